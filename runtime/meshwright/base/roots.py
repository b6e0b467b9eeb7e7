"""Roots of functions of one variable, by bracketing: Chandrupatla's method (T. R. Chandrupatla, Advances in Engineering
Software 28, 1997), inverse quadratic interpolation where it is safe, bisection elsewhere.
"""

import math

import numpy as np

MAX_STEPS = 200


def bracketed(function, a, b, tolerance, values=None):
    """The root of a continuous ``function`` between ``a`` and ``b``, to ``tolerance`` in the variable.

    The signs at the ends must differ. ``values`` are the function's values at a and b if they are known.
    """
    fa, fb = values if values is not None else (function(a), function(b))
    if fa == 0.0:
        return a
    if fb == 0.0:
        return b
    if not fa * fb < 0.0:
        raise ValueError(f"no change of sign between {a} and {b}")
    c, fc, share = a, fa, 0.5
    for _ in range(MAX_STEPS):
        x = a + share * (b - a)
        fx = function(x)
        if (fx < 0.0) == (fa < 0.0):
            c, fc = a, fa
        else:
            c, fc, b, fb = b, fb, a, fa
        a, fa = x, fx
        width = abs(b - a)
        if fa == 0.0 or width <= tolerance or not math.isfinite(fx):
            break
        share = _next_share(a, b, c, fa, fb, fc)
        share = min(max(share, 0.5 * tolerance / width), 1.0 - 0.5 * tolerance / width)
    return a if abs(fa) < abs(fb) else b


def _next_share(a, b, c, fa, fb, fc):
    """Where between a and b to look next."""
    xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
    if not (phi * phi < xi and (1.0 - phi) ** 2 < 1.0 - xi):
        return 0.5
    return fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)


def narrowed(function, inside, outside, values, tolerance, near, steps):
    """Of N functions at once the roots between places ``inside`` (N,) and ``outside`` (N,), to ``tolerance`` (N,).

    ``function(x, rows)`` gives the values (R,) of the functions ``rows`` (R,) at x (R,): not negative inside, negative
    or not a number outside. ``values``: those inside and outside, (N,) each. A value inside below ``near`` is a root.
    No result: who asks keeps the last place inside, after ``steps`` steps at most.
    """
    a, b, fa, fb = outside.copy(), inside.copy(), values[1].copy(), values[0].copy()
    with np.errstate(divide="ignore", invalid="ignore"):
        c, fc, share = a.copy(), fa.copy(), fa / (fa - fb)
    rows = np.flatnonzero(a != b)
    for _ in range(steps):
        if not len(rows):
            return
        least = np.minimum(0.5 * tolerance[rows] / np.abs(b[rows] - a[rows]), 0.5)
        known = np.where(np.isfinite(share[rows]), share[rows], 0.5)
        x = a[rows] + np.clip(known, least, 1.0 - least) * (b[rows] - a[rows])
        fx = function(x, rows)
        other = (fx >= 0.0) != (fa[rows] >= 0.0)
        c[rows], fc[rows] = np.where(other, b[rows], a[rows]), np.where(other, fb[rows], fa[rows])
        b[rows], fb[rows] = np.where(other, a[rows], b[rows]), np.where(other, fa[rows], fb[rows])
        a[rows], fa[rows] = x, fx
        rows = rows[~((fx >= 0.0) & (fx < near)) & (np.abs(b[rows] - x) > tolerance[rows])]
        share[rows] = _next_shares(*(v[rows] for v in (a, b, c, fa, fb, fc)))


def _next_shares(a, b, c, fa, fb, fc):
    """Where between each a and b to look next; not a number where nothing is known of it."""
    with np.errstate(divide="ignore", invalid="ignore"):
        xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
        safe = (phi * phi < xi) & ((1.0 - phi) ** 2 < 1.0 - xi)
        share = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
    return np.where(safe, share, 0.5)
