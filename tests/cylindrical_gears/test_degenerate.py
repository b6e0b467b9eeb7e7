"""Degenerate, extreme and bad designs: every one has an answer."""

import math

import numpy as np
import pytest

from meshwright import DesignError, Drive
from tests.cylindrical_gears.designs import ARCSEC, tables
from tests.independent.cylindrical_gears import pair_of

PAIR = {"pinion_teeth": 20, "wheel_teeth": 40}
HELICAL = {**PAIR, "pinion_helix_angle_deg": 15.0}
CROSSED = {**PAIR, "pinion_helix_angle_deg": 30.0, "wheel_helix_angle_deg": 20.0}
ANGLES = np.radians([-5.0, 0.0, 5.0])


def solved(design, errors=None, angles=ANGLES):
    return Drive.from_tables(tables(design, errors)).tca(angles)


@pytest.mark.parametrize("errors", [{"vertical_deg": 0.05}, {"horizontal_deg": -0.05}])
@pytest.mark.parametrize("design", [PAIR, HELICAL])
def test_unmodified_parallel_gears_that_are_tilted_touch_at_the_end_of_a_face(design, errors):
    found = solved(design, errors)
    assert set(found.status) == {"edge_contact"}
    assert all("face of the" in text or "face)" in text for text in found.messages)
    assert np.abs(np.abs(found.points[:, 2]) - 10.0).max() < 0.1


def test_profile_modifications_alone_leave_a_spur_pair_its_line():
    """Status line_contact, with the transmission error of the planar problem: −s E/r_b2, to second order in E."""
    found = solved({**PAIR, "pinion_profile_crowning_um": 0.5})
    assert set(found.status) == {"line_contact"}
    drive = Drive.from_tables(tables(PAIR))
    sizes, solution = drive.design.sizes, drive.tca(ANGLES).solutions
    start, end = sizes["pinion_edge_start_mm"], sizes["pinion_edge_end_mm"]
    depth = 0.0005 * ((2.0 * solution[:, 0] - end - start) / (end - start)) ** 2
    assert found.error == pytest.approx(-depth / sizes["wheel_base_radius_mm"], rel=5e-3, abs=1e-5 * ARCSEC)


@pytest.mark.parametrize("given", [{"center_distance_mm": 84.0}, {}])
def test_base_circles_that_overlap_have_no_contact(given):
    errors = {} if given else {"center_distance_mm": -6.0}
    assert set(solved({**PAIR, **given}, errors).status) == {"no_contact"}


@pytest.mark.parametrize("shaft", [1e-6, 1e-4, 1e-2, 0.1])
def test_a_crowned_pair_on_nearly_parallel_axes_goes_over_into_the_parallel_one(shaft):
    crowned = {**HELICAL, "pinion_lead_crowning_um": 10.0, "wheel_profile_crowning_um": 6.0}
    parallel, crossed = solved(crowned), solved({**crowned, "wheel_helix_angle_deg": -15.0 + shaft})
    assert set(crossed.status) == {"converged"}
    assert crossed.error == pytest.approx(parallel.error, abs=max(1e-6, 2.0 * shaft) * ARCSEC)
    assert crossed.unknowns["z_pinion"] == pytest.approx(parallel.unknowns["z_pinion"], abs=max(1e-4, shaft))


def test_an_unmodified_pair_leaves_its_face_as_the_axes_become_parallel():
    """With x1 + x2 ≠ 0 the line of contact misses the common perpendicular by an amount ∝ 1/sin Σ."""
    design = {**PAIR, "pinion_helix_angle_deg": 15.0, "pinion_profile_shift_coefficient": 0.3}
    places = []
    for shaft in (2.0, 1.0):
        found = solved({**design, "wheel_helix_angle_deg": -15.0 + shaft})
        assert set(found.status) == {"converged"}
        assert all("off_face" in flags for flags in found.flags)
        places.append(np.abs(found.unknowns["z_pinion"]).min())
    assert places[1] / places[0] == pytest.approx(2.0, rel=0.05)


