"""Internal gear pairs: a ring gear that a pinion cutter shapes, and a pinion cut by a rack that may be modified.

Frames: ``f`` fixed, z along the pinion's axis, x through the pitch point; the axis of the ring gear passes through
(−a, 0, 0). Both turn about +z, the pinion by φ1, the ring gear by φ2. Body frames ``pinion`` and ``wheel``: a tooth of
the pinion and a space of the ring gear are centred on x, z along the gear's own axis, middle of the face at z = 0. Both
members have one helix angle, right hand positive. Words as in ISO 21771:2007, where the ring gear has a negative number
of teeth.
"""

from dataclasses import dataclass

import sympy as sp

from derive.drives import cylindrical_gears as rack
from derive.drives import cylindrical_gears_keys as k
from derive.drives import outlines
from derive.drives.cylindrical_gears_keys import PINION
from derive.drives.internal_gears_drawing import drawing
from derive.drives.internal_gears_keys import CUTTER, PARAMETERS, RING, RULES, shaping_distance
from derive.drives.rack_generated import fillet_margins
from derive.language import vectors as v
from derive.language.chain import Rx, Ry, Rz, translation
from derive.language.choice import excess
from derive.language.contact import contact
from derive.language.definitions import Definitions
from derive.language.drive import Body, DesignSystem, Drive, Loading, Margin, Region, Role, Source, System, body_point
from derive.language.envelope import envelope, explicit_turn
from derive.language.functions import LeastTeeth, solid
from derive.language.replace import replaced
from derive.language.surface import Surface, swept
from derive.language.symbols import Guard, Quantity, Unknown, rotation_angle

s, m, alpha, a = (q.symbol for q in (k.flank, k.module, k.pressure_angle, k.center_distance))
dA, dh, dv, da = (q.symbol for q in (k.error_distance, k.error_horizontal, k.error_vertical, k.error_axial))
twist = sp.tan(PINION.helix_angle.symbol) / RING.reference_radius
bases = RING.base_radius - PINION.base_radius

#: Members nearer than the difference of their base radii and this part of it are started as if they were there.
NEARER = sp.Rational(1, 10**6)

#: Involute functions that differ by less are of one angle: that of a distance given to a micrometre.
ALIKE = sp.Rational(1, 10**5)


@dataclass(frozen=True)
class Space:
    """A space of the ring gear: flank and fillet in the places on its profile and across the face."""

    surface: Surface
    fillet: Surface
    start: sp.Expr
    bottom: sp.Expr

    @property
    def rolling(self):
        return self.surface.parameters[0]

    @property
    def axial(self):
        return self.surface.parameters[1]


def _space(definitions):
    """The involute helicoid that the cutter's flank leaves, and the envelope of the rounding of its tip."""

    def let(name, value, meaning, unit="mm"):
        return definitions.let(name, value, meaning, unit)

    rolling = Quantity("rho_wheel", "mm", "rolling length of the ring gear's involute from the base circle", "wheel")
    axial = Quantity("z_wheel", "mm", "position across the face of the wheel", "wheel")
    base = let("r_b_wheel", RING.base_radius, "base radius of the ring gear")
    half = let("psi_wheel", RING.half_space, "half angle of the space on the base circle", "rad")
    theta = let("theta_wheel", s * (half - rolling / base), "turn of the tangent to the base circle", "rad")
    section = Rz(theta).direction((base, s * rolling, sp.Integer(0)))
    surface = swept(
        definitions, section, Rz(twist * axial) @ translation(z=axial), along=rolling, sweep=axial, outward=s
    )
    surface = surface.on("internal_gears/section", "internal_gears/roll")
    start = let("rho_F_wheel", RING.root_rolling, "rolling length at the fillet")
    bottom = let("xi_bottom", v.arc(CUTTER.base_radius, CUTTER.within), "turn of the normal from flank to root", "rad")
    return Space(surface, _fillet(definitions, let), start, bottom)


