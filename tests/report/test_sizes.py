"""Misalignments of chosen size, and what a drawing states of the members."""

import numpy as np
import pytest

from meshwright import Drive, cli
from meshwright.contact.results import ARCSEC
from meshwright.report.sensitivity import misalignments, sensitivity
from meshwright.report.tables import drawing


def test_a_misalignment_has_the_size_that_is_chosen():
    """The wheel of spur gears set further apart turns with the same ratio; the size and its unit are named."""
    drive = Drive.load("spherical-table-3-1-concave")
    parameter = next(p for p in misalignments(drive.design) if p["key_unit"] == "mm")
    angles = np.radians([-2.0, 0.0, 2.0])
    effect = sensitivity(drive, parameter, angles, 0.05)
    assert effect.label == "0.05\N{NO-BREAK SPACE}mm"
    moved = drive.with_(misalignment={parameter["key"]: 0.05}).tca(angles)
    assert effect.plus.error == pytest.approx(moved.error, abs=1e-9 * ARCSEC)


@pytest.mark.parametrize(
    ("given", "said"),
    [("vertical", "did you mean vertical_deg?"), ("vertical_deg=much", "KEY=SIZE"), ("vertical_deg=-1", "above zero")],
)
def test_a_misalignment_that_cannot_be_shown_is_bad_input(given, said, capsys):
    given = given if "=" in given else f"{given}=0.1"
    assert cli.main(["report", "spherical-table-3-1-concave", "--misalign", given, "--html", "unwritten.html"]) == 2
    assert said in capsys.readouterr().err


def test_a_drawing_states_each_member_and_both(analysed):
    analysis = analysed("spherical-table-3-1-concave")
    pinion, wheel, both = drawing(analysis).tables
    assert dict(zip((r[3] for r in pinion.rows), (r[1] for r in pinion.rows), strict=True))["pinion_teeth"] == "36"
    stated = {row[3]: row[1] for row in wheel.rows}
    assert (stated["wheel_teeth"], stated["wheel_pitch_radius_mm"]) == ("72", "144")
    assert not set(stated) & {row[3] for row in pinion.rows}
    assert {row[3]: row[1] for row in both.rows}["module_mm"] == "4"
    assert any(row[0].startswith("backlash") for row in both.rows)
