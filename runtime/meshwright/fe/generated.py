"""What all solid models share: generated regions as functions of two parameters, and turns."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from meshwright.contact.placement import about_z
from meshwright.drive import Drive
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import Section, SectionCurves, Surface

_BISECTIONS = 60


def region_surface(drive: Drive, member: str, region: str) -> Surface:
    """A generated region as a function of two parameter arrays."""
    generated = drive.flank(member, region)

    def evaluate(profile: Floats, face: Floats) -> tuple[Floats, Floats]:
        profile, face = np.broadcast_arrays(profile, face)
        found = generated(np.stack([profile.ravel(), face.ravel()], axis=1))
        return found.points.reshape(*profile.shape, 3), found.normals.reshape(*profile.shape, 3)

    return evaluate


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


def turned(surface: Surface, angle: float) -> Surface:
    """The surface turned about z."""
    rotation = about_z(angle)[:3, :3].T

    def evaluate(profile: Floats, face: Floats) -> tuple[Floats, Floats]:
        points, normals = surface(profile, face)
        return points @ rotation, normals @ rotation

    return evaluate


def constant(value: float) -> Callable[[Floats], Floats]:
    """The same profile parameter on every section."""
    return lambda sections: np.full_like(sections, value)
