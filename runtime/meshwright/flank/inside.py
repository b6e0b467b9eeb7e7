"""Places of a surface inside its limits."""

import math

import numpy as np

from meshwright.flank.rays import leave

#: A place outside a limit is moved back this much further than to first order.
OVERSHOOT = 1.05

#: Newton's method: so many steps at most; one of no more than this, in natural sizes, is rounding.
NEWTON_STEPS, STILL = 40, 1e-14


def on_surface(flank, places, sizes):
    """The places (N, k) moved to where the surface's own conditions hold, by the shortest way in natural sizes."""
    q = places.copy()
    if not flank.body["conditions"]:
        return q
    for _ in range(NEWTON_STEPS):
        conditions = flank(q).conditions
        step = np.linalg.pinv(np.nan_to_num(conditions[:, :, 1:] * sizes)) @ conditions[:, :, :1]
        q = q - step[:, :, 0] * sizes
        if not (np.abs(step) > STILL).any():
            break
    return q


def start_inside(flank, limits, places, sizes):
    """A place (k,) inside every limit, from the places that contact uses, and (); where no such place is found None
    and the names of the limits exceeded at the place that exceeds them least.
    """
    q = on_surface(flank, places[np.isfinite(places).all(axis=1)], sizes)
    nearest, conflict = -np.inf, ()
    for _ in range(NEWTON_STEPS):
        if not len(q):
            break
        values = limits.values(flank(q))
        least = values.min(axis=1)
        best = int(np.argmax(least))
        if least[best] >= 0.0:
            return q[best], ()
        if least[best] > nearest:
            exceeded = [name for name, value in zip(limits.names, values[best], strict=True) if value < 0.0]
            nearest, conflict = least[best], tuple(dict.fromkeys(exceeded))
        q = q[np.isfinite(least)]
        if len(q):
            q = _inwards(flank, limits, q, sizes)
    return None, conflict


def _inwards(flank, limits, q, sizes):
    """Places (N, k) moved along the surface against the limits that they exceed, a little further than first order."""
    found = flank(q)
    values, slopes = limits.values(found), limits.slopes(found) * sizes
    short = np.where(values < 0.0, values, 0.0) * OVERSHOOT
    short[~np.isfinite(short)] = 0.0
    slopes = np.nan_to_num(np.where(short[:, :, None] < 0.0, slopes, 0.0), posinf=0.0, neginf=0.0)
    step = (np.linalg.pinv(slopes, rcond=1e-6) @ -short[:, :, None])[:, :, 0]
    step *= np.minimum(1.0, 0.5 / np.maximum(np.abs(step).max(axis=1, keepdims=True), 1e-300))
    return on_surface(flank, q + step * sizes, sizes)


def deeper(chart, limits, start):
    """A place about as far from the limits on either side of it, by halving chords through ``start`` (k,)."""
    q = start
    for axis in (0, 1, 0, 1):
        ends = [end for end, _, _ in leave(chart, limits, q, [(axis, -1.0), (axis, 1.0)])]
        if not all(math.isfinite(e) for e in ends):
            continue
        at = q[list(chart.free)].copy()
        at[axis] = 0.5 * (ends[0] + ends[1])
        moved = chart.complete(at[None], q[None])[0]
        if limits.least(chart.flank(moved))[0] > 0.0:
            q = moved
    return q
