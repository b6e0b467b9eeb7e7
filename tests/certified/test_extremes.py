"""Errors of lines, edges and corners are enclosed: closed forms and explicit involutes lie between the bounds."""

import json
import math

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.contact.results import ARCSEC
from meshwright.cycle import certified_lines
from meshwright.cycle.certified_extreme import enclosed_extremes
from meshwright.cycle.certified_line import LINE, Posed, certified_line
from meshwright.design import design as designs
from tests.cycle.test_plain_pairs import EDGES, c14, h17, involutes
from tests.quick import quick


def bounds_of(drive, *degrees):
    result = drive.tca(np.radians(degrees))
    return result, enclosed_extremes(drive, result).bounds / ARCSEC


@pytest.mark.parametrize("name", quick(EDGES, "spur, axes inclined", "helical, lead slope, at a tip"))
def test_the_error_on_an_edge_is_enclosed(name):
    made, degrees, expected, *_ = EDGES[name]
    _, ((low, high),) = bounds_of(made(), degrees)
    assert low <= expected <= high and high - low < 0.02


@pytest.mark.parametrize("flank", ["left", "right"])
def test_the_error_of_a_line_is_enclosed(flank):
    """That of a spur pair moved apart, to the other side on the other flank."""
    drive = c14(center_distance_mm=91.7).with_(flank=flank)
    _, ((low, high),) = bounds_of(drive, 4.0)
    expected = -312.1622890 if flank == "left" else 312.1622890
    assert low <= expected + 1e-7 and expected - 1e-7 <= high and high - low < 1e-3


def equal_hob():
    worm = Drive.load("plain-zi")
    worm = worm.with_(design={"hob_pitch_radius_mm": worm.design.as_solved()["design"]["worm_pitch_radius_mm"]})
    return worm.with_(design={"cutting_center_distance_mm": worm.design.value("center_distance_mm")})


def spur_error(distance="91.7"):
    """TE = −(1 + z1/z2)(inv α_w′ − inv α_w) of C14, right-hand sense of its left flank, rad, to 50 digits."""
    with mpmath.workdps(60):
        m, alpha, z1, z2 = mpmath.mpf("4.5"), mpmath.radians(20), 16, 24
        working = mpmath.acos(m * (z1 + z2) / 2 * mpmath.cos(alpha) / mpmath.mpf(distance))
        shifts = mpmath.mpf("0.1817") + mpmath.mpf("0.1715")
        without_play = mpmath.tan(alpha) - alpha + 2 * shifts / (z1 + z2) * mpmath.tan(alpha)
        return -(1 + mpmath.mpf(z1) / z2) * (mpmath.tan(working) - working - without_play)


def test_the_error_of_a_spur_line_lies_between_bounds_to_fifty_digits():
    _, ((low, high),) = bounds_of(c14(center_distance_mm=91.7), 4.0)
    with mpmath.workdps(60):
        assert mpmath.mpf(low) * mpmath.mpf(ARCSEC) < spur_error() < mpmath.mpf(high) * mpmath.mpf(ARCSEC)
    assert high - low < 1e-5


def crown_pair():
    return Drive.load("bevel-crown-pair")


@pytest.mark.parametrize(("made", "degrees"), [(h17, 0.0), (equal_hob, 10.0), (crown_pair, 10.0)])
def test_conjugate_flanks_have_no_error_and_lie_in_one_another_all_along_a_line(made, degrees):
    """Helical gears, a wheel cut by the worm's equal and gears cut by one crown gear; two of them left-handed."""
    drive = made()
    result = drive.tca(np.radians([degrees]))
    found = drive.certify_extremes(np.radians([degrees]), result)
    low, high = found.bounds[0] / ARCSEC
    assert result.status == ("line_contact",) and low <= 0.0 <= high and high - low < 2e-5
    line = found.lines[0]
    assert line.shown and -LINE <= line.apart[0] <= 0.0 <= line.apart[1] <= LINE and line.ended == (True, True)


