"""Spiral bevel and hypoid gears, face-milled: generated on a cradle, or the gear copied from its cutter (Formate).

Frames: ``f`` fixed, z along the gear's axis to its back, y the common perpendicular; the pinion's axis is
(sin Σ, 0, cos Σ) through (0, E, 0). ``gen`` is the machine: z along the cradle's axis to the blank, x along the machine
plane to the tooth being cut. Body frames: z along the axis to the back, x to the tooth being cut at rest, origin the
design crossing point. The pinion turns by +φ1 about minus its axis and drives the gear by +φ2 about z. Left-hand
pinion: the right-hand drive is its mirror image. The cradle-type generator is that of the field (F. L. Litvin and
A. Fuentes, "Gear Geometry and Applied Theory", 2004, chapters 21 and 22), with frames of its own.
"""

from dataclasses import dataclass
from functools import partial

import sympy as sp

from derive.drives import bevel_keys as k
from derive.drives import outlines
from derive.drives.bevel_keys import GEAR, PINION, Settings
from derive.drives.bevel_rexs import EXCHANGE
from derive.language import vectors as v
from derive.language.chain import Ry, Rz, translation
from derive.language.contact import contact
from derive.language.definitions import Definitions
from derive.language.drive import (
    PATH,
    Body,
    DesignSystem,
    Drive,
    Loading,
    Margin,
    Region,
    Role,
    Source,
    System,
    body_point,
)
from derive.language.envelope import envelope, explicit, explicit_angle
from derive.language.surface import Surface
from derive.language.symbols import Guard, Quantity, Rule, Unknown, rotation_angle
from derive.tools.cutter_blade import CutterBlade

s = k.flank.symbol
N_1, N_2, Sigma, E = (q.symbol for q in (k.pinion_teeth, k.gear_teeth, k.shaft_angle, k.offset))
dE, dP, dG, dSigma = (q.symbol for q in (k.error_offset, k.error_pinion, k.error_gear, k.error_angle))

#: Hand of the members: the pinion's is left.
HAND = {"pinion": -1, "gear": 1}

#: Which flank of the member meets the other's: the gear's convex one is cut by an inside blade.
SIDE = {"pinion": s, "gear": -s}


# -- one member on its machine --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Tooth:
    """A member's flank, explicit, and the fillet; ``regular`` and ``fillet_regular`` have the sign of their singular
    functions where they exist, ``arc`` is the arc length along the blade from its tip.
    """

    settings: Settings
    flank: Surface
    fillet: Surface
    blade: CutterBlade
    arc: sp.Expr
    regular: sp.Expr
    fillet_regular: sp.Expr
    tau: Quantity
    recovered: tuple = ()

    @property
    def name(self):
        return self.settings.body


def _blade(m, definitions):
    return CutterBlade(
        definitions, m.body, HAND[m.body], SIDE[m.body], m.point_radius.symbol, m.blade_angle.symbol,
        m.blade_curvature.symbol, m.blade_reference.symbol, m.edge_radius.symbol,
    )  # fmt: skip


def _machine(m, cradle, work, sliding):
    """Cutter to body: the head on the turned cradle, the blank at its root angle, turned by its work."""
    h = HAND[m.body]
    head = Rz(h * (m.cradle_angle.symbol + cradle)) @ translation(x=m.radial.symbol)
    cutter = head @ Rz(h * m.swivel.symbol) @ Ry(m.tilt.symbol)
    blank = translation(y=-h * m.blank_offset.symbol, z=-m.sliding_base.symbol - sliding)
    axis = translation(z=-m.center_to_back.symbol) @ Ry(m.root_angle.symbol - sp.pi / 2)
    return Rz(-h * work) @ axis @ blank @ cutter


def _work(m, phi, definitions):
    """Turn of the blank at a turn of the cradle: ratio of roll and modified roll."""
    turn = sp.Integer(0)
    for n, coefficient in reversed([*enumerate(m.modified_roll, 2)]):
        share = coefficient.symbol / sp.factorial(n)
        turn = phi * (turn - definitions.let(f"c_{n}_{m.body}", share, f"share of the turn's power {n}"))
    return m.ratio_of_roll.symbol * phi * (1 + turn)


