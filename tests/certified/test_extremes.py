"""Errors of lines, edges and corners are enclosed: closed forms and explicit involutes lie between the bounds."""

import json
import math

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.contact.results import ARCSEC
from meshwright.cycle.certified_extreme import enclosed_extremes
from meshwright.design import design as designs
from tests.cycle.test_plain_pairs import EDGES, c14, involutes
from tests.quick import quick


def bounds_of(drive, *degrees):
    result = drive.tca(np.radians(degrees))
    return result, enclosed_extremes(drive, result) / ARCSEC


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


def test_errors_of_left_handed_bevel_gears_and_of_an_equal_hob_are_enclosed():
    """Both are conjugate: their error is 0."""
    worm = Drive.load("plain-zi")
    worm = worm.with_(design={"hob_pitch_radius_mm": worm.design.as_solved()["design"]["worm_pitch_radius_mm"]})
    worm = worm.with_(design={"cutting_center_distance_mm": worm.design.value("center_distance_mm")})
    for drive in (Drive.load("bevel-crown-pair"), worm):
        result, ((low, high),) = bounds_of(drive, 10.0)
        assert result.status == ("line_contact",)
        assert low <= 0.0 <= high and high - low < 1e-3


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


def test_a_table_of_lines_and_edges_is_certified(tmp_path, capsys):
    path = tmp_path / "c14.toml"
    path.write_text(designs.toml_text(c14().design.given()))
    assert main(["tca", str(path), "--phi-deg=-5,0,20", "--certify"]) == 0
    assert "enclosed: the error of 3 contacts" in capsys.readouterr().out
    assert main(["tca", str(path), "--phi-deg=-5,0,20", "--certify", "--json", "-"]) == 0
    for point in json.loads(capsys.readouterr().out)["points"]:
        low, high = point["certificate"]["transmission_error_arcsec"]
        assert low <= point["transmission_error_arcsec"] <= high and point["certificate"]["outcome"] == "enclosed"
