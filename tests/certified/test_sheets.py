"""Every operation on polynomials of three variables holds every function that its arguments hold, exactly judged."""

from fractions import Fraction

import numpy as np
import pytest

from tests.certified import arithmetic
from tests.certified.arithmetic import C, halved, header, operations
from tests.certified.test_polynomials import BINARY, UNARY, missing

pytestmark = pytest.mark.usefixtures("many_digits")

COUNT, TERMS = 25, [(d - j, j, k) for k in range(5) for d in range(5 - k) for j in range(d + 1)]

#: Coefficients in a row; places after these and one that is zero: radius; what of the coefficients occurs, highest
#: degree in s and t and highest power of u.
HELD, RADIUS, WIDTH = len(TERMS), len(TERMS) + 1, len(TERMS) + 3

#: Error terms, halved: as of the polynomials of one variable. The bound of a sum of rounded products is twice what its
#: terms come to at their worst, so it is left out, as are the tails of series.
HALVED = halved(
    """
add: r->radius = (radii + ⟦MWC_U⟧ * mwc_sheet_size(r->c))
add, radii: r->radius = (⟦radii⟧ + MWC_U
mul, degrees beyond the last: spread + ⟦beyond⟧ +
mul, first: spread = ⟦size⟧ * b->radius
mul, second: a->radius * (⟦other⟧ + b->radius)
mul, radii: a->radius * (other + ⟦b->radius⟧)
mul, by a number: spread = mwc_sheet_part(a, 0) * radius + ⟦a->radius⟧ * (mwc_abs(by) + radius)
mul, by a number within a radius: spread = ⟦mwc_sheet_part(a, 0)⟧ * radius
div: q.radius = least > 0.0 ? ⟦mwc_sheet_most(&left)⟧
sqrt: s.radius = defined ? ⟦mwc_sheet_most(&left)⟧
sincos, sine: sine->radius = (sine->radius + ⟦radius⟧)
sincos, cosine: cosine->radius = (cosine->radius + ⟦radius⟧)
"""
)


def compiled(folder, replaced=None):
    """The operations as they are, or with one text of the header replaced."""
    text = header("sheet.h", replaced)
    cube = (C / "certify" / "cube.h").read_text(encoding="utf-8").replace('#include "sheet.h"', "")
    calls = [(op, f"r[k] = mwc_sheet_{op}(a[k], b[k])") for op in BINARY]
    calls += [(op, f"r[k] = mwc_sheet_{op}(a[k])") for op in (*UNARY[:-1], "sign")]
    calls.append(("sincos", "mwc_sheet_sincos(a[k], &r[k], &s[k])"))
    calls += [
        (f"half_{v}_{name}", f"(r[k] = a[k], mwc_cube_half(&r[k], {v}, {end}))")
        for v in range(3)
        for name, end in (("low", "-1.0"), ("high", "1.0"))
    ]
    calls.append(("low", "(r[k] = a[k], r[k].c[0] = mwc_cube_low(&a[k]))"))
    return operations(folder, text + cube, "mwc_sheet", calls)


def run(loaded, op, a, b):
    """Results (N, WIDTH) of one operation; of ``sincos`` both."""
    return arithmetic.run(loaded, op, _marked(a), _marked(b))


def _marked(rows):
    """Rows with the degrees that occur in them, as the structure holds them."""
    rows = np.array(rows, dtype=float)
    occurs = rows[:, :HELD] != 0.0
    degrees = [(i + j, k) for i, j, k in TERMS]
    highest = np.where(occurs[..., None], degrees, 0).max(axis=1).astype(np.int32)
    rows[:, -1] = np.ascontiguousarray(highest).view(float)[:, 0]
    return rows


def at(row, place):
    powers = [[x**n for n in range(5)] for x in place]
    return sum(
        Fraction(float(c)) * powers[0][i] * powers[1][j] * powers[2][k]
        for c, (i, j, k) in zip(row, TERMS, strict=False)
        if c
    )


def misses(loaded, op, a, b):
    one = Fraction(1)
    places = ((-one, -one, -one), (one, -one, one), (one, one, one), (one / 3, -one / 2, one / 5))
    found = [result[:, : RADIUS + 1] for result in run(loaded, op, a, b)]
    return missing(op, [rows[:, : RADIUS + 1] for rows in (a, b)], found, places, at)


def sheets(rng, count, radii, kept=slice(0, HELD)):
    """Coefficients that fall with the degree, the first of size 1; radius in shares of it."""
    rows = np.zeros((count, WIDTH))
    size = np.array([0.1 ** sum(term) for term in TERMS])
    rows[:, :HELD][:, kept] = (rng.uniform(-1, 1, (count, HELD)) * size)[:, kept]
    rows[:, 0] = rng.uniform(1.0, 2.0, count)
    rows[:, RADIUS] = radii * rows[:, 0]
    return rows


