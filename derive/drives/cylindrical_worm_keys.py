"""Parameters of cylindrical worm drives: design keys, rules, what a hob's condition changes, standard proportions."""

from dataclasses import dataclass

import sympy as sp

from derive.language.choice import excess
from derive.language.symbols import Guard, Rule, Table, parameter
from derive.tools.worm_body import SHEET_USED

POSITIVE = (0, sp.oo)
flank = parameter("flank", "s", "groove flank", table=Table.FLANK, choices=(("right", 1), ("left", -1)), default=1)
normal_module = parameter("normal_module_mm", "m_n", "normal module", domain=POSITIVE)
axial_module = parameter("axial_module_mm", "m_x", "axial module", domain=POSITIVE)
threads = parameter("worm_threads", "T_1", "threads of the worm", domain=POSITIVE, integer=True, required=True)
teeth = parameter("wheel_teeth", "T_2", "teeth of the wheel", domain=POSITIVE, integer=True, required=True)
lead_angle = parameter("worm_lead_angle_deg", "lambda_worm", "lead angle of the worm", domain=(0, sp.pi / 2))
pitch_radius = parameter("worm_pitch_radius_mm", "r_worm", "reference radius of the worm", domain=POSITIVE)
pressure_angle = parameter(
    "pressure_angle_deg", "alpha", "pressure angle of the generating profile", domain=(0, sp.pi / 2), required=True
)
shaft_angle = parameter("shaft_angle_deg", "Sigma", "shaft angle", domain=(0, sp.pi), default=sp.pi / 2)
shift = parameter("pitch_line_shift_mm", "dx", "pitch line below the middle of the blade height", default=0)
thickness_allowance = parameter(
    "worm_thickness_allowance_um", "A_sn", "allowance of the normal thread thickness of the worm", default=0
)
hob_radius = parameter("hob_pitch_radius_mm", "r_hob", "reference radius of the hob", domain=POSITIVE)
hob_threads = parameter("hob_threads", "T_hob", "threads of the hob", domain=POSITIVE, integer=True)
hob_pressure_angle = parameter(
    "hob_pressure_angle_deg", "alpha_hob", "pressure angle of the hob's profile", domain=(0, sp.pi / 2)
)
hob_lead_angle = parameter("hob_lead_angle_deg", "lambda_hob", "lead angle of the hob", domain=(0, sp.pi / 2))
center_distance = parameter("center_distance_mm", "A", "centre distance", domain=POSITIVE)
cutting_distance = parameter("cutting_center_distance_mm", "A_gen", "cutting centre distance", domain=POSITIVE)
cutting_angle = parameter("cutting_shaft_angle_deg", "Sigma_gen", "cutting shaft angle", domain=(0, sp.pi))
ground_off = parameter(
    "hob_regrind_mm", "Delta_hob", "what resharpening took off the radius of the hob", domain=POSITIVE,
    lower_included=True, default=0,
)  # fmt: skip
lead_matched = parameter(
    "hob_lead_matched_mm",
    "Delta_lead",
    "what is ground off the hob where its lead angle and normal module match those of the worm",
    domain=POSITIVE,
    lower_included=True,
    default=0,
)  # fmt: skip
working = parameter(
    "hob_working_radius_mm", "r_w", "radius of the reground hob that rolls where that of a new one would",
    domain=POSITIVE,
)  # fmt: skip
error_distance = parameter(
    "center_distance_mm", "dA", "centre distance error, wheel away from the worm", table=Table.MISALIGNMENT, default=0
)
error_horizontal = parameter("horizontal_deg", "dh", "shaft angle error, about x", table=Table.MISALIGNMENT, default=0)
error_vertical = parameter(
    "vertical_deg", "dv", "tilt about y of the already tilted wheel frame", table=Table.MISALIGNMENT, default=0
)
error_axial = parameter("axial_mm", "da", "shift of the wheel along its own axis", table=Table.MISALIGNMENT, default=0)
wheel_tip = parameter(
    "wheel_tip_radius_mm", "R_tip", "outside cylinder of the wheel", table=Table.BLANK, domain=POSITIVE
)
wheel_throat = parameter(
    "wheel_throat_radius_mm", "R_throat", "throat circle of the wheel", table=Table.BLANK, domain=POSITIVE
)
face_width = parameter("wheel_face_width_mm", "b_wheel", "face width of the wheel", table=Table.BLANK, domain=POSITIVE)
worm_root = parameter("worm_root_radius_mm", "rho_root", "root radius of the worm", table=Table.BLANK, domain=POSITIVE)
worm_tip = parameter(
    "worm_tip_radius_mm", "rho_tip", "tip radius of the worm", table=Table.BLANK, domain=POSITIVE, above=worm_root.key
)
hob_tip = parameter(
    "hob_tip_addendum_mm", "h_hob", "end of the blade beyond the pitch line", table=Table.BLANK, domain=POSITIVE
)
hob_rounding = parameter(
    "hob_tip_rounding_mm",
    "rho_hob",
    "rounding between flank and tip cylinder of the hob; it cuts the fillet of the wheel",
    table=Table.BLANK,
    domain=POSITIVE,
    lower_included=True,
)
preset = parameter(
    "limits",
    "limits",
    "whose rule gives the wheel's tip and the end of the blade where this table leaves them open",
    table=Table.BLANK,
    choices=(("recess-action", 1),),
)
separation = parameter(
    "separation_mm",
    "delta",
    "separation for contact ellipses",
    table=Table.CONTACT,
    domain=POSITIVE,
    default=sp.Rational(632, 100000),
)
allowance = parameter(
    "elastic_allowance_mm",
    "delta_e",
    "separation below which a pair counts as touching",
    table=Table.CONTACT,
    domain=POSITIVE,
    lower_included=True,
    default=0,
)


