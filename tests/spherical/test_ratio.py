"""Contact ratio of spherical gears: the spur gear's formula, and what ends contact."""

import math

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from meshwright.cycle.pairs import Mesh
from tests.independent.spherical import spur_contact_ratio


@pytest.mark.parametrize(("angle", "value"), [(20.0, 1.752024), (25.0, 1.534052)])
@pytest.mark.parametrize("wheel", ["convex", "concave", "spur"])
@pytest.mark.parametrize("flank", ["left", "right"])
def test_contact_ratio_of_table_3_1(wheel, flank, angle, value):
    drive = Drive.load(f"spherical-table-3-1-{wheel}").with_(flank=flank, design={"pressure_angle_deg": angle})
    ratio = Mesh.of(drive).contact_ratio
    assert ratio == pytest.approx(value, abs=5e-7)
    assert ratio == pytest.approx(float(spur_contact_ratio(4, 36, 72, mpmath.radians(angle), 4)), abs=1e-10)


def test_contact_ratio_is_the_spur_formula_for_any_design(pair):
    rng = np.random.default_rng(31)
    for _ in range(12):
        module, teeth, angle = 10 ** rng.uniform(-1, 1.5), rng.integers(30, 120, 2), rng.uniform(18, 27)
        drive = pair(
            "convex", ("convex", "spur")[rng.integers(2)], module_mm=module, pressure_angle_deg=angle,
            pinion_teeth=int(teeth[0]), wheel_teeth=int(teeth[1]), face_width_mm=2 * module,
            pinion_sphere_radius_mm=rng.uniform(10, 100) * module,
        )  # fmt: skip
        expected = spur_contact_ratio(module, *map(int, teeth), mpmath.radians(angle), module)
        assert Mesh.of(drive).contact_ratio == pytest.approx(float(expected), abs=1e-10)


@pytest.mark.parametrize("flank", ["left", "right"])
def test_contact_runs_from_the_tip_of_the_wheel_to_that_of_the_pinion(flank):
    window = Mesh.of(Drive.load("spherical-table-3-1-concave").with_(flank=flank)).window
    assert (window.begin.reason, window.begin.member) == ("tip", "wheel")
    assert (window.end.reason, window.end.member) == ("tip", "pinion")
    assert (window.begin.angle < window.end.angle) == (flank == "left")


def test_the_straight_part_of_the_cutter_can_limit_contact_instead():
    drive = Drive.load("spherical-table-3-1-concave").with_(contact={"limit": "cutter"})
    alpha = math.radians(20)
    expected = 2 * 4 / (math.pi * 4 * math.sin(alpha) * math.cos(alpha))
    mesh = Mesh.of(drive)
    assert mesh.contact_ratio == pytest.approx(expected, abs=1e-10)
    assert {mesh.window.begin.reason, mesh.window.end.reason} <= {"root", "tool_end"}


def test_errors_of_assembly_leave_the_contact_ratio_close_to_ideal():
    drive = Drive.load("spherical-table-3-1-concave")
    for errors in ({"vertical_deg": 2.0}, {"horizontal_deg": 0.5}, {"center_distance_mm": 0.1}):
        assert Mesh.of(drive.with_(misalignment=errors)).contact_ratio == pytest.approx(1.752, abs=0.03)


def test_undercut_ends_contact_where_it_comes_first(pair):
    drive = pair("convex", "spur", pressure_angle_deg=14.5, pinion_teeth=12, pinion_sphere_radius_mm=24.0)
    begin = Mesh.of(drive).window.begin
    assert (begin.reason, begin.member) == ("undercut", "pinion")
