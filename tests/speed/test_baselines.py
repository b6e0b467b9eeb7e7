"""The equations by common means, which the benchmarks compare with, are the same equations."""

import casadi
import numpy as np
import pytest

from derive import drives
from derive.passes.schedule import schedule
from tests.benchmarks import baselines, bench
from tests.quick import quick


@pytest.mark.parametrize(("design", "first", "step"), quick(bench.CASES, *bench.CASES[:3]))
def test_lambdified_residual_vanishes_at_the_points_of_the_runtime(design, first, step):
    case = bench.case_of(design, first, step)
    plan = schedule(drives.catalogue()[case.name]())
    residual = baselines.lambdified(plan.drive, plan.unknowns)
    for phi, x in zip(case.angles[:3], case.points[:3], strict=True):
        np.testing.assert_allclose(np.array(residual(x, phi, case.parameters), float), 0.0, atol=1e-9)
        assert np.abs(np.array(residual(x + 1e-3, phi, case.parameters), float)).max() > 1e-6


@pytest.mark.parametrize(("design", "first", "step"), bench.CASES)
def test_the_chain_of_the_description_by_casadi_alone_has_the_contact_of_the_runtime(design, first, step):
    """Matrices, equations of meshing left as they are, derivatives and Newton's method by CasADi."""
    case = bench.case_of(design, first, step)
    chain = bench.Chained.of(case).chain
    assert len(chain.names) >= len(case.start)
    solver = casadi.rootfinder("solver", "fast_newton", chain.function, {"abstol": 1e-11, "abstolStep": 1e-9})
    x = np.array(chain.start(case.angles[0], case.start)) + 1e-5
    for phi, solution in zip(case.angles[:3], case.points[:3], strict=True):
        x = np.array(solver(x, [*chain.numbers, phi])).ravel()
        np.testing.assert_allclose(x, chain.start(phi, solution), rtol=0.0, atol=1e-9)


def test_the_chain_leaves_the_equations_of_meshing_to_casadi():
    unknowns = bench.Chained.of(bench.case_of("helical-crowned", -0.1, 1e-5)).chain.names
    assert {"phi_gen_pinion", "phi_gen_wheel"} < set(unknowns) and len(unknowns) == 7
