"""Where the contacts over the pinion angle pass from one branch of contact to another: curves are broken there."""

import numpy as np

from meshwright.cycle.path import Path

#: Solutions nearer than this, relative to their size or 1, are one.
SAME = 1e-6


def breaks(drive, tca):
    """The positions k of a TCA at which contact is not on the branch through position k − 1: (B,) of int.

    Positions without a contact point break no curve: there is none at them.
    """
    mirror = drive.design.mirror.sign
    joints = np.flatnonzero(tca.solved[1:] & tca.solved[:-1]) + 1
    return np.array([k for k in joints if not _one_branch(drive, mirror * tca.angles, tca.solutions, k)], dtype=int)


def broken(values, places):
    """Values (N, …) over the positions with a row of NaN before each of the ``places``."""
    return np.insert(np.asarray(values, dtype=float), places, np.nan, axis=0)


def _one_branch(drive, angles, solutions, k):
    """Whether the solution before position ``k``, followed to its angle, becomes its solution."""
    path = Path.through(drive, angles[k - 1], solutions[k - 1]).extended(angles[k])
    reached = path.angles[-1] == angles[k] if angles[k] > angles[k - 1] else path.angles[0] == angles[k]
    end = path.unknowns[-1 if angles[k] > angles[k - 1] else 0]
    return bool(reached and np.allclose(end, solutions[k], rtol=SAME, atol=SAME))
