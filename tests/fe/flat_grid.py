"""Pressure cells on a plane, for what cells do to one another wherever they come from."""

import numpy as np

from meshwright.fe.gap import ContactGrid

ALL_ROUND = ((0, 1.0), (1, 0.0), (1, 1.0))


def flat_grid(centres, half, place, free_edges=ALL_ROUND):
    """Equal cells of half sides ``half`` at centres (N, 2), a row each, at places (N, 2) of the wheel's flank."""
    count = len(centres)
    nothing = np.zeros(count)
    return ContactGrid(
        rows=count,
        columns=1,
        centres=centres,
        half=np.tile(half, (count, 1)),
        rectangle=np.tile(half, (count, 1)),
        ways=np.tile(np.eye(2), (count, 1, 1)),
        frame=np.tile(np.eye(3), (count, 1, 1)),
        points=np.column_stack([centres, nothing]),
        gap=nothing,
        row_gap=nothing,
        offset=nothing,
        free=np.zeros((2, count), dtype=bool),
        beyond={},
        sharp=np.zeros((4, count)),
        place={"wheel": place},
        free_edges={"wheel": free_edges},
    )
