"""As-measured flanks in contact: no deviation is the nominal drive, another design's difference is that design."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.errors import UsageError
from meshwright.cli import main
from meshwright.contact.results import ARCSEC
from meshwright.shop.as_measured import AsMeasured
from meshwright.shop.located import along, located
from meshwright.shop.nominal import nominal
from meshwright.shop.spline import Knots
from meshwright.shop.tables import csv_text

ANGLES = np.radians([-50.0, -10.0, 0.0, 40.0])


def _points(drive, member, lines, deviation, margin=0.02):
    points = nominal(drive, member, lines, margin)
    return replace(points, deviations=deviation(points))


def _difference(drive, other, member, lines):
    """Deviations of another design's flank, along the nominal normals."""

    def deviation(points):
        found = located(drive, member, points)
        return along(other.flank(member), found.parameters[0], found.rays[0])[1]

    return _points(drive, member, lines, deviation, 0.0)


@pytest.mark.parametrize("count", [2, 3, 4, 9])
def test_splines_hold_what_they_can(count):
    """A line, a parabola, a cubic to rounding, with their slopes."""
    knots, x = Knots.at(np.linspace(0.0, 1.0, count) ** 1.2), np.linspace(0.0, 1.0, 17)
    for power in range(min(count, 4)):
        value, slope, bent = knots.weights(x)
        assert value @ knots.places**power == pytest.approx(x**power, abs=1e-13)
        assert slope @ knots.places**power == pytest.approx(power * x ** max(power - 1, 0), abs=1e-12)
        assert bent @ knots.places**power == pytest.approx(power * (power - 1) * x ** max(power - 2, 0), abs=1e-11)


@pytest.mark.parametrize(
    ("design", "member", "hand"),
    [("plain-za", "wheel", "right"), ("plain-za", "pinion", "left"), ("helical-crowned", "wheel", None),
     ("spherical-table-3-1-convex", "pinion", None)],
)  # fmt: skip
def test_no_deviation_is_the_nominal_drive(design, member, hand):
    drive = Drive.load(design)
    drive = drive.with_(design={"hand": hand}) if hand else drive
    angles = ANGLES if hand else 0.1 * ANGLES * drive.pitch()
    angles = drive.design.mirror.sign * angles
    found = AsMeasured.of(drive, member, _points(drive, member, (5, 7), lambda p: np.zeros(len(p.tooth)))).tca(angles)
    there = drive.tca(angles)
    assert set(found.status) == {"converged"} and set(found.kinds) == {"tangency"}
    assert np.abs(found.errors - there.error).max() < 1e-9 * ARCSEC
    assert np.abs(found.points - there.points).max() < 1e-6 and np.abs(found.normals - there.normals).max() < 1e-9


@pytest.mark.parametrize(
    ("design", "member", "change", "angles"),
    [("plain-za", "wheel", {"hob_pressure_angle_deg": 20.05}, ANGLES),
     ("helical-crowned", "pinion", {"pinion_lead_crowning_um": 14.0}, np.radians([-4.0, 0.0, 4.0]))],
)  # fmt: skip
def test_the_difference_to_another_design_gives_that_design(design, member, change, angles):
    """Within what interpolation leaves, which falls with the fourth power of the cells."""
    drive = Drive.load(design)
    other = drive.with_(design=change)
    wanted, off = other.tca(angles), []
    moved = np.abs(wanted.error - drive.tca(angles).error).max()
    assert moved > 0.5 * ARCSEC or np.abs(wanted.points - drive.tca(angles).points).max() > 1e-3
    for lines in ((5, 7), (9, 13)):
        found = AsMeasured.of(drive, member, _difference(drive, other, member, lines)).tca(angles)
        off.append(np.abs(found.errors - wanted.error).max() / ARCSEC)
    assert off[1] < 1e-3 and (off[1] < 0.2 * off[0] or off[0] < 1e-7)


