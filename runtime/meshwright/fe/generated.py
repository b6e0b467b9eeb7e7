"""What all solid models share: generated regions as functions of two parameters, and turns."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from meshwright.contact.placement import about_z
from meshwright.drive import Drive
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import Section, SectionCurves, Smooth, Surface
from meshwright.flank.surface import Flank

_BISECTIONS = 60


def region_surface(drive: Drive, member: str, region: str) -> Smooth:
    """A generated region of two parameters as a function of two arrays."""
    return _Generated(drive.flank(member, region))


@dataclass(frozen=True)
class _Generated:
    """A region over its own two parameters."""

    flank: Flank

    def __call__(self, profile: Floats, face: Floats) -> tuple[Floats, Floats]:
        profile, face = np.broadcast_arrays(profile, face)
        found = self.flank(np.stack([profile.ravel(), face.ravel()], axis=1))
        return found.points.reshape(*profile.shape, 3), found.normals.reshape(*profile.shape, 3)

    def tangents(self, profile: Floats, face: Floats) -> tuple[Floats, Floats]:
        found = self.flank(np.stack([profile, face], axis=1))
        return found.points, found.tangents


def tip_parameter(drive: Drive, member: str, section: Section, values: Floats, ends: tuple[float, float]) -> Floats:
    """Profile parameter (K,) between ``ends`` at which the flank's sections ``values`` (K,) meet the blank's tip."""
    generated = drive.flank(member)
    curves = SectionCurves(region_surface(drive, member, "flank"), section, constant(ends[0]), constant(ends[1]))
    low, high = np.full_like(values, ends[0]), np.full_like(values, ends[1])
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        face = curves.solve(values, middle[:, None])[:, 0]
        below = generated(np.stack([middle, face], axis=1)).margins["tip"] > 0.0
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return 0.5 * (low + high)


def turned(surface: Surface, angle: float, shift: float = 0.0) -> Surface:
    """The surface turned about z by an angle in rad, its face parameter counted from ``shift`` on."""
    rotation = about_z(angle)[:3, :3].T
    if isinstance(surface, Smooth):
        return _Turned(surface, rotation, shift)
    return _TurnedRows(surface, rotation, shift)


@dataclass(frozen=True)
class _TurnedRows:
    surface: Surface
    rotation: Floats
    shift: float

    def __call__(self, profile: Floats, face: Floats) -> tuple[Floats, Floats]:
        points, normals = self.surface(profile, face - self.shift)
        return points @ self.rotation, normals @ self.rotation


@dataclass(frozen=True)
class _Turned(_TurnedRows):
    surface: Smooth

    def tangents(self, profile: Floats, face: Floats) -> tuple[Floats, Floats]:
        points, tangents = self.surface.tangents(profile, face - self.shift)
        return points @ self.rotation, tangents @ self.rotation


def constant(value: float) -> Callable[[Floats], Floats]:
    """The same profile parameter on every section."""
    return lambda sections: np.full_like(sections, value)
