"""How far flat facets are from the surface on which their corners lie, and how many rows bring that below a limit."""

import numpy as np

from meshwright.fe.hexahedra import Floats


def facet_departures(points: Floats, normals: Floats) -> tuple[float, float, float]:
    """Largest distance in mm of facets from a surface along their edges across and along it, and everywhere on them.

    points, normals (2 K + 1, 2 J + 1, 3) of the surface; the facets' corners are every other one, either diagonal.
    """
    def off(at: tuple, one: tuple, other: tuple) -> Floats:
        return np.sum((0.5 * (points[one] + points[other]) - points[at]) * normals[at], axis=-1)

    even, odd, lower, upper = slice(None, None, 2), slice(1, None, 2), slice(None, -1, 2), slice(2, None, 2)
    across = off((even, odd), (even, lower), (even, upper))
    along = off((odd, even), (lower, even), (upper, even))
    diagonals = (
        off((odd, odd), (lower, lower), (upper, upper)),
        off((odd, odd), (lower, upper), (upper, lower)),
    )
    # over a triangle the distance is quadratic; in its middle 4/9 of the sum of those at its edges' middles
    first, last = slice(None, -1), slice(1, None)
    halves = [(across[k], along[:, m]) for k in (first, last) for m in (first, last)]
    inside = [4.0 / 9.0 * np.abs(a + b + d) for d in diagonals for a, b in halves]
    edges = [np.abs(across).max(), np.abs(along).max(), *(np.abs(d).max() for d in diagonals)]
    return float(edges[0]), float(edges[1]), float(max(*edges, *(i.max() for i in inside)))


def finer_rows(
    rows: tuple[int, int], departures: tuple[float, float], wanted: float, most: tuple[int, int]
) -> tuple[int, int]:
    """Rows across and along a flank at which departures in mm, which fall with their square, are about half of that
    wanted, not above ``most``.
    """
    growth = np.clip(np.sqrt(2.2 * np.array(departures) / wanted), 1.05, 4.0)
    across, along = np.minimum(np.ceil(rows * growth), most)
    return int(across), int(along)
