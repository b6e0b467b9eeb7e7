"""Sides of a tooth whose root is not generated: the flank joins the root by a circular arc in every section.

The arc touches flank and root. Where the flank ends higher up, as a thread's does near its singular line, the arc
starts at the end of the flank and the root is as much higher.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import elementwise

from meshwright.fe.generated import constant
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import OfSections, Section, SectionCurves, Surface
from meshwright.fe.tooth import ToothSide

_SAMPLES = 17


@dataclass(frozen=True)
class Span:
    """Profile parameters (...,) of a flank at its deepest, at its middle and beyond its tip, as functions of its face
    parameter (...,).
    """

    root: Callable[[Floats], Floats]
    middle: Callable[[Floats], Floats]
    tip: Callable[[Floats], Floats]

    @classmethod
    def constant(cls, root: float, middle: float, tip: float) -> Span:
        """The same all along the flank."""
        return cls(constant(root), constant(middle), constant(tip))

    def counted_from(self, shift: float) -> Span:
        """The same as functions of a face parameter that is larger by ``shift``."""
        return Span(*(partial(_shifted, of, shift) for of in (self.root, self.middle, self.tip)))

    def on(self, surface: Surface, section: Section, values: Floats) -> tuple[Floats, Floats, Floats]:
        """The three (K,) where sections ``values`` (K,) cut the surface; ValueError where they do not."""
        root, middle, tip = self.faces(surface, section, values)
        return self.root(root), self.middle(middle), self.tip(tip)

    def faces(self, surface: Surface, section: Section, values: Floats) -> tuple[Floats, Floats, Floats]:
        """The face parameters (K,) of these."""
        root, middle, tip = (_faces(surface, section, values, of) for of in (self.root, self.middle, self.tip))
        return root, middle, tip


def _shifted(of: Callable[[Floats], Floats], shift: float, face: Floats) -> Floats:
    return of(face - shift)


def _faces(surface: Surface, section: Section, values: Floats, of: Callable[[Floats], Floats]) -> Floats:
    """The face parameter (K,) of a line along a flank where sections (K,) cut it."""

    def line(_: Floats, face: Floats) -> tuple[Floats, Floats]:
        return surface(of(face), face)

    return SectionCurves(line, section, of, of).solve(values, np.zeros((len(values), 1)))[:, 0]


@dataclass(frozen=True)
class Outline:
    """Root and tip of a tooth as its sections show them; points (..., 3) in the body frame, mm.

    across: unit normals (..., 3) of the sections.  above_root: height (...,) above the root and its unit gradient
    (..., 3) within the section.  below_tip: height (...,) left to the tip.  radius: of the arc between root and flank.
    """

    across: Callable[[Floats], Floats]
    above_root: Callable[[Floats], tuple[Floats, Floats]]
    below_tip: Callable[[Floats], Floats]
    radius: float

    def arc_centres(self, points: Floats, normals: Floats) -> tuple[Floats, Floats]:
        """Centres (..., 3) of the arcs that touch a flank at points with normals (..., 3), and its unit normals
        (..., 3) within the sections.
        """
        across = self.across(points)
        within = normals - np.sum(normals * across, axis=-1, keepdims=True) * across
        within = within / np.linalg.norm(within, axis=-1, keepdims=True)
        return points + self.radius * within, within

    def arcs(self, centre: Floats, within: Floats, share: Floats) -> tuple[Floats, Floats]:
        """Points and normals (..., 3) at shares (...,) of the arcs from root to flank."""
        _, upward = self.above_root(centre)
        whole = np.arccos(np.clip(np.sum(upward * within, axis=-1), -1.0, 1.0))
        shares = [np.sin((1.0 - share) * whole) / np.sin(whole), np.sin(share * whole) / np.sin(whole)]
        normals = shares[0][..., None] * upward + shares[1][..., None] * within
        return centre - self.radius * normals, normals


def rounded_side(
    surface: Surface, section: Section, span: Span, faces: tuple[float, float], outline: Outline
) -> ToothSide:
    """The side of a generated flank between its rounding at the root and its tip.

    Raises ValueError where the flank does not reach the tip.
    """
    values = np.linspace(*faces, _SAMPLES)
    root, middle, end = span.on(surface, section, values)
    whole = SectionCurves(surface, section, CubicSpline(values, root), CubicSpline(values, end))
    arcs = _Arcs(whole, outline)
    tip = _tip_line(whole, values, (middle, end), outline.below_tip)
    joint = root.copy()
    reaches = arcs.overlap(joint, values) < 0.0
    if reaches.any():
        joint[reaches] = crossing(arcs.overlap, values[reaches], (root[reaches], middle[reaches]))
    joint_of = CubicSpline(values, joint)
    flank = SectionCurves(surface, section, joint_of, tip)
    fillet = OfSections(arcs.surface(joint_of), section, constant(0.0), constant(1.0))
    return ToothSide(fillet, flank)


def _tip_line(
    flank: SectionCurves, values: Floats, ends: tuple[Floats, Floats], below_tip: Callable[[Floats], Floats]
) -> CubicSpline:
    """Profile parameter between ``ends`` (K,) where a section meets the tip, for sections between the ``values`` (K,).

    below_tip: points (..., 3) to the height (...,) left. Raises ValueError where the flank does not reach the tip.
    """
    return CubicSpline(values, crossing(lambda u, s: below_tip(_at(flank, s, u)[0]), values, ends))


def crossing(function: Callable[[Floats, Floats], Floats], values: Floats, ends: tuple[Floats, Floats]) -> Floats:
    """Profile parameter (K,) between ``ends`` (K,) at which the function of it and of the section (K,) vanishes.

    Raises ValueError where it does not.
    """
    found = elementwise.find_root(function, ends, args=(values,), tolerances={"xatol": 1e-13, "xrtol": 1e-13})
    if not np.all(found.success):
        raise ValueError("the flank does not reach its tip in every section of its face")
    return found.x


def _at(curves: SectionCurves, values: Floats, profile: Floats) -> tuple[Floats, Floats]:
    """Points and normals (K, 3), (K, 3) at section values and profile parameters (K,)."""
    _, points, normals = curves.places(values, profile[:, None])
    return points[:, 0], normals[:, 0]


@dataclass(frozen=True)
class _Arcs:
    """The arcs that touch a flank at a profile parameter, one in each section."""

    flank: SectionCurves
    outline: Outline

    def centre(self, profile: Floats, values: Floats) -> tuple[Floats, Floats]:
        """Centres (K, 3) and the flank's unit normals (K, 3) within the sections."""
        return self.outline.arc_centres(*_at(self.flank, values, profile))

    def overlap(self, profile: Floats, values: Floats) -> Floats:
        """Height (K,) of the arcs above the root: 0 where they touch it."""
        return self.outline.above_root(self.centre(profile, values)[0])[0] - self.outline.radius

    def surface(self, joint: Callable[[Floats], Floats]) -> Surface:
        """The arcs as a surface: (share of the arc from root to flank, section value) to points and normals.

        An arc lies in its section, where that is a half plane.
        """

        def evaluate(profile: Floats, face: Floats) -> tuple[Floats, Floats]:
            profile, face = np.broadcast_arrays(profile, face)
            values, which = np.unique(face, return_inverse=True)
            centre, within = self.centre(joint(values), values)
            which = which.reshape(face.shape)
            return self.outline.arcs(centre[which], within[which], profile)

        return evaluate
