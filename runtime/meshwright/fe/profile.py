"""Section curves of a tooth side: exact points of a generated surface at given section and arc length."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from meshwright.fe.hexahedra import Floats

Surface = Callable[[Floats, Floats], tuple[Floats, Floats]]
"""Two parameter arrays of one shape to points and outward unit normals (..., 3), body frame, mm."""


@runtime_checkable
class Smooth(Protocol):
    """A :data:`Surface` that tells where straight lines meet it, as that of every flank does."""

    def __call__(self, profile: Floats, face: Floats) -> tuple[Floats, Floats]: ...

    def pierced(self, feet: Floats, plane: Floats, start: tuple[float, float]) -> tuple[Floats, ...]:
        """Both parameters (N,), points and outward unit normals (N, 3) where the normals of a plane through feet (N, 3)
        meet it, from nearby parameters; not a number where they do not. ``plane`` (2, 3): directions that span it.
        """
        ...


class Section(Protocol):
    """The surfaces that cut a tooth across, of revolution or half planes: points (..., 3), body frame, mm."""

    def at(self, points: Floats) -> Floats:
        """The coordinate (...,) that is constant on a section."""
        ...

    def factors(self, values: Floats) -> tuple[Floats, Floats]:
        """Factors (K, 4) of x, y, z and the distance from the axis, and what (K,) they add up to on sections (K,)."""
        ...

    def across(self, points: Floats) -> Floats:
        """Unit normals (..., 3) of the sections."""
        ...


@runtime_checkable
class Cut(Smooth, Protocol):
    """A surface that also tells where sections of a tooth cut it."""

    def on_sections(self, profile: Floats, factors: Floats, values: Floats, start: Floats) -> tuple[Floats, ...]:
        """Face parameter (N,), points and outward unit normals (N, 3) at profile parameters (N,) where x, y, z and the
        distance from the axis with ``factors`` (N, 4) add up to ``values`` (N,), from nearby face parameters (N,); not
        a number where there are none.
        """
        ...


_SECANT_STEPS = 30
_SECTION_TOLERANCE = 1e-12
# So many times the tolerance is as good as surfaces can be evaluated.
_FOUND = 1e3
_TABLE_POINTS = 129


@dataclass(frozen=True)
class SectionCurves:
    """The curves that sections cut from a surface, from a first to a last value of its profile parameter.

    surface: (profile parameter, face parameter) to points and normals.  section: the coordinate held on a section.
    first, last: profile parameter at the ends, as functions of the section values (K,) (root end, tip end).  near: face
    parameter near which sections cut the surface, as such a function too.
    """

    surface: Surface
    section: Section
    first: Callable[[Floats], Floats]
    last: Callable[[Floats], Floats]
    near: Callable[[Floats], Floats] = np.zeros_like

    def places(self, values: Floats, profile: Floats) -> tuple[Floats, Floats, Floats]:
        """Face parameter, shape of ``profile`` (K, J), where the section coordinate is ``values`` (K,), and points and
        outward normals (K, J, 3) there.
        """
        wanted = np.broadcast_to(values[:, None], profile.shape)
        if isinstance(self.surface, Cut):
            factors, sums = (np.repeat(of, profile.shape[1], axis=0) for of in self.section.factors(values))
            start = np.repeat(self.near(values), profile.shape[1])
            face, *found = self.surface.on_sections(profile.ravel(), factors, sums, start)
            points, normals = (of.reshape(*profile.shape, 3) for of in found)
            # the other half of a plane through the axis is none of the section
            if np.all(np.abs(self.section.at(points) - wanted) < _FOUND * _SECTION_TOLERANCE):
                return face.reshape(profile.shape), points, normals
        return self._by_secants(wanted, profile)

    def _by_secants(self, wanted: Floats, profile: Floats) -> tuple[Floats, Floats, Floats]:
        """The same at section values (K, J)."""
        older = np.broadcast_to(self.near(wanted[:, 0])[:, None], profile.shape)
        newer = older + 1e-3
        miss_older = self.section.at(self.surface(profile, older)[0]) - wanted
        for _ in range(_SECANT_STEPS):
            points, normals = self.surface(profile, newer)
            miss = self.section.at(points) - wanted
            if np.all(np.abs(miss) < _SECTION_TOLERANCE):
                return newer, points, normals
            change = miss - miss_older
            step = np.where(change == 0.0, 0.0, -miss * (newer - older) / np.where(change == 0.0, 1.0, change))
            older, newer, miss_older = newer, newer + step, miss
        if np.max(np.abs(miss)) > _FOUND * _SECTION_TOLERANCE:
            raise ValueError(f"the flank does not reach a section of its face (miss {np.max(np.abs(miss)):.3g} mm)")
        return newer, *self.surface(profile, newer)

    def solve(self, values: Floats, profile: Floats) -> Floats:
        """Face parameter, shape of ``profile`` (K, J), where the section coordinate is ``values`` (K,)."""
        return self.places(values, profile)[0]

    def points(self, values: Floats, profile: Floats) -> Floats:
        """Points (K, J, 3) on the surface at section values (K,) and profile parameters (K, J)."""
        return self.places(values, profile)[1]

    def normals(self, values: Floats, profile: Floats) -> Floats:
        """Outward normals (K, J, 3) at the same points."""
        return self.places(values, profile)[2]

    def rail(self, values: Floats) -> Rail:
        """The curves at given section values (K,), ready to be divided by arc length."""
        fraction = np.linspace(0.0, 1.0, _TABLE_POINTS)
        first, last = self.first(values)[:, None], self.last(values)[:, None]
        profile = first + (last - first) * fraction
        points = self.points(values, profile)
        steps = np.linalg.norm(np.diff(points, axis=1), axis=-1)
        lengths = np.concatenate([np.zeros((len(values), 1)), np.cumsum(steps, axis=1)], axis=1)
        return Rail(self, values, profile, points, lengths)


class OfSections(SectionCurves):
    """Curves of a surface whose second parameter is the section itself."""

    def places(self, values: Floats, profile: Floats) -> tuple[Floats, Floats, Floats]:
        face = np.broadcast_to(values[:, None], profile.shape).copy()
        return face, *self.surface(profile, face)


@dataclass(frozen=True)
class Rail:
    """Section curves tabulated by arc length: K curves, tables (K, P) and points (K, P, 3)."""

    curves: SectionCurves
    values: Floats
    profile: Floats
    table: Floats
    lengths: Floats

    @property
    def total(self) -> Floats:
        """Arc lengths (K,) of the curves in mm."""
        return self.lengths[:, -1]

    def parameters(self, fractions: Floats) -> Floats:
        """Profile parameters (K, J) at fractions (K, J) of the arc length."""
        rows = zip(fractions * self.total[:, None], self.lengths, self.profile, strict=True)
        return np.stack([np.interp(wanted, lengths, profile) for wanted, lengths, profile in rows])

    def at(self, fractions: Floats) -> Floats:
        """Points (K, J, 3) on the surface itself, near the given fractions (K, J) of the arc length."""
        return self.curves.points(self.values, self.parameters(fractions))
