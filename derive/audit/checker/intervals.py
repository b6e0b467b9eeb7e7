"""Real numbers enclosed between whole multiples of 2^-200, with their derivatives along some unknowns.

Sums and products of intervals grow by the unit, whatever is computed: fractions would grow without end. Every function
rounds outwards. Sine and cosine are Taylor's series about the nearest multiple of a right angle, arc tangents a series
after three halvings, pi is Machin's.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import cache
from math import isqrt, prod

from .refusal import require

BITS = 200
UNIT = 1 << BITS
Pair = tuple[int, int]


class Undefined(Exception):
    """A number that surely does not exist, such as the root of a negative one."""


def enclosed(number: Fraction | int) -> Pair:
    """An exact number; equal ends where it is a multiple of the unit."""
    over, under = number.numerator << BITS, number.denominator
    return over // under, -(-over // under)


def plus(a: Pair, b: Pair) -> Pair:
    return a[0] + b[0], a[1] + b[1]


def minus(a: Pair) -> Pair:
    return -a[1], -a[0]


def times(a: Pair, b: Pair) -> Pair:
    products = (a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1])
    return min(products) >> BITS, -(-max(products) >> BITS)


def square(a: Pair) -> Pair:
    low, high = sorted((abs(a[0]), abs(a[1])))
    return (0 if a[0] < 0 < a[1] else low * low >> BITS), -(-high * high >> BITS)


def reciprocal(a: Pair) -> Pair:
    if a == (0, 0):
        raise Undefined("a division by zero")
    require(a[0] > 0 or a[1] < 0, "a divisor may be zero")
    return (UNIT * UNIT) // a[1], -(-(UNIT * UNIT) // a[0])


def root(a: Pair) -> Pair:
    if a[1] < 0:
        raise Undefined("the root of a negative number")
    require(a[0] >= 0, "a radicand may be negative")
    high = isqrt(a[1] << BITS)
    return isqrt(a[0] << BITS), high + (high * high != a[1] << BITS)


@cache
def pi() -> Pair:
    """16 atan 1/5 - 4 atan 1/239."""
    a, b = (times(enclosed(of), small_arc(enclosed(Fraction(1, by)))) for of, by in ((16, 5), (-4, 239)))
    return plus(a, b)


def small_arc(a: Pair) -> Pair:
    """The arc tangent of a number in (-1/2, 1/2): the series alternates, what is left out is below the last term."""
    total, power, k = (0, 0), a, 1
    while max(map(abs, power)) > 1:
        total = plus(total, times(power, enclosed(Fraction(1 - k % 4 + 1, k))))
        power, k = times(power, square(a)), k + 2
    return total[0] - 2, total[1] + 2


def arc(a: Pair) -> Pair:
    """The arc tangent, end by end."""
    return arc_of_end(a[0])[0], arc_of_end(a[1])[1]


def arc_of_end(end: int) -> Pair:
    a = end, end
    for _ in range(3):
        a = times(a, reciprocal(plus(enclosed(1), root(plus(enclosed(1), square(a))))))
    return times(enclosed(8), small_arc(a))


def turned(a: Pair) -> tuple[Pair, Pair]:
    """Cosine and sine: those of the middle; for all within w, sin(m + w) is within |cos m| w + w^2/2 of sin m."""
    if a == (0, 0):
        return enclosed(1), a
    middle = (a[0] + a[1]) >> 1
    right = times(pi(), enclosed(Fraction(1, 2)))
    quarters = (2 * middle + right[0]) // (2 * right[0])
    reduced = plus((middle, middle), minus(times(enclosed(quarters), right)))
    cosine, sine = series(reduced)
    for _ in range(quarters % 4):
        cosine, sine = minus(sine), cosine
    wide = max(a[1] - middle, middle - a[0])
    return widened(cosine, changed(sine, wide)), widened(sine, changed(cosine, wide))


def changed(slope: Pair, wide: int) -> int:
    """|slope| w + w^2/2, rounded upwards."""
    off = 0, wide
    return times(plus(magnitude(slope), times(off, enclosed(Fraction(1, 2)))), off)[1]


def magnitude(a: Pair) -> Pair:
    return 0, max(map(abs, a))


def widened(a: Pair, by: int) -> Pair:
    return max(a[0] - by, -UNIT), min(a[1] + by, UNIT)


def series(a: Pair) -> tuple[Pair, Pair]:
    """Cosine and sine of a small angle; terms fall from the second on, so that the last bounds what is left out."""
    sums, term, k = [(0, 0), (0, 0)], enclosed(1), 0
    while k < 4 or max(map(abs, term)) > 1:
        sums[k % 2] = plus(sums[k % 2], term if k % 4 < 2 else minus(term))
        k += 1
        term = times(times(term, a), enclosed(Fraction(1, k)))
    return widened(sums[0], 2), widened(sums[1], 2)


class Enclosed:
    """A number between two multiples of the unit, and its derivatives, none of a constant.

    ``exact``: q and k where it is q times the k-th power of pi, so that an angle less itself is nothing.
    """

    __slots__ = ("exact", "pair", "rates")

    def __init__(self, pair: Pair, rates: tuple[Pair, ...] = (), exact: tuple[Fraction, int] | None = None):
        self.pair, self.rates, self.exact = pair, rates, exact

    @classmethod
    def of(cls, number: Fraction | int, power_of_pi: int = 0) -> Enclosed:
        pair = enclosed(number)
        if number == 0:
            return cls(pair, (), (Fraction(0), 0))
        for _ in range(abs(power_of_pi)):
            pair = times(pair, pi() if power_of_pi > 0 else reciprocal(pi()))
        return cls(pair, (), (Fraction(number), power_of_pi))

    def along(self, *parts: tuple[Pair, Enclosed]) -> Enclosed:
        """This value with the derivatives that follow from those of others, each times its slope."""
        moving = [(slope, other.rates) for slope, other in parts if other.rates]
        rates = []
        for column in range(max((len(rates) for _, rates in moving), default=0)):
            total = 0, 0
            for slope, own in moving:
                if own[column] != (0, 0):
                    total = plus(total, times(slope, own[column]))
            rates.append(total)
        return Enclosed(self.pair, tuple(rates))

    def above(self, bound: int = 0) -> bool:
        return self.pair[0] > bound


def total(*terms: Enclosed) -> Enclosed:
    exact = [term.exact for term in terms if term.exact != (0, 0)]
    if None not in exact and len({k for _, k in exact}) <= 1:
        return Enclosed.of(sum(q for q, _ in exact), exact[0][1] if exact else 0)
    pair = 0, 0
    for term in terms:
        pair = plus(pair, term.pair)
    return Enclosed(pair).along(*((enclosed(1), term) for term in terms))


def product(*factors: Enclosed) -> Enclosed:
    exact = [factor.exact for factor in factors]
    if None not in exact:
        return Enclosed.of(prod(q for q, _ in exact), sum(k for _, k in exact))
    value = factors[0]
    for factor in factors[1:]:
        made = Enclosed(times(value.pair, factor.pair))
        value = made.along((factor.pair, value), (value.pair, factor))
    return value


def quotient(a: Enclosed, b: Enclosed) -> Enclosed:
    return product(a, inverse(b))


def inverse(a: Enclosed) -> Enclosed:
    pair = reciprocal(a.pair)
    return Enclosed(pair).along((minus(square(pair)), a))


def whole_power(a: Enclosed, exponent: int) -> Enclosed:
    if exponent < 0:
        return inverse(whole_power(a, -exponent))
    if exponent == 0:
        return Enclosed.of(1)
    pair = enclosed(1)
    for _ in range(exponent // 2):
        pair = times(pair, square(a.pair))
    before = a.pair if exponent > 1 and exponent % 2 == 0 else enclosed(1)
    for _ in range((exponent - 1) // 2):
        before = times(before, square(a.pair))
    pair = times(pair, a.pair) if exponent % 2 else pair
    return Enclosed(pair).along((times(enclosed(exponent), before), a))


def square_root(a: Enclosed) -> Enclosed:
    pair = root(a.pair)
    if not a.rates:
        return Enclosed(pair)
    require(a.above(), "a radicand may be zero")
    return Enclosed(pair).along((reciprocal(times(enclosed(2), pair)), a))


def power(a: Enclosed, exponent: Fraction) -> Enclosed:
    require(exponent.denominator in (1, 2) and abs(exponent) <= 64, f"a power of {exponent} is not foreseen")
    return whole_power(a if exponent.denominator == 1 else square_root(a), exponent.numerator)


def sine(a: Enclosed) -> Enclosed:
    c, s = turned(a.pair)
    return Enclosed(s).along((c, a))


def cosine(a: Enclosed) -> Enclosed:
    c, s = turned(a.pair)
    return Enclosed(c).along((minus(s), a))


def tangent(a: Enclosed) -> Enclosed:
    return quotient(sine(a), cosine(a))


def arc_tangent(a: Enclosed) -> Enclosed:
    return Enclosed(arc(a.pair)).along((reciprocal(plus(enclosed(1), square(a.pair))), a))


def arc_sine(a: Enclosed) -> Enclosed:
    low, high = a.pair
    if low > UNIT or high < -UNIT:
        raise Undefined("an arc sine of a number beyond 1")
    require(low >= -UNIT and high <= UNIT, "the argument of an arc sine may lie beyond 1")
    pair = arc_sine_of_end(low)[0], arc_sine_of_end(high)[1]
    if not a.rates:
        return Enclosed(pair)
    other = root(plus(enclosed(1), minus(square(a.pair))))
    require(other[0] > 0, "an arc sine without a derivative")
    return Enclosed(pair).along((reciprocal(other), a))


def arc_sine_of_end(end: int) -> Pair:
    if abs(end) == UNIT:
        return times(pi(), enclosed(Fraction(end, 2 * UNIT)))
    a = end, end
    return arc(times(a, reciprocal(root(plus(enclosed(1), minus(square(a)))))))


def arc_cosine(a: Enclosed) -> Enclosed:
    return total(Enclosed(times(pi(), enclosed(Fraction(1, 2)))), product(Enclosed.of(-1), arc_sine(a)))


def angle(y: Enclosed, x: Enclosed) -> Enclosed:
    """atan2, but on its cut and at the origin."""
    if x.above():
        return arc_tangent(quotient(y, x))
    up = y.above()
    require(up or y.pair[1] < 0, "an angle may lie on its cut")
    right = Enclosed(times(pi(), enclosed(Fraction(1 if up else -1, 2))))
    return total(right, product(Enclosed.of(-1), arc_tangent(quotient(x, y))))


def size(a: Enclosed) -> Enclosed:
    """The absolute value; both slopes where the sign is not known."""
    if a.pair[0] >= 0 or a.pair[1] <= 0:
        return a if a.pair[0] >= 0 else product(Enclosed.of(-1), a)
    return Enclosed(magnitude(a.pair)).along(((-UNIT, UNIT), a))


def excess(a: Enclosed) -> Enclosed:
    """What is above zero; both slopes where the sign is not known."""
    if a.pair[1] <= 0:
        return Enclosed((0, 0))
    return a if a.pair[0] >= 0 else Enclosed((0, a.pair[1])).along(((0, UNIT), a))


def step(a: Enclosed) -> Enclosed:
    require(a.pair[0] >= 0 or a.pair[1] < 0, "a sign is not known")
    return Enclosed.of(int(a.pair[0] >= 0))


def sign(a: Enclosed) -> Enclosed:
    return Enclosed.of(1 if step(a).above() else -1)


#: Operations of a description, but for powers and quotients of whole numbers.
OPERATIONS: dict[str, Callable[..., Enclosed]] = {
    "+": total, "*": product, "sqrt": square_root, "sin": sine, "cos": cosine, "tan": tangent, "asin": arc_sine,
    "acos": arc_cosine, "atan": arc_tangent, "atan2": angle, "abs": size, "excess": excess, "unit_step": step,
    "sign": sign, "pi": lambda: Enclosed.of(1, 1),
}  # fmt: skip
