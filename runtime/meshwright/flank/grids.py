"""Grids over a region of a tooth: N places across it, along the profile, and M along it.

Along the tooth they stand at equal steps of the axial position, the radius or the last surface parameter, as the drive
says, from one end of the region to the other; across it each line runs from border to border. Lines that miss the
region hold no points.
"""

from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.flank.mesh import Triangulation, mesh
from meshwright.flank.region import CELLS, NEWTON_STEPS, lengthwise, region, solved

#: Samples of a line across the tooth on which its ends are looked for; halvings of the step that holds an end.
SAMPLES, BISECTIONS = 65, 56

#: Lines along the border count as inside: the limits there are zero to rounding, mm; and how much it varies along one.
ROUNDING, NOISE = 1e-9, 1e-13


@dataclass(frozen=True)
class Grid:
    """N × M points of a region in the body frame, row-major, the index along the tooth fastest; NaN off the region.

    ``parameters`` names; ``values`` (N·M, k) in rad or mm; ``points`` (N·M, 3) mm; ``normals`` (N·M, 3) unit, out of
    the material. ``mesh`` is the region with its border resolved, None for a line of points.
    """

    member: str
    region: str
    parameters: tuple[str, ...]
    shape: tuple[int, int]
    values: np.ndarray
    points: np.ndarray
    normals: np.ndarray
    mesh: Triangulation | None = None


def grid(drive, member, shape, name, uses, inset=0.0):
    """The :class:`Grid` of the region ``name`` of a member; ``uses`` as of :func:`~meshwright.flank.region.region`.

    ``inset`` is the share of its length by which the grid stays off either end of the region along the tooth, and of
    the profile's parameter off either end of each line across it.

    Raises :class:`~meshwright.base.errors.UsageError` if nothing of the surface lies within the limits.
    """
    if min(shape) < 2:
        raise UsageError(f"--grid {shape[0]}x{shape[1]}: needs at least 2 points each way; for example --grid 21x41")
    whole = region(drive, member, name, uses)
    triangles = mesh(whole, tuple(n - 1 for n in shape))
    if not len(triangles.triangles):
        raise UsageError(f"{whole.why_empty}; change [blank] or [design]")
    # Coarser triangles may miss a narrow end of the region, beyond which no line would then be looked for.
    close = triangles if min(shape) > CELLS else mesh(whole, tuple(max(CELLS, n - 1) for n in shape))
    values = _Lines.over(whole, close, shape[1], inset).rows(shape[0], inset)
    return _of_design(drive, whole.flank, shape, values, triangles)


def of_design(drive, triangles):
    """A triangulation as the drive of the design's hand has it."""
    if not drive.design.mirrored:
        return triangles
    flip = drive.design.mirror.flip
    return Triangulation(
        triangles.parameters, flip * triangles.points, flip * triangles.normals, triangles.triangles[:, ::-1],
        triangles.border[:, ::-1], triangles.limit,
    )  # fmt: skip


def _of_design(drive, flank, shape, values, triangles):
    """The grid at parameters (N·M, k) of the right-hand drive, as the drive of the design's hand has it."""
    found = flank(values)
    mirror = drive.design.mirror
    flip, signs = mirror.flip, np.array([mirror.factor(name) for name in flank.parameters])
    return Grid(
        flank.body["name"], flank.region, flank.parameters, tuple(shape), signs * values, flip * found.points,
        flip * found.normals, of_design(drive, triangles),
    )  # fmt: skip