def _generated(m, definitions):
    """The flank that the rolling cutter envelops, with its meshing equation solved for the place on the blade."""
    blade, name = _blade(m, definitions), m.body
    theta = Quantity(f"theta_{name}", "rad", "angle around the cutter's axis", "tool")
    w = Quantity(f"w_{name}", "mm", "where the blade's normal meets its line, from where they touch", "tool")
    phi = Quantity(f"phi_cradle_{name}", "rad", "turn of the cradle", "gen")

    def rolled(cutter, turn):
        motion = _machine(m, turn, _work(m, turn, definitions), m.helical_motion.symbol * turn)
        return envelope(cutter, motion, turn).on("bevel/meshing", "bevel/pole")

    flank, solved = explicit(rolled(blade.swung_edge(w, theta), phi))
    tau = Quantity(f"tau_{name}", "rad", "inclination of the normal on the rounding of the blade", "tool")
    phi_f = Quantity(f"phi_fillet_{name}", "rad", "turn of the cradle where it cuts the fillet", "gen")
    fillet = explicit_angle(rolled(blade.tip(tau, theta), phi_f), tau, _upward)
    arc = definitions.let(f"u_{name}", blade.arc_length(solved.symbol), "along the blade from its tip", "mm", "tool")
    sign = -HAND[name] * SIDE[name]
    return Tooth(
        m, flank.in_order(phi, theta).on("bevel/linear"), fillet.in_order(phi_f, theta), blade, arc,
        sign * solved.denominator, sign * Quantity(f"{tau}_cosine"), tau, (arc,),
    )  # fmt: skip


def _upward(a, b):
    """The direction of the solution whose sine is positive."""
    return -a


def _formate(m, definitions):
    """The copy of the cutter at rest."""
    blade, name = _blade(m, definitions), m.body
    theta = Quantity(f"theta_{name}", "rad", "angle around the cutter's axis", "tool")
    u = Quantity(f"u_{name}", "mm", "along the blade from its tip", "tool")
    tau = Quantity(f"tau_{name}", "rad", "inclination of the normal on the rounding of the blade", "tool")
    rest = _machine(m, 0, 0, 0)
    flank, fillet = (c.placed(rest).turned_over() for c in (blade.edge(u, theta), blade.tip(tau, theta)))
    sign = HAND[name] * SIDE[name]
    return Tooth(m, flank, fillet, blade, u, -sign, sign, tau)


# -- the pair -------------------------------------------------------------------------------------------------------


def _gear_mounting(phi_2):
    return translation(z=dG) @ Rz(phi_2)


def _pinion_mounting(phi_1, offset, shaft_angle, axial):
    return translation(y=offset) @ Ry(shaft_angle) @ Rz(sp.pi) @ translation(z=axial) @ Rz(-phi_1)


def bevel(cut_gear):
    """The drive whose gear is cut by ``cut_gear``."""
    definitions = Definitions()
    phi_1 = rotation_angle("phi_pinion", "angle of the pinion in mesh", "f")
    error = rotation_angle("transmission_error", "gear angle less ratio times pinion angle", "f")
    ratio = definitions.let("ratio", N_1 / N_2, "N1/N2")
    phi_2 = ratio * phi_1 + error
    pinion_tooth, gear_tooth = _generated(PINION, definitions), cut_gear(GEAR, definitions)
    formate = cut_gear is _formate

    pinion = _body("pinion", pinion_tooth, _pinion_mounting(phi_1, E + dE, Sigma + dSigma, dP))
    wheel = _body("wheel", gear_tooth, _gear_mounting(phi_2))
    unknowns = (*_unknowns(pinion_tooth), *_unknowns(gear_tooth), Unknown(error))
    mean = _MeanPoint(pinion_tooth, gear_tooth, definitions)
    return Drive(
        name="bevel_formate" if formate else "bevel_generated",
        family="bevel",
        title="bevel or hypoid pair with a Formate gear" if formate else "bevel or hypoid pair with a generated gear",
        parameters=k.parameters(formate),
        rules=mean.rules,
        systems=mean.systems,
        guards=(*_guards(pinion_tooth), *_guards(gear_tooth)),
        sizes=_sizes(),
        instant=phi_1,
        error=error,
        ratio=ratio,
        wheel_angle=phi_2,
        pinion=pinion,
        wheel=wheel,
        regions=tuple(
            Region(
                body.name, "fillet", tooth.fillet, tooth.fillet_regular, _fillet_margins(tooth),
                tooth.settings.pitch_angle.place,
            )
            for body, tooth in ((pinion, pinion_tooth), (wheel, gear_tooth))
        ),  # fmt: skip
        unknowns=unknowns,
        residual=contact(pinion.placed, wheel.placed),
        definitions=definitions,
        start=mean.start(phi_1, error, ratio),
        guess={},
        sample=SAMPLE_FORMATE if formate else SAMPLE,
        sample_angle=0.9 if formate else 0.03,
        reference_angle=k.mean_pinion_angle.symbol,
        pinion_teeth=k.pinion_teeth.key,
        variant_defaults={"pinion.method": "generated", "gear.method": "generated"},
        variant={"pinion.method": "generated", "gear.method": "formate" if formate else "generated"},
        handed="left",
        loading=Loading(pairs=5, torque_on="wheel"),
        exchange=EXCHANGE,
        outline=outlines.bevel,
        sources=(Source("F. L. Litvin, A. Fuentes", "Gear Geometry and Applied Theory", 2004, "chapters 21, 22"),),
        flanks_apart=True,
        absorbs_errors=True,
    )  # fmt: skip


