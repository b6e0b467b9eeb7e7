"""Every operation on polynomials of two variables holds every function that its arguments hold, exactly judged."""

import ctypes
import subprocess
from fractions import Fraction

import flint
import numpy as np
import pytest

from meshwright.base.compile import FLAGS, compiler
from tests.certified.arithmetic import C
from tests.certified.test_arithmetic import arb
from tests.certified.test_polynomials import BALLS, BINARY, EXACT, UNARY, outside

COUNT, TERMS = 25, [(d - j, j) for d in range(5) for j in range(d + 1)]

_LOOP = """
void run_{op}(int n, const mwc_sheet *a, const mwc_sheet *b, mwc_sheet *r, mwc_sheet *s)
{{
    (void)b, (void)s;
    for (int k = 0; k < n; k++) {call};
}}
"""

#: Error terms, halved: as of the polynomials of one variable. The bound of a sum of rounded products is twice what its
#: terms come to at their worst, so it is left out, as are the tails of series.
_TERMS = {
    "add": ("a.radius = ((a.radius + b.radius) + ", "MWC_U * rounded)"),
    "add, radii": ("a.radius = (", "(a.radius + b.radius) + MWC_U"),
    "mul, degrees beyond the last": ("spread + ", "beyond +"),
    "mul, first": ("spread = ", "mwc_sheet_part(&a, 0) * b.radius"),
    "mul, second": ("a.radius * (", "mwc_sheet_part(&b, 0) + b.radius)"),
    "mul, radii": ("a.radius * (mwc_sheet_part(&b, 0) + ", "b.radius)"),
    "div": ("q.radius = least > 0.0 ? ", "mwc_sheet_most(&left)"),
    "sqrt": ("s.radius = defined ? ", "mwc_sheet_most(&left)"),
    "sincos, sine": ("sine->radius = (sine->radius + ", "radius)"),
    "sincos, cosine": ("cosine->radius = (cosine->radius + ", "radius)"),
}
HALVED = {name: (before + term, f"{before}0.5 * {term}") for name, (before, term) in _TERMS.items()}


def compiled(folder, replaced=None):
    """The operations as they are, or with one text of the header replaced."""
    text = (C / "certify" / "sheet.h").read_text(encoding="utf-8")
    if replaced:
        assert text.count(replaced[0]) == 1, (replaced[0], text.count(replaced[0]))
        text = text.replace(*replaced)
    text = text.replace('"ball.h"', '"certify/ball.h"')
    calls = [(op, f"r[k] = mwc_sheet_{op}(a[k], b[k])") for op in BINARY]
    calls += [(op, f"r[k] = mwc_sheet_{op}(a[k])") for op in (*UNARY[:3], "sign")]
    calls.append(("sincos", "mwc_sheet_sincos(a[k], &r[k], &s[k])"))
    source, library = folder / "sheet.c", folder / "sheet.so"
    loops = "".join(_LOOP.format(op=op, call=call) for op, call in calls)
    source.write_text(f"#include <stddef.h>\n{text}{loops}", encoding="utf-8")
    flags = [f for f in FLAGS if not f.startswith(("-W", "-O"))]
    command = (*compiler(), *flags, "-O1", f"-I{C}", "-shared", source, "-o", library, "-lm")
    subprocess.run([*map(str, command)], check=True)
    return ctypes.CDLL(str(library))


def run(loaded, op, a, b):
    """Results (N, 16) of one operation; of ``sincos`` both."""
    arrays = [np.ascontiguousarray(x, dtype=float) for x in (a, b)] + [np.empty_like(a) for _ in range(2)]
    getattr(loaded, f"run_{op}")(len(a), *(x.ctypes.data_as(ctypes.c_void_p) for x in arrays))
    return arrays[2:] if op == "sincos" else arrays[2:3]


def at(row, s, t):
    return sum(Fraction(float(c)) * s**i * t**j for c, (i, j) in zip(row, TERMS, strict=False))


def misses(loaded, op, a, b):
    """How often a value somewhere, with the arguments at an end of their radii, lies outside the result."""
    found, count, one = run(loaded, op, a, b), 0, Fraction(1)
    for k in range(len(a)):
        held = [result[k] for result in found if np.isfinite(result[k]).all()]
        for s, t in ((-one, -one), (one, -one), (one, one), (one / 3, -one / 2)):
            middles = [(at(row, s, t), Fraction(float(row[-1]))) for row in held]
            for sides in ((-1, -1), (-1, 1), (1, 1), (0, 0)):
                x, y = (at(r[k], s, t) + e * Fraction(float(r[k][-1])) for r, e in zip((a, b), sides, strict=True))
                values = [EXACT[op](x, y)] if op in EXACT else [f(arb(x), arb(y)) for f in BALLS[op]]
                count += sum(outside(value, *middle) for value, middle in zip(values, middles, strict=False))
    return count


def sheets(rng, count, radii, kept=slice(0, 15)):
    """Coefficients that fall with the degree, the first of size 1; radius in shares of it."""
    rows = np.zeros((count, 16))
    size = np.array([0.1 ** (i + j) for i, j in TERMS])
    rows[:, :15][:, kept] = (rng.uniform(-1, 1, (count, 15)) * size)[:, kept]
    rows[:, 0] = rng.uniform(1.0, 2.0, count)
    rows[:, -1] = radii * rows[:, 0]
    return rows


def cases(rng):
    """(operation, first, second) with arguments that bring every error term to bear."""
    for radii in (0.0, 1e-9, 0.3):
        a, b = (sheets(rng, COUNT, radii) for _ in range(2))
        for op in (*BINARY, *UNARY):
            yield op, a, b
    yield "add", *(sheets(rng, 8 * COUNT, 0.0, slice(0, 1)) for _ in range(2))
    for radii in (0.3, 0.6):
        yield "sqrt", *(sheets(rng, COUNT, radii, slice(0, 1)) for _ in range(2))
    last = np.zeros((4, 16))
    last[:, 10] = rng.uniform(1, 2, 4)
    yield "mul", last, last
    near = np.zeros((4, 16))
    near[:, -1] = 0.01
    yield "sincos", near, near
    near[:, 0] = np.pi / 2
    yield "sincos", near, near


@pytest.fixture(autouse=True)
def many_digits():
    before, flint.ctx.prec = flint.ctx.prec, 300
    yield
    flint.ctx.prec = before


def test_every_operation_holds_the_exact_results(tmp_path):
    loaded = compiled(tmp_path)
    for op, a, b in cases(np.random.default_rng(1)):
        assert misses(loaded, op, a[:6], b[:6]) == 0, op


def test_a_sign_that_changes_is_anything_between(tmp_path):
    a = np.zeros((3, 16))
    a[:, 0], a[:, 1] = (1.0, 0.01, -1.0), 0.1
    (found,) = run(compiled(tmp_path), "sign", a, a)
    assert found[:, 0].tolist() == [1.0, 0.0, -1.0] and found[:, -1] == pytest.approx([0.0, 1.0, 0.0], abs=1e-9)
    assert found[1, -1] >= 1.0


@pytest.mark.validate
@pytest.mark.parametrize("term", HALVED)
def test_half_an_error_term_is_too_little(tmp_path, term):
    loaded, wanted = compiled(tmp_path, HALVED[term]), term.split(",")[0]
    assert any(misses(loaded, op, a, b) for op, a, b in cases(np.random.default_rng(2)) if op == wanted)
