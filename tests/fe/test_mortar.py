"""Gap and force of flat facets on curved flanks, against sums over many places of each facet and plane geometry."""

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator

from meshwright.fe.mortar import fitted_nodes, pressed

# Common curvature along the tooth of flanks that differ little, as of spiral bevel teeth, and those of their gap, 1/mm.
COMMON, ACROSS, ALONG = 1.0 / 77.0, 0.05, 3e-4
SAMPLES = 60
CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])


def pinion(x, y):
    return 0.5 * COMMON * y**2 + 0.0 * x


def gap(x, y):
    return 0.5 * (ACROSS * x**2 + ALONG * y**2)


def sheet(x, y, lean, height):
    """Nodes (N, 3) and faces (F, 4) of rows that lean over."""
    gx, gy = np.meshgrid(x, y, indexing="ij")
    gx = gx + lean * gy
    number = np.arange(gx.size).reshape(gx.shape)
    quads = np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], axis=-1).reshape(-1, 4)
    return np.stack([gx, gy, height(gx, gy)], axis=-1).reshape(-1, 3), quads


@pytest.fixture(scope="module")
def sheets():
    """A slave of rows at an angle and a master whose sections are as long but not at the same places."""
    slave = sheet(np.linspace(-0.3, 0.3, 9), np.linspace(-4.0, 4.0, 5), 0.02, pinion)
    ticks = np.linspace(-0.5, 0.5, 12), np.linspace(-6.0, 6.0, 7) + 0.6
    return slave, ticks, sheet(*ticks, 0.0, lambda x, y: pinion(x, y) + gap(x, y))


def shapes():
    """Places of a face, its shape functions (P, 4) there."""
    ticks = (2.0 * np.arange(SAMPLES) + 1.0) / SAMPLES - 1.0
    local = np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 1, 2)
    return np.prod(1.0 + local * CORNERS, axis=-1) / 4.0


def weighted(nodes, quads, height):
    """Integrals (N,) of a gap over faces of equal area with functions dual to the nodes', over those of the latter."""
    shape = shapes()
    dual = shape @ np.linalg.inv(shape.T @ shape) * shape.sum(axis=0)
    found, total = np.zeros(len(nodes)), np.zeros(len(nodes))
    for quad in quads:
        np.add.at(found, quad, dual.T @ height(shape @ nodes[quad]))
        np.add.at(total, quad, shape.sum(axis=0))
    return found / total


def fitted(sheets, gap_of_flanks, closing=1.0):
    (nodes, quads), _, (above, faces) = sheets
    return fitted_nodes(np.zeros(3), np.eye(3), gap_of_flanks, nodes[quads], above[faces], quads, closing)


def everywhere(points):
    return gap(points[:, 0], points[:, 1]), np.ones(len(points), dtype=bool)


def seen_gap(sheets, nodes):
    """What a mortar sees of the facets' gap at the slave's nodes (N, 3)."""
    (_, quads), ticks, (above, _) = sheets
    master = RegularGridInterpolator(ticks, above[:, 2].reshape(len(ticks[0]), -1))
    return weighted(nodes, quads, lambda places: master(places[:, :2]) - places[:, 2])


def test_facets_have_the_gap_of_the_flanks(sheets):
    """At each node to 2 % of the height of an arc; as they are, facets miss it by more than a third of that."""
    (nodes, _), _, _ = sheets
    arc = COMMON * 2.0**2 / 8.0
    found, shifts = fitted(sheets, everywhere)
    assert sorted(found) == list(range(len(nodes)))
    moved = nodes.copy()
    moved[found] += shifts
    wanted = gap(*nodes[:, :2].T)
    before, after = (np.abs(seen_gap(sheets, of) - wanted).max() for of in (nodes, moved))
    assert before > arc / 3.0
    assert after < 0.02 * arc


def test_flanks_that_no_load_closes_only_stay_apart(sheets):
    """Nodes move only where the gap of flanks or facets is less than what the load may close."""
    (nodes, _), _, _ = sheets
    closing = 2e-3
    found, shifts = fitted(sheets, everywhere, closing)
    moved = nodes.copy()
    moved[found] += shifts
    wide = gap(*nodes[:, :2].T) > closing
    before, after = (seen_gap(sheets, of)[wide] for of in (nodes, moved))
    assert wide.any() and (after > closing - 2e-4).all()
    apart = before > closing + 2e-4
    assert apart.any() and after[apart] == pytest.approx(before[apart], abs=1e-12)


def test_nodes_without_the_other_flank_stay(sheets):
    (nodes, _), _, _ = sheets

    def half(points):
        return gap(points[:, 0], points[:, 1]), points[:, 1] < 1.0

    found, _ = fitted(sheets, half)
    assert set(found) == set(np.flatnonzero(nodes[:, 1] < 1.0))


def test_pressures_act_where_the_master_is():
    """A tilted square under pressures that grow along it, with a master over its first 70 %: ∫ p over that part."""
    ticks = np.linspace(0.0, 1.0, 5)
    tilt = 0.1
    nodes, quads = sheet(ticks, ticks, 0.0, lambda x, y: tilt * x)
    master = np.array([[[-1.0, -1.0, 0.5], [0.7, -1.0, 0.5], [0.7, 2.0, 0.5], [-1.0, 2.0, 0.5]]])
    pressures = 100.0 * nodes[quads][..., 1]
    places, forces = pressed(np.zeros(3), np.eye(3), nodes[quads], pressures, master)
    assert forces.sum(axis=0) == pytest.approx(np.array([-tilt, 0.0, 1.0]) * 50.0 * 0.7, rel=0.02, abs=1e-12)
    assert forces[:, 2] @ places[:, 1] == pytest.approx(100.0 / 3.0 * 0.7, rel=0.02)


def test_a_corner_without_the_master_has_the_pressure_beside_it():
    """Pressures that are 100 MPa but at uncovered corners, where there are none: 100 MPa on all that is covered."""
    ticks = np.linspace(0.0, 1.0, 5)
    nodes, quads = sheet(ticks, ticks, 0.0, lambda x, y: 0.0 * x)
    master = np.array([[[-1.0, -1.0, 0.5], [0.9, -1.0, 0.5], [0.9, 2.0, 0.5], [-1.0, 2.0, 0.5]]])
    pressures = np.where(nodes[quads][..., 0] < 0.9, 100.0, 0.0)
    _, forces = pressed(np.zeros(3), np.eye(3), nodes[quads], pressures, master)
    assert forces.sum(axis=0) == pytest.approx([0.0, 0.0, 90.0], rel=0.02)