def _body(name, tooth, motion):
    point = body_point(name)
    return Body(
        name,
        tooth.flank,
        motion,
        reference={},
        regular=tooth.regular,
        point=point,
        margins=_margins(tooth, point),
        recovered=tooth.recovered,
        lengthwise=tooth.settings.pitch_angle.place,
    )


def _unknowns(tooth):
    m = tooth.settings
    sizes = {"u": m.face_width.symbol / 4, "theta": m.face_width.symbol / m.point_radius.symbol}
    return tuple(Unknown(p, sizes.get(p.name.split("_")[0], sp.Integer(1))) for p in tooth.flank.parameters)


def _cone(m, point):
    """(along the pitch cone, below the face cone) of a point of the body."""
    x, y, z = point
    rho, delta, tip = v.radius(x, y), m.pitch_angle.symbol, m.face_angle.symbol
    along = (z + m.pitch_apex.symbol) * sp.cos(delta) + rho * sp.sin(delta)
    return along, (z + m.face_apex.symbol) * sp.sin(tip) - rho * sp.cos(tip)


def _margins(tooth, point):
    m = tooth.settings
    along, below_tip = _cone(m, point)
    outer, face = m.outer_cone_distance.symbol, m.face_width.symbol
    return (
        Margin("off_tip", "tip", below_tip),
        Margin("off_face", "face", (outer - along) * (along - outer + face) / face),
        Margin("off_root", "root", tooth.arc - tooth.blade.junction, Role.JUNCTION, joins="fillet"),
    )


def _fillet_margins(tooth):
    joint = tooth.blade.inclination_at_junction
    return Margin("", "junction", tooth.tau - joint, joins="flank"), Margin("", "bottom", sp.pi / 2 - tooth.tau)


def _guards(tooth):
    m = tooth.settings
    face, outer = m.face_width, m.outer_cone_distance
    return (
        Guard(
            1 - tooth.blade.sine_at_junction**2,
            f"the arc of the {m.body}'s blade and its rounded tip must touch",
            _places(m.blade_curvature, m.blade_reference, m.edge_radius),
        ),
        Guard(
            outer.symbol - face.symbol,
            f"the {m.body}'s outer cone distance must exceed its face width",
            (outer.place, face.place),
        ),
    )


def _sizes():
    return (
        ("ratio", N_1 / N_2, "gear turns per pinion turn N1/N2, the inverse of the gear ratio"),
    )


