"""Deviations read back: slope and form of every trace, pitch of an eccentric wheel."""

import json
import math

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.shop.measured import measured
from meshwright.shop.nominal import nominal
from meshwright.shop.tables import csv_text


def test_slopes_across_and_along_the_tooth_come_back():
    """A spur flank with 3 µm from tip to root and 2 µm over 18 mm of face: slopes, no form, totals their sums."""
    gears = Drive.load("spur-profile-shift")
    points = nominal(gears, "wheel", (5, 4), 0.05)
    along = points.points[:, 2]
    points.deviations[:] = 2e-3 * along / 18.0
    (flank,) = measured(gears, "wheel", points).flanks
    for length, trace in flank.lead:
        assert length == pytest.approx(18.0, abs=1e-9)
        assert (trace.total, trace.slope, trace.form) == pytest.approx((2e-3, 2e-3, 0.0), abs=1e-12)
    for _, trace in flank.profile:
        assert (trace.total, trace.slope, trace.form) == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)
    assert flank.map == pytest.approx(points.deviations.reshape(5, 4))


def test_pitch_of_an_eccentric_wheel(tmp_path, capsys):
    """A wheel off its axis by e along x: δ = e n_x; at one radius F_p nears 2e / cos of the pressure angle there."""
    gears, e = Drive.load("spur-profile-shift"), 0.01
    points = nominal(gears, "wheel", (3, 3), 0.05, teeth=tuple(range(1, 25)))
    points.deviations[:] = e * points.normals[:, 0]
    found = measured(gears, "wheel", points)
    ((radius, pitch),) = found.pitch.values()
    middle = (points.i == 1) & (points.j == 1)
    assert radius == pytest.approx(np.hypot(*points.points[middle][0][:2]))
    base = 36.0 * math.cos(math.radians(20.0))
    # turn = δ / (± r_b), so that the arcs are a sine of amplitude e·radius/r_b sampled at 24 teeth
    turns = e * points.normals[middle, 0] * radius / base
    assert pitch.total == pytest.approx(np.ptp(turns), rel=1e-9)
    assert 2 * e * radius / base * math.cos(math.pi / 24) <= pitch.total <= 2 * e * radius / base * (1 + 1e-12)
    assert pitch.single.sum() == pytest.approx(0.0, abs=1e-12)
    (tmp_path / "m.csv").write_text(csv_text(points, {}))
    arguments = ["measured", "spur-profile-shift", "--member", "wheel", "--measured", str(tmp_path / "m.csv")]
    assert main([*arguments, "--json", "-"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["schema"] == "meshwright.measured/1" and len(document["flanks"]) == 24
    assert document["pitch"][0]["total_cumulative_um"] == pytest.approx(1e3 * pitch.total)
    assert main(arguments) == 0
    assert "total cumulative" in capsys.readouterr().out


def test_a_file_without_deviations_or_of_another_design_is_refused(tmp_path, capsys):
    gears = Drive.load("spur-profile-shift")
    points = nominal(gears, "wheel", (3, 3), 0.05)
    (tmp_path / "m.csv").write_text(csv_text(points, {}))
    arguments = ["measured", "spur-profile-shift", "--member", "wheel", "--measured", str(tmp_path / "m.csv")]
    assert main(arguments) == 2
    assert "deviation_um is empty" in capsys.readouterr().err
    points.deviations[:] = 0.0
    (tmp_path / "m.csv").write_text(csv_text(points, {}))
    assert main([*arguments, "--set", "design.wheel_profile_shift_coefficient=0.3"]) == 2
    assert "off the flank" in capsys.readouterr().err
