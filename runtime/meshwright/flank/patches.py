"""A closed body as a patchwork: grids of points over four-sided patches that meet along whole edges.

The same patches, with more points, are the body's triangles.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import KDTree

Floats = NDArray[np.floating[Any]]
Ints = NDArray[np.int64]

#: Points of neighbouring patches that are one are no further apart, mm.
TOGETHER = 1e-7


@dataclass(frozen=True)
class Patch:
    """points (I, J, 3) in mm: with i to the right and j upwards it is seen from outside. ``kind`` is what it is of."""

    kind: str
    points: Floats

    def moved(self, motion: Floats) -> Patch:
        """The patch under a 4 x 4 motion."""
        return Patch(self.kind, self.points @ motion[:3, :3].T + motion[:3, 3])

    def turned_over(self) -> Patch:
        """The same seen from the other side."""
        return Patch(self.kind, np.swapaxes(self.points, 0, 1))


def triangulated(patches: list[Patch]) -> tuple[Floats, Ints]:
    """Points (N, 3) and triangles (M, 3), counter-clockwise seen from outside, of patches whose edges are shared."""
    points = np.concatenate([p.points.reshape(-1, 3) for p in patches])
    parts, first, rims = [], 0, []
    for patch in patches:
        n, m, _ = patch.points.shape
        number = first + np.arange(n * m).reshape(n, m)
        a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
        parts += [np.stack(corners, axis=-1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))]
        rims.append(np.concatenate([number[0], number[-1], number[:, 0], number[:, -1]]))
        first += n * m
    label = np.arange(len(points))
    rim = np.unique(np.concatenate(rims))
    same = KDTree(points[rim]).query_pairs(TOGETHER, output_type="ndarray")
    label[rim] = rim[first_of_groups(same, len(rim))]
    triangles = label[np.concatenate(parts)]
    flat = np.sort(triangles, axis=1)
    triangles = triangles[(np.diff(flat, axis=1) > 0).all(axis=1)]
    used, numbered = np.unique(triangles, return_inverse=True)
    return points[used], numbered.reshape(-1, 3)


def first_of_groups(pairs: Ints, count: int) -> Ints:
    """For each of ``count`` things the number of the first one with which pairs (P, 2) connect it."""
    links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    _, group = connected_components(links, directed=False)
    first = np.full(group.max() + 1, count)
    np.minimum.at(first, group, np.arange(count))
    return first[group]
