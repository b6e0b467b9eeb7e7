"""Designs of every family that REXS has, as raw tables, and their way through a REXS file."""

import math

from meshwright.design import design as designs
from meshwright.rexs.document import parsed
from meshwright.rexs.reading import design_of
from meshwright.rexs.writing import file_of

FORMS = ("ZA", "ZI", "ZN", "ZK", "ZC")


def worm_pair(worm, hob):
    """A worm drive of these flank forms; its numbers differ from pair to pair."""
    n = 5 * FORMS.index(worm) + FORMS.index(hob)
    design = {
        "worm_threads": 1 + n % 4,
        "wheel_teeth": 29 + 2 * n,
        "pressure_angle_deg": 15.0 + n / 3,
        "shaft_angle_deg": 90.0 if n % 3 else 75.3,
        "hob_pitch_radius_mm": 31.7 + n / 7,
        "hob_pressure_angle_deg": 15.1 + n / 3,
        "center_distance_mm": 155.5 + n * math.pi,
        "worm_profile": worm,
        "hob_profile": hob,
        "hand": "left" if n % 2 else "right",
    }
    design |= {"normal_module_mm": 2.1 + n / 11} if n % 2 else {"axial_module_mm": 2.3 + n / 13}
    design |= {"worm_lead_angle_deg": 4.4 + n / 3} if n % 3 else {"worm_pitch_radius_mm": 28.8 + n / 9}
    if {worm, hob} & {"ZK", "ZC"}:
        design["grinding_wheel_radius_mm"] = 151.3 + n
    if "ZC" in (worm, hob):
        design["profile_arc_radius_mm"] = 33.3 + n
    blank = {
        "wheel_tip_radius_mm": 131.1 + n, "wheel_throat_radius_mm": 127.7, "wheel_face_width_mm": 40.4 + n,
        "worm_tip_radius_mm": 33.9, "worm_root_radius_mm": 25.2,
    }  # fmt: skip
    if n % 5:
        blank["hob_tip_addendum_mm"] = 5.3
    misalignment = {"center_distance_mm": 0.02, "horizontal_deg": -0.03, "vertical_deg": 0.04, "axial_mm": -0.05}
    return {
        "drive": "cylindrical-worm", "name": f"{worm} worm, {hob} hob", "flank": "right", "design": design,
        "misalignment": misalignment, "blank": blank,
    }  # fmt: skip


HELICAL = {
    "drive": "cylindrical-gears", "name": "helical <pair> & co.", "flank": "left",
    "design": {
        "normal_module_mm": 2.5, "pressure_angle_deg": 17.5, "pinion_teeth": 23, "wheel_teeth": 41,
        "pinion_helix_angle_deg": 22.3, "wheel_helix_angle_deg": -22.3, "pinion_profile_shift_coefficient": 0.21,
        "wheel_profile_shift_coefficient": -0.13, "face_width_mm": 24.0, "pinion_face_width_mm": 26.0,
        "center_distance_mm": 88.1, "basic_rack_dedendum_mm": 3.3,
    },
    "blank": {"pinion_tip_radius_mm": 34.1, "wheel_tip_radius_mm": 57.3},
}  # fmt: skip

CROSSED = {
    "drive": "cylindrical-gears", "name": "crossed", "flank": "left",
    "design": {
        "normal_module_mm": 1.1, "pressure_angle_deg": 20.0, "pinion_teeth": 17, "wheel_teeth": 23,
        "pinion_helix_angle_deg": -45.0, "wheel_helix_angle_deg": -40.0, "face_width_mm": 12.0,
        "center_distance_mm": 31.3,
    },
}  # fmt: skip



def bevel_pair(name, gear, hand, **design):
    """A bevel pair whose numbers are all different."""
    pinion = {
        "point_radius_mm": 74.25, "blade_angle_deg": 18.05, "edge_radius_mm": 0.7, "radial_setting_mm": 74.87,
        "cradle_angle_deg": 63.94, "tilt_deg": 1.5, "swivel_deg": -21.7, "root_angle_deg": 16.87,
        "blank_offset_mm": 3.93, "sliding_base_mm": -0.29, "center_to_back_mm": 1.02, "ratio_of_roll": 3.243,
        "roll_2c": 0.01, "roll_6d": -0.02, "pitch_angle_deg": 18.43, "pitch_apex_mm": 0.11, "face_angle_deg": 20.1,
        "face_apex_mm": -0.12, "outer_cone_distance_mm": 82.05, "face_width_mm": 25.4,
    }  # fmt: skip
    return {
        "drive": "bevel", "name": name, "flank": "convex",
        "design": {
            "pinion_teeth": 12, "gear_teeth": 36, "shaft_angle_deg": 87.5, "offset_mm": 12.7, "hand": hand, **design,
        },
        "pinion": pinion,
        "gear": {
            "point_radius_mm": 77.03, "blade_angle_deg": 22.0, "radial_setting_mm": 72.64, "cradle_angle_deg": 59.23,
            "root_angle_deg": 67.68, "pitch_angle_deg": 71.57, "face_angle_deg": 72.9,
            "outer_cone_distance_mm": 82.15, "face_width_mm": 25.5, **gear,
        },
        "misalignment": {"offset_mm": 0.01, "pinion_axial_mm": 0.02, "gear_axial_mm": -0.03, "shaft_angle_deg": 0.04},
    }  # fmt: skip


GENERATED = bevel_pair("hypoid, generated gear", {"ratio_of_roll": 1.0517}, "left")
FORMATE = bevel_pair("hypoid, Formate gear", {"method": "formate"}, "right")
HOBBED = bevel_pair("hypoid, face-hobbed", {"ratio_of_roll": 1.0517}, "left", blade_groups=13)

WORM_PAIRS = [worm_pair(worm, hob) for worm in FORMS for hob in FORMS]
PAIRS = [*WORM_PAIRS, HELICAL, CROSSED, GENERATED, FORMATE, HOBBED]


def named(tables):
    return tables["name"]


def file_text(tables):
    """The design as a new file."""
    return file_of(tables, "0").content.decode()


def read_text(text, stage=None):
    """What a file with this text says."""
    return design_of(parsed(text.encode(), "FILE.rexs"), stage)


def complete(tables):
    """All parameters of a design by symbol."""
    return designs.by_rules(tables)[1]
