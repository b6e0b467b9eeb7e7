"""Cylindrical gears: spur, helical and crossed-helical involute pairs with profile shift and flank modifications.

Frames: ``f`` fixed, z along the pinion axis, x from pinion to wheel; the wheel axis is (0, sin Σ, cos Σ) through
(A, 0, 0). Body frames ``pinion`` and ``wheel``: the tooth is centred on x, z along the gear's own axis, middle of the
face at z = 0. The pinion turns by +φ1 about z and the wheel by +φ2 about minus its axis; right-hand helix angles are
positive. Words and modifications as in ISO 21771:2007.
"""

from dataclasses import dataclass

import sympy as sp

from derive.drives import cylindrical_gears_keys as k
from derive.drives import outlines
from derive.drives.cylindrical_gears_drawing import drawing
from derive.drives.cylindrical_gears_keys import PINION, WHEEL, Gear
from derive.drives.cylindrical_gears_rexs import EXCHANGE
from derive.drives.rack_generated import body, fillet_margins, rolled, solid_teeth, undercut
from derive.language import vectors as v
from derive.language.chain import Rx, Ry, Rz, placement, translation
from derive.language.choice import excess, is_zero, only_where_zero
from derive.language.contact import contact
from derive.language.definitions import Definitions
from derive.language.drive import DesignSystem, Drive, Loading, Margin, Region, Role, Source, System, body_point
from derive.language.functions import LeastTeeth
from derive.language.replace import replaced
from derive.language.surface import Surface
from derive.language.symbols import Guard, Quantity, Unknown, rotation_angle
from derive.tools.basic_rack import BasicRack, RackBody, Relief, basic_rack

s, m, alpha, Sigma, A = (q.symbol for q in (k.flank, k.module, k.pressure_angle, k.shaft_angle, k.center_distance))
dA, dh, dv, da = (
    q.symbol for q in (k.error_distance, k.error_horizontal, k.error_vertical, k.error_axial)
)
x_sum = PINION.profile_shift.symbol + WHEEL.profile_shift.symbol
half_turn = placement(v.scale(-1, v.I), v.scale(-1, v.J), v.K, (0, 0, 0))  # exact, as an angle of π is not
bases = PINION.base_radius + WHEEL.base_radius
parallel = is_zero(sp.sin(Sigma))

#: Parallel gears brought nearer than the sum of their base radii and this part of it are started as if they were there.
NEARER = sp.Rational(1, 10**6)


@dataclass(frozen=True)
class Tooth:
    """A generated tooth: flank and fillet, explicit in the parameters of their rack."""

    gear: Gear
    rack: BasicRack
    surface: Surface
    fillet: Surface
    generating_angle: sp.Expr

    @property
    def half_pitch(self):
        """From the middle of the tooth to where flanks meet on the reference circle at rest."""
        return s * sp.pi / (2 * self.gear.teeth.symbol)


def rack_cut(gear, definitions):
    """The flank that the rolling rack envelops: the gear turns by −φ while the rack moves by −r φ along y."""
    rack = basic_rack(_rack_body(gear, definitions), definitions)
    surface, phi = _rolled(rack.cutter, gear, f"phi_gen_{gear.name}")
    fillet, _ = _rolled(rack.rounding, gear, f"phi_fillet_{gear.name}")
    return Tooth(gear, rack, surface, fillet, phi)


def _rack_body(gear, definitions):
    name = gear.name

    def place(symbol, value, meaning):
        return definitions.let(f"{symbol}_{name}", value, f"place on the edge that cuts {meaning} of the {name}", "mm")

    tip, root = gear.tip_relief, gear.root_relief
    return RackBody(
        name=name,
        module=m,
        pressure_angle=alpha,
        helix_angle=gear.helix_angle.symbol,
        shift=gear.shift,
        dedendum=k.dedendum.symbol,
        rounding=k.rounding.symbol,
        flank=s,
        face_width=gear.face_width.symbol,
        start=definitions.let("l_F", k.EDGE_START, "start of the straight edge", "mm"),
        end=place("l_A", gear.edge_end, "the tip"),
        crowning=gear.profile_crowning.symbol,
        slope=gear.profile_slope.symbol,
        twist=gear.flank_twist.symbol,
        tip_relief=Relief(tip.amount.symbol, place("l_a", gear.edge_at(tip.radius.symbol), "the tip relief's begin")),
        root_relief=Relief(
            root.amount.symbol, place("l_f", gear.edge_at(root.radius.symbol), "the root relief's begin")
        ),
        relief_exponent=k.relief_exponent.symbol,
        lead_crowning=gear.lead_crowning.symbol,
        lead_slope=gear.lead_slope.symbol,
    )


