"""Outlines of threads: distances from roots that are cones, tori or neither, against closed forms."""

import numpy as np
import pytest

from meshwright.fe.thread import Revolved, Root

CIRCLE, CENTRE = 104.2, 125.0
PLACES = np.array([24.0, 30.0, 33.0, 36.5]), np.array([-3.0, -40.0, 21.0, 47.0])


def revolved(height):
    """A root where ``height`` of the distance from a circle beside the axis vanishes."""

    def root(radius, z):
        away = np.hypot(CENTRE - radius, z)
        by_distance = (height(away + 1e-6) - height(away - 1e-6)) / 2e-6
        return Root(height(away), (-by_distance * (CENTRE - radius) / away, by_distance * z / away))

    return Revolved(lambda radius, z: np.hypot(CENTRE - radius, z) - 96.5, root)


@pytest.mark.parametrize("height", [lambda away: CIRCLE - away, lambda away: CIRCLE**3 - away**3])
def test_the_distance_from_a_torus_is_that_from_its_circle(height):
    """Whatever function is zero on it."""
    found = revolved(height).from_root(*PLACES)
    away = np.hypot(CENTRE - PLACES[0], PLACES[1])
    assert found.above == pytest.approx(CIRCLE - away, abs=1e-9)
    assert found.slopes[0] == pytest.approx((CENTRE - PLACES[0]) / away, abs=1e-9)
    assert found.slopes[1] == pytest.approx(-PLACES[1] / away, abs=1e-9)
    z = np.array([-47.0, 0.0, 12.0])
    assert revolved(height).root_radius(z, 20.8) == pytest.approx(CENTRE - np.sqrt(CIRCLE**2 - z**2), abs=1e-9)


def test_where_a_root_does_not_reach_is_said():
    with pytest.raises(ValueError, match="does not reach as far along the axis as 110"), np.errstate(invalid="ignore"):
        revolved(lambda away: CIRCLE - away).root_radius(np.array([110.0]), 20.8)


def test_a_cone_is_as_far_as_its_slant_says():
    taper = 0.2
    found = Revolved.cones(30.0, 25.0, taper).from_root(*PLACES)
    assert found.above == pytest.approx((PLACES[0] - 25.0 - taper * PLACES[1]) / np.hypot(1.0, taper), abs=1e-12)
    assert found.slopes[1] / found.slopes[0] == pytest.approx(-taper, abs=1e-15)
