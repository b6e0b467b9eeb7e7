"""Every operation of the arithmetics encloses what it must, exactly judged; no error term could be smaller by half."""

import math
import re
from fractions import Fraction

import flint
import numpy as np
import pytest

from tests.certified.arithmetic import C, compiled, halved

pytestmark = pytest.mark.usefixtures("many_digits")

COUNT = 250
U = 2.0**-53


def fractions(row):
    """Midpoint and radius of a ball or of a wide one."""
    return sum(map(Fraction, row[:-1].tolist())), Fraction(float(row[-1]))


def ends(row):
    middle, radius = fractions(row)
    return middle - radius, middle, middle + radius


def outside(result, value):
    """Whether a value, a fraction or an arb, surely lies outside a result; NaN and infinite radii hold everything."""
    if not np.all(np.isfinite(result)):
        return False
    middle, radius = fractions(result)
    if isinstance(value, Fraction):
        return abs(value - middle) > radius * (1 + Fraction(1, 2**40))
    return bool(abs(value - arb(middle)) > arb(radius * (1 + Fraction(1, 2**40))))


def arb(value):
    return flint.arb(flint.fmpq(value.numerator, value.denominator))


EXACT = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "sqr": lambda a: a * a,
    "neg": lambda a: -a,
    "magnitude": abs,
}
BALLS = {
    "sqrt": lambda a: arb(a).sqrt(),
    "atan2": lambda y, x: flint.arb.atan2(arb(y), arb(x)),
}


def misses(arithmetic, kind, op, a, b=None):
    """Number of points within the arguments whose result lies outside the result, taken at middles and ends."""
    found = arithmetic(kind, op, a, b)
    if op == "sincos":
        return sum(
            outside(r, f(arb(x)))
            for result, f in zip(found, (flint.arb.sin, flint.arb.cos), strict=True)
            for r, row in zip(result, a, strict=True)
            for x in ends(row)
        )
    count = 0
    for k, row in enumerate(a):
        for x in ends(row):
            for y in ends(b[k]) if b is not None else (None,):
                args = (x,) if y is None else (x, y)
                count += _misses_at(found[k], op, args)
    return count


def _misses_at(result, op, args):
    if not np.all(np.isfinite(result)):
        return False
    if op == "div" and args[1] == 0:
        return True
    if op == "sqrt" and args[0] < 0:
        return True
    if op == "sign":
        return outside(result, Fraction(-1 if args[0] < 0 else 1))
    return outside(result, (EXACT.get(op) or BALLS[op])(*args))


def numbers(rng, kind, count=COUNT, radii=(-60, -1), least=-3, most=3):
    """Balls of many sizes; a third are points, a third have radii far below the midpoint, the rest large ones."""
    mid = rng.choice([-1.0, 1.0], count) * np.exp2(rng.uniform(least, most, count))
    shares = [np.zeros(count), np.exp2(rng.uniform(*radii, count)), rng.uniform(0, 1, count)]
    share = np.choose(rng.integers(0, 3, count), shares)
    radius = np.abs(mid) * share
    if kind == "ball":
        return np.stack([mid, radius], 1)
    low = mid * U * rng.uniform(-0.5, 0.5, count) * 0.99
    return np.stack([mid, low, np.abs(mid) * share], 1)


#: Each error term of the headers, halved. Not among them are those that others always outweigh, by their nature: the
#: rounding of an arc's last sum (its tangent has the errors of a sine and a cosine), the product of two rests, and the
#: factors that only make good the rounding of radii.
HALVED = halved(
    r"""
sum: MWC_FMA(⟦MWC_U⟧, mwc_abs(m), a.radius + b.radius));\n}\n\nMWI_INLINE mw_ball mwc_sub
radii of a sum: mwc_abs(m), ⟦a.radius + b.radius → 0.5 * (a.radius + b.radius)⟧));\n}\n\nMWI_INLINE mw_ball mwc_sub
difference: MWC_FMA(⟦MWC_U⟧, mwc_abs(m), a.radius + b.radius));\n}\n\nMWI_INLINE mw_ball mwc_neg
product: rounding = MWC_FMA(⟦MWC_U⟧, mwc_abs(m), MWC_TINY)
product, first: MWC_FMA(⟦mwc_abs(a.mid)⟧, b.radius, MWC_FMA(
product, second: MWC_FMA(MWC_READ, b.radius, ⟦mwc_abs(b.mid)⟧), rounding
product of radii: MWC_FMA(⟦MWC_READ⟧, b.radius, mwc_abs(b.mid)), rounding
square: MWC_FMA(⟦MWC_U⟧, m, MWC_TINY)
square, first: ⟦2.0 * mwc_abs → mwc_abs⟧(a.mid) + mwc_reach(a),
square, second: 2.0 * mwc_abs(a.mid) + ⟦mwc_reach(a)⟧,
underflow: MWC_TINY = ⟦9.881312916824931e-324 → 4.9406564584124654e-324⟧
quotient: spread + (⟦MWC_U⟧ * mwc_abs(q) + MWC_TINY)
quotient, divisor: ⟦mwc_abs(q) * (1.0 + 4.0 * MWC_U) → 0.5 * mwc_abs(q)⟧ * b.radius
quotient, dividend: * b.radius + ⟦a.radius⟧) / (least
quotient, least divisor: least = mwc_abs(b.mid) - ⟦mwc_reach(b)⟧;
root: / root + ⟦MWC_U⟧ * root
root, radius: ⟦a.radius * (1.0 + 8.0 * MWC_U) → 0.5 * a.radius⟧ / root
sine: MWC_SINE = ⟦2.220446049250313e-16 → 1.1102230246251565e-16⟧
sine, slope: turn.sine = mwc_where(near, s, ⟦(mwc_abs(c) + MWC_SINE) → 0.5 * mwc_abs(c)⟧ * a.radius
sine, bend: bend = ⟦0.5 → 0.25⟧ * a.radius * mwc_reach(a)
cosine, slope: turn.cosine = mwc_where(near, c, ⟦(mwc_abs(s) + MWC_SINE) → 0.5 * mwc_abs(s)⟧ * a.radius
arc, radius: ⟦d.radius⟧ + MWC_FMA(MWC_U, mwc_abs(m), cube)
wide sum: (a.radius + b.radius) + ⟦MWC_U⟧ * (mwc_abs(c) + mwc_abs(low))
wide product: ⟦MWC_U⟧ * (mwc_abs(c) + mwc_abs(d) + mwc_abs(cross) + mwc_abs(low))
wide quotient: ⟦left / (least * (1.0 - 8.0 * MWC_U)) → 0.5 * left / least⟧
wide root: joined(s.hi, s.lo, ⟦left⟧ / least)
wide sine, slope: by_sine = ⟦mwc_wide_most(*cosine)⟧ * d + 0.5 * d * d
"""
)


