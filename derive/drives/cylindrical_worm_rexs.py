"""Cylindrical worm drives in REXS 2.0.0: worm_stage, worm_gear, worm_wheel, hob and grinding wheel."""

import sympy as sp

from derive.drives import cylindrical_worm_keys as k
from derive.exchange.rexs import (
    HAND,
    Assumption,
    Attribute,
    Component,
    Exchange,
    Reading,
    Relation,
    Words,
    angle_between_shafts,
    attribute,
    direct,
    shaft_axes,
)
from derive.tools.grinding import WHEEL_RADIUS
from derive.tools.grinding_arc import ARC_RADIUS


def _hob_radius(lead, module, threads):
    """Reference radius p/tan λ of a hob of this lead, with cos λ = π·m·T/lead."""
    cosine = sp.pi * module * threads / lead
    return lead / (2 * sp.pi) * cosine / sp.sqrt((1 - cosine) * (1 + cosine))


lead_angle, lead = attribute("worm", "lead_angle_worm_gear"), attribute("worm", "lead")
diameter = attribute("worm", "reference_diameter_worm_gear")
hob_tip, hob_addendum = attribute("hob", "tip_diameter_worm_gear"), attribute("hob", "tooth_addendum_worm_wheel_hob")
hob_lead = attribute("hob", "lead")
m_n, m_x, T_h, r_1, A = (q.symbol for q in (k.normal_module, k.axial_module, k.hob_threads, k.pitch_radius,
                                            k.center_distance))
