"""Radii beside middles, bounds for whole domains and the test that uses them: what they must hold, exactly judged, and
no error term could be smaller by half.
"""

import ctypes
from fractions import Fraction

import numpy as np
import pytest

from tests.certified.arithmetic import C, halved, header, library_of
from tests.certified.test_arithmetic import cases, misses, numbers
from tests.certified.test_proof import LANES, D, N, systems

pytestmark = pytest.mark.usefixtures("many_digits")

#: Operations of a harness that takes balls: the middle is that of the ball, the radius what is tested.
OPERATIONS = {
    "add": "m = a.mid + b.mid; r = MWC_U * mwc_units_sum(ra, rb, m); v = mwc_bound_sum(A, B);",
    "sub": "m = a.mid - b.mid; r = MWC_U * mwc_units_sum(ra, rb, m); v = mwc_bound_sum(A, B);",
    "mul": "m = a.mid * b.mid; r = MWC_U * mwc_units_product(a.mid, ra, b.mid, rb, m); v = mwc_bound_product(A, B);",
    "sqr": "m = a.mid * a.mid; r = MWC_U * mwc_units_square(a.mid, ra, m); v = mwc_bound_product(A, A);",
    "div": "m = a.mid / b.mid; r = MWC_U * mwc_units_quotient(ra, b.mid, rb, m); v = mwc_bound_quotient(A, B, B.most);",
    "sqrt": "m = sqrt(a.mid); r = MWC_U * mwc_units_root(ra, m); v = mwc_bound_root(A, A.most);",
    "sign": "m = a.mid < 0.0 ? -1.0 : 1.0; v = mwc_bound_sign(A, A.most); r = v.radius;",
    "atan2": "const mw_ball near = mwc_atan2(mwc_units_ball(a.mid, ra), mwc_units_ball(b.mid, rb));"
    " m = near.mid; r = near.radius; v = mwc_bound_angle(A, B, mwc_uncut(a.mid, b.mid));",
    "sine": "double c; mwi_sine(a.mid, &m, &c); r = MWC_U * mwc_units_turned(ra, c, mwc_units_size(a.mid, m));"
    " v = mwc_bound_sine(A);",
    "cosine": "double s; mwi_sine(a.mid, &s, &m); r = MWC_U * mwc_units_turned(ra, s, 1.0); v = mwc_bound_cosine(A);",
}  # fmt: skip
#: Products of which more is known: the first factor exact, both, the second's largest size.
PRODUCTS = {
    "share": "r = MWC_U * mwc_units_share(a.mid, rb, m);",
    "rounded": "r = MWC_U * mwc_units_rounded(m);",
    "scaled": "r = MWC_U * mwc_units_scaled(a.mid, ra, mwc_abs(b.mid) + mwc_reach(b), rb, m);",
}

_RUN = """
void {name}(int n, const mw_ball *first, const mw_ball *second, double *middle, double *radius, mwc_bound *bound)
{{
    for (int k = 0; k < n; k++) {{
        const mw_ball a = first[k], b = second[k];
        const double ra = MWC_UNITS * a.radius, rb = MWC_UNITS * b.radius;
        mwc_bound A = {{ mwc_abs(a.mid), a.radius }}, B = {{ mwc_abs(b.mid), b.radius }}, v = {{ 0.0, 0.0 }};
        double m = 0.0, r = 0.0;
        (void)ra, (void)rb, (void)A, (void)B;
        {body}
        middle[k] = m, radius[k] = r + MWC_TINY, bound[k] = v;
    }}
}}
"""

_ORDER = """
void order(const double *J, int *rows)
{{
    mwc_order({n}, J, rows);
}}

double mwc_units_rounded_of(double m)
{{
    return mwc_units_rounded(m);
}}
"""

_SETTLE = """
void settle_{lanes}(const double *d, const double *wide, const double *R, const double *J, double *proved, double *e)
{{
    mwc_domain of;
    of.n = {n};
    for (int i = 0; i < {n}; i++) of.d[i] = d[i], of.inverse[i] = 1.0 / d[i], of.wide[i] = of.near[i] = wide[i];
    mwc_settle{lanes}({n}, &of, R, J, proved, e);
}}
"""

