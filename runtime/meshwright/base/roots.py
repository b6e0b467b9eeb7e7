"""Roots of a function of one variable, by bracketing."""

import math

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
