"""A drive outside the tree: a crowned helical pinion in an internal gear, with involute flanks on parallel axes.

Frames: ``f`` fixed, z along the pinion's axis, x through the pitch point; the internal gear's axis passes through
(−a, 0, 0). Both turn about +z, the pinion by φ1, the gear by φ2. A tooth of the pinion and a space of the gear are
centred on x in their body frames. Right hand; the gear's spaces are the teeth of an external gear of the same hand.
"""

from dataclasses import dataclass

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import Rx, Ry, Rz, translation
from derive.language.contact import contact
from derive.language.definitions import Definitions
from derive.language.drive import Body, Drive, Loading, Margin, Region, Role, Source, System, body_point
from derive.language.functions import solid
from derive.language.outline import Outline, Suggestion, z_1, z_2
from derive.language.outline import m as given_module
from derive.language.surface import Surface, swept
from derive.language.symbols import Guard, Parameter, Quantity, Rule, Table, Unknown, parameter, rotation_angle

POSITIVE, ACUTE = (0, sp.oo), (0, sp.pi / 2)

flank = parameter("flank", "s", "flank", table=Table.FLANK, choices=(("left", 1), ("right", -1)), default=1)
module = parameter("normal_module_mm", "m", "normal module", domain=POSITIVE, required=True)
pressure_angle = parameter("pressure_angle_deg", "alpha", "normal pressure angle", domain=ACUTE, required=True)
helix_angle = parameter("helix_angle_deg", "beta", "helix angle of both members, right hand", domain=ACUTE,
                        lower_included=True, default=0)  # fmt: skip
face_width = parameter("face_width_mm", "F", "face width of both members", domain=POSITIVE, required=True)
crowning = parameter("pinion_lead_crowning_um", "C", "lead crowning of the pinion in the transverse plane", default=0)
rounding = parameter("root_rounding_mm", "rho", "radius of both root fillets in the transverse plane", domain=POSITIVE)
distance = parameter("center_distance_mm", "a", "centre distance", domain=POSITIVE)
error_distance = parameter("center_distance_mm", "da", "centre distance error, gear away from the pitch point",
                           table=Table.MISALIGNMENT, default=0)  # fmt: skip
error_out = parameter("out_of_plane_deg", "dx", "tilt of the gear about x", table=Table.MISALIGNMENT, default=0)
error_in = parameter("in_plane_deg", "dy", "tilt of the gear about y", table=Table.MISALIGNMENT, default=0)
separation = parameter("separation_mm", "delta", "separation for contact ellipses", table=Table.CONTACT,
                       domain=POSITIVE, default=sp.Rational(632, 100000))  # fmt: skip

s, m, alpha, beta, F, a = (q.symbol for q in (flank, module, pressure_angle, helix_angle, face_width, distance))


@dataclass(frozen=True)
class Member:
    """The keys of one member; ``inside`` is −1 for the internal gear, +1 for the pinion."""

    name: str
    inside: int
    teeth: Parameter
    tip_radius: Parameter
    form_radius: Parameter

    @classmethod
    def of(cls, name, inside):
        def own(key, symbol, meaning, **kind):
            return parameter(f"{name}_{key}", f"{symbol}_{name}", f"{meaning} of the {name}", domain=POSITIVE, **kind)

        return cls(
            name,
            inside,
            own("teeth", "T", "teeth", integer=True, required=True),
            own("tip_radius_mm", "r_a", "tip radius", table=Table.BLANK),
            own("form_radius_mm", "r_f", "radius where involute and fillet join", table=Table.BLANK),
        )

    @property
    def parameters(self):
        return self.teeth, self.tip_radius, self.form_radius

    @property
    def pitch_radius(self):
        return m * self.teeth.symbol / (2 * sp.cos(beta))

    @property
    def base_radius(self):
        return self.pitch_radius / v.root(1 + tangent**2)

    def roll_at(self, radius):
        """Roll angle of the involute at a radius."""
        return v.root(radius**2 - self.base_radius**2) / self.base_radius


PINION, WHEEL = Member.of("pinion", 1), Member.of("wheel", -1)
tangent = sp.tan(alpha) / sp.cos(beta)  # of the transverse pressure angle


@dataclass(frozen=True)
class Tooth:
    """Flank and fillet; ``bottom`` is the fillet's parameter where it meets the root circle."""

    member: Member
    flank: Surface
    fillet: Surface
    bottom: sp.Expr
    root_radius: sp.Expr


