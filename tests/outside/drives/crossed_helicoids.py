"""A drive outside the tree: two right-hand involute helicoids on crossed axes.

Frames: ``f`` fixed, z along the pinion's axis, x to the wheel; the wheel's axis is (0, sin Σ, cos Σ) through (a, 0, 0).
The pinion turns by +φ1 about z, the wheel by +φ2 about minus its axis. A tooth is centred on x in its body frame.
"""

from dataclasses import dataclass

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import Rx, Rz, translation
from derive.language.contact import contact
from derive.language.definitions import Definitions
from derive.language.drive import Body, Drive, Loading, Margin, Region, Role, Source, System, body_point
from derive.language.functions import solid
from derive.language.surface import Surface, helicoid
from derive.language.symbols import Guard, Parameter, Quantity, Rule, Table, Unknown, parameter, rotation_angle

POSITIVE, ACUTE = (0, sp.oo), (0, sp.pi / 2)

flank = parameter("flank", "s", "flank", table=Table.FLANK, choices=(("left", 1), ("right", -1)), default=1)
module = parameter("normal_module_mm", "m", "normal module", domain=POSITIVE, required=True)
pressure_angle = parameter("pressure_angle_deg", "alpha", "normal pressure angle", domain=ACUTE, required=True)
face_width = parameter("face_width_mm", "F", "face width of both gears", domain=POSITIVE, required=True)
rounding = parameter("root_rounding_mm", "rho", "radius of the root fillet in the transverse plane", domain=POSITIVE)
distance = parameter("center_distance_mm", "a", "centre distance", domain=POSITIVE)
shaft_angle = parameter("shaft_angle_deg", "Sigma", "shaft angle", domain=(0, sp.pi))
error_distance = parameter(
    "center_distance_mm", "da", "centre distance error", table=Table.MISALIGNMENT, default=0
)
error_angle = parameter("shaft_angle_deg", "dSigma", "shaft angle error", table=Table.MISALIGNMENT, default=0)
separation = parameter(
    "separation_mm", "delta", "separation for contact ellipses", table=Table.CONTACT, domain=POSITIVE,
    default=sp.Rational(632, 100000),
)  # fmt: skip

s, m, alpha = flank.symbol, module.symbol, pressure_angle.symbol


@dataclass(frozen=True)
class Gear:
    """The keys of one member and what follows from them in its transverse plane."""

    name: str
    teeth: Parameter
    helix_angle: Parameter
    tip_radius: Parameter
    form_radius: Parameter

    @classmethod
    def of(cls, name):
        def own(key, symbol, meaning, domain=POSITIVE, **kind):
            return parameter(f"{name}_{key}", f"{symbol}_{name}", f"{meaning} of the {name}", domain=domain, **kind)

        return cls(
            name,
            own("teeth", "T", "teeth", integer=True, required=True),
            own("helix_angle_deg", "beta", "helix angle, right hand,", ACUTE, required=True),
            own("tip_radius_mm", "r_a", "tip radius", table=Table.BLANK),
            own("form_radius_mm", "r_f", "radius where the involute begins", table=Table.BLANK),
        )

    @property
    def parameters(self):
        return self.teeth, self.helix_angle, self.tip_radius, self.form_radius

    @property
    def pitch_radius(self):
        return m * self.teeth.symbol / (2 * sp.cos(self.helix_angle.symbol))

    @property
    def roll_at_pitch(self):
        """Tangent of the transverse pressure angle."""
        return sp.tan(alpha) / sp.cos(self.helix_angle.symbol)

    @property
    def base_radius(self):
        return self.pitch_radius / v.root(1 + self.roll_at_pitch**2)

    @property
    def screw_parameter(self):
        return self.pitch_radius / sp.tan(self.helix_angle.symbol)

    @property
    def cos_base_helix(self):
        return v.unit((self.screw_parameter, self.base_radius, sp.Integer(0)))[0]

    def roll_at(self, radius):
        """Roll angle of the involute at a radius."""
        return v.root(radius**2 - self.base_radius**2) / self.base_radius


PINION, WHEEL = Gear.of("pinion"), Gear.of("wheel")


@dataclass(frozen=True)
class Tooth:
    """Flank and fillet of a gear; ``bottom`` is the fillet's parameter where it meets the root circle."""

    gear: Gear
    flank: Surface
    fillet: Surface
    bottom: sp.Expr
    root_radius: sp.Expr


