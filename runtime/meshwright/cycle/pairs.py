"""Tooth pairs in mesh together: who touches, how far the others are apart, how many teeth that makes.

The pair k positions later runs on the same curve, TE_k(φ) = TE(φ − k·pitch). A rigid pinion pushes the wheel to the
largest (or, on the other flank, smallest) transmission error of all pairs: the upper (lower) envelope.
"""

import math
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from meshwright.base.roots import bracketed
from meshwright.contact.analysis import at_solutions
from meshwright.contact.results import impossible
from meshwright.cycle.extremes import Extremes
from meshwright.cycle.first_contact import search_from
from meshwright.cycle.model import DriveModel
from meshwright.cycle.rigid import ROUND_OFF, RigidTeeth
from meshwright.cycle.windows import Window, status_at

#: Sampling of one pitch when looking for changes in the number of teeth in contact.
SAMPLES = 96

#: Changes of the number of teeth are located to this angle, rad.
ANGLE_TOLERANCE = 1e-12


#: Errors at so many angles show whether they are one, from this share of the window inside its ends on.
LOOKS = 9
INNER = 1e-6


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

    drive: DriveModel
    window: Window

    @classmethod
    def of(cls, drive):
        """The mesh of a drive; without a path of contact (see the window's status) only that can be asked of it."""
        return cls(drive, drive.window)

    @property
    def mirror(self):
        return self.drive.design.mirror.sign

    @property
    def envelope(self):
        """Which envelope of the transmission errors is transmitted: "upper" or "lower"."""
        return "upper" if self.sense > 0 else "lower"

    @property
    def middle(self):
        """Angle of the right-hand drive in the middle of the window, or that to which relative errors refer."""
        middle = 0.5 * self.mirror * (self.window.begin.angle + self.window.end.angle)
        return middle if math.isfinite(middle) else self.drive.design.reference_angle

    @cached_property
    def impossible(self):
        """Flags that points between the ends of the window carry and that mark what bodies cannot make."""
        path = self.window.path
        if path is None:
            return ()
        lower, upper = self.window.bounds
        inside = (path.angles >= lower) & (path.angles <= upper)
        found = at_solutions(self.drive, path.angles[inside], path.unknowns[inside])
        return tuple(dict.fromkeys(f for flags in found.flags for f in flags if impossible(f)))

    @cached_property
    def path(self):
        """The path of tangencies along which pairs touch; None where there is none, or one that bodies cannot make
        while their flanks' extremes say where they touch.
        """
        return None if self.impossible and self.window.complete and self.search else self.window.path

    @cached_property
    def status(self):
        """Status word of the contact of a pair in the middle of its window."""
        if self.path is self.window.path:
            return self.window.status
        return status_at(self.drive, self.middle, self.window.status)

    @cached_property
    def contact(self):
        """What says where a pair touches: its path or, where it has none, the extremes of the wheel's turn; None where
        neither is known.
        """
        if self.path is not None:
            return self.path
        return None if self.search is None else Extremes(self.search)

    @cached_property
    def constant(self):
        """Whether flanks without a path transmit one error while they touch, but for rounding."""
        if self.path is not None or not self.window.complete:
            return False
        low, high = sorted((self.window.begin.angle, self.window.end.angle))
        inner = INNER * (high - low)
        return bool(np.ptp(self.errors(np.linspace(low + inner, high - inner, LOOKS))) < ROUND_OFF)

    @property
    def sense(self):
        """+1 where the wheel is pushed to larger angles, −1 to smaller: the side on which the gap opens."""
        path = self.window.path
        if path is None:
            return math.nan if self.contact is None else self.mirror * self.contact.sense
        for angle in path.angles[np.argsort(np.abs(path.angles))]:
            (lever,) = path.levers([angle])
            if math.isfinite(lever) and lever != 0.0:
                return self.mirror * math.copysign(1.0, lever)
        return math.nan

    @cached_property
    def search(self):
        """The search for first contacts of a pair: see :func:`~meshwright.cycle.first_contact.search_from`."""
        return search_from(self.drive, self.window.path)

    @cached_property
    def rigid(self):
        """The mesh's :class:`~meshwright.cycle.rigid.RigidTeeth`; None where the blank does not bound its flanks."""
        return RigidTeeth.of(self)

    @property
    def contact_ratio(self):
        """Pitches from begin to end; NaN if an end does not exist."""
        return self.window.span / self.drive.pitch()

    @property
    def gap(self):
        """Pinion angle of every pitch over which no pair is inside its window, rad; 0 from a contact ratio of 1 on, NaN
        if an end does not exist.
        """
        gap = self.drive.pitch() - self.window.span
        return gap if math.isnan(gap) else max(gap, 0.0)

    def errors(self, angles):
        """Transmission error of pair 0, rad, at pinion angles (M,); NaN where its path does not reach."""
        return self.mirror * self.contact.errors(self.mirror * np.atleast_1d(angles))

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
        """Every :class:`Pair` inside its window at a pinion angle, nearest to contact first."""
        numbers = list(self.numbers(angle))
        if not numbers:
            return ()
        if self.contact is None:
            return tuple(Pair(k, angle - k * self.drive.pitch(), math.nan, math.nan) for k in numbers)
        own = np.array([angle - k * self.drive.pitch() for k in numbers])
        errors = self.errors(own)
        levers = np.abs(self.contact.levers(self.mirror * own))
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
        calls the average contact ratio. In a window that begins where it ends: of the one instant.
        """
        if not self.window.complete:
            return math.nan
        if self.window.span == 0.0:
            return float(self.teeth_in_contact(self.window.begin.angle))
        lengths, counts = self._steps
        whole, part = divmod(self.window.span, self.drive.pitch())
        before = np.cumsum(lengths) - lengths
        reached = np.clip(part - before, 0.0, lengths)
        return float(whole * np.dot(lengths, counts) + np.dot(reached, counts)) / self.window.span

    @cached_property
    def _steps(self):
        """The number of teeth in contact over one pitch from the smaller end of the window: lengths and counts.

        The ends of the windows are changes by themselves: with span n·pitch + f, n + 1 pairs are inside over f and n
        over the rest, however short either is.
        """
        pitch = self.drive.pitch()
        whole, part = divmod(self.window.span, pitch)
        lengths, counts = np.array([part, pitch - part]), np.array([whole + 1.0, whole])
        if not self.allowance > 0.0:
            return lengths, counts
        start = min(self.window.begin.angle, self.window.end.angle)
        parts = [self._closed(start + a, start + b) for a, b in ((0.0, part), (part, pitch)) if b > a]
        return tuple(np.concatenate(columns) for columns in zip(*parts, strict=True))

    def _closed(self, low, high):
        """Lengths and counts, ascending, of the pairs that the allowance closes between two changes of the windows."""
        inner = min(1e-9 * (high - low), ANGLE_TOLERANCE)
        places = np.linspace(low + inner, high - inner, max(3, math.ceil((high - low) / self.drive.pitch() * SAMPLES)))
        places = np.sort(np.concatenate([places, self._turning(places)]))
        counts, ends, kept = [self.teeth_in_contact(p) for p in places], [low], []
        for a, b, count, last in zip(places, places[1:], counts, counts[1:], strict=False):
            while count != last:
                changed = partial(self._differs, count)
                a = bracketed(changed, a, b, ANGLE_TOLERANCE, (0.5, -0.5))
                ends.append(a)
                kept.append(count)
                a = min(a + 2.0 * ANGLE_TOLERANCE, b)
                count = self.teeth_in_contact(a)
        return np.diff([*ends, high]), np.array([*kept, counts[-1]], dtype=float)

    def _differs(self, count, angle):
        """Negative where another number of pairs is in contact than ``count``."""
        return 0.5 - (self.teeth_in_contact(angle) != count)

    def _turning(self, places):
        """Where the separation of a pair may come to the allowance and go back between two of ascending places (P,)."""
        present = [{pair.number: pair.separation - self.allowance for pair in self.pairs(p)} for p in places]
        found = []
        for number in set().union(*present):
            values = np.array([entry.get(number, math.nan) for entry in present])
            before, here, after = values[:-2], values[1:-1], values[2:]
            with np.errstate(invalid="ignore", divide="ignore"):
                bend = before - 2.0 * here + after
                shift = 0.5 * (before - after) / bend
                dips = (here * (here - 0.125 * (before - after) ** 2 / bend) < 0.0) & (np.abs(shift) < 1.0)
                dips &= (before * here > 0.0) & (after * here > 0.0)
            found.append((places[1:-1] + shift * (places[1] - places[0]))[dips])
        return np.concatenate(found or [np.empty(0)])
