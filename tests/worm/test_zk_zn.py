"""ZK worm with a ZN-hobbed wheel: what the conference paper claims, and what holds."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.contact.results import ARCSEC
from tests.worm.designs import packaged


@pytest.mark.parametrize("shaft_angle", [30, 45, 60])
def test_transmission_error_is_constant_not_zero_and_contact_stays_at_one_radius(shaft_angle):
    result = Drive.load(f"zk-zn-{shaft_angle}").tca(np.radians(np.arange(-120.0, 141.0, 10.0)))
    assert set(result.status) == {"converged"}
    assert np.allclose(result.error / ARCSEC, 133.65, atol=0.005)
    assert np.abs(result.relative_error / ARCSEC).max() < 1e-8
    radius = np.hypot(*result.points[:, :2].T)
    assert np.ptp(radius) < 1e-10


@pytest.mark.parametrize("wheel_radius", [45.0, 60.0, 100.0, 250.0, 400.0])
def test_the_constant_hardly_depends_on_the_grinding_wheel(wheel_radius):
    drive = Drive.from_tables(packaged("zk-zn-45", design__grinding_wheel_radius_mm=wheel_radius))
    result = drive.tca(np.radians([-60.0, 0.0, 60.0]))
    assert np.allclose(result.error / ARCSEC, 133.65, atol=0.0055)
    assert np.abs(result.relative_error / ARCSEC).max() < 1e-8


def test_the_pitch_radius_printed_for_the_wheel_is_that_of_45_degrees(reference):
    rows = {row["quantity"]: row for row in reference("zk-zn-worm")["table_1"]["rows"]}
    sizes = {angle: Drive.load(f"zk-zn-{angle}").design.sizes for angle in (30, 45, 60, 90)}
    printed, tolerance = rows["pitch radius"]["wheel"], rows["pitch radius"]["tolerance"]
    fits = [angle for angle, size in sizes.items() if abs(size["wheel_pitch_radius_mm"] - printed) < tolerance]
    assert fits == [45]
    helix = {angle: size["wheel_helix_angle_deg"] for angle, size in sizes.items()}
    assert helix[30] > 0 and helix[45] > 0 and helix[60] == pytest.approx(0, abs=1e-12) and helix[90] < 0


def test_printed_contact_ratios_are_the_printed_windows_over_a_pitch_cut_off_after_three_digits(reference):
    table = reference("zk-zn-worm")["table_2"]
    pitch = np.degrees(Drive.load("zk-zn-45").pitch())
    for row in table["rows"]:
        entry = dict(zip(table["columns"], row, strict=True))
        ratio = (entry["end_deg"] - entry["begin_deg"]) / pitch
        assert np.floor(ratio * 1000 + 1e-9) / 1000 == pytest.approx(entry["cr"], abs=1e-12)


def test_at_right_angles_the_constant_branch_turns_back_at_a_pitchfork():
    (point,) = Drive.load("zk-zn-90").limits().branch_points
    assert point.kind == "pitchfork"
    assert np.degrees(point.angle) == pytest.approx(4.832354, abs=1e-6)


def test_beyond_the_pitchfork_the_error_falls_and_the_published_zero_is_impossible():
    before, after = Drive.load("zk-zn-90").tca(np.radians([4.8, 60.0])).relative_error / ARCSEC
    assert abs(before) < 1e-8
    assert after < -100.0


def test_branch_points_of_the_other_flank_are_its_half_turn():
    (point,) = Drive.from_tables(packaged("zk-zn-90", flank="left")).limits().branch_points
    assert np.degrees(point.angle) == pytest.approx(-4.832354, abs=1e-6)


@pytest.mark.parametrize("shaft_angle", [30, 45, 60])
def test_below_right_angles_the_constant_branch_does_not_turn_back(shaft_angle):
    assert all(point.kind == "crossing" for point in Drive.load(f"zk-zn-{shaft_angle}").limits().branch_points)