def _fillet(definitions, let):
    """The rounding of the cutter's tip rolls on the ring gear.

    Its section is in the frame of the tangent to the base circle along which the involute passes into the rounding:
    there the normal turns from s·y to the radius. Across the face all sections are cut alike, turned along the helix:
    the turn of the cutter is that of the section.
    """
    turn = Quantity("xi_wheel", "rad", "turn of the normal along the rounding of the cutter", "wheel")
    axial = Quantity("z_f_wheel", "mm", "position across the face on the fillet of the wheel", "wheel")
    phi = rotation_angle("phi_shaper", "turn of the cutter's section from the line of centres", "gen")
    rounding = CUTTER.rounding.symbol
    base = let("r_b_shaper", CUTTER.base_radius, "base radius of the cutter")
    within = let("rho_c_shaper", CUTTER.within, "distance of the rounding's centre along the normal of the involute")
    middle = let("nu_shaper", s * (CUTTER.half_thickness - CUTTER.edge_end / base),
                 "angle from the middle of the tooth to the section's frame", "rad")  # fmt: skip
    along = twist / CUTTER.ratio * axial
    normal = (sp.sin(turn), s * sp.cos(turn), sp.Integer(0))
    centre = (base, s * within, sp.Integer(0))
    cutter = swept(
        definitions, v.add(centre, v.scale(rounding, normal)), Rz(along) @ translation(z=axial), along=turn,
        sweep=axial, outward=-s, slope=(sp.cos(turn), -s * sp.sin(turn), sp.Integer(0)),
    ).with_pole(centre)  # fmt: skip
    turned = phi - along
    roll = Rz(-CUTTER.ratio * (turned - middle)) @ translation(x=shaping_distance.symbol) @ Rz(turned)
    return explicit_turn(envelope(cutter, roll, phi), phi, 1)


def _ring_body(space, motion):
    x, y, z = body_point("wheel")
    margins = (
        Margin("off_tip", "tip", v.radius(x, y) - RING.tip_radius.symbol),
        Margin("off_face", "face", RING.face_width.symbol / 2 - sp.Abs(z)),
        Margin("off_root", "root", space.start - space.rolling, Role.JUNCTION, joins="fillet"),
        Margin("off_tool", "tool_end", space.rolling - CUTTER.rolled),
    )
    reference = {space.rolling: RING.reference_radius * PINION.sin_transverse, space.axial: sp.Integer(0)}
    return Body("wheel", space.surface, motion, reference, point=(x, y, z), margins=margins, lengthwise="axial")


def _ring_solid(space):
    half = RING.face_width.symbol / 2
    return solid("wheel", {
        "module": (m, "mm"), "teeth": (RING.number, ""), "root_radius": (RING.root_radius, "mm"),
        "face_first": (-half, "mm"), "face_last": (half, "mm"), "flank_root": (space.start, "mm"),
        "tip_first": (space.start, "mm"), "tip_last": (RING.tip_rolling * sp.Rational(3, 4), "mm"),
        "fillet_junction": (0, "rad"), "fillet_land": (space.bottom, "rad"),
    })  # fmt: skip