def _tooth(gear, definitions):
    name, radius = gear.name, definitions.let(f"r_b_{gear.name}", gear.base_radius, "base radius", "mm")
    roll, psi = Quantity(f"roll_{name}", "rad", f"roll angle of the {name}'s involute", name), _turn("psi", name)
    involute = v.arc(gear.roll_at_pitch, sp.Integer(1))
    half = sp.pi / (2 * gear.teeth.symbol) + gear.roll_at_pitch - involute
    half = definitions.let(f"half_{name}", half, "half tooth angle on the base circle", "rad")
    p = definitions.let(f"p_{name}", gear.screw_parameter, "screw parameter", "mm/rad")

    def from_centre(x, y):
        """A point or vector of the involute that starts at azimuth 0, on the tooth's side."""
        return Rz(s * half).direction((x, -s * y, sp.Integer(0)))

    section = from_centre(
        radius * (sp.cos(roll) + roll * sp.sin(roll)), radius * (sp.sin(roll) - roll * sp.cos(roll))
    )
    surface = helicoid(definitions, section, along=roll, sweep=psi, parameter=p, outward=-s)

    start = definitions.let(f"roll_f_{name}", gear.roll_at(gear.form_radius.symbol), "roll angle at the form circle")
    cosine, sine = sp.cos(start), sp.sin(start)
    normal, along, rho = (sine, -cosine), (cosine, sine), rounding.symbol
    centre = tuple(
        definitions.let(f"c_{axis}_{name}", value, "centre of the fillet", "mm")
        for axis, value in (
            ("x", radius * (cosine + start * sine) + rho * sine),
            ("y", radius * (sine - start * cosine) - rho * cosine),
        )
    )
    xi = Quantity(f"xi_{name}", "rad", f"turn of the normal along the fillet of the {name}", name)
    psi_f = _turn("psi_f", name)
    arc = [c - rho * (sp.cos(xi) * n + sp.sin(xi) * e) for c, n, e in zip(centre, normal, along, strict=True)]
    fillet = helicoid(definitions, from_centre(*arc), along=xi, sweep=psi_f, parameter=p, outward=s)
    bottom = v.arc(sum(a * b for a, b in zip(centre, along, strict=True)),
                   sum(a * b for a, b in zip(centre, normal, strict=True)))  # fmt: skip
    bottom = definitions.let(f"xi_bottom_{name}", bottom, "end of the fillet", "rad")
    return Tooth(gear, surface, fillet, bottom, v.radius(*centre) - rho)


def _turn(symbol, name):
    return rotation_angle(f"{symbol}_{name}", f"screw angle of the {name}", name)


def _body(tooth, motion):
    gear, (roll, psi) = tooth.gear, tooth.flank.parameters
    x, y, z = body_point(gear.name)
    margins = (
        Margin("off_tip", "tip", gear.tip_radius.symbol - v.radius(x, y)),
        Margin("off_face", "face", face_width.symbol / 2 - sp.Abs(z)),
        Margin("off_root", "root", roll - gear.roll_at(gear.form_radius.symbol), Role.JUNCTION, joins="fillet"),
    )
    return Body(
        gear.name, tooth.flank, motion, {roll: gear.roll_at_pitch, psi: sp.Integer(0)}, point=(x, y, z),
        margins=margins, lengthwise="axial",
    )  # fmt: skip


def _region(tooth):
    xi, _ = tooth.fillet.parameters
    margins = Margin("", "junction", xi, joins="flank"), Margin("", "bottom", tooth.bottom - xi)
    return Region(tooth.gear.name, "fillet", tooth.fillet, s, margins, "axial")


def _solid(tooth):
    gear, half = tooth.gear, face_width.symbol / 2
    begin = gear.roll_at(gear.form_radius.symbol)
    return solid(gear.name, {
        "module": (m, "mm"), "teeth": (gear.teeth.symbol, ""), "root_radius": (tooth.root_radius, "mm"),
        "face_first": (-half, "mm"), "face_last": (half, "mm"), "flank_root": (begin, "rad"),
        "tip_first": (begin, "rad"), "tip_last": (gear.roll_at(gear.tip_radius.symbol + m / 4), "rad"),
        "fillet_junction": (0, "rad"), "fillet_land": (tooth.bottom, "rad"),
    })  # fmt: skip