@dataclass(frozen=True)
class _Lines:
    """Lines across a region at lengthwise coordinates ``along`` (M,): ``lower`` and ``upper`` (M, k), their ends."""

    region: object
    along: np.ndarray
    lower: np.ndarray
    upper: np.ndarray

    @classmethod
    def over(cls, whole, triangles, count, inset):
        """``count`` lines from near one end of the region to the other; NaN where a line misses it."""
        flank, known = whole.flank, triangles.parameters
        reached, _ = lengthwise(flank, flank(known))
        off = inset * np.ptp(reached)
        along = np.linspace(reached.min() + off, reached.max() - off, count)
        room = np.ptp(known[:, 0]) / SAMPLES
        profile = np.linspace(known[:, 0].min() - room, known[:, 0].max() + room, SAMPLES)
        places = np.stack(np.meshgrid(profile, along, indexing="ij"), axis=-1).reshape(-1, 2)
        near = known[_nearest(np.stack([known[:, 0], reached], axis=1), places)]
        q = _solve(whole, places[:, 0], places[:, 1], near)
        inside = (whole.limits.least(flank(q)) >= -ROUNDING).reshape(SAMPLES, count)
        q = q.reshape(SAMPLES, count, -1)
        first, last = _longest_runs(inside)
        ends = [_end(whole, q, profile, along, first, -1), _end(whole, q, profile, along, last, 1)]
        missed = ~inside.any(axis=0)
        for end in ends:
            end[missed] = np.nan
        return cls(whole, along, *ends)

    def rows(self, count, inset):
        """Parameters (count·M, k): equal steps of the profile's parameter on every line."""
        rows, start = [], self.lower
        for share in np.linspace(inset, 1.0 - inset, count):
            profile = self.lower[:, 0] + share * (self.upper[:, 0] - self.lower[:, 0])
            start = np.where(
                (share in (0.0, 1.0)),
                self.lower if share == 0.0 else self.upper,
                _solve(self.region, profile, self.along, start),
            )
            rows.append(start)
        values = np.concatenate(rows)
        values[~(self.region.limits.least(self.region.flank(values)) >= -ROUNDING)] = np.nan
        return values


def _nearest(known, places):
    """For each place (P, 2) the number of the nearest of known ones (V, 2), in shares of their spread."""
    spread = np.maximum(np.ptp(known, axis=0), 1e-300)
    known, places = known / spread, places / spread
    numbers = np.empty(len(places), dtype=int)
    for first in range(0, len(places), 1024):
        part = places[first : first + 1024]
        numbers[first : first + 1024] = np.argmin(((part[:, None] - known[None]) ** 2).sum(axis=2), axis=1)
    return numbers


def _longest_runs(inside):
    """First and last index (M,) of the longest run of true in each column."""
    first, last, best = (np.zeros(inside.shape[1], dtype=int) for _ in range(3))
    length = np.zeros(inside.shape[1], dtype=int)
    for k, row in enumerate(inside):
        length = np.where(row, length + 1, 0)
        longer = length > best
        best, last = np.where(longer, length, best), np.where(longer, k, last)
        first = np.where(longer, k - length + 1, first)
    return first, last


def _end(whole, q, profile, along, index, sign):
    """Parameters (M, k) where each line leaves the region beyond the sample ``index`` (M,)."""
    columns = np.arange(len(along))
    inner, beyond = profile[index], np.clip(index + sign, 0, len(profile) - 1)
    outer, best = profile[beyond], q[index, columns].copy()
    floor = np.minimum(whole.limits.least(whole.flank(best)), 0.0) - NOISE
    for _ in range(BISECTIONS):
        middle = 0.5 * (inner + outer)
        trial = _solve(whole, middle, along, best)
        good = whole.limits.least(whole.flank(trial)) >= floor
        inner, outer = np.where(good, middle, inner), np.where(good, outer, middle)
        best = np.where(good[:, None], trial, best)
    return best


def _solve(whole, profile, along, start):
    """Parameters (N, k) at profile parameters and lengthwise coordinates (N,), from nearby ones; NaN for none."""
    flank, q, sizes = whole.flank, start.copy(), whole.chart.sizes
    for _ in range(NEWTON_STEPS):
        found = flank(q)
        reached, slopes = lengthwise(flank, found)
        residual = np.concatenate(
            [(q[:, 0] - profile)[:, None], (reached - along)[:, None], found.conditions[:, :, 0]], axis=1
        )
        matrix = np.zeros((len(q), q.shape[1], q.shape[1]))
        matrix[:, 0, 0], matrix[:, 1], matrix[:, 2:] = 1.0, slopes, found.conditions[:, :, 1:]
        step = solved(matrix, residual)
        largest = np.abs(step / sizes).max(axis=1)
        q -= step * np.minimum(1.0, 0.5 / np.maximum(largest, 1e-300))[:, None]
        if not (largest > 1e-12).any():
            break
    q[~(largest < 1e-9)] = np.nan
    return q
