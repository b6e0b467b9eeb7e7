"""Which cells touch, against conditions that hold of one solution alone."""

import numpy as np
import pytest

from meshwright.fe.cells import Cells, PairCells
from meshwright.fe.touching import active_set


@pytest.mark.parametrize("least", [1.0, 1e-3, 1e-6])
@pytest.mark.parametrize("seed", range(6))
def test_the_cells_that_touch_are_found_whatever_moves_what(seed, least):
    """Cells that move one another at random, some ways hardly at all: nothing pulls, nothing overlaps, and the moment
    is the torque. The energy being convex, there is one such solution.
    """
    random = np.random.default_rng(seed)
    count, torque = 60, 5.0
    turned, _ = np.linalg.qr(random.normal(size=(count, count)))
    work = turned @ np.diag(np.geomspace(least, 1.0, count)) @ turned.T
    areas, arms, gap = (random.uniform(0.5, 1.5, count) for _ in range(3))
    cells = Cells((PairCells(work, np.empty((count, 0)), areas),), (np.empty(0, dtype=np.int64),), np.empty((0, 0)))
    pressure, rotation = active_set(cells, gap, arms, areas, random.uniform(size=count) < 0.5, torque)
    opening = gap + work @ pressure / areas - rotation * arms
    assert (pressure >= 0.0).all() and (areas * pressure) @ arms == pytest.approx(torque)
    room = 1e-8 * max(1.0, pressure.max())
    assert (opening > -room).all() and np.abs(opening[pressure > 0.0]).max() < room
