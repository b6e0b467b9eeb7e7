"""A flank with any number of conditions: the same one, described with one and with two, is as without."""

import numpy as np
import pytest

from tests.outside.folder import Commands, derived

pytestmark = pytest.mark.validate

DESIGN = """
drive = "{family}"
[design]
normal_module_mm = 2.0
pressure_angle_deg = 20.0
pinion_teeth = 20
wheel_teeth = 30
pinion_helix_angle_deg = 50.0
wheel_helix_angle_deg = 35.0
face_width_mm = 30.0
[misalignment]
center_distance_mm = 0.1
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("drives")
    derived("crossed_helicoids", made)
    return derived("more_conditions", made)


@pytest.fixture
def of_family(folder, tmp_path):
    def commands(family):
        design = tmp_path / f"{family}.toml"
        design.write_text(DESIGN.format(family=family), encoding="utf-8")
        return Commands(folder, design)

    return commands


@pytest.mark.parametrize("family", ["one-condition", "two-conditions"])
def test_results_do_not_depend_on_the_number_of_conditions(of_family, family, tmp_path):
    plain, described = of_family("crossed-helicoids"), of_family(family)
    angles = ("--phi-deg", "-20,-5,0,5,12")
    one, other = (of.json("tca", *angles)["points"] for of in (plain, described))
    for a, b in zip(one, other, strict=True):
        assert b["contact_point_mm"] == pytest.approx(a["contact_point_mm"], abs=1e-9)
        assert b["first_contact"]["kind"] == a["first_contact"]["kind"]
        assert b["first_contact"]["point_mm"] == pytest.approx(a["first_contact"]["point_mm"], abs=1e-6)
    one, other = (of.json("ratio")["contact_ratio"] for of in (plain, described))
    assert other == pytest.approx(one, abs=1e-9)
    grid = ("surface", "--member", "pinion", "--grid", "5x7")
    grids = [np.array(of.json(*grid)["points_mm"], dtype=float) for of in (plain, described)]
    assert grids[1] == pytest.approx(grids[0], abs=1e-3)
    described("report", "--html", tmp_path / "page.html")
    described("limits")
