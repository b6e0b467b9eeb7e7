"""What all solid models share: generated regions as functions of two parameters, and turns."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from meshwright.contact.placement import about_z
from meshwright.drive import Drive
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import Cut, Section, SectionCurves, Surface
from meshwright.flank.surface import Flank

_BISECTIONS = 60


def region_surface(drive: Drive, member: str, region: str) -> Cut:
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

    def pierced(self, feet: Floats, plane: Floats, start: tuple[float, float]) -> tuple[Floats, ...]:
        q = pierced(self.flank, feet, plane, np.array(start))
        found = self.flank(q)
        return q[:, 0], q[:, 1], found.points, found.normals

    def on_sections(self, profile: Floats, factors: Floats, values: Floats, start: Floats) -> tuple[Floats, ...]:
        near = np.stack([profile, start], axis=1)
        found = self.flank(on_sections(self.flank, profile, factors, values, near))
        return found.parameters[:, 1], found.points, found.normals


def on_sections(flank: Flank, profile: Floats, sections: Floats, values: Floats, start: Floats) -> Floats:
    """Parameters (N, k), from nearby ones (N, k), with given first ones (N,) where x, y, z and the distance from the
    axis with factors (N, 4) add up to values (N,).
    """
    count, k = start.shape
    factors = np.zeros((count, 2, k + 4))
    factors[:, 0, 0], factors[:, 1, k:] = 1.0, sections
    return flank.places(factors, flank.sizes, np.stack([profile, values], axis=1), start)


def pierced(flank: Flank, feet: Floats, plane: Floats, start: Floats) -> Floats:
    """Parameters (N, k), from nearby ones (k,), where normals of a plane (2, 3) through feet (N, 3) meet a flank."""
    factors = np.zeros((2, len(start) + 4))
    factors[:, len(start) : len(start) + 3] = plane
    return flank.places(factors, flank.sizes, feet @ plane.T, np.tile(start, (len(feet), 1)))


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
    if isinstance(surface, Cut):
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
    surface: Cut

    def pierced(self, feet: Floats, plane: Floats, start: tuple[float, float]) -> tuple[Floats, ...]:
        back = self.rotation.T
        profile, face, *found = self.surface.pierced(feet @ back, plane @ back, (start[0], start[1] - self.shift))
        return profile, face + self.shift, *(of @ self.rotation for of in found)

    def on_sections(self, profile: Floats, factors: Floats, values: Floats, start: Floats) -> tuple[Floats, ...]:
        turned_back = np.column_stack([factors[:, :3] @ self.rotation.T, factors[:, 3]])
        face, *found = self.surface.on_sections(profile, turned_back, values, start - self.shift)
        return face + self.shift, *(of @ self.rotation for of in found)


def constant(value: float) -> Callable[[Floats], Floats]:
    """The same profile parameter on every section."""
    return lambda sections: np.full_like(sections, value)
