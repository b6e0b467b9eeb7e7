"""ZI: a straight line that touches the helix of a base cylinder, in screw motion (ISO 10828, form I)."""

import sympy as sp

from derive.language import vectors as v
from derive.language.origin import Origin
from derive.language.surface import helicoid
from derive.language.symbols import Quantity
from derive.language.tool import tool
from derive.tools.worm_body import WormTool, reach, regression


@tool()
def involute(body, definitions):
    """Groove flank of a ZI worm or hob in its body frame; parameters (t, ψ), t ≥ base radius the radius."""
    r, s, lead, name = body.pitch_radius, body.flank, body.lead_angle, body.name
    t = Quantity(f"t_{name}", "mm", "radius", name)
    base = definitions.let(
        f"r_b_{name}",
        r / v.root(1 + (sp.tan(body.pressure_angle) / sp.sin(lead)) ** 2),
        "base radius",
        "mm",
        name,
    )

    def profile_angle(radius):
        return v.arc(sp.sqrt((radius - base) * (radius + base)), base)

    origin = Origin("helicoids/zi-normal")

    here = definitions.let(f"a_t_{name}", profile_angle(t), "transverse profile angle", "rad", name, origin)
    there = definitions.let(
        f"a_t_pitch_{name}", profile_angle(r), "the same on the pitch cylinder", "rad", name, origin
    )
    rise = body.screw_parameter * (_involute_function(here) - _involute_function(there))
    height = s * (body.groove_width / (2 * sp.cos(lead)) + rise)
    section = definitions.let_vector(f"P_{name}", (t, sp.Integer(0), height), "axial section", "mm", name)
    flank = helicoid(
        definitions, section, along=t, sweep=body.turn, parameter=body.screw_parameter, outward=-s
    )
    return WormTool(
        flank.on("helicoids/zi-normal"),
        pitch_point=r,
        tip_margin=reach(body, t),
        scale=body.module,
        screw_parameter=body.screw_parameter,
        lower_end=base,
        margins=(regression(t - base),),
    )


def _involute_function(angle):
    return sp.tan(angle) - angle
