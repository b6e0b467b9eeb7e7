"""What rigid teeth transmit: over all pairs, the one whose two bounded flanks touch first, tangency, edge or corner."""

import math
from collections import defaultdict
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from meshwright.base.roots import bracketed
from meshwright.contact.results import ARCSEC
from meshwright.cycle.first_contact import pair_errors

#: Angles of one pitch that are looked at first; all pairs are looked at for each third of them, those that may lead for
#: the others; pairs beyond the windows that are looked at on either side.
SAMPLES, STRIDE, BEYOND = 24, 3, 4

#: Errors that differ by less are the same to round-off, rad.
ROUND_OFF = 1e-8 * ARCSEC

#: Where curves cross is located to this share of a pitch at most. Where one jumps, as many steps as a crossing takes do
#: not end at round-off: the error there is then found to this share of what is transmitted.
TRANSFER_TOLERANCE, CROSSING_STEPS, JUMP_RESOLUTION = 1e-10, 12, 1e-8

#: Between samples a curve dips below both by less than this share of what is transmitted.
DIP = 0.1

#: An extreme is located to this share of a sample's width, in so many steps at most, each third by the golden section.
EXTREME_TOLERANCE, EXTREME_STEPS, GOLDEN = 1e-4, 30, 0.381966


@dataclass(frozen=True)
class RigidTeeth:
    """First contact of all pairs of a ``mesh``; ``first`` is :func:`~meshwright.cycle.first_contact.pair_errors`'s.

    Angles and errors in rad; with the mesh's sense of rotation the pair that leads has the largest error. ``known``: by
    angle and pair its error, and what it had to exceed to be told for sure: if it does not, the true one does not.
    ``unknown``: the angles at which a search met the flanks of a pair without finding its first contact.
    """

    mesh: object
    first: object
    known: dict = field(default_factory=lambda: defaultdict(dict), repr=False)
    unknown: set = field(default_factory=set, repr=False)

    @cached_property
    def sense(self):
        """The mesh's: +1 where the wheel is pushed to larger angles, −1 to smaller."""
        return self.mesh.sense

    @classmethod
    def of(cls, mesh):
        """The first contacts of a mesh with both ends; None where the blank does not bound its flanks."""
        if not mesh.window.complete:
            return None
        first = pair_errors(mesh)
        found = None if first is None else cls(mesh, first)
        middle = 0.5 * (mesh.window.begin.angle + mesh.window.end.angle)
        bounded = found is not None and (math.isfinite(found.ahead(0, middle)) or found.unknown)
        return found if bounded else None

    def ahead(self, number, angle, least=-math.inf):
        """Sense times the error at which pair ``number`` touches at a pinion angle; −infinity where it never does.
        Where it touches at no more than ``least``, some error that is no higher: that takes far less to find.
        """
        here = self.known[angle]
        error, exceeded = here.get(number, (-math.inf, math.inf))
        if error <= exceeded and not exceeded <= least:
            until = None if least == -math.inf else self.sense * least
            (error,) = self.first([angle - number * self.mesh.drive.pitch()], until)
            if math.isinf(error):
                self.unknown.add(angle)
            error = float(self.sense * error) if math.isfinite(error) else -math.inf
            here[number] = error, least
        return error

    def highest(self, numbers, angle):
        """The error transmitted by some of the pairs at an angle, with the number of the one that leads: those that are
        likely to lead go first.
        """
        best, highest = None, -math.inf
        for number in numbers:
            error = self.ahead(number, angle, highest)
            if best is None or error > highest:
                best, highest = number, error
        return highest, best

    def leader(self, angle, likely=None):
        """Number of the pair that touches first at a pinion angle, ``likely`` that one, and sense times its error.

        The pairs inside their windows, and beyond them outwards as long as one touches before all that were looked at.
        """
        inside = self.mesh.numbers(angle)
        if not len(inside):
            low = min(self.mesh.window.begin.angle, self.mesh.window.end.angle)
            inside = range(math.floor((angle - low) / self.mesh.drive.pitch()), inside.start)
        highest, best = self.highest(sorted(inside, key=lambda number: number != likely), angle)
        for number, step in ((inside.start - 1, -1), (inside.stop, 1)):
            for away in range(BEYOND):
                here = self.ahead(number + away * step, angle, highest)
                if best is None:
                    best = number
                if not here > highest:
                    break
                highest, best = here, number + away * step
        return best, highest

    def transmitted(self, angles):
        """Error that rigid teeth transmit at pinion angles (N,), rad: (N,); NaN where no pair touches, or none is known
        to touch first.
        """
        values, likely = np.empty(len(angles)), None
        for k, angle in enumerate(angles):
            likely, values[k] = self.leader(float(angle), likely)
        values[[float(angle) in self.unknown for angle in angles]] = np.nan
        return self.sense * np.where(np.isfinite(values), values, np.nan)

    def peak_to_peak(self):
        """Largest less smallest transmitted error of one pitch, rad; NaN if there is an angle at which no pair touches,
        or none is known to touch first.

        Sampled; the transfers between samples are located, and the extremes of the pairs about the extreme samples.
        """
        angles, numbers, values = self._sampled()
        if self.unknown or not np.isfinite(values).all():
            return math.nan
        lowest, highest = values.min(), values.max()
        spread = highest - lowest
        if spread < ROUND_OFF:
            return float(spread)
        ends = []
        for k in range(1, SAMPLES + 1):
            if numbers[k] != numbers[k + 1]:
                ends += self._transfer(numbers[k : k + 2], angles[k : k + 2], lowest, spread)
                lowest, highest = (of((was, *(e for _, e in ends))) for of, was in ((min, lowest), (max, highest)))
        shifted = [(angle + turn, error) for angle, error in ends for turn in (0.0, angles[0] - angles[SAMPLES])]
        for sign in (1.0, -1.0):
            k = 1 + int(np.argmax(sign * values[1:-1]))
            three = list(zip(angles[k - 1 : k + 2], (sign * values[k - 1 : k + 2]).tolist(), strict=True))
            if not any(_goes_on(three, (angle, sign * error)) for angle, error in shifted):
                found = self._extreme(sign, angles[k - 1 : k + 2], values[k - 1 : k + 2])
                lowest, highest = min(lowest, found), max(highest, found)
        return math.nan if self.unknown else float(highest - lowest)

    def _sampled(self):
        """Angles of one pitch and one beyond either end; number and error (sense times it) of the leader at each."""
        pitch = self.mesh.drive.pitch()
        start = min(self.mesh.window.begin.angle, self.mesh.window.end.angle)
        angles = (start + np.arange(-1, SAMPLES + 2) / SAMPLES * pitch).tolist()
        leaders, likely = {}, None
        for k in range(1, SAMPLES + 1, STRIDE):
            leaders[k] = likely, _ = self.leader(angles[k], likely)
        self._repeat(leaders, angles, SAMPLES + 1, 1, 1)
        found = [error for _, error in leaders.values()]
        dip = DIP * (max(found) - min(found))
        for k in range(1, SAMPLES + 1):
            if k not in leaders:
                leaders[k] = self._between(leaders, angles, k, dip)
        self._repeat(leaders, angles, 0, SAMPLES, -1)
        self._repeat(leaders, angles, SAMPLES + 2, 2, 1)
        numbers, values = zip(*(leaders[k] for k in range(len(angles))), strict=True)
        return angles, numbers, np.array(values)

    def _repeat(self, leaders, angles, k, same, shift):
        """What is known at an angle a pitch away, by its number and that of the pairs, which are ``shift`` later."""
        self.known[angles[k]] = {number + shift: found for number, found in self.known[angles[same]].items()}
        leaders[k] = leaders[same][0] + shift, leaders[same][1]

    def _between(self, leaders, angles, k, dip):
        """Number and error of the leader at an angle between two at which all are: of the pairs that may lead where the
        error is lower by ``dip`` than it goes on from either.
        """
        ends = [(k - 1) // STRIDE * STRIDE + 1 + side for side in (0, STRIDE)]
        low, high = sorted(leaders[end][1] for end in ends)
        likely = [] if low == -math.inf else self._contenders([angles[end] for end in ends], 2.0 * low - high - dip)
        error, number = self.highest(likely, angles[k])
        return (number, error) if error > -math.inf else self.leader(angles[k])

    def _contenders(self, angles, least):
        """The pairs that lead at one of some samples, and those that may lead with at least an error between them: that
        come so near to it at the samples as they change from one to another, or nearer.
        """
        looked_at = [self.known[angle] for angle in angles]
        found = [max(here, key=here.get) for here in looked_at]
        for number in set().union(*looked_at).difference(found):
            errors = [here[number][0] for here in looked_at if number in here]
            if max(errors) > -math.inf and 2.0 * max(errors) - min(errors) > least - ROUND_OFF:
                found.append(number)
        return list(dict.fromkeys(found))

    def _transfer(self, pair, angles, lowest, spread):
        """Angles just before and after the transfer between two samples, of which a ``pair`` of numbers leads one each,
        and the errors transmitted there.

        Not sought where it is above ``lowest``: a curve that neither jumps nor turns between lies between its ends, so
        that where curves cross, or one jumps across the other, the error is above the lower end of both.
        """
        bracket = _Bracket(self, pair, angles)
        width, steps = angles[1] - angles[0], 0

        def enough():
            low, high = (end[0] for end in bracket.ends)
            exact = ROUND_OFF if steps < CROSSING_STEPS else max(ROUND_OFF, JUMP_RESOLUTION * spread)
            if bracket.open < exact:
                bracket.settle()
            return bracket.open < exact or bracket.floor > lowest + DIP * spread * ((high - low) / width) ** 2

        def difference(angle):
            nonlocal steps
            steps += 1
            found = bracket.shrink(angle)
            return 0.0 if enough() else found

        if enough():
            return []
        bracketed(difference, *angles, TRANSFER_TOLERANCE * self.mesh.drive.pitch(), bracket.differences)
        contenders = self._contenders(angles, bracket.floor)
        return [(angle, self.highest(contenders, angle)[0]) for angle, _ in bracket.ends]

    def _extreme(self, sign, angles, values):
        """Largest (sign +1) or smallest transmitted error about the second of three samples with their values (3,).

        By parabolas, else by the golden section.
        """
        numbers, width = self._contenders(angles, sign * max(sign * values)), angles[1] - angles[0]
        (a, b, c), (fa, fb, fc) = angles, (sign * values).tolist()
        for k in range(EXTREME_STEPS):
            if not fb >= max(fa, fc) or c - a < EXTREME_TOLERANCE * width or fb - min(fa, fc) < ROUND_OFF:
                break
            left, right = (b - a) * (fb - fc), (b - c) * (fb - fa)
            shift = 0.5 * ((b - a) * left - (b - c) * right) / (left - right) if left != right else 0.0
            x = b - shift
            if k % 3 == 2 or not a < x < c or shift == 0.0:
                x = b + GOLDEN * ((c - b) if c - b > b - a else (a - b))
            elif abs(shift) < EXTREME_TOLERANCE * width:
                break
            error, best = self.highest(numbers, x)
            fx = sign * error
            numbers = [best, *(number for number in numbers if number != best)]
            if fx > fb:
                a, fa, b, fb, c, fc = (b, fb, x, fx, c, fc) if x > b else (a, fa, x, fx, b, fb)
            elif x > b:
                c, fc = x, fx
            else:
                a, fa = x, fx
        return sign * fb


class _Bracket:
    """Two angles at the first of which one of a ``pair`` of numbers leads, at the second the other.

    ``ends``: both angles, each with the errors of the pair (sense times them).
    """

    def __init__(self, teeth, pair, angles):
        self.teeth, self.pair = teeth, pair
        self.ends = [(angle, ()) for angle in angles]
        self.settle()

    def settle(self):
        """Look at both curves at both ends."""
        self.ends = [(angle, self._both(angle, leads)) for leads, (angle, _) in enumerate(self.ends)]

    def _both(self, angle, leads):
        """The errors of the pair at an angle at which, or so it is thought, number ``leads`` of it leads."""
        errors = [0.0, 0.0]
        errors[leads] = self.teeth.ahead(self.pair[leads], angle)
        errors[1 - leads] = self.teeth.ahead(self.pair[1 - leads], angle, errors[leads])
        return tuple(errors)

    @property
    def differences(self):
        """First less second at both ends."""
        return tuple(_difference(errors) for _, errors in self.ends)

    @property
    def floor(self):
        """The lower end of both curves, above which the error is at the transfer."""
        return max(map(min, *(errors for _, errors in self.ends)))

    @property
    def open(self):
        """How much lower than at both ends the error may be."""
        return min(max(errors) for _, errors in self.ends) - self.floor

    def shrink(self, angle):
        """Replace an end by an angle between; first less second there.

        The curve that changes least is taken as straight where the other one passes it by far.
        """
        (low, at_low), (high, at_high) = self.ends
        changes = [abs(after - before) for before, after in zip(at_low, at_high, strict=True)]
        flat = changes.index(min(changes))
        errors = [0.0, 0.0]
        errors[1 - flat] = self.teeth.ahead(self.pair[1 - flat], angle, min(at_low[flat], at_high[flat]))
        if math.isfinite(changes[flat]):
            errors[flat] = at_low[flat] + (angle - low) / (high - low) * (at_high[flat] - at_low[flat])
        if not abs(_difference(errors)) > changes[flat]:
            errors = self._both(angle, flat)
        found = _difference(errors)
        self.ends[1 if found < 0.0 else 0] = angle, tuple(errors)
        return found


def _goes_on(samples, end):
    """Whether a function rises from the middle one of three samples, the highest of them, to a higher ``end`` between
    two of them, and without a maximum before that.
    """
    (x, f), (before, after) = samples[1], (samples[0], samples[2])
    if not (end[1] > f and before[0] < end[0] < after[0]):
        return False
    far, way = before if end[0] > x else after, end[0] - x
    rise, before_rise = (end[1] - f) / way, (f - far[1]) / (x - far[0])
    return (rise + (rise - before_rise) / (end[0] - far[0]) * way) * way > 0.0


def _difference(errors):
    """First less second, ±1 where one does not touch at all."""
    one, other = errors
    return (1.0 if other == -math.inf else -1.0) if math.inf in (-one, -other) else one - other
