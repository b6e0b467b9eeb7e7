"""Cylindrical worm drives: a worm of any ISO flank form and a wheel cut by a hob of any ISO flank form.

Frames: ``f`` fixed, z along the worm axis, x from worm to wheel; the wheel axis is (0, sin Σ, cos Σ) through
(A, 0, 0). The worm turns by +φ1 about z, the wheel by +φ2 about minus its axis. Right hand; the left-hand drive is
the mirror image y → −y.
"""

from dataclasses import dataclass, replace
from functools import partial

import sympy as sp

from derive.drives import outlines
from derive.drives.cylindrical_worm_functions import generation_functions
from derive.language import vectors as v
from derive.language.chain import Rx, Ry, Rz, translation
from derive.language.choice import excess
from derive.language.contact import contact
from derive.language.definitions import Definitions
from derive.language.drive import Body, Drive, Loading, Margin, Region, Regrind, Source, System, ToolUse, body_point
from derive.language.envelope import envelope, explicit, merge_sum
from derive.language.functions import solid
from derive.language.rack_and_pinion import Rack
from derive.language.symbols import Guard, Rule, Table, Unknown, parameter, rotation_angle
from derive.tools.axial_blade import axial_blade
from derive.tools.grinding_arc import grinding_arc
from derive.tools.grinding_disc import grinding_disc
from derive.tools.involute import involute
from derive.tools.reground import reground, working_radius
from derive.tools.straight_blade import straight_blade
from derive.tools.tip_rounding import tip_rounding
from derive.tools.worm_body import SHEET_USED, WormBody

SOURCES = (
    Source(
        "K.-Y. Chen, C.-B. Tsay",
        "Contact characteristics of recess action worm gear drives with double-depth teeth",
        2011,
        "Journal of Mechanical Design 133: the whole drive, ZN worm and oversize ZN hob",
    ),
    Source(
        "K.-Y. Chen, C.-B. Tsay",
        "Contact characteristics of the ZK-type worm and ZN-type worm wheel meshing with a non-ninety-degree crossing "
        "angle",
        2009,
        "JSME International Conference on Motion and Power Transmissions, GUD-02: ZK worm, ZN hob, shaft angle",
    ),
    Source("ISO", "ISO 10828, Worm gears: worm profiles and gear mesh geometry", 2015, "flank forms A, I, N, K, C"),
    Source("author not named", "Right-angle cylindrical worm gear drives as rack and pinion", None, "limit points"),
)

#: ISO 10828 letters and the tools that make them.
TOOLS = {"ZA": axial_blade, "ZI": involute, "ZN": straight_blade, "ZK": grinding_disc, "ZC": grinding_arc}

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


def _parameters(own, condition):
    """The parameter vector, with the keys of the two tools' own data."""
    return (
        flank, normal_module, axial_module, threads, teeth, lead_angle, pitch_radius, pressure_angle, shaft_angle,
        shift, hob_radius, hob_threads, *own["worm"].values(), hob_pressure_angle, *own["hob"].values(),
        hob_lead_angle, center_distance, cutting_distance, cutting_angle,
        error_distance, error_horizontal, error_vertical, error_axial,
        wheel_tip, wheel_throat, face_width, worm_tip, worm_root, hob_tip, hob_rounding, preset, separation,
        allowance, *condition.parameters,
    )  # fmt: skip


def _own(worm_tool, hob_tool):
    """The keys of the tools' own data, by body and datum: the hob's begin with ``hob_``.

    The worm's keys are those of either tool, as the hob's data are the worm's unless a design says otherwise.
    """
    return {
        "worm": {d: d.parameter("worm") for d in dict.fromkeys((*worm_tool.data, *hob_tool.data))},
        "hob": {d: replace(d, default=None, required=False).parameter("hob", "hob_") for d in hob_tool.data},
    }


def _follow(own):
    """The hob's own data are the worm's."""
    return tuple(Rule(p.symbol, own["worm"][datum].symbol) for datum, p in own["hob"].items())