def cases(rng):
    """(operation, first, second) with arguments that bring every error term to bear."""
    for radii in (0.0, 1e-9, 0.3):
        a, b = (sheets(rng, COUNT, radii) for _ in range(2))
        for op in (*BINARY, *UNARY):
            yield op, a, b
    for kept in (slice(0, 15), slice(0, 3), [0, 15, 25, 31, 34], slice(0, 1)):  # fewer variables, lower degrees
        a = sheets(rng, 3, 1e-9, kept)
        for op in (*BINARY, *UNARY):
            yield op, a, b[:3]
            yield op, b[:3], a
    yield "add", *(sheets(rng, 8 * COUNT, 0.0, slice(0, 1)) for _ in range(2))
    for radii in (0.3, 0.6):
        yield "sqrt", *(sheets(rng, COUNT, radii, slice(0, 1)) for _ in range(2))
    last = np.zeros((4, WIDTH))
    last[:, 10] = rng.uniform(1, 2, 4)
    yield "mul", last, last
    near = np.zeros((4, WIDTH))
    near[:, RADIUS] = 0.01
    yield "sincos", near, near
    near[:, 0] = np.pi / 2
    yield "sincos", near, near


def test_every_operation_holds_the_exact_results(tmp_path):
    loaded = compiled(tmp_path)
    for op, a, b in cases(np.random.default_rng(1)):
        assert misses(loaded, op, a[:6], b[:6]) == 0, op


def test_a_sign_that_changes_is_anything_between(tmp_path):
    a = np.zeros((3, WIDTH))
    a[:, 0], a[:, 1] = (1.0, 0.01, -1.0), 0.1
    (found,) = run(compiled(tmp_path), "sign", a, a)
    assert found[:, 0].tolist() == [1.0, 0.0, -1.0] and found[:, RADIUS] == pytest.approx([0.0, 1.0, 0.0], abs=1e-9)
    assert found[1, RADIUS] >= 1.0


def test_halves_of_the_cube_and_lower_bounds_hold_every_value(tmp_path):
    rng, loaded = np.random.default_rng(4), compiled(tmp_path)
    rows = np.concatenate([sheets(rng, 8, 1e-6), sheets(rng, 8, 0.0, slice(0, 15)), sheets(rng, 4, 0.0, [0, 15, 25])])
    rows[:, 0] *= rng.choice([0.0, 1.0], len(rows))
    rows[:12, [3, 5]] = 0.4  # convex
    rows[:4, [3, 5]] *= -1.0
    places = [[Fraction(int(n), 8) for n in place] for place in rng.integers(-8, 9, (40, 3))]
    (low,) = run(loaded, "low", rows, rows)
    for row, bound in zip(rows, low, strict=True):
        least = min(at(row, place) for place in places) - Fraction(float(row[RADIUS]))
        assert bound[0] <= least and least - bound[0] < 3.0
    for variable in range(3):
        for end in (-1, 1):
            (halves,) = run(loaded, f"half_{variable}_{'low' if end < 0 else 'high'}", rows, rows)
            for row, half in zip(rows, halves, strict=True):
                for place in places[:6]:
                    inner = [*place]
                    inner[variable] = (place[variable] + end) / 2
                    off = abs(at(row, inner) - at(half, place))
                    assert off <= Fraction(float(half[RADIUS])) - Fraction(float(row[RADIUS]))


def test_the_lower_bound_of_a_convex_polynomial_is_sharp(tmp_path):
    rows = np.zeros((2, WIDTH))
    rows[:, [3, 5]] = 0.5
    rows[:, 4] = 0.3
    rows[0, [16, 17]] = 0.2, -0.1  # the lowest place moves with u
    rows[0, 25] = 0.05
    (found,) = run(compiled(tmp_path), "low", rows, rows)
    assert np.all(found[:, 0] <= 0.0) and found[1, 0] > -1e-10
    plain = -np.abs(rows[:, :RADIUS]).sum(axis=1)
    assert np.all(found[:, 0] > 0.1 * plain)


@pytest.mark.validate
@pytest.mark.parametrize("term", HALVED)
def test_half_an_error_term_is_too_little(tmp_path, term):
    loaded, wanted = compiled(tmp_path, HALVED[term]), term.split(",")[0]
    assert any(misses(loaded, op, a, b) for op, a, b in cases(np.random.default_rng(2)) if op == wanted)
