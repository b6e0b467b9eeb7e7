"""Wheel angle at which a bounded involute flank passes through points of its mate, in closed form, and its extreme.

Lead slope makes an exact helicoid of another lead; lead crowning, a radial plunge of the tool, leaves every transverse
section an involute of less profile shift. Formulas of ISO 21771 alone: nothing of the product is read. A point of the
pinion's rectangle (roll length ϱ1, height Z1) gives the wheel's roll length, height and turn δ without iteration.
Bodies touch first where σδ is largest over what the limits of both leave: in the rectangle, or along a border of
either, corners included.
"""

import math
from dataclasses import dataclass

import numpy as np

#: Points of a look along a border, and over the rectangle each way.
ALONG = 97
OVER = 25

#: How often a look is made closer about the best place.
CLOSER = 15


def involute(angle):
    return math.tan(angle) - angle


@dataclass(frozen=True)
class Gear:
    """One gear of a pair: lengths in mm, angles in rad; ``bow``, ``rise``: angle that crowning takes off, and roll
    length by which it lowers the start of the flank, both over the square of the height.
    """

    teeth: int
    helix: float
    shift: float
    tip: float
    face: float
    bow: float
    rise: float
    r: float
    r_b: float
    half_tooth: float
    lead_error: float
    start: float

    @classmethod
    def of(cls, module, angle, teeth, helix, face, shift=0.0, tip=None, slope=0.0, crowning=0.0):
        """Cut by the basic rack of ISO 53: dedendum 1.25, rounding 0.38 modules."""
        transverse = math.atan(math.tan(angle) / math.cos(helix))
        r = module * teeth / (2 * math.cos(helix))
        r_b = r * math.cos(transverse)
        l_f = (-1.25 + 0.38 * (1 - math.sin(angle))) * module / math.cos(angle)
        start = r * math.sin(transverse) + (l_f * math.cos(angle) + shift * module) / math.sin(transverse)
        half = (math.pi / 2 + 2 * shift * math.tan(angle)) / teeth + involute(transverse)
        tip = r + (1 + shift) * module if tip is None else tip
        plunge = crowning / math.sin(angle) * (2 / face) ** 2
        bow, rise = 2 * plunge * math.tan(angle) / (module * teeth), plunge / math.sin(transverse)
        return cls(teeth, helix, shift, tip, face, bow, rise, r, r_b, half,
                   slope / (face * math.cos(angle) * math.cos(helix) * r), max(start, 0.0))  # fmt: skip

    @property
    def end(self):
        """Roll length at the tip."""
        return math.sqrt(self.tip**2 - self.r_b**2)

    def roll(self, length):
        return length / self.r_b - np.arctan(length / self.r_b)


