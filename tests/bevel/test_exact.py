"""Conjugate and crowned pairs whose contact is known in closed form: the crown gear and its modifications."""

from math import atan2, degrees

import numpy as np
import pytest

from meshwright import Drive
from tests.bevel.exact import crown_pair, formate_cradle

ARCSEC = np.pi / 648000
HANDS = [(flank, hand) for flank in ("convex", "concave") for hand in ("left", "right")]


def path(drive, reach_deg=8.0, points=9):
    """Tooth contact analysis about the middle of the path."""
    middle = drive.design.reference_angle * (-1 if drive.design.mirrored else 1)
    return drive.tca(middle + np.radians(np.linspace(-reach_deg, reach_deg, points)))


@pytest.mark.parametrize(("flank", "hand"), HANDS)
def test_a_pair_cut_by_one_crown_gear_touches_along_lines_and_runs_true(flank, hand):
    found = path(Drive.from_tables(crown_pair(flank, hand=hand)))
    assert set(found.status) == {"line_contact"}
    assert np.abs(found.error).max() < 1e-9 * ARCSEC


@pytest.mark.parametrize(("flank", "hand"), HANDS)
@pytest.mark.parametrize(
    "crowned", [{"lengthwise": 2.0}, {"profile": 0.002}, {"lengthwise": 0.3, "shaft_deg": 75.0, "teeth": (13, 40)}]
)
def test_crowning_in_one_direction_makes_points_without_error(flank, hand, crowned):
    drive = Drive.from_tables(crown_pair(flank, hand=hand, **crowned))
    found = path(drive)
    assert set(found.status) == {"converged"}
    assert np.abs(found.error).max() < 1e-9 * ARCSEC
    assert (found.curvatures[:, 0] > 0).all()
    fixed = ("theta_pinion", "theta_gear") if "lengthwise" in crowned else ("u_pinion", "u_gear")
    for name in fixed:
        assert np.ptp(found.unknowns[name]) < 1e-9
    assert not any("undercut" in flags for flags in found.flags)


@pytest.mark.parametrize(("flank", "hand"), HANDS)
def test_crowned_both_ways_the_gear_lags_on_both_sides(flank, hand):
    found = path(Drive.from_tables(crown_pair(flank, hand=hand, lengthwise=2.0, profile=0.002)), points=17)
    drives = (1 if flank == "convex" else -1) * (1 if hand == "left" else -1)
    error = drives * found.error
    assert error.argmax() not in (0, len(error) - 1)
    assert np.ptp(error) > ARCSEC
    assert (np.diff(error, 2) < 0).all()


@pytest.mark.parametrize(("flank", "hand"), HANDS)
@pytest.mark.parametrize("offset", [0.0, 15.0, 30.0, -10.0])
def test_a_pinion_that_rolls_with_its_formate_gear_runs_true_at_any_offset(flank, hand, offset):
    cone = degrees(atan2(41, 11)) if offset == 0 else 72.0
    drive = Drive.from_tables(formate_cradle(flank, hand=hand, offset=offset, gear_pitch_deg=cone))
    found = path(drive, reach_deg=5.0)
    assert set(found.status) == {"converged"}
    assert np.abs(found.error).max() < 1e-9 * ARCSEC
    assert np.ptp(found.unknowns["theta_gear"]) < 1e-9
    assert (found.curvatures > 0).all()


def test_the_other_hand_is_the_mirror_image():
    left = Drive.from_tables(crown_pair(lengthwise=2.0, profile=0.002))
    right = Drive.from_tables(crown_pair(lengthwise=2.0, profile=0.002, hand="right"))
    errors = {"offset_mm": 0.05, "pinion_axial_mm": -0.04, "gear_axial_mm": 0.03, "shaft_angle_deg": 0.02}
    angles = np.linspace(-0.15, 0.15, 5)
    a = left.with_(misalignment=errors).tca(angles)
    b = right.with_(misalignment=errors).tca(-angles)
    np.testing.assert_allclose(b.error, -a.error, atol=1e-15)
    np.testing.assert_allclose(b.points, a.points * [1, -1, 1], atol=1e-12)
    np.testing.assert_allclose(b.curvatures, a.curvatures, rtol=1e-9)
