"""The closed body of a threaded member between two planes across its axis: all its threads, root, tip, ends and bore.

Planes z = constant cut it, as they cut a gear of as many teeth as it has threads. The fillets are arcs in half planes
through the axis that join flank and root.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from meshwright.fe.generated import constant
from meshwright.fe.hexahedra import Floats, Ints
from meshwright.fe.profile import SectionCurves, Surface
from meshwright.fe.rounding import crossing
from meshwright.fe.thread import ThreadBlank, ThreadFlank
from meshwright.fe.thread_flanks import ThreadSides
from meshwright.flank.polygon import triangles

# A flank's ends are interpolated between so many places per radian of its face parameter, at least so many.
_SAMPLES_PER_RADIAN, _FEWEST_SAMPLES = 12, 33
# How far the places reach beyond the end planes, in parts of the length.
_BEYOND = 0.02
# Rows over a flank and planes from which the refinement starts, and at which it ends; the rows over a fillet.
_FEWEST, _MOST = (6, 48), (64, 4096)
_FILLET_ROWS = 8


@dataclass(frozen=True)
class Sections:
    """A body in K planes z = constant: outline (K, J, 3) counter-clockwise about the axis; bore (2, B, 3) at its ends.

    The last point of an outline is on a root land.
    """

    outline: Floats
    bore: Floats

    def triangles(self) -> tuple[Floats, Ints]:
        """Points (N, 3) and triangles (M, 3), counter-clockwise seen from outside, between first and last plane.

        Raises ValueError where the outline of an end crosses itself.
        """
        planes, count, _ = self.outline.shape
        outer = np.arange(planes * count).reshape(planes, count)
        inner = outer.size + np.arange(2 * self.bore.shape[1]).reshape(2, -1)
        outer_next, inner_next = np.roll(outer, -1, axis=1), np.roll(inner, -1, axis=1)
        points = np.concatenate([self.outline.reshape(-1, 3), self.bore.reshape(-1, 3)])
        first, last = (_end(points, outer[k], inner[k]) for k in (0, -1))
        faces = [
            _quads(outer[:-1], outer_next[:-1], outer_next[1:], outer[1:]),
            _quads(inner[:-1], inner[1:], inner_next[1:], inner_next[:-1]),
            first[:, ::-1],
            last,
        ]
        return points, np.concatenate(faces)


def _quads(a: Ints, b: Ints, c: Ints, d: Ints) -> Ints:
    return np.concatenate([np.stack(corners, axis=-1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))])


def _end(points: Floats, outer: Ints, inner: Ints) -> Ints:
    """Triangles between an outline and the bore in a plane, seen from +z; a seam joins them at the outline's last."""
    azimuth = _azimuth(points[inner]) - _azimuth(points[outer[-1]])
    start = int(np.argmin(np.abs(np.exp(1j * azimuth) - 1.0)))
    hole = np.roll(inner[::-1], start - len(inner) + 1)
    around = np.concatenate([outer, hole, hole[:1], outer[-1:]])
    return around[triangles(points[around][:, :2])]


def thread_body(
    sides: ThreadSides, pitch: float, ends: tuple[float, float], departure: float
) -> tuple[Sections, float]:
    """The body of a thread between two values of z in mm, and how far its flanks' facets are from the flanks, mm.

    pitch: angle between threads.  Raises ValueError where a side has no whole flank, or no land is left.
    """
    left, right = (_Side.of(sides.flanks[name], sides.blank, ends) for name in ("left", "right"))
    rows, planes = _FEWEST
    while True:
        found = [_departures(side.flank, ends, rows, planes) for side in (left, right)]
        across, along, reached = np.max(found, axis=0)
        finer = finer_rows((rows, planes), (across, max(along, reached - across)), departure, _MOST)
        if reached <= departure or finer == (rows, planes):
            break
        rows, planes = finer
    step = np.sqrt(80.0 * departure / sides.blank.tip)
    outline = _outline(left, right, pitch, np.linspace(*ends, planes + 1), rows, step)
    turn = np.linspace(0.0, 2.0 * np.pi, int(np.ceil(2.0 * np.pi / step)), endpoint=False)
    around = np.stack([np.cos(turn), np.sin(turn), np.zeros_like(turn)], axis=-1)
    bore = sides.blank.bored(np.stack([around + [0.0, 0.0, end] for end in ends]))
    return Sections(outline, bore), float(reached)


