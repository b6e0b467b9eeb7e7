"""Tooth pairs in mesh together: who touches, how far the others are apart, how many teeth that makes.

The pair k positions later runs on the same curve, TE_k(φ) = TE(φ − k·pitch). A rigid pinion pushes the wheel to the
largest (or, on the other flank, smallest) transmission error of all pairs: the upper (lower) envelope.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from meshwright.base.roots import bracketed
from meshwright.cycle.windows import Window, contact_window

#: Sampling of one pitch when looking for changes in the number of teeth in contact.
SAMPLES = 96

#: Changes of the number of teeth are located to this angle, rad.
ANGLE_TOLERANCE = 1e-12


@dataclass(frozen=True)
class Pair:
    """One pair at one input angle: its ``number`` k, its own angle φ − k·pitch, its transmission error (rad),
    and its ``separation`` from contact along the normal, mm, while the leading pair touches.
    """

    number: int
    angle: float
    error: float
    separation: float


@dataclass(frozen=True)
class Mesh:
    """All tooth pairs of a drive over one window. Angles in rad; pinion angles as the user counts them."""

    drive: object
    window: Window

    @classmethod
    def of(cls, drive):
        """The mesh of a drive; without a path of contact (see the window's status) only that can be asked of it."""
        return cls(drive, contact_window(drive))

    @property
    def mirror(self):
        return self.drive.design.mirror.sign

    @property
    def envelope(self):
        """Which envelope of the transmission errors is transmitted: "upper" or "lower"."""
        return "upper" if self.sense > 0 else "lower"

    @property
    def sense(self):
        """+1 where the wheel is pushed to larger angles, −1 to smaller: the side on which the gap opens."""
        path = self.window.path
        middle = path.angles[np.argmin(np.abs(path.angles))]
        return self.mirror * float(np.sign(path.levers([middle])[0]))

    @property
    def contact_ratio(self):
        """Pitches from begin to end; NaN if an end does not exist."""
        return self.window.span / self.drive.pitch()

    def errors(self, angles):
        """Transmission error of pair 0, rad, at pinion angles (M,); NaN where its path does not reach."""
        return self.mirror * self.window.path.errors(self.mirror * np.atleast_1d(angles))

    def numbers(self, angle, reach=None):
        """The pairs inside their windows at a pinion angle: k with begin ≤ φ − k·pitch ≤ end.

        ``reach`` are other smallest and largest own angles of a pair, if not those of its window.
        """
        if reach is None and not self.window.complete:
            return range(1)
        low, high = reach or sorted((self.window.begin.angle, self.window.end.angle))
        pitch = self.drive.pitch()
        return range(math.ceil((angle - high) / pitch), math.floor((angle - low) / pitch) + 1)

    def pairs(self, angle):
        """Every :class:`Pair` inside its window at a pinion angle, nearest to contact first.

        Flanks that touch along lines transmit uniformly: all their pairs touch.
        """
        numbers = list(self.numbers(angle))
        if not numbers:
            return ()
        if self.window.path is None:
            return tuple(Pair(k, angle - k * self.drive.pitch(), math.nan, 0.0) for k in numbers)
        own = np.array([angle - k * self.drive.pitch() for k in numbers])
        errors = self.errors(own)
        levers = np.abs(self.window.path.levers(self.mirror * own))
        if not np.any(np.isfinite(errors)):
            return ()
        behind = np.maximum(np.nanmax(self.sense * errors) - self.sense * errors, 0.0)
        found = zip(numbers, own.tolist(), errors.tolist(), (behind * levers).tolist(), strict=True)
        return tuple(sorted((Pair(*entry) for entry in found), key=lambda p: p.separation))

    def teeth_in_contact(self, angle):
        """Number of pairs inside their windows; with an elastic allowance, of those that it closes."""
        allowance = self.allowance
        if not allowance > 0.0:
            return len(self.numbers(angle))
        return sum(pair.separation <= allowance for pair in self.pairs(angle))

    @property
    def allowance(self):
        """The design's elastic allowance, mm; 0 where the family has none."""
        try:
            allowance = self.drive.design.value("elastic_allowance_mm", "contact")
        except KeyError:
            return 0.0
        return 0.0 if math.isnan(allowance) else allowance

    def average_over_pitch(self):
        """Average number of teeth in contact over one pitch; NaN without both ends."""
        if not self.window.complete:
            return math.nan
        return float(np.dot(*self._steps)) / self.drive.pitch()

    def average_begin_to_end(self):
        """Average number of teeth in contact over the window of one pair; NaN without both ends.

        With contact ratio n + f and no allowance this is ((n+1)² f + n² (1−f))/(n + f), what the recess-action paper
        calls the average contact ratio.
        """
        if not self.window.complete:
            return math.nan
        lengths, counts = self._steps
        whole, part = divmod(self.window.span, self.drive.pitch())
        before = np.cumsum(lengths) - lengths
        reached = np.clip(part - before, 0.0, lengths)
        return float(whole * np.dot(lengths, counts) + np.dot(reached, counts)) / self.window.span

    @cached_property
    def _steps(self):
        """The number of teeth in contact over one pitch from the smaller end of the window: lengths and counts."""
        start, pitch = min(self.window.begin.angle, self.window.end.angle), self.drive.pitch()
        places = start + pitch * (np.arange(SAMPLES + 1) + 0.5) / (SAMPLES + 1)
        counts = [self.teeth_in_contact(p) for p in places]
        jumps = [
            self._jump(a, b, first)
            for a, b, first, last in zip(places, places[1:], counts, counts[1:], strict=False)
            if first != last
        ]
        kept = [counts[0], *(b for a, b in zip(counts, counts[1:], strict=False) if a != b)]
        return np.diff([start, *jumps, start + pitch]), np.array(kept)

    def _jump(self, a, b, first):
        return bracketed(lambda p: 0.5 - (self.teeth_in_contact(p) != first), a, b, ANGLE_TOLERANCE, (0.5, -0.5))
