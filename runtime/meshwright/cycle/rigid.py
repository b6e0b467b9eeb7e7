"""What rigid teeth transmit: over all pairs, the one whose two bounded flanks touch first, tangency, edge or corner."""

import math
from dataclasses import dataclass, field

import numpy as np

from meshwright.base.roots import bracketed
from meshwright.contact.results import ARCSEC
from meshwright.cycle.first_contact import pair_errors

#: Angles of one pitch that are looked at first, and pairs beyond the windows that are looked at on either side.
SAMPLES, BEYOND = 24, 4

#: Errors that differ by less are the same to round-off, rad.
ROUND_OFF = 1e-8 * ARCSEC

#: Transfers are located to this share of a pitch; an extreme to this share of a sample's width, in so many steps at
#: most, each third of them by the golden section.
TRANSFER_TOLERANCE, EXTREME_TOLERANCE, EXTREME_STEPS, GOLDEN = 1e-10, 1e-4, 30, 0.381966


@dataclass(frozen=True)
class RigidTeeth:
    """First contact of all pairs of a ``mesh``; ``first`` is :func:`~meshwright.cycle.first_contact.pair_errors`'s.

    Angles and errors in rad; with the mesh's sense of rotation the pair that leads has the largest error.
    """

    mesh: object
    first: object
    known: dict = field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, mesh):
        """The first contacts of a mesh with both ends; None where the blank does not bound its flanks."""
        if mesh.window.path is None or not mesh.window.complete:
            return None
        first = pair_errors(mesh)
        found = None if first is None else cls(mesh, first)
        middle = 0.5 * (mesh.window.begin.angle + mesh.window.end.angle)
        return found if found is not None and math.isfinite(found.ahead(0, middle)) else None

    def ahead(self, number, angle):
        """Sense times the error at which pair ``number`` touches at a pinion angle; −infinity where it never does."""
        key = (number, angle)
        if key not in self.known:
            (error,) = self.first([angle - number * self.mesh.drive.pitch()])
            self.known[key] = self.mesh.sense * error if math.isfinite(error) else -math.inf
        return self.known[key]

    def leader(self, angle):
        """Number of the pair that touches first at a pinion angle, and sense times its error.

        The pairs inside their windows, and beyond them outwards as long as one touches before all that were looked at.
        """
        inside = self.mesh.numbers(angle)
        if not len(inside):
            low = min(self.mesh.window.begin.angle, self.mesh.window.end.angle)
            inside = range(math.floor((angle - low) / self.mesh.drive.pitch()), inside.start)
        found = {number: self.ahead(number, angle) for number in inside}
        for number, step in ((inside.start - 1, -1), (inside.stop, 1)):
            for away in range(BEYOND):
                highest = max(found.values(), default=-math.inf)
                here = found[number + away * step] = self.ahead(number + away * step, angle)
                if not here > highest:
                    break
        best = max(found, key=found.get)
        return best, found[best]

    def transmitted(self, angles):
        """Error that rigid teeth transmit at pinion angles (N,), rad: (N,); NaN where no pair touches."""
        values = np.array([self.leader(float(angle))[1] for angle in angles])
        return self.mesh.sense * np.where(np.isfinite(values), values, np.nan)

    def peak_to_peak(self):
        """Largest less smallest transmitted error of one pitch, rad; NaN if there is an angle at which no pair touches.

        Sampled; the transfers between samples are located, and the extremes of the pairs about the extreme samples.
        """
        pitch = self.mesh.drive.pitch()
        start = min(self.mesh.window.begin.angle, self.mesh.window.end.angle)
        angles = start + np.arange(SAMPLES + 1) / SAMPLES * pitch
        leaders = [self.leader(float(angle)) for angle in angles]
        values = np.array([value for _, value in leaders])
        if not np.isfinite(values).all():
            return math.nan
        lowest, highest = values.min(), values.max()
        if highest - lowest < ROUND_OFF:
            return float(highest - lowest)
        for k, ((before, _), (after, _)) in enumerate(zip(leaders, leaders[1:], strict=False)):
            if before != after and min(values[k], values[k + 1]) - lowest < 0.5 * (highest - lowest):
                lowest = min(lowest, self._transfer(before, after, angles[k], angles[k + 1]))
        for sign in (1.0, -1.0):
            k = int(np.argmax(sign * values))
            found = self._extreme(sign, angles[k], pitch / SAMPLES)
            lowest, highest = min(lowest, found), max(highest, found)
        return float(highest - lowest)

    def _transfer(self, before, after, low, high):
        """The error where two pairs change over, between two angles."""

        def difference(angle):
            one, other = self.ahead(before, float(angle)), self.ahead(after, float(angle))
            return 1.0 if one == math.inf or other == -math.inf else -1.0 if one == -math.inf else one - other

        ends = difference(low), difference(high)
        if not ends[0] * ends[1] < 0.0 or max(map(abs, ends)) < ROUND_OFF:
            return min(self.leader(float(low))[1], self.leader(float(high))[1])
        at = float(bracketed(difference, low, high, TRANSFER_TOLERANCE * self.mesh.drive.pitch(), ends))
        return self.leader(at)[1]

    def _extreme(self, sign, angle, width):
        """Largest (sign +1) or smallest transmitted error about an angle: by parabolas, else by the golden section."""
        a, b, c = float(angle) - width, float(angle), float(angle) + width
        fa, fb, fc = (sign * self.leader(x)[1] for x in (a, b, c))
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
            fx = sign * self.leader(x)[1]
            if fx > fb:
                a, fa, b, fb, c, fc = (b, fb, x, fx, c, fc) if x > b else (a, fa, x, fx, b, fb)
            elif x > b:
                c, fc = x, fx
            else:
                a, fa = x, fx
        return sign * fb
