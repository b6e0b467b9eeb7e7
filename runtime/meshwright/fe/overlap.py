"""Where two flanks would lie in one another: the rectangle of the contact plane that cells divide without an ellipse.

A tangency has its Hertz ellipse to go by, as long as that is not many times as large as the flanks. Where an edge
touches the flanks open like a wedge to one side and there is nothing on the other, and the tangency of the same pair
may come into contact too: the rectangle is found from the gaps.
"""

import numpy as np

from meshwright.fe.gap import Bools, ContactGrid, ContactPlane, cell_centres, contact_grid
from meshwright.fe.hexahedra import Floats

# Cells along a side with which the rectangle is looked for, and the part of them that has to overlap.
_CELLS = 15
_FILLED = 0.4
# Rounds of looking, and how much wider than what overlaps the rectangle is, in parts of its sides.
_ROUNDS = 10
_ROOM = 0.08


def overlap_grid(plane: ContactPlane, apart: float, closing: float, cells: int) -> ContactGrid | None:
    """Grid of cells x cells over the part of the contact plane where the gap is less than what the load closes.

    apart: gap of the pair at its first contact, mm, where the load closes ``closing``, which is more.  None where
    nothing overlaps.
    """
    touch = plane.contact.touch
    curvatures = np.array([touch.curvature_min, touch.curvature_max])
    return fitted_grid(plane, np.sqrt(2.0 * (closing - apart) / curvatures), closing, cells)


def fitted_grid(plane: ContactPlane, reach: Floats, closing: float, cells: int) -> ContactGrid | None:
    """The same, looked for from a rectangle of half sides ``reach`` (2,) in mm about the contact point."""
    centre, found = np.zeros(2), False
    for _ in range(_ROUNDS):
        gap, inside = plane.gaps(plane.feet(cell_centres(reach, _CELLS, centre)))
        overlaps = (inside & (gap < closing)).reshape(_CELLS, _CELLS)
        if not overlaps.any():
            if found:
                break
            reach = reach / 3.0  # what is there may be narrower than a cell
            continue
        found, (centre, reach, done) = True, _fitted(overlaps, centre, reach)
        if done:
            break
    return contact_grid(plane, reach, cells, centre) if found else None


def _fitted(overlaps: Bools, centre: Floats, reach: Floats) -> tuple[Floats, Floats, bool]:
    """Centre (2,) and half sides (2,) about the overlapping ones of square cells (S, S), wider where they go on at the
    border, and whether that is as good as cells of this size can tell.
    """
    low, high, done = np.empty(2), np.empty(2), True
    for axis in (0, 1):
        (used,) = np.nonzero(overlaps.any(axis=1 - axis))
        size, count = 2.0 * reach[axis] / len(overlaps), used[-1] - used[0] + 1
        begins, ends = bool(used[0] == 0), bool(used[-1] == len(overlaps) - 1)
        room = _ROOM * count * size
        low[axis] = used[0] * size - (0.5 * count * size if begins else room)
        high[axis] = (used[-1] + 1) * size + (0.5 * count * size if ends else room)
        done &= not (begins or ends) and bool(count >= _FILLED * len(overlaps))
    return centre - reach + 0.5 * (low + high), 0.5 * (high - low), done
