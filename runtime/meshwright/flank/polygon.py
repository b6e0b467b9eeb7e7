"""Triangles of a plane polygon, by cutting off its ears."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def triangles(corners: Floats) -> Ints:
    """Numbers (N - 2, 3) of the corners (N, 2) of triangles that fill a polygon, counter-clockwise like its corners.

    A hole is joined to the outline by a seam of two edges, whose corners occur twice (G. H. Meisters, Polygons have
    ears, American Mathematical Monthly 82, 1975). Raises ValueError for a polygon that crosses itself.
    """
    left, found = list(range(len(corners))), []
    at = 0
    waited = 0
    while len(left) > 3:
        before, here, after = (left[(at + k) % len(left)] for k in (-1, 0, 1))
        if _is_ear(corners, left, before, here, after):
            found.append((before, here, after))
            del left[at % len(left)]
            # the next ear is sought one further on, so that ears do not fan out from one corner
            at, waited = at + 1, 0
        else:
            at, waited = at + 1, waited + 1
            if waited > len(left):
                raise ValueError("the outline crosses itself")
        at %= len(left)
    return np.array([*found, tuple(left)])


def _is_ear(corners: Floats, left: list[int], before: int, here: int, after: int) -> bool:
    """Whether the triangle at a corner turns left and holds no other corner that is left."""
    a, b, c = corners[before], corners[here], corners[after]
    if not _side(a, b, c) > 0.0:
        return False
    others = corners[[k for k in left if k not in (before, here, after)]]
    within = (_side(a, b, others) >= 0.0) & (_side(b, c, others) >= 0.0) & (_side(c, a, others) >= 0.0)
    for corner in (a, b, c):
        within &= (others != corner).any(axis=1)
    return not within.any()


def _side(a: Floats, b: Floats, places: Floats) -> Floats:
    """Twice the areas of the triangles of a, b and places (..., 2), positive on the left of the way from a to b."""
    return (b[0] - a[0]) * (places[..., 1] - a[1]) - (b[1] - a[1]) * (places[..., 0] - a[0])
