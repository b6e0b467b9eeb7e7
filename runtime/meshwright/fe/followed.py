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
    """Sections z (K,) of a surface over monotone rows of profile parameters (P, K), equally spaced in each section.

    start (K,): the profile parameter from which each section was followed.  face (P, K): the angle; beyond a cusp that
    of the last regular place.  regular (P, K): False from a cusp on.  radius (P, K) in mm.
    """

    generated: Generated
    sections: Floats
    profile: Floats
    start: Floats
    face: Floats
    regular: Bools
    radius: Floats

    @classmethod
    def follow(cls, generated: Generated, sections: Floats, start: tuple[Floats, Floats], profile: Floats) -> Line:
        """From a place near each section, profile parameter and angle (K,), both ways along it over ``profile`` (P, K).

        Raises ValueError where a section does not hold its start.
        """
        first = start[0]
        begun = in_section(generated, first, start[1], sections)
        if not np.all(held(generated(first, begun), sections)):
            raise ValueError("the surface does not reach some section of its face, or only on another sheet")
        up = np.sign(profile[-1] - profile[0])
        faces, regulars = np.tile(begun, (len(profile), 1)), np.zeros(profile.shape, dtype=bool)
        radii = np.full(profile.shape, np.nan)
        for way in (1, -1):
            face, regular = begun.copy(), np.ones(len(sections), dtype=bool)
            for k in range(len(profile))[::way]:
                mine = up * way * (profile[k] - first) >= 0.0
                faces[k, mine] = face[mine]
                (on,) = np.nonzero(mine & regular)
                if not len(on):
                    continue
                place = profile[k, on]
                trial = in_section(generated, place, face[on], sections[on])
                found = generated(place, trial)
                good = held(found, sections[on])
                regular[on] = regulars[k, on] = good
                face[on[good]] = faces[k, on[good]] = trial[good]
                radii[k, on] = np.hypot(found.points[:, 0], found.points[:, 1])
        return cls(generated, sections, profile, first, faces, regulars, radii)

    def of(self, chosen: Bools) -> Line:
        """The same in some of the sections."""
        return Line(
            self.generated, self.sections[chosen], self.profile[:, chosen], self.start[chosen],
            self.face[:, chosen], self.regular[:, chosen], self.radius[:, chosen],
        )  # fmt: skip

    @cached_property
    def _near(self) -> RegularGridInterpolator:
        shares = np.linspace(0.0, 1.0, len(self.profile))
        return RegularGridInterpolator((shares, self.sections), self.face, bounds_error=False, fill_value=None)

    def surface(self, profile: Floats, sections: Floats) -> tuple[Floats, Floats]:
        """Points and normals over profile parameter and z, between the line's own sections."""
        profile, sections = np.broadcast_arrays(profile, sections)
        places, wanted = profile.ravel(), sections.ravel()
        face = in_section(self.generated, places, self.face_at(places, wanted), wanted)
        found = self.generated(places, face)
        return found.points.reshape(*profile.shape, 3), found.normals.reshape(*profile.shape, 3)

    def face_at(self, profile: Floats, sections: Floats) -> Floats:
        """Angles (N,) near the surface at profile parameters (N,) and sections (N,), between the line's own."""
        first, last = (np.interp(sections, self.sections, row) for row in (self.profile[0], self.profile[-1]))
        return self._near(np.stack([(profile - first) / (last - first), sections], axis=1))

    def at(self, profile: Floats) -> FlankPoints:
        """The surface at a profile parameter (K,) in each section."""
        return self.generated(profile, in_section(self.generated, profile, self._face(profile), self.sections))

    def _face(self, profile: Floats) -> Floats:
        sense = np.sign(self.profile[-1] - self.profile[0])
        columns = zip(profile, sense, self.profile.T, self.face.T, strict=True)
        return np.array([np.interp(way * value, way * row, face) for value, way, row, face in columns])

    def cusp(self) -> Floats:
        """Profile parameter (K,) in each section up to which a line that meets a cusp is regular."""
        return self._end_of(lambda found: found.regular > 0.0, self.regular)

    def up_to(self, height: Callable[[FlankPoints], Floats]) -> Floats:
        """Profile parameter (K,) in each section at which a height (N,) of places of the surface first falls to zero.

        Raises ValueError where the line ends before, or all of it is beyond.
        """
        def inside(found: FlankPoints) -> Bools:
            return (found.regular > 0.0) & (height(found) > 0.0)

        places = zip(self.profile, self.face, self.regular, strict=True)
        below = np.stack([
            regular & inside(self.generated(value, face)) for value, face, regular in places
        ])
        if not np.all(inside(self.at(self.start))):
            raise ValueError("some section of its face has no flank below the tip")
        found = self._end_of(inside, below)
        if not np.all(np.abs(height(self.at(found))) < _ON_PLACE):
            raise ValueError("the flank does not reach its tip in every section of its face")
        return found

    def _end_of(self, holds: Callable[[FlankPoints], Bools], kept: Bools) -> Floats:
        """Last profile parameter (K,) in each section of the run from its start on of places (P, K) that are kept."""
        up, column = np.sign(self.profile[-1] - self.profile[0]), np.arange(len(self.sections))
        after = up * (self.profile - self.start) > 0.0
        lost = after & ~kept
        end = np.where(lost.any(axis=0), np.argmax(lost, axis=0), len(kept) - 1)
        before = np.maximum(end - 1, 0)
        inside = np.where(after[before, column], self.profile[before, column], self.start)
        outside = self.profile[end, column]
        inside = np.where(lost.any(axis=0), inside, outside)
        for _ in range(_BISECTIONS):
            middle = 0.5 * (inside + outside)
            good = holds(self.at(middle))
            inside, outside = np.where(good, middle, inside), np.where(good, outside, middle)
        return inside

    def at_radius(self, radius: Floats) -> tuple[Floats, Floats]:
        """Profile parameter (K,) and point (K, 3) at a radius (K,); not a number beyond the largest one followed."""
        grown = np.maximum.accumulate(np.nan_to_num(self.radius, nan=-np.inf))
        profile = np.array([np.interp(r, *column) for r, *column in zip(radius, grown.T, self.profile.T, strict=True)])
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
        return profile, np.where(((radius < grown[-1] + _ON_PLACE) & (miss < _ON_PLACE))[:, None], found, np.nan)


def level(generated: Generated, sections: Floats, profile: Floats, steps: int = 16) -> Floats:
    """Angle (K,) in the sections at a profile parameter (K,), followed there from an angle of 0."""
    face = np.zeros_like(sections)
    height = generated(profile, face).points[:, 2]
    for share in np.linspace(0.0, 1.0, steps + 1):
        face = in_section(generated, profile, face, height + share * (sections - height))
    return face


def held(found: FlankPoints, sections: Floats) -> Bools:
    """Whether places are regular ones of their sections."""
    return (found.regular > 0.0) & (np.abs(found.points[:, 2] - sections) < _ON_PLACE)


def in_section(generated: Generated, profile: Floats, face: Floats, sections: Floats) -> Floats:
    """Angle (K,) near ``face`` at which the surface is in the sections."""
    for _ in range(_NEWTON_STEPS):
        found = generated(profile, face)
        step = (found.points[:, 2] - sections) / found.tangents[:, -1, 2]
        face = face - step
        if np.abs(step).max() < _STILL:
            break
    return face
