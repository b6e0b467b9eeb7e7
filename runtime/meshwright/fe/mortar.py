"""What mortar contact makes of flanks that are meshed with flat facets: the gap at nodes, the force of pressures.

Nodes lie on the flanks, chords between them do not. Where both flanks are curved along the tooth and only their
difference is small, as of teeth along spirals, the facets of the two do not fit one another: they stand off, or
overlap, by the height of their arcs, which may be more than the load closes.

Mortar contact knows a gap by its integrals alone, weighted with shape functions dual to the movement of the slave's
nodes: each weighs its own node's movement and no other (B. Wohlmuth, A mortar finite element method using dual spaces
for the Lagrange multiplier, 2000). To it the gap at a node is that of the best bilinear fit (least squares) to the gap
of the facets on each face, the mean by area where faces meet. A movement of the node along the normal makes it the gap
of the flanks at the node: what it would be if the facets of both had the same corners.

Integrals are over what the master covers. A corner of a face that it does not cover has no multiplier; the others of
the face stand for it. So do pressures here, and their moment is that of the load to 0.1 % also where a tip cuts faces.
"""

from collections.abc import Callable

import numpy as np

from meshwright.fe.hexahedra import Floats, Ints

Gap = Callable[[Floats], tuple[Floats, np.ndarray]]
"""Points (N, 3) to the gap (N,) in mm of the flanks along the normal through them, and where both flanks are (N,)."""

# Gauss points along a side of a slave face, for its gap and for its force: edges of the master's facets cross it.
_GAP_POINTS, _FORCE_POINTS = 8, 16
# A face of which the other flank covers less than this part says nothing of its nodes.
_COVERED = 0.5
# So little, in parts of its area, the fit is held where the other flank does not cover a face.
_HOLD = 1e-3
_NEWTON_STEPS = 8
# So far, in parts of a face, a place may lie beyond its edges and still count as on it.
_BESIDE = 1e-6
_SIGNS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])


def fitted_nodes(
    origin: Floats, axes: Floats, gap: Gap, slave: Floats, master: Floats, quads: Ints, closing: float
) -> tuple[Ints, Floats]:
    """Nodes (K,) of the slave and what to move them by (K, 3) in mm, so that the facets have the gap of the flanks.

    slave (F, 4, 3), master (M, 4, 3): corners of the faces on either flank; quads (F, 4): numbers of the slave's
    nodes.  axes: rows (3, 3), two directions at right angles to the normal and the normal, out of the slave; origin:
    point (3,) of contact.  Where the flanks are further apart than ``closing`` mm, more than the load closes, it is
    enough that the facets are so too.
    """
    below, above = ((corners - origin) @ axes.T for corners in (slave, master))
    nodes, of_facets = _gap_of_facets(below, above, quads)
    corners = np.empty((quads.max() + 1, 3))
    corners[quads] = slave
    of_flanks, inside = gap(corners[nodes])
    nodes, of_facets, of_flanks = nodes[inside], of_facets[inside], of_flanks[inside]
    wanted = np.where(of_flanks < closing, of_flanks, np.maximum(of_facets, closing))
    return nodes, (of_facets - wanted)[:, None] * axes[2]


def _gap_of_facets(slave: Floats, master: Floats, quads: Ints) -> tuple[Ints, Floats]:
    """Nodes (K,) of the slave below the master and the gap (K,) along the third axis that mortar contact sees there."""
    local, weights = _gauss(_GAP_POINTS)
    shape = _shape(local)
    places = shape @ slave
    heights = _heights(master, places[..., :2].reshape(-1, 2)).reshape(places.shape[:2]) - places[..., 2]
    areas = weights * _areas(slave, local)
    seen = areas * np.isfinite(heights)
    kept = seen.sum(axis=1) > _COVERED * areas.sum(axis=1)
    heights, seen, areas = np.nan_to_num(heights[kept]), seen[kept], areas[kept]
    mass = np.einsum("fp,pm,pn->fmn", seen + _HOLD * (areas - seen), shape, shape)
    fit = np.linalg.solve(mass, ((seen * heights) @ shape)[..., None])[..., 0]
    nodes, where = np.unique(quads[kept], return_inverse=True)
    share = seen @ shape
    total, weighted = (np.bincount(where.ravel(), part.ravel(), len(nodes)) for part in (share, share * fit))
    return nodes, weighted / total


