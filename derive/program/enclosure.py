"""Exact rational bounds of constants that no fraction is equal to, such as multiples of π.

A constant of a program is printed as the double nearest to it; certified arithmetic needs to know how far that is off.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import isqrt

import mpmath
import sympy as sp

#: Decimal digits of the numbers that come from outside, and binary digits of roots: far beyond any double's.
DIGITS, ROOT_BITS = 80, 256


@dataclass(frozen=True)
class Enclosure:
    """``low`` ≤ the constant ≤ ``high``."""

    low: Fraction
    high: Fraction

    @classmethod
    def of(cls, value: Enclosure | Fraction | int | float) -> Enclosure:
        """The enclosure of an exact fraction or double."""
        return value if isinstance(value, Enclosure) else cls(Fraction(value), Fraction(value))

    @classmethod
    def of_symbol(cls, symbol: sp.Expr) -> Enclosure:
        """The enclosure of a SymPy number such as π, from its digits; a SymPy float is the double that it holds."""
        if isinstance(symbol, sp.Float):
            return cls.of(float(symbol))
        with mpmath.workdps(DIGITS):
            digits = Fraction(int(mpmath.floor(mpmath.mpf(symbol.evalf(DIGITS)) * 10 ** (DIGITS - 10))))
        unit = Fraction(1, 10 ** (DIGITS - 10))
        return cls((digits - 1) * unit, (digits + 2) * unit)

    @property
    def exact(self) -> bool:
        return self.low == self.high

    def hull(self, other: Enclosure) -> Enclosure:
        return Enclosure(min(self.low, other.low), max(self.high, other.high))

    def __neg__(self) -> Enclosure:
        return Enclosure(-self.high, -self.low)

    def __add__(self, other: Enclosure) -> Enclosure:
        return Enclosure(self.low + other.low, self.high + other.high)

    def __sub__(self, other: Enclosure) -> Enclosure:
        return self + (-other)

    def __mul__(self, other: Enclosure) -> Enclosure:
        products = [a * b for a in (self.low, self.high) for b in (other.low, other.high)]
        return Enclosure(min(products), max(products))

    def sqrt(self) -> Enclosure:
        unit = 1 << ROOT_BITS
        scaled = [k.numerator * unit * unit // k.denominator for k in (self.low, self.high)]
        return Enclosure(Fraction(isqrt(scaled[0]), unit), Fraction(isqrt(scaled[1]) + 1, unit))

    def parts(self) -> tuple[float, float, float]:
        """(high, low, radius), doubles: the constant is within ``radius`` of ``high + low``."""
        middle = (self.low + self.high) / 2
        high = float(middle)
        low = float(middle - Fraction(high))
        rest = max(abs(self.low - Fraction(high) - Fraction(low)), abs(self.high - Fraction(high) - Fraction(low)))
        return high, low, _upwards(rest)


def _upwards(value: Fraction) -> float:
    """A double not below a fraction."""
    near = float(value)
    return near if Fraction(near) >= value else near * (1 + 2.0**-50)
