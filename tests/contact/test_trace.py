"""A trace stays on its tooth pair, however far apart the angles are."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.library import library, text
from meshwright.contact import analysis


@pytest.mark.parametrize("name", ["recess-action-full", "spherical-table-3-1-concave", "face-worm-conical-convex"])
def test_a_trace_in_whole_pitches_follows_one_pair(name):
    """A pitch away stands the contact of the neighbouring pair, an exact solution with an error of a tooth."""
    drive = Drive.load(name)
    whole = np.arange(-1, 3) * drive.pitch()
    fine = drive.tca(np.linspace(whole[0], whole[-1], 49))
    coarse = drive.tca(whole)
    assert coarse.error == pytest.approx(fine.error[::16], abs=1e-12)
    assert coarse.points == pytest.approx(fine.points[::16], abs=1e-8, nan_ok=True)


@pytest.mark.parametrize("name", ["recess-action-full", "spherical-table-2-3", "face-worm-conical-convex"])
def test_an_angle_out_of_range_is_bad_input_and_its_neighbours_are_not(name):
    drive = Drive.load(name)
    angles = np.array([0.0, 0.01, np.nan, 0.02, np.inf, -1e300, 1.1e12, 10_000.1, -9e11, 0.03])
    x, records = analysis.trace(drive, angles)
    out = ~(np.abs(angles) <= 1e12)
    assert {text(library().mw_status_word(code)) for code in records["status"][out]} == {"bad_input"}
    away = ~out & (np.abs(angles) > 1.0)
    assert {text(library().mw_status_word(code)) for code in records["status"][away]} == {"no_contact"}
    out |= away
    assert not records["guard"].any() and np.isnan(x[out]).all()
    alone, statuses = analysis.trace(drive, angles[~out])
    assert x[~out] == pytest.approx(alone, abs=1e-11)
    assert (statuses["status"] >= 0).all() and (records["status"][~out] >= 0).all()


@pytest.mark.parametrize("name", ["recess-action-full", "helical-crowned", "bevel-hypoid", "face-worm-conical-convex"])
def test_close_points_that_share_a_jacobian_are_the_solutions_of_each_alone(name):
    """Their steps use the inverse of an earlier Jacobian, and leave no more than round-off does."""
    drive = Drive.load(name)
    error, middle = drive.design.description["error"], drive.design.reference_angle
    angles = middle + np.linspace(-0.02, 0.02, 2001) * drive.pitch()
    x, records = analysis.trace(drive, angles)
    assert (records["status"] == 0).all()
    for k in range(7, len(angles), 150):
        alone, _ = drive.trace([angles[k]])
        assert x[k] == pytest.approx(alone[0], abs=1e-11)
        assert x[k, error] == pytest.approx(alone[0, error], abs=3e-15)