@dataclass(frozen=True)
class Pair:
    """Two gears, s = +1 or −1 the flank; errors of the assembly in mm and rad."""

    pinion: Gear
    wheel: Gear
    distance: float
    s: int = 1
    distance_error: float = 0.0
    horizontal: float = 0.0
    vertical: float = 0.0
    axial: float = 0.0
    shaft: float = 0.0

    @property
    def ratio(self):
        return self.pinion.teeth / self.wheel.teeth

    def at(self, phi, length, height):
        """Point (…, 3) in the fixed frame, turn δ of the wheel, its roll length² and height there."""
        p, w, s = self.pinion, self.wheel, self.s
        radius = np.hypot(p.r_b, length)
        half = p.half_tooth - p.bow * height**2 - p.lead_error * height
        polar = s * (half - p.roll(length)) + height * math.tan(p.helix) / p.r + phi - s * math.pi / (2 * p.teeth)
        point = np.stack(np.broadcast_arrays(radius * np.cos(polar), radius * np.sin(polar), height), axis=-1)
        x, y, z = np.moveaxis(point - [self.distance + self.distance_error, 0.0, 0.0], -1, 0)
        tilt = self.shaft + self.horizontal
        y, z = math.cos(tilt) * y - math.sin(tilt) * z, math.sin(tilt) * y + math.cos(tilt) * z
        c, d = math.cos(self.vertical), -math.sin(self.vertical)
        x, z = c * x + d * z, -d * x + c * z
        z = z - self.axial
        squared = x * x + y * y - w.r_b**2
        with np.errstate(invalid="ignore"):
            other = np.sqrt(squared)
            turn = -s * math.pi / (2 * w.teeth) + s * (w.half_tooth - w.bow * z**2 - w.lead_error * z - w.roll(other))
            turn = turn + z * math.tan(w.helix) / w.r - np.arctan2(-y, -x)
        return point, turn, squared, z

    def limits(self, phi, length, height):
        """Signed distances inside every limit (…, 8), and the wheel's turn less its nominal one (…)."""
        p, w = self.pinion, self.wheel
        _, turn, squared, z = self.at(phi, length, height)
        with np.errstate(invalid="ignore"):
            other = np.where(squared >= 0.0, np.sqrt(np.maximum(squared, 0.0)), np.nan)
            values = np.broadcast_arrays(
                length - p.start + p.rise * np.square(height), p.end - length, height + p.face / 2, p.face / 2 - height,
                other - w.start + w.rise * z**2, w.end - other, z + w.face / 2, w.face / 2 - z,
            )  # fmt: skip
        return np.stack(values, axis=-1), (turn - self.ratio * phi + math.pi) % (2 * math.pi) - math.pi

    def error(self, phi):
        """(Transmission error (rad), point, names of the limits that hold it); NaN where flanks do not meet."""
        best = (-math.inf, None, ())
        for found in (self._inside(phi), *self._borders(phi)):
            if found[0] > best[0] + 1e-15:
                best = found
        if best[1] is None:
            return math.nan, None, ()
        return self.s * best[0], self.at(phi, *best[1])[0], best[2]

    def _value(self, phi, length, height, held=()):
        limits, error = self.limits(phi, length, height)
        free = [i for i in range(len(NAMES)) if i not in held]
        inside = (limits[..., free] > -1e-11).all(axis=-1) & np.isfinite(error)
        return np.where(inside, self.s * error, -np.inf)

    def _inside(self, phi):
        """Ever closer looks over the heights and, at each, over the roll lengths: a ridge runs across either."""
        p = self.pinion
        heights, best = np.linspace(-p.face / 2, p.face / 2, OVER), (-math.inf, None, ())
        for _ in range(CLOSER):
            lengths, values = self._across(phi, heights)
            k = int(np.argmax(values))
            if values[k] > best[0]:
                best = (float(values[k]), (float(lengths[k]), float(heights[k])), ())
            if best[1] is None:
                break
            half = 2.0 * (heights[1] - heights[0])
            heights = np.clip(np.linspace(best[1][1] - half, best[1][1] + half, OVER), -p.face / 2, p.face / 2)
        return best

    def _across(self, phi, heights):
        """The best roll length at each of some heights (N,), and the value there."""
        p, rows = self.pinion, np.arange(len(heights))
        lengths = np.linspace(p.start, p.end, OVER)[None, :] + 0.0 * heights[:, None]
        best, where = np.full(len(heights), -np.inf), np.full(len(heights), p.start)
        for _ in range(CLOSER):
            values = self._value(phi, lengths, heights[:, None])
            k = values.argmax(axis=1)
            better = values[rows, k] > best
            best, where = np.where(better, values[rows, k], best), np.where(better, lengths[rows, k], where)
            half = 2.0 * (lengths[:, 1] - lengths[:, 0])[:, None]
            lengths = np.clip(where[:, None] + half * np.linspace(-1.0, 1.0, OVER), p.start, p.end)
        return where, best

    def _borders(self, phi):
        p = self.pinion
        for k, of in ((0, lambda t: p.start - p.rise * t * t), (1, lambda t: np.full_like(t, p.end))):
            yield self._along(phi, (k,), lambda t, of=of: (of(t), t), -p.face / 2, p.face / 2)
        for k, height in ((2, -p.face / 2), (3, p.face / 2)):
            yield self._along(phi, (k,), lambda t, at=height: (t, np.full_like(t, at)), p.start, p.end)
        for k in (4, 5):  # where the wheel's roll length holds: one length of the pinion for each height
            yield from self._wheel_border(phi, k, -p.face / 2, p.face / 2, along_height=True)
        for k in (6, 7):
            yield from self._wheel_border(phi, k, p.start, p.end, along_height=False)

    def _wheel_border(self, phi, k, low, high, along_height):
        lengths = self.pinion.start, self.pinion.end
        heights = -self.pinion.face / 2, self.pinion.face / 2
        span = lengths if along_height else heights

        def curve(t):
            """By bisection of the limit across."""
            a, b = np.full_like(t, span[0] - 0.5), np.full_like(t, span[1] + 0.5)
            if along_height:
                a = np.maximum(a, 1e-9)

            def value(u):
                found = self.limits(phi, *((u, t) if along_height else (t, u)))[0][..., k]
                return np.where(np.isnan(found), -1.0 if k == 4 else 1.0, found)

            first, last = value(a), value(b)
            good = first * last <= 0.0
            for _ in range(70):
                middle = 0.5 * (a + b)
                left = value(middle) * first > 0.0
                a, b = np.where(left, middle, a), np.where(left, b, middle)
            across = np.where(good, 0.5 * (a + b), np.nan)
            return (across, t) if along_height else (t, across)

        yield self._along(phi, (k,), curve, low, high)

    def _along(self, phi, held, curve, low, high):
        best, t = (-math.inf, None, held), np.linspace(low, high, ALONG)
        for _ in range(CLOSER):
            length, height = curve(t)
            values = self._value(phi, length, height, held)
            k = int(np.argmax(values))
            if values[k] > best[0]:
                best = (float(values[k]), (float(length[k]), float(height[k])), held)
                centre = t[k]
            if best[1] is None:
                return best
            half = 2.0 * (t[1] - t[0])
            t = np.clip(np.linspace(centre - half, centre + half, 33), low, high)
        return best


NAMES = (
    "pinion root", "pinion tip", "pinion face -", "pinion face +",
    "wheel root", "wheel tip", "wheel face -", "wheel face +",
)  # fmt: skip