r_h, lam_h = k.hob_radius.symbol, k.hob_lead_angle.symbol
throat = k.wheel_throat.symbol
forms = {form.upper(): form for form in ("za", "zi", "zn", "zk", "zc")}
pairs = [
    direct("worm", "number_of_teeth", k.threads),
    direct("wheel", "number_of_teeth", k.teeth),
    direct("worm", "normal_module", k.normal_module),
    direct("worm", "axial_module", k.axial_module),
    direct("worm", "reference_diameter_worm_gear", k.pitch_radius, 2),
    direct("worm", "pressure_angle_worm_gear", k.pressure_angle),
    direct("worm", "tip_diameter_worm_gear", k.worm_tip, 2),
    direct("worm", "root_diameter_worm_gear", k.worm_root, 2),
    direct("wheel", "outer_diameter_worm_wheel", k.wheel_tip, 2),
    direct("wheel", "tip_diameter_worm_gear", k.wheel_throat, 2),
    direct("wheel", "face_width_worm_wheel", k.face_width),
    direct("stage", "center_distance", k.center_distance),
    direct("stage", "center_distance_offset", k.error_distance, given=True),
    direct("stage", "intersection_angle_offset", k.error_horizontal, given=True),
    direct("stage", "inclination_angle_offset", k.error_vertical, given=True),
    direct("stage", "width_offset", k.error_axial, given=True),
    direct("hob", "number_of_teeth", k.hob_threads),
    direct("hob", "pressure_angle_worm_gear", k.hob_pressure_angle),
    direct("hob", "tooth_addendum_worm_wheel_hob", k.hob_tip),
    direct("disc", "grinding_disk_diameter", WHEEL_RADIUS.parameter("worm"), 2),
    direct("disc", "profile_radius_zc_disc", ARC_RADIUS.parameter("worm")),
]
EXCHANGE = Exchange(
    components=(
        Component("stage", "worm_stage"),
        Component("worm", "worm_gear"),
        Component("wheel", "worm_wheel"),
        Component("unit", "gear_unit", beside="stage"),
        Component("shaft_1", "shaft"),
        Component("shaft_2", "shaft"),
        Component("wheel_left", "worm_gear_flank", beside="hob"),
        Component("wheel_right", "worm_gear_flank", beside="hob"),
        Component("hob", "worm_wheel_hob_tool"),
        Component("hob_settings", "worm_gear_manufacturing_settings", beside="hob"),
        Component("worm_left", "worm_gear_flank", beside="disc"),
        Component("worm_right", "worm_gear_flank", beside="disc"),
        Component("disc", "worm_grinding_disc_tool"),
        Component("disc_settings", "worm_gear_manufacturing_settings", beside="disc"),
    ),
    relations=(
        Relation("stage", (("stage", "stage"), ("gear_1", "worm"), ("gear_2", "wheel")), required=True),
        Relation("assembly", (("assembly", "unit"), ("part", "stage"))),
        Relation("assembly", (("assembly", "shaft_1"), ("part", "worm"))),
        Relation("assembly", (("assembly", "shaft_2"), ("part", "wheel"))),
        Relation("assembly", (("assembly", "unit"), ("part", "shaft_1"))),
        Relation("assembly", (("assembly", "unit"), ("part", "shaft_2"))),
        Relation("flank", (("gear", "wheel"), ("left", "wheel_left"), ("right", "wheel_right"))),
        Relation("flank", (("gear", "worm"), ("left", "worm_left"), ("right", "worm_right"))),
        *(
            Relation("manufacturing_step", (("workpiece", f"{gear}_{side}"), ("tool", tool),
                                            ("manufacturing_settings", f"{tool}_settings")))
            for gear, tool in (("wheel", "hob"), ("worm", "disc")) for side in ("left", "right")
        ),
    ),
    attributes=(
        *(written for written, _ in pairs),
        Attribute("worm", "lead_angle_worm_gear", HAND * k.lead_angle.symbol, (k.lead_angle,)),
        Attribute("worm", "lead", 2 * sp.pi * k.p_1, (k.lead_angle,)),
        Attribute("worm", "axial_pitch", sp.pi * m_x, (k.axial_module,)),
        Attribute("worm", "form_factor_worm_gear", 2 * r_1 / m_x, (k.pitch_radius,)),
        Attribute("wheel", "normal_module", m_n, (k.normal_module,)),
        Attribute("wheel", "reference_diameter_worm_gear", 2 * k.r_2, (k.teeth,)),
        Attribute("wheel", "throat_radius_worm_wheel", A - throat, (k.wheel_throat,)),
        Attribute("wheel", "addendum_modification_coefficient_worm_wheel", (A - r_1 - k.r_2) / m_x,
                  (k.center_distance,)),
        Attribute("hob", "tip_diameter_worm_gear", 2 * (r_h + k.hob_tip.symbol), (k.hob_radius,)),
        Attribute("hob", "lead", 2 * sp.pi * k.p_h, (k.hob_radius, k.hob_lead_angle)),
        *shaft_axes(k.shaft_angle, HAND),
    ),
    words=(
        Words("worm", "flank_form", "worm_profile", forms),
        Words("hob", "flank_form", "hob_profile", forms),
        Words("wheel", "flank_form", "hob_profile", forms),
    ),
    readings=(
        *(reading for _, reading in pairs),
        Reading(HAND, sp.sign(lead_angle)),
        Reading(k.lead_angle.symbol, sp.Abs(lead_angle)),
        Reading(k.lead_angle.symbol, sp.atan2(lead, sp.pi * diameter)),
        Reading(k.axial_module.symbol, attribute("worm", "axial_pitch") / sp.pi),
        Reading(k.normal_module.symbol, attribute("wheel", "normal_module")),
        Reading(r_1, attribute("worm", "form_factor_worm_gear") * m_x / 2),
        Reading(k.shaft_angle.symbol, angle_between_shafts()),
        Reading(throat, A - attribute("wheel", "throat_radius_worm_wheel")),
        Reading(r_h, hob_tip / 2 - hob_addendum),
        Reading(r_h, _hob_radius(hob_lead, m_n, T_h), override=True),
        Reading(lam_h, sp.atan2(hob_lead / (2 * sp.pi), r_h), override=True),
        Reading(A, r_1 + k.r_2 + attribute("wheel", "addendum_modification_coefficient_worm_wheel") * m_x),
    ),
    assumptions=(
        Assumption("design.pressure_angle_deg", "REXS does not say whether the pressure angle of a ZA worm is that "
                   "of the normal or of the axial section: taken as normal", {"worm_profile": ["ZA"]}),
        Assumption("design.hob_pressure_angle_deg", "REXS does not say whether the pressure angle of a ZA hob is "
                   "that of the normal or of the axial section: taken as normal", {"hob_profile": ["ZA"]}),
        Assumption("design.grinding_wheel_radius_mm", "REXS has no grinding wheel of a hob: it stands as the "
                   "worm's", {"worm_profile": ["ZA", "ZI", "ZN"]}),
        Assumption("design.hand", "sign assumed: a negative lead angle is a left-hand worm"),
        *(
            Assumption(f"misalignment.{key}", f"sign assumed: {meaning}")
            for key, meaning in (
                ("center_distance_mm", "above zero the wheel is farther from the worm"),
                ("horizontal_deg", "above zero the shaft angle is larger"),
                ("vertical_deg", "above zero the wheel is tilted by +y of its own frame"),
                ("axial_mm", "above zero the wheel is shifted along its own axis"),
            )
        ),
    ),
    doubtful=((r_h, sp.Rational(1, 1000)),),
    defaults=(
        ("flank", "REXS holds both flanks and does not say which one is analysed"),
        ("design.shaft_angle_deg", "no axes of the shafts (u_axis_vector): right angle"),
        ("design.pitch_line_shift_mm", "REXS has no shift of the pitch line"),
    ),
    absent=(
        ("flank", "REXS holds both flanks and does not say which one is analysed"),
        ("design.pitch_line_shift_mm", "REXS has no shift of the pitch line"),
        ("design.cutting_center_distance_mm", "REXS has the hob, not the machine that it runs on"),
        ("design.cutting_shaft_angle_deg", "REXS has the hob, not the machine that it runs on"),
        ("contact.separation_mm", "an assumption of the analysis"),
        ("contact.elastic_allowance_mm", "an assumption of the analysis"),
        ("blank.limits", "the sizes that follow from it are written"),
    ),
)  # fmt: skip
