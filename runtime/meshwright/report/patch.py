"""The part of a flank that a contact runs over, as a grid: the path of contact and room for its ellipses."""

from dataclasses import dataclass

import numpy as np

#: Room around the path, in contact ellipses.
ROOM = 1.3

#: Least and largest number of grid points along a parameter.
LEAST, LARGEST = 9, 640

_NEWTON_STEPS = 30


@dataclass(frozen=True)
class Patch:
    """A grid of a flank, body frame: ``points`` and outward unit ``normals`` (rows, columns, 3), mm; ``inside``
    (rows, columns) is the least margin to a limit of the design, negative beyond it. NaN where no flank exists."""

    points: np.ndarray
    normals: np.ndarray
    inside: np.ndarray


def patch(flank, path, axes, cell):
    """The :class:`Patch` around a path of contact: parameters ``path`` (N, k), semi-axes of the contact ellipses
    there ``axes`` (N, 2, 3), body frame, mm.

    The first two of the flank's parameters span the grid, with cells of about ``cell`` mm; a third parameter is
    solved from the flank's own condition.
    """
    at = flank(path)
    slopes = np.concatenate([np.swapaxes(at.tangents, 1, 2), at.conditions[:, :, 1:]], axis=1)
    inverse = np.linalg.pinv(slopes)[:, :, :3]
    reach = ROOM * np.linalg.norm(np.einsum("nkx,nax->nka", inverse, axes), axis=2)
    low, high = (path - reach).min(axis=0), (path + reach).max(axis=0)
    speed = np.linalg.norm(at.tangents, axis=2).mean(axis=0)
    counts = np.clip(np.ceil((high - low) * speed / cell), LEAST, LARGEST).astype(int)
    lines = [np.linspace(low[i], high[i], counts[i]) for i in (0, 1)]
    grid = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, 2)
    return _shaped(flank(_completed(flank, path, grid)), tuple(counts[:2]))


def _shaped(at, shape):
    margins = [values for values in at.margins.values() if np.any(np.isfinite(values))]
    inside = np.min([at.regular, *margins], axis=0)
    return Patch(at.points.reshape(*shape, 3), at.normals.reshape(*shape, 3), inside.reshape(shape))


def _completed(flank, path, grid):
    """The grid's two parameters with the third, where there is one, solved from the flank's condition (Newton)."""
    if len(flank.parameters) == 2:
        return grid
    linear = np.column_stack([np.ones(len(path)), path[:, :2]])
    guess, *_ = np.linalg.lstsq(linear, path[:, 2], rcond=None)
    q = np.column_stack([grid, np.column_stack([np.ones(len(grid)), grid]) @ guess])
    for _ in range(_NEWTON_STEPS):
        condition = flank(q).conditions[:, 0]
        q[:, 2] -= condition[:, 0] / condition[:, 3]
    unsolved = ~(np.abs(condition[:, 0] / condition[:, 3]) < 1e-9)
    q[unsolved] = np.nan
    return q