s, m_n, m_x, T_1, T_2 = (q.symbol for q in (flank, normal_module, axial_module, threads, teeth))
lam, r_1, alpha, Sigma = (q.symbol for q in (lead_angle, pitch_radius, pressure_angle, shaft_angle))
r_h, T_h, lam_h, alpha_h = (q.symbol for q in (hob_radius, hob_threads, hob_lead_angle, hob_pressure_angle))
A, A_gen, Sigma_gen = (q.symbol for q in (center_distance, cutting_distance, cutting_angle))

#: Derived sizes that every formula shares.
p_1 = r_1 * sp.tan(lam)
p_h = r_h * sp.tan(lam_h)
r_2 = m_n * T_2 / (2 * sp.sin(Sigma + lam))
groove_width = sp.pi * m_n / 2 - 2 * shift.symbol * sp.tan(alpha)



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


def _rules(hob):
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


def _hob_end(hob):
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



def _proportions(hob):
    """What completes a blank. Of two rules for one size the second serves a wheel without a throat."""
    return (
        Rule(hob_tip.symbol, (STANDARD_ADDENDUM + STANDARD_CLEARANCE) * m_x + shift.symbol),
        Rule(wheel_tip.symbol, wheel_throat.symbol + BEYOND_THROAT * m_x),
        Rule(wheel_tip.symbol, r_2 + STANDARD_ADDENDUM * m_x - shift.symbol),
        Rule(hob_rounding.symbol, _standard_rounding()),
        Rule(worm_tip.symbol, A - _hob_end(hob) - STANDARD_CLEARANCE * m_x),
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


def _threaded_body(name, radius, lead, angle, own):
    return WormBody(
        name=name,
        turn=rotation_angle(f"psi_{name}", f"screw angle of the {name} flank", name),
        module=m_n,
        pitch_radius=radius,
        lead_angle=lead,
        screw_parameter=radius * sp.tan(lead),
        pressure_angle=angle,
        groove_width=groove_width,
        flank=s,
        tip_addendum=hob_tip.symbol,
        tip_rounding=hob_rounding.symbol,
        own={datum: p.symbol for datum, p in own[name].items()},
    )


def cutting(phi_h):
    """Hob body to wheel body: the hob turns by φ_h, the blank by T_h/T2·φ_h about minus its axis."""
    return Rz(T_h / T_2 * phi_h) @ Rx(Sigma_gen) @ translation(x=-A_gen) @ Rz(phi_h)


def mounting(phi_2):
    """Wheel body to the fixed frame in mesh, with the errors of assembly."""
    return (
        translation(x=A + error_distance.symbol)
        @ Rx(-(Sigma + error_horizontal.symbol))
        @ Ry(error_vertical.symbol)
        @ translation(z=error_axial.symbol)
        @ Rz(-phi_2)
    )


def helicoids(worm_profile, hob_profile, definitions):
    """The worm and the hob: flanks of the same kind, each with its own data."""
    own = _own(TOOLS[worm_profile], TOOLS[hob_profile])
    return TOOLS[worm_profile](_worm(own), definitions), TOOLS[hob_profile](_hob(own), definitions)


def _worm(own):
    return _threaded_body("worm", r_1, lam, alpha, own)


def _hob(own):
    return _threaded_body("hob", r_h, lam_h, alpha_h, own)


#: Statements of the audit record about the wheel of any hob.
HOBBED = tuple(
    f"cylindrical_worm/{key}" for key in ("meshing", "normal", "sum-angle", "explicit", "linear", "both-systems")
)


def cylindrical_worm(worm_profile, hob_profile, condition=NEW):
    """The drive whose worm and hob have these ISO 10828 flank forms ("ZA", "ZI", "ZN", "ZK", "ZC").

    The form of a reground hob is that which it had when it was new.
    """
    definitions = Definitions()
    phi_1 = rotation_angle("phi_worm", "angle of the worm in mesh", "f")
    error = rotation_angle("transmission_error", "wheel angle less ratio times worm angle", "f")
    ratio = definitions.let("ratio", T_1 / T_2, "T1/T2")
    phi_2 = ratio * phi_1 + error

    worm_tool, hob_tool = TOOLS[worm_profile], TOOLS[hob_profile]
    own = _own(worm_tool, hob_tool)
    worm, hob = worm_tool(_worm(own), definitions), hob_tool(_hob(own), definitions)
    systems = _of_reground_hob(hob, own, definitions) if not condition.new else ()
    hob = hob if condition.new else reground(hob, _hob(own), definitions, condition.ground_off)
    phi_h = rotation_angle("phi_hob", "angle of the hob in cutting", "gen")
    wheel, psi = _hobbed(hob.flank, phi_h)
    psi_h = hob.flank.parameters[1]
    phi_h = definitions.let("phi_hob", psi - psi_h, "angle of the hob in cutting", "rad", "gen", parity=-1)
    rounding = tip_rounding(hob, _with_tip(_hob(own), condition), definitions)
    fillet, _ = _hobbed(rounding.surface, rotation_angle("phi_round_hob", "angle of the hob in cutting", "gen"))

    t_w, psi_w = worm.flank.parameters
    t_h = hob.parameter
    pinion = Body(
        "pinion",
        worm.flank,
        Rz(phi_1),
        reference={t_w: worm.pitch_point, psi_w: sp.Integer(0)},
        point=body_point("pinion"),
        margins=_worm_margins(body_point("pinion"), worm),
    )
    wheel_body = Body(
        "wheel",
        wheel,
        mounting(phi_2),
        reference={t_h: hob.pitch_point, psi: sp.Integer(0)},
        point=body_point("wheel"),
        margins=_wheel_margins(body_point("wheel"), hob, psi, definitions),
        recovered=(psi_h, phi_h),
        lengthwise="axial",
    )
    sizes = {t_w: worm.scale, t_h: hob.scale}
    unknowns = tuple(Unknown(symbol, sizes.get(symbol, sp.Integer(1))) for symbol in (t_w, psi_w, t_h, psi, error))
    return Drive(
        name=_name(worm_profile, hob_profile, condition),
        family="cylindrical-worm",
        title=f"{worm_profile} worm with a wheel cut by a {'' if condition.new else 'reground '}{hob_profile} hob",
        parameters=_parameters(own, condition),
        rules=(*_rules(condition), *_follow(own), *worm.rules, *hob.rules),
        systems=systems,
        guards=GUARDS + _profile_guards(worm, hob),
        sizes=SIZES,
        instant=phi_1,
        error=error,
        ratio=ratio,
        wheel_angle=phi_2,
        pinion=pinion,
        wheel=wheel_body,
        regions=(
            Region("wheel", "fillet", fillet, _fillet_regular(rounding), _fillet_margins(rounding), "axial"),
        ),
        unknowns=unknowns,
        residual=contact(pinion.placed, wheel_body.placed),
        definitions=definitions,
        start=_start(worm, hob, condition, psi, phi_1, phi_h, error, definitions),
        guess={t_w: worm.pitch_point, t_h: hob.pitch_point},
        sample=SAMPLE | worm_tool.sample | hob_tool.sample | ({} if condition.new else {ground_off.key: 0.5}),
        sample_angle=1.0,
        pinion_teeth=threads.key,
        variant={"worm_profile": worm_profile, "hob_profile": hob_profile, "hob_condition": condition.word},
        variant_defaults={"hob_profile": "worm_profile", "hob_condition": NEW.word},
        functions=(
            *generation_functions(
                worm, hob, Rack(hob.flank, p_h, T_h / T_2, A_gen, Sigma_gen), wheel, psi, wheel_body.recovered,
                _rack_sizes(worm_profile == hob_profile, condition),
            ),
            *_solids(condition),
        ),
        tools=(
            ToolUse("worm", worm_profile, worm_tool, tuple(own["worm"][d].key for d in worm_tool.data)),
            ToolUse("hob", hob_profile, hob_tool, tuple(own[b][d].key for d in hob_tool.data for b in ("worm", "hob"))),
        ),
        loading=Loading(
            pairs=5,
            torque_on="wheel",
            keys={
                name: f"{Table.BLANK.value}.{p.key}"
                for name, p in (("wheel_face", face_width), ("wheel_tip", wheel_tip), ("tool_rounding", hob_rounding))
            },
        ),
        proportions=_proportions(condition),
        exchange=_exchange() if condition.new else None,
        regrind=REGRIND,
        outline=outlines.worm,
        sources=SOURCES,
        handed="right",
        exclusive=(
            (normal_module.key, axial_module.key),
            (lead_angle.key, pitch_radius.key),
        ),
    )


def _of_reground_hob(hob, own, definitions):
    """The design system of a reground hob; ``hob`` is the new one."""
    keys = (ground_off.key, hob_radius.key)
    return (working_radius(hob, _hob(own), definitions, REGROUND.ground_off, working.symbol, keys),)


def _with_tip(body, condition):
    """The data of a hob with the tip that is left of it."""
    return body if condition.new else replace(body, tip_addendum=body.tip_addendum - condition.ground_off)


def _solids(hob):
    """Thread and wheel of a whole blank; the root of the wheel is that of its middle plane."""
    worm = {
        "module": (m_x, "mm"),
        "root_radius": (worm_root.symbol, "mm"),
        "tip_radius": (worm_tip.symbol, "mm"),
        "rounding": (STANDARD_ROUNDING * m_x, "mm"),
        "taper": (0, ""),
    }
    wheel = {
        "module": (m_x, "mm"),
        "teeth": (T_2, ""),
        "root_radius": (_hob_end(hob), "mm"),
        "face_first": (-face_width.symbol / 2, "mm"),
        "face_last": (face_width.symbol / 2, "mm"),
    }
    return solid("pinion", worm), solid("wheel", wheel)


def _exchange():
    """The family in REXS; that page reads this one's keys."""
    from derive.drives.cylindrical_worm_rexs import EXCHANGE

    return EXCHANGE


def _rack_sizes(same_profile, hob):
    """Sizes (value, unit) by name, for limits, sections and the search for contacts."""
    return {
        "module": (m_n, "mm"),
        "reference_radius_tool": (hob.radius, "mm"),
        "end_radius_tool": (r_h + hob_tip.symbol - hob.ground_off, "mm"),
        "reference_radius_pinion": (r_1, "mm"),
        "tip_radius_pinion": (worm_tip.symbol, "mm"),
        "root_radius_pinion": (worm_root.symbol, "mm"),
        "axial_pitch_pinion": (2 * sp.pi * p_1 / T_1, "mm"),
        "tip_radius_wheel": (wheel_tip.symbol, "mm"),
        "throat_radius_wheel": (wheel_throat.symbol, "mm"),
        "cutting_distance": (A_gen, "mm"),
        "cutting_angle": (Sigma_gen, "rad"),
        "turns": (T_1 / T_h, ""),
        "oversize": (hob.radius - r_1, "mm"),
        "same_profile": (sp.Integer(int(same_profile and hob.new)), ""),
    }


def _hobbed(cutter, phi_h):
    """What a screw surface of the hob envelops on the wheel, explicit in its turn, and the rack angle Ψ."""
    turn = cutter.parameters[-1]
    wheel = envelope(cutter, cutting(phi_h), phi_h)
    wheel, psi = merge_sum(wheel, turn, phi_h, "psi_fixed_hob", "angle of the hob profile in the fixed cutting frame")
    return explicit(wheel)[0].on("conventions/wheel-axis", *HOBBED), psi


def _fillet_regular(rounding):
    """The condition on the ball grows or falls along the flank's parameter; its slope gives the sign."""
    (condition,), t = rounding.surface.conditions, rounding.surface.parameters[1]
    return s * rounding.surface.definitions.derivative(condition, t)


def _fillet_margins(rounding):
    return Margin("", "bottom", rounding.turn), Margin("", "junction", rounding.before_flank, joins="flank")


def _start(worm, hob, condition, psi, phi_1, phi_h, error, definitions):
    """A point close to contact: on the hob's mid plane Ψ = 0 at the right cutting angle, and below it on the worm."""
    t_w, psi_w = worm.flank.parameters
    t_h = hob.parameter
    at_middle = {psi: sp.Integer(0)}
    worm_x, worm_y, _ = worm.flank.point
    hob_x, hob_y, _ = hob.flank.point
    worm_radius = v.radius(worm_x, worm_y)
    hob_radius_here = v.radius(hob_x, hob_y)
    return System(
        name="start",
        definitions=definitions,
        unknowns=(Unknown(t_w, worm.scale), Unknown(t_h, hob.scale)),
        residual=(worm_radius - r_1 - (hob_radius_here - condition.radius), phi_h - phi_1 * T_1 / T_h),
        outputs={
            t_w: t_w,
            psi_w: v.arc(hob_y, hob_x) - phi_1 - v.arc(worm_y, worm_x),
            t_h: t_h,
            psi: sp.Integer(0),
            error: sp.Integer(0),
        },
        fixed=at_middle,
    )


def _worm_margins(point, worm):
    x, y, _ = point
    radius = v.radius(x, y)
    return (
        Margin("off_tip", "tip", worm_tip.symbol - radius),
        Margin("off_root", "root", radius - worm_root.symbol),
        *worm.margins,
    )


def _wheel_margins(point, hob, psi, definitions):
    x, y, z = point
    radius = v.radius(x, y)
    height, throat = A - radius, A - wheel_throat.symbol
    n_x = Rz(psi).direction(hob.flank.normal)[0]
    return (
        Margin("off_tip", "tip", wheel_tip.symbol - radius),
        Margin("off_tip", "throat", v.radius(height, z) - throat),
        Margin("off_face", "face", face_width.symbol / 2 - sp.Abs(z)),
        Margin("off_tool", "tool_end", hob.tip_margin, joins="fillet"),
        Margin("spurious_sheet", "spurious_sheet", n_x, relative=True),
        *hob.margins,
    )


def _profile_guards(worm, hob):
    return tuple(
        Guard(value, f"{body}: {reason}", (normal_module.key, lead_angle.key, pressure_angle.key, radius.key))
        for body, tool, radius in (("worm", worm, pitch_radius), ("hob", hob, hob_radius))
        for reason, value in tool.radicands
    )


def catalogue():
    """Every combination of a worm and a hob, new and reground: name → builder.

    One program a combination, not flanks composed at run time: fused, residual and Jacobian take 330 (ZN, ZN) to 768
    (ZC, ZC) operations; composed from point, normal and their derivatives on either flank, 537 to 940, that is 1.6 to
    1.2 times as many, and the pivot order of the Newton step could not be chosen in advance. A reground hob takes more
    operations than a new one.
    """
    combinations = [(worm, hob, condition) for condition in (NEW, REGROUND) for worm in TOOLS for hob in TOOLS]
    return {_name(*words): partial(cylindrical_worm, *words) for words in combinations}


def _name(worm_profile, hob_profile, condition):
    ending = "" if condition.new else f"_{condition.word}"
    return f"cylindrical_worm_{worm_profile}_{hob_profile}{ending}".lower()


#: What resharpening the hob changes.
REGRIND = Regrind(
    command="hob-life",
    summary="The life of a hob: what its wheels do in contact from the first to the last resharpening.",
    words={"hob_condition": REGROUND.word},
    amount=ground_off.place,
    radius=hob_radius.place,
    mate=pitch_radius.place,
    working=working.place,
    settings=(cutting_distance.place, cutting_angle.place),
)


#: A regular design (the fully recess-action drive) and angles: here pivots are chosen and self-tests are made.
SAMPLE = {
    "flank": 1, "normal_module_mm": 2, "worm_threads": 1, "wheel_teeth": 277, "worm_lead_angle_deg": 3,
    "pressure_angle_deg": 10, "pitch_line_shift_mm": 4, "hob_pitch_radius_mm": 20,
}  # fmt: skip
