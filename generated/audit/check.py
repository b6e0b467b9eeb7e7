#!/usr/bin/env python3
"""Re-check the audit record with the standard library alone: `python check.py [folder]`, exit status 0 if everything
holds.

The record is two files of canonical JSON, one object per line. `ledger.jsonl` holds sources, steps (definitions),
equations and verdicts; `certificates.jsonl` holds what shows each equation true or false. Every object carries the
sha256 of the rest of itself and names the objects it rests on by their sha256, so the one root hash pins all of them.
`artifacts.json` seals every generated file, these pages included.

What is checked:
  lines         canonical text, no key twice, the keys of its kind and no other, every object used by a verdict
  hashes        every object, every link, the root, every generated file, none missing and none added
  bindings      a verdict judges the source of its own name; its equations are what the source's reading says, read
                anew from the text; a printed number stands in the print; a corrected equation differs from the printed
                one; a statement does not rest on two identical sides
  names         symbols, cosines, roots, arcs and jets are different things; equal names of roots are equal roots
  relations     only sin^2 + cos^2 = 1, root^2 = radicand and sign^2 = 1, each angle and root once
  certificates  numerator = sum of cofactor * relation, in exact integers
  trees         lhs - rhs = numerator / denominators: expanded in exact integers where that fits, else at three points,
                each modulo a prime of its own, prime and point drawn at random in this run; cosines, sines and roots
                are independent there, and derivatives are carried out by dual numbers, not by the prover's formulas
  not vacuous   at a point of the variety modulo a random prime, and at the recorded real point, both sides exist and
                agree
  refutations   the sides differ at the recorded point by more than the bounds of the arithmetic (exact fractions, with
                an enclosure wherever pi, a bare angle, a root or an arc enters)
  numbers       a printed number holds if its formula lies within half a unit of its last printed digit
  verdicts      follow from the certificates that they name
Degree and coefficients of lhs - rhs are bounded here, from the trees alone, before anything is evaluated. The bound
that is printed at the end is the probability that a wrong certificate passes three random points.
"""

from __future__ import annotations

import ast
import hashlib
import json
import math
import random
import re
import sys
from fractions import Fraction
from math import isqrt
from pathlib import Path

POINTS = 3
#: Products of terms that the exact expansion of one certificate may take.
EXPANSION = 12_000
#: Bounds on degree and on log2 of the sum of absolute coefficients, of any numerator or denominator.
LARGEST_DEGREE = 2**24
LARGEST_BITS = 2**24
#: Bounds on what one node may ask for.
LARGEST_EXPONENT = 64
LARGEST_INTEGER = 10**60
#: Enclosures are rounded to this.
GRID = 10**45
#: The recorded decimals of values that are not rational may be off by this.
ROUNDED = Fraction(1, 10**20)
NAME = re.compile(r"[A-Za-z]\w*", re.ASCII)
RESERVED = re.compile(r"(sqrt|arc)\d+")
PRINTED = re.compile(r"-?\d+(\.\d+)?")


class Rejected(Exception):
    """The record is not what it claims to be; the message says where."""


def require(condition: object, message: str) -> None:
    if not condition:
        raise Rejected(message)


# ---- numbers: residues, enclosures, polynomial quotients, bounds; dual numbers over any, nested once a derivative ---
# The int 0 is an exact zero of every kind; no other int occurs as a value.


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


class Ball:
    """A real number: an exact fraction, or a middle with the radius of its enclosure."""

    __slots__ = ("middle", "radius")

    def __init__(self, middle, radius=0):
        self.middle, self.radius = Fraction(middle), Fraction(radius)
        if radius:
            rounded = Fraction(round(self.middle * GRID), GRID)
            spread = self.radius + abs(rounded - self.middle)
            self.middle, self.radius = rounded, Fraction(math.ceil(spread * GRID), GRID)

    def __add__(self, other):
        return Ball(self.middle + other.middle, self.radius + other.radius)

    def __mul__(self, other):
        spread = (
            abs(self.middle) * other.radius + abs(other.middle) * self.radius + self.radius * other.radius
        )
        return Ball(self.middle * other.middle, spread)

    def __neg__(self):
        return Ball(-self.middle, self.radius)

    def inverse(self):
        require(abs(self.middle) > self.radius, "a denominator vanishes")
        nearest = abs(self.middle) - self.radius
        return Ball(1 / self.middle, self.radius / (abs(self.middle) * nearest))

    def root(self):
        require(self.middle - self.radius >= 0, "the root of a negative number")
        low, high = (square_root(value) for value in (self.middle - self.radius, self.middle + self.radius))
        return Ball((low[0] + high[1]) / 2, (high[1] - low[0]) / 2)

    def vanishes(self) -> bool:
        """May it be zero? For an exact value: is it zero?"""
        return abs(self.middle) <= self.radius


