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
    """A :data:`Surface` that knows its tangents, as that of every flank does."""

    def __call__(self, profile: Floats, face: Floats) -> tuple[Floats, Floats]: ...

    def tangents(self, profile: Floats, face: Floats) -> tuple[Floats, Floats]:
        """Points (N, 3) at parameters (N,) and their derivatives (N, 2, 3) by the two."""
        ...


class Section(Protocol):
    """The surfaces that cut a tooth across, of revolution or half planes: points (..., 3), body frame, mm."""

    def at(self, points: Floats) -> Floats:
        """The coordinate (...,) that is constant on a section."""
        ...

    def across(self, points: Floats) -> Floats:
        """Unit normals (..., 3) of the sections."""
        ...


_SECANT_STEPS = 30
_SECTION_TOLERANCE = 1e-12
_TABLE_POINTS = 129


@dataclass(frozen=True)
class SectionCurves:
    """The curves that sections cut from a surface, from a first to a last value of its profile parameter.

    surface: (profile parameter, face parameter) to points and normals.  section: the coordinate held on a section.
    first, last: profile parameter at the ends, as functions of the section values (K,) (root end, tip end).
    """

    surface: Surface
    section: Section
    first: Callable[[Floats], Floats]
    last: Callable[[Floats], Floats]

    def solve(self, values: Floats, profile: Floats) -> Floats:
        """Face parameter, shape of ``profile`` (K, J), where the section coordinate is ``values`` (K,)."""
        wanted = np.broadcast_to(values[:, None], profile.shape)
        older, newer = np.zeros_like(profile), np.full_like(profile, 1e-3)
        miss_older = self.section.at(self.surface(profile, older)[0]) - wanted
        for _ in range(_SECANT_STEPS):
            miss = self.section.at(self.surface(profile, newer)[0]) - wanted
            if np.all(np.abs(miss) < _SECTION_TOLERANCE):
                return newer
            change = miss - miss_older
            step = np.where(change == 0.0, 0.0, -miss * (newer - older) / np.where(change == 0.0, 1.0, change))
            older, newer, miss_older = newer, newer + step, miss
        if np.max(np.abs(miss)) > 1e3 * _SECTION_TOLERANCE:
            raise ValueError(f"the flank does not reach a section of its face (miss {np.max(np.abs(miss)):.3g} mm)")
        return newer

    def points(self, values: Floats, profile: Floats) -> Floats:
        """Points (K, J, 3) on the surface at section values (K,) and profile parameters (K, J)."""
        return self.surface(profile, self.solve(values, profile))[0]

    def normals(self, values: Floats, profile: Floats) -> Floats:
        """Outward normals (K, J, 3) at the same points."""
        return self.surface(profile, self.solve(values, profile))[1]

    def rail(self, values: Floats) -> Rail:
        """The curves at given section values (K,), ready to be divided by arc length."""
        fraction = np.linspace(0.0, 1.0, _TABLE_POINTS)
        first, last = self.first(values)[:, None], self.last(values)[:, None]
        profile = first + (last - first) * fraction
        points = self.points(values, profile)
        steps = np.linalg.norm(np.diff(points, axis=1), axis=-1)
        lengths = np.concatenate([np.zeros((len(values), 1)), np.cumsum(steps, axis=1)], axis=1)
        return Rail(self, values, profile, points, lengths)


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