def _rolled(cutter, gear, angle):
    return rolled(cutter, gear.name, gear.reference_radius, angle, "cylindrical_gears")


def cylindrical_gears():
    """The pair of gears."""
    definitions = Definitions()
    phi_1 = rotation_angle("phi_pinion", "angle of the pinion in mesh", "f")
    error = rotation_angle("transmission_error", "wheel angle less ratio times pinion angle", "f")
    ratio = definitions.let("ratio", PINION.teeth.symbol / WHEEL.teeth.symbol, "z1/z2")
    phi_2 = ratio * phi_1 + error

    teeth = pinion_tooth, wheel_tooth = rack_cut(PINION, definitions), rack_cut(WHEEL, definitions)
    mounting = translation(x=A + dA) @ Rx(-(Sigma + dh)) @ Ry(dv) @ translation(z=da)
    pinion = tooth_body(pinion_tooth, Rz(phi_1 - pinion_tooth.half_pitch))
    wheel = tooth_body(wheel_tooth, mounting @ half_turn @ Rz(-phi_2 - wheel_tooth.half_pitch))
    return Drive(
        name="cylindrical_gears",
        family="cylindrical-gears",
        title="Involute cylindrical gears on parallel or crossed axes",
        parameters=k.PARAMETERS,
        rules=k.RULES,
        systems=(_zero_backlash(),),
        guards=(*_pair_guards(), *(g for tooth in teeth for g in tooth_guards(tooth))),
        sizes=_sizes(teeth),
        instant=phi_1,
        error=error,
        ratio=ratio,
        wheel_angle=phi_2,
        pinion=pinion,
        wheel=wheel,
        regions=tuple(Region(t.gear.name, "fillet", t.fillet, s, fillet_margins(t, alpha), "axial") for t in teeth),
        unknowns=(*tooth_unknowns(pinion_tooth), *tooth_unknowns(wheel_tooth), Unknown(error)),
        residual=contact(pinion.placed, wheel.placed),
        definitions=definitions,
        start=_start(teeth, phi_1, phi_2, error, definitions),
        guess={},
        sample=SAMPLE,
        sample_angle=0.03,
        pinion_teeth=PINION.teeth.key,
        loading=Loading(pairs=3, torque_on="pinion"),
        exchange=EXCHANGE,
        functions=tuple(function for tooth in teeth for function in (*tooth_undercut(tooth), tooth_solid(tooth))),
        least_teeth={
            g.name: LeastTeeth(g.teeth.key, (g.tip_relief.radius.key, g.root_relief.radius.key))
            for g in (PINION, WHEEL)
        },
        outline=outlines.cylindrical,
        drawing=drawing(),
        sources=(
            Source("ISO", "ISO 21771, Gears: Cylindrical involute gears and gear pairs: Concepts and geometry", 2007),
            Source("F. L. Litvin, A. Fuentes", "Gear Geometry and Applied Theory", 2004, "chapters 13 to 16"),
        ),
    )


def tooth_undercut(tooth):
    """Undercut is sought from far beyond the start of the involute, on the other side of the axis, to the tip."""
    gear = tooth.gear
    start, end = k.EDGE_START, gear.edge_end
    ends = {"first": start - 2 * gear.reference_radius, "start": start, "middle": (start + end) / 2, "last": end}
    return undercut(tooth, tooth.rack.along, "rack", " from its datum line", ends)


def tooth_solid(tooth):
    """A modified flank meets the tip near the end of the edge, not far beyond it."""
    gear = tooth.gear
    root_radius = gear.reference_radius + gear.shift - k.dedendum.symbol
    return solid_teeth(gear, m, alpha, root_radius, (k.EDGE_START, gear.edge_end + m / 4))


def tooth_body(tooth, motion):
    rack = tooth.rack
    return body(tooth, motion, {rack.along: tooth.gear.edge_end, rack.axial: sp.Integer(0)}, _margins(tooth))


def tooth_unknowns(tooth):
    return Unknown(tooth.rack.along, m), Unknown(tooth.rack.axial, tooth.gear.face_width.symbol / 3)


def _margins(tooth):
    gear = tooth.gear
    x, y, z = body_point(gear.name)
    return (
        Margin("off_tip", "tip", gear.tip_radius.symbol - v.radius(x, y)),
        Margin("off_face", "face", gear.face_width.symbol / 2 - sp.Abs(z)),
        Margin("off_root", "root", tooth.rack.along - k.EDGE_START, Role.JUNCTION, joins="fillet"),
    )


