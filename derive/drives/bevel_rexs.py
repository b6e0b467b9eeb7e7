"""Spiral bevel and hypoid gears in REXS 2.0.0: bevel_stage, bevel_gear, tool and machine settings of one flank each."""

from derive.drives import bevel_keys as k
from derive.drives.bevel_keys import GEAR, PINION
from derive.exchange.rexs import (
    Assumption,
    Attribute,
    Component,
    Exchange,
    Reading,
    Relation,
    Without,
    Words,
    attribute,
    direct,
    place,
)

MEMBERS = {"pinion": PINION, "gear": GEAR}
TEETH = {"pinion": k.pinion_teeth, "gear": k.gear_teeth}


def _member(name, m):
    """Attributes and readings of a member's body, tool and machine settings."""
    tool, machine = f"{name}_tool", f"{name}_settings"
    return (
        direct(name, "number_of_teeth", TEETH[name]),
        direct(name, "pitch_angle", m.pitch_angle),
        direct(name, "pitch_apex_beyond_crossing_point", m.pitch_apex),
        direct(name, "face_angle", m.face_angle),
        direct(name, "face_apex_beyond_crossing_point", m.face_apex),
        direct(name, "outer_cone_distance", m.outer_cone_distance),
        direct(name, "face_width", m.face_width),
        direct(tool, "blade_point_radius", m.point_radius),
        direct(tool, "blade_pressure_angle", m.blade_angle),
        direct(tool, "tool_edge_radius_bevel_gear_tool", m.edge_radius, given=True),
        direct(machine, "radial_distance", m.radial),
        direct(machine, "center_roll_position", m.cradle_angle),
        direct(machine, "cutter_tilt", m.tilt),
        direct(machine, "cutter_swivel", m.swivel),
        direct(machine, "machine_root_angle", m.root_angle),
        direct(machine, "work_offset", m.blank_offset),
        direct(machine, "sliding_base", m.sliding_base),
        direct(machine, "machine_center_to_crossing_point", m.center_to_back),
        direct(machine, "ratio_of_roll", m.ratio_of_roll),
    )


def _roll(name, m):
    """Modified roll: the five coefficients in their order."""
    values = tuple(q.symbol for q in m.modified_roll)
    return Attribute(f"{name}_settings", "modified_roll_coefficients", values, m.modified_roll, given=True)


PAIRS = (
    direct("stage", "shaft_angle", k.shaft_angle),
    direct("stage", "hypoid_offset", k.offset),
    direct("stage", "number_of_blade_groups", k.blade_groups, given=True),
    direct("stage", "deviation_of_offset", k.error_offset, given=True),
    direct("stage", "axial_displacement_pinion", k.error_pinion, given=True),
    direct("stage", "axial_displacement_gear", k.error_gear, given=True),
    direct("stage", "deviation_of_shaft_angle", k.error_angle, given=True),
    *(pair for name, m in MEMBERS.items() for pair in _member(name, m)),
)

_MACHINE = "zero and sign assumed: REXS does not define those of machine settings"

EXCHANGE = Exchange(
    components=(
        Component("stage", "bevel_stage"),
        *(Component(name, "bevel_gear") for name in MEMBERS),
        Component("unit", "gear_unit", beside="stage"),
        *(
            component
            for name in MEMBERS
            for component in (
                Component(f"{name}_left", "bevel_gear_flank", beside="stage"),
                Component(f"{name}_right", "bevel_gear_flank", beside="stage"),
                Component(f"{name}_tool", "bevel_gear_tool"),
                Component(f"{name}_settings", "bevel_gear_manufacturing_settings"),
            )
        ),
    ),
    relations=(
        Relation("stage", (("stage", "stage"), ("gear_1", "pinion"), ("gear_2", "gear")), required=True),
        Relation("assembly", (("assembly", "unit"), ("part", "stage"))),
        *(Relation("flank", (("gear", name), *((side, f"{name}_{side}") for side in ("left", "right"))))
          for name in MEMBERS),
        *(Relation("manufacturing_step", (("workpiece", f"{name}_left"), ("tool", f"{name}_tool"),
                                          ("manufacturing_settings", f"{name}_settings"))) for name in MEMBERS),
    ),
    attributes=(*(written for written, _ in PAIRS), *(_roll(name, m) for name, m in MEMBERS.items())),
    words=(
        Words("pinion", "spiral_angle_pitch_direction", "hand", {"left": "left", "right": "right"}),
        Words("gear", "spiral_angle_pitch_direction", "hand", {"left": "right", "right": "left"}),
    ),
    readings=(
        *(reading for _, reading in PAIRS),
        *(Reading(q.symbol, attribute(f"{name}_settings", "modified_roll_coefficients", i))
          for name, m in MEMBERS.items() for i, q in enumerate(m.modified_roll)),
    ),
    assumptions=(
        Assumption("flank", "REXS does not say which of left and right is convex: the settings stand with the left "
                   "flanks of both members"),
        Assumption(place(k.offset), "sign assumed: above zero where the pinion's spiral angle is the larger"),
        *(Assumption(place(q), "sign assumed") for q in (k.error_offset, k.error_pinion, k.error_gear, k.error_angle)),
        *(Assumption(place(q), _MACHINE) for m in MEMBERS.values() for q in (
            m.cradle_angle, m.tilt, m.swivel, m.root_angle, m.blank_offset, m.sliding_base, m.center_to_back,
        )),
        *(Assumption(place(q), "order and factors of the coefficients assumed: 2C, 6D, 24E, 120F, 720G")
          for m in MEMBERS.values() for q in m.modified_roll),
        *(Assumption(place(q), "sign assumed: above zero where the apex lies beyond the crossing point")
          for m in MEMBERS.values() for q in (m.pitch_apex, m.face_apex)),
    ),
    without=(Without("gear.method", "formate", "gear_settings", "ratio_of_roll",
                     "the gear's settings have no ratio of roll: its flank is a copy of its cutter"),),
    absent=(
        ("flank", "REXS holds both flanks and does not say which one is analysed"),
        ("pinion.method", "REXS has no attribute for it: a member with a ratio of roll is generated"),
        ("gear.method", "REXS has no attribute for it: a member with a ratio of roll is generated"),
        *((place(m.blade_offset), "REXS has no attribute for it") for m in MEMBERS.values()),
        *((place(m.helical_motion), "its coefficients have no unit in REXS") for m in MEMBERS.values()),
        (place(k.separation), "an assumption of the analysis"),
    ),
)  # fmt: skip
