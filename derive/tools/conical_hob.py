"""Conical (or cylindrical) hob: a straight edge whose screw motion also carries it outwards along a cone."""

from dataclasses import dataclass

import sympy as sp

from derive.language.chain import Rz, translation
from derive.language.surface import swept
from derive.language.symbols import Quantity
from derive.language.tool import tool


@dataclass(frozen=True)
class HobBody:
    """What the tool needs to know. Angles in rad, lengths in mm.

    ``along`` = 0 is the middle of the profile, on the pitch cone; the radius there is ``pitch_radius`` at
    ``sweep`` = 0 and grows by screw_parameter·tan(cone_angle) a radian. ``flank`` is +1 where the gear tooth is convex.
    """

    along: Quantity
    sweep: Quantity
    phase: sp.Expr
    pitch_radius: sp.Expr
    screw_parameter: sp.Expr
    cone_angle: sp.Expr
    profile_angle: sp.Expr
    flank: sp.Expr


@tool()
def conical_hob(body, definitions):
    """Thread flank of a conical hob in its body frame, z along its axis; normal out of the hob.

    Source: F. L. Litvin, A. Nava, Q. Fan and A. Fuentes, NASA/CR-2002-211895, section 3, "existing design".
    """
    edge = (
        body.pitch_radius + body.along * sp.cos(body.profile_angle),
        sp.Integer(0),
        body.flank * body.along * sp.sin(body.profile_angle),
    )
    advance = body.screw_parameter * body.sweep
    motion = Rz(body.sweep + body.phase) @ translation(x=advance * sp.tan(body.cone_angle), z=advance)
    return swept(definitions, edge, motion, along=body.along, sweep=body.sweep, outward=-body.flank)
