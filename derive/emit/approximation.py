"""Polynomials for sine, cosine and arctangent, found anew by Chebyshev fitting in 40-digit arithmetic.

Generated C needs no mathematical library but ``sqrt``: its own functions vectorise and give the same bits on every
compiler and processor. Coefficients are rounded to double, lowest power first.
"""

from functools import cache

import mpmath

#: Square of the distance between two angles below which the series r − r³/6 + r⁵/120 and r²/2 − r⁴/24 are exact to
#: double precision of the sine and cosine to which they are added.
NEAR = 2.0**-18


def _fit(function, upper, terms):
    with mpmath.workdps(40):
        highest_first = mpmath.chebyfit(cache(function), [mpmath.mpf(10) ** -12, upper], terms)
        return tuple(float(c) for c in reversed(highest_first))


@cache
def sine():
    """P with sin r = r + r³ P(r²) for |r| ≤ π/4."""
    return _fit(lambda z: (mpmath.sin(mpmath.sqrt(z)) / mpmath.sqrt(z) - 1) / z, (mpmath.pi / 4) ** 2, 6)


@cache
def cosine():
    """Q with cos r = 1 − r²/2 + r⁴ Q(r²) for |r| ≤ π/4."""
    return _fit(lambda z: (mpmath.cos(mpmath.sqrt(z)) - 1 + z / 2) / z**2, (mpmath.pi / 4) ** 2, 6)


@cache
def arctangent():
    """P with atan r = r + r³ P(r²) for |r| ≤ tan(π/8)."""
    return _fit(lambda z: (mpmath.atan(mpmath.sqrt(z)) / mpmath.sqrt(z) - 1) / z, mpmath.tan(mpmath.pi / 8) ** 2, 11)


@cache
def half_pi_parts():
    """π/2 in three parts; the first two have 33 bits, so that their multiples up to 2²⁰ are exact."""
    return _half_pi(33, 33)


@cache
def half_pi_halves():
    """π/2 in two parts, for products that are not rounded before they are subtracted."""
    return _half_pi(53)


def _half_pi(*bits):
    with mpmath.workdps(60):
        rest, parts = mpmath.pi / 2, []
        for count in bits:
            unit = mpmath.ldexp(1, mpmath.frexp(rest)[1] - count)
            parts.append(mpmath.floor(rest / unit) * unit)
            rest -= parts[-1]
        return tuple(float(p) for p in (*parts, rest))