@pytest.fixture(scope="module")
def arithmetic(tmp_path_factory):
    return compiled(tmp_path_factory.mktemp("arithmetic"))


@pytest.fixture(scope="module")
def halved(tmp_path_factory):
    return compiled(tmp_path_factory.mktemp("halved"), {term: [change] for term, change in HALVED.items()})


def cases(kind, rng):
    """(operation, first, second) with arguments that bring every error term to bear."""
    a, b = numbers(rng, kind), numbers(rng, kind)
    for op in ("add", "sub", "mul", "div", "atan2"):
        yield op, a, b
    yield "sqr", a, None
    yield "neg", a, None
    yield "sign", a, None
    yield "sqrt", np.abs(a), None
    yield "magnitude", a, None
    yield "magnitude", numbers(rng, kind, radii=(-2, 4)), None  # of either sign
    angles = numbers(rng, kind, radii=(-60, -20), least=-6, most=9)
    yield "sincos", angles, None
    extremes = np.concatenate([np.arange(-8, 9) * np.pi / 2, np.arange(-8, 9) * np.pi / 4])
    wide = np.stack([extremes, *([np.zeros_like(extremes)] * (kind == "wide")), np.full_like(extremes, 0.01)], 1)
    yield "sincos", wide, None
    yield "sincos", numbers(rng, kind, least=-110, most=-0.4), None
    if kind == "wide":  # both roundings of a sum at their largest
        points = [numbers(rng, kind, 8 * COUNT, least=-1, most=1) * [1.0, 1.0, 0.0] for _ in range(2)]
        yield "add", *points
    if kind == "ball":
        far = rng.uniform(1e5, 1e6, 8 * COUNT)  # both roundings of the reduction at their largest
        yield "sincos", np.stack([far, np.zeros_like(far)], 1), None
        least = 2.0**-1074
        tiny = rng.integers(1, 40, (COUNT, 2)) * least
        factor = np.stack([rng.uniform(0.1, 1.0, COUNT), rng.uniform(0.05, 0.5, COUNT)], 1)
        yield "mul", tiny, factor


@pytest.mark.parametrize("kind", ["ball", "wide"])
def test_every_operation_encloses_the_exact_result(arithmetic, kind):
    for op, a, b in cases(kind, np.random.default_rng(1)):
        assert misses(arithmetic["exact"], kind, op, a, b) == 0, op


def test_results_are_no_wider_than_rounding_makes_them(arithmetic):
    rng = np.random.default_rng(2)
    points = numbers(rng, "ball") * [1.0, 0.0]
    for op in ("add", "mul", "div"):
        result = arithmetic["exact"]("ball", op, points, points[::-1])
        assert np.all(result[:, 1] <= 1.001 * U * np.abs(result[:, 0]) + 1e-320)
    wide = numbers(rng, "wide") * [1.0, 1.0, 0.0]
    for op in ("mul", "div", "sqrt"):
        result = arithmetic["exact"]("wide", op, np.abs(wide), np.abs(wide[::-1]))
        assert np.all(result[:, 2] <= 16 * U * U * np.abs(result[:, 0]))


