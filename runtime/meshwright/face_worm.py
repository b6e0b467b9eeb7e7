"""Limits of a face worm drive: where its worm, its gear and the hob-cut gear of the reference design are undercut."""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.singular_lines import edges


@dataclass(frozen=True)
class UndercutPoint:
    """A point of a singular line: surface parameters by name (mm, rad) and the point (3,), mm, in the member's frame.

    ``on_flank``: inside the blade's working length and the face of the gear.
    """

    member: str
    parameters: dict[str, float]
    point: np.ndarray
    on_flank: bool


def undercut(drive, count=9):
    """:class:`UndercutPoint` of each member at ``count`` places of the profile, from root to tip of the gear tooth.

    Member ``reference_wheel`` is the gear that the hob would cut; the flank of the gear itself is a cone, singular at
    its apex only.
    """
    root, tip = _profile(drive)
    points = [_cone_apex(drive)]
    for member, ends in (("pinion", (root, tip)), ("reference_wheel", _hob_profile(drive))):
        surface = drive.flank(member)
        for profile in np.linspace(*ends, count):
            points += [_point(drive, member, surface, q) for q in edges(surface, profile)]
    return points


def _profile(drive):
    """Ends of the blade's working length: u at the root and at the tip of the gear tooth."""
    top = drive.design.value("gear_addendum_mm", "blank") / math.cos(drive.design.value("blade_angle_deg"))
    return drive.design.sizes["flank_root_mm"], top


def _hob_profile(drive):
    """The same heights on the hob, whose u grows into the gear."""
    slant = math.cos(drive.design.value("profile_angle_deg"))
    return -drive.design.value("gear_addendum_mm", "blank") / slant, drive.design.value("blade_depth_mm") / slant


def _point(drive, member, surface, q):
    point = surface([q]).points[0]
    # the worm's generating point lies on the head-cutter's cone, at the same u and θ to the blade's small parabola
    on_gear = point if member == "reference_wheel" else drive.flank("wheel")([q[:2]]).points[0]
    named = dict(zip(surface.parameters, q.tolist(), strict=True))
    return UndercutPoint(member, named, point, _inside(drive, on_gear))


def _inside(drive, point):
    inner, outer = (drive.design.value(f"gear_{end}_radius_mm") for end in ("inner", "outer"))
    return bool(inner < math.hypot(point[0], point[1]) < outer)


def _cone_apex(drive):
    """The singular function of a cone is linear along its generatrix: two values give its root."""
    wheel = drive.flank("wheel")
    at_middle, beyond = wheel([[0.0, 0.0], [1.0, 0.0]]).regular
    u = at_middle / (at_middle - beyond)
    root, tip = _profile(drive)
    return UndercutPoint(
        "wheel", {"u_gear": float(u), "theta_gear": 0.0}, wheel([[u, 0.0]]).points[0], bool(root < u < tip)
    )
