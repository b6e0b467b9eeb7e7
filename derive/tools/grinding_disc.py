"""ZK: a biconical grinding wheel set at the lead angle (ISO 10828, form K)."""

import sympy as sp

from derive.language.chain import Motion
from derive.language.differentiate import partial
from derive.language.envelope import explicit
from derive.language.symbols import Quantity
from derive.language.tool import tool
from derive.tools.grinding import WHEEL_RADIUS, grinding_wheel, ground_flank, ground_tool


@tool(WHEEL_RADIUS)
def grinding_disc(body, definitions):
    """Groove flank of a ZK worm or hob in its body frame; parameters (t, ψ), t the angle on the grinding wheel."""
    alpha, r, s = body.pressure_angle, body.pitch_radius, body.flank
    u = Quantity(f"u_{body.name}", "mm", "distance along the wheel's edge from its pitch point to the rim", body.name)
    edge = (r - u * sp.cos(alpha), sp.Integer(0), s * (body.groove_width / 2 - u * sp.sin(alpha)))
    tangent = tuple(partial(c, u) for c in edge)
    wheel = grinding_wheel(body, definitions, edge, tangent, Motion(), u, outward=-s)
    flank = ground_flank(wheel, body, lambda surface: explicit(surface)[0])
    return ground_tool(body, flank.on("helicoids/zk-normal", "zk-zn/eq-4"))
