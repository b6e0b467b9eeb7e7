"""Where the contacts over the pinion angle pass from one branch of contact to another: curves are broken there."""

import numpy as np

from meshwright.cycle.path import Path

#: Solutions nearer than this, relative to their size or 1, are one.
SAME = 1e-6


def breaks(drive, tca):
    """The positions k of a TCA at which contact is not on the branch through position k − 1: (B,) of int.

    Positions without a contact point break no curve: there is none at them.
    """
    known = np.flatnonzero(tca.solved)
    angles, found = drive.design.mirror.sign * tca.angles, []
    for run in np.split(known, np.flatnonzero(np.diff(known) > 1) + 1):
        while run.size > 1:
            run = run[_on_one_branch(drive, angles[run], tca.solutions[run]) :]
            found += run[:1].tolist()
    return np.array(found, dtype=int)


def broken(values, places):
    """Values (N, …) over the positions with a row of NaN before each of the ``places``."""
    return np.insert(np.asarray(values, dtype=float), places, np.nan, axis=0)


def _on_one_branch(drive, angles, solutions):
    """How many of the solutions at angles (N,), ascending or descending, lie on the branch through the first."""
    path = Path.through(drive, angles[0], solutions[0]).extended(angles[-1])
    there = path.solve(angles[1:])
    same = np.isclose(there, solutions[1:], rtol=SAME, atol=SAME).all(axis=1)
    return len(angles) if same.all() else 1 + int(np.argmin(same))