def posed(drive, degrees):
    """Flanks for proofs at an angle, the line there, its wheel angle and a place."""
    angles = np.radians([degrees])
    (line,) = drive.tca(angles).lines
    ends = np.array([-20.0, 20.0] * 4)
    place = line.unknowns(drive)[len(line.points) // 2]
    return Posed(drive, angles[0], ends), line, drive.ratio * angles[0] + line.middle.wheel_turn, place


def test_a_wheel_turned_back_stands_apart_by_that_all_along_the_line():
    drive = h17()
    at, line, wheel, place = posed(drive, 0.0)
    sense = drive.first_contact([0.0]).levers[0]
    for arc in (1e-6, -1e-6):
        turned = wheel + math.copysign(arc / 22.0, sense * arc)
        found = certified_line(at, turned, place, [line], 22.0)
        assert found.reason == "wide"
    radius = 22.0
    shifted = certified_line(at, wheel + math.copysign(5e-10 / radius, sense), place, [line], radius)
    assert shifted.apart[0] <= 5e-10 <= shifted.apart[1] and shifted.apart[1] - shifted.apart[0] < 2e-10


def test_crowned_flanks_lie_on_no_line():
    """By 1 µm at either end of the face; where a plain pair would touch."""
    crowned, (_, line, wheel, place) = c14(pinion_lead_crowning_um=1.0), posed(c14(), 4.0)
    at, *_ = posed(c14(), 4.0)
    found = certified_line(Posed(crowned, at.angle, at.ends), wheel, place, [line], 55.0)
    assert not found.shown and found.plain()["outcome"] == "unknown" and found.reason in ("wide", "effort")


@pytest.mark.validate
def test_what_is_shown_of_every_angle_holds_the_closed_form_and_what_is_not_is_said(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(certified_lines, "BUDGET", 1_500)
    monkeypatch.setattr(certified_lines, "LONGEST", 1 / 40)
    monkeypatch.setattr(certified_lines, "SAMPLES", 2)
    path = tmp_path / "c14.toml"
    path.write_text(designs.toml_text(c14(center_distance_mm=91.7).design.given()))
    assert main(["ratio", str(path), "--certify", "--json", "-"]) == 0
    found = json.loads(capsys.readouterr().out)["certificate"]
    expected = float(spur_error() / ARCSEC)
    low, high = found["transmission_error_arcsec"]
    assert found["outcome"] == "enclosed" and low <= expected <= high and high - low < 0.01
    assert found["held_deg"] and {gap["reason"] for gap in found["gaps"]} <= {"effort", "no_line", "off_flank"}
    assert found["pair_peak_to_peak_arcsec"][0] == 0.0
    for at in found["at_angles"]:
        if at["transmission_error_arcsec"]:
            assert at["transmission_error_arcsec"][0] <= expected <= at["transmission_error_arcsec"][1]
    covered = sorted(found["held_deg"] + [gap["pinion_angle_deg"] for gap in found["gaps"]])
    assert all(before[1] == pytest.approx(after[0]) for before, after in zip(covered, covered[1:], strict=False))


def test_a_range_of_angles_at_which_the_wheel_stands_elsewhere_is_not_shown():
    drive = c14(center_distance_mm=91.7)
    asked = certified_lines._Asked.of(drive, 0.0, 0.1)  # noqa: SLF001
    expected, piece, spans = float(spur_error()), asked._piece, []  # noqa: SLF001
    for arc in (0.0, 3e-6, -3e-6):

        def turned(begin, end, arc=arc):
            made = piece(begin, end)
            made.x[drive.design.description["error"]].c[0] += arc / 50.0
            return made

        asked._piece = turned  # noqa: SLF001
        spans.append(asked.span(0.05, 0.06))
    assert not spans[0].reason and spans[1].reason + spans[2].reason == "elsewhere_first"
    assert all(span.reason or span.low < expected < span.high for span in spans)


@pytest.mark.validate
def test_errors_past_the_segment_are_enclosed_or_unknown():
    drive = c14()
    angles = np.arange(17.0, 24.0, 0.5)
    _, bounds = bounds_of(drive, *angles)
    known = np.isfinite(bounds).all(axis=1)
    assert known.sum() > len(angles) // 2
    pair = involutes(drive)
    for angle, (low, high) in zip(angles[known], bounds[known], strict=True):
        assert low - 1e-6 <= pair.error(math.radians(angle))[0] / ARCSEC <= high + 1e-6


@pytest.mark.validate
def test_a_table_of_lines_and_edges_is_certified(tmp_path, capsys):
    path = tmp_path / "c14.toml"
    path.write_text(designs.toml_text(c14().design.given()))
    assert main(["tca", str(path), "--phi-deg=-5,0,20", "--certify"]) == 0
    assert "enclosed: the error of 3 contacts" in capsys.readouterr().out
    assert main(["tca", str(path), "--phi-deg=-5,0,20", "--certify", "--json", "-"]) == 0
    for point in json.loads(capsys.readouterr().out)["points"]:
        low, high = point["certificate"]["transmission_error_arcsec"]
        assert low <= point["transmission_error_arcsec"] <= high and point["certificate"]["outcome"] == "enclosed"