@dataclass(frozen=True)
class _Side:
    """Flank and fillet of one side in planes z = constant."""

    fillet: SectionCurves
    flank: SectionCurves

    @classmethod
    def of(cls, thread: ThreadFlank, blank: ThreadBlank, ends: tuple[float, float]) -> _Side:
        surface, span, outline = thread.at(0.0), thread.span, blank.outline()
        room = _BEYOND * (ends[1] - ends[0])
        whole = SectionCurves(surface, _axial, constant(span.root), constant(span.tip))
        profile = np.tile([span.root, span.middle, span.tip], (2, 1))
        reach = whole.solve(np.array([ends[0] - room, ends[1] + room]), profile)
        count = max(_FEWEST_SAMPLES, int(_SAMPLES_PER_RADIAN * np.ptp(reach)))
        face = np.linspace(reach.min(), reach.max(), count)

        def overlap(profile: Floats, face: Floats) -> Floats:
            centre, _ = outline.arc_centres(*surface(profile, face))
            return outline.above_root(centre)[0] - outline.radius

        tip = crossing(lambda u, at: outline.below_tip(surface(u, at)[0]), face, (span.middle, span.tip))
        joint = np.full_like(face, span.root)
        reaches = overlap(joint, face) < 0.0
        if reaches.any():
            joint[reaches] = crossing(overlap, face[reaches], (span.root, span.middle))
        joint_of = CubicSpline(face, joint)

        def arcs(share: Floats, face: Floats) -> tuple[Floats, Floats]:
            share, face = np.broadcast_arrays(share, face)
            return outline.arcs(*outline.arc_centres(*surface(joint_of(face), face)), share)

        first, last = (_by_height(surface, profile, face) for profile in (joint, tip))
        return cls(
            SectionCurves(arcs, _axial, constant(0.0), constant(1.0)), SectionCurves(surface, _axial, first, last)
        )


def _axial(points: Floats) -> Floats:
    return points[..., 2]


def _by_height(surface: Surface, profile: Floats, face: Floats) -> CubicSpline:
    """The profile parameter of a line on a flank as a function of z."""
    height = surface(profile, face)[0][:, 2]
    order = np.argsort(height)
    return CubicSpline(height[order], profile[order])


def _grid(curves: SectionCurves, heights: Floats, rows: int) -> tuple[Floats, Floats]:
    """Points and normals (K, rows + 1, 3) from the first to the last profile parameter."""
    first, last = curves.first(heights)[:, None], curves.last(heights)[:, None]
    profile = first + (last - first) * np.linspace(0.0, 1.0, rows + 1)
    return curves.surface(profile, curves.solve(heights, profile))


def _departures(flank: SectionCurves, ends: tuple[float, float], rows: int, planes: int) -> tuple[float, float, float]:
    """:func:`facet_departures` of the flank's facets."""
    return facet_departures(*_grid(flank, np.linspace(*ends, 2 * planes + 1), 2 * rows))


