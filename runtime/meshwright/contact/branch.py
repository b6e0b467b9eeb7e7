"""A branch of contact followed in arclength: through folds, where it turns back, and past crossings with others."""

from dataclasses import dataclass

import numpy as np

from meshwright.base.library import library, pointer

#: Steps along a branch, in natural sizes of the unknowns and radians of the input angle, and how many each way.
STEP, STEPS = 0.1, 150


@dataclass(frozen=True)
class Branch:
    """Consecutive points of a branch: ``angles`` (N,), ``unknowns`` (N, nx), ``slopes`` dφ/darclength, bordered
    ``determinants``.
    """

    angles: np.ndarray
    unknowns: np.ndarray
    slopes: np.ndarray
    determinants: np.ndarray

    def up_to(self, count):
        """Its first points."""
        return Branch(*(a[:count] for a in (self.angles, self.unknowns, self.slopes, self.determinants)))

    @property
    def turns(self):
        """Steps (M,) on which the branch turns back."""
        return np.flatnonzero(self.slopes[:-1] * self.slopes[1:] < 0.0)

    @property
    def crossings(self):
        """Steps (M,) on which another branch crosses."""
        return np.flatnonzero(self.determinants[:-1] * self.determinants[1:] < 0.0)


def follow(drive, angle, unknowns, step=STEP, count=STEPS):
    """The :class:`Branch` through a solved contact; towards larger angles first if ``step`` > 0.

    Steps are in natural sizes of the unknowns and radians of the input angle.
    """
    m, s = drive.model, drive.state(angle)
    angles, slopes, determinants = (np.empty(count + 1) for _ in range(3))
    x = np.empty((count + 1, m.nx))
    start = np.ascontiguousarray(unknowns, dtype=float)
    arrays = (pointer(a) for a in (angles, x, slopes, determinants))
    n = library().mw_arclength(m, pointer(s), angle, pointer(start), step, count, *arrays)
    return Branch(angles[:n], x[:n], slopes[:n], determinants[:n])


def turning_point(drive, branch, k):
    """(input angle, unknowns) of the fold on step k of a branch; None if there is none."""
    return _singular(drive, branch, k, False, branch.slopes)


def crossing_point(drive, branch, k):
    """(input angle, unknowns) of where another branch crosses on step k of a branch; None if none does."""
    return _singular(drive, branch, k, True, branch.determinants)


def _singular(drive, branch, k, crossing, indicator):
    """The singular point on step k, on which the ``indicator`` (N,) changes sign, by its extended system."""
    share = indicator[k] / (indicator[k] - indicator[k + 1])
    angle, unknowns = (a[k] + share * (a[k + 1] - a[k]) for a in (branch.angles, branch.unknowns))
    place, x = np.array([angle]), np.ascontiguousarray(unknowns)
    found = library().mw_branch_point(
        drive.model, pointer(drive.state(angle)), int(crossing), pointer(place), pointer(x)
    )
    return (float(place[0]), x) if found >= 0 else None


def fold_angle(path, side):
    """Input angle of a fold between the path's lower (0) or upper (-1) end and the node after it; None without one."""
    drive, sense = path.drive, 1.0 if side else -1.0
    branch = follow(drive, path.angles[side], path.unknowns[side], sense * STEP, STEPS)
    if not len(branch.turns):
        return None
    found = turning_point(drive, branch, branch.turns[0])
    if found is None or abs(found[0] - path.angles[side]) > path.spacing:
        return None
    return float(found[0])
