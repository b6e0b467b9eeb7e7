"""Krawczyk's test on linear systems whose solutions are known exactly, in one lane and in several."""

import ctypes
from fractions import Fraction

import numpy as np
import pytest

from tests.certified.arithmetic import halved, header, library_of

N, D = 5, ctypes.POINTER(ctypes.c_double)
LANES = (1, 4)

_PROVE = """
void prove_{lanes}(const double *R, const double *J, const double *d, double *proved, double *e)
{{
    double z[{n}][{lanes}], K[{n}][{lanes}];
    mwc_prove{lanes}({n}, R, J, d, proved, z, K, (double (*)[{lanes}])e);
}}
"""

#: Error terms of the test, halved. The bound of a sum of many products is not among them, as no such sum comes near it,
#: nor what doubles find for |I - C J|, which that bound outweighs.
HALVED = halved(
    """
residual: off[k][l] = MWC_FMA(⟦MWC_READ → 0.5⟧, entry.radius,
Jacobian: w[i][l] = MWC_FMA(⟦MWC_READ → 0.5⟧, entry.radius,
shift: z[i][l] = (⟦mwc_abs(sum[l])⟧ + radius[l]) * MWC_READ;
"""
)


def compiled(folder, replaced=None):
    """The test as it is, or with one text of its header replaced: number of lanes → function."""
    text = header("point.h", replaced).replace('#include "lane.h"', "")
    parts = ['#include "certify/lane.h"\n']
    for lanes in LANES:
        parts.append(f"#define MW_LANES {lanes}\n{text}\n{_PROVE.format(lanes=lanes, n=N)}\n#undef MW_LANES\n")
    library = library_of(folder, "".join(parts))
    return {lanes: getattr(library, f"prove_{lanes}") for lanes in LANES}


def proved(functions, lanes, R, J, d):
    """Whether each of ``lanes`` systems is proved, and its bounds e (lanes, N)."""
    mine = [np.ascontiguousarray(np.moveaxis(a, 0, -1)) for a in (R, J)]
    shown, e = np.empty(lanes), np.empty((N, lanes))
    functions[lanes](*(a.ctypes.data_as(D) for a in (*mine, np.ascontiguousarray(d), shown, e)))
    return shown > 0.0, e.T


def solved(A, b):
    """Exact solution of A x = b, fractions."""
    rows = [[*row, value] for row, value in zip(A, b, strict=True)]
    for k in range(N):
        pivot = max(range(k, N), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [v / rows[k][k] for v in rows[k]]
        for i in range(N):
            if i != k:
                rows[i] = [v - rows[i][k] * w for v, w in zip(rows[i], rows[k], strict=True)]
    return [row[-1] for row in rows]


def systems(rng, count, decoupled):
    """Balls R (count, N, 2) and J (count, N * N, 2), and the exact solutions of systems at the far ends of them."""
    R, J, exact = np.empty((count, N, 2)), np.empty((count, N * N, 2)), []
    for k in range(count):
        A = rng.uniform(-1, 1, (N, N)) * 10.0 ** rng.uniform(-3, 3, N)
        A = np.diag(rng.choice([0.5, 1.0, 2.0], N)) if decoupled else A
        r = rng.uniform(0.1, 1.0, N) * rng.choice([-1.0, 1.0], N)
        share = 0.25 if decoupled else 10.0 ** rng.uniform(-12, -3)
        radii = np.abs(A) * share, np.abs(r) * (1.0 if decoupled else share)
        R[k], J[k] = np.stack([r, radii[1]], 1), np.stack([A.ravel(), radii[0].ravel()], 1)
        # what puts the solution farthest where the equations are decoupled: J smaller, R larger
        ends = zip(A.ravel(), radii[0].ravel(), strict=True)
        true = [Fraction(a) - Fraction(radius) * int(np.sign(a)) for a, radius in ends]
        true = [true[N * i : N * i + N] for i in range(N)]
        off = [Fraction(r[i]) + Fraction(radii[1][i]) * int(np.sign(r[i])) for i in range(N)]
        exact.append(solved(true, [-v for v in off]))
    return R, J, exact


def wrong(functions, lanes, seed, decoupled):
    """(number of proved systems, number of those whose solution is not within the bounds)."""
    rng, shown, missed = np.random.default_rng(seed), 0, 0
    for _ in range(40):
        R, J, exact = systems(rng, lanes, decoupled)
        largest = [max(abs(float(x[i])) for x in exact) for i in range(N)]
        d = np.array(largest) * (1.3 if decoupled else 8.0)
        ok, e = proved(functions, lanes, R, J, d)
        for k in np.flatnonzero(ok):
            shown += 1
            missed += any(abs(exact[k][i]) > Fraction(float(e[k, i])) for i in range(N))
    return shown, missed


@pytest.fixture(scope="module")
def functions(tmp_path_factory):
    return compiled(tmp_path_factory.mktemp("proof"))


@pytest.mark.parametrize("lanes", LANES)
@pytest.mark.parametrize("decoupled", [True, False])
def test_the_exact_solution_lies_within_the_bounds(functions, lanes, decoupled):
    shown, missed = wrong(functions, lanes, 1, decoupled)
    assert shown >= 20 and missed == 0


def test_a_singular_or_undefined_system_is_never_proved(functions):
    R, J = np.zeros((1, N, 2)), np.zeros((1, N * N, 2))
    for value in (0.0, np.nan, np.inf):
        J[..., 0] = value
        assert not proved(functions, 1, R, J, np.ones(N))[0][0]
    J[..., 0] = np.eye(N).ravel()
    assert proved(functions, 1, R, J, np.ones(N))[0][0]
    for radius in (np.nan, np.inf):
        R[0, 2, 1] = radius
        assert not proved(functions, 1, R, J, np.ones(N))[0][0]


@pytest.mark.parametrize("term", HALVED)
def test_half_a_term_of_the_test_is_too_little(tmp_path, term):
    changed = compiled(tmp_path, HALVED[term])
    assert any(wrong(changed, 1, seed, decoupled)[1] for seed in range(3) for decoupled in (True, False))
