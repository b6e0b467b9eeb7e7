"""Designs whose flanks touch along lines, as tables of a design file, and drives of them."""

from meshwright import Drive

_STEEL = {"youngs_modulus_mpa": 206000.0, "poisson_ratio": 0.3}

#: FZG type C gears, face width 14 mm, without modifications (ISO 14635).
FZG_C14_TABLES = {
    "drive": "cylindrical-gears",
    "flank": "left",
    "design": {
        "normal_module_mm": 4.5,
        "pressure_angle_deg": 20.0,
        "pinion_teeth": 16,
        "wheel_teeth": 24,
        "pinion_helix_angle_deg": 0.0,
        "wheel_helix_angle_deg": 0.0,
        "pinion_profile_shift_coefficient": 0.1817,
        "wheel_profile_shift_coefficient": 0.1715,
        "face_width_mm": 14.0,
    },
    "blank": {"pinion_tip_radius_mm": 41.31765, "wheel_tip_radius_mm": 59.27175},
    "material": _STEEL,
}

#: A helical pair without modifications.
H501_TABLES = {
    "drive": "cylindrical-gears",
    "flank": "left",
    "design": {
        "normal_module_mm": 3.5,
        "pressure_angle_deg": 20.0,
        "pinion_teeth": 20,
        "wheel_teeth": 30,
        "pinion_helix_angle_deg": 15.0,
        "wheel_helix_angle_deg": -15.0,
        "pinion_profile_shift_coefficient": 0.1809,
        "wheel_profile_shift_coefficient": 0.0891,
        "face_width_mm": 14.0,
    },
    "blank": {"pinion_tip_radius_mm": 40.336, "wheel_tip_radius_mm": 58.132},
    "material": _STEEL,
}

#: A worm of form ZI whose wheel is cut by a hob of its own size.
EQUAL_HOB_TABLES = {
    "drive": "cylindrical-worm",
    "flank": "right",
    "design": {
        "worm_profile": "ZI",
        "axial_module_mm": 4.0,
        "worm_threads": 2,
        "wheel_teeth": 40,
        "shaft_angle_deg": 90.0,
        "worm_pitch_radius_mm": 20.0,
        "pressure_angle_deg": 20.0,
        "center_distance_mm": 100.0,
        "hob_threads": 2,
        "cutting_center_distance_mm": 100.0,
        "cutting_shaft_angle_deg": 90.0,
        "hob_pitch_radius_mm": 20.0,
    },
    "blank": {
        "worm_tip_radius_mm": 24.0,
        "worm_root_radius_mm": 15.2,
        "wheel_throat_radius_mm": 84.0,
        "wheel_tip_radius_mm": 86.0,
        "wheel_face_width_mm": 24.0,
        "hob_tip_addendum_mm": 4.8,
        "hob_tip_rounding_mm": 0.8,
    },
    "material": _STEEL,
}

FZG_C14, H501, EQUAL_HOB = map(Drive.from_tables, (FZG_C14_TABLES, H501_TABLES, EQUAL_HOB_TABLES))
