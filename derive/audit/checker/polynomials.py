"""Polynomials of a certificate in exact integers, quotients of them, and bounds on their size.

As text: `2*0^2*4+-1*1`, coefficient * generator^power.
"""

import re

from .refusal import require

#: Bounds on degree and on log2 of the sum of absolute coefficients, of any numerator or denominator.
LARGEST_DEGREE = 2**24
LARGEST_BITS = 2**24

#: coefficient * generator^power, the numbers without leading zeros, no power that is 1.
TERM = re.compile(r"-?[1-9]\d*(\*(0|[1-9]\d*)(\^([2-9]|[1-9]\d+))?)*", re.ASCII)


class Size:
    """Bounds on a quotient: degrees of numerator and denominator, log2 of the sums of their absolute coefficients."""

    __slots__ = ("above", "below", "bits")

    def __init__(self, above: int, below: int, bits: int):
        require(max(above, below) <= LARGEST_DEGREE, "the degree of a tree is out of range")
        require(bits <= LARGEST_BITS, "the coefficients of a tree are out of range")
        self.above, self.below, self.bits = above, below, bits

    def __add__(self, other):
        above = max(self.above + other.below, other.above + self.below)
        return Size(above, self.below + other.below, self.bits + other.bits + 1)

    def __mul__(self, other):
        return Size(self.above + other.above, self.below + other.below, self.bits + other.bits)

    def __neg__(self):
        return self

    def inverse(self):
        return Size(self.below, self.above, self.bits)


class TooLarge(Exception):
    """An expansion exceeds its budget; random points decide instead."""


class Quotient:
    """An expanded numerator over a list of factors, in exact integers; `work` counts products of terms left."""

    __slots__ = ("numerator", "factors", "work")

    def __init__(self, numerator: dict, factors: dict, work: list):
        self.numerator, self.factors, self.work = numerator, factors, work

    def __add__(self, other):
        common = {key: max(times, other.factors.get(key, 0)) for key, times in self.factors.items()}
        common = {**other.factors, **common}
        total = dict(self.over(common))
        for key, amount in other.over(common).items():
            accumulate(total, key, amount)
        return Quotient(total, common, self.work)

    def over(self, common: dict) -> dict:
        """The numerator over a common denominator."""
        total = self.numerator
        for key, times in common.items():
            for _ in range(times - self.factors.get(key, 0)):
                total = product(total, dict(key), self.work)
        return total

    def __mul__(self, other):
        factors = dict(self.factors)
        for key, times in other.factors.items():
            factors[key] = factors.get(key, 0) + times
        return Quotient(product(self.numerator, other.numerator, self.work), factors, self.work)

    def __neg__(self):
        return Quotient({key: -amount for key, amount in self.numerator.items()}, self.factors, self.work)

    def inverse(self):
        require(self.numerator, "a denominator vanishes")
        above = {(): 1}
        for key, times in self.factors.items():
            for _ in range(times):
                above = product(above, dict(key), self.work)
        below = {} if self.numerator == {(): 1} else {tuple(sorted(self.numerator.items())): 1}
        return Quotient(above, below, self.work)

    def vanishes(self) -> bool:
        return not self.numerator


def product(a: dict, b: dict, work: list) -> dict:
    """Product of two polynomials, (generator, power) pairs -> coefficient."""
    work[0] -= len(a) * len(b)
    if work[0] < 0:
        raise TooLarge
    total: dict = {}
    for first, amount in a.items():
        for second, factor in b.items():
            accumulate(total, joined(first, second), amount * factor)
    return total


def joined(first: tuple, second: tuple) -> tuple:
    """The product of two monomials."""
    if not first or not second:
        return first or second
    powers = dict(first)
    for index, exponent in second:
        powers[index] = powers.get(index, 0) + exponent
    return tuple(sorted(powers.items()))


def read_polynomial(text: str) -> dict:
    """Powers ((generator, power), ...) -> coefficient."""
    terms = {}
    for term in text.split("+") if text else ():
        require(TERM.fullmatch(term), f"{term!r} is no term in canonical form")
        factor, *powers = term.split("*")
        key = tuple((int(index), int(exponent or 1)) for index, _, exponent in (item.partition("^") for item in powers))
        require(key not in terms, "a polynomial repeats a term")
        require([i for i, _ in key] == sorted({i for i, _ in key}), "a term is not in canonical order")
        require(all(0 < exponent <= 4096 for _, exponent in key), "an exponent is out of range")
        terms[key] = int(factor)
    return terms


def degree_of(terms: dict) -> int:
    return max((sum(exponent for _, exponent in key) for key in terms), default=0)


def times_relation(cofactor: dict, generator: int, square: dict) -> dict:
    """cofactor * (generator^2 - square)."""
    total: dict = {}
    for key, amount in cofactor.items():
        for other, scale in [(((generator, 2),), 1), *((powers, -value) for powers, value in square.items())]:
            accumulate(total, joined(key, other), amount * scale)
    return total


def accumulate(terms: dict, key: tuple, amount: int) -> None:
    total = terms.get(key, 0) + amount
    if total:
        terms[key] = total
    else:
        terms.pop(key, None)
