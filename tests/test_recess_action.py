"""The recess-action worm drive against its paper's Table 2 (Chen and Tsay 2011)."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.contact.results import ARCSEC

# Half a unit of the last printed digit, and a little for its rounding.
LENGTH_MM = 6e-5
ANGLE_DEG = 6e-5
KINEMATIC_ERROR_ARCSEC = 1e-4


def _rows(reference):
    table = reference("recess-action-worm")["table_2"]
    corrected = {(*m["row"], m["column"]): m["corrected"] for m in table["misprints"]}
    for row in table["rows"]:
        entries = dict(zip(table["columns"], row, strict=True))
        for column in entries:
            entries[column] = corrected.get((entries["type"], entries["phi_worm_deg"], column), entries[column])
        yield entries


@pytest.mark.parametrize("proportions", ["standard", "semi", "full"])
def test_every_row_of_table_2_comes_out_with_the_implied_hob_radius(reference, proportions):
    rows = [row for row in _rows(reference) if row["type"] == proportions]
    result = Drive.load(f"recess-action-{proportions}").tca(np.radians([row["phi_worm_deg"] for row in rows]))
    assert result.status == ("converged",) * 5
    for k, row in enumerate(rows):
        assert result.unknowns["t_worm"][k] == pytest.approx(row["l_worm_mm"], abs=LENGTH_MM)
        assert result.unknowns["t_hob"][k] == pytest.approx(row["l_hob_mm"], abs=LENGTH_MM)
        # the paper turns its helicoids the other way: theta = -psi
        assert -np.degrees(result.unknowns["psi_worm"][k]) == pytest.approx(row["theta_worm_deg"], abs=ANGLE_DEG)
        assert -np.degrees(result.unknowns["psi_hob"][k]) == pytest.approx(row["theta_hob_deg"], abs=ANGLE_DEG)
        assert np.degrees(result.wheel_angles[k]) == pytest.approx(row["phi2_deg"], abs=ANGLE_DEG)
        error = result.relative_error[k] / ARCSEC
        assert error == pytest.approx(row["ke_arcsec"], abs=KINEMATIC_ERROR_ARCSEC)


def test_the_printed_hob_radius_misses_the_published_kinematic_error_by_six_percent(reference):
    row = next(r for r in _rows(reference) if r["type"] == "full" and r["phi_worm_deg"] == 2000)
    result = Drive.load("recess-action-full-printed-hob").tca(np.radians([2000.0]))
    assert result.relative_error[0] / ARCSEC / row["ke_arcsec"] == pytest.approx(0.94, abs=0.005)


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