def _tooth(member, crown, definitions):
    name, side = member.name, member.inside
    radius = definitions.let(f"r_b_{name}", member.base_radius, "base radius", "mm")
    roll = Quantity(f"roll_{name}", "rad", f"roll angle of the {name}'s involute", name)
    z = Quantity(f"z_{name}", "mm", f"place across the face of the {name}", name)
    half = sp.pi / (2 * member.teeth.symbol) + tangent - v.arc(tangent, sp.Integer(1))
    half = definitions.let(f"half_{name}", half, "half tooth or space on the base circle", "rad")

    def traverse(z):
        trace = z * 2 * sp.sin(beta) / (m * member.teeth.symbol)
        return Rz(trace - s * crown / radius * (2 * z / F) ** 2) @ translation(z=z)

    def from_centre(x, y):
        return Rz(s * half).direction((x, -s * y, sp.Integer(0)))

    section = from_centre(
        radius * (sp.cos(roll) + roll * sp.sin(roll)), radius * (sp.sin(roll) - roll * sp.cos(roll))
    )
    surface = swept(definitions, section, traverse(z), along=roll, sweep=z, outward=-s * side)

    start = definitions.let(f"roll_f_{name}", member.roll_at(member.form_radius.symbol), "roll angle at the join")
    cosine, sine = sp.cos(start), sp.sin(start)
    normal, along, rho = (side * sine, -side * cosine), (-side * cosine, -side * sine), rounding.symbol
    centre = tuple(
        definitions.let(f"c_{axis}_{name}", value, "centre of the fillet", "mm")
        for axis, value in (
            ("x", radius * (cosine + start * sine) + rho * normal[0]),
            ("y", radius * (sine - start * cosine) + rho * normal[1]),
        )
    )
    xi = Quantity(f"xi_{name}", "rad", f"turn of the normal along the fillet of the {name}", name)
    z_f = Quantity(f"z_f_{name}", "mm", f"place across the face on the fillet of the {name}", name)
    arc = [c - rho * (sp.cos(xi) * n - sp.sin(xi) * e) for c, n, e in zip(centre, normal, along, strict=True)]
    fillet = swept(definitions, from_centre(*arc), traverse(z_f), along=xi, sweep=z_f, outward=s)
    # towards the root circle: −centre for the pinion, +centre for the gear
    root = tuple(-side * c for c in centre)
    bottom = v.arc(sum(p * e for p, e in zip(root, along, strict=True)),
                   -sum(p * n for p, n in zip(root, normal, strict=True)))  # fmt: skip
    bottom = definitions.let(f"xi_bottom_{name}", bottom, "end of the fillet", "rad")
    return Tooth(member, surface, fillet, bottom, v.radius(*centre) - side * rho)


def _body(tooth, motion):
    member, (roll, z) = tooth.member, tooth.flank.parameters
    x, y, height = body_point(member.name)
    margins = (
        Margin("off_tip", "tip", member.inside * (member.tip_radius.symbol - v.radius(x, y))),
        Margin("off_face", "face", F / 2 - sp.Abs(height)),
        Margin("off_root", "root", member.inside * (roll - member.roll_at(member.form_radius.symbol)),
               Role.JUNCTION, joins="fillet"),
    )  # fmt: skip
    return Body(
        member.name, tooth.flank, motion, {roll: tangent, z: sp.Integer(0)}, point=(x, y, height), margins=margins,
        lengthwise="axial",
    )  # fmt: skip


def _region(tooth):
    xi, _ = tooth.fillet.parameters
    margins = Margin("", "junction", xi, joins="flank"), Margin("", "bottom", tooth.bottom - xi)
    return Region(tooth.member.name, "fillet", tooth.fillet, s, margins, "axial")


def _solid(tooth):
    member, begin = tooth.member, tooth.member.roll_at(tooth.member.form_radius.symbol)
    return solid(member.name, {
        "module": (m, "mm"), "teeth": (member.teeth.symbol, ""), "root_radius": (tooth.root_radius, "mm"),
        "face_first": (-F / 2, "mm"), "face_last": (F / 2, "mm"), "flank_root": (begin, "rad"),
        "tip_first": (begin, "rad"),
        "tip_last": (member.roll_at(member.tip_radius.symbol + member.inside * m / 4), "rad"),
        "fillet_junction": (0, "rad"), "fillet_land": (tooth.bottom, "rad"),
    })  # fmt: skip


