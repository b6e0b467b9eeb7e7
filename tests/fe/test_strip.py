"""Rows of cells across strips whose curves bend as they like."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from meshwright.fe.strip import Strip

LENGTH, WIDTHS = 4.0, (0.05, 0.5, 2.0)


@pytest.mark.parametrize("seed", range(20))
def test_rows_never_cross_where_a_curve_bends_sharply(seed):
    """Corners of up to 110 degrees at random places: no place is under two cells, which would press it twice."""
    random = np.random.default_rng(seed)
    corners = np.sort(random.uniform(0.0, LENGTH, 3))
    slopes = np.tan(np.radians(random.uniform(-55.0, 55.0, 4)))
    along = np.union1d(np.linspace(0.0, LENGTH, 41), corners)
    steps = np.diff(along) * slopes[np.searchsorted(corners, 0.5 * (along[1:] + along[:-1]))]
    curve = PchipInterpolator(along, np.insert(np.cumsum(steps), 0, 0.0))
    strip = Strip(None, (0.0, LENGTH), 2.0, along, curve)
    stations = np.linspace(0.0, LENGTH, 120)
    for width in WIDTHS:
        rows = strip._without_crossing(width)
        sides = [rows.at(stations, np.full(len(stations), side * width)) for side in (-1.0, 1.0)]
        across = sides[1] - sides[0]
        for side in sides:
            step = np.diff(side, axis=0)
            for row in (across[:-1], across[1:]):
                assert np.all(step[:, 0] * row[:, 1] - step[:, 1] * row[:, 0] > 0.0)


def test_rows_lie_straight_across_a_curve_that_bends_little():
    along = np.linspace(0.0, LENGTH, 41)
    strip = Strip(None, (0.0, LENGTH), 2.0, along, lambda x, n=0: 0.05 * (2.0 * x if n else x * x))
    stations = np.linspace(0.0, LENGTH, 50)
    assert strip._without_crossing(0.5).way(stations) == pytest.approx(strip.way(stations), abs=1e-4)


def test_flanks_that_do_not_lie_over_one_another_are_told():
    touch = SimpleNamespace(edge="tip of the pinion on right face of the wheel")
    extents = np.array([[0.05, -14.7], [-1.07, 0.7]])
    pair = SimpleNamespace(pairs_later=1, touch=touch)
    plane = SimpleNamespace(extents=lambda: extents, shared=False, contact=pair)
    with pytest.raises(ArithmeticError, match=r"pair \+1 do not lie over one another .* \(tip of the pinion on right"):
        Strip.of(plane)
