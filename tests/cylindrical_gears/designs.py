"""Designs of cylindrical gears for tests."""

import math

ARCSEC = math.pi / 648000


def tables(design, misalignment=None, flank="left", blank=None):
    """A design of module 3, 20° and a face of 20 mm unless ``design`` says otherwise."""
    common = {"normal_module_mm": 3.0, "pressure_angle_deg": 20.0, "face_width_mm": 20.0}
    return {
        "drive": "cylindrical-gears",
        "flank": flank,
        "design": common | design,
        "misalignment": misalignment or {},
        "blank": blank or {},
    }


def random_modified(rng):
    """A pair on parallel or crossed axes with every modification, profile shift and misalignment."""
    def between(a, b):
        return float(rng.uniform(a, b))

    module, crossed = between(0.5, 8.0), rng.random() < 0.5
    helix = [between(-40.0, 40.0)]
    helix.append(between(max(-40.0, 12.0 - helix[0]), 40.0) if crossed and helix[0] > -25.0 else -helix[0])
    shaft = sum(helix) + (between(-1.0, 1.0) if helix[0] != -helix[1] else 0.0)
    teeth, shift = (int(rng.integers(14, 50)), int(rng.integers(20, 90))), (between(0.0, 0.5), between(-0.2, 0.3))
    radii = [module * z / 2 / math.cos(math.radians(b)) for z, b in zip(teeth, helix, strict=True)]
    design = {
        "normal_module_mm": module, "pressure_angle_deg": between(16.0, 24.0), "shaft_angle_deg": shaft,
        "face_width_mm": between(6.0, 12.0) * module, "basic_rack_rounding_mm": between(0.1, 0.25) * module,
        "center_distance_mm": sum(radii) + (sum(shift) + between(0.0, 0.05)) * module,
        "relief_exponent": int(rng.integers(2, 4)),
    }  # fmt: skip
    for name, z, b, x, r in zip(("pinion", "wheel"), teeth, helix, shift, radii, strict=True):
        design |= {
            f"{name}_teeth": z, f"{name}_helix_angle_deg": b, f"{name}_profile_shift_coefficient": x,
            f"{name}_profile_crowning_um": between(1.0, 10.0) * module,
            f"{name}_profile_slope_um": between(-5.0, 5.0) * module,
            f"{name}_lead_crowning_um": between(3.0, 15.0) * module,
            f"{name}_lead_slope_um": between(-5.0, 5.0) * module,
            f"{name}_flank_twist_um": between(-3.0, 3.0) * module,
            f"{name}_tip_relief_um": between(0.0, 15.0) * module,
            f"{name}_tip_relief_radius_mm": r + (x + between(0.2, 0.7)) * module,
            f"{name}_root_relief_um": between(0.0, 15.0) * module,
            f"{name}_root_relief_radius_mm": r + (x - between(0.2, 0.4)) * module,
        }  # fmt: skip
    errors = {
        "center_distance_mm": between(-0.02, 0.02) * module, "horizontal_deg": between(-0.05, 0.05),
        "vertical_deg": between(-0.05, 0.05), "axial_mm": between(-0.1, 0.1) * module,
    }  # fmt: skip
    return tables(design, errors, str(rng.choice(["left", "right"])))
