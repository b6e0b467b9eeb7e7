"""Structured blocks of hexahedra and the graded divisions of their edges."""

from dataclasses import dataclass

import numpy as np

from meshwright.fe.hexahedra import FaceSet, Floats, HexMesh

_SAMPLES = 20001
# Zero-based element face (S1..S6) on each side of a block whose axes i, j, k are the element's own.
_SIDE_FACE = {"i0": 5, "i1": 3, "j0": 2, "j1": 4, "k0": 0, "k1": 1}


@dataclass(frozen=True)
class Block:
    """Points (I+1, J+1, K+1, 3) of I x J x K hexahedra; (i, j, k) right-handed."""

    points: Floats

    @property
    def shape(self) -> tuple[int, int, int]:
        """Elements along i, j, k."""
        ni, nj, nk, _ = self.points.shape
        return ni - 1, nj - 1, nk - 1

    def mesh(self) -> HexMesh:
        """The block alone, nodes in C order of (i, j, k)."""
        number = np.arange(self.points[..., 0].size).reshape(self.points.shape[:3])
        low, high = slice(None, -1), slice(1, None)
        corners = [(low, low), (high, low), (high, high), (low, high)]
        columns = [number[i, j, k] for k in (low, high) for i, j in corners]
        return HexMesh(self.points.reshape(-1, 3), np.stack([c.ravel() for c in columns], axis=1))

    def side(self, name: str) -> FaceSet:
        """Element faces on a side ``i0 i1 j0 j1 k0 k1``."""
        number = np.arange(np.prod(self.shape)).reshape(self.shape)
        elements = np.take(number, 0 if name[1] == "0" else -1, axis="ijk".index(name[0])).ravel()
        return FaceSet(elements, np.full(len(elements), _SIDE_FACE[name]))


def transfinite(low_i: Floats, high_i: Floats, low_j: Floats, high_j: Floats) -> Floats:
    """Points (..., I, J, 3) between four edge curves (Gordon and Hall's transfinite interpolation).

    low_i, high_i (..., J, 3) are the edges at the first and last i, low_j, high_j (..., I, 3) those at the
    first and last j; corners must agree.  Interior points follow the edges' own relative arc lengths.
    """
    s = _blend(_relative_length(low_j), _relative_length(high_j), low_i, high_i)
    t = np.swapaxes(_blend(_relative_length(low_i), _relative_length(high_i), low_j, high_j), -1, -2)
    s, t = s[..., None], t[..., None]
    across = (1 - s) * low_i[..., None, :, :] + s * high_i[..., None, :, :]
    along = (1 - t) * low_j[..., :, None, :] + t * high_j[..., :, None, :]
    corners = (
        (1 - s) * (1 - t) * low_i[..., None, :1, :]
        + (1 - s) * t * low_i[..., None, -1:, :]
        + s * (1 - t) * high_i[..., None, :1, :]
        + s * t * high_i[..., None, -1:, :]
    )
    return across + along - corners


def _relative_length(curve: Floats) -> Floats:
    steps = np.linalg.norm(np.diff(curve, axis=-2), axis=-1)
    length = np.concatenate([np.zeros_like(steps[..., :1]), np.cumsum(steps, axis=-1)], axis=-1)
    return length / length[..., -1:]


def _blend(first: Floats, last: Floats, across_first: Floats, across_last: Floats) -> Floats:
    """Relative position (..., I, J) that goes from ``first`` to ``last`` (..., I) over J."""
    weight = 0.5 * (_relative_length(across_first) + _relative_length(across_last))
    return first[..., :, None] * (1 - weight[..., None, :]) + last[..., :, None] * weight[..., None, :]


@dataclass(frozen=True)
class FineZone:
    """Where an edge is divided finely: centre and half width as lengths along it, interval size in the zone.

    largest: interval size anywhere.
    """

    centre: float
    half_width: float
    size: float
    largest: float = np.inf


def graded(length: float, zone: FineZone, growth: float, count: int | None = None) -> Floats:
    """(count + 1,) positions from 0 to length, one of them the zone's centre if that lies inside.

    Intervals are at most ``zone.size`` in the zone; outside it each exceeds its neighbour by the factor ``growth``
    at most, up to ``zone.largest``.  A ``count`` above the least possible one shortens the intervals; a smaller one
    is a ValueError.
    """
    below, above = _counts(length, zone, growth)
    needed = below + above
    count = needed if count is None else count
    if count < needed:
        raise ValueError(f"{count} intervals over {length:g} mm: at least {needed} are needed")
    more_below = (count - needed) * below // needed
    more_above = count - needed - more_below
    centre = min(max(zone.centre, 0.0), length)
    return np.concatenate(
        [
            _divided(0.0, centre, zone, growth, below + more_below)[:-1],
            _divided(centre, length, zone, growth, above + more_above),
        ]
    )


def geometric(ratio: float, count: int) -> Floats:
    """(count + 1,) positions from 0 to 1, each interval ``ratio`` times the one after it."""
    intervals = ratio ** np.arange(count, dtype=np.float64)[::-1]
    return np.concatenate([[0.0], np.cumsum(intervals) / intervals.sum()])


def graded_count(length: float, zone: FineZone, growth: float) -> int:
    """Least number of intervals that :func:`graded` needs."""
    return sum(_counts(length, zone, growth))


def _counts(length: float, zone: FineZone, growth: float) -> tuple[int, int]:
    low, centre, high = _intervals_up_to(np.array([0.0, min(max(zone.centre, 0.0), length), length]), zone, growth)
    return int(np.ceil(centre - low - 1e-9)), int(np.ceil(high - centre - 1e-9))


def _divided(start: float, end: float, zone: FineZone, growth: float, count: int) -> Floats:
    """(count + 1,) positions from start to end with equal shares of the interval density."""
    if count == 0:
        return np.array([start])
    positions = np.linspace(start, end, _SAMPLES)
    density = _intervals_up_to(positions, zone, growth)
    divided = np.interp(np.linspace(density[0], density[-1], count + 1), density, positions)
    divided[[0, -1]] = start, end
    return divided


def _intervals_up_to(position: Floats, zone: FineZone, growth: float) -> Floats:
    """Integral of the interval density from the zone's centre; the interval size grows linearly outside."""
    slope = np.log(growth)
    distance = np.abs(position - zone.centre)
    inside = np.minimum(distance, zone.half_width) / zone.size
    beyond = np.maximum(distance - zone.half_width, 0.0)
    growing = np.minimum(beyond, max(zone.largest - zone.size, 0.0) / slope)
    outside = np.log1p(slope * growing / zone.size) / slope + (beyond - growing) / max(zone.largest, zone.size)
    return np.sign(position - zone.centre) * (inside + outside)
