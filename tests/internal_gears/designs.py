"""Designs of internal gear pairs for tests."""

import math


def tables(design, misalignment=None, flank="left", blank=None):
    """A design of module 2, 20° and a face of 20 mm unless ``design`` says otherwise."""
    common = {"normal_module_mm": 2.0, "pressure_angle_deg": 20.0, "face_width_mm": 20.0}
    return {
        "drive": "internal-gears", "flank": flank, "design": common | design, "misalignment": misalignment or {},
        "blank": blank or {},
    }  # fmt: skip


def random_pair(rng, modified=True):
    """A sound pair: helix, profile shifts, allowances; and modifications of the pinion with misalignments."""

    def between(a, b):
        return float(rng.uniform(a, b))

    module, z_1 = between(0.5, 8.0), int(rng.integers(18, 40))
    z_2 = z_1 + int(rng.integers(18, 60))
    beta, shift = between(-25.0, 25.0), (between(0.0, 0.4), between(-0.2, 0.2))
    design = {
        "normal_module_mm": module, "pressure_angle_deg": between(18.0, 24.0), "pinion_teeth": z_1, "wheel_teeth": -z_2,
        "pinion_helix_angle_deg": beta, "face_width_mm": between(6.0, 12.0) * module,
        "pinion_profile_shift_coefficient": shift[0], "wheel_profile_shift_coefficient": shift[1],
        "pinion_thickness_allowance_um": -between(0.0, 20.0) * module,
        "wheel_thickness_allowance_um": -between(0.0, 20.0) * module,
    }  # fmt: skip
    flank = str(rng.choice(["left", "right"]))
    if not modified:
        return tables(design, flank=flank)
    reference = module * (z_2 - z_1) / 2 / math.cos(math.radians(beta))
    design |= {
        "center_distance_mm": reference - sum(shift) * module * between(0.95, 1.0),
        "basic_rack_rounding_mm": between(0.1, 0.25) * module,
        "pinion_profile_crowning_um": between(1.0, 10.0) * module,
        "pinion_lead_crowning_um": between(3.0, 15.0) * module,
        "pinion_profile_slope_um": between(-5.0, 5.0) * module, "pinion_lead_slope_um": between(-5.0, 5.0) * module,
        "pinion_flank_twist_um": between(-3.0, 3.0) * module,
    }  # fmt: skip
    errors = {
        "center_distance_mm": between(-0.02, 0.02) * module, "horizontal_deg": between(-0.03, 0.03),
        "vertical_deg": between(-0.03, 0.03), "axial_mm": between(-0.1, 0.1) * module,
    }  # fmt: skip
    return tables(design, errors, flank)
