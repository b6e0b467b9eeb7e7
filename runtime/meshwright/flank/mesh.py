"""Triangles over a region with its border resolved: vertices on the limits to rounding and at the corners of two."""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.base.roots import narrowed

#: A coarse look at how much of its box a region fills: cells; how much finer the lattice may become for it, and how
#: coarse it may be.
FEWEST, MOST_GROWN, FEWEST_ASKED = 12, 4.0, 4

#: The border is located on an edge of the lattice to so many units in the last place; Newton steps to a corner.
LAST_PLACES = 4.0
NEWTON_STEPS = 25

#: A corner belongs to the cell in which the border passes from limit to limit: it lies in it, or pokes through a side
#: between two nodes outside, by no more than this part of the cell's width.
SLACK = 1.0

#: The four edges of a cell from corner to corner, counter-clockwise: (corner, next corner).
CORNERS = ((0, 0), (1, 0), (1, 1), (0, 1))


@dataclass(frozen=True)
class Triangulation:
    """A meshed region, body frame, right hand: ``parameters`` (V, k), ``points`` and outward unit ``normals`` (V, 3) in
    mm, ``triangles`` (T, 3) counter-clockwise seen from outside the material. ``border`` (B, 2): directed edges with
    the region on their left in the chart; ``limit`` (B,): number of the limit that each lies on.
    """

    parameters: np.ndarray
    points: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    border: np.ndarray
    limit: np.ndarray

    @property
    def pieces(self):
        """Number (T,) of the connected piece that each triangle belongs to, from 0."""
        label = np.arange(len(self.points))
        while True:
            least = label[self.triangles].min(axis=1)
            new = label.copy()
            for corner in self.triangles.T:
                np.minimum.at(new, corner, least)
            if (new == label).all():
                break
            label = new
        return np.unique(label[self.triangles[:, 0]], return_inverse=True)[1]


def mesh(region, cells):
    """The :class:`Triangulation` of a :class:`~meshwright.flank.region.Region` over cells × cells of its lattice."""
    if region.empty:
        return _triangulation(region, np.empty((0, len(region.flank.parameters))), [], [])
    lattice = region.lattice(_enough(region, cells))
    nodes = np.full(lattice.shape, -1)
    nodes[lattice.inside] = np.arange(np.count_nonzero(lattice.inside))
    crossings, q, limit = _crossings(region, lattice, np.count_nonzero(lattice.inside))
    cut = _Cut(region, lattice, nodes, crossings, limit, [*lattice.q[lattice.inside], *q])
    around = np.stack([nodes[a : nodes.shape[0] - 1 + a, b : nodes.shape[1] - 1 + b] for a, b in CORNERS], axis=-1)
    whole = (around >= 0).all(axis=2)
    triangles, border = around[whole][:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3).tolist(), []
    for i, j in np.argwhere((around >= 0).any(axis=2) & ~whole):
        cut.cell(int(i), int(j), triangles, border)
    return _triangulation(region, np.array(cut.vertices), triangles, border)


def _enough(region, cells):
    """Cells of the lattice that give the region about as many as asked for, where it fills its box only in part."""
    inside = region.lattice((FEWEST, FEWEST)).inside
    grown = min(MOST_GROWN, max(1.0, math.sqrt((FEWEST + 1) ** 2 / max(1, np.count_nonzero(inside)))))
    return tuple(max(FEWEST_ASKED, round(grown * n)) for n in cells)


def _triangulation(region, q, triangles, border):
    found = region.flank(q) if len(q) else None
    points, normals = (found.points, found.normals) if len(q) else (np.empty((0, 3)), np.empty((0, 3)))
    triangles = np.array(triangles, dtype=int).reshape(-1, 3)
    if len(triangles):
        a, b, c = (points[triangles[:, k]] for k in range(3))
        across = np.cross(b - a, c - a)
        twice = np.linalg.norm(across, axis=1)
        facing = np.sum(across * normals[triangles[:, 0]])
        triangles = triangles[twice > 1e-12 * twice.max()]
        if facing < 0.0:
            triangles = triangles[:, ::-1]
    edges = np.array([e[:2] for e in border], dtype=int).reshape(-1, 2)
    return Triangulation(q, points, normals, triangles, edges, np.array([e[2] for e in border], dtype=int))


