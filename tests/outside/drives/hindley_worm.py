"""Hourglass worm drives: a worm turned with a straight edge that swings like a wheel, and a wheel cut by such a hob.

Frames: ``f`` fixed, z along the worm axis, x from worm to wheel; the wheel axis is (0, sin Σ, cos Σ) through (A, 0, 0).
The worm turns by +φ1 about z, the wheel by +φ2 about minus its axis. The lathe tool of a worm or hob turns about a
parallel to the wheel axis at A + excess, on a radius that is larger than the wheel's by the same excess and so slowly
that it moves like the wheel in the pitch point: excess 0 is the Hindley worm, an infinite one the ZA worm.
"""

from dataclasses import dataclass

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import Rx, Ry, Rz, translation
from derive.language.contact import contact
from derive.language.definitions import Definitions
from derive.language.drive import Body, Drive, Margin, System, body_point
from derive.language.envelope import envelope, merge_sum
from derive.language.surface import Surface, swept
from derive.language.symbols import Quantity, Rule, Table, Unknown, parameter

POSITIVE = (0, sp.oo)

flank = parameter("flank", "s", "groove flank", table=Table.FLANK, choices=(("right", 1), ("left", -1)), default=1)
module = parameter("module_mm", "m", "transverse module of the wheel", domain=POSITIVE, required=True)
threads = parameter("worm_threads", "T_1", "threads of the worm", domain=POSITIVE, integer=True, required=True)
teeth = parameter("wheel_teeth", "T_2", "teeth of the wheel", domain=POSITIVE, integer=True, required=True)
pressure_angle = parameter("pressure_angle_deg", "alpha", "slope of the edge", domain=(0, sp.pi / 2), required=True)
distance = parameter("center_distance_mm", "A", "centre distance", domain=POSITIVE, required=True)
shaft_angle = parameter("shaft_angle_deg", "Sigma", "shaft angle", domain=(0, sp.pi), default=sp.pi / 2)
worm_excess = parameter("worm_tool_excess_mm", "e_worm", "excess of the worm's tool radius", required=True)
hob_excess = parameter("hob_tool_excess_mm", "e_hob", "excess of the hob's tool radius", required=True)
error_distance = parameter("center_distance_mm", "dA", "centre distance error", table=Table.MISALIGNMENT, default=0)
error_horizontal = parameter("horizontal_deg", "dh", "shaft angle error", table=Table.MISALIGNMENT, default=0)
error_vertical = parameter("vertical_deg", "dv", "tilt of the wheel about y", table=Table.MISALIGNMENT, default=0)
error_axial = parameter("axial_mm", "da", "shift of the wheel along its axis", table=Table.MISALIGNMENT, default=0)
error_worm = parameter("worm_axial_mm", "dw", "shift of the worm along its axis", table=Table.MISALIGNMENT, default=0)
wheel_tip = parameter("wheel_tip_radius_mm", "R_tip", "outside cylinder", table=Table.BLANK, domain=POSITIVE)
face_width = parameter("wheel_face_width_mm", "b_wheel", "face width", table=Table.BLANK, domain=POSITIVE)
worm_addendum = parameter("worm_addendum_mm", "h_tip", "end of the edge outwards", table=Table.BLANK, domain=POSITIVE)
worm_dedendum = parameter("worm_dedendum_mm", "h_root", "end of the edge inwards", table=Table.BLANK, domain=POSITIVE)
worm_length = parameter("worm_length_mm", "L_worm", "length of the worm", table=Table.BLANK, domain=POSITIVE)
separation = parameter(
    "separation_mm", "delta", "separation for contact ellipses", table=Table.CONTACT, domain=POSITIVE,
    default=sp.Rational(632, 100000),
)  # fmt: skip

PARAMETERS = (
    flank, module, threads, teeth, pressure_angle, distance, shaft_angle, worm_excess, hob_excess, error_distance,
    error_horizontal, error_vertical, error_axial, error_worm, wheel_tip, face_width, worm_addendum, worm_dedendum,
    worm_length, separation,
)  # fmt: skip

s, m, T_1, T_2, alpha, A, Sigma = (
    q.symbol for q in (flank, module, threads, teeth, pressure_angle, distance, shaft_angle)
)
R = m * T_2 / 2
ratio = T_1 / T_2

RULES = (
    Rule(worm_addendum.symbol, m),
    Rule(worm_dedendum.symbol, sp.Rational(6, 5) * m),
    Rule(wheel_tip.symbol, R + m),
)


@dataclass(frozen=True)
class Thread:
    surface: Surface
    slow: sp.Expr

    @property
    def edge(self):
        return self.surface.parameters[0]

    @property
    def turn(self):
        return self.surface.parameters[1]