def _start(teeth, phi_1, ratio, error, definitions):
    """The aligned pair touches on the common normal through the pitch point, which it reaches half a tooth later."""
    turned = phi_1 + s * sp.pi / (2 * PINION.teeth.symbol)
    outputs = {error: sp.Integer(0)}
    for tooth, sense, turn in zip(teeth, (1, -1), (turned, ratio * turned), strict=True):
        roll, psi = tooth.flank.parameters
        share = tooth.gear.cos_base_helix**2
        outputs |= {roll: tooth.gear.roll_at_pitch + s * sense * share * turn, psi: sense * (share - 1) * turn}
    return System("start", definitions, (), (), outputs)


def _guards(gear):
    where = (gear.form_radius.place, module.key, gear.teeth.key)
    return (
        Guard(gear.form_radius.symbol - gear.base_radius,
              f"the involute of the {gear.name} begins inside its base circle", where),
        Guard(gear.tip_radius.symbol - gear.form_radius.symbol,
              f"the {gear.name} ends below the start of its involute", (gear.tip_radius.place, *where)),
    )  # fmt: skip


def crossed_helicoids():
    """The pair of gears."""
    definitions = Definitions()
    phi_1 = rotation_angle("phi_pinion", "angle of the pinion in mesh", "f")
    error = rotation_angle("transmission_error", "wheel angle less ratio times pinion angle", "f")
    ratio = definitions.let("ratio", PINION.teeth.symbol / WHEEL.teeth.symbol, "T1/T2")
    phi_2 = ratio * phi_1 + error
    teeth = _tooth(PINION, definitions), _tooth(WHEEL, definitions)
    mounting = translation(x=distance.symbol + error_distance.symbol)
    mounting = mounting @ Rx(-(shaft_angle.symbol + error_angle.symbol))
    pinion = _body(teeth[0], Rz(phi_1))
    wheel = _body(teeth[1], mounting @ Rz(sp.pi - phi_2 - s * sp.pi / WHEEL.teeth.symbol))
    rules = [
        Rule(shaft_angle.symbol, PINION.helix_angle.symbol + WHEEL.helix_angle.symbol),
        Rule(distance.symbol, PINION.pitch_radius + WHEEL.pitch_radius),
        Rule(rounding.symbol, sp.Rational(38, 100) * m),
    ]
    for gear in (PINION, WHEEL):
        rules.append(Rule(gear.tip_radius.symbol, gear.pitch_radius + m))
        rules.append(Rule(gear.form_radius.symbol, gear.pitch_radius - sp.Rational(9, 10) * m))
    return Drive(
        name="crossed_helicoids",
        family="crossed-helicoids",
        title="Involute helicoids on crossed axes",
        parameters=(
            flank, module, pressure_angle, *PINION.parameters, *WHEEL.parameters, face_width, rounding, distance,
            shaft_angle, error_distance, error_angle, separation,
        ),
        rules=tuple(rules),
        guards=(*_guards(PINION), *_guards(WHEEL)),
        sizes=(("ratio", PINION.teeth.symbol / WHEEL.teeth.symbol, "wheel turns per pinion turn"),),
        instant=phi_1,
        error=error,
        pinion=pinion,
        wheel=wheel,
        regions=tuple(_region(tooth) for tooth in teeth),
        unknowns=tuple(Unknown(q) for tooth in teeth for q in tooth.flank.parameters) + (Unknown(error),),
        residual=contact(pinion.placed, wheel.placed),
        definitions=definitions,
        start=_start(teeth, phi_1, ratio, error, definitions),
        guess={},
        sample={
            "flank": 1, "normal_module_mm": 2, "pressure_angle_deg": 20, "pinion_teeth": 20, "wheel_teeth": 30,
            "pinion_helix_angle_deg": 50, "wheel_helix_angle_deg": 35, "face_width_mm": 20,
        },
        sample_angle=0.02,
        pinion_teeth=PINION.teeth.key,
        handed="right",
        loading=Loading(pairs=3, torque_on="pinion"),
        functions=(_solid(teeth[0]), _solid(teeth[1])),
        sources=(Source("F. L. Litvin, A. Fuentes", "Gear Geometry and Applied Theory", 2004, "chapter 16"),),
    )  # fmt: skip


def catalogue():
    """The one drive of this file."""
    return {"crossed_helicoids": crossed_helicoids}
