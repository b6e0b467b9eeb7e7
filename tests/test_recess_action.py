"""The recess-action worm drive against its paper's Table 2 (Chen and Tsay 2011)."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.contact.results import ARCSEC
from tests.published import published_rows, solved_rows, table


@pytest.fixture(scope="module")
def rows():
    """Those of the table, its misprints corrected."""
    found, misprints = published_rows()
    for (*row, column), corrected in misprints.items():
        next(r for r in found if [r["type"], r["phi_worm_deg"]] == row)[column] = corrected
    return found


def test_every_row_of_table_2_comes_out_with_the_implied_hob_radius(rows):
    """To half a unit of the last printed digit, and a little for its rounding."""
    solved = solved_rows(rows, "")
    assert len(rows) == 15 and np.isfinite([[*ours.values()] for ours in solved]).all()
    _, worst = table(rows, solved, {})
    assert worst.pop("ke_arcsec") < 1e-4
    assert all(difference < 6e-5 for difference in worst.values())


def test_the_printed_hob_radius_misses_the_published_kinematic_error_by_six_percent(rows):
    (row,) = [r for r in rows if r["type"] == "full" and r["phi_worm_deg"] == 2000]
    (ours,) = solved_rows([row], "-printed-hob")
    assert ours["ke_arcsec"] / row["ke_arcsec"] == pytest.approx(0.94, abs=0.005)


def test_a_hob_equal_to_the_worm_gives_line_contact_and_no_transmission_error():
    drive = Drive.load("recess-action-full")
    equal = drive.design.as_solved()["design"]["worm_pitch_radius_mm"]
    result = drive.with_(design={"hob_pitch_radius_mm": equal}).tca(np.radians([0.0, 700.0, 2000.0]))
    assert result.status == ("line_contact",) * 3
    assert np.abs(result.error / ARCSEC).max() < 1e-9
    assert np.isnan(result.points).all()


def test_an_undersize_hob_interferes():
    result = Drive.load("recess-action-full").with_(design={"hob_pitch_radius_mm": 18.9}).tca(np.radians([1000.0]))
    assert "interference" in result.flags[0]
    assert not result.complete


@pytest.mark.parametrize("flank", ["right", "left"])
def test_both_backends_agree(flank):
    errors = {"center_distance_mm": -0.1, "vertical_deg": 0.05, "horizontal_deg": -0.05, "axial_mm": 0.02}
    angles = np.radians([-900.0, -200.0, 300.0, 1000.0])
    results = []
    for backend in ("c", "casadi"):
        drive = Drive.load("recess-action-standard", backend).with_(flank=flank, misalignment=errors)
        results.append(drive.tca(angles))
    first, second = results
    assert first.status == second.status == ("converged",) * 4
    assert np.abs(first.wheel_angles - second.wheel_angles).max() < 1e-12
    # near line contact the point along the major axis is known to round-off times the Jacobian's condition
    assert np.abs(first.points - second.points).max() < 1e-9