def parameters(own, condition):
    """The parameter vector, with the keys of the two tools' own data."""
    return (
        flank, normal_module, axial_module, threads, teeth, lead_angle, pitch_radius, pressure_angle, shaft_angle,
        shift, thickness_allowance, hob_radius, hob_threads, *own["worm"].values(), hob_pressure_angle,
        *own["hob"].values(), hob_lead_angle, center_distance, cutting_distance, cutting_angle,
        error_distance, error_horizontal, error_vertical, error_axial,
        wheel_tip, wheel_throat, face_width, worm_tip, worm_root, hob_tip, hob_rounding, preset, separation,
        allowance, *condition.parameters,
    )  # fmt: skip


s, m_n, m_x, T_1, T_2 = (q.symbol for q in (flank, normal_module, axial_module, threads, teeth))
lam, r_1, alpha, Sigma = (q.symbol for q in (lead_angle, pitch_radius, pressure_angle, shaft_angle))
r_h, T_h, lam_h, alpha_h = (q.symbol for q in (hob_radius, hob_threads, hob_lead_angle, hob_pressure_angle))
A, A_gen, Sigma_gen = (q.symbol for q in (center_distance, cutting_distance, cutting_angle))

#: Derived sizes that every formula shares.
p_1 = r_1 * sp.tan(lam)
p_h = r_h * sp.tan(lam_h)
r_2 = m_n * T_2 / (2 * sp.sin(Sigma + lam))
groove_width = sp.pi * m_n / 2 - 2 * shift.symbol * sp.tan(alpha)

#: How far each flank of the worm is moved along its axis, out of the thread, by the allowance of its thickness.
thickened = thickness_allowance.symbol / (2 * sp.cos(lam))


@dataclass(frozen=True)
class HobCondition:
    """A hob as the design's word for it says: what is ground off it, and its radius and lead angle where it rolls.

    ``parameters`` are the keys that it needs; ``lead_matched``: the radius at which its module is that of the worm.
    """

    word: str
    ground_off: sp.Expr
    radius: sp.Expr
    lead_angle: sp.Expr
    lead_matched: sp.Expr
    parameters: tuple = ()

    @property
    def new(self):
        """Whether nothing is ground off it."""
        return not self.parameters


NEW = HobCondition("new", sp.S.Zero, r_h, lam_h, r_h)
REGROUND = HobCondition(
    "reground",
    ground_off.symbol,
    working.symbol,
    sp.atan2(p_h, working.symbol),
    r_h - lead_matched.symbol,
    (ground_off, lead_matched, working),
)


def _lead_of_hob(hob):
    """The lead angle on the new hob's reference cylinder."""
    matched = sp.asin(m_n * T_h / (2 * hob.lead_matched))
    return matched if hob.new else sp.atan2(hob.lead_matched * sp.tan(matched), r_h)


def rules(hob):
    """What completes a design that leaves keys open."""
    return (
        *RULES,
        Rule(lam_h, _lead_of_hob(hob)),
        Rule(alpha_h, alpha),
        Rule(A, r_1 + r_2),
        Rule(A_gen, A + hob.radius - r_1),
        Rule(Sigma_gen, Sigma + lam - hob.lead_angle),
        # The recess-action paper's limits, in any proportions; without the preset they stay open (not a number).
        Rule(wheel_tip.symbol, (r_2 + 2 * m_n - shift.symbol) * preset.symbol),
        Rule(hob_tip.symbol, (2 * m_n + shift.symbol) * preset.symbol),
    )


RULES = (
    Rule(lam, sp.atan2(m_x * T_1 / 2, r_1)),
    Rule(lam, sp.asin(m_n * T_1 / (2 * r_1))),
    Rule(m_n, m_x * sp.cos(lam)),
    Rule(m_x, m_n / sp.cos(lam)),
    Rule(r_1, m_n * T_1 / (2 * sp.sin(lam))),
    Rule(r_h, r_1),
    Rule(T_h, T_1),
)

