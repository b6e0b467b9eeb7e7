"""The profile of a helicoid over its whole regular length, from the generated profile functions."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from meshwright.limits.model import DriveModel
from meshwright.limits.zeros import zeros

#: Steps of the search along a profile, in natural sizes of its parameter, and how far it goes.
STEP, REACH = 0.05, 20.0

#: Share of the regular sheet |Ψ − Ψ0| < 90° that is searched.
SHEET_SHARE = 0.98


@dataclass(frozen=True)
class Profile:
    """Profile parameters of the ``"pinion"`` of a drive or of its ``"tool"``, on the branch of the pitch point.

    The radius grows from :attr:`lower` to :attr:`upper`.
    """

    drive: DriveModel
    role: str

    @cached_property
    def _function(self):
        return self.drive.function(f"profile_{self.role}")

    @property
    def name(self):
        """What the drive calls the body."""
        return self._function.frames["point"]

    @property
    def parameter(self):
        """Name of the profile parameter."""
        return self._function.arguments[0]

    @cached_property
    def _range(self):
        return {key: float(v) for key, v in self.drive.function(f"profile_range_{self.role}")().items()}

    @property
    def pitch_point(self):
        """Parameter at (or, on a ground flank, near) the pitch cylinder."""
        return self._range["pitch_point"]

    def __call__(self, t):
        """Point (…, 3), unit normal (…, 3), growth of the squared radius and axial section at parameters t."""
        return self._function(t)

    def radius(self, t):
        """Distance of the profile point from the axis."""
        point = self(t)["point"]
        return np.hypot(point[..., 0], point[..., 1])

    @cached_property
    def sense(self):
        """+1 if the radius grows with the parameter, −1 if it falls."""
        return float(np.sign(self(self.pitch_point)["growth"]))

    def _walk(self, sense):
        """Parameters from the pitch point on, as far as the profile goes on that side, edges included."""
        steps = np.arange(0.0, REACH, STEP) * self._range["scale"]
        t = self.pitch_point + sense * steps
        lower = self._range.get("lower_end", -np.inf)
        t = t[t > lower] if sense < 0 else t
        growth = self(t)["growth"] * self.sense
        with np.errstate(invalid="ignore"):
            broken = np.flatnonzero(~(growth > 0.0))
        if len(broken):
            last = broken[0]
            edge = zeros(lambda q: self(q)["growth"], t[last - 1 : last + 1])
            return np.append(t[:last], edge)
        return np.append(t, lower) if sense < 0 and np.isfinite(lower) else t

    @cached_property
    def _sides(self):
        inward, outward = self._walk(-self.sense), self._walk(self.sense)
        return np.concatenate([inward[:0:-1], outward])

    @cached_property
    def regression(self):
        """Parameter of the inner end if the flank turns back there (edge of regression, base cylinder), else None."""
        inner = self._sides[0]
        if inner == self._range.get("lower_end"):
            below = self(inner - STEP * self._range["scale"])["point"]
            return None if np.all(np.isfinite(below)) else float(inner)
        growth, usual = (abs(float(self(t)["growth"])) for t in (inner, self.pitch_point))
        return float(inner) if growth < 1e-6 * usual else None

    def samples(self, largest_radius, count=200):
        """Parameters from the inner end to a radius, or to the outer end, in order of growing radius."""
        t = self._sides[self.radius(self._sides) <= largest_radius]
        return np.linspace(t[0], t[-1], count)

    def at_radius(self, radius):
        """Parameter at a radius, or None where the profile does not reach it."""
        found = zeros(lambda t: self.radius(t) - radius, self._sides)
        return found[0] if found else None

    def sheet(self):
        """Range of the rack angle Ψ of the wheel's regular sheet at the pitch point: the normal's x keeps its sign."""
        across, along, _ = self(self.pitch_point)["normal"]
        middle = np.arctan2(-along, across)
        middle -= np.pi * np.round(middle / np.pi)
        return middle - SHEET_SHARE * np.pi / 2, middle + SHEET_SHARE * np.pi / 2

    def least_radius(self):
        """Radius of the inner end."""
        return float(self.radius(self._sides[0]))

    def largest_radius(self):
        """Radius of the outer end, as far as it is searched."""
        return float(self.radius(self._sides[-1]))