#: Error terms, halved. Not among them: the radii of the arc of an angle, for which test_arithmetic.py cares, the error
#: of its middle, which is far below its bound, factors that only make good the rounding of radii, and in the test the
#: share of an elimination's rounding, to which no elimination comes near.
HALVED = {
    term: (header, *change)
    for header, terms in {
        "units.h": """
add radii: ⟦(ra + rb)⟧ + mwc_abs(m)
add rounding: (ra + rb) + ⟦mwc_abs(m)⟧
rounded: return ⟦mwc_abs(m)⟧ + MWC_UNITS_TINY;
share: MWC_FMA(⟦mwc_abs(a)⟧, rb, mwc_units_rounded(m))
scaled first: MWC_FMA(⟦mwc_abs(a)⟧, rb, MWC_FMA(ra
scaled second: MWC_FMA(ra, ⟦most⟧,
mul second: MWC_FMA(MWC_UNITS_READ, rb, ⟦mwc_abs(b)⟧), rb
mul radii: MWC_FMA(⟦MWC_UNITS_READ⟧, rb, mwc_abs(b)), rb
sqr first: ⟦2.0 * mwc_abs → mwc_abs⟧(a) + MWC_UNITS_READ * ra
sqr second: 2.0 * mwc_abs(a) + ⟦MWC_UNITS_READ⟧ * ra
div divisor: ⟦mwc_abs(m) * (1.0 + 4.0 * MWC_U) → 0.5 * mwc_abs(m)⟧ * rb
div dividend: * rb + ⟦ra⟧)
div least: mwc_abs(b) - ⟦MWC_UNITS_READ⟧ * rb
div rounding: spread + ⟦mwc_units_rounded(m)⟧
sqrt radius: ⟦ra * (1.0 + 8.0 * MWC_U) → 0.5 * ra⟧ / m
sqrt rounding: / m + ⟦mwc_abs(m)⟧
sine slope: ⟦(mwc_abs(slope) + MWC_SINE) → 0.5 * mwc_abs(slope)⟧ + bend
sine bend: bend = ⟦0.5 → 0.25⟧ * MWC_UNITS_READ
sine rounding: ⟦2.0 * size → size⟧ + MWC_UNITS_TINY
""",
        "domain.h": r"""
bound add radii: ⟦a.radius + b.radius → 0.5 * (a.radius + b.radius)⟧ + MWC_U * most
bound add rounding: a.radius + b.radius + ⟦MWC_U⟧ * most
bound mul first: ⟦a.most⟧ * b.radius + a.radius
bound mul second: (⟦b.most⟧ + mwc_bound_reach(b))
bound mul radii: (b.most + ⟦mwc_bound_reach(b)⟧)
bound mul rounding: + (⟦MWC_U⟧ * most + MWC_TINY));\n}\n\nMWI_INLINE mwc_bound mwc_bound_quotient
bound div divisor: (⟦most⟧ * b.radius + a.radius) / (rest
bound div dividend: (most * b.radius + ⟦a.radius⟧) / (rest
bound div least: rest = least - ⟦mwc_bound_reach(b)⟧, most
bound div rounding: spread + (⟦MWC_U⟧ * most
bound sqrt radius: ⟦a.radius * (1.0 + 8.0 * MWC_U) → 0.5 * a.radius⟧ / sqrt(least)
bound sqrt rounding: / sqrt(least) + ⟦MWC_U⟧ * most
bound sine radius: ⟦a.radius⟧ + (MWC_SINE * size + MWC_TINY)
bound sine rounding: a.radius + (⟦MWC_SINE⟧ * size + MWC_TINY)
bound sine, cosine: ⟦a.radius⟧ * (slope < 1.0 ? slope : 1.0)
bound sine, size: const double slope = ⟦a.most⟧ + mwc_bound_reach(a);
bound atan2 radius: ⟦off / (rest * (1.0 - 8.0 * MWC_U)) → 0.5 * off / rest⟧
bound sign: least - ⟦mwc_bound_reach(a)⟧ > 0.0, 1.0
""",
        "settle.h": """
settle residual: MWC_FMA(⟦MWC_UNITS_READ⟧, entry.radius
settle shift: e[l] += ⟦mwc_abs(sum[l])⟧;
settle Jacobian: MWC_FMA(⟦part[l]⟧, bound, off[k][l])
settle image: above[l], ⟦of->wide[i]⟧ + most[i][l]);
""",
    }.items()
    for term, change in halved(terms).items()
}


