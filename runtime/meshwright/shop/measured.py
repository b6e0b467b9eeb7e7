"""Measured deviations by tooth and flank: traces across and along it, and pitch.

Normal deviations in mm, positive for excess material, over the chord length from point to point of each trace; the
part's angle is as in the file. Terms as of :mod:`meshwright.shop.deviations`.
"""

from dataclasses import dataclass

import numpy as np

from meshwright.shop.deviations import pitch_deviations, trace_deviations
from meshwright.shop.located import located


@dataclass(frozen=True)
class MeasuredFlank:
    """A flank of one tooth: ``map`` (N, M) of deviations, NaN where nothing is measured, ``profile`` (M,) and ``lead``
    (N,) its :class:`~meshwright.shop.deviations.TraceDeviations` with the lengths of the traces, mm.
    """

    tooth: int
    flank: str
    map: np.ndarray
    profile: tuple
    lead: tuple


@dataclass(frozen=True)
class Measured:
    """All flanks, and pitch deviations by flank at the ``radius`` (mm) where all teeth are measured; else none."""

    flanks: tuple[MeasuredFlank, ...]
    pitch: dict


def measured(drive, member, points):
    """:class:`Measured` of :class:`~meshwright.shop.tables.Points` with deviations.

    Raises :class:`~meshwright.base.errors.UsageError` for points that are not nominal points of the design.
    """
    located(drive, member, points)
    shape = int(points.i.max()) + 1, int(points.j.max()) + 1
    flanks, arcs = [], {}
    for tooth, word in dict.fromkeys(zip(points.tooth.tolist(), points.flank, strict=True)):
        own = np.flatnonzero((points.tooth == tooth) & np.array([w == word for w in points.flank]))
        places, deviations = np.full((*shape, 3), np.nan), np.full(shape, np.nan)
        places[points.i[own], points.j[own]] = points.points[own]
        deviations[points.i[own], points.j[own]] = points.deviations[own]
        profile = tuple(_trace(places[:, j], deviations[:, j]) for j in range(shape[1]))
        lead = tuple(_trace(places[i], deviations[i]) for i in range(shape[0]))
        flanks.append(MeasuredFlank(tooth, word, deviations, profile, lead))
        middle = own[(points.i[own] == shape[0] // 2) & (points.j[own] == shape[1] // 2)]
        if len(middle) and np.isfinite(points.deviations[middle[0]]):
            arcs.setdefault(word, {})[tooth] = _arc(points, middle[0])
    count = drive.teeth(member)
    pitch = {
        word: (radius, pitch_deviations([by_tooth[k][1] for k in range(1, count + 1)]))
        for word, by_tooth in arcs.items()
        if count > 1 and len(by_tooth) == count
        for radius in [by_tooth[1][0]]
    }
    return Measured(tuple(flanks), pitch)


def _trace(places, deviations):
    """Length (mm) of the measured part of a trace, and its deviations."""
    known = np.isfinite(deviations)
    steps = np.linalg.norm(np.diff(places[known], axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)]) if known.any() else np.empty(0)
    return (float(along[-1]) if len(along) else 0.0), trace_deviations(along, deviations[known])


def _arc(points, k):
    """Radius of a point, and how far its tooth stands ahead in the sense of +z along that circle for its deviation."""
    radius = np.hypot(*points.points[k, :2])
    lever = points.normals[k] @ np.cross([0.0, 0.0, 1.0], points.points[k])
    return float(radius), float(radius * points.deviations[k] / lever)
