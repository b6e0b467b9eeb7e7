"""The peak of the free contact, and what presses beside a sharp edge, of pressures in closed form."""

import numpy as np
import pytest

from meshwright.fe.edge_zone import EdgeZone
from meshwright.fe.gap import ContactGrid

#: Rows of cells along a contact of this length, mm.
ROWS = 40
LENGTH = 8.0


def _strip(columns, mean_pressure, sharp=1.0):
    """A strip from 0 to 1 mm across, an edge at 0; ``mean_pressure(x)``: its integral from 0 to places x across."""
    borders = np.linspace(0.0, 1.0, columns + 1)
    own = np.diff(mean_pressure(borders)) / np.diff(borders)
    along, across = np.meshgrid(
        (np.arange(ROWS) + 0.5) * LENGTH / ROWS, 0.5 * (borders[1:] + borders[:-1]), indexing="ij"
    )
    count = along.size
    at_edge = np.zeros((4, count), dtype=bool)
    at_edge[2] = across.ravel() < borders[1]
    centres = np.stack([along.ravel(), across.ravel()], axis=1)
    nothing = np.zeros(count)
    grid = ContactGrid(
        rows=ROWS,
        columns=columns,
        centres=centres,
        half=np.tile([0.5 * LENGTH / ROWS, 0.5 / columns], (count, 1)),
        rectangle=np.empty((count, 2)),
        ways=np.empty((count, 2, 2)),
        frame=np.tile(np.eye(3), (count, 1, 1)),
        points=np.column_stack([centres, nothing]),
        gap=nothing,
        row_gap=np.zeros(ROWS),
        offset=centres[:, 1],
        free=np.zeros((2, count), dtype=bool),
        beyond={"tip of the wheel": at_edge},
        sharp=sharp * at_edge,
        place={},
        free_edges={},
    )
    return grid, np.tile(own, ROWS)


@pytest.mark.parametrize("columns", [100, 400])
def test_pressure_that_grows_without_bound_has_a_peak_beyond_the_half_of_the_force_at_the_edge(columns):
    """1/√x carries half of its force up to x = 1/4, where it is 2, whatever the cells are."""
    zone = EdgeZone.of(*_strip(columns, lambda x: 2.0 * np.sqrt(x)))
    assert zone.peak == pytest.approx(2.0, rel=0.01) and zone.holds
    assert zone.depth[1] == pytest.approx(0.25, rel=0.02)
    (load,) = zone.loads
    assert load.edge == "the tip of the wheel" and load.length == pytest.approx(LENGTH)
    assert load.force == pytest.approx(LENGTH, rel=0.1) and load.pressure == pytest.approx(4.0, rel=0.1)


@pytest.mark.parametrize("columns", [25, 100])
def test_the_zone_of_an_edge_is_a_quarter_of_the_width_of_the_contact(columns):
    """1 - x has a variance of 1/18 about its middle: a quarter of the width is √5/2 of √(1/18)."""
    zone = EdgeZone.of(*_strip(columns, lambda x: x - 0.5 * x**2))
    depth = 0.5 * np.sqrt(5.0 / 18.0)
    assert zone.depth[1] == pytest.approx(depth, rel=0.01) and not zone.holds
    assert zone.peak == pytest.approx(1.0 - depth, rel=0.01)


def test_flush_ends_leave_the_peak_where_it_is_and_less_and_less_sharp_ones_lead_there():
    def falling(x):
        return x - 0.5 * x**2

    flush = EdgeZone.of(*_strip(100, falling, sharp=0.0))
    assert flush.peak == pytest.approx(0.995) and flush.depth is None and flush.loads == ()
    peaks = [EdgeZone.of(*_strip(100, falling, sharp=sharp)).peak for sharp in (1.0, 0.5, 0.1, 1e-3)]
    assert np.all(np.diff(peaks) > 0.0) and peaks[-1] == pytest.approx(flush.peak)