def compiled(folder, change=None):
    """The harness of the headers as they are, or with one text of one of them replaced."""
    for name in ("ball.h", "lane.h", "wide.h", "run.h", "tables.h", "units.h", "domain.h", "settle.h"):
        place = folder / "certify" / name
        place.parent.mkdir(exist_ok=True)
        place.write_text(header(name, change[1:] if change and change[0] == name else None), encoding="utf-8")
    for name in ("circular.h", "mw_enclosures.h", "mw_certified.h"):
        (folder / name).write_text((C / name).read_text(encoding="utf-8"), encoding="utf-8")
    bodies = OPERATIONS | {name: f"m = a.mid * b.mid; {body}" for name, body in PRODUCTS.items()}
    parts = ['#include "certify/wide.h"\n#include "certify/domain.h"\n']
    parts += [_RUN.format(name=f"run_{name}", body=body) for name, body in bodies.items()]
    parts.append(_ORDER.format(n=N))
    for lanes in LANES:
        text = f'#include "certify/settle.h"\n{_SETTLE.format(lanes=lanes, n=N)}'
        parts.append(f"#define MW_LANES {lanes}\n{text}#undef MW_LANES\n")
    return library_of(folder, "".join(parts), folder)


class Radii:
    """The harness as an arithmetic of balls, for :func:`tests.certified.test_arithmetic.misses`. ``bounds``: with the
    radii of a domain that holds the one point alone.
    """

    def __init__(self, loaded, bounds):
        self._loaded, self._bounds = loaded, bounds

    def __call__(self, kind, op, a, b=None):
        if op == "sincos":
            return self._run("sine", a, a), self._run("cosine", a, a)
        return self._run(op, a, a if b is None else b)

    def _run(self, op, a, b):
        a, b = (np.ascontiguousarray(x, dtype=float) for x in (a, b))
        middle, radius, bound = np.empty(len(a)), np.empty(len(a)), np.empty((len(a), 2))
        pointers = (x.ctypes.data_as(D) for x in (a, b, middle, radius, bound))
        getattr(self._loaded, f"run_{op}")(len(a), *pointers)
        if self._bounds:
            assert np.all(bound[:, 0] >= np.abs(middle))
        return np.stack([middle, bound[:, 1] if self._bounds else radius], 1)


def missed(loaded, seed, wanted=None):
    """Number of results outside of what is said of them, by operation ``wanted`` alone if one is."""
    rng, count = np.random.default_rng(seed), 0
    for op, a, b in cases("ball", rng):
        if op in ("neg", "magnitude") or wanted not in (None, op):
            continue
        for bounds in (False, True):
            count += misses(Radii(loaded, bounds), "ball", op, a, b)
    if wanted in (None, "sign"):
        count += misses(Radii(loaded, True), "ball", "sign", numbers(rng, "ball", radii=(-2, 4)))  # of either sign
    for op in PRODUCTS:
        if wanted in (None, "mul"):
            a, b = numbers(rng, "ball"), numbers(rng, "ball")
            a[:, 1] *= op == "scaled"
            b[:, 1] *= op != "rounded"
            count += misses(_Named(loaded, op), "ball", "mul", a, b)
    return count


class _Named(Radii):
    """One of :data:`PRODUCTS`."""

    def __init__(self, loaded, name):
        super().__init__(loaded, bounds=False)
        self._name = name

    def __call__(self, kind, op, a, b=None):
        return self._run(self._name, a, b)


def settled(loaded, lanes, R, J, d, wide):
    """Whether each of ``lanes`` systems is proved, and the bounds (lanes,) of their last unknowns."""
    R = np.stack([R[..., 0], R[..., 1] * 2.0**53], -1)
    mine = [np.ascontiguousarray(np.moveaxis(a, 0, -1)) for a in (R, J[..., 0])]
    shown, e = np.empty(lanes), np.empty(lanes)
    arrays = (np.ascontiguousarray(d), np.ascontiguousarray(wide), *mine, shown, e)
    getattr(loaded, f"settle_{lanes}")(*(a.ctypes.data_as(D) for a in arrays))
    return shown > 0.0, e


