"""Every operation on polynomials with an error bound holds every function that its arguments hold, exactly judged."""

from fractions import Fraction

import flint
import numpy as np
import pytest

from tests.certified.arithmetic import halved, header, operations, run
from tests.certified.test_arithmetic import arb

pytestmark = pytest.mark.usefixtures("many_digits")

ORDER, COUNT = 8, 25
BINARY, UNARY = ("add", "sub", "mul", "div", "atan2"), ("sqr", "neg", "sqrt", "magnitude", "sincos")

#: Error terms, halved. Not among them are the tails of series, which roundings outweigh, and the factors that only make
#: good the rounding of radii.
HALVED = halved(
    """
add: a.radius = ((a.radius + b.radius) + ⟦MWC_U⟧ * rounded)
add, radii: a.radius = (⟦(a.radius + b.radius)⟧ + MWC_U
mul: beyond + (⟦MWC_U⟧ * rounded
mul, powers beyond the last: spread + ⟦beyond⟧ +
mul, first: spread = ⟦mwc_poly_part(&a, 0)⟧ * b.radius
mul, second: a.radius * (⟦mwc_poly_part(&b, 0)⟧ + b.radius)
mul, radii: a.radius * (mwc_poly_part(&b, 0) + ⟦b.radius⟧)
div: q.radius = least > 0.0 ? ⟦mwc_poly_most(&left)⟧
sqrt: mwc_poly_least(&a) > 0.0 && least > 0.0 ? ⟦mwc_poly_most(&left)⟧
sincos, sine: sine->radius = (sine->radius + ⟦radius⟧)
sincos, cosine: cosine->radius = (cosine->radius + ⟦radius⟧)
"""
)


def compiled(folder, replaced=None):
    """The operations as they are, or with one text of the header replaced."""
    text = header("polynomial.h", replaced)
    calls = [(op, f"r[k] = mwc_poly_{op}(a[k], b[k])") for op in BINARY]
    calls += [(op, f"r[k] = mwc_poly_{op}(a[k])") for op in UNARY[:-1]]
    calls.append(("sincos", "mwc_poly_sincos(a[k], &r[k], &s[k])"))
    return operations(folder, text, "mw_polynomial", calls)


def at(row, t):
    return sum(Fraction(float(c)) * t**k for k, c in enumerate(row[: ORDER + 1]))


EXACT = {"add": lambda a, b: a + b, "sub": lambda a, b: a - b, "mul": lambda a, b: a * b, "div": lambda a, b: a / b,
         "sqr": lambda a, _: a * a, "neg": lambda a, _: -a, "magnitude": lambda a, _: abs(a)}  # fmt: skip
BALLS = {"sqrt": [lambda a, _: a.sqrt()], "atan2": [flint.arb.atan2],
         "sincos": [lambda a, _: a.sin(), lambda a, _: a.cos()]}  # fmt: skip


def missing(op, arguments, found, places, at):
    """How often a value at a place, with the arguments at an end of their radii, lies outside the results: rows of all
    of these end with a radius.
    """
    count = 0
    for k in range(len(arguments[0])):
        held = [result[k] for result in found if np.isfinite(result[k]).all()]
        for place in places:
            middles = [(at(row, place), Fraction(float(row[-1]))) for row in held]
            ends = [(at(rows[k], place), Fraction(float(rows[k][-1]))) for rows in arguments]
            for sides in ((-1, -1), (-1, 1), (1, -1), (1, 1), (0, 0)):
                x, y = (middle + side * radius for (middle, radius), side in zip(ends, sides, strict=True))
                values = [EXACT[op](x, y)] if op in EXACT else [f(arb(x), arb(y)) for f in BALLS[op]]
                count += sum(outside(value, *middle) for value, middle in zip(values, middles, strict=False))
    return count


def misses(loaded, op, a, b):
    return missing(op, (a, b), run(loaded, op, a, b), (Fraction(-1), Fraction(1), Fraction(1, 3)), at)


def outside(value, middle, radius):
    if isinstance(value, Fraction):
        return abs(value - middle) > radius
    return bool(abs(value - arb(middle)) > arb(radius))


def polynomials(rng, count, radii, powers=slice(0, 5)):
    """Coefficients that fall, the first of size 1; radius in shares of it."""
    rows = np.zeros((count, ORDER + 2))
    size = 0.1 ** np.arange(ORDER + 1)
    rows[:, powers] = (rng.uniform(-1, 1, (count, ORDER + 1)) * size)[:, powers]
    rows[:, 0] = rng.uniform(1.0, 2.0, count)
    rows[:, -1] = radii * rows[:, 0]
    return rows


def cases(rng):
    """(operation, first, second) with arguments that bring every error term to bear."""
    for radii in (0.0, 1e-9, 0.3):
        a, b = (polynomials(rng, COUNT, radii) for _ in range(2))
        for op in (*BINARY, *UNARY):
            yield op, a, b
    for op in ("add", "mul", "sqrt"):  # constants, whose one rounding is all there is
        yield op, *(polynomials(rng, 8 * COUNT, 0.0, slice(0, 1)) for _ in range(2))
    for radii in (0.3, 0.6):
        yield "sqrt", *(polynomials(rng, COUNT, radii, slice(0, 1)) for _ in range(2))
    across = polynomials(rng, COUNT, 0.3)
    across[:, 0] = rng.uniform(-0.2, 0.2, COUNT)
    yield "magnitude", across, across
    last = np.zeros((4, ORDER + 2))
    last[:, ORDER] = rng.uniform(1, 2, 4)
    yield "mul", last, last
    near = np.zeros((4, ORDER + 2))
    near[:, -1] = 0.01
    yield "sincos", near, near
    near[:, 0] = np.pi / 2
    yield "sincos", near, near


def test_every_operation_holds_the_exact_results(tmp_path):
    loaded = compiled(tmp_path)
    for op, a, b in cases(np.random.default_rng(1)):
        assert misses(loaded, op, a[:COUNT], b[:COUNT]) == 0, op


@pytest.mark.validate
@pytest.mark.parametrize("term", HALVED)
def test_half_an_error_term_is_too_little(tmp_path, term):
    loaded, wanted = compiled(tmp_path, HALVED[term]), term.split(",")[0]
    assert any(misses(loaded, op, a, b) for op, a, b in cases(np.random.default_rng(2)) if op == wanted)
