"""Plane sections of a drive whose wheel is generated as rack and pinion: the profiles of both in the plane y = C."""

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.flank.grids import Grid
from meshwright.limits.profile import Profile
from meshwright.limits.rack import need_right_angle, section_radii


def section(drive, member, offset, count):
    """:class:`~meshwright.flank.grids.Grid` of count × 1 points of a member's flank in the plane y = ``offset``, mm.

    The pinion is cut at angle 0, where its frame is the fixed frame; the wheel's profile is the one that the tool's
    section generates, in the wheel's plane z = ``offset`` (−``offset`` on a left-hand drive: every frame is mirrored).
    In order of growing radius on the pinion or tool.
    """
    need_right_angle(drive)
    mirror = drive.design.mirror.sign
    profile = Profile(drive, "pinion" if member == "pinion" else "tool")
    t = np.array([profile.at_radius(r) for r in section_radii(drive, profile, count)], dtype=float)
    point = profile(t)["point"]
    with np.errstate(invalid="ignore"):
        turn = np.arcsin(mirror * offset / np.hypot(point[:, 0], point[:, 1])) - np.arctan2(point[:, 1], point[:, 0])
    if not np.all(np.isfinite(turn)):
        raise UsageError(f"--section {offset:g}: the plane misses the profile; use a value nearer to 0")
    flank = drive.flank(member)
    at = flank(np.column_stack([t, turn]))
    flip = drive.design.mirror.flip
    values = np.column_stack([t, mirror * turn])
    return Grid(member, "flank", flank.parameters, (len(t), 1), values, at.points * flip, at.normals * flip)
