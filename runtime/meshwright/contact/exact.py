"""Exact numbers of a design and of an angle, and the enclosures that certified arithmetic reads and writes.

A number of a design is the shortest decimal that reads back as its double: the one that was written, unless more than
sixteen digits were. Angles in degrees are multiples of π, which is given by bounds.
"""

import math
from fractions import Fraction

import numpy as np

from meshwright.base.library import record

#: π lies between (Archimedes' bounds, to 60 decimals).
PI = (
    Fraction("3.141592653589793238462643383279502884197169399375105820974944"),
    Fraction("3.141592653589793238462643383279502884197169399375105820974945"),
)

#: What both are whole multiples of the inverse of.
_PI_OF = 10**60


def decimal(number):
    """The decimal that a double was written as, a fraction."""
    return Fraction(repr(float(number)))


def wide(low, high):
    """(high, low, radius) of doubles: every number between two fractions is within ``radius`` of ``high + low``."""
    of = low.denominator * high.denominator
    return _wide(low.numerator * high.denominator, high.numerator * low.denominator, of)


def _wide(low, high, of):
    """The same of whole numbers, over another one."""
    middle, twice = low + high, 2 * of
    first = middle / twice
    a, b = first.as_integer_ratio()
    middle, by = middle * b - a * twice, twice * b
    second = middle / by
    c, d = second.as_integer_ratio()
    rest, by = (high - low) * b * d + abs(middle * d - c * by), by * d
    radius = rest / by
    e, f = radius.as_integer_ratio()
    return first, second, radius if e * by >= rest * f else math.nextafter(radius, math.inf)


def upwards(value):
    """The least double not below a fraction."""
    near = float(value)
    return near if Fraction(near) >= value else math.nextafter(near, math.inf)


def downwards(value):
    """The largest double not above a fraction."""
    return -upwards(-value)


def wides(pairs):
    """An array of ``mw_wide`` from bounds; NaN where there are none (None)."""
    array = np.full(len(pairs), np.nan, dtype=record("mw_wide"))
    for k, pair in enumerate(pairs):
        if pair is not None:
            array[k] = wide(*pair)
    return array


def doubles(numbers):
    """An array of ``mw_wide`` of doubles (N,), each the number that it is."""
    array = np.zeros(len(numbers), dtype=record("mw_wide"))
    array["hi"] = numbers
    return array


def radians(degrees):
    """Bounds of an angle in rad, given in degrees as a fraction."""
    ends = sorted(degrees * p / 180 for p in PI)
    return ends[0], ends[1]


def angles(degrees, sign):
    """An array of ``mw_wide`` of angles given in degrees as fractions, times a sign."""
    ends = [sign * (p * _PI_OF).numerator for p in PI]
    array = np.empty(len(degrees), dtype=record("mw_wide"))
    for k, angle in enumerate(degrees):
        low, high = sorted(angle.numerator * end for end in ends)
        array[k] = _wide(low, high, 180 * angle.denominator * _PI_OF)
    return array


def bounds(entry):
    """The two fractions between which an ``mw_wide`` or ``mw_ball`` lies."""
    middle = Fraction(float(entry["hi"])) + Fraction(float(entry["lo"])) if "hi" in entry.dtype.names else None
    middle = Fraction(float(entry["mid"])) if middle is None else middle
    radius = Fraction(float(entry["radius"]))
    return middle - radius, middle + radius


def arcseconds(low, high):
    """Doubles around the same angles in arcseconds: (low, high), rounded outwards."""
    ends = [Fraction(648000) * angle / p for angle in (low, high) for p in PI]
    return downwards(min(ends)), upwards(max(ends))
