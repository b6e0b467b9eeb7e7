"""The sides of a thread in planes across its axis, z = constant.

They cut it as they cut a gear of as many teeth as it has threads. The fillets are arcs in half planes through the axis
that join flank and root.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from meshwright.fe.generated import constant
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import SectionCurves, Surface
from meshwright.fe.rounding import crossing
from meshwright.fe.thread import ThreadBlank, ThreadFlank
from meshwright.flank.sections import Sections

# A flank's ends are interpolated between so many places per radian of its face parameter, at least so many.
_SAMPLES_PER_RADIAN, _FEWEST_SAMPLES = 12, 33
# How far the places reach beyond the end planes, in parts of the length.
_BEYOND = 0.02


@dataclass(frozen=True)
class ThreadSide:
    """Flank and fillet of one side of a thread: a :class:`~meshwright.flank.sides.Side`."""

    fillet: SectionCurves
    flank: SectionCurves

    sections = Sections(0.0)
    has_fillet = True
    has_step = False

    def grids(self, values: Floats, fillet: Floats, flank: Floats) -> tuple[Floats, Floats, Floats]:
        """As :class:`~meshwright.flank.sides.Side` says."""
        points, normals = _grid(self.flank, values, flank)
        rounded, _ = _grid(self.fillet, values, fillet)
        rounded[:, -1] = points[:, 0]
        return rounded, points, normals

    def breaks(self) -> Floats:
        """A thread has none."""
        return np.empty(0)

    @classmethod
    def of(cls, thread: ThreadFlank, blank: ThreadBlank, ends: tuple[float, float]) -> ThreadSide:
        """The side between two values of z in mm; raises ValueError where it has no whole flank."""
        surface, span, outline = thread.at(0.0), thread.span(0.0), blank.outline()
        room = _BEYOND * (ends[1] - ends[0])
        around = np.array([ends[0] - room, ends[1] + room])
        reach = np.concatenate(span.faces(surface, cls.sections, around))
        count = max(_FEWEST_SAMPLES, int(_SAMPLES_PER_RADIAN * np.ptp(reach)))
        face = np.linspace(reach.min(), reach.max(), count)

        def overlap(profile: Floats, face: Floats) -> Floats:
            centre, _ = outline.arc_centres(*surface(profile, face))
            return outline.above_root(centre)[0] - outline.radius

        middle, end = span.middle(face), span.tip(face)
        tip = crossing(lambda u, at: outline.below_tip(surface(u, at)[0]), face, (middle, end))
        joint = span.root(face)
        reaches = overlap(joint, face) < 0.0
        if reaches.any():
            joint[reaches] = crossing(overlap, face[reaches], (joint[reaches], middle[reaches]))
        joint_of = CubicSpline(face, joint)

        def arcs(share: Floats, face: Floats) -> tuple[Floats, Floats]:
            share, face = np.broadcast_arrays(share, face)
            return outline.arcs(*outline.arc_centres(*surface(joint_of(face), face)), share)

        first, last = (_by_height(surface, profile, face, profile) for profile in (joint, tip))
        near = _by_height(surface, middle, face, face)
        return cls(
            SectionCurves(arcs, cls.sections, constant(0.0), constant(1.0), near),
            SectionCurves(surface, cls.sections, first, last, near),
        )


def _by_height(surface: Surface, profile: Floats, face: Floats, number: Floats) -> CubicSpline:
    """A number of a line on a flank as a function of z."""
    height = surface(profile, face)[0][:, 2]
    order = np.argsort(height)
    return CubicSpline(height[order], number[order])


def _grid(curves: SectionCurves, heights: Floats, shares: Floats) -> tuple[Floats, Floats]:
    """Points and normals (K, J, 3) at shares (J,) of the way from the first to the last profile parameter."""
    first, last = curves.first(heights)[:, None], curves.last(heights)[:, None]
    profile = first + (last - first) * shares
    points, normals = curves.surface(profile, curves.solve(heights, profile))
    points[..., 2] = heights[:, None]
    return points, normals