def ordered(loaded, R, J):
    """Both with the rows in the order that the first system needs."""
    rows = np.empty(N, np.int32)
    loaded.order(np.ascontiguousarray(J[0, :, 0]).ctypes.data_as(D), rows.ctypes.data_as(ctypes.POINTER(ctypes.c_int)))
    assert sorted(rows) == [*range(N)]
    at = np.argsort(rows)
    return R[:, at], J.reshape(-1, N, N, 2)[:, at].reshape(J.shape)


def wrong(loaded, lanes, seed, decoupled):
    """(number of proved systems, number of those whose last unknown or whose box is not what is said)."""
    rng, shown, off = np.random.default_rng(seed), 0, 0
    for _ in range(160 if decoupled else 40):
        R, J, exact = systems(rng, lanes, decoupled)
        largest = [max(abs(float(x[i])) for x in exact) for i in range(N)]
        d = np.array(largest) * (rng.choice([0.99, 1.3]) if decoupled else 300.0)
        R, J = ordered(loaded, R, J)
        entries = (J[..., 1] + 9 * 2.0**-53 * np.abs(J[..., 0])).reshape(lanes, N, N)
        wide = 1.0000001 * np.max(entries @ d, axis=0)
        ok, e = settled(loaded, lanes, R, J, d, wide)
        for k in np.flatnonzero(ok):
            shown += 1
            outside = any(abs(x) > Fraction(float(side)) for x, side in zip(exact[k], d, strict=True))
            off += outside or abs(exact[k][N - 1]) > Fraction(float(e[k]))
    return shown, off


@pytest.fixture(scope="module")
def loaded(tmp_path_factory):
    return compiled(tmp_path_factory.mktemp("domain"))


def test_radii_and_bounds_enclose_the_exact_results(loaded):
    assert missed(loaded, 1) == 0


def test_what_underflow_loses_is_covered_and_no_more(loaded):
    rounded = loaded.mwc_units_rounded_of
    rounded.argtypes, rounded.restype = [ctypes.c_double], ctypes.c_double
    rng, least, shares = np.random.default_rng(3), 2.0**-1074, []
    for _ in range(500):
        a, b = float(rng.integers(1, 40)) * least, float(rng.uniform(0.1, 1.0))
        off = abs(Fraction(a) * Fraction(b) - Fraction(a * b))
        shares.append(off * 2**53 / Fraction(rounded(a * b)))
    assert 0.5 < max(shares) <= 1


@pytest.mark.parametrize("lanes", LANES)
@pytest.mark.parametrize("decoupled", [True, False])
def test_the_exact_solution_lies_within_the_bound_of_its_last_unknown(loaded, lanes, decoupled):
    shown, off = wrong(loaded, lanes, 1, decoupled)
    assert shown >= 20 and off == 0


def test_a_singular_or_undefined_system_is_never_proved(loaded):
    R, J, d, wide = np.zeros((1, N, 2)), np.zeros((1, N * N, 2)), np.ones(N), np.full(N, 1e-9)
    for value in (0.0, np.nan, np.inf, 1e300):
        J[..., 0] = value
        assert not settled(loaded, 1, R, J, d, wide)[0][0]
    J[..., 0] = np.eye(N).ravel()
    assert settled(loaded, 1, R, J, d, wide)[0][0]
    for radius in (np.nan, np.inf):
        R[0, 2, 1] = radius
        assert not settled(loaded, 1, R, J, d, wide)[0][0]
        R[0, 2, 1] = 0.0
        assert not settled(loaded, 1, R, J, d, np.where(np.arange(N) == 1, radius, wide))[0][0]


@pytest.mark.validate
@pytest.mark.parametrize("term", HALVED)
def test_half_an_error_term_is_too_little(tmp_path, term):
    changed, word = compiled(tmp_path, HALVED[term]), term.removeprefix("bound ").replace(",", " ").split()[0]
    if word == "settle":
        assert any(wrong(changed, 1, seed, decoupled)[1] for seed in range(3) for decoupled in (True, False))
    else:
        wanted = {"sine": "sincos", "share": "mul", "scaled": "mul", "rounded": "mul"}.get(word, word)
        assert any(missed(changed, seed, wanted) for seed in range(8))
