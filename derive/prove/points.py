"""Points at which statements are evaluated: rational cosines and sines, small rational parameters.

A polynomial identity in an angle and its cosine and sine that held on all real points would hold as a polynomial
identity, so a point with an exactly rational cosine and sine refutes exactly. Where the bare angle, pi, a root or an
angle that depends on other values also occurs, their values are rational to 1e-25 and a difference counts only above
1e-9.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import islice

import mpmath

from derive.prove.angles import PI
from derive.prove.evaluate import Evaluator
from derive.prove.fraction import Quotient
from derive.prove.polynomial import Terms

HALF_TANGENTS = tuple(
    Fraction(*pair)
    for pair in ((1, 3), (1, 2), (1, 4), (2, 3), (1, 5), (2, 5), (3, 4), (1, 6), (3, 5), (1, 7), (2, 7), (3, 7))
)
LENGTHS = tuple(map(Fraction, (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47)))
#: More than any of them: where two symbols of a point were equal, a determinant could vanish.
BEYOND = 60
DIGITS, SCALE = 60, 10**30
THRESHOLD = Fraction(1, 10**9)


@dataclass(frozen=True)
class Point:
    """Values of the free symbols and jets, and of the half-angle tangents that fix every cosine and sine."""

    symbols: dict[str, Fraction]
    half_tangents: dict[str, Fraction]
    values: dict[str, Fraction]


def sample_points(evaluator: Evaluator, count: int) -> Iterator[Point]:
    """Deterministic points of the statement's variety with real roots, simplest first."""
    return islice((point for attempt in range(8 * count) if (point := _point(evaluator, attempt)) is not None), count)


def value_at(part: Quotient, point: Point) -> Fraction | None:
    """The number, or None where a denominator vanishes."""
    names = part.ring.names
    below = Fraction(1)
    for factor, times in part.factors:
        below *= _sum(part.ring.terms(factor), names, point.values) ** times
    return _sum(part.ring.terms(part.numerator), names, point.values) / below if below else None


def is_rounded(evaluator: Evaluator, parts: list[Quotient]) -> bool:
    """Does a value depend on a bare angle, on pi or on a root, which are rational only to 1e-30?"""
    statement = evaluator.statement
    inexact = (
        {angle.symbol for angle in statement.angles}
        | {PI}
        | {root.generator for root in evaluator.roots}
        | set(evaluator.arcs.values())
    )
    inexact |= {
        name for angle in statement.angles if angle.symbol in statement.used for name in (angle.cosine, angle.sine)
    }
    positions = [i for i, name in enumerate(evaluator.ring.names) if name in inexact]
    polys = [poly for part in parts for poly in (part.numerator, *(factor for factor, _ in part.factors))]
    return any(powers[i] for poly in polys for powers in evaluator.ring.terms(poly) for i in positions)


def _point(evaluator: Evaluator, attempt: int) -> Point | None:
    statement = evaluator.statement
    angles = [angle for angle in statement.angles if angle.symbol not in statement.used]
    bases = {angle.name: HALF_TANGENTS[(k + attempt) % len(HALF_TANGENTS)] for k, angle in enumerate(angles)}
    values: dict[str, Fraction] = {PI: arctangent(Fraction(1)) * 4}
    for angle in angles:
        t = bases[angle.name]
        values[angle.cosine], values[angle.sine] = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
        values[angle.symbol] = 2 * angle.divisor * arctangent(t)
    dependent = {root.generator for root in evaluator.roots} | set(evaluator.arcs.values())
    dependent |= {name for angle in statement.angles for name in (angle.cosine, angle.sine)}
    free = [
        name
        for name in evaluator.ring.names
        if name not in values and name not in dependent and not name.startswith("sqrt")
    ]
    for k, name in enumerate(free):
        if name in statement.signs:
            values[name] = Fraction((-1) ** (attempt + k))
        else:
            turn, place = divmod(k, len(LENGTHS))
            length = LENGTHS[(place + 3 * attempt) % len(LENGTHS)] + turn * BEYOND
            values[name] = length / (1 if attempt < 4 else 1 + (attempt + k) % 3)
    by_symbol = {angle.symbol: angle for angle in statement.angles}
    point = Point({name: values[name] for name in free}, bases, values)
    for kind, tree in statement.dependent_generators:
        if kind == "arc":
            y, x = (value_at(evaluator.value(part), point) for part in tree[1:])
            if x is None or y is None or x <= 0:
                return None
            values[evaluator.arcs[tree]] = arctangent(y / x)
            continue
        value = value_at(evaluator.value(tree), point)
        if value is None or (kind == "root" and value < 0):
            return None
        if kind == "angle":
            angle = by_symbol[tree]
            values[angle.cosine], values[angle.sine] = cosine_and_sine(value / angle.divisor)
        else:
            root = next(root for root in evaluator.roots if root.radicand == tree)
            values[root.generator] = _sum(
                evaluator.ring.terms(root.divisor), evaluator.ring.names, values
            ) * square_root(value)
    return point


def square_root(value: Fraction) -> Fraction:
    return _rational(lambda: mpmath.sqrt(_real(value)))


def cosine_and_sine(angle: Fraction) -> tuple[Fraction, Fraction]:
    return _rational(lambda: mpmath.cos(_real(angle))), _rational(lambda: mpmath.sin(_real(angle)))


@cache
def arctangent(t: Fraction) -> Fraction:
    return _rational(lambda: mpmath.atan(_real(t)))


def _real(value: Fraction) -> mpmath.mpf:
    return mpmath.mpf(value.numerator) / value.denominator


def _rational(value: Callable[[], mpmath.mpf]) -> Fraction:
    """A real number, rational to 1e-30."""
    with mpmath.workdps(DIGITS):
        return Fraction(int(mpmath.floor(value() * SCALE + 0.5)), SCALE)


def _sum(terms: Terms, names: tuple[str, ...], values: dict[str, Fraction]) -> Fraction:
    total = Fraction(0)
    for powers, factor in terms.items():
        product = Fraction(factor)
        for name, power in zip(names, powers, strict=True):
            if power:
                product *= values[name] ** power
        total += product
    return total
