"""The part of a flank that a contact runs over, as a grid: the path of contact and room for its ellipses."""

from dataclasses import dataclass

import numpy as np

from meshwright.flank.chart import Chart
from meshwright.report.projection import Projection

#: Room around the path, in contact ellipses.
ROOM = 1.3

#: Least and largest number of grid points along a parameter.
LEAST, LARGEST = 21, 480


@dataclass(frozen=True)
class Patch:
    """A grid of a flank: surface ``parameters`` (rows, columns, k), ``points`` and outward unit ``normals``
    (rows, columns, 3), body frame, mm; ``inside`` (rows, columns) is the least margin to a limit of the design,
    negative beyond it. NaN where no flank exists.
    """

    parameters: np.ndarray
    points: np.ndarray
    normals: np.ndarray
    inside: np.ndarray

    @property
    def projection(self):
        """How the flank is best laid flat."""
        shown = np.isfinite(self.points).all(axis=2)
        return Projection.of(self.points[shown], self.normals[shown])

    @classmethod
    def of(cls, flank, parameters):
        """The patch at a grid of parameters (rows, columns, k)."""
        shape = parameters.shape[:2]
        at = flank(parameters.reshape(-1, parameters.shape[2]))
        margins = [values for values in at.margins.values() if np.any(np.isfinite(values))]
        inside = np.min([at.regular, *margins], axis=0)
        return cls(parameters, at.points.reshape(*shape, 3), at.normals.reshape(*shape, 3), inside.reshape(shape))


def patch(flank, path, axes, cell):
    """The :class:`Patch` around a path of contact: parameters ``path`` (N, k), semi-axes of the contact ellipses
    there ``axes`` (N, 2, 3), body frame, mm.

    The first two of the flank's parameters span the grid, with cells of about ``cell`` mm; others are solved from the
    flank's own conditions.
    """
    at, chart = flank(path), Chart(flank, (0, 1), flank.sizes)
    slopes = np.concatenate([np.swapaxes(at.tangents, 1, 2), at.conditions[:, :, 1:]], axis=1)
    inverse = np.linalg.pinv(slopes)[:, :, :3]
    reach = ROOM * np.linalg.norm(np.einsum("nkx,nax->nka", inverse, axes), axis=2)
    low, high = (path - reach).min(axis=0), (path + reach).max(axis=0)
    speed = np.linalg.norm(chart.by_coordinates(at, np.swapaxes(at.tangents, 1, 2)), axis=1).mean(axis=0)
    counts = np.clip(np.ceil((high - low)[:2] * speed / cell), LEAST, LARGEST).astype(int)
    lines = [np.linspace(low[i], high[i], counts[i]) for i in (0, 1)]
    grid = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)
    near = _extended(path, grid)
    completed = chart.complete(grid.reshape(-1, 2), near.reshape(-1, near.shape[2]))
    return Patch.of(flank, completed.reshape(near.shape))


def _extended(path, grid):
    """The grid with further parameters, where the path has such, that follow the path linearly."""
    linear = np.column_stack([np.ones(len(path)), path[:, :2]])
    slopes, *_ = np.linalg.lstsq(linear, path[:, 2:], rcond=None)
    return np.concatenate([grid, slopes[0] + grid @ slopes[1:]], axis=2)
