"""ZA: a straight edge in the axial plane, in screw motion (ISO 10828, form A: the Archimedean helicoid)."""

import sympy as sp

from derive.language.surface import helicoid
from derive.language.symbols import Quantity
from derive.language.tool import tool
from derive.tools.worm_body import WormTool, reach


@tool()
def axial_blade(body, definitions):
    """Groove flank of a ZA worm or hob in its body frame; parameters (t, ψ), t the radius."""
    r, s, lead = body.pitch_radius, body.flank, body.lead_angle
    t = Quantity(f"t_{body.name}", "mm", "radius", body.name)
    height = body.groove_width / 2 + (t - r) * sp.tan(body.pressure_angle)
    section = definitions.let_vector(
        f"P_{body.name}", (t, sp.Integer(0), s * height / sp.cos(lead)), "blade edge", "mm", body.name
    )
    flank = helicoid(
        definitions, section, along=t, sweep=body.turn, parameter=body.screw_parameter, outward=-s
    )
    return WormTool(
        flank.on("helicoids/za-normal"),
        pitch_point=r,
        tip_margin=reach(body, t),
        scale=body.module,
        screw_parameter=body.screw_parameter,
        lower_end=sp.Integer(0),
    )