@pytest.mark.parametrize(
    ("design", "member"),
    [("plain-za", "wheel"), ("helical-crowned", "pinion"), ("spherical-table-3-1-convex", "pinion"),
     ("face-worm-cylindrical-convex", "pinion")],
)  # fmt: skip
def test_derivatives_are_those_of_differences(design, member):
    """Of surfaces and of the equations of contact: sixth-order differences, at random places of a rough flank."""
    drive, rng = Drive.load(design), np.random.default_rng(3)
    points = _points(drive, member, (5, 7), lambda p: 0.02 * rng.standard_normal(len(p.tooth)))
    measured = AsMeasured.of(drive, member, points)
    own = [b["name"] for b in measured._bodies].index(member)
    surface = measured._surfaces()[own]
    nodes = measured.field.nodes
    q = np.array([0.6 * nodes[1, 2] + 0.4 * nodes[2, 3], 0.7 * nodes[3, 4] + 0.3 * nodes[2, 3]])  # between the knots
    steps = 2e-4 * np.ptp(nodes.reshape(-1, nodes.shape[2]), axis=0)
    for exact, found in zip(surface.slopes(q), _differences(lambda at: surface(at)[:3], q, steps), strict=True):
        assert (np.abs(exact - found) * steps).max(initial=0.0) < 1e-11
    angles = np.zeros(len(q))
    start = measured.tca(0.0).solutions
    x = np.concatenate([start, start + 1e-3 * np.append(np.zeros(start.shape[1] - 1), 1.0)])
    sizes = np.full(x.shape[1], 2e-4)
    [found] = _differences(lambda y: measured._residual(angles, y)[:1], x, sizes)
    exact = measured._jacobian(angles, x)
    assert np.abs(exact - found).max() < 1e-7 * np.abs(exact).max()


def _differences(function, q, steps):
    """Derivatives of each of the function's results (P, …) by every parameter of q (P, k), to the sixth order."""
    columns = []
    for step, size in zip(np.diag(steps), steps, strict=True):
        parts = [
            [share * (a - b) / size for a, b in zip(function(q + m * step), function(q - m * step), strict=True)]
            for m, share in ((1, 3.0 / 4.0), (2, -3.0 / 20.0), (3, 1.0 / 60.0))
        ]
        columns.append([sum(of_each) for of_each in zip(*parts, strict=True)])
    return [np.stack(of_each, axis=-1) for of_each in zip(*columns, strict=True)]


def test_a_constant_deviation_turns_the_wheel_and_leaves_the_ease_off():
    """Δφ2 = δ/a, a the lever of the wheel (first order; the flanks are curved by 1e-2/mm, δ is 2 µm)."""
    drive, thick = Drive.load("plain-za"), 2e-3
    plain, thicker = (
        AsMeasured.of(drive, "wheel", _points(drive, "wheel", (5, 7), lambda p, d=d: np.full(len(p.tooth), d)))
        for d in (0.0, thick)
    )
    found, there = thicker.tca(ANGLES), drive.tca(ANGLES)
    assert found.errors - there.error == pytest.approx(thick / there.lever_arms["wheel"], rel=1e-3)
    one, two = (of.ease_off(-1.0, 1.0, 6e-3) for of in (plain, thicker))
    assert one.ease_off.shape == (5, 7) and np.nanmin(one.ease_off) >= 0.0
    assert np.nanmax(np.abs(one.ease_off - two.ease_off)) < 1e-3 * np.nanmax(one.ease_off)


def test_a_burr_on_the_border_of_the_grid_touches_first():
    """The tangency alone would not see it."""
    drive = Drive.load("plain-za")

    def burr(points):
        return np.where((points.i == 0) & (points.j == 3), 0.3, 0.0)

    found = AsMeasured.of(drive, "wheel", _points(drive, "wheel", (5, 7), burr)).tca(np.zeros(1))
    lever = drive.tca([0.0]).lever_arms["wheel"][0]
    assert found.kinds == ("edge",) and (found.first[0] - found.nominal[0]) * lever > 1e-3


def test_a_grid_with_a_gap_is_refused():
    drive = Drive.load("plain-za")
    points = _points(drive, "wheel", (5, 7), lambda p: np.where((p.i == 2) & (p.j == 3), math.nan, 0.0))
    with pytest.raises(UsageError, match="i = 2, j = 3: not measured"):
        AsMeasured.of(drive, "wheel", points)
    with pytest.raises(UsageError, match="--tooth 4"):
        AsMeasured.of(drive, "wheel", points, 4)
    with pytest.raises(UsageError, match="the design's flank is not measured"):
        AsMeasured.of(drive.with_(flank="left"), "wheel", points)


def test_the_command(tmp_path, capsys):
    drive, file = Drive.load("plain-za"), tmp_path / "wheel.csv"
    file.write_text(csv_text(_points(drive, "wheel", (5, 7), lambda p: np.zeros(len(p.tooth))), {}))
    words = ["measured", "plain-za", "--member", "wheel", "--measured", str(file)]
    assert main([*words, "--contact", "--phi-deg", "0,30", "--json", "-"]) == 0
    contact = json.loads(capsys.readouterr().out)["contact"]
    for point in contact["points"]:
        error = point["transmission_error_arcsec"]
        assert error == pytest.approx(point["nominal_transmission_error_arcsec"], abs=1e-9)
        assert point["first_contact"]["kind"] == "tangency"
    assert 0.0 < contact["pattern_share"] < 1.0 and len(contact["ease_off_um"]) == 5
    assert main([*words, "--phi-deg", "0"]) == 2 and "--contact" in capsys.readouterr().err
