"""Lines of a chart from inside a region to where they leave it."""

from dataclasses import dataclass

import numpy as np

from meshwright.base.roots import narrowed
from meshwright.flank.bounds import Limits
from meshwright.flank.chart import Chart

#: A ray from inside the region to its end: first step in natural sizes, growth of the steps, how many at most.
FIRST_STEP, GROWTH, MAX_STEPS = 1.0 / 64.0, 1.3, 48

#: What holds the end of a ray is divided into so many parts, and the end located to so many units in the last place.
PARTS, LAST_PLACES = 32, 4.0


def leave(chart, limits, start, ways):
    """Where a chart's lines through an inner place leave the region, one for each of the ``ways``, an axis and a sign:
    coordinate (infinite if it does not), the limit that ends it, and the last place (k,) inside.
    """
    rays = _Rays.of(chart, limits, start, ways)
    ended = np.flatnonzero(np.isfinite(rays.outer))
    ends, sizes = rays.divided(ended), np.maximum(*np.abs([rays.inner[ended], rays.outer[ended]]))
    exact = LAST_PLACES * np.spacing(sizes)
    rays.inner[ended], rays.outer[ended] = narrowed(
        lambda at, which: rays.least(at, ended[which]), rays.inner[ended], rays.outer[ended], ends, exact
    )
    rays.divided(ended)
    names = [limits.names[k] if np.isfinite(end) else None for end, k in zip(rays.outer, rays.limit, strict=True)]
    reached = np.where(np.isfinite(rays.outer), rays.inner, rays.outer)
    return list(zip(reached.tolist(), names, rays.q, strict=True))


@dataclass(frozen=True)
class _Rays:
    """Lines of a chart through the coordinates ``here`` (2,), R of them, along ``axes`` (R,). Each leaves the region
    between its coordinates ``inner`` and ``outer`` (R,), the latter infinite if it does not, by a limit's number
    ``limit`` (R,); ``q`` (R, k) are the last places inside.
    """

    chart: Chart
    limits: Limits
    here: np.ndarray
    axes: np.ndarray
    inner: np.ndarray
    outer: np.ndarray
    limit: np.ndarray
    q: np.ndarray

    @classmethod
    def of(cls, chart, limits, start, ways):
        """Followed from an inner place, in ever longer steps, until they have left the region."""
        here, axes = start[list(chart.free)], np.array([axis for axis, _ in ways])
        steps = np.array([sign for _, sign in ways]) * FIRST_STEP * chart.sizes[list(chart.free)][axes]
        limit, q = np.zeros(len(ways), dtype=int), np.tile(start, (len(ways), 1))
        rays = cls(chart, limits, here, axes, here[axes], np.copysign(np.inf, steps), limit, q)
        going = np.arange(len(ways))
        for _ in range(MAX_STEPS):
            further = rays.inner[going] + steps[going]
            inside = rays.least(further, going) >= 0.0
            rays.outer[going[~inside]] = further[~inside]
            going = going[inside]
            if not going.size:
                break
            rays.inner[going], steps[going] = further[inside], GROWTH * steps[going]
        return rays

    def least(self, at, which):
        """The least limit (M,) at coordinates (M,) of the rays ``which`` (M,), which keep what they meet."""
        trials, values = self._at(at, which)
        least = values.min(axis=1)
        inside = least >= 0.0
        self.q[which[inside]], self.limit[which[~inside]] = trials[inside], np.argmin(values[~inside], axis=1)
        return least

    def divided(self, which):
        """Narrow some rays to the first of the places between at which they are outside; the least limit inside, and
        that outside.
        """
        at = self.inner[which, None] + np.arange(PARTS + 1) / PARTS * (self.outer - self.inner)[which, None]
        trials, values = self._at(at[:, 1:].ravel(), np.repeat(which, PARTS))
        trials, values = (found.reshape(len(which), PARTS, found.shape[1]) for found in (trials, values))
        outside = ~(values.min(axis=2) >= 0.0)
        outside[:, -1] = True  # the outer end, whose coordinate rounding may have moved
        rows, first = np.arange(len(which)), np.argmax(outside, axis=1)
        self.limit[which] = np.argmin(values[rows, first], axis=1)
        self.q[which] = np.where(first[:, None] > 0, trials[rows, first - 1], self.q[which])
        self.inner[which], self.outer[which] = at[rows, first], at[rows, first + 1]
        return self.limits.least(self.chart.flank(self.q[which])), values[rows, first].min(axis=1)

    def _at(self, at, which):
        places = np.tile(self.here, (len(at), 1))
        places[np.arange(len(at)), self.axes[which]] = at
        trials = self.chart.complete(places, self.q[which])
        return trials, self.limits.values(self.chart.flank(trials))
