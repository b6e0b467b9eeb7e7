"""Deviations of a measured trace and of pitch, in the terms of ISO 1328-1.

A trace runs over its evaluation length; g is its least-squares line. Total deviation F = max δ − min δ, slope
deviation f_H = g(end) − g(begin), form deviation f_f = max(δ − g) − min(δ − g). Profile: F_α, f_Hα, f_fα; helix (lead):
F_β, f_Hβ, f_fβ. All in the unit of δ, along the normal where δ is.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class TraceDeviations:
    """Total, slope and form deviation of one trace."""

    total: float
    slope: float
    form: float


def trace_deviations(places, deviations):
    """:class:`TraceDeviations` of ``deviations`` (n,) at ``places`` (n,) along the trace; n from 2 on, NaN left out."""
    places, deviations = np.asarray(places, float), np.asarray(deviations, float)
    known = np.isfinite(deviations)
    if known.sum() < 2:
        return TraceDeviations(np.nan, np.nan, np.nan)
    x, y = places[known], deviations[known]
    slope, start = np.polyfit(x, y, 1)
    rest = y - (start + slope * x)
    return TraceDeviations(float(np.ptp(y)), float(slope * (x[-1] - x[0])), float(np.ptp(rest)))


@dataclass(frozen=True)
class PitchDeviations:
    """Single pitch deviations f_pt (T,), their largest magnitude, and the total cumulative deviation F_p."""

    single: np.ndarray
    largest: float
    total: float


def pitch_deviations(arcs):
    """:class:`PitchDeviations` of T teeth, ``arcs`` (T,): deviation of each tooth's place at the reference circle."""
    arcs = np.asarray(arcs, float)
    single = np.diff(arcs, prepend=arcs[-1])
    cumulative = np.cumsum(single - single.mean())
    return PitchDeviations(single, float(np.abs(single).max()), float(np.ptp(np.append(cumulative, 0.0))))