def facet_departures(points: Floats, normals: Floats) -> tuple[float, float, float]:
    """Largest distance in mm of facets from a surface along their edges across and along it, and everywhere on them.

    points, normals (2 K + 1, 2 J + 1, 3) of the surface; the facets' corners are every other one, either diagonal.
    """
    def off(at: tuple, one: tuple, other: tuple) -> Floats:
        return np.sum((0.5 * (points[one] + points[other]) - points[at]) * normals[at], axis=-1)

    even, odd, lower, upper = slice(None, None, 2), slice(1, None, 2), slice(None, -1, 2), slice(2, None, 2)
    across = off((even, odd), (even, lower), (even, upper))
    along = off((odd, even), (lower, even), (upper, even))
    diagonals = (
        off((odd, odd), (lower, lower), (upper, upper)),
        off((odd, odd), (lower, upper), (upper, lower)),
    )
    # over a triangle the distance is quadratic; in its middle 4/9 of the sum of those at its edges' middles
    first, last = slice(None, -1), slice(1, None)
    halves = [(across[k], along[:, m]) for k in (first, last) for m in (first, last)]
    inside = [4.0 / 9.0 * np.abs(a + b + d) for d in diagonals for a, b in halves]
    edges = [np.abs(across).max(), np.abs(along).max(), *(np.abs(d).max() for d in diagonals)]
    return float(edges[0]), float(edges[1]), float(max(*edges, *(i.max() for i in inside)))


def finer_rows(
    rows: tuple[int, int], departures: tuple[float, float], wanted: float, most: tuple[int, int]
) -> tuple[int, int]:
    """Rows across and along a flank at which departures in mm, which fall with their square, are about half of that
    wanted, not above ``most``.
    """
    growth = np.clip(np.sqrt(2.2 * np.array(departures) / wanted), 1.05, 4.0)
    across, along = np.minimum(np.ceil(rows * growth), most)
    return int(across), int(along)


def _outline(left: _Side, right: _Side, pitch: float, heights: Floats, rows: int, step: float) -> Floats:
    """Points (K, J, 3) once around the axis, each thread from its right root over its tip to the land on its left."""
    ascent, descent = (
        np.concatenate([_grid(of.fillet, heights, _FILLET_ROWS)[0][:, :-1], _grid(of.flank, heights, rows)[0]], axis=1)
        for of in (right, left)
    )
    thickness = (_azimuth(descent[:, -1]) - _azimuth(ascent[:, -1])) % pitch
    threads = round((_azimuth(ascent[:1, -1]) + thickness[:1] - _azimuth(descent[:1, -1]))[0] / pitch)
    descent = _about_axis(descent[:, ::-1], np.array(threads * pitch))
    land = (_azimuth(ascent[:, 0]) - _azimuth(descent[:, -1])) % pitch
    tooth = np.concatenate(
        [ascent, _arc(ascent[:, -1], descent[:, 0], thickness, step), descent,
         _arc(descent[:, -1], _about_axis(ascent[:, 0], np.array(pitch)), land, step)], axis=1,
    )  # fmt: skip
    tooth[:, :, 2] = heights[:, None]
    return np.concatenate([_about_axis(tooth, np.array(k * pitch)) for k in range(round(2.0 * np.pi / pitch))], axis=1)


def _azimuth(points: Floats) -> Floats:
    return np.arctan2(points[..., 1], points[..., 0])


def _about_axis(points: Floats, angle: Floats) -> Floats:
    c, s, (x, y, z) = np.cos(angle), np.sin(angle), np.moveaxis(points, -1, 0)
    return np.stack(np.broadcast_arrays(c * x - s * y, s * x + c * y, z), axis=-1)


def _arc(start: Floats, end: Floats, angle: Floats, step: float) -> Floats:
    """Points (K, n, 3) between start and end (K, 3), which it leaves out, over angles (K,) about the axis."""
    count = max(2, int(np.ceil(angle.max() / step)))
    share = np.linspace(0.0, 1.0, count + 1)[1:-1]
    turned = _about_axis(start[:, None], angle[:, None] * share)
    growth = np.hypot(end[:, 0], end[:, 1]) / np.hypot(start[:, 0], start[:, 1])
    radial = (1.0 + (growth[:, None] - 1.0) * share)[..., None]
    return turned * np.concatenate([radial, radial, np.ones_like(radial)], axis=-1)