# -- the unmodified pair: its common normal fixes centre distance, transmission error and the place of contact ---------


def _normal(cosine):
    """Components x, and y over the flank sign, of the common normal of two involute helicoids, and its length.

    Out of the pinion, it meets both axes at the angles of the base helices: n·k = −s sin β_b1, n·k2 = s sin β_b2. On
    parallel axes these are one equation, and the transverse working pressure angle decides, whose cosine is given.
    """
    sine, along = sp.sin(Sigma), WHEEL.sin_base_helix + PINION.sin_base_helix * sp.cos(Sigma)
    within = cosine * PINION.cos_base_helix
    n_y, length = along * sine + parallel * within, sine**2 + parallel
    return v.root((length * PINION.cos_base_helix) ** 2 - n_y**2), n_y, length


def _turns(n_x, n_y, length):
    """Angles of the common normal about either axis, over the flank sign."""
    in_wheel = n_y * sp.cos(Sigma) + length * PINION.sin_base_helix * sp.sin(Sigma)
    return v.arc(n_y, n_x), v.arc(in_wheel, n_x)


def _rolled_length(gear, turned):
    """Distance along the normal from the base cylinder, of a flank turned by ``turned`` against the normal."""
    return m * sp.cos(alpha) * gear.teeth.symbol / 2 * (turned + sp.pi / 2 + gear.involute)


def _zero_backlash():
    """Centre distance at which both flanks touch: what both rolled lengths and the profile shifts add up to."""
    root = Quantity("sqrt_alpha_w", "", "square root of the transverse working pressure angle, which is not negative")
    angle = root**2
    teeth = PINION.teeth.symbol + WHEEL.teeth.symbol
    normal = _normal(sp.cos(angle))
    lengths = (_rolled_length(gear, -turn) for gear, turn in zip((PINION, WHEEL), _turns(*normal), strict=True))
    return DesignSystem(
        name="zero_backlash",
        unknowns=(Unknown(root),),
        residual=(sp.tan(angle) - angle - PINION.involute - parallel * 2 * x_sum * sp.tan(alpha) / teeth,),
        guess={root: v.root(PINION.transverse_pressure_angle)},
        fills={A: (sp.Add(*lengths) + m * x_sum * sp.sin(alpha)) * normal[2] / normal[0]},
        message="with these profile shifts there is no centre distance without backlash",
        keys=(PINION.profile_shift.key, WHEEL.profile_shift.key, k.pressure_angle.key),
    )


def _start(teeth, phi_1, phi_2, error, definitions):
    """The contact of the unmodified, aligned pair; of its line on nearly parallel axes the middle of the face.

    Both flanks have a straight generator with the common normal. Where these cross is the contact; crowning draws it
    to the middle of the face. Along a line the place is that nearest to the middle at which the edge cuts.
    """

    def let(name, value, meaning, unit="mm"):
        return definitions.let(f"start_{name}", value, meaning, unit)

    distance = A + dA
    least = bases * (1 + NEARER)
    normal = _normal(bases / (least + excess(distance - least)))
    n = [let(f"n_{axis}", c / normal[2], "common normal", "") for axis, c in zip("xy", normal[:2], strict=True)]
    turns = [let(f"nu_{t.gear.name}", turn, "angle of the common normal", "rad")
             for t, turn in zip(teeth, _turns(*normal), strict=True)]  # fmt: skip
    lengths = [_rolled_length(gear, turned) for gear, turned in ((PINION, s * phi_1 - turns[0]), (WHEEL, -turns[1]))]
    cut = PINION.shift + WHEEL.shift
    wheel_turn = 2 * (sp.Add(*lengths) + cut * sp.sin(alpha) - distance * n[0]) / (
        m * sp.cos(alpha) * WHEEL.teeth.symbol
    )
    angle = let("phi", s * wheel_turn, "wheel angle", "rad")
    pinion, wheel = teeth
    generation = (
        s * (turns[0] - at_edge(PINION)) - phi_1 + pinion.half_pitch,
        s * (turns[1] - at_edge(WHEEL)) + angle + wheel.half_pitch,
    )
    z_1, z_2 = _crossing(n, lengths[0] + PINION.shift * sp.sin(alpha), distance, onto_edge(pinion, generation[0]), let)
    return System(
        name="start",
        definitions=definitions,
        unknowns=(),
        residual=(),
        outputs={
            pinion.rack.along: edge_place(pinion, generation[0], z_1),
            pinion.rack.axial: z_1,
            wheel.rack.along: edge_place(wheel, generation[1], z_2),
            wheel.rack.axial: z_2,
            error: angle - replaced(phi_2, {error: sp.Integer(0)}),
        },
    )