def internal_gears():
    """The pair."""
    definitions = Definitions()
    phi_1 = rotation_angle("phi_pinion", "angle of the pinion in mesh", "f")
    error = rotation_angle("transmission_error", "wheel angle less ratio times pinion angle", "f")
    ratio = definitions.let("ratio", PINION.teeth.symbol / RING.number, "z1/|z2|")
    phi_2 = ratio * phi_1 + error
    tooth, space = rack.rack_cut(PINION, definitions), _space(definitions)
    half_pitch = s * sp.pi / (2 * RING.number)
    mounting = translation(x=-a - dA) @ Rx(-dh) @ Ry(dv) @ translation(z=da)
    pinion = rack.tooth_body(tooth, Rz(phi_1 - tooth.half_pitch))
    wheel = _ring_body(space, mounting @ Rz(phi_2 - half_pitch))
    fillets = (
        Region("pinion", "fillet", tooth.fillet, s, fillet_margins(tooth, alpha), "axial"),
        Region("wheel", "fillet", space.fillet, s, _fillet_margins(space), "axial"),
    )
    return Drive(
        name="internal_gears",
        family="internal-gears",
        title="Involute pinion in a ring gear shaped by a pinion cutter",
        parameters=PARAMETERS,
        rules=RULES,
        systems=(
            _tight("zero_backlash", RING.number - PINION.teeth.symbol,
                   PINION.profile_shift.symbol + RING.profile_shift.symbol, a, bases,
                   (RING.teeth.key, PINION.teeth.key, PINION.profile_shift.key, RING.profile_shift.key)),
            _tight("full_depth", RING.number - CUTTER.teeth.symbol, CUTTER.profile_shift.symbol + RING.shift,
                   shaping_distance.symbol, RING.base_radius - CUTTER.base_radius,
                   (CUTTER.teeth.key, RING.teeth.key, CUTTER.profile_shift.key, RING.profile_shift.key)),
        ),
        guards=(*_guards(), *rack.rack_guards(), *rack.tooth_guards(tooth)),
        sizes=_sizes(tooth),
        instant=phi_1,
        error=error,
        ratio=ratio,
        wheel_angle=phi_2,
        pinion=pinion,
        wheel=wheel,
        regions=fillets,
        unknowns=(
            *rack.tooth_unknowns(tooth), Unknown(space.rolling, m), Unknown(space.axial, RING.face_width.symbol / 3),
            Unknown(error),
        ),
        residual=contact(pinion.placed, wheel.placed),
        definitions=definitions,
        start=_start(tooth, space, phi_1, phi_2, error, definitions),
        guess={},
        sample=SAMPLE,
        sample_angle=0.03,
        pinion_teeth=PINION.teeth.key,
        loading=Loading(pairs=3, torque_on="pinion"),
        functions=(*rack.tooth_undercut(tooth), rack.tooth_solid(tooth), _ring_solid(space)),
        least_teeth={
            "pinion": LeastTeeth(PINION.teeth.key, (PINION.tip_relief.radius.key, PINION.root_relief.radius.key)),
        },
        outline=outlines.internal,
        drawing=drawing(),
        sources=(
            Source("ISO", "ISO 21771, Gears: Cylindrical involute gears and gear pairs: Concepts and geometry", 2007),
            Source("F. L. Litvin, A. Fuentes", "Gear Geometry and Applied Theory", 2004, "chapters 13 to 16"),
        ),
    )  # fmt: skip


def _fillet_margins(space):
    turn = space.fillet.parameters[0]
    return Margin("", "junction", turn, joins="flank"), Margin("", "bottom", space.bottom - turn)


def _tight(name, teeth, shifts, distance, apart, keys):
    """The distance at which ring gear and external gear touch on both flanks: their difference of ``teeth``, the sum of
    their profile ``shifts``, how far their base circles are ``apart``.
    """
    root = Quantity(f"sqrt_{name}", "", "square root of the transverse working pressure angle, which is not negative")
    angle = root**2
    return DesignSystem(
        name=name,
        unknowns=(Unknown(root),),
        residual=(sp.tan(angle) - angle - PINION.involute + 2 * shifts * sp.tan(alpha) / teeth,),
        guess={root: v.root(PINION.transverse_pressure_angle)},
        fills={distance: apart / sp.cos(angle)},
        message="with these numbers of teeth and profile shifts there is no distance of the axes without backlash",
        keys=keys,
    )


def _start(tooth, space, phi_1, phi_2, error, definitions):
    """The contact of the unmodified, aligned pair: of its line the place nearest to the middle of the face at which the
    edge cuts.
    """

    def let(name, value, meaning, unit="rad"):
        return definitions.let(f"start_{name}", value, meaning, unit)

    distance, least = a + dA, bases * (1 + NEARER)
    apart = let("distance", least + excess(distance - least), "distance of the axes", "mm")
    beyond = v.root(apart**2 - bases**2)
    working = let("alpha_w", v.arc(beyond, bases), "transverse working pressure angle")
    generation = s * (PINION.transverse_pressure_angle - working) - phi_1 + tooth.half_pitch
    z = let("z", rack.onto_edge(tooth, generation), "place across the face", "mm")
    thickness = PINION.involute + 2 * PINION.shift * sp.tan(alpha) / (m * PINION.teeth.symbol)
    along = z * sp.tan(PINION.helix_angle.symbol) / PINION.reference_radius
    first = PINION.base_radius * (working + thickness + s * (phi_1 + along))
    rolling = let("rho", first + beyond, "rolling length of the ring gear", "mm")
    turn = s * (rolling / RING.base_radius - RING.half_space - working) - twist * z + s * sp.pi / (2 * RING.number)
    return System(
        name="start",
        definitions=definitions,
        unknowns=(),
        residual=(),
        outputs={
            tooth.rack.along: rack.edge_place(tooth, generation, z),
            tooth.rack.axial: z,
            space.rolling: rolling,
            space.axial: z,
            error: turn - replaced(phi_2, {error: sp.Integer(0)}),
        },
    )


