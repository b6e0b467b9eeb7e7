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

from meshwright.base.errors import DesignError
from meshwright.contact.placement import about_z
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import Surface
from meshwright.fe.rounding import Outline, Span, rounded_side
from meshwright.fe.tooth import SideName, Teeth, ToothForm, ToothSide, middle_of_land, moved

# The portion reaches so far to either side of the azimuth that faces the wheel.
HALF_PORTION = np.radians(75.0)

# Steps in which a place on the root is found, and how little, mm, the last one moves it.
_ROOT_STEPS, _ON_ROOT = 60, 1e-12


@dataclass(frozen=True)
class ThreadFlank:
    """One side of the thread at an angle of it in rad: the surface and where its profile ends, with 0 as face
    parameter near the wheel.
    """

    at: Callable[[float], Surface]
    span: Callable[[float], Span]


@dataclass(frozen=True)
class Root:
    """Distance in mm that a place is above the root, and its slopes by the distance from the axis and along it."""

    above: Floats
    slopes: tuple[Floats, Floats]


@dataclass(frozen=True)
class Revolved:
    """Tip and root of a thread, surfaces of revolution: functions of places (...,), distances in mm from the axis and
    positions along it.

    below_tip: positive below the tip, 0 on it.  root: the same above the root, with its slopes.
    """

    below_tip: Callable[[Floats, Floats], Floats]
    root: Callable[[Floats, Floats], Root]

    @classmethod
    def cones(cls, tip: float, root: float, taper: float) -> Revolved:
        """Cones, or cylinders, of radii in mm at z = 0 that grow by ``taper`` along z."""
        slant = np.hypot(1.0, taper)

        def above(radius: Floats, z: Floats, of: float) -> Floats:
            return (radius - of - taper * z) / slant

        def above_root(radius: Floats, z: Floats) -> Root:
            one = np.ones_like(radius)
            return Root(above(radius, z, root), (one / slant, -taper * one / slant))

        return cls(lambda radius, z: -above(radius, z, tip), above_root)

    def from_root(self, radius: Floats, z: Floats) -> Root:
        """The distance from the root itself: from the foot of the normal through a place.

        Raises ValueError where there is no such foot.
        """
        foot, slopes = (radius, z), (radius, z)
        for _ in range(_ROOT_STEPS):
            found = self.root(*foot)
            steep = np.hypot(*found.slopes)
            slopes = found.slopes[0] / steep, found.slopes[1] / steep
            off = radius - foot[0], z - foot[1]
            above = off[0] * slopes[0] + off[1] * slopes[1]
            steps = [o - (above + found.above / steep) * slope for o, slope in zip(off, slopes, strict=True)]
            foot = foot[0] + steps[0], foot[1] + steps[1]
            if np.max(np.abs(steps)) < _ON_ROOT * max(1.0, float(np.max(radius))):
                return Root(above, slopes)
        raise ValueError(f"no place of the root lies below the flank ({np.max(np.abs(steps)):.3g} mm off)")

    def root_radius(self, z: Floats, near: float) -> Floats:
        """Radii (...,) of the root at positions (...,) along the axis, from one in mm that is near.

        Raises ValueError where there is no root.
        """
        radius = np.full_like(z, near)
        for _ in range(_ROOT_STEPS):
            found = self.root(radius, z)
            step = found.above / found.slopes[0]
            radius = radius - step
            if np.max(np.abs(step)) < _ON_ROOT * max(1.0, near):
                return radius
        raise ValueError(f"the root does not reach as far along the axis as {np.abs(z).max():.6g} mm")


@dataclass(frozen=True)
class ThreadBlank:
    """Tip and root, and radii in mm of root and bore at z = 0 and of the rounding at the root."""

    revolved: Revolved
    root: float
    rounding: float
    bore: float

    def outline(self) -> Outline:
        """Tip and root in a half plane through the axis."""

        def above_root(points: Floats) -> tuple[Floats, Floats]:
            found = self.revolved.from_root(np.hypot(points[..., 0], points[..., 1]), points[..., 2])
            upward = _radial(points) * found.slopes[0][..., None]
            upward[..., 2] = found.slopes[1]
            return found.above, upward

        def below_tip(points: Floats) -> Floats:
            return self.revolved.below_tip(np.hypot(points[..., 0], points[..., 1]), points[..., 2])

        return Outline(_azimuthal, above_root, below_tip, self.rounding)

    def bored(self, points: Floats) -> Floats:
        """Points (..., 3) moved radially to the bore, which keeps its share of the root's radius."""
        wanted = self.bore / self.root * self.revolved.root_radius(points[..., 2], self.root)
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

    Raises DesignError, at first use, where a side cannot be rounded or has no land left at tip or root.
    """
    radius, azimuth = float(np.hypot(*facing[:2])), float(np.arctan2(facing[1], facing[0]))
    faces = (-HALF_PORTION * radius, HALF_PORTION * radius)
    outline = blank.outline()

    @cache
    def side(angle: float, name: SideName) -> ToothSide:
        section, flank = HalfPlanes(radius, azimuth - angle), flanks[name]
        try:
            return rounded_side(flank.at(angle), section, flank.span(angle), faces, outline)
        except ValueError as error:
            reason = f"the thread {abs(angle) / pitch:.3g} pitches from its middle is not whole: {error}"
            raise DesignError("blank", None, reason, "change the blank, or model fewer --pairs") from error

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
