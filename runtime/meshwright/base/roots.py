"""Roots of functions of one variable, by bracketing."""

import math

import numpy as np

MAX_STEPS = 200


def bracketed(function, a, b, tolerance, values=None):
    """The root of a continuous ``function`` between ``a`` and ``b``, to ``tolerance`` in the variable.

    The signs at the ends must differ. Chandrupatla's method: inverse quadratic interpolation where it is safe,
    bisection elsewhere. ``values`` are the function's values at a and b if they are known.
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


def narrowed(function, inner, outer, values, tolerance, small=0.0):
    """Ends (N,) of intervals from ``inner`` to ``outer`` (N,), narrowed to ``tolerance`` (N,) about the places at which
    functions pass from zero or more to less, or to none; by the method of :func:`bracketed`, all at once.

    ``function(x, which)`` gives the values (M,) of the functions numbered ``which`` (M,) at places x (M,); ``values``
    are those at both ends. Where one is below ``small`` at an inner end, that is enough.
    """
    inner, outer = np.array(inner, dtype=float), np.array(outer, dtype=float)
    left = np.flatnonzero(np.abs(outer - inner) > tolerance)
    a, b, fa, fb, exact = (v[left] for v in (inner, outer, *values, tolerance))
    with np.errstate(all="ignore"):
        share = fa / (fa - fb)
        share = np.where((share > 0.0) & (share < 1.0), share, 0.5)
        for _ in range(MAX_STEPS):
            if not left.size:
                break
            x = a + share * (b - a)
            fx = function(x, left)
            inside = fx >= 0.0
            inner[left[inside]], outer[left[~inside]] = x[inside], x[~inside]
            same = inside == (fa >= 0.0)
            c, fc, b, fb = np.where(same, (a, fa, b, fb), (b, fb, a, fa))
            width = np.abs(b - x)
            going = (width > exact) & ~(inside & (fx < small))
            left, a, b, c, fa, fb, fc, exact, width = (v[going] for v in (left, x, b, c, fx, fb, fc, exact, width))
            share = _next_shares(a, b, c, fa, fb, fc)
            share = np.clip(share, 0.5 * exact / width, 1.0 - 0.5 * exact / width)
    return inner, outer


def _next_shares(a, b, c, fa, fb, fc):
    """:func:`_next_share` of many; halfway from where a function is zero, which may be so for a while."""
    xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
    share = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
    return np.where((phi * phi < xi) & ((1.0 - phi) ** 2 < 1.0 - xi) & (fa != 0.0), share, 0.5)