def _at_full_depth():
    """By how much the involute function of the angle of generation is off, at the distance of the cutter."""
    angle = sp.atan(CUTTER.rolled / (RING.base_radius - CUTTER.base_radius))
    shifts, teeth = CUTTER.profile_shift.symbol + RING.shift, RING.number - CUTTER.teeth.symbol
    return sp.tan(angle) - angle - PINION.involute + 2 * shifts * sp.tan(alpha) / teeth


def _guards():
    z_1, z_2, z_0 = PINION.teeth.key, RING.teeth.key, CUTTER.teeth.key
    r_a, r_a0 = RING.tip_radius, CUTTER.tip_radius
    cutter = (r_a0.key, z_0, CUTTER.profile_shift.key)
    ring = (r_a.key, z_2, RING.profile_shift.key)
    return (
        Guard(RING.number - PINION.teeth.symbol, "the ring gear needs more teeth than the pinion", (z_2, z_1)),
        Guard(RING.number - CUTTER.teeth.symbol, "the ring gear needs more teeth than its cutter", (z_2, z_0)),
        Guard(ALIKE - sp.Abs(_at_full_depth()), "the distance of the axes while shaping follows from the numbers of "
              "teeth and profile shifts of ring gear and cutter: leave it out", (shaping_distance.key, z_0, z_2)),
        Guard(r_a.symbol - RING.base_radius, "the tip of the ring gear lies inside its base circle", ring),
        Guard(RING.pointed, "the teeth of the ring gear end in a point before the tip", ring),
        Guard(r_a0.symbol - CUTTER.rounding.symbol - CUTTER.base_radius,
              "the tip of the cutter lies inside its base circle", cutter),
        Guard(CUTTER.pointed, "the teeth of the cutter end in a point below the tip", cutter),
        Guard(CUTTER.centre_angle, "the tip of the cutter is not wide enough for its rounding",
              (CUTTER.rounding.key, *cutter)),
        Guard(RING.root_rolling - RING.tip_rolling, "the ring gear has no involute between its tip and its fillet",
              (*ring, CUTTER.rounding.key, r_a0.key)),
    )  # fmt: skip


def _sizes(tooth):
    return (
        ("transverse_working_pressure_angle_deg", sp.acos(bases / a), "transverse working pressure angle"),
        *rack.tooth_sizes(tooth),
        ("wheel_transverse_pressure_angle_deg", PINION.transverse_pressure_angle,
         "transverse pressure angle of the ring gear"),
        ("wheel_base_helix_angle_deg", sp.asin(PINION.sin_base_helix), "base helix angle of the ring gear"),
        ("wheel_reference_radius_mm", RING.reference_radius, "reference radius of the ring gear"),
        ("wheel_base_radius_mm", RING.base_radius, "base radius of the ring gear"),
        ("wheel_limit_radius_mm", v.radius(RING.base_radius, RING.root_rolling),
         "start of the involute of the ring gear"),
        ("wheel_root_radius_mm", RING.root_radius, "root radius of the ring gear"),
        ("ratio", PINION.teeth.symbol / RING.number,
         "wheel turns per pinion turn z1/|z2|, the inverse of the gear ratio"),
    )  # fmt: skip


def catalogue():
    """The one drive of the family: name → builder."""
    return {"internal_gears": internal_gears}


#: A regular design and angle: here pivots are chosen and self-tests are made.
SAMPLE = {
    "flank": 1, "normal_module_mm": 2, "pressure_angle_deg": 20, "pinion_teeth": 22, "wheel_teeth": -70,
    "pinion_helix_angle_deg": 12, "face_width_mm": 20, "pinion_lead_crowning_um": 20, "pinion_profile_crowning_um": 10,
}  # fmt: skip
