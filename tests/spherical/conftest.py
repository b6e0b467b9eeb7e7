"""Designs and the independent formulation, shared by the tests of spherical gears."""

import pytest

from meshwright import Drive


def tables(pinion_form, wheel_form, /, **changes):
    """Table 3.1 with these forms; ``changes`` replace keys of [design], ``flank`` and ``misalignment``."""
    flank = changes.pop("flank", "left")
    misalignment = changes.pop("misalignment", {})
    design = {
        "module_mm": 4.0, "pinion_teeth": 36, "wheel_teeth": 72, "pressure_angle_deg": 20.0,
        "pinion_form": pinion_form, "wheel_form": wheel_form, "face_width_mm": 15.0,
        "pinion_sphere_radius_mm": 72.0, "wheel_sphere_radius_mm": 144.0,
    }  # fmt: skip
    design |= changes
    for member in ("pinion", "wheel"):
        if design[f"{member}_form"] == "spur" and f"{member}_sphere_radius_mm" not in changes:
            design.pop(f"{member}_sphere_radius_mm")
    return {"drive": "spherical", "flank": flank, "design": design, "misalignment": misalignment}


@pytest.fixture
def pair():
    """``pair(pinion_form, wheel_form, **changes)`` → :class:`~meshwright.Drive`."""
    return lambda *forms, **changes: Drive.from_tables(tables(*forms, **changes))
