"""Plane sections of a right-angle worm drive: the profiles of its rack and its pinion in the plane y = C."""

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.flank.grids import Grid
from meshwright.limits.cylindrical_worm import need_right_angle, section_radii
from meshwright.limits.profile import Profile


def section(drive, member, offset, count):
    """:class:`~meshwright.flank.grids.Grid` of count × 1 points of a member's flank in the plane y = ``offset``, mm.

    The worm is cut at angle 0, where its frame is the fixed frame; the wheel's profile is the one that the hob's
    section generates, in the wheel's plane z = ``offset`` (−``offset`` on a left-hand drive: every frame is mirrored).
    In order of growing radius on the worm or hob.
    """
    if drive.design.family != "cylindrical-worm":
        raise UsageError(f"--section: a {drive.design.family} drive has no sections that mesh as planar pairs")
    need_right_angle(drive)
    mirror = drive.design.mirror.sign
    profile = Profile(drive, "worm" if member == "pinion" else "hob")
    t = np.array([profile.at_radius(r) for r in section_radii(drive, profile, count)], dtype=float)
    point = profile(t)["point"]
    with np.errstate(invalid="ignore"):
        turn = np.arcsin(mirror * offset / np.hypot(point[:, 0], point[:, 1])) - np.arctan2(point[:, 1], point[:, 0])
    if not np.all(np.isfinite(turn)):
        raise UsageError(f"--section {offset:g}: the plane misses the profile; use a value nearer to 0")
    flank = drive.flank(member)
    at = flank(np.column_stack([t, turn]))
    flip = np.array([1.0, mirror, 1.0])
    values = np.column_stack([t, mirror * turn])
    return Grid(member, "flank", flank.parameters, (len(t), 1), values, at.points * flip, at.normals * flip)
