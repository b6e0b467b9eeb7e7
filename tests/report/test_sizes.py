"""Misalignments of chosen size, and what a drawing states of the members."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from meshwright import DesignError, Drive, cli
from meshwright.contact.results import ARCSEC
from meshwright.report.figures import pictures
from meshwright.report.findings import findings
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


@pytest.mark.parametrize(
    ("play", "key"), [(-20 * ARCSEC, "misalignment.center_distance_mm larger by"), (20 * ARCSEC, None)]
)
def test_a_drive_that_jams_is_told_which_of_its_own_sizes_give_it_room(analysed, play, key):
    """Spherical gears have no cutting centre distance; theirs are the widths of the cutter and the assembly."""
    analysis = analysed("spherical-table-3-1-concave")
    jammed = replace(analysis, running=replace(analysis.running, backlash=play))
    said = [f.text for f in findings(jammed) if "jams" in f.text]
    assert bool(said) == bool(key)
    assert all(key in text and "half_space_mm smaller by" in text and "cutting" not in text for text in said)


def test_teeth_that_lose_contact_before_the_next_pair_are_a_warning(analysed):
    """Lines of contact of a narrow window: the report has no running pairs there, and says so all the same."""
    drive = Drive.load("spur-profile-shift").with_(blank={"pinion_tip_radius_mm": 18.2})
    analysis = SimpleNamespace(**{**vars(analysed("spherical-table-3-1-concave")), "drive": drive, "running": None})
    assert any(f.kind == "warn" and "Contact ratio 0.380, below 1" in f.text for f in findings(analysis))
    assert not any("below 1" in f.text for f in findings(analysed("spherical-table-3-1-concave")))


def test_a_drawing_states_each_member_and_both(analysed):
    analysis = analysed("spherical-table-3-1-concave")
    pinion, wheel, both = drawing(analysis).tables
    assert dict(zip((r[3] for r in pinion.rows), (r[1] for r in pinion.rows), strict=True))["pinion_teeth"] == "36"
    stated = {row[3]: row[1] for row in wheel.rows}
    assert (stated["wheel_teeth"], stated["wheel_pitch_radius_mm"]) == ("72", "144")
    assert not set(stated) & {row[3] for row in pinion.rows}
    assert {row[3]: row[1] for row in both.rows}["module_mm"] == "4"
    assert any(row[0].startswith("backlash") for row in both.rows)


def test_a_drawing_says_where_each_size_is_from(tmp_path):
    """Of a first design: what was asked for is given, what was proposed assumed, the rest derived by a relation."""
    place = tmp_path / "first.toml"
    words = ["new", "cylindrical-gears", "--m", "2", "--z", "20:45", "--set", "design.face_width_mm=15"]
    assert cli.main([*words, "--out", str(place)]) == 0
    shown = SimpleNamespace(drive=Drive.load(place), teeth={"wheel": 45}, running=None)
    *members, checks = drawing(shown).tables
    rows = {row[3]: row for table in members for row in table.rows}
    assert rows["pinion_teeth"][5] == "given" and rows["face_width_mm"][5] == "given"
    assert rows["pinion_lead_crowning_um"][5:] == ("assumed", "proposed, not given")
    assert rows["pinion_span_mm"][4:6] == ("W_k_pinion", "derived") and "inv" not in rows["pinion_span_mm"][6]
    assert ("undercut pinion", "does not occur") in {row[:2] for row in checks.rows}
    listed = shown.drive.with_(design={"normal_backlash_mm": 0.1}, assumed=["design.normal_backlash_mm"])
    assert listed.drawing().sizes["normal_backlash_mm"].provenance == "given"  # what is changed is taken off the list
    changed = shown.drive.with_(design={"pinion_lead_crowning_um": 6.0})
    assert changed.drawing().sizes["pinion_lead_crowning_um"].provenance == "given"


@pytest.mark.parametrize("listed", ["design.face_width_mm", ["design.face_width"], ["drive.r"], [3], [[]]])
def test_a_list_of_what_is_assumed_that_names_no_key_is_bad_input(listed):
    with pytest.raises(DesignError, match="assumed"):
        Drive.load("helical-crowned").with_(assumed=listed)


def test_a_grinding_wheel_is_no_part_of_the_wheel():
    """A key belongs to a member whose word begins or ends it: the tool of a ground worm is named after neither."""
    tables = drawing(SimpleNamespace(drive=Drive.load("zk-zn-45"), teeth={"wheel": 29}, running=None)).tables
    assert any("wheel_teeth" in {row[3] for row in table.rows} for table in tables)
    assert not any("grinding" in row[3] for table in tables for row in table.rows)


def test_a_report_under_load_shows_what_was_solved_and_says_what_was_not(analysed):
    """One angle carries on two pairs, another has no figures: one point on either curve, and a sentence."""
    line = {member: [[70.0, 0.0, -2.0], [70.0, 0.0, 2.0]] for member in ("pinion", "wheel")}
    pairs = [
        {"pairs_later": 0, "share": 0.75, "peak_pressure_mpa": 900.0, "line_mm": line},
        {"pairs_later": 1, "share": 0.25, "peak_pressure_mpa": 500.0, "line_mm": line},
    ]
    points = [
        {"pinion_angle_deg": 1.0, "message": "", "loaded_transmission_error_arcsec": -20.0, "pairs": pairs},
        {"pinion_angle_deg": 2.0, "message": "no tooth pair touches at this angle", "pairs": []},
    ]
    document = {"torque_nm": 200.0, "torque_on": "pinion", "points": points}
    analysis = replace(analysed("spherical-table-3-1-concave"), loaded=document)
    (picture,) = (p for p in pictures(analysis) if p.name == "loaded")
    assert picture.title == "Under 200 N m on the pinion"
    error, share, pressure = picture.figure(analysis).axes
    assert [line.get_ydata()[0] for line in error.lines] == [-20.0]
    assert np.isnan([line.get_ydata()[1] for axes in (error, share, pressure) for line in axes.lines]).all()
    assert [line.get_ydata()[0] for line in share.lines] == [0.75, 0.25]
    assert [line.get_ydata()[0] for line in pressure.lines] == [900.0, 500.0]
    (lines,) = (p for p in pictures(analysis) if p.name == "loaded-lines-wheel")
    (axes,) = lines.figure(analysis).axes
    wide, narrow = (drawn.get_linewidth() for drawn in axes.lines[:2])
    assert wide > 1.5 * narrow and axes.get_aspect() == 1.0
    assert any("at 1 of 2 angles: no tooth pair touches" in finding.text for finding in findings(analysis))


def test_a_member_without_a_torque_is_bad_input(capsys):
    assert cli.main(["report", "spherical-table-3-1-concave", "--torque-on", "wheel", "--html", "unwritten.html"]) == 2
    assert "--torque-nm" in capsys.readouterr().err
