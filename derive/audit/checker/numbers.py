"""Dual numbers over numbers of any kind, and residues modulo a prime.

The int 0 is an exact zero of every kind; no other int occurs as a value.
"""

import random

from .refusal import require

#: Bounds on what one node may ask for.
LARGEST_EXPONENT = 64
LARGEST_INTEGER = 10**60


class Dual:
    """value + rate * epsilon, epsilon^2 = 0."""

    __slots__ = ("value", "rate")

    def __init__(self, value, rate):
        self.value, self.rate = value, rate


def parts(number):
    return (number.value, number.rate) if type(number) is Dual else (number, 0)


def add(a, b):
    if type(a) is int:
        return b
    if type(b) is int:
        return a
    if type(a) is Dual or type(b) is Dual:
        (u, du), (v, dv) = parts(a), parts(b)
        return Dual(add(u, v), add(du, dv))
    return a + b


def mul(a, b):
    if type(a) is int or type(b) is int:
        return 0
    if type(a) is Dual or type(b) is Dual:
        (u, du), (v, dv) = parts(a), parts(b)
        return Dual(mul(u, v), add(mul(u, dv), mul(du, v)))
    return a * b


def neg(a):
    if type(a) is Dual:
        return Dual(neg(a.value), neg(a.rate))
    return 0 if type(a) is int else -a


def inverse(a):
    if type(a) is Dual:
        value = inverse(a.value)
        return Dual(value, neg(mul(a.rate, mul(value, value))))
    require(type(a) is not int, "a denominator vanishes")
    return a.inverse()


def power(a, exponent: int, one):
    require(abs(exponent) <= LARGEST_EXPONENT, "an exponent is out of range")
    base, result = (inverse(a) if exponent < 0 else a), one
    for _ in range(abs(exponent)):
        result = mul(result, base)
    return result


def same(a, b) -> bool:
    """Equal numbers; 0 stands for a zero of any kind."""
    difference = add(a, neg(b))
    return type(difference) is int or difference.vanishes()


class Residue:
    """An integer modulo a prime."""

    __slots__ = ("value", "prime")

    def __init__(self, value: int, prime: int):
        self.value, self.prime = value % prime, prime

    def __add__(self, other):
        return Residue(self.value + other.value, self.prime)

    def __mul__(self, other):
        return Residue(self.value * other.value, self.prime)

    def __neg__(self):
        return Residue(-self.value, self.prime)

    def inverse(self):
        require(self.value, "a denominator vanishes")
        return Residue(pow(self.value, -1, self.prime), self.prime)

    def vanishes(self) -> bool:
        return not self.value


def is_prime(n: int) -> bool:
    """Miller and Rabin's test with the bases that decide every n below 3.3e24 (Sorenson and Webster 2015)."""
    bases = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41)
    if any(n % base == 0 for base in bases):
        return n in bases
    odd, twos = n - 1, 0
    while odd % 2 == 0:
        odd, twos = odd // 2, twos + 1
    for base in bases:
        x = pow(base, odd, n)
        if x in (1, n - 1):
            continue
        for _ in range(twos - 1):
            x = x * x % n
            if x == n - 1:
                break
        else:
            return False
    return True


def random_prime(rng: random.Random) -> int:
    """A prime of 61 bits that is 3 modulo 4, so that a^((p+1)/4) is the root of a square; there are about 1.3e16."""
    while True:
        candidate = 2**60 + 4 * rng.randrange(2**58) + 3
        if is_prime(candidate):
            return candidate
