"""What drawings of worm drives state: backlash by the thread's thickness, and worms given by quotient and shift.

Values: ISO/TR 10828 in closed form (m_x 5, 1:50, q 9, ZI 20°, normal backlash 0.1: j_x = j_n/(cos γ cos α)).
"""

import math
import tomllib

import numpy as np
import pytest

from meshwright import DesignError, Drive
from meshwright.cli import main
from tests.quick import quick

ARCSEC = math.radians(1 / 3600)
THINNED = "--m 5 --z 1:50 --set design.worm_diameter_quotient=9 --set design.hob_pitch_radius_mm=22.5"


def first(tmp_path, words):
    """The design that `new` writes."""
    path = tmp_path / "first.toml"
    assert main(["new", "cylindrical-worm", *words.split(), "--out", str(path)]) == 0
    return path


def test_backlash_by_the_thread_keeps_the_line_of_an_equal_hob(tmp_path):
    drive = Drive.load(first(tmp_path, f"{THINNED} --set design.normal_backlash_mm=0.1"))
    sizes = drive.drawing().sizes
    assert sizes["axial_backlash_mm"].value == pytest.approx(0.107072662, abs=1e-9)
    assert sizes["worm_axial_thread_thickness_mm"].value == pytest.approx(7.746908972, abs=1e-9)
    assert sizes["wheel_backlash_deg"].value * 3600 == pytest.approx(176.682575, abs=1e-6)
    right, left = (drive.with_(flank=flank).tca(np.radians([0.0, 40.0, 123.0])) for flank in ("right", "left"))
    assert {*right.status, *left.status} == {"line_contact"}
    assert (left.error - right.error) / ARCSEC == pytest.approx([176.682575] * 3, abs=1e-6)


@pytest.mark.parametrize("form", quick(["ZI", "ZK", "ZA", "ZN"], "ZI", "ZN"))
def test_the_standard_wheel_of_an_equal_hob_can_be_started(tmp_path, capsys, form):
    """The backlash of `new`, 0.02 modules, is taken off the thread: the cutting distance stays that of the pair."""
    path = first(tmp_path, f"--m 4 --z 2:40 --a 100 --profile {form} --set design.hob_pitch_radius_mm=20")
    assert "the flanks touch along a line" in capsys.readouterr().out
    design = tomllib.loads(path.read_text(encoding="utf-8"))["design"]
    assert design["cutting_center_distance_mm"] == design["center_distance_mm"] == 100.0
    assert design["cutting_shaft_angle_deg"] == 90.0
    sizes = Drive.load(path).drawing().sizes
    assert sizes["normal_backlash_mm"].value == pytest.approx(0.08, abs=1e-4)


WORM = {
    "worm_threads": 2, "wheel_teeth": 41, "axial_module_mm": 4.0, "pressure_angle_deg": 20.0, "worm_profile": "ZI",
}  # fmt: skip


def worm(**design):
    kept = {key: value for key, value in (WORM | design).items() if value is not None}
    return Drive.from_tables({"drive": "cylindrical-worm", "design": kept})


@pytest.mark.parametrize("given", [
    {"worm_diameter_quotient": 10.0}, {"worm_pitch_diameter_mm": 40.0}, {"worm_pitch_diameter_in": 40 / 25.4},
    {"axial_module_mm": None, "axial_pitch_mm": 4 * math.pi, "worm_pitch_radius_mm": 20.0},
    {"axial_module_mm": None, "lead_worm_mm": 8 * math.pi, "worm_diameter_quotient": 10.0},
    {"wheel_profile_shift_coefficient": 0.5, "center_distance_mm": 104.0},
    {"worm_diameter_quotient": 10.0, "worm_lead_angle_deg": None, "wheel_pitch_diameter_mm": 164.0},
])  # fmt: skip
def test_a_worm_may_be_given_by_other_sizes_of_its_drawing(given):
    design = worm(**given).design
    assert design.value("worm_pitch_radius_mm") == pytest.approx(20.0, abs=1e-9)
    assert design.value("axial_module_mm") == pytest.approx(4.0, abs=1e-9)
    assert design.value("worm_lead_angle_deg") == pytest.approx(math.atan(0.2), abs=1e-12)


def test_the_profile_shift_of_the_wheel_gives_the_centre_distance():
    """ISO/TR 10828: a = r1 + m_x z2/2 + x2 m_x."""
    design = worm(worm_diameter_quotient=10.0, wheel_profile_shift_coefficient=-0.25).design
    assert design.value("center_distance_mm") == pytest.approx(20 + 82 - 1, abs=1e-9)


@pytest.mark.parametrize(("given", "named"), [
    ({"worm_diameter_quotient": 10.0, "worm_pitch_radius_mm": 21.0}, ("quotient = 10", "radius_mm = 21")),
    ({"worm_diameter_quotient": 10.0, "wheel_profile_shift_coefficient": 0.5, "center_distance_mm": 100.0},
     ("coefficient = 0.5", "center_distance_mm = 100")),
    ({"worm_diameter_quotient": 10.0, "normal_backlash_mm": 0.1, "worm_thickness_allowance_um": -50.0},
     ("normal_backlash_mm = 0.1", "allowance_um = -50")),
    ({"worm_diameter_quotient": 10.0, "axial_pitch_mm": 12.0}, ("axial_module_mm = 4", "axial_pitch_mm = 12")),
])  # fmt: skip
def test_sizes_of_a_worm_that_contradict_are_both_named(given, named):
    with pytest.raises(DesignError, match="contradicts") as caught:
        worm(**given)
    assert all(words in str(caught.value) for words in named)


def test_a_lead_angle_of_two_decimals_agrees_with_the_quotient():
    assert worm(worm_lead_angle_deg=11.31, worm_diameter_quotient=10.0).design.value("axial_module_mm") == 4.0