def at_edge(gear):
    """Angle of the rack's normal in the transverse section."""
    return v.arc(sp.Integer(1), gear.tan_transverse)


def _crossing(n, length, distance, at_line, let):
    """Axial positions, in either gear, at which the two straight generators with the common normal cross.

    The sine of their angle vanishes on parallel axes. Crowning adds its curvature to what holds them together there.
    """
    n_x, n_y = n
    sine_1, sine_2 = PINION.sin_base_helix, WHEEL.sin_base_helix
    cosine_1, cosine_2 = PINION.cos_base_helix, WHEEL.cos_base_helix
    n_z = -s * sine_1
    together = sp.cos(Sigma) + sine_1 * sine_2
    slope = let("slope", n_x * sp.sin(Sigma) / (cosine_2 * cosine_1**2), "parting of the generators", "")
    lever = distance * (n_y * sp.cos(Sigma) + sine_1 * sp.sin(Sigma)) / cosine_2
    base = WHEEL.base_radius + PINION.base_radius * together / (cosine_1 * cosine_2)
    parted = let("parted", s * (lever - base) + slope * length * n_z, "distance of the generators at mid face")
    crowning = sp.Add(*(8 * g.lead_crowning.symbol / g.face_width.symbol**2 for g in (PINION, WHEEL)))
    held = slope**2 + parallel + excess(crowning) * distance * n_x
    z_1 = let("z_pinion", parted * slope / held + parallel * at_line, "place across the face of the pinion")
    z_2 = let(
        "z_wheel",
        length * s * sine_2
        - s * PINION.base_radius * n_x * sp.sin(Sigma) / cosine_1
        + (z_1 - length * n_z) * together / cosine_1**2,
        "place across the face of the wheel",
    )
    return z_1, z_2


def onto_edge(tooth, generation):
    """The place across the face nearest to its middle that the edge cuts at this turn in generation, spur gears: 0."""
    middle = edge_place(tooth, generation, sp.Integer(0))
    slope = edge_place(tooth, generation, sp.Integer(1)) - middle
    beyond = excess(k.EDGE_START - middle) - excess(middle - tooth.gear.edge_end)
    return beyond * slope / (slope**2 + is_zero(slope))


def edge_place(tooth, generation, axial):
    """The place on the straight edge that cuts at this turn in generation: its equation of meshing, linear in it."""
    gear, cosine = tooth.gear, sp.cos(tooth.gear.helix_angle.symbol)
    cotangent = sp.cos(alpha) * cosine / sp.sin(alpha)
    rolled = axial * sp.tan(gear.helix_angle.symbol) - gear.reference_radius * generation
    return (sp.pi * m / (4 * cosine) + s * rolled - gear.shift * cotangent) / (
        sp.sin(alpha) / cosine + sp.cos(alpha) * cotangent
    )


# -- limits of the design, sizes ---------------------------------------------------------------------------------------


def _pair_guards():
    helix = (PINION.helix_angle.key, WHEEL.helix_angle.key, k.shaft_angle.key)
    unlike = 1 - is_zero(PINION.helix_angle.symbol + WHEEL.helix_angle.symbol)
    along = WHEEL.sin_base_helix + PINION.sin_base_helix * sp.cos(Sigma)
    square = sp.sin(Sigma) ** 2
    return (
        Guard(
            sp.Rational(1, 2) - parallel * unlike,
            "parallel axes need equal helix angles of opposite hand",
            helix,
        ),
        Guard(
            parallel + square * PINION.cos_base_helix**2 - along**2,
            "no common normal: the helix angles differ too much from the shaft angle",
            (*helix, k.pressure_angle.key),
        ),
        *rack_guards(),
    )


def rack_guards():
    """What the basic rack must be."""
    return (
        Guard(
            k.full_rounding(),
            "the basic rack is so deep that it ends in a point",
            (k.dedendum.key, k.pressure_angle.key, k.module.key),
        ),
        Guard(
            k.full_rounding() - k.rounding.symbol + m / 10**9,
            "the tip of the basic rack is not wide enough for its rounding: at most that of a fully round tip",
            (k.rounding.key, k.dedendum.key, k.pressure_angle.key),
        ),
        Guard(
            k.dedendum.symbol - k.rounding.symbol * (1 - sp.sin(alpha)),
            "the rounding of the basic rack is higher than its dedendum",
            (k.rounding.key, k.dedendum.key),
        ),
    )


