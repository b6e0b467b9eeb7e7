"""Fractions over a polynomial ring whose denominators stay a list of factors: no gcd is taken and nothing cancels.

Every factor of a denominator is a side condition of the statement in which it occurs.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from derive.prove.polynomial import Poly, PolynomialRing

Factors = tuple[tuple[Poly, int], ...]


@dataclass(frozen=True)
class Quotient:
    """numerator / product of factor**power."""

    ring: PolynomialRing
    numerator: Poly
    factors: Factors = ()

    def __add__(self, other: Quotient) -> Quotient:
        common = _least_common(self.factors, other.factors)
        return Quotient(
            self.ring,
            self.numerator * self._product(_missing(common, self.factors))
            + other.numerator * self._product(_missing(common, other.factors)),
            common,
        )

    def __neg__(self) -> Quotient:
        return Quotient(self.ring, -self.numerator, self.factors)

    def __sub__(self, other: Quotient) -> Quotient:
        return self + (-other)

    def __mul__(self, other: Quotient) -> Quotient:
        return Quotient(self.ring, self.numerator * other.numerator, _merged(self.factors, other.factors))

    def __truediv__(self, other: Quotient) -> Quotient:
        """Divide by a numerator that is not identically zero; it becomes a side condition."""
        if not other.numerator:
            raise ZeroDivisionError("division by an expression that is identically zero")
        factors = () if other.numerator == self.ring.constant(1) else ((other.numerator, 1),)
        return Quotient(self.ring, self.numerator * self._product(other.factors), _merged(self.factors, factors))

    def __pow__(self, power: int) -> Quotient:
        if power < 0:
            return Quotient(self.ring, self.ring.constant(1)) / self**-power
        return Quotient(
            self.ring, self.numerator**power, tuple((factor, times * power) for factor, times in self.factors if power)
        )

    def derivative(self, rates: Mapping[str, Quotient]) -> Quotient:
        """Directional derivative; `rates` gives the rate of every generator that moves."""
        inner = Quotient(self.ring, self.ring.constant(0))
        for name, rate in rates.items():
            slope = self.ring.partial(self.numerator, name)
            if slope:
                inner += Quotient(self.ring, slope, self.factors) * rate
            for factor, times in self.factors:
                slope = self.ring.partial(factor, name)
                if slope:
                    scaled = self.numerator * slope * -times
                    inner += Quotient(self.ring, scaled, _merged(self.factors, ((factor, 1),))) * rate
        return inner

    def _product(self, factors: Factors) -> Poly:
        product = self.ring.constant(1)
        for factor, times in factors:
            product *= factor**times
        return product


def _merged(left: Factors, right: Factors) -> Factors:
    merged = list(left)
    for factor, times in right:
        for position, (known, count) in enumerate(merged):
            if known == factor:
                merged[position] = (known, count + times)
                break
        else:
            merged.append((factor, times))
    return tuple(merged)


def _power_in(factor: Poly, factors: Factors) -> int:
    return next((times for known, times in factors if known == factor), 0)


def _least_common(left: Factors, right: Factors) -> Factors:
    shared = [(factor, max(times, _power_in(factor, right))) for factor, times in left]
    return tuple(shared + [(factor, times) for factor, times in right if not _power_in(factor, left)])


def _missing(common: Factors, have: Factors) -> Factors:
    return tuple(
        (factor, times - _power_in(factor, have)) for factor, times in common if times > _power_in(factor, have)
    )