def _outline():
    """A first design: ISO 53 pressure angle, a face of ten modules, crowning enough for contact in a point."""
    return Outline(
        {"m": "normal module", "z": "teeth of the pinion : teeth of the internal gear"},
        {},
        (
            Suggestion("design.normal_module_mm", (given_module,)),
            Suggestion("design.pinion_teeth", (z_1,), whole=True),
            Suggestion("design.wheel_teeth", (z_2,), whole=True),
            Suggestion("design.pressure_angle_deg", (sp.Integer(20),), "ISO 53"),
            Suggestion("design.face_width_mm", (10 * given_module,), "ten modules"),
            Suggestion("design.pinion_lead_crowning_um", (sp.Integer(10),), "contact in a point"),
        ),
    )


def own_ring():
    """The pair."""
    definitions = Definitions()
    phi_1 = rotation_angle("phi_pinion", "angle of the pinion in mesh", "f")
    error = rotation_angle("transmission_error", "gear angle less ratio times pinion angle", "f")
    ratio = definitions.let("ratio", PINION.teeth.symbol / WHEEL.teeth.symbol, "T1/T2")
    phi_2 = ratio * phi_1 + error
    teeth = _tooth(PINION, crowning.symbol, definitions), _tooth(WHEEL, sp.Integer(0), definitions)
    mounting = translation(x=-a - error_distance.symbol) @ Rx(error_out.symbol) @ Ry(error_in.symbol)
    pinion, wheel = _body(teeth[0], Rz(phi_1)), _body(teeth[1], mounting @ Rz(phi_2))
    turned = phi_1 + s * sp.pi / (2 * PINION.teeth.symbol)
    (roll_1, z_1), (roll_2, z_2) = (tooth.flank.parameters for tooth in teeth)
    start = System("start", definitions, (), (), {
        roll_1: tangent + s * turned, z_1: sp.Integer(0), roll_2: tangent + s * ratio * turned, z_2: sp.Integer(0),
        error: sp.Integer(0),
    })  # fmt: skip
    rules = [Rule(a, WHEEL.pitch_radius - PINION.pitch_radius), Rule(rounding.symbol, sp.Rational(3, 10) * m)]
    for member in (PINION, WHEEL):
        rules.append(Rule(member.tip_radius.symbol, member.pitch_radius + member.inside * m))
        rules.append(Rule(member.form_radius.symbol, member.pitch_radius - member.inside * sp.Rational(9, 10) * m))
    return Drive(
        name="own_ring",
        family="own-ring",
        title="Crowned pinion in an internal gear",
        parameters=(
            flank, module, pressure_angle, helix_angle, *PINION.parameters, *WHEEL.parameters, face_width, crowning,
            rounding, distance, error_distance, error_out, error_in, separation,
        ),
        rules=tuple(rules),
        guards=(
            Guard(WHEEL.teeth.symbol - PINION.teeth.symbol, "the internal gear needs more teeth than its pinion",
                  (PINION.teeth.key, WHEEL.teeth.key)),
            Guard(PINION.form_radius.symbol - PINION.base_radius,
                  "the involute of the pinion begins inside its base circle", (PINION.form_radius.place,)),
            Guard(WHEEL.tip_radius.symbol - WHEEL.base_radius,
                  "the tip of the gear lies inside its base circle", (WHEEL.tip_radius.place, WHEEL.teeth.key)),
        ),
        sizes=(("ratio", PINION.teeth.symbol / WHEEL.teeth.symbol, "wheel turns per pinion turn"),),
        instant=phi_1,
        error=error,
        pinion=pinion,
        wheel=wheel,
        regions=tuple(_region(tooth) for tooth in teeth),
        unknowns=(Unknown(roll_1), Unknown(z_1, F / 3), Unknown(roll_2), Unknown(z_2, F / 3), Unknown(error)),
        residual=contact(pinion.placed, wheel.placed),
        definitions=definitions,
        start=start,
        guess={},
        sample={
            "flank": 1, "normal_module_mm": 2, "pressure_angle_deg": 20, "helix_angle_deg": 12, "pinion_teeth": 30,
            "wheel_teeth": 72, "face_width_mm": 20, "pinion_lead_crowning_um": 20,
        },
        sample_angle=0.02,
        pinion_teeth=PINION.teeth.key,
        handed="right",
        loading=Loading(pairs=3, torque_on="pinion"),
        functions=(_solid(teeth[0]), _solid(teeth[1])),
        outline=_outline,
        sources=(Source("ISO", "ISO 21771, Gears: Cylindrical involute gears and gear pairs", 2007),),
    )  # fmt: skip


def catalogue():
    """The one drive of this file."""
    return {"own_ring": own_ring}
