"""ZC: a grinding wheel with a convex arc profile, set at the lead angle (ISO 10828, form C): a concave worm flank."""

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import swing
from derive.language.envelope import explicit_angle
from derive.language.outline import m
from derive.language.symbols import Quantity
from derive.language.tool import Datum, tool
from derive.tools.grinding import WHEEL_RADIUS, grinding_wheel, ground_flank, ground_tool

ARC_RADIUS = Datum(
    "profile_arc_radius_mm", "rho_c", "profile arc radius", domain=(0, sp.oo), required=True, sample=40,
    suggested=6 * m, why="six modules", decimals=2,
)  # fmt: skip


@tool(WHEEL_RADIUS, ARC_RADIUS)
def grinding_arc(body, definitions):
    """Groove flank of a ZC worm or hob in its body frame; parameters (t, ψ), t the angle on the grinding wheel."""
    alpha, r, s, rho = body.pressure_angle, body.pitch_radius, body.flank, body[ARC_RADIUS]
    xi = Quantity(f"xi_{body.name}", "rad", "angle along the wheel's arc from its pitch point, about y", body.name)
    pitch_point = (r, sp.Integer(0), s * body.groove_width / 2)
    centre = v.add(pitch_point, (rho * sp.sin(alpha), sp.Integer(0), -s * rho * sp.cos(alpha)))
    arc = swing("y", xi, centre)
    tangent = arc.local_velocity(xi, pitch_point)
    wheel = grinding_wheel(body, definitions, pitch_point, tangent, arc, xi, outward=1 / rho, pole=centre)
    # Both directions of the normal solve the equation of meshing; at the pitch point the wheel's own is the one
    # along which the arc's centre recedes, hence the sign.
    flank = ground_flank(wheel, body, lambda surface: explicit_angle(surface, xi, sign=-1))
    radicand = ("the arc's centre lies inside the groove", rho - body.groove_width / 2 * sp.cos(alpha))
    flank = flank.on("helicoids/zc-normal", "helicoids/zc-meshing", "helicoids/zc-limit")
    return ground_tool(body, flank, radicands=(radicand,))
