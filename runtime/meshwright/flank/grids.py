"""Grids over a region of a tooth: N places across it, along the profile, and M along it.

Along the tooth they stand at equal steps of the axial position, the radius or the last surface parameter, as the drive
says, from one end of the region to the other; across it each line runs from border to border. Lines that miss the
region hold no points.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from numbers import Real

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.flank.lines import ROUNDING, lines
from meshwright.flank.mesh import Triangulation, mesh

#: Larger grids are taken for a mistake.
MOST_POINTS = 4_000_000


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


def checked_size(shape):
    """The shape of a grid; raises :class:`~meshwright.base.errors.UsageError` for more points than anyone means."""
    if (points := math.prod(map(int, shape))) > MOST_POINTS:
        raise UsageError(f"--grid {'x'.join(map(str, shape))}: {points} points; {MOST_POINTS} at most")
    return shape


def grid(drive, member, shape, name, inset=0.0):
    """The :class:`Grid` of the region ``name`` of a member.

    ``inset`` is the share of its length by which the grid stays off either end of the region along the tooth, and of
    the profile's parameter off either end of each line across it.

    Raises :class:`~meshwright.base.errors.UsageError` if nothing of the surface lies within the limits.
    """
    counts = tuple(shape) if isinstance(shape, Iterable) else ()
    asked = "x".join(map(str, counts)) if len(counts) == 2 else shape
    if len(counts) != 2 or not all(isinstance(n, int | np.integer) and n >= 2 for n in counts):
        raise UsageError(f"--grid {asked}: needs at least 2 points each way; for example --grid 21x41")
    checked_size(counts)
    if not (isinstance(inset, Real) and 0.0 <= inset < 0.5):
        raise UsageError(f"inset = {inset!r}: must be a share from 0 to below 0.5; 0.05 is usual")
    whole = drive.region(member, name)
    triangles = mesh(whole, tuple(n - 1 for n in shape))
    if not len(triangles.triangles):
        raise UsageError(f"{whole.why_empty}; change [blank] or [design]")
    guides = lines(whole, triangles)
    off = inset * np.ptp(guides.along)
    along = np.linspace(guides.along[0] + off, guides.along[-1] - off, shape[1])
    values = guides.at(along).places(np.linspace(inset, 1.0 - inset, shape[0])).reshape(-1, len(whole.chart.sizes))
    values[~(whole.limits.least(whole.flank(values)) >= -ROUNDING)] = np.nan
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
