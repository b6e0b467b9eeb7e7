"""The border of a region as curves: one for each limit, from corner to corner, followed to rounding."""

from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError

#: A border curve follows its limit to this distance, mm; points of the first fit and at most.
TOLERANCE = 1e-6
FEWEST, MOST = 9, 513

#: At a corner both limits are zero to this.
ON_CORNER = 1e-8

#: Degree of the curves, where they have points enough.
DEGREE = 5
NEWTON_STEPS = 12


@dataclass(frozen=True)
class Side:
    """A border curve of a region: ``coordinates`` (n, 2) of its chart at equal steps of the curve's own parameter, with
    the region on the left; ``limit`` is its limit's name, ``deviation`` how far the spline through the points is at
    most from the limit, mm.
    """

    limit: str
    coordinates: np.ndarray
    deviation: float

    @property
    def spline(self):
        """The curve as a SciPy B-spline over 0 … 1."""
        return _spline(self.coordinates)


def loops(region, triangles):
    """The border of a region as closed loops: lists of :class:`Side`, each beginning where the one before ends."""
    return [[_side(region, triangles, *part) for part in _parts(loop)] for loop in _chained(triangles)]


def cornered(region, triangles):
    """Whether every curve of the border ends on both limits that meet there."""
    for loop in _chained(triangles):
        parts = _parts(loop)
        for (_, before), (vertices, limit) in zip([parts[-1], *parts[:-1]], parts, strict=True):
            values = region.limits.values(region.flank(triangles.parameters[vertices[:1]]))[0]
            if not np.abs(values[[before, limit]]).max() < ON_CORNER:
                return False
    return True


def _spline(coordinates):
    from scipy.interpolate import make_interp_spline

    at = np.linspace(0.0, 1.0, len(coordinates))
    return make_interp_spline(at, coordinates, k=min(DEGREE, len(coordinates) - 1))


def _chained(triangles):
    """Closed loops of border edges: lists of (vertex, limit) in order."""
    following = {int(a): (int(b), int(limit)) for (a, b), limit in zip(triangles.border, triangles.limit, strict=True)}
    found = []
    while following:
        first = vertex = next(iter(following))
        loop = []
        while vertex in following:
            after, limit = following.pop(vertex)
            loop.append((vertex, limit))
            vertex = after
        if vertex == first and len(loop) > 2:
            found.append(loop)
    return found


def _parts(loop):
    """The stretches of a loop on one limit: (vertices with both ends, limit). One without corners is halved."""
    starts = [k for k in range(len(loop)) if loop[k][1] != loop[k - 1][1]]
    if not starts:
        starts = [0, len(loop) // 2]
    parts = []
    for k, start in enumerate(starts):
        end = starts[(k + 1) % len(starts)]
        count = (end - start) % len(loop) or len(loop)
        vertices = [loop[(start + n) % len(loop)][0] for n in range(count + 1)]
        parts.append((vertices, loop[start][1]))
    return parts


def _side(region, triangles, vertices, limit):
    """The :class:`Side` along a chain of border vertices."""
    known = triangles.parameters[vertices]
    # Lengths in the chart: in space a curve stands still where it meets a cusp.
    free = list(region.chart.free)
    steps = np.diff(known[:, free] / region.chart.sizes[free], axis=0)
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(steps, axis=1))])
    keep = np.concatenate([[True], np.diff(length) > 1e-9 * max(length[-1], 1e-300)])
    keep[-1] = True
    share, known = length[keep] / max(length[-1], 1e-300), known[keep]
    count = FEWEST
    while True:
        at = np.linspace(0.0, 1.0, count)
        coordinates = _on_limit(region, limit, at, share, known)
        deviation = _deviation(region, limit, coordinates, share, known)
        if deviation <= TOLERANCE or count >= MOST:
            return Side(region.limits.names[limit], coordinates, deviation)
        count = 2 * count - 1


def _on_limit(region, limit, at, share, known):
    """Chart coordinates (n, 2) on a limit at shares of the length of a chain; its ends stay."""
    free = list(region.chart.free)
    q = np.stack([np.interp(at, share, column) for column in known.T], axis=1)
    coordinates = q[:, free].copy()
    for _ in range(NEWTON_STEPS):
        q, back, _ = _to_limit(region, limit, coordinates, q)
        coordinates[1:-1] -= back[1:-1]
        if not np.abs(back[1:-1] / region.chart.sizes[free]).max(initial=0.0) > 1e-13:
            break
    return coordinates


def _to_limit(region, limit, coordinates, start):
    """Parameters (n, k), the way (n, 2) of the coordinates from a limit, straight in natural sizes, and its length in
    mm (n,).
    """
    chart, sizes = region.chart, region.chart.sizes[list(region.chart.free)]
    q = chart.complete(coordinates, start)
    found = chart.flank(q)
    value = region.limits.values(found)[:, limit]
    slopes, tangents = (
        chart.by_coordinates(found, by_parameters) * sizes
        for by_parameters in (region.limits.slopes(found)[:, limit : limit + 1], np.swapaxes(found.tangents, 1, 2))
    )
    with np.errstate(invalid="ignore"):
        back = value[:, None] * slopes[:, 0] / np.maximum(np.sum(slopes[:, 0] ** 2, axis=1), 1e-300)[:, None]
    if not np.isfinite(back).all():
        raise UsageError(
            f"the {region.flank.region} of the {region.flank.body['name']} ends at its {region.limits.names[limit]} "
            "where the surface itself does; a trimmed surface needs more: write --vtu or --stl"
        )
    return q, back * sizes, np.linalg.norm(np.einsum("ni,nji->nj", back, tangents), axis=1)


def _deviation(region, limit, coordinates, share, known):
    """Largest distance, mm, of the spline through a side's points from its limit, midway between them."""
    at = (np.arange(len(coordinates) - 1) + 0.5) / (len(coordinates) - 1)
    start = np.stack([np.interp(at, share, column) for column in known.T], axis=1)
    return float(_to_limit(region, limit, _spline(coordinates)(at), start)[2].max())
