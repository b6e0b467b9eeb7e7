"""Numbers modulo a prime drawn at random, with rates along directions and the angle that they stand for."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from random import SystemRandom

from .numbers import random_prime
from .refusal import foreseen

#: Drawn anew in every run; 3 modulo 4, so that the root of a square can be had by a power.
PRIME = random_prime(SystemRandom())
#: What the circle's number is modulo the prime, and the largest divisor of the multiples that decimals stand for.
PI = SystemRandom().randrange(1, PRIME)
#: Which odd function stands for the sign.
SALT = SystemRandom().randrange(1, PRIME)
#: Which function stands for the square root, if it is not the root.
ANY_ROOT: int | None = None


class NoRoot(Exception):
    """A radicand is no square at these inputs; others have to be drawn."""


@dataclass(frozen=True)
class Number:
    """A value with its rates along the directions, and its linear form in independent angles (None: it is its own)."""

    value: int
    rates: tuple[int, ...] = ()
    angle: dict | None = None

    @property
    def form(self) -> dict:
        if self.angle is not None:
            return self.angle
        return {self.value: 1} if self.value else {}


def combined(a: tuple[int, ...], x: int, b: tuple[int, ...], y: int) -> tuple[int, ...]:
    """x*a + y*b for rates of equal length or none."""
    if not a and not b:
        return ()
    if not b:
        return tuple(p * x % PRIME for p in a)
    if not a:
        return tuple(q * y % PRIME for q in b)
    return tuple((p * x + q * y) % PRIME for p, q in zip(a, b, strict=True))


def add(a: Number, b: Number, sign: int = 1) -> Number:
    angle = dict(a.form)
    for name, factor in b.form.items():
        angle[name] = angle.get(name, 0) + (factor if sign == 1 else -factor)
        if not angle[name]:
            del angle[name]
    return Number((a.value + sign * b.value) % PRIME, combined(a.rates, 1, b.rates, sign), angle)


def multiply(a: Number, b: Number) -> Number:
    return Number(a.value * b.value % PRIME, combined(a.rates, b.value, b.rates, a.value))


def divide(a: Number, b: Number) -> Number:
    foreseen(b.value, "a division by zero")
    inverse = pow(b.value, -1, PRIME)
    value = a.value * inverse % PRIME
    return Number(value, combined(a.rates, inverse, b.rates, -value * inverse))


def square_root(value: int) -> int:
    if ANY_ROOT is not None:
        return hash((ANY_ROOT, value % PRIME)) % PRIME
    root_of_value = pow(value, (PRIME + 1) // 4, PRIME)
    if not root_of_value or (root_of_value**2 - value) % PRIME:
        raise NoRoot
    return root_of_value


def halved(cosine: int, sine: int) -> tuple[int, int]:
    """Cosine and sine of half the angle."""
    half = square_root((1 + cosine) * pow(2, -1, PRIME) % PRIME)
    return half, sine * pow(2 * half, -1, PRIME) % PRIME


def root(a: Number) -> Number:
    value = square_root(a.value)
    return Number(value, combined(a.rates, pow(2 * value, -1, PRIME), (), 0))


def sign(a: Number) -> Number:
    """An odd function that is constant; nothing else is asked of the sign, so that no branch stands for the others.

    Where its square has to be 1, or a root of a square it, SALT is 0: 1 for squares, else -1.
    """
    residue = pow(a.value, (PRIME - 1) // 2, PRIME)
    if not residue or not SALT:
        return Number(residue if residue else 1)
    return Number(residue * hash((SALT, a.value * a.value % PRIME)) % PRIME)


@contextmanager
def any_root(salt: int) -> Iterator[None]:
    """Any function in the place of the square root, by a number of its own: no radicand has to be a square."""
    globals()["ANY_ROOT"] = salt
    try:
        yield
    finally:
        globals()["ANY_ROOT"] = None


@contextmanager
def real_signs() -> Iterator[None]:
    """Signs whose squares are 1, and that are those of roots of squares."""
    kept, globals()["SALT"] = SALT, 0
    try:
        yield
    finally:
        globals()["SALT"] = kept


def scaled(a: Number, literal: Fraction | int, product: Number) -> Number:
    """A product with a literal keeps its linear form if there is one."""
    angle = None if a.angle is None else {name: factor * literal for name, factor in a.angle.items() if literal}
    return Number(product.value, product.rates, angle)
