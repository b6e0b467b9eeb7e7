"""Places of a flank on lines across a tooth: on their lines and on the flank, or none at all."""

from dataclasses import replace

import numpy as np
import pytest

from meshwright.base.errors import UsageError
from meshwright.drive import Drive
from meshwright.flank.lines import solve, tangents
from meshwright.flank.sections import lengthwise

#: Planes, cylinders and cones across teeth, and a parameter along them.
DESIGNS = (
    "recess-action-full", "plain-zc", "zk-zn-45", "face-worm-conical-convex", "bevel-hypoid", "helical-crowned",
    "spherical-table-2-1",
)


@pytest.fixture(scope="module", params=DESIGNS)
def region(request):
    return Drive.load(request.param).region("wheel")


def places_near(region, size):
    """Parameters (9, k) about an inner place of a region, up to ``size`` natural sizes away."""
    random = np.random.default_rng(5)
    free = list(region.chart.free)
    moved = region.seed[free] + size * random.uniform(-1.0, 1.0, (9, 2)) * region.chart.sizes[free]
    q = region.chart.complete(moved, np.tile(region.seed, (9, 1)))
    assert np.isfinite(q).all()
    return q


def test_places_are_on_their_lines_and_on_the_flank(region):
    wanted = places_near(region, 1e-2)
    along = lengthwise(region.flank, region.flank(wanted))
    found = solve(region, wanted[:, region.profile], along, np.tile(region.seed, (9, 1)))
    at = region.flank(found)
    reached = lengthwise(region.flank, at)
    np.testing.assert_allclose(found[:, region.profile], wanted[:, region.profile], rtol=1e-13)
    np.testing.assert_allclose(reached, along, rtol=0, atol=1e-9)
    assert np.abs(at.conditions[:, :, 0]).max(initial=0.0) < 1e-8
    np.testing.assert_allclose(at.points, region.flank(wanted).points, rtol=0, atol=1e-8)


def test_tangents_are_those_of_neighbouring_lines(region):
    here, step = region.seed[None], 1e-5
    found = region.flank(here)
    along = lengthwise(region.flank, found)
    ways = tangents(region, found)[0]
    for way, by in zip(ways, ((step, 0.0), (0.0, step)), strict=True):
        ends = [
            region.flank(solve(region, here[:, region.profile] + s * by[0], along + s * by[1], here)).points[0]
            for s in (-1.0, 1.0)
        ]
        np.testing.assert_allclose((ends[1] - ends[0]) / (2.0 * step), way, rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize("along", [np.nan, np.inf, 1e300, -1e9])
def test_where_there_is_no_place_there_is_no_number(region, along):
    if region.flank.sections is None and np.isfinite(along):
        pytest.skip("the last parameter runs along the tooth: every value of it has a place")
    found = solve(region, region.seed[None, region.profile], np.array([along]), region.seed[None])
    assert np.isnan(found).all()


def test_what_is_no_surface_is_refused(region):
    """Points without all of their tangents."""
    flank, k = replace(region.flank, body=region.flank.body | {"outputs": 6}), len(region.seed)
    with pytest.raises(UsageError, match="no surface of two free parameters"):
        flank.places(np.eye(k + 4)[:2], region.chart.sizes, np.zeros((1, 2)), region.seed[None])