def test_the_sine_of_a_small_angle_is_known_to_a_share_of_itself(arithmetic):
    small = np.stack([10.0 ** np.arange(-300.0, 0.0), np.zeros(300)], 1)
    sine, _ = arithmetic["exact"]("ball", "sincos", small)
    assert np.all(sine[:, 1] <= 2.1 * U * sine[:, 0])


def test_what_is_not_defined_everywhere_holds_everything(arithmetic):
    across, none = np.array([[0.1, 0.2]]), np.array([[np.nan, 0.0]])
    one, negative = np.array([[1.0, 0.0]]), np.array([[-1.0, 0.1]])
    run = arithmetic["exact"]
    for found in (
        run("ball", "div", one, across), run("ball", "sqrt", across), run("ball", "sign", across),
        run("ball", "atan2", across, negative), run("ball", "atan2", across, across),
        run("ball", "sincos", np.array([[1e7, 0.0]]))[0], run("ball", "sqrt", negative),
        run("ball", "add", none, one), run("ball", "sqrt", none), run("ball", "sign", none),
    ):  # fmt: skip
        assert not np.isfinite(found[0, 1]) or np.isnan(found[0, 0])


def operation_of(term):
    """The operation that an error term belongs to."""
    words = {"sum": "add", "difference": "sub", "product": "mul", "square": "sqr", "underflow": "mul",
             "quotient": "div", "root": "sqrt", "sine": "sincos", "cosine": "sincos", "arc": "atan2"}  # fmt: skip
    term = term.removeprefix("wide ").removeprefix("radii of a ")
    return next(op for word, op in words.items() if term.startswith(word))


def test_terms_of_the_wide_series_are_inverse_factorials_within_their_radii():
    text = (C / "certify" / "wide.h").read_text(encoding="utf-8")
    for name, first in (("SINE", 1), ("COSINE", 0)):
        rows = re.search(rf"MWC_OF_{name}\[\] = \{{\n(.*?)\n\}}", text, re.DOTALL).group(1)
        more = re.search(rf"MWC_MORE_OF_{name}\[\] = \{{\n(.*?)\n\}}", text, re.DOTALL).group(1)
        terms = [[Fraction(float(x)) for x in row.split(",")] for row in re.findall(r"\{ (.*) \}", rows)]
        assert len(terms) == 11
        for k, (high, low, radius) in enumerate(terms):
            off = abs(Fraction(1, math.factorial(first + 2 * k)) - high - low)
            assert off <= radius <= 2 * off
        single = [float(x) for x in more.split(",")]
        assert single == [1 / math.factorial(first + 22 + 2 * k) for k in range(6)]


def test_the_constants_are_what_the_bounds_were_proved_for():
    text = (C / "certify" / "wide.h").read_text(encoding="utf-8")
    high, low, radius = map(float, re.search(r"MWC_HALF_PI = \{ (.*), (.*), (.*) \}", text).groups())
    off = abs(flint.arb.pi() / 2 - flint.arb(high) - flint.arb(low))
    assert radius / 2 < off < radius
    text = (C / "circular.h").read_text(encoding="utf-8")
    found = re.search(r"a - k \* (\S+)\) - k \* (\S+)\) - k \* (\S+);", text).groups()
    parts = [Fraction(float(x)) for x in found]
    assert all((x * 2**80).denominator == 1 and x.numerator.bit_length() <= 33 for x in parts[:2])
    assert abs(flint.arb.pi() / 2 - arb(sum(parts))) < flint.arb(2) ** -118
    for name, first in (("u", 3), ("v", 4)):
        series = re.search(rf"const double {name} = (.*?);", text, re.DOTALL).group(1)
        coefficients = [float(x) for x in re.findall(r"-?\d+\.\d+(?:e-\d+)?", series)]
        signs = [(-1) ** (k + (name == "u")) for k in range(8)]
        assert coefficients == [s / math.factorial(first + 2 * k) for k, s in enumerate(signs)]


def test_the_angle_of_a_point_is_within_its_bound(tmp_path):
    """In every octant, on the axes and the diagonals, at any distance of the two coordinates."""
    angles, rng = compiled(tmp_path)["exact"].angles, np.random.default_rng(11)
    y, x = rng.choice([-1.0, 1.0], (2, 2000)) * np.exp2(rng.uniform(-60, 60, (2, 2000)))
    y[:400] = x[:400] * rng.choice([-1.0, 1.0], 400) * (1.0 + 2.0 ** rng.uniform(-50, -1, 400))
    y[400:404], x[400:404] = (0.0, 1.0, 0.0, -1.0), (1.0, 0.0, -1.0, 0.0)
    for one, *point in zip(angles(y, x), y, x, strict=True):
        assert abs(flint.arb(one) - flint.arb.atan2(*map(flint.arb, point))) < flint.arb(2) ** -50, point


@pytest.mark.validate
@pytest.mark.parametrize("term", HALVED)
def test_half_an_error_term_is_too_little(halved, term):
    kind, wanted = "wide" if term.startswith("wide") else "ball", operation_of(term)
    assert any(
        misses(halved[term], kind, op, a, b) > 0
        for seed in range(8)
        for op, a, b in cases(kind, np.random.default_rng(seed))
        if op == wanted
    )
