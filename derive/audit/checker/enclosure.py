"""Real numbers as exact fractions or enclosures, and printed numbers judged by them."""

import math
import re
from fractions import Fraction
from math import isqrt

from .numbers import LARGEST_INTEGER, power
from .refusal import require
from .trees import product_of, sum_of

#: Enclosures are rounded to this.
GRID = 10**45
PRINTED = re.compile(r"-?\d+(\.\d+)?")


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
        spread = abs(self.middle) * other.radius + abs(other.middle) * self.radius + self.radius * other.radius
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