def _thread(name, excess, definitions):
    """The groove flank that a straight edge leaves on a body that turns while the edge swings about the tool's axis."""
    u = Quantity(f"u_{name}", "mm", f"along the edge of the {name}'s tool, outwards", name)
    turn = Quantity(f"theta_{name}", "rad", f"turn of the {name} in its own cutting", name)
    radius = R + excess
    slow = definitions.let(f"ratio_{name}", ratio * R / radius, f"turn of the tool a turn of the {name}")
    edge = (u * sp.cos(alpha) - radius, -s * (sp.pi * m / 4 + u * sp.sin(alpha)), sp.Integer(0))
    motion = Rz(-turn) @ translation(x=A + excess) @ Rx(-Sigma) @ Rz(-slow * turn)
    return Thread(swept(definitions, edge, motion, along=u, sweep=turn, outward=s), slow)


def hindley_worm():
    """The drive."""
    definitions = Definitions()
    phi_1 = Quantity("phi_worm", "rad", "angle of the worm in mesh", "f")
    error = Quantity("transmission_error", "rad", "wheel angle less ratio times worm angle", "f")
    phi_2 = ratio * phi_1 + error
    worm, hob = (_thread(n, e.symbol, definitions) for n, e in (("worm", worm_excess), ("hob", hob_excess)))
    phi_h = Quantity("phi_hob", "rad", "angle of the hob in cutting", "gen")
    cutting = Rz(ratio * phi_h) @ Rx(Sigma) @ translation(x=-A) @ Rz(phi_h)
    wheel = envelope(hob.surface, cutting, phi_h)
    total = Quantity("psi_hob", "rad", "hob angle less its own turn", "gen")
    wheel, total = merge_sum(wheel, -hob.turn, phi_h, "psi_hob", "angle of the hob less the turn of the point")
    pinion = Body(
        "pinion",
        worm.surface,
        translation(z=error_worm.symbol) @ Rz(phi_1),
        reference={worm.edge: sp.Integer(0), worm.turn: sp.Integer(0)},
        point=body_point("pinion"),
        margins=(
            Margin("off_tip", "tip", worm_addendum.symbol - worm.edge * sp.cos(alpha)),
            Margin("off_root", "root", worm_dedendum.symbol + worm.edge * sp.cos(alpha)),
            Margin("off_face", "face", worm_length.symbol / 2 - sp.Abs(body_point("pinion")[2])),
        ),
    )
    x, y, z = body_point("wheel")
    wheel_body = Body(
        "wheel",
        wheel,
        translation(x=A + error_distance.symbol)
        @ Rx(-(Sigma + error_horizontal.symbol))
        @ Ry(error_vertical.symbol)
        @ translation(z=error_axial.symbol)
        @ Rz(-phi_2),
        reference={hob.edge: sp.Integer(0), hob.turn: sp.Integer(0), total: sp.Integer(0)},
        point=body_point("wheel"),
        margins=(
            Margin("off_tip", "tip", wheel_tip.symbol - v.radius(x, y)),
            Margin("off_face", "face", face_width.symbol / 2 - sp.Abs(z)),
        ),
        lengthwise="axial",
    )
    (meshing,) = wheel.conditions
    return Drive(
        name="hindley_worm",
        family="hindley-worm",
        title="hourglass worm with a wheel cut by an hourglass hob",
        parameters=PARAMETERS,
        rules=RULES,
        guards=(),
        instant=phi_1,
        error=error,
        pinion=pinion,
        wheel=wheel_body,
        unknowns=(
            Unknown(worm.edge, m), Unknown(worm.turn), Unknown(hob.edge, m), Unknown(hob.turn), Unknown(total),
            Unknown(error),
        ),
        residual=contact(pinion.placed, wheel_body.placed),
        definitions=definitions,
        start=System(
            name="start",
            definitions=definitions,
            unknowns=(Unknown(total),),
            residual=(meshing,),
            outputs={
                worm.edge: sp.Integer(0), worm.turn: phi_1, hob.edge: sp.Integer(0), hob.turn: phi_1, total: total,
                error: sp.Integer(0),
            },
            fixed={hob.edge: sp.Integer(0), hob.turn: phi_1},
        ),
        guess={total: sp.Integer(0)},
        sample={"flank": 1, "module_mm": 4, "worm_threads": 1, "wheel_teeth": 40, "pressure_angle_deg": 20,
                "center_distance_mm": 105, "worm_tool_excess_mm": 60, "hob_tool_excess_mm": 20},
        sample_angle=0.1,
        pinion_teeth=threads.key,
    )  # fmt: skip


def catalogue():
    """The one drive."""
    return {"hindley_worm": hindley_worm}
