"""The equations by common means, which the benchmarks compare with, are the same equations."""

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
