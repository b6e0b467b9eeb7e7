"""The contact of a pair by the extreme of the wheel's turn at each of its angles, where no branch of tangencies says
it.
"""

from dataclasses import dataclass

import numpy as np

from meshwright.cycle.first_results import OPEN_ENDED, UNKNOWN
from meshwright.cycle.search import Search


@dataclass(frozen=True)
class Extremes:
    """First contacts of a pair, asked like a :class:`~meshwright.cycle.path.Path`; right-hand drive."""

    search: Search

    @property
    def sense(self):
        """+1 where the wheel is pushed to larger angles, −1 to smaller."""
        return self.search.sense

    def errors(self, angles):
        """Transmission error, rad, at input angles (M,); NaN where the flanks do not touch, or it is not known."""
        return self._of(angles, lambda found: found.wheel_turn)

    def levers(self, angles):
        """Signed lever of the wheel, mm, as of a path."""
        return self._of(angles, lambda found: found.lever)

    def _of(self, angles, value):
        found = self.search.at(np.atleast_1d(np.asarray(angles, dtype=float)))
        return np.array([np.nan if f in (None, UNKNOWN, OPEN_ENDED) else value(f) for f in found])
