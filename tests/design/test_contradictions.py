"""Two sizes of a drawing that contradict each other are refused, whatever the family, and both are named."""

import random
import re

import pytest

from meshwright import DesignError, Drive
from tests.quick import quick


def gears(draw):
    teeth, module = draw.randint(18, 40), draw.choice([2, 3, 5])
    design = {"pinion_teeth": teeth, "wheel_teeth": draw.randint(teeth, 100), "normal_module_mm": module}
    design |= {"helix_angle_deg": draw.choice([0.0, 12.0, 25.0]), "face_width_mm": 30.0, "pressure_angle_deg": 20.0}
    return "cylindrical-gears", design | {"pinion_thickness_allowance_um": -40.0, "wheel_thickness_allowance_um": -50.0}


def worms(draw):
    design = {"worm_threads": draw.randint(1, 4), "wheel_teeth": draw.randint(30, 60), "pressure_angle_deg": 20.0}
    module, quotient = draw.choice([2.0, 4.0, 5.0]), draw.choice([9.0, 10.0, 12.5])
    design |= {"axial_module_mm": module, "worm_diameter_quotient": quotient}
    return "cylindrical-worm", design | {
        "worm_profile": draw.choice(["ZI", "ZA", "ZN"]), "wheel_profile_shift_coefficient": 0.1,
        "worm_thickness_allowance_um": -60.0,
    }


def bevels(draw):
    teeth = draw.randint(10, 20)
    gear = draw.randint(2 * teeth, 5 * teeth)
    design = {"pinion_teeth": teeth, "gear_teeth": gear, "outer_transverse_module_mm": 4.0}
    design |= {"face_width_mm": 4.0 + gear / 2, "cutter_radius_mm": 2.2 * gear}
    return "bevel", design | {"offset_mm": draw.choice([0.0, 0.4 * gear])}


@pytest.mark.parametrize("seed", quick(range(70), 0))
@pytest.mark.parametrize("family", [gears, worms, bevels])
def test_a_second_value_that_contradicts_is_refused_with_both_keys(family, seed):
    """Any size that follows from those given, with another value; one that follows from what is assumed is taken."""
    draw = random.Random(seed)
    drive, design = family(draw)
    document = {"drive": drive, "design": design}
    stated = Drive.from_tables(document).drawing().sizes
    follows = [key for key, size in stated.items() if size.provenance == "derived" and isinstance(size.value, float)
               and size.relation.count("=") == 1 and size.table in ("design", "blank", "pinion", "gear")
               and abs(size.value) > 1e-3 and key.endswith(("_mm", "_um", "_deg", "_coefficient"))]  # fmt: skip
    key = draw.choice(follows)
    name, value = key.rpartition(".")[2], stated[key].value * 1.02
    table = stated[key].table
    document[table] = document.get(table, {}) | {name: value}
    try:
        assert Drive.from_tables(document).drawing().sizes[key].value == pytest.approx(value, rel=1e-12)
    except DesignError as refused:
        named = set(re.findall(r"(?:design|blank|pinion|gear)\.\w+", str(refused)))
        assert f"{table}.{name}" in named and len(named) > 1, (key, refused)
