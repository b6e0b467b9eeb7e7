"""The line along which flanks touch, or an edge of one touches the other."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from meshwright.base.library import ffi
from meshwright.base.plain import finite_or_none

#: Chords of less than this share of a line say nothing of how it bends.
SHORT = 1e-4


@dataclass(frozen=True)
class TouchingLine:
    """The line along which flanks touch at a pinion ``angle`` (rad), or an edge touches a flank, from end to end.

    ``places``: its points as C has them, M of ``mw_first``, right hand; ``points`` (M, 3), fixed frame, mm. ``ends``:
    of either end the names of the member and of the limit that end it, None and "" where nothing does. ``curvatures``
    (M,): relative curvature across the line, 1/mm, NaN along an edge.
    """

    angle: float
    places: object
    points: np.ndarray
    ends: tuple[tuple[str | None, str], ...]
    curvatures: np.ndarray

    def __getstate__(self):
        """What another process can be given: the points, without C's memory."""
        return self.__dict__ | {"places": None}

    @property
    def middle(self):
        """The place nearest to the middle of its length."""
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(self.points, axis=0), axis=1))])
        return ffi.addressof(self.places, int(np.argmin(np.abs(along - 0.5 * along[-1]))))

    def unknowns(self, drive):
        """Unknowns of contact at its points, right hand: (M, nx)."""
        return np.array([unknowns_at(drive, place) for place in self.places])

    @property
    def length(self):
        """Length of the line, mm."""
        return _arc_length(self.points)

    def mirrored(self, mirror):
        """The same by a :class:`~meshwright.design.mirror.Mirror`."""
        return replace(self, angle=mirror.sign * self.angle, points=self.points * mirror.flip)

    def plain(self):
        """The entry ``contact_line`` of a TCA."""
        ends = [(at, member, [limit] if limit else []) for at, (member, limit)
                in zip(self.points[[0, -1]].tolist(), self.ends, strict=True)]  # fmt: skip
        return {
            "points_mm": self.points.tolist(),
            "ends": [{"point_mm": at, "member": member, "limits": limits} for at, member, limits in ends],
            "length_mm": self.length,
            "curvature_per_mm": [finite_or_none(value) for value in self.curvatures],
        }


def unknowns_at(drive, place):
    """Unknowns (nx,) of the contact at a place, right hand."""
    description, x = drive.design.description, np.empty(drive.model.nx)
    for body, own in zip(description["bodies"], (place.q_pinion, place.q_wheel), strict=True):
        x[body["unknowns"]] = list(own)[: len(body["unknowns"])]
    x[description["error"]] = place.wheel_turn
    return x


def _arc_length(points):
    """Length of a smooth curve through points (M, 3): chords, and by how much arcs through three points are longer."""
    chords = np.linalg.norm(np.diff(points, axis=0), axis=1)
    kept = np.concatenate([[True], chords > SHORT * chords.sum()])
    points = points[kept]
    before, after = (np.linalg.norm(d, axis=1) for d in (points[1:-1] - points[:-2], points[2:] - points[1:-1]))
    if not len(before):
        return float(chords.sum())
    both = np.linalg.norm(points[2:] - points[:-2], axis=1)
    bends = np.maximum(before + after - both, 0.0) / (3.0 * before * after * (before + after))  # curvature²/24
    each = np.concatenate([bends[:1], 0.5 * (bends[1:] + bends[:-1]), bends[-1:]])
    return float(chords.sum() + each @ np.concatenate([before[:1], after]) ** 3)