def tooth_guards(tooth):
    gear, name = tooth.gear, tooth.gear.name
    r_a = gear.tip_radius
    teeth = (gear.teeth.key, gear.profile_shift.key, k.module.key)
    tip, root = gear.tip_relief, gear.root_relief
    return (
        Guard(r_a.symbol - gear.base_radius, f"the tip of the {name} lies inside its base circle", (r_a.key, *teeth)),
        Guard(gear.pointed, f"the teeth of the {name} end in a point below the tip", (r_a.key, *teeth)),
        Guard(gear.edge_end - k.EDGE_START, f"the {name} ends below the start of its involute", (r_a.key, *teeth)),
        Guard(
            gear.edge_end - gear.edge_at(tip.radius.symbol),
            f"the tip relief of the {name} needs a radius at which it begins, below the tip",
            (tip.radius.key, tip.amount.key),
        ),
        Guard(
            gear.edge_at(root.radius.symbol) - k.EDGE_START,
            f"the root relief of the {name} needs a radius at which it begins, above the start of the involute",
            (root.radius.key, root.amount.key),
        ),
    )


def _sizes(teeth):
    parallel_angle = only_where_zero(sp.sin(Sigma), sp.acos(bases / A))
    n_x, _, length = _normal(bases / A)
    sizes = [
        ("normal_working_pressure_angle_deg", sp.asin(n_x / length),
         "complement of the angle between common normal and common perpendicular"),
        ("transverse_working_pressure_angle_deg", parallel_angle, "transverse working pressure angle, parallel axes"),
    ]
    sizes += [size for tooth in teeth for size in tooth_sizes(tooth)]
    meaning = "wheel turns per pinion turn z1/z2, the inverse of the gear ratio"
    return (*sizes, ("ratio", PINION.teeth.symbol / WHEEL.teeth.symbol, meaning))


def tooth_sizes(tooth):
    """The sizes of one member."""
    gear, name, beta = tooth.gear, tooth.gear.name, tooth.gear.helix_angle.symbol
    return (
        (f"{name}_transverse_pressure_angle_deg", gear.transverse_pressure_angle,
         f"transverse pressure angle of the {name}"),
        (f"{name}_base_helix_angle_deg", sp.asin(gear.sin_base_helix), f"base helix angle of the {name}"),
        (f"{name}_reference_radius_mm", gear.reference_radius, f"reference radius of the {name}"),
        (f"{name}_base_radius_mm", gear.base_radius, f"base radius of the {name}"),
        (f"{name}_limit_radius_mm", v.radius(gear.base_radius, gear.rolling_radius(k.EDGE_START)),
         f"start of the involute of the {name}, without undercut"),
        (f"{name}_root_radius_mm", gear.reference_radius + gear.shift - k.dedendum.symbol,
         f"root radius of the {name}"),
        (f"{name}_overlap_ratio", gear.face_width.symbol * sp.Abs(sp.sin(beta)) / (sp.pi * m),
         f"overlap ratio of the {name}'s face"),
        (f"{name}_least_teeth_without_undercut", _least_teeth(gear), f"least teeth without undercut, {name}"),
        (f"{name}_edge_start_mm", k.EDGE_START, f"edge of the rack at the root of the {name}"),
        (f"{name}_edge_end_mm", gear.edge_end, f"edge of the rack at the tip of the {name}"),
    )  # fmt: skip


def _least_teeth(gear):
    """Number of teeth, not rounded, below which the edge cuts into the involute."""
    height = -k.EDGE_START * sp.cos(alpha) - gear.shift
    return 2 * height * sp.cos(gear.helix_angle.symbol) * gear.cos_base_helix**2 / (m * sp.sin(alpha) ** 2)


def catalogue():
    """The one drive of the family: name → builder."""
    return {"cylindrical_gears": cylindrical_gears}


#: A regular design and angle: here pivots are chosen and self-tests are made.
SAMPLE = {
    "flank": 1, "normal_module_mm": 2, "pressure_angle_deg": 20, "pinion_teeth": 17, "wheel_teeth": 23,
    "pinion_helix_angle_deg": 20, "wheel_helix_angle_deg": 10, "face_width_mm": 20,
    "pinion_lead_crowning_um": 20, "pinion_profile_crowning_um": 10,
}  # fmt: skip