def pressed(
    origin: Floats, axes: Floats, slave: Floats, pressures: Floats, master: Floats
) -> tuple[Floats, Floats]:
    """Places (Q, 3) on the slave and forces (Q, 3) in N there, out of its faces, of pressures at its corners.

    pressures (F, 4) in MPa; slave, master, origin and axes as above.
    """
    above = (master - origin) @ axes.T
    bare = np.isnan(_heights(above, ((slave - origin) @ axes[:2].T).reshape(-1, 2))).reshape(pressures.shape)
    others = np.sum(pressures * ~bare, axis=1) / np.maximum(np.sum(~bare, axis=1), 1)
    pressures = np.where(bare, others[:, None], pressures)
    loaded = pressures.any(axis=1)
    slave, pressures = slave[loaded], pressures[loaded]
    local, weights = _gauss(_FORCE_POINTS)
    places = _shape(local) @ slave
    covered = np.isfinite(_heights(above, ((places - origin) @ axes[:2].T).reshape(-1, 2))).reshape(places.shape[:2])
    along, across = np.einsum("pnk,fni->kfpi", _slopes(local), slave)
    forces = np.cross(along, across) * (weights * covered * (pressures @ _shape(local).T))[..., None]
    return places.reshape(-1, 3), forces.reshape(-1, 3)


def _gauss(points: int) -> tuple[Floats, Floats]:
    """Local places (P, 2) of the Gauss points of a face, ``points`` along a side, and weights (P,)."""
    at, weights = np.polynomial.legendre.leggauss(points)
    return np.stack(np.meshgrid(at, at, indexing="ij"), axis=-1).reshape(-1, 2), np.outer(weights, weights).ravel()


def _shape(local: Floats) -> Floats:
    """Bilinear shape functions (P, 4) at local places (P, 2)."""
    return np.prod(1.0 + local[:, None] * _SIGNS, axis=-1) / 4.0


def _slopes(local: Floats) -> Floats:
    """Derivatives (P, 4, 2) of the same."""
    return _SIGNS * (1.0 + local[:, None] * _SIGNS)[..., ::-1] / 4.0


def _areas(corners: Floats, local: Floats) -> Floats:
    """Area per local area (F, P) of faces (F, 4, 3) seen along the normal."""
    return np.abs(np.linalg.det(np.einsum("pnk,fni->fpki", _slopes(local), corners[..., :2])))


def _heights(faces: Floats, places: Floats) -> Floats:
    """Height along the third axis (N,) of faces (M, 4, 3) above places (N, 2); not a number where there is none."""
    heights = np.full(len(places), np.nan)
    order = np.argsort(places[:, 0])
    ascending = places[order, 0]
    for corners in faces:
        low, high = corners[:, :2].min(axis=0), corners[:, :2].max(axis=0)
        near = order[slice(*np.searchsorted(ascending, (low[0], high[0])))]
        near = near[(places[near, 1] >= low[1]) & (places[near, 1] <= high[1])]
        local = np.zeros((len(near), 2))
        for _ in range(_NEWTON_STEPS):
            miss = _shape(local) @ corners[:, :2] - places[near]
            slopes = np.einsum("pnk,ni->pik", _slopes(local), corners[:, :2])
            local -= np.linalg.solve(slopes, miss[..., None])[..., 0]
        on = np.abs(local).max(axis=1, initial=0.0) <= 1.0 + _BESIDE
        heights[near[on]] = _shape(local[on]) @ corners[:, 2]
    return heights