def _crossings(region, lattice, first):
    """Border vertices on the lattice's edges: numbers by edge (axis, i, j), parameters (C, k), limits by number."""
    edges, inner, outer, starts = [], [], [], []
    for axis in (0, 1):
        near = lattice.inside[:-1] if axis == 0 else lattice.inside[:, :-1]
        far = lattice.inside[1:] if axis == 0 else lattice.inside[:, 1:]
        for i, j in np.argwhere(near != far):
            a, b = (i, j), (i + 1, j) if axis == 0 else (i, j + 1)
            if not lattice.inside[a]:
                a, b = b, a
            edges.append((axis, int(i), int(j)))
            inner.append([lattice.lines[0][a[0]], lattice.lines[1][a[1]]])
            outer.append([lattice.lines[0][b[0]], lattice.lines[1][b[1]]])
            starts.append(lattice.q[a])
    if not edges:
        return {}, np.empty((0, lattice.q.shape[2])), {}
    inner, outer, q = np.array(inner), np.array(outer), np.array(starts)
    ends = [region.limits.values(region.flank(at)) for at in (q, region.chart.complete(outer, q))]
    worst, shares = np.argmin(ends[1], axis=1), np.zeros(len(q))

    def least(share, which):
        at = inner[which] + share[:, None] * (outer - inner)[which]
        trial = region.chart.complete(at, q[which])
        values = region.limits.values(region.flank(trial))
        good = values.min(axis=1) >= 0.0
        worst[which[~good]] = np.argmin(values[~good], axis=1)
        q[which[good]] = trial[good]
        return values.min(axis=1)

    rounding = np.spacing(np.maximum(np.abs(inner), np.abs(outer)))
    exact = LAST_PLACES * (rounding / np.maximum(np.abs(outer - inner), rounding)).min(axis=1)
    narrowed(least, shares, shares + 1.0, [values.min(axis=1) for values in ends], exact)
    numbers = {edge: first + k for k, edge in enumerate(edges)}
    return numbers, q, {first + k: int(w) for k, w in enumerate(worst)}


@dataclass(frozen=True)
class _Cut:
    """Cells cut along the border; ``vertices`` grows by the corners that are found."""

    region: object
    lattice: object
    nodes: np.ndarray
    crossings: dict
    limit: dict
    vertices: list

    def cell(self, i, j, triangles, border):
        """Add the triangles and border edges of one cell."""
        around, inside = self._around(i, j)
        if len(inside) == 2 and inside[1] - inside[0] == 2 and not self._inside_at(i, j):
            # a triangle about each of two opposite nodes
            nodes = [k for k, v in enumerate(around) if v not in self.limit]
            parts = [[around[k], around[(k + 1) % len(around)], around[k - 1]] for k in nodes]
        else:
            parts = [around]
        for part in parts:
            polygon = self._with_corners(i, j, part, border)
            triangles += [(polygon[0], polygon[k], polygon[k + 1]) for k in range(1, len(polygon) - 1)]

    def _around(self, i, j):
        """Vertices counter-clockwise about a cell, beginning with a node, and which of its corners are inside."""
        edges = ((0, i, j), (1, i + 1, j), (0, i, j + 1), (1, i, j))
        inside = [k for k, (a, b) in enumerate(CORNERS) if self.lattice.inside[i + a, j + b]]
        around = []
        for k in [(inside[0] + n) % 4 for n in range(4)]:
            a, b = CORNERS[k]
            if self.lattice.inside[i + a, j + b]:
                around.append(int(self.nodes[i + a, j + b]))
            if edges[k] in self.crossings:
                around.append(self.crossings[edges[k]])
        return around, inside

    def _inside_at(self, i, j):
        lines = self.lattice.lines
        middle = np.array([[0.5 * (lines[0][i] + lines[0][i + 1]), 0.5 * (lines[1][j] + lines[1][j + 1])]])
        q = self.region.chart.complete(middle, self.lattice.q[i, j][None])
        return self.region.limits.least(self.region.flank(q))[0] >= 0.0

    def _with_corners(self, i, j, polygon, border):
        """The polygon with a corner between neighbouring border vertices on different limits; notes its border."""
        result = []
        for k, vertex in enumerate(polygon):
            following = polygon[(k + 1) % len(polygon)]
            result.append(vertex)
            if vertex not in self.limit or following not in self.limit:
                continue
            pair = self.limit[vertex], self.limit[following]
            corner = None if pair[0] == pair[1] else self._corner(i, j, pair, vertex, following)
            if corner is None:
                border.append((vertex, following, pair[0]))
                continue
            self.vertices.append(corner)
            number = len(self.vertices) - 1
            border += [(vertex, number, pair[0]), (number, following, pair[1])]
            result.append(number)
        return result

    def _corner(self, i, j, pair, *ends):
        """Parameters (k,) of the corner of two limits in the cell; None if it is not there."""
        region, lines = self.region, self.lattice.lines
        low = np.array([lines[0][i], lines[1][j]])
        size = np.array([lines[0][i + 1], lines[1][j + 1]]) - low
        q = np.mean([self.vertices[e] for e in ends], axis=0)
        at = q[list(region.chart.free)]
        for _ in range(NEWTON_STEPS):
            found = region.flank(region.chart.complete(at[None], q[None]))
            values = region.limits.values(found)[0, pair]
            by_parameters = region.limits.slopes(found)[:, pair]
            slopes = region.chart.by_coordinates(found, by_parameters)[0] * size
            if not np.isfinite(slopes).all() or abs(np.linalg.det(slopes)) < 1e-300:
                return None
            step = np.linalg.solve(slopes, values)
            at = at - size * step * min(1.0, 0.5 / max(np.abs(step).max(), 1e-300))
            q = region.chart.complete(at[None], q[None])[0]
            if np.abs(step).max() < 1e-13:
                break
        share = (at - low) / size
        if not ((share > -SLACK) & (share < 1.0 + SLACK)).all():
            return None
        values = region.limits.values(region.flank(q))[0]
        return q if values.min() > -1e-9 else None
