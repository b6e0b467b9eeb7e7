"""Limits of a face worm drive: undercut of worm, gear and hob-cut reference gear, and the head-cutter's clearance."""

import math

import numpy as np

from meshwright.limits import head_cutter
from meshwright.limits.branches import branch_points
from meshwright.limits.results import Limits, SurfaceLimit
from meshwright.limits.singular_lines import edges


def limits(drive, request):
    """All limits of the drive; see :class:`~meshwright.limits.results.Limits`."""
    return Limits(
        undercut=tuple(undercut(drive, request.grid)),
        branch_points=branch_points(drive),
        head_cutter=head_cutter.judged(drive),
    )


def undercut(drive, count):
    """Singular points of each member at ``count`` places of the profile, root to tip of the gear tooth, and its middle.

    Member ``reference_wheel`` is the gear that the hob would cut; the flank of the gear itself is a cone, singular at
    its apex only.
    """
    yield _cone_apex(drive)
    for member, ends in (("pinion", _profile(drive)), ("reference_wheel", _hob_profile(drive))):
        surface = drive.flank(member)
        for profile in np.union1d(np.linspace(*ends, count), 0.0):
            for q in edges(surface, profile):
                yield _limit(drive, member, surface, q)


def _profile(drive):
    """Ends of the blade's working length: u at the root and at the tip of the gear tooth."""
    return drive.design.sizes["flank_root_mm"], head_cutter.tip_place(drive)


def _hob_profile(drive):
    """The same heights on the hob, whose u grows into the gear."""
    slant = math.cos(drive.design.value("profile_angle_deg"))
    return -drive.design.value("gear_addendum_mm", "blank") / slant, drive.design.value("blade_depth_mm") / slant


def _limit(drive, member, surface, q):
    point = surface([q]).points[0]
    # the worm's generating point lies on the head-cutter's cone, at the same u and θ to the blade's small parabola
    on_gear = point if member == "reference_wheel" else drive.flank("wheel")([q[:2]]).points[0]
    named = dict(zip(surface.parameters, q.tolist(), strict=True))
    return SurfaceLimit(member, point, named, _inside(drive, on_gear), {"edge_position_mm": float(q[0])})


def _inside(drive, point):
    inner, outer = (drive.design.value(f"gear_{end}_radius_mm") for end in ("inner", "outer"))
    return bool(inner < math.hypot(point[0], point[1]) < outer)


def _cone_apex(drive):
    """The singular function of a cone is linear along its generatrix: two values give its root."""
    wheel = drive.flank("wheel")
    at_middle, beyond = wheel([[0.0, 0.0], [1.0, 0.0]]).regular
    u = at_middle / (at_middle - beyond)
    root, tip = _profile(drive)
    named = {"u_gear": float(u), "theta_gear": 0.0}
    place = {"edge_position_mm": float(u)}
    return SurfaceLimit("wheel", wheel([[u, 0.0]]).points[0], named, bool(root < u < tip), place)