def square_root(value: Fraction) -> tuple:
    """The root from below and from above; equal where it is rational."""
    above, below = isqrt(value.numerator), isqrt(value.denominator)
    if above * above == value.numerator and below * below == value.denominator:
        return Fraction(above, below), Fraction(above, below)
    floor = isqrt(value.numerator * GRID**2 // value.denominator)
    return Fraction(floor, GRID), Fraction(floor + 1, GRID)


def arctangent(t: Ball) -> Ball:
    """Euler's series after halving of the angle where t is large; d(arctan t) <= dt."""
    middle, radius = t.middle, t.radius
    if middle < 0:
        return -arctangent(-t)
    if not middle:
        return Ball(0, radius)
    if middle > 1:
        exact = Ball(middle)
        half = exact * (Ball(1) + (Ball(1) + exact * exact).root()).inverse()
        return Ball(2) * arctangent(half) + Ball(0, radius)
    square = shortened(middle * middle / (1 + middle * middle))
    term = total = shortened(middle / (1 + middle * middle))
    n = 1
    while term * GRID > 1:
        term = shortened(term * square * 2 * n / (2 * n + 1))
        total += term
        n += 1
    return Ball(total, radius + Fraction(n + 4, GRID))


def cosine_and_sine(angle: Ball, pi: Ball) -> tuple:
    """Taylor series after taking off full turns; |d cos|, |d sin| <= |d angle|."""
    turns = round(angle.middle / (2 * pi.middle))
    reduced = angle + Ball(-2 * turns) * pi
    x = shortened(reduced.middle)
    totals, term, n = [Fraction(0), Fraction(0)], Fraction(1), 0
    while n < 4 or abs(term) * GRID > 1:
        totals[n % 2] += term * (-1) ** (n // 2)
        n += 1
        term = shortened(term * x / n)
    spread = reduced.radius + Fraction(n + 4, GRID)
    return Ball(totals[0], spread), Ball(totals[1], spread)


def shortened(value: Fraction) -> Fraction:
    """Cut to a grid 1000 times as fine as that of enclosures."""
    return Fraction(int(value * GRID * 1000), GRID * 1000)


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


# ---- environments: what symbols, cosines, jets and roots are worth ---------------------------------------------------


class Point:
    """Generators are independent; what one of them is worth, a subclass says."""

    def __init__(self, scope: dict):
        self.scope, self.known, self.memo = scope, {}, {}

    def generator(self, name: str):
        if name not in self.known:
            self.known[name] = self.drawn(name)
        return self.known[name]

    def circle(self, name: str):
        return self.generator(f"cos({name})"), self.generator(f"sin({name})")

    def jet(self, name: str, orders: tuple):
        require(len(orders) == len(self.scope["jets"][name]), f"{name} has another number of variables")
        return self.generator(f"{name}[{','.join(map(str, orders))}]")

    def polynomial(self, terms: dict):
        """A polynomial of the certificate, in the certificate's generators."""
        total = 0
        for key, amount in terms.items():
            term = self.constant(amount)
            for index, exponent in key:
                term = mul(term, power(self.generator(self.scope["generators"][index]), exponent, self.constant(1)))
            total = add(total, term)
        return total

    def root(self, radicand):
        name, divisor = self.scope["roots"][canonical(radicand)]
        return mul(self.generator(name), inverse(self.polynomial(divisor)))

    def arc(self, tree):
        return self.generator(self.scope["arcs"][canonical(tree)])


class Free(Point):
    """A random point modulo a prime at which cosines, sines and roots are independent."""

    def __init__(self, scope: dict, rng: random.Random):
        super().__init__(scope)
        self.rng, self.prime = rng, random_prime(rng)

    def constant(self, number: int):
        return Residue(number, self.prime)

    def drawn(self, name: str):
        return Residue(self.rng.randrange(1, self.prime), self.prime)


class Variety(Free):
    """A random point modulo a prime on which every relation holds."""

    def __init__(self, scope: dict, rng: random.Random):
        super().__init__(scope, rng)
        for name in scope["signs"]:
            self.known[name] = self.constant(rng.choice((1, -1)))
        for name in scope["angles"].values():
            t = self.drawn(name)
            below = inverse(self.constant(1) + t * t)
            self.known[f"cos({name})"] = (self.constant(1) + -(t * t)) * below
            self.known[f"sin({name})"] = self.constant(2) * t * below

    def root(self, radicand):
        name, divisor = self.scope["roots"][canonical(radicand)]
        if name not in self.known:
            square = parts(evaluate(radicand, self))[0]
            square = square.value if type(square) is Residue else 0
            value = pow(square, (self.prime + 1) // 4, self.prime)
            if value**2 % self.prime != square:
                raise NoRoot
            self.known[name] = Residue(value, self.prime) * self.polynomial(divisor)
        return super().root(radicand)


class NoRoot(Exception):
    """The radicand is no square modulo the prime at this point; take another."""


class Sizes(Point):
    """Bounds instead of values."""

    def constant(self, number: int):
        require(abs(number) <= LARGEST_INTEGER, "an integer is out of range")
        return Size(0, 0, abs(number).bit_length())

    def drawn(self, name: str):
        return Size(1, 0, 0)

    def polynomial(self, terms: dict):
        return Size(degree_of(terms), 0, sum(map(abs, terms.values())).bit_length())


class Expanded(Point):
    """Polynomials in the names of the generators."""

    def __init__(self, scope: dict, budget: int):
        super().__init__(scope)
        self.work = [budget]

    def constant(self, number: int):
        return Quotient({(): number} if number else {}, {}, self.work)

    def drawn(self, name: str):
        return Quotient({((name, 1),): 1}, {}, self.work)

    def named(self, terms: dict) -> dict:
        """A polynomial of the certificate, its generators by name."""
        generators = self.scope["generators"]
        return {tuple(sorted((generators[i], e) for i, e in key)): amount for key, amount in terms.items()}

    def polynomial(self, terms: dict):
        return Quotient(self.named(terms), {}, self.work)


class Exact(Point):
    """A real point with exactly rational cosines and sines; bare angles, pi, roots and arcs as enclosures."""

    def __init__(self, scope: dict, point: dict):
        super().__init__(scope)
        symbols = {name: Ball(fraction(text)) for name, text in point["symbols"].items()}
        self.tangents = {name: fraction(text) for name, text in point["half_tangents"].items()}
        require(set(self.tangents) <= set(scope["angles"].values()), "a point gives the angle of nothing")
        require(
            all(abs(symbols.get(name, Ball(1)).middle) == 1 for name in scope["signs"]), "a sign is neither +1 nor -1"
        )
        require(not set(symbols) & {*scope["angles"], *scope["definitions"], "pi"}, "a point gives one value twice")
        self.pi = Ball(4) * arctangent(Ball(1))
        self.known = symbols | {"pi": self.pi}
        for symbol, name in scope["angles"].items():
            if symbol not in scope["definitions"]:
                self.known[symbol] = Ball(2 * divisor_of(name)) * arctangent(Ball(self.tangents[name]))

    def constant(self, number: int):
        return Ball(number)

    def drawn(self, name: str):
        raise Rejected(f"the point gives no value for {name}")

    def circle(self, name: str):
        symbol = name.partition("/")[0]
        if symbol in self.scope["definitions"]:
            angle = evaluate(symbol, self)
            return cosine_and_sine(mul(angle, inverse(self.constant(divisor_of(name)))) or Ball(0), self.pi)
        t = self.tangents[name]
        return Ball((1 - t * t) / (1 + t * t)), Ball(2 * t / (1 + t * t))

    def root(self, radicand):
        return (evaluate(radicand, self) or Ball(0)).root()

    def arc(self, tree):
        y, x = (evaluate(part, self) for part in tree[1:])
        require(type(x) is Ball and x.middle > x.radius, "an arc leaves the right half plane")
        return arctangent(mul(y, x.inverse())) if type(y) is Ball else 0


class Moving:
    """The same point while some symbols move: every value is dual."""

    def __init__(self, rest, rates: dict):
        self.rest, self.rates, self.scope, self.memo = rest, rates, rest.scope, {}

    def constant(self, number: int):
        return self.rest.constant(number)

    def generator(self, name: str):
        return Dual(self.rest.generator(name), self.rates.get(name, 0))

    def circle(self, name: str):
        symbol = name.partition("/")[0]
        cosine, sine = self.rest.circle(name)
        turning = (
            parts(evaluate(symbol, self))[1] if symbol in self.scope["definitions"] else self.rates.get(symbol, 0)
        )
        if divisor_of(name) > 1:
            turning = mul(turning, inverse(self.constant(divisor_of(name))))
        return Dual(cosine, neg(mul(sine, turning))), Dual(sine, mul(cosine, turning))

    def jet(self, name: str, orders: tuple):
        rate = 0
        for position, variable in enumerate(self.scope["jets"][name]):
            raised = tuple(order + (k == position) for k, order in enumerate(orders))
            if variable in self.rates:
                rate = add(rate, mul(self.rates[variable], self.rest.jet(name, raised)))
        return Dual(self.rest.jet(name, orders), rate)

    def root(self, radicand):
        value = self.rest.root(radicand)
        _, rate = parts(evaluate(radicand, self))
        return Dual(value, mul(rate, inverse(add(value, value))))

    def arc(self, tree):
        (y, dy), (x, dx) = (parts(evaluate(part, self)) for part in tree[1:])
        turning = add(mul(x, dy), neg(mul(y, dx)))
        return Dual(self.rest.arc(tree), mul(turning, inverse(add(mul(x, x), mul(y, y)))))


def divisor_of(name: str) -> int:
    return int(name.partition("/")[2] or 1)


def fraction(text: str) -> Fraction:
    require(type(text) is str and re.fullmatch(r"-?\d{1,400}(/\d{1,400})?", text), "a number is no fraction")
    return Fraction(text)


# ---- trees -----------------------------------------------------------------------------------------------------------


def evaluate(tree, env):
    """The value of a tree: a number, a list of three, or a list of three rows."""
    if type(tree) is int:
        return env.constant(tree)
    require(type(tree) in (str, list), "a tree holds something that is neither a name nor a node")
    key = tree if type(tree) is str else id(tree)
    if key not in env.memo:
        env.memo[key] = _symbol(tree, env) if type(tree) is str else _node(tree, env)
    return env.memo[key]


def _symbol(name: str, env):
    require(NAME.fullmatch(name) and not RESERVED.fullmatch(name), f"{name!r} is no name of a symbol")
    definitions = env.scope["definitions"]
    return evaluate(definitions[name], env) if name in definitions else env.generator(name)


def _node(tree: list, env):
    operation, *arguments = tree
    if operation in ("cos", "sin", "tan", "Rx", "Ry", "Rz"):
        (angle,) = arguments
        cosine, sine = turn(angle, env)
        if operation in ("Rx", "Ry", "Rz"):
            return rotation("xyz".index(operation[1]), cosine, sine, env.constant(1))
        return {"cos": lambda: cosine, "sin": lambda: sine, "tan": lambda: mul(sine, inverse(cosine))}[operation]()
    if operation == "jet":
        require(all(type(order) is int and 0 <= order <= LARGEST_EXPONENT for order in arguments[1:]), "not a jet")
        return env.jet(arguments[0], tuple(arguments[1:]))
    if operation == "sqrt":
        (radicand,) = arguments
        return env.root(radicand)
    if operation == "atan2":
        require(len(arguments) == 2, "an arc has two sides")
        return env.arc(tree)
    if operation == "d":
        rates = {symbol: evaluate(rate, env) for symbol, rate in arguments[1:]}
        require(len(rates) == len(arguments) - 1 > 0, "a derivative moves each of its symbols once")
        require(not set(rates) & {*env.scope["definitions"], "pi"}, "a derivative is taken along a defined name")
        require(all(NAME.fullmatch(symbol) for symbol in rates), "a derivative is taken along a symbol")
        return each(lambda number: parts(number)[1], evaluate(arguments[0], Moving(env, rates)))
    if operation == "mat":
        return [[evaluate(entry, env) for entry in row] for row in arguments]
    if operation == "^":
        base, exponent = arguments
        require(type(exponent) is int, "an exponent is an integer")
        return power(evaluate(base, env), exponent, env.constant(1))
    if operation in ("at", "entry"):
        value = evaluate(arguments[0], env)
        for place in arguments[1:]:
            require(type(place) is int and 0 <= place < 3 and type(value) is list, "no such component")
            value = value[place]
        return value
    require(operation in OPERATIONS, f"{operation!r} is not in the grammar")
    values = [evaluate(argument, env) for argument in arguments]
    return OPERATIONS[operation](*values)


def each(function, value):
    return [each(function, part) for part in value] if type(value) is list else function(value)


def sum_of(first, *rest):
    for value in rest:
        first = [sum_of(a, b) for a, b in zip(first, value, strict=True)] if type(first) is list else add(first, value)
    return first


def product_of(first, *rest):
    for value in rest:
        scalar, other = (value, first) if type(first) is list else (first, value)
        first = each(lambda number, scalar=scalar: mul(scalar, number), other)
    return first


def quotient_of(above, below):
    scale = inverse(below)
    return each(lambda number: mul(number, scale), above)


def dot(u, v):
    return sum_of(*(mul(a, b) for a, b in zip(u, v, strict=True)))


def cross(u, v):
    return [add(mul(u[i - 2], v[i - 1]), neg(mul(u[i - 1], v[i - 2]))) for i in range(3)]


def apply(matrix, other):
    if type(other[0]) is not list:
        return [dot(row, other) for row in matrix]
    return [[dot(row, column) for column in zip(*other, strict=True)] for row in matrix]


OPERATIONS = {
    "+": sum_of,
    "*": product_of,
    "/": quotient_of,
    "-": lambda value: each(neg, value),
    "vec": lambda x, y, z: [x, y, z],
    "dot": dot,
    "cross": cross,
    "triple": lambda u, v, w: dot(cross(u, v), w),
    "@": apply,
    "T": lambda matrix: [list(column) for column in zip(*matrix, strict=True)],
}


def rotation(axis: int, cosine, sine, one):
    rows = [[one if i == j else 0 for j in range(3)] for i in range(3)]
    first, second = (axis + 1) % 3, (axis + 2) % 3
    rows[first][first], rows[first][second], rows[second][first], rows[second][second] = cosine, neg(sine), sine, cosine
    return rows


def turn(tree, env):
    """Cosine and sine of a rational combination of angles, by complex multiplication."""
    form = linear(tree, env.scope)
    cosine, sine = env.constant(1), 0
    for symbol in sorted(set(form) - {"pi"}):
        name = env.scope["angles"][symbol]
        times = form[symbol] * divisor_of(name)
        require(times.denominator == 1, f"no base angle divides {symbol}")
        require(abs(times) <= LARGEST_EXPONENT, f"a multiple of {symbol} is out of range")
        c, s = env.circle(name)
        s = s if times > 0 else neg(s)
        for _ in range(abs(int(times))):
            cosine, sine = add(mul(cosine, c), neg(mul(sine, s))), add(mul(sine, c), mul(cosine, s))
    quarters = 2 * form.get("pi", Fraction(0))
    require(quarters.denominator == 1, "an angle has a fraction of a right angle")
    for _ in range(int(quarters) % 4):
        cosine, sine = neg(sine), cosine
    return cosine, sine


def linear(tree, scope: dict) -> dict:
    """Base angle or "pi" -> rational factor. A defined name that is listed as a base angle stands for itself."""
    if type(tree) is str:
        opaque = tree in scope["angles"] or tree not in scope["definitions"]
        return {tree: Fraction(1)} if opaque else linear(scope["definitions"][tree], scope)
    if tree == 0:
        return {}
    require(type(tree) is list, "not an angle")
    if tree[0] == "+":
        total = {}
        for term in tree[1:]:
            for symbol, factor in linear(term, scope).items():
                total[symbol] = total.get(symbol, Fraction(0)) + factor
        return {symbol: factor for symbol, factor in total.items() if factor}
    scale = {
        "-": lambda: (Fraction(-1), tree[1]),
        "/": lambda: (Fraction(1, whole(tree[2])), tree[1]),
        "*": lambda: (Fraction(whole(tree[1])), tree[2]),
    }
    require(tree[0] in scale and len(tree) <= 3, "not an angle")
    factor, rest = scale[tree[0]]()
    return {symbol: factor * value for symbol, value in linear(rest, scope).items()}



def whole(tree) -> int:
    require(type(tree) is int, "not an angle")
    return tree


# ---- texts: the notation in which readings are written, read anew ----------------------------------------------------

ARITY = {
    **dict.fromkeys(("cos", "sin", "tan", "sqrt", "Rx", "Ry", "Rz", "T"), 1),
    **dict.fromkeys(("dot", "cross", "atan2"), 2),
    **dict.fromkeys(("triple", "vec"), 3),
}
FORMULA_ARITY = ARITY | dict.fromkeys(("asin", "acos", "atan", "degrees", "radians"), 1)


def read_equation(text: str, jets: dict) -> list:
    """Both sides of `left = right` as trees."""
    left, right = re.sub(r"(\w)('+)", lambda m: f"{m[1]}[{len(m[2])}]", text).split(" = ")
    return [read_text(left, jets, ARITY), read_text(right, jets, ARITY)]


def read_formula(text: str) -> object:
    """A formula with numbers put in; decimals become quotients."""
    exact = re.sub(r"(\d+)\.(\d+)", lambda m: f"({int(m[1] + m[2])}/{10 ** len(m[2])})", text)
    return read_text(exact, {}, FORMULA_ARITY)


def read_text(text: str, jets: dict, arity: dict) -> object:
    try:
        return translated(ast.parse(" ".join(text.split()), mode="eval").body, jets, arity)
    except SyntaxError as error:
        raise Rejected(f"a reading is no formula: {text!r}") from error


def translated(node, jets: dict, arity: dict) -> object:
    """Python's syntax tree as a tree of the record."""
    again = lambda part: translated(part, jets, arity)  # noqa: E731
    match node:
        case ast.Constant(value=int(value)):
            return value
        case ast.Name(id=name):
            return ["jet", name, *(0 for _ in jets[name])] if name in jets else name
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return ["-", again(operand)]
        case ast.BinOp(left=left, op=operator, right=right):
            return joined_by(operator, again(left), again(right))
        case ast.Subscript(value=ast.Name(id=name), slice=place):
            orders = ast.literal_eval(place)
            return ["jet", name, *(orders if type(orders) is tuple else (orders,))]
        case ast.Attribute(value=value, attr=("x" | "y" | "z") as axis):
            return ["at", again(value), "xyz".index(axis)]
        case ast.Call(func=ast.Name(id="d"), args=[expression, *directions]):
            moved = [[n.elts[0].id, again(n.elts[1])] if isinstance(n, ast.Tuple) else [n.id, 1] for n in directions]
            return ["d", again(expression), *moved]
        case ast.Call(func=ast.Name(id="mat"), args=rows):
            return ["mat", *([again(entry) for entry in row.elts] for row in rows)]
        case ast.Call(func=ast.Name(id="entry"), args=[matrix, row, column]):
            return ["entry", again(matrix), row.value - 1, column.value - 1]
        case ast.Call(func=ast.Name(id=name), args=arguments) if arity.get(name) == len(arguments):
            return [name, *map(again, arguments)]
    raise Rejected(f"a reading holds {type(node).__name__}, which is not part of the notation")


def joined_by(operator, left, right):
    if isinstance(operator, ast.Add | ast.Sub):
        right = right if isinstance(operator, ast.Add) else ["-", right]
        return ["+", *(left[1:] if left_is(left, "+") else [left]), right]
    if isinstance(operator, ast.Mult | ast.Div):
        if left_is(left, "-"):  # -a b is printed and meant as -(a b)
            return ["-", joined_by(operator, left[1], right)]
        if isinstance(operator, ast.Div):
            return ["/", left, right]
        return ["*", *(left[1:] if left_is(left, "*") else [left]), right]
    if isinstance(operator, ast.MatMult):
        return ["@", left, right]
    exponent = -right[1] if left_is(right, "-") else right
    require(isinstance(operator, ast.Pow) and type(exponent) is int, "a reading holds an operator out of the notation")
    return ["^", left, exponent]


def left_is(tree, operation: str) -> bool:
    return type(tree) is list and tree[0] == operation


# ---- polynomials: text `2*0^2*4+-1*1`, coefficient * generator^power -------------------------------------------------


def read_polynomial(text: str) -> dict:
    """Powers ((generator, power), ...) -> coefficient."""
    terms = {}
    for term in text.split("+") if text else ():
        require(re.fullmatch(r"-?\d+(\*\d+(\^\d+)?)*", term), "a polynomial is not in canonical order")
        factor, *powers = term.split("*")
        key = tuple((int(index), int(exponent or 1)) for index, _, exponent in (item.partition("^") for item in powers))
        require(key not in terms and int(factor), "a polynomial repeats a term or has a zero term")
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


# ---- certificates ----------------------------------------------------------------------------------------------------


def canonical(value: object) -> str:
    return json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False)


def sha256_of(body: dict) -> str:
    return hashlib.sha256(
        canonical({key: value for key, value in body.items() if key != "sha256"}).encode()
    ).hexdigest()


def scope_of(certificate: dict, equation: dict, definitions: dict) -> dict:
    """What an evaluation needs, after checking that angles, roots, signs and definitions are named once and apart."""
    for entry in certificate["angles"]:
        require(type(entry["divisor"]) is int and 1 <= entry["divisor"] <= LARGEST_EXPONENT, "an angle has no divisor")
    angles = {
        entry["symbol"]: entry["symbol"] + (f"/{entry['divisor']}" if entry["divisor"] > 1 else "")
        for entry in certificate["angles"]
    }
    require(len(angles) == len(certificate["angles"]), "one angle has two names")
    named = [root for root in certificate["roots"] if "generator" in root]
    roots = {canonical(root["radicand"]): (root["generator"], read_polynomial(root["divisor"])) for root in named}
    require(len(roots) == len(named), "one root has two names")
    arcs = {canonical(arc["tree"]): arc["generator"] for arc in certificate["arcs"]}
    require(len(arcs) == len(set(arcs.values())) == len(certificate["arcs"]), "arcs and their names do not match")
    for names, stem in (({name for name, _ in roots.values()}, "sqrt"), (arcs.values(), "arc")):
        for name in names:
            require(re.fullmatch(rf"{stem}\d+", name), f"{name!r} cannot be the name of a {stem}")
    jets = equation["jets"]
    plain = [*(set(angles) - set(definitions)), *equation["signs"], *definitions, *jets]
    require(len(plain) == len(set(plain)) and "pi" not in plain, "one name means two things")
    require(all(NAME.fullmatch(name) and not RESERVED.fullmatch(name) for name in plain), "a name is no name")
    return {
        "angles": angles,
        "roots": roots,
        "arcs": arcs,
        "signs": equation["signs"],
        "jets": jets,
        "definitions": definitions,
        "generators": certificate.get("generators", []),
    }


def relations_of(certificate: dict, scope: dict) -> list:
    """The relations, as (generator index, square), each of an allowed shape and each once."""
    index = {name: position for position, name in enumerate(certificate["generators"])}
    require(len(index) == len(certificate["generators"]), "one generator is listed twice")
    relations = []
    for relation in certificate["relations"]:
        name, square = relation["generator"], read_polynomial(relation["square"])
        require(
            name in index and index[name] not in [known for known, _ in relations],
            f"relation for {name} is invented or repeated",
        )
        if relation["kind"] == "circle":
            angle = name[4:-1]
            require(
                name == f"sin({angle})" and angle in scope["angles"].values(),
                f"{name} is not the sine of a listed angle",
            )
            require(square == {(): 1, ((index[f"cos({angle})"], 2),): -1}, f"the relation of {name} is not the circle")
        elif relation["kind"] == "sign":
            require(name in scope["signs"] and square == {(): 1}, f"{name} is not a sign")
        else:
            require(
                relation["kind"] == "root" and name in [known for known, _ in scope["roots"].values()],
                f"relation {relation['kind']} for {name} is invented",
            )
        relations.append((index[name], square))
    return relations


def check_proof(certificate: dict, equation: dict, definitions: dict) -> dict:
    """An identity: the integers, the trees, and one point where nothing vanishes.

    How it was decided: {"expanded": 0 or 1, "degree": bound, "bits": bound}.
    """
    scope = scope_of(certificate, equation, definitions)
    relations = relations_of(certificate, scope)
    require(certificate["components"], "the certificate has no component")
    components = []
    for component in certificate["components"]:
        numerator = read_polynomial(component["numerator"])
        total: dict = {}
        require(len(component["cofactors"]) == len(relations), "cofactors and relations do not match")
        for text, (generator, square) in zip(component["cofactors"], relations, strict=True):
            for key, amount in times_relation(read_polynomial(text), generator, square).items():
                accumulate(total, key, amount)
        require(total == numerator, "numerator is not the sum of cofactor times relation")
        denominators = [(read_polynomial(text), times) for text, times in component["denominators"]]
        require(all(factor for factor, _ in denominators), "a denominator is zero")
        require(all(type(n) is int and 0 < n <= LARGEST_EXPONENT for _, n in denominators), "no power of a denominator")
        components.append((numerator, denominators))
    bound = size_of(scope, equation, certificate, components)
    expanded = agrees_expanded(scope, certificate, equation, components, relations)
    rng = random.SystemRandom()
    for _ in range(0 if expanded else POINTS):
        check_point(Free(scope, rng), certificate, equation, components, relations)
    check_variety(scope, rng, equation)
    check_instance(certificate, equation, scope)
    degree = max(degree_of(above) + sum(degree_of(f) * n for f, n in below) for above, below in components)
    require(degree == certificate["degree"], "the recorded degree is not that of the certificate")
    return {"expanded": int(expanded), "degree": bound.above + bound.below, "bits": bound.bits}


def size_of(scope: dict, equation: dict, certificate: dict, components: list) -> Size:
    """Bounds on (lhs - rhs) * denominators - numerator, over all components and root relations."""
    env = Sizes(scope)
    left, right = (flat(evaluate(equation[side], env)) for side in ("lhs", "rhs"))
    require(len(left) == len(right) == len(components), "the sides and the certificate have different shapes")
    worst = Size(0, 0, 0)
    for a, b, (numerator, denominators) in zip(left, right, components, strict=True):
        total = add(a, b) or Size(0, 0, 0)
        for factor, times in denominators:
            for _ in range(times):
                total = total * env.polynomial(factor)
        total = total + env.polynomial(numerator)
        worst = Size(max(worst.above, total.above), max(worst.below, total.below), max(worst.bits, total.bits))
    for root in certificate["roots"]:
        square = evaluate(root["radicand"], env) or Size(0, 0, 0)
        worst = worst + square * Size(2 * degree_of(read_polynomial(root["divisor"])), 0, 64)
    return worst


def agrees_expanded(scope: dict, certificate: dict, equation: dict, components: list, relations: list) -> bool:
    """Are the trees the recorded quotients, and the roots those of their radicands, in exact integers?

    False if that takes more than the budget.
    """
    env = Expanded(scope, EXPANSION)
    try:
        check_roots(env, certificate, relations)
        left, right = (flat(evaluate(equation[side], env)) for side in ("lhs", "rhs"))
        for a, b, (numerator, denominators) in zip(left, right, components, strict=True):
            difference = add(a, neg(b))
            if type(difference) is int:
                require(not numerator, "the trees differ from numerator / denominators")
                continue
            below: dict = {}
            for factor, times in denominators:
                key = tuple(sorted(env.named(factor).items()))
                below[key] = below.get(key, 0) + times
            recorded = Quotient(env.named(numerator), below, env.work)
            require((difference + -recorded).vanishes(), "the trees differ from numerator / denominators")
    except TooLarge:
        return False
    return True


def check_roots(env: Point, certificate: dict, relations: list) -> None:
    """root^2 = radicand * divisor^2, and roots of one name have one radicand and one divisor."""
    squares = {
        certificate["generators"][generator]: env.polynomial(square)
        for relation, (generator, square) in zip(certificate["relations"], relations, strict=True)
        if relation["kind"] == "root"
    }
    divisors: dict = {}
    for root in certificate["roots"]:
        name, divisor = root["generator"], env.polynomial(read_polynomial(root["divisor"]))
        require(type(divisor) is not int, "a root is divided by zero")
        square = mul(evaluate(root["radicand"], env), mul(divisor, divisor))
        require(same(square, squares.setdefault(name, square)), "a root is not of its radicand")
        require(same(divisor, divisors.setdefault(name, divisor)), "roots of one name have two divisors")


def check_point(env: Free, certificate: dict, equation: dict, components: list, relations: list) -> None:
    check_roots(env, certificate, relations)
    left, right = (flat(evaluate(equation[side], env)) for side in ("lhs", "rhs"))
    for a, b, (numerator, denominators) in zip(left, right, components, strict=True):
        below = env.constant(1)
        for factor, times in denominators:
            below = mul(below, power(env.polynomial(factor), times, env.constant(1)))
        require(not below.vanishes(), "a denominator is zero")
        require(
            same(mul(add(a, neg(b)), below), env.polynomial(numerator)),
            "the trees differ from numerator / denominators",
        )


def check_variety(scope: dict, rng: random.Random, equation: dict) -> None:
    """Both sides exist and agree at a random point on which every relation holds."""
    for _ in range(200):
        point = Variety(scope, rng)
        try:
            left, right = (flat(evaluate(equation[side], point)) for side in ("lhs", "rhs"))
        except NoRoot:
            continue
        require(all(same(a, b) for a, b in zip(left, right, strict=True)), "the sides differ on the variety")
        return
    raise Rejected("no point of the variety was found: the statement may be vacuous")


def flat(value) -> list:
    return [number for part in value for number in flat(part)] if type(value) is list else [value]


def check_instance(certificate: dict, equation: dict, scope: dict) -> tuple:
    """Both sides at the recorded real point, which must exist; the recorded numbers are those of the sides."""
    env = Exact(scope, certificate["point"])
    left, right = ([number or Ball(0) for number in flat(evaluate(equation[s], env))] for s in ("lhs", "rhs"))
    for number, text in zip(left + right, certificate["lhs"] + certificate["rhs"], strict=True):
        room = abs(number.middle) * Fraction(1, 10**9) + (number.radius and ROUNDED)
        require(
            abs(number.middle - Fraction(text)) <= room,
            "the recorded numbers are not those of the sides",
        )
    if certificate["kind"] == "ring_nf":
        require(all(same(a, b) for a, b in zip(left, right, strict=True)), "the sides differ at the recorded point")
    return left, right


def check_refutation(certificate: dict, equation: dict, definitions: dict) -> None:
    """The sides differ at the recorded point by more than the enclosures of both."""
    left, right = check_instance(certificate, equation, scope_of(certificate, equation, definitions))
    require(certificate["differs"], "the counterexample names no component that differs")
    require(certificate["differs"] == sorted(set(certificate["differs"])), "the counterexample repeats a component")
    for position in certificate["differs"]:
        require(type(position) is int and 0 <= position < len(left), "the counterexample names no component")
        require(not same(left[position], right[position]), "the sides agree at the counterexample")


def check_number(certificate: dict, equation: dict, definitions: dict) -> None:
    """A printed number against its formula: within half a unit of its last printed digit, or not, as recorded."""
    require(not definitions, "a formula of numbers has definitions")
    value, printed = number_of(equation["lhs"]), equation["rhs"]
    require(
        abs(value.middle - Fraction(certificate["value"])) <= abs(value.middle) * Fraction(1, 10**8) + value.radius,
        "the recorded value is not that of the formula",
    )
    require(
        holds(value, printed) == (certificate["outcome"] == "proved"),
        "a printed number is not judged by half a unit of its last digit",
    )


def holds(value: Ball, printed: str) -> bool:
    """Is a number printed as it should be? Only its sign, for ">0" and "<0"."""
    if printed in (">0", "<0"):
        require(not value.vanishes(), "a sign cannot be decided")
        return (value.middle > 0) == (printed == ">0")
    require(PRINTED.fullmatch(printed), "a printed number is not a decimal")
    half_unit = Fraction(1, 2 * 10 ** len(printed.partition(".")[2]))
    room = half_unit - abs(value.middle - Fraction(printed))
    require(abs(room) >= value.radius, "a printed number lies on the edge of half a unit")
    return room >= 0


def number_of(tree) -> Ball:
    """A formula with numbers put in, enclosed."""
    if type(tree) is int:
        require(abs(tree) <= LARGEST_INTEGER, "an integer is out of range")
        return Ball(tree)
    if tree == "pi":
        return Ball(4) * arctangent(Ball(1))
    operation, *arguments = tree
    if operation == "^":
        require(type(arguments[1]) is int, "an exponent is an integer")
        return power(number_of(arguments[0]), arguments[1], Ball(1))
    require(operation in NUMERIC, f"{operation!r} is not a function of numbers")
    return NUMERIC[operation](*map(number_of, arguments))


def arc_sine(x: Ball) -> Ball:
    if not x.radius and abs(x.middle) == 1:
        return Ball(x.middle / 2) * number_of("pi")
    return arctangent(x * (Ball(1) + -(x * x)).root().inverse())


def circular(function):
    return lambda angle: function(*cosine_and_sine(angle, number_of("pi")))


NUMERIC = {
    "-": lambda a: -a,
    "/": lambda a, b: a * b.inverse(),
    "+": lambda first, *rest: sum_of(first, *rest),
    "*": lambda first, *rest: product_of(first, *rest),
    "sqrt": lambda a: a.root(),
    "cos": circular(lambda cosine, sine: cosine),
    "sin": circular(lambda cosine, sine: sine),
    "tan": circular(lambda cosine, sine: sine * cosine.inverse()),
    "asin": arc_sine,
    "acos": lambda x: number_of("pi") * Ball(Fraction(1, 2)) + -arc_sine(x),
    "atan": lambda x: arctangent(x),
    "degrees": lambda x: x * Ball(180) * number_of("pi").inverse(),
    "radians": lambda x: x * number_of("pi") * Ball(Fraction(1, 180)),
}

CHECKS = {
    "ring_nf": check_proof,
    "exact_point": check_refutation,
    "numeric": check_number,
    "undecided": lambda *_: None,
}
OUTCOME_OF_KIND = {"ring_nf": "proved", "exact_point": "refuted", "undecided": "undecided"}


# ---- the record ------------------------------------------------------------------------------------------------------

_POINT = {"angles", "arcs", "point", "lhs", "rhs", "rounded"}
KEYS = {
    "source": {"id", "document", "document_sha256", "locator", "verbatim", "ocr_doubt", "reading", "figures"}
    | {"offset"},
    "step": {"id", "op", "tree", "inputs"},
    "equation": {"id", "kind", "lhs", "rhs", "where", "jets", "signs", "side_conditions", "unit", "sources"},
    "verdict": {"id", "source", "status", "plain", "readings", "corrected", "contradiction", "change", "missing"}
    | {"damage", "drops"},
    "ring_nf": {"kind", "outcome", "equation", "generators", "roots", "relations", "components", "degree"} | _POINT,
    "exact_point": {"kind", "outcome", "equation", "roots", "differs"} | _POINT,
    "undecided": {"kind", "outcome", "equation", "angles", "arcs"},
    "numeric": {"kind", "outcome", "equation", "value"},
}
#: Keys of any object whose value is text.
TEXTS = {
    "id", "kind", "document", "document_sha256", "locator", "verbatim", "ocr_doubt", "op", "unit", "source", "status",
    "plain", "missing", "damage", "drops", "outcome", "change",
}  # fmt: skip
EQUATIONS = ("printed", "derived", "corrected")
OPERATIONS_OF_STEPS = {"d": "diff", "cross": "cross", "dot": "dot", "triple": "dot", "@": "matmul"}


def read_json(text: str):
    """JSON without repeated keys, floating-point numbers or NaN."""

    def once(pairs: list) -> dict:
        require(len(pairs) == len({key for key, _ in pairs}), "a key stands twice")
        return dict(pairs)

    def never(token: str):
        raise Rejected(f"{token} is not a number of the record")

    return json.loads(text, object_pairs_hook=once, parse_float=never, parse_constant=never)


def read_file(path: Path) -> str:
    try:
        return path.read_bytes().decode("utf-8")
    except (OSError, ValueError) as error:
        raise Rejected(f"{path.name} cannot be read: {error}") from error


def read_lines(path: Path) -> list[dict]:
    text = read_file(path)
    require(text.endswith("\n") and "\r" not in text, f"{path.name} does not end its lines as it should")
    items = []
    for number, line in enumerate(text[:-1].split("\n"), 1):
        try:
            item = read_json(line)
        except (Rejected, ValueError, RecursionError) as error:
            raise Rejected(f"{path.name} line {number}: {error}") from error
        require(type(item) is dict and canonical(item) == line, f"{path.name} line {number}: not canonical")
        items.append(item)
    return items


def read_record(folder: Path) -> dict[str, dict]:
    """Every object by its hash, after recomputing it."""
    objects: dict[str, dict] = {}
    for name in ("ledger.jsonl", "certificates.jsonl"):
        for number, item in enumerate(read_lines(folder / name), 1):
            kind = item.get("object")
            require((kind == "certificate") == (name == "certificates.jsonl"), f"{name} line {number}: a {kind} here")
            shape = KEYS.get(item.get("kind") if kind == "certificate" else kind)
            require(shape is not None, f"{name} line {number}: unknown object {kind!r}")
            require(set(item) == shape | {"object", "sha256"}, f"{name} line {number}: not the keys of a {kind}")
            require(all(type(item[key]) is str for key in TEXTS & set(item)), f"{name} line {number}: a text is none")
            require(FORMS.get(kind, bool)(item), f"{name} line {number}: not the form of a {kind}")
            require(item["sha256"] == sha256_of(item), f"{name} line {number}: the hash is not that of the line")
            require(item["sha256"] not in objects, f"{name} line {number}: repeated")
            objects[item["sha256"]] = item
    return objects


def formed_equation(equation: dict) -> bool:
    """Whether what an equation says of itself beside its two sides has the form that it must have."""
    jets, conditions = equation["jets"], equation["side_conditions"]
    return (
        equation["kind"] in EQUATIONS
        and type(jets) is dict
        and all(names and distinct_texts(names) for names in jets.values())
        and distinct_texts(conditions)
        and distinct_texts(equation["signs"])
        and all(name.isidentifier() for name in equation["signs"])
    )


def formed_verdict(verdict: dict) -> bool:
    """Whether its readings are lists of texts, each part with an equation and its certificate."""
    readings = [verdict[role] for role in ("readings", "corrected", "contradiction")]
    return all(
        type(reading) is dict
        and set(reading) == {"label", "parts", "texts"}
        and type(reading["label"]) is str
        and type(reading["texts"]) is list
        and type(reading["parts"]) is list
        and all(type(part) is dict and set(part) == {"certificate", "equation"} for part in reading["parts"])
        and all(type(part[key]) is str for part in reading["parts"] for key in part)
        for reading in [each for role in readings if type(role) is list for each in role]
    ) and all(type(role) is list for role in readings)


def formed_certificate(certificate: dict) -> bool:
    texts = (certificate["equation"], certificate.get("value", ""))
    return (
        all(type(text) is str for text in texts)
        and type(certificate.get("rounded", False)) is bool
        and certificate["outcome"] in ("proved", "refuted", "undecided")
    )


def formed_source(source: dict) -> bool:
    """Whether a text is said to stand at a place of its document, or nowhere: then it is a transliteration."""
    at = source["offset"]
    return at is None or (type(at) is int and at >= 0 and source["verbatim"] != "")


FORMS = {
    "source": formed_source,
    "equation": formed_equation,
    "verdict": formed_verdict,
    "certificate": formed_certificate,
}


def distinct_texts(items: list) -> bool:
    return type(items) is list and all(type(item) is str for item in items) and len(items) == len(set(items))


def root_of(objects: dict[str, dict]) -> str:
    """One hash over all objects."""
    return hashlib.sha256("\n".join(sorted(objects)).encode()).hexdigest()


def linked(objects: dict[str, dict], key: str, kind: str) -> dict:
    require(key in objects and objects[key]["object"] == kind, f"a link to a {kind} leads nowhere")
    return objects[key]


def definitions_of(equation: dict, objects: dict[str, dict]) -> dict:
    """Name -> tree, each step under its own name."""
    found = {}
    for name, key in equation["where"].items():
        step = linked(objects, key, "step")
        require(step["id"].rpartition(".")[2] == name, f"{equation['id']}: {name} is another step's name")
        found[name] = step["tree"]
    return found


def check_certificate(certificate: dict, objects: dict[str, dict]) -> dict:
    equation = linked(objects, certificate["equation"], "equation")
    require(certificate["kind"] in CHECKS, f"unknown kind of certificate {certificate['kind']!r}")
    require(
        certificate["kind"] == "numeric" or OUTCOME_OF_KIND[certificate["kind"]] == certificate["outcome"],
        f"{equation['id']}: kind and outcome contradict",
    )
    try:
        return CHECKS[certificate["kind"]](certificate, equation, definitions_of(equation, objects)) or {}
    except (Rejected, ArithmeticError, LookupError, TypeError, ValueError, AttributeError, RecursionError) as error:
        raise Rejected(f"{equation['id']}: {error}") from error


def status_of(readings: list[str], corrected: list[str], contradiction: list[str], damaged: bool) -> str:
    """The status that outcomes imply. Several readings stand for several ways in which a text can be read."""
    if contradiction:
        return "undecided" if contradiction != ["proved"] else "ambiguous" if damaged else "false"
    if len(set(readings)) > 1:
        return "ambiguous"
    if readings[0] != "refuted":
        return readings[0]
    return "proved_with_correction" if corrected == ["proved"] else "false"


def outcome_of(reading: dict, verdict: dict, objects: dict[str, dict]) -> str:
    """A reading is proved if all its equations are, refuted if one is."""
    outcomes = set()
    for part in reading["parts"]:
        certificate = linked(objects, part["certificate"], "certificate")
        require(
            certificate["equation"] == part["equation"], f"{verdict['id']}: the certificate is for another equation"
        )
        outcomes.add(certificate["outcome"])
    require(outcomes, f"{verdict['id']}: nothing is judged")
    return next(outcome for outcome in ("refuted", "undecided", "proved") if outcome in outcomes)


def check_verdict(verdict: dict, objects: dict[str, dict]) -> None:
    """What is judged is what the source says, and the status follows from the certificates."""
    source = linked(objects, verdict["source"], "source")
    require(source["id"] == verdict["id"], f"{verdict['id']}: the verdict is on another source")
    require(verdict["damage"] == source["ocr_doubt"], f"{verdict['id']}: another damage than that of the source")
    printed = source["document_sha256"]
    require(source["locator"] and verdict["plain"], f"{verdict['id']}: words are missing")
    require(source["verbatim"] or not printed, f"{verdict['id']}: the print is missing")
    check_bindings(verdict, source, objects)
    roles = ("readings", "corrected", "contradiction")
    outcomes = [[outcome_of(reading, verdict, objects) for reading in verdict[role]] for role in roles]
    if outcomes[0] or outcomes[2]:
        require(
            verdict["status"] == status_of(*outcomes, bool(verdict["damage"])),
            f"{verdict['id']}: the status does not follow from the certificates",
        )
    else:
        judged_by_words = ("not_mathematical", "definition") + (("ambiguous",) if verdict["missing"] else ())
        require(verdict["status"] in judged_by_words, f"{verdict['id']}: nothing is judged")


def check_bindings(verdict: dict, source: dict, objects: dict[str, dict]) -> None:
    """Every equation belongs to this verdict and says what the source's reading, or the correction, says."""
    name = verdict["id"]
    said = dict(source["reading"])
    if source["figures"]:
        require(not said, f"{name}: both a reading and printed numbers")
        said = {"as printed": source["figures"]}
    readings = {reading["label"]: reading for reading in verdict["readings"]}
    require(
        sorted(said) == sorted(readings) and len(readings) == len(verdict["readings"]),
        f"{name}: the readings are not those of the source",
    )
    for label, reading in readings.items():
        require(reading["texts"] == said[label], f"{name}: {label!r} is not what the source reads")
    for role in ("corrected", "contradiction"):
        require(len(verdict[role]) <= 1, f"{name}: more than one {role}")
        require(all(reading["label"] == role for reading in verdict[role]), f"{name}: a {role} has another label")
    printed = [part["equation"] for reading in verdict["readings"] for part in reading["parts"]]
    for reading in (*verdict["readings"], *verdict["corrected"], *verdict["contradiction"]):
        texts = reading["texts"] or [None] * len(reading["parts"])
        require(len(texts) == len(reading["parts"]), f"{name}: an equation is missing or added")
        for number, (part, text) in enumerate(zip(reading["parts"], texts, strict=True), 1):
            equation = linked(objects, part["equation"], "equation")
            if part["equation"] in printed and reading["label"] == "corrected":
                continue  # a part that is right as printed
            require(equation["id"] == f"{name}/{reading['label']}/{number}", f"{name}: an equation of another verdict")
            require(equation["sources"] == [verdict["source"]], f"{name}: an equation of another source")
            try:
                check_content(equation, text, source, [objects[key] for key in printed])
            except (Rejected, ArithmeticError, LookupError, TypeError, ValueError, AttributeError) as error:
                raise Rejected(f"{name}: {error}") from error


def check_content(equation: dict, text, source: dict, printed: list[dict]) -> None:
    """The trees are those of the text; the statement is not its own left side."""
    sides = [equation["lhs"], equation["rhs"]]
    corrected = equation["kind"] == "corrected"
    if type(text) is list:
        require(sides == [read_formula(text[0]), text[1]], "a formula is not that of the source")
        print_ = re.sub("[\ufffd\u2212]", "-", source["verbatim"])  # glyphs that stand for minus
        stated = corrected or text[1] in (">0", "<0") or re.search(rf"(?<![\d.]){re.escape(text[1])}(?!\d)", print_)
        require(stated, f"the number {text[1]} does not stand in the print")
        return
    if text is None:
        require(corrected, "an equation has no text")
        require(
            any((sides[0] == p["lhs"]) != (sides[1] == p["rhs"]) for p in printed),
            "a correction changes more than one side of what is printed",
        )
    else:
        require(sides == read_equation(text, equation["jets"]), f"the equation is not {text!r}")
    require(sides[0] != sides[1], "both sides of the statement are the same expression")
    require(not corrected or sides not in [[p["lhs"], p["rhs"]] for p in printed], "nothing is corrected")


def check_step(step: dict, objects: dict[str, dict]) -> None:
    """A definition rests on the steps whose names it uses, and on no other; its operation is that of its tree."""
    used = {linked(objects, key, "step")["id"].rpartition(".")[2] for key in step["inputs"]}
    require(used <= names_in(step["tree"]), f"{step['id']}: an input is not used")
    require(step["inputs"] == sorted(set(step["inputs"])), f"{step['id']}: inputs are not in order")
    operation = step["tree"][0] if type(step["tree"]) is list else ""
    require(step["op"] == OPERATIONS_OF_STEPS.get(operation, "define"), f"{step['id']}: not the operation of its tree")


def names_in(tree) -> set:
    if type(tree) is list:
        return set().union(*map(names_in, tree))
    return {tree} if type(tree) is str else set()


def check_use(objects: dict[str, dict]) -> None:
    """One certificate an equation, and nothing in the record that no verdict rests on."""
    certificates = [item for item in objects.values() if item["object"] == "certificate"]
    require(len({item["equation"] for item in certificates}) == len(certificates), "an equation has two certificates")
    require(any(item["object"] == "verdict" for item in objects.values()), "the record holds no verdict")
    identifiers = [item["id"] for item in objects.values() if item["object"] in ("verdict", "equation", "source")]
    verdicts = [item["id"] for item in objects.values() if item["object"] == "verdict"]
    require(len(set(verdicts)) == len(verdicts), "two verdicts have one name")
    require(len(set(identifiers)) == len(identifiers) - len(verdicts), "two objects have one name")
    reached: set = set()
    pending = [item["sha256"] for item in objects.values() if item["object"] == "verdict"]
    while pending:
        key = pending.pop()
        if key not in reached:
            reached.add(key)
            pending += [link for link in names_in(listed(objects[key])) if link in objects]
    require(reached == set(objects), "the record holds an object that no verdict rests on")


def listed(value):
    """Lists for dictionaries."""
    if type(value) is dict:
        return [listed(part) for part in value.values()]
    return [listed(part) for part in value] if type(value) is list else value


def is_proved(verdict: dict, objects: dict[str, dict]) -> bool:
    """Proved, or ambiguous with a proved reading (damaged print)."""
    return verdict["status"] in ("proved", "proved_with_correction") or any(
        outcome_of(reading, verdict, objects) == "proved" for reading in verdict["readings"]
    )


def equations_named(text: str) -> list[str]:
    """The equation ids in the comment at the top of a generated header."""
    head = text.partition("*/")[0].partition("Equations (")[2]
    return [line.strip(" *") for line in head.splitlines()[1:] if line.strip(" *")]


def check_files(folder: Path, root: str, objects: dict[str, dict]) -> int:
    """The seal names every generated file and no other; each is unchanged and rests on proved statements."""
    seal_text = read_file(folder / "artifacts.json")
    try:
        seal = read_json(seal_text)
    except ValueError as error:
        raise Rejected(f"artifacts.json cannot be read: {error}") from error
    require(seal_text == json.dumps(seal, indent=1, sort_keys=True) + "\n", "artifacts.json is not canonical")
    require(set(seal) == {"root", "files"} and seal["root"] == root, "artifacts.json carries another root hash")
    proved = {item["id"] for item in objects.values() if item["object"] == "verdict" and is_proved(item, objects)}
    there = {
        path.relative_to(folder.parent).as_posix()
        for path in folder.parent.rglob("*")
        if path.is_file() and path.parent.name != "__pycache__"
    } - {f"{folder.name}/artifacts.json", "manifest.json"}
    for name in sorted(there ^ set(seal["files"])):
        raise Rejected(f"{name} is {'not sealed' if name in there else 'missing'}")
    for name, expected in seal["files"].items():
        data = (folder.parent / name).read_bytes()
        require(set(expected) == {"sha256", "equations"}, f"{name}: not the keys of a seal")
        require(hashlib.sha256(data).hexdigest() == expected["sha256"], f"{name} has been changed")
        named = equations_named(data.decode("utf-8")) if name.endswith(".h") else []
        require(named == expected["equations"], f"{name} names other equations than its seal")
        require(named or b"_setup(const double" not in data or not name.endswith(".h"), f"{name} names no equation")
        require(not named or root.encode() in data, f"{name} does not carry the root hash")
        for key in named:
            require(key in proved, f"{name} rests on {key}, which is not a proved statement of the record")
    check_manifest(folder, seal)
    return len(seal["files"])


def check_manifest(folder: Path, seal: dict) -> None:
    """The list of all files beside the record, where there is one."""
    path = folder.parent / "manifest.json"
    if path.is_file():
        expected = {name: entry["sha256"] for name, entry in seal["files"].items()}
        expected[f"{folder.name}/artifacts.json"] = hashlib.sha256((folder / "artifacts.json").read_bytes()).hexdigest()
        require(read_json(read_file(path)).get("files") == expected, "manifest.json lists other files than the seal")


def verify(folder: Path) -> dict[str, int | str]:
    """Check everything in a folder; the counts and the root hash, or Rejected."""
    try:
        return verified(folder.resolve())
    except (ArithmeticError, AttributeError, LookupError, RecursionError, TypeError, ValueError) as error:
        raise Rejected(f"something is not of the form that it must have ({type(error).__name__}: {error})") from error


def verified(folder: Path) -> dict[str, int | str]:
    objects = read_record(folder)
    check_use(objects)
    decided = []
    for item in objects.values():
        if item["object"] == "certificate":
            decided.append(check_certificate(item, objects))
        elif item["object"] == "verdict":
            check_verdict(item, objects)
        elif item["object"] == "step":
            check_step(item, objects)
    root = root_of(objects)
    kinds = [item["object"] for item in objects.values()]
    return {
        **{kind: kinds.count(kind) for kind in sorted(set(kinds))},
        "file": check_files(folder, root, objects),
        "expanded": sum(each_decided.get("expanded", 0) for each_decided in decided),
        "sampled": sum(not each_decided["expanded"] for each_decided in decided if each_decided),
        "bits of certainty": certainty(decided),
        "root": root,
    }


def certainty(decided: list[dict]) -> int:
    """-log2 of the probability that a wrong certificate, among those not expanded, passes all its random points.

    At one point: degree / prime (Schwartz 1980, Zippel 1979), and the share of primes that divide all coefficients.
    """
    sampled = [item for item in decided if item and not item["expanded"]]
    worst = max((item["degree"] / 2**60 + item["bits"] / 60 / 2**53 for item in sampled), default=2.0**-60)
    return math.floor(-POINTS * math.log2(worst))


def main(arguments: list[str]) -> int:
    folder = Path(arguments[0] if arguments else Path(__file__).parent)
    try:
        report = verify(folder)
    except Rejected as reason:
        print(f"REJECTED: {reason}", file=sys.stderr)
        return 1
    counted = {kind: report[kind] for kind in ("certificate", "equation", "file", "source", "step", "verdict")}
    print(", ".join(f"{count} {kind}{'' if count == 1 else 's'}" for kind, count in counted.items()), "hold")
    print(
        f"proofs expanded in exact integers: {report['expanded']}; checked at {POINTS} random points instead: "
        f"{report['sampled']}" + (f", failure below 2^-{report['bits of certainty']}" if report["sampled"] else "")
    )
    print("root", report["root"])
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
