"""Two worms outside the tree: a blade crowned about the involute helicoid, and a ZN blade with a parabolic tip."""

import sympy as sp

from derive.drives import cylindrical_worm as family
from derive.language import vectors as v
from derive.language.chain import Rx
from derive.language.choice import excess
from derive.language.surface import helicoid
from derive.language.symbols import Quantity
from derive.language.tool import Datum, tool
from derive.tools.worm_body import WormTool, reach, regression

CROWN = Datum("blade_crown_per_mm", "c", "crowning of the blade", default=0, sample="0.001")
RELIEF = Datum("tip_relief_per_mm", "q", "parabola of the relieved tip", domain=(0, sp.oo), lower_included=True,
               default=0, sample="0.01")  # fmt: skip
BEGIN = Datum("tip_relief_begin_mm", "b", "distance beyond the pitch line where the tip relief begins", default=0,
              sample="0.5")  # fmt: skip


@tool(CROWN)
def crowned_involute(body, definitions):
    """Involute helicoid (ISO 10828, form I), crowned about the pitch cylinder."""
    r, s, p, lead = body.pitch_radius, body.flank, body.screw_parameter, body.lead_angle
    t = Quantity(f"t_{body.name}", "mm", "radius", body.name)
    base = definitions.let(f"r_b_{body.name}", r / v.root(1 + (sp.tan(body.pressure_angle) / sp.sin(lead)) ** 2),
                           "base radius", "mm", body.name)  # fmt: skip

    def involute(radius):
        tangent = sp.sqrt((radius - base) * (radius + base))
        return tangent / base - v.arc(tangent, base)

    height = body.groove_width / (2 * sp.cos(lead)) + p * (involute(t) - involute(r)) - body[CROWN] * (t - r) ** 2
    section = definitions.let_vector(f"P_{body.name}", (t, 0, s * height), "axial section", "mm")
    flank = helicoid(definitions, section, along=t, sweep=body.turn, parameter=p, outward=-s)
    return WormTool(
        flank, r, reach(body, t), body.module, p, lower_end=base, margins=(regression(t - base),)
    )


@tool(RELIEF, BEGIN)
def relieved_blade(body, definitions):
    """Straight edge in the plane normal to the groove (ISO 10828, form N) that falls back by a parabola at its tip."""
    alpha, r, s = body.pressure_angle, body.pitch_radius, body.flank
    t = Quantity(f"t_{body.name}", "mm", "height over the pitch line", body.name)
    half = body.groove_width * sp.sin(body.lead_angle) / 2
    foot = definitions.let(f"x_{body.name}", v.root(r**2 - half**2), "height of the pitch line", "mm")
    across = body.groove_width / 2 + t * sp.tan(alpha) + body[RELIEF] * excess(t - body[BEGIN]) ** 2
    edge = Rx(body.lead_angle).point((foot + t, sp.Integer(0), s * across))
    section = definitions.let_vector(f"P_{body.name}", edge, "blade edge", "mm")
    flank = helicoid(definitions, section, along=t, sweep=body.turn, parameter=body.screw_parameter, outward=-s)
    return WormTool(
        flank, sp.Integer(0), body.tip_addendum - t, body.module, body.screw_parameter,
        radicands=(("the groove is wider than the pitch cylinder", r**2 - half**2),),
    )  # fmt: skip


def catalogue():
    family.TOOLS |= {"ZY": crowned_involute, "ZT": relieved_blade}
    return {
        f"cylindrical_worm_{word.lower()}_{word.lower()}": lambda word=word: family.cylindrical_worm(word, word)
        for word in ("ZY", "ZT")
    }
