"""The thread of a threaded member: at every angle of it the portion that faces the wheel, as a tooth of a rack.

Sections are half planes through the member's axis; their coordinate is the length along the reference circle from the
azimuth that faces the wheel. Neighbours along the axis are threads, or turns of the same one, met a pitch earlier and
later. The shaft goes on beyond the portion, so its end faces are held. The member turns by its angle about +z of its
body frame and is right-handed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from meshwright.contact.placement import about_z
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import Surface
from meshwright.fe.rounding import Outline, Span, rounded_side
from meshwright.fe.tooth import SideName, Teeth, ToothForm, ToothSide, middle_of_land, moved

# The portion reaches so far to either side of the azimuth that faces the wheel.
_HALF_PORTION = np.radians(75.0)

@dataclass(frozen=True)
class ThreadFlank:
    """One side of the thread: the surface at an angle of the thread in rad, with 0 as face parameter near the wheel."""

    at: Callable[[float], Surface]
    span: Span


@dataclass(frozen=True)
class ThreadBlank:
    """Radii in mm at z = 0 of tip, root, rounding at the root and bore; taper: growth of the others along z."""

    tip: float
    root: float
    rounding: float
    bore: float
    taper: float = 0.0

    def outline(self) -> Outline:
        """Tip and root in a half plane through the axis."""
        slant = np.hypot(1.0, self.taper)

        def above(points: Floats, radius: float) -> Floats:
            return (np.hypot(points[..., 0], points[..., 1]) - radius - self.taper * points[..., 2]) / slant

        def above_root(points: Floats) -> tuple[Floats, Floats]:
            radial = _radial(points)
            radial[..., 2] = -self.taper
            return above(points, self.root), radial / slant

        return Outline(_azimuthal, above_root, lambda points: -above(points, self.tip), self.rounding)

    def bored(self, points: Floats) -> Floats:
        """Points (..., 3) moved radially to the bore, which keeps its share of the root's radius."""
        share = self.bore / self.root
        wanted = share * (self.root + self.taper * points[..., 2])
        scale = wanted / np.hypot(points[..., 0], points[..., 1])
        return points * np.stack([scale, scale, np.ones_like(scale)], axis=-1)


def thread_teeth(
    flanks: dict[SideName, ThreadFlank],
    working: SideName,
    blank: ThreadBlank,
    pitch: float,
    facing: Floats,
) -> Teeth:
    """The thread as teeth; facing (3,): a point that faces the wheel at the angle 0; pitch: angle between threads.

    Raises ValueError, at first use, where a side cannot be rounded or has no land left at tip or root.
    """
    radius, azimuth = float(np.hypot(*facing[:2])), float(np.arctan2(facing[1], facing[0]))
    faces = (-_HALF_PORTION * radius, _HALF_PORTION * radius)
    outline = blank.outline()

    @cache
    def side(angle: float, name: SideName) -> ToothSide:
        section = HalfPlanes(radius, azimuth - angle)
        return rounded_side(flanks[name].at(angle), section, flanks[name].span, faces, outline)

    def cut(angle: float, values: Floats) -> Floats:
        """Between the thread at this angle and its right neighbour, met a pitch later."""
        left = side(angle - pitch, "left").root_end(values)
        return middle_of_land(side(angle, "right").root_end(values), moved(about_z(-pitch), left))

    @cache
    def at(angle: float) -> ToothForm:
        return ToothForm(
            lambda name: side(angle, name),
            faces,
            lambda values: moved(about_z(pitch), cut(angle + pitch, values)),
            lambda values: cut(angle, values),
            blank.bored,
            cut_ends=True,
        )

    return Teeth(at, working)


def side_of(normal: Floats) -> SideName:
    """Side of a thread with an outward normal (3,): the right one faces +z."""
    return "right" if normal[2] > 0.0 else "left"


def opposite(name: SideName) -> SideName:
    """The other side."""
    return "left" if name == "right" else "right"


@dataclass(frozen=True)
class HalfPlanes:
    """Half planes through the axis as sections: the length in mm along a circle about it, from an azimuth in rad."""

    radius: float
    azimuth: float

    def at(self, points: Floats) -> Floats:
        """The length (...,) at points (..., 3)."""
        c, s, x, y = np.cos(self.azimuth), np.sin(self.azimuth), points[..., 0], points[..., 1]
        return self.radius * np.arctan2(c * y - s * x, c * x + s * y)

    def factors(self, values: Floats) -> tuple[Floats, Floats]:
        """Factors (K, 4) of x, y, z and the distance from the axis: they add up to 0 (K,) in these planes (K,)."""
        azimuth = self.azimuth + values / self.radius
        nothing = np.zeros_like(azimuth)
        return np.stack([-np.sin(azimuth), np.cos(azimuth), nothing, nothing], axis=1), nothing

    def across(self, points: Floats) -> Floats:
        """Unit vectors (..., 3) around the axis."""
        return _azimuthal(points)


def _radial(points: Floats) -> Floats:
    unit = points / np.hypot(points[..., 0], points[..., 1])[..., None]
    unit[..., 2] = 0.0
    return unit


def _azimuthal(points: Floats) -> Floats:
    radial = _radial(points)
    return np.stack([-radial[..., 1], radial[..., 0], radial[..., 2]], axis=-1)
