"""ZN: a straight edge in the plane normal to the groove, in screw motion (ISO 10828, form N)."""

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import Rx
from derive.language.origin import Origin
from derive.language.surface import helicoid
from derive.language.symbols import Quantity
from derive.language.tool import tool
from derive.tools.worm_body import WormTool


@tool()
def straight_blade(body, definitions):
    """Groove flank of a ZN worm or hob in its body frame; parameters (t, ψ), t along the edge from its apex."""
    alpha, r, s = body.pressure_angle, body.pitch_radius, body.flank
    t = Quantity(
        f"t_{body.name}", "mm", "distance along the edge from the virtual apex of both edges", body.name, (0, sp.oo)
    )
    half_groove = body.groove_width * sp.sin(body.lead_angle) / 2
    apex = definitions.let(
        f"r_t_{body.name}",
        v.root(r**2 - half_groove**2) - body.groove_width / (2 * sp.tan(alpha)),
        "distance of the virtual apex from the axis",
        "mm",
        body.name,
        Origin("helicoids/zn-width"),
    )
    blade = (apex + t * sp.cos(alpha), sp.Integer(0), s * t * sp.sin(alpha))
    section = definitions.let_vector(f"P_{body.name}", Rx(body.lead_angle).point(blade), "blade edge", "mm", body.name)
    flank = helicoid(definitions, section, along=t, sweep=body.turn, parameter=body.screw_parameter, outward=-s)
    pitch_point = body.groove_width / (2 * sp.sin(alpha))
    return WormTool(
        flank.on("helicoids/zn-width", "helicoids/zn-straight", "helicoids/zn-normal"),
        pitch_point=pitch_point,
        tip_margin=pitch_point + body.tip_addendum / sp.cos(alpha) - t,
        scale=body.module,
        screw_parameter=body.screw_parameter,
        lower_end=sp.Integer(0),
        radicands=(("the groove is wider than the pitch cylinder", r**2 - half_groove**2),),
    )