# -- where the teeth meet -------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _MeanPoint:
    """The point of the gear at mid face and mid height, and where the aligned pair touches if it runs there.

    Each member's point follows from two of its sizes: cone distance and height of the gear's, radius and axial
    position of the pinion's; the angle of the gear from n·(v2 − v1) = 0, that of the pinion from the azimuth.
    """

    pinion: Tooth
    gear: Tooth
    definitions: Definitions

    @property
    def systems(self):
        return self._of_gear(), self._of_mesh(), self._of_pinion()

    @property
    def rules(self):
        """The angle at which the pinion's point lies where the gear's is."""
        a, b, _ = self._met()
        x, y, _ = (q.symbol for q in k.mean_point_pinion)
        return (Rule(k.mean_pinion_angle.symbol, v.arc(y * a - x * b, x * a + y * b)),)

    @staticmethod
    def _met():
        """The gear's mean point in the frame of a pinion at angle 0."""
        met = _pinion_mounting(0, E, Sigma, 0).inverse() @ Rz(k.mean_gear_angle.symbol)
        return met.point(tuple(q.symbol for q in k.mean_point))

    def _of_gear(self):
        tooth, m = self.gear, GEAR
        point, normal = tooth.flank.body_point(), tooth.flank.body_normal()
        along, below_tip = _cone(m, point)
        height = (tooth.arc - tooth.blade.straight_junction) * sp.cos(m.blade_angle.symbol)
        names = (k.mean_cradle_gear if tooth.recovered else k.mean_u_gear), k.mean_theta_gear
        return DesignSystem(
            name="gear_mean_point",
            unknowns=_unknowns(tooth),
            residual=(along - m.outer_cone_distance.symbol + m.face_width.symbol / 2, below_tip - height),
            guess=_guess(tooth),
            fills=_filled((*names, *k.mean_point, *k.mean_normal), (*tooth.flank.parameters, *point, *normal)),
            message="the settings of the gear cut no point at mid face and mid height",
            keys=_places(m.cradle_angle, m.radial, m.point_radius, m.sliding_base, m.outer_cone_distance),
            homotopy=True,
            definitions=self.definitions,
        )

    def _of_mesh(self):
        """The angle at which the gear's mean point meets the pinion, followed from that of crossing axes."""
        point, normal = (tuple(q.symbol for q in vector) for vector in (k.mean_point, k.mean_normal))
        x, y, _ = point
        phi_1, phi_2 = Quantity("phi_1_rolling", "rad"), Quantity("phi_2_meeting", "rad")
        relative = _pinion_mounting(phi_1, PATH * E, Sigma, 0).inverse() @ Rz(phi_2 + N_1 / N_2 * phi_1)
        return DesignSystem(
            name="mesh_angle",
            unknowns=(Unknown(phi_2),),
            residual=(relative.power(phi_1, point, normal),),
            guess={phi_2: -v.arc(y, x)},
            fills=_filled((k.mean_gear_angle,), (phi_2,)),
            message="the gear's mean point meets the pinion at no angle",
            keys=_places(k.offset, k.shaft_angle, GEAR.outer_cone_distance, GEAR.cradle_angle),
            fixed={phi_1: sp.Integer(0)},
            definitions=self.definitions,
        )

    def _of_pinion(self):
        """The pinion's point on that circle of its axis, and the angle at which it lies there."""
        tooth, m = self.pinion, PINION
        a, b, height = self._met()
        x, y, z = tooth.flank.body_point()
        return DesignSystem(
            name="pinion_mean_point",
            unknowns=_unknowns(tooth),
            residual=(v.radius(x, y) - v.radius(a, b), z - height),
            guess=_guess(tooth),
            fills=_filled(
                (k.mean_cradle_pinion, k.mean_theta_pinion, *k.mean_point_pinion), (*tooth.flank.parameters, x, y, z)
            ),
            message="the settings of the pinion cut no point where the gear's mean point meets it",
            keys=_places(m.cradle_angle, m.radial, m.point_radius, m.sliding_base, m.blank_offset),
            homotopy=True,
            definitions=self.definitions,
        )

    def start(self, phi_1, error, ratio):
        """The mean point, followed along the path by the rolls of either member."""
        ahead = phi_1 - k.mean_pinion_angle.symbol
        phi, theta = self.pinion.flank.parameters
        outputs = {
            theta: k.mean_theta_pinion.symbol,
            phi: k.mean_cradle_pinion.symbol + ahead / PINION.ratio_of_roll.symbol,
            error: k.mean_gear_angle.symbol - ratio * k.mean_pinion_angle.symbol,
        }
        across, theta = self.gear.flank.parameters
        outputs[theta] = k.mean_theta_gear.symbol
        if self.gear.recovered:
            outputs[across] = k.mean_cradle_gear.symbol + ratio * ahead / GEAR.ratio_of_roll.symbol
        else:
            outputs[across] = k.mean_u_gear.symbol
        return System(name="start", definitions=self.definitions, unknowns=(), residual=(), outputs=outputs)


def _places(*parameters):
    return tuple(q.place for q in parameters)