#: Proportions of ISO/TR 10828 over the axial module: addendum, clearance, rounding, and how far the outside cylinder of
#: a throated wheel lies beyond its throat.
STANDARD_ADDENDUM, STANDARD_CLEARANCE, STANDARD_ROUNDING, BEYOND_THROAT = (
    sp.Rational(n, 10) for n in (10, 2, 3, 5)
)  # fmt: skip


def hob_end(hob):
    """Distance from the wheel's axis to the tip cylinder of the hob."""
    return A_gen - r_h - hob_tip.symbol + hob.ground_off


def _standard_rounding():
    """Rounding of the hob's tip: the standard one, or what clearance and hob allow if that is less.

    On a straight-sided profile a rounding ϱ takes ϱ(1 − sin α) from the height, where the clearance is (ISO 53), and
    ϱ(1 − sin α)/cos α from the land on either side.
    """
    land = excess(sp.pi * m_n - groove_width - 2 * hob_tip.symbol * sp.tan(alpha_h))
    allowed = sp.Min(STANDARD_CLEARANCE * m_x, land * sp.cos(alpha_h) / 2) / (1 - sp.sin(alpha_h))
    return sp.Min(STANDARD_ROUNDING * m_x, allowed)


def _standard_face():
    """The chord that the worm's tip circle cuts from its pitch line; less where the hob's flank does not reach so far.

    The flank ends where the hob's normal has no part along the centre line: at tan = tan α/sin λ.
    """
    chord = 2 * m_x * sp.sqrt(2 * r_1 / m_x + 1)
    sheet = sp.atan2(sp.tan(alpha), sp.sin(lam))
    return sp.Min(chord, 2 * r_1 * sp.sin(SHEET_USED * sheet))


def proportions(hob):
    """What completes a blank. Of two rules for one size the second serves a wheel without a throat."""
    return (
        Rule(hob_tip.symbol, (STANDARD_ADDENDUM + STANDARD_CLEARANCE) * m_x + shift.symbol),
        Rule(wheel_tip.symbol, wheel_throat.symbol + BEYOND_THROAT * m_x),
        Rule(wheel_tip.symbol, r_2 + STANDARD_ADDENDUM * m_x - shift.symbol),
        Rule(hob_rounding.symbol, _standard_rounding()),
        Rule(worm_tip.symbol, A - hob_end(hob) - STANDARD_CLEARANCE * m_x),
        Rule(worm_root.symbol, A - wheel_throat.symbol - STANDARD_CLEARANCE * m_x),
        Rule(worm_root.symbol, A - wheel_tip.symbol - STANDARD_CLEARANCE * m_x),
        Rule(face_width.symbol, _standard_face()),
    )


GUARDS = (
    Guard(
        1 - m_n * T_1 / (2 * r_1),
        "the worm is too thin for its module and threads: m_n·T1/(2·r1) must be below 1",
        (normal_module.key, threads.key, pitch_radius.key),
    ),
    Guard(
        1 - m_n * T_h / (2 * r_h),
        "the hob is too thin for its module and threads: m_n·T_h/(2·r_h) must be below 1",
        (normal_module.key, hob_threads.key, hob_radius.key),
    ),
    Guard(
        sp.pi - Sigma - lam,
        "shaft angle plus lead angle must stay below 180°",
        (shaft_angle.key, lead_angle.key),
    ),
    Guard(Sigma_gen, "the cutting shaft angle must be above 0°", (cutting_angle.key, shaft_angle.key)),
    Guard(sp.pi - Sigma_gen, "the cutting shaft angle must be below 180°", (cutting_angle.key, shaft_angle.key)),
    Guard(
        groove_width,
        "no groove is left on the pitch cylinder: π·m_n/2 − 2·shift·tan(pressure angle) must be positive",
        (normal_module.key, shift.key, pressure_angle.key),
    ),
)
SIZES = (
    ("screw_parameter_worm_mm_per_rad", p_1, "screw parameter of the worm"),
    ("screw_parameter_hob_mm_per_rad", p_h, "screw parameter of the hob"),
    ("lead_worm_mm", 2 * sp.pi * p_1, "lead of the worm"),
    ("wheel_pitch_radius_mm", r_2, "reference radius of the wheel"),
    ("wheel_helix_angle_deg", sp.pi / 2 - lam - Sigma, "helix angle of the wheel; positive: hand opposite to the worm"),
    ("groove_width_mm", groove_width, "normal width of the groove on the pitch cylinder"),
    ("ratio", T_1 / T_2, "wheel turns per pinion turn T1/T2, the inverse of the gear ratio"),
)  # fmt: skip

#: A regular design (the fully recess-action drive) and angles: here pivots are chosen and self-tests are made.
SAMPLE = {
    "flank": 1, "normal_module_mm": 2, "worm_threads": 1, "wheel_teeth": 277, "worm_lead_angle_deg": 3,
    "pressure_angle_deg": 10, "pitch_line_shift_mm": 4, "hob_pitch_radius_mm": 20,
}  # fmt: skip