def test_another_shaft_angle_has_another_working_pressure_angle():
    for shaft in (49.0, 50.0, 51.5):
        design = {**CROSSED, "shaft_angle_deg": shaft}
        drive = Drive.from_tables(tables(design))
        working = math.radians(drive.design.sizes["normal_working_pressure_angle_deg"])
        normal = pair_of(drive.design.tables).common_normal()
        assert working == pytest.approx(math.asin(normal[0]), abs=1e-12)
        assert np.abs(drive.tca(ANGLES).error).max() < 1e-9 * ARCSEC
        assert (abs(math.degrees(working) - 20.0) < 1e-9) == (shaft == 50.0)


def test_negative_crowning_is_interference():
    found = solved({**HELICAL, "pinion_lead_crowning_um": -10.0})
    assert all("interference" in flags for flags in found.flags)
    assert (found.curvatures[:, 0] < 0.0).all()


@pytest.mark.parametrize(
    ("design", "blank", "words"),
    [
        ({"pinion_teeth": 0}, {}, ("pinion_teeth", "0", "greater than 0")),
        ({"pinion_teeth": 12.5}, {}, ("pinion_teeth", "12.5", "whole number")),
        ({"normal_module_mm": 0.0}, {}, ("normal_module_mm", "greater than 0")),
        ({"pressure_angle_deg": 90.0}, {}, ("pressure_angle_deg", "less than 90")),
        ({"pinion_helix_angle_deg": 90.0}, {}, ("pinion_helix_angle_deg", "less than 90")),
        ({"shaft_angle_deg": 180.0}, {}, ("shaft_angle_deg", "less than 180")),
        ({"face_width_mm": -1.0}, {}, ("face_width_mm", "greater than 0")),
        ({"relief_exponent": 4}, {}, ("relief_exponent", "less than 4")),
        ({"pinion_helix_angle_deg": 10.0, "wheel_helix_angle_deg": -9.0, "shaft_angle_deg": 0.0}, {},
         ("pinion_helix_angle_deg", "opposite hand", "wheel_helix_angle_deg", "shaft_angle_deg")),
        ({"pinion_helix_angle_deg": 40.0, "wheel_helix_angle_deg": 40.0, "shaft_angle_deg": 20.0}, {},
         ("no common normal", "pinion_helix_angle_deg", "shaft_angle_deg")),
        ({"pinion_tip_relief_um": 10.0}, {}, ("pinion_tip_relief_radius_mm", "radius at which it begins")),
        ({"wheel_root_relief_um": 10.0}, {}, ("wheel_root_relief_radius_mm", "radius at which it begins")),
        ({"pinion_tip_relief_um": 10.0, "pinion_tip_relief_radius_mm": 34.0}, {},
         ("pinion_tip_relief_radius_mm", "34", "below the tip")),
        ({"pinion_root_relief_um": 10.0, "pinion_root_relief_radius_mm": 28.2}, {},
         ("pinion_root_relief_radius_mm", "28.2", "above the start")),
        ({}, {"pinion_tip_radius_mm": 28.0}, ("pinion_tip_radius_mm", "28", "base circle")),
        ({}, {"pinion_tip_radius_mm": 37.0}, ("pinion_tip_radius_mm", "37", "point")),
        ({"pinion_teeth": 8, "pinion_profile_shift_coefficient": 0.9}, {}, ("pinion", "point")),
        ({"pinion_profile_shift_coefficient": 2.0}, {}, ("pinion_profile_shift_coefficient", "2.0", "point")),
        ({"basic_rack_rounding_mm": 2.0}, {}, ("basic_rack_rounding_mm", "2", "fully round")),
        ({"basic_rack_dedendum_mm": 9.0}, {}, ("basic_rack_", "9")),
        ({"pinion_profile_shift_coefficient": -0.9, "wheel_profile_shift_coefficient": -1.9}, {},
         ("pinion_profile_shift_coefficient", "-0.9", "without backlash")),
        ({"hand": "left"}, {}, ("hand", "unknown key")),
    ],
)  # fmt: skip
def test_bad_designs_are_refused_with_key_value_reason_and_remedy(design, blank, words):
    with pytest.raises(DesignError) as caught:
        Drive.from_tables(tables({**PAIR, **design}, blank=blank))
    for word in words:
        assert word in str(caught.value)