def _filled(parameters, values):
    return {q.symbol: value for q, value in zip(parameters, values, strict=True)}


def _guess(tooth):
    """On the blank's middle, cut while the cradle is at rest."""
    m = tooth.settings
    mean, q = m.outer_cone_distance.symbol - m.face_width.symbol / 2, m.cradle_angle.symbol
    radial = m.radial.symbol
    theta = v.arc(-radial * sp.sin(q), mean - radial * sp.cos(q)) - m.swivel.symbol - q
    across, along = tooth.flank.parameters
    return {across: sp.Integer(0), along: theta}


def catalogue():
    """Generated or Formate gear: name → builder."""
    return {"bevel_generated": partial(bevel, _generated), "bevel_formate": partial(bevel, _formate)}


#: Regular designs, where pivots are chosen and self-tests made: a pair by one crown gear, the pinion crowned both
#: ways, and a hypoid pair whose pinion rolls with the gear's own tool.
SAMPLE = {
    "flank": 1, "pinion_teeth": 15, "gear_teeth": 44, "offset_mm": "0.01",
    "pinion.point_radius_mm": "76.8533", "pinion.blade_angle_deg": 20, "pinion.radial_setting_mm": "72.8141",
    "pinion.blade_curvature_per_mm": "0.002", "pinion.blade_reference_mm": "3.9375",
    "pinion.cradle_angle_deg": "61.6114", "pinion.root_angle_deg": "18.8247", "pinion.sliding_base_mm": "-3.7",
    "pinion.tilt_deg": "0.02", "pinion.swivel_deg": 20, "pinion.edge_radius_mm": "0.5",
    "pinion.ratio_of_roll": "3.0991", "pinion.roll_2c": "0.01", "pinion.pitch_angle_deg": "18.8247",
    "pinion.face_angle_deg": "18.8247",
    "pinion.face_apex_mm": "9.2973", "pinion.outer_cone_distance_mm": "92.9731", "pinion.face_width_mm": 27,
    "gear.point_radius_mm": "77.5467", "gear.blade_angle_deg": 20, "gear.radial_setting_mm": "71.9405",
    "gear.blade_curvature_per_mm": "0.00001", "gear.edge_radius_mm": "0.5",
    "gear.cradle_angle_deg": "60.1871", "gear.root_angle_deg": "71.1753", "gear.sliding_base_mm": "-3.7",
    "gear.ratio_of_roll": "1.05651", "gear.pitch_angle_deg": "71.1753", "gear.face_angle_deg": "71.1753",
    "gear.face_apex_mm": "3.1695", "gear.outer_cone_distance_mm": "92.9731", "gear.face_width_mm": 27,
}  # fmt: skip
SAMPLE_FORMATE = {
    "flank": 1, "pinion_teeth": 11, "gear_teeth": 41, "offset_mm": 30,
    "pinion.point_radius_mm": "76.7441", "pinion.blade_angle_deg": 20, "pinion.radial_setting_mm": "87.3328",
    "pinion.blade_curvature_per_mm": "0.001", "pinion.blade_reference_mm": 4, "pinion.edge_radius_mm": "0.5",
    "pinion.cradle_angle_deg": "49.4081", "pinion.tilt_deg": 18, "pinion.swivel_deg": "-49.4081",
    "pinion.root_angle_deg": "-0.001", "pinion.blank_offset_mm": 30, "pinion.sliding_base_mm": "14.2576",
    "pinion.ratio_of_roll": "3.72727", "pinion.pitch_angle_deg": "17.397", "pinion.pitch_apex_mm": "7.833",
    "pinion.face_angle_deg": "17.397", "pinion.face_apex_mm": "18.536", "pinion.outer_cone_distance_mm": "119.09",
    "pinion.face_width_mm": 29,
    "gear.point_radius_mm": "77.6559", "gear.blade_angle_deg": 20, "gear.radial_setting_mm": "87.8478",
    "gear.edge_radius_mm": "0.5",
    "gear.cradle_angle_deg": "47.3583", "gear.root_angle_deg": 72, "gear.sliding_base_mm": -4,
    "gear.pitch_angle_deg": 72, "gear.face_angle_deg": 72, "gear.face_apex_mm": "3.3647",
    "gear.outer_cone_distance_mm": "113.3889", "gear.face_width_mm": 27,
}  # fmt: skip
