"""Conical (or cylindrical) hob: a straight edge whose screw motion also carries it outwards along a cone."""

import sympy as sp

from derive.language.chain import Rz, translation
from derive.language.surface import swept


def conical_hob(definitions, *, along, sweep, phase, pitch_radius, screw_parameter, cone_angle, profile_angle, flank):
    """Thread flank of the hob in its body frame, z along its axis; normal out of the hob.

    ``along`` = 0 is the middle of the profile, on the pitch cone; the radius there is ``pitch_radius`` at
    ``sweep`` = 0 and grows by screw_parameter·tan(cone_angle) a radian. ``flank`` is +1 where the gear tooth is
    convex. Source: F. L. Litvin, A. Nava, Q. Fan and A. Fuentes, NASA/CR-2002-211895, section 3, "existing design".
    """
    edge = (
        pitch_radius + along * sp.cos(profile_angle),
        sp.Integer(0),
        flank * along * sp.sin(profile_angle),
    )
    advance = screw_parameter * sweep
    motion = Rz(sweep + phase) @ translation(x=advance * sp.tan(cone_angle), z=advance)
    return swept(definitions, edge, motion, along=along, sweep=sweep, outward=-flank)
