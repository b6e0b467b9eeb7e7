"""A generated surface followed in sections z = constant, so that every place of a section is found on one sheet.

The equations of a generated surface have other solutions far from the tooth, and the surface may end in a cusp; both
are kept out by following it from a place that is known.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RegularGridInterpolator

from meshwright.fe.hexahedra import Floats
from meshwright.flank.surface import FlankPoints

Generated = Callable[[Floats, Floats], FlankPoints]
"""Profile parameter (K,) and angle (K,) to what is known of the surface there; the angle is its last parameter."""

Bools = NDArray[np.bool_]

_BISECTIONS, _NEWTON_STEPS = 50, 30
_ON_PLACE, _STILL = 1e-10, 1e-14


@dataclass(frozen=True)
class Line:
    """Sections z (K,) of a surface over a monotone row of profile parameters (P,).

    face (P, K): the angle; beyond a cusp that of the last regular place.  regular (P, K): False from a cusp on.
    radius (P, K) in mm.
    """

    generated: Generated
    sections: Floats
    profile: Floats
    face: Floats
    regular: Bools
    radius: Floats

    @classmethod
    def follow(cls, generated: Generated, sections: Floats, start: float, end: float, steps: int) -> Line:
        """From a profile parameter, at an angle of 0 and then in the sections, to another in so many steps.

        Raises ValueError where a section does not reach the start.
        """
        first = np.full_like(sections, start)
        face = np.zeros_like(sections)
        height = generated(first, face).points[:, 2]
        for share in np.linspace(0.0, 1.0, steps // 4 + 1):
            face = _in_section(generated, first, face, height + share * (sections - height))
        profile = np.linspace(start, end, steps + 1)
        faces, regulars, radii = [], [], []
        regular = np.ones(len(sections), dtype=bool)
        for value in profile:
            place = np.full_like(sections, value)
            trial = _in_section(generated, place, face, sections)
            found = generated(place, trial)
            regular = regular & (found.regular > 0.0) & (np.abs(found.points[:, 2] - sections) < _ON_PLACE)
            face = np.where(regular, trial, face)
            faces.append(face)
            regulars.append(regular)
            radii.append(np.hypot(found.points[:, 0], found.points[:, 1]))
        if not np.all(regulars[0]):
            raise ValueError("the surface does not reach some section of its face, or only on another sheet")
        return cls(generated, sections, profile, np.stack(faces), np.stack(regulars), np.stack(radii))

    def joined(self, other: Line) -> Line:
        """With one that goes the other way from the same start."""
        def both(here: NDArray, there: NDArray) -> NDArray:
            return np.concatenate([here[:0:-1], there])

        tables = (both(getattr(self, n), getattr(other, n)) for n in ("profile", "face", "regular", "radius"))
        return Line(self.generated, self.sections, *tables)

    def of(self, chosen: Bools) -> Line:
        """The same in some of the sections."""
        tables = (table[:, chosen] for table in (self.face, self.regular, self.radius))
        return Line(self.generated, self.sections[chosen], self.profile, *tables)

    @cached_property
    def _near(self) -> RegularGridInterpolator:
        return RegularGridInterpolator((self.profile, self.sections), self.face, bounds_error=False, fill_value=None)

    def surface(self, profile: Floats, sections: Floats) -> tuple[Floats, Floats]:
        """Points and normals over profile parameter and z, between the line's own sections."""
        profile, sections = np.broadcast_arrays(profile, sections)
        places, wanted = profile.ravel(), sections.ravel()
        face = _in_section(self.generated, places, self._near(np.stack([places, wanted], axis=1)), wanted)
        found = self.generated(places, face)
        return found.points.reshape(*profile.shape, 3), found.normals.reshape(*profile.shape, 3)

    def at(self, profile: Floats) -> FlankPoints:
        """The surface at a profile parameter (K,) in each section."""
        return self.generated(profile, _in_section(self.generated, profile, self._face(profile), self.sections))

    def _face(self, profile: Floats) -> Floats:
        sense = np.sign(self.profile[-1] - self.profile[0])
        columns = zip(profile, self.face.T, strict=True)
        return np.array([np.interp(sense * value, sense * self.profile, face) for value, face in columns])

    def cusp(self) -> Floats:
        """Profile parameter (K,) in each section up to which a line that meets a cusp is regular."""
        return self._end_of(self.regular, lambda found: found.regular > 0.0)

    def up_to(self, height: Callable[[FlankPoints], Floats]) -> Floats:
        """Profile parameter (K,) in each section at which a height (N,) of places of the surface first falls to zero.

        Raises ValueError where the line ends before, or all of it is beyond.
        """
        def inside(found: FlankPoints) -> Bools:
            return (found.regular > 0.0) & (height(found) > 0.0)

        places = zip(self.profile, self.face, self.regular, strict=True)
        held = np.stack([
            regular & inside(self.generated(np.full_like(face, value), face)) for value, face, regular in places
        ])
        if not np.all(held.any(axis=0)):
            raise ValueError("some section of its face has no flank below the tip")
        found = self._end_of(held, inside)
        if not np.all(np.abs(height(self.at(found))) < _ON_PLACE):
            raise ValueError("the flank does not reach its tip in every section of its face")
        return found

    def _end_of(self, held: Bools, holds: Callable[[FlankPoints], Bools]) -> Floats:
        """Last profile parameter (K,) in each section of the first run of places (P, K) that are held."""
        first = np.argmax(held, axis=0)
        beyond = np.arange(len(held))[:, None] > first
        last = np.where(np.any(beyond & ~held, axis=0), np.argmax(beyond & ~held, axis=0) - 1, len(held) - 1)
        inside, outside = self.profile[last], self.profile[np.minimum(last + 1, len(held) - 1)]
        for _ in range(_BISECTIONS):
            middle = 0.5 * (inside + outside)
            good = holds(self.at(middle))
            inside, outside = np.where(good, middle, inside), np.where(good, outside, middle)
        return inside

    def at_radius(self, radius: Floats) -> tuple[Floats, Floats]:
        """Profile parameter (K,) and point (K, 3) at a radius (K,); not a number beyond the largest one followed."""
        grown = np.maximum.accumulate(self.radius)
        profile = np.array([np.interp(r, column, self.profile) for r, column in zip(radius, grown.T, strict=True)])
        face = self._face(profile)
        for _ in range(_NEWTON_STEPS):
            found = self.generated(profile, face)
            x, tangents = found.points, found.tangents[:, [0, -1]]
            off = np.stack([0.5 * (x[:, 0] ** 2 + x[:, 1] ** 2 - radius**2), x[:, 2] - self.sections], axis=1)
            by_radius = np.einsum("kpi,ki->kp", tangents[:, :, :2], x[:, :2])
            matrix = np.stack([by_radius, tangents[:, :, 2]], axis=1)
            step = np.linalg.solve(matrix, off[:, :, None])[:, :, 0]
            profile, face = profile - step[:, 0], face - step[:, 1]
            if np.abs(step).max() < _STILL:
                break
        found = self.generated(profile, face).points
        miss = np.hypot(np.hypot(found[:, 0], found[:, 1]) - radius, found[:, 2] - self.sections)
        return profile, np.where(((radius <= grown[-1]) & (miss < _ON_PLACE))[:, None], found, np.nan)


def _in_section(generated: Generated, profile: Floats, face: Floats, sections: Floats) -> Floats:
    """Angle (K,) near ``face`` at which the surface is in the sections."""
    for _ in range(_NEWTON_STEPS):
        found = generated(profile, face)
        step = (found.points[:, 2] - sections) / found.tangents[:, -1, 2]
        face = face - step
        if np.abs(step).max() < _STILL:
            break
    return face
