"""Singular points of the equations of contact, against 50 digits."""

import mpmath
import numpy as np
import pytest

from derive import drives
from derive.passes.schedule import schedule
from meshwright import Drive
from meshwright.contact.branch import STEP, follow, turning_point


@pytest.fixture(scope="module")
def equations():
    """Residual of the zk-zn-90 drive in 60 digits as a function of (unknowns, input angle), its unknowns scaled."""
    drive = Drive.load("zk-zn-90")
    name = drive.design.description["name"]
    plan = schedule(drives.catalogue([name])[name]())
    run = plan.tape.evaluator(plan.residual, mpmath)
    keys = [*plan.unknowns, plan.drive.instant]

    def residual(parameters, y):
        given = {p.symbol: mpmath.mpf(float(v)) for p, v in zip(plan.drive.parameters, parameters, strict=True)}
        return mpmath.matrix(run(given | dict(zip(keys, y, strict=True))))

    return residual


def _derivative(residual, y):
    step, columns = mpmath.mpf(10) ** -20, []
    for k in range(len(y)):
        ends = [residual([v + share * step * (j == k) for j, v in enumerate(y)]) for share in (1, -1)]
        columns.append((ends[0] - ends[1]) / (2 * step))
    return mpmath.matrix([[column[i] for column in columns] for i in range(len(columns[0]))])


def _polished(residual, y, columns):
    """(y, ψ, μ) with R + μψ = 0, ψ∂R/∂y = 0 in these columns, |ψ| = 1, by Newton's method on differences."""
    n, unfolded = len(y) - 1, columns > len(y) - 1
    matrix = _derivative(residual, y)[:, :columns]
    psi = mpmath.svd_r(matrix * matrix.T)[0][:, n - 1]
    z = mpmath.matrix([*y, *psi, *([0] * unfolded)])

    def extended(z):
        y, psi, mu = list(z[: n + 1]), mpmath.matrix(z[n + 1 : 2 * n + 1]), z[2 * n + 1] if unfolded else 0
        matrix = _derivative(residual, y)[:, :columns]
        return mpmath.matrix([*(residual(y) + mu * psi), *(matrix.T * psi), (mpmath.fdot(psi, psi) - 1) / 2])

    jacobian = _derivative(lambda z: extended(mpmath.matrix(z)), list(z))
    for _ in range(8):
        change = mpmath.lu_solve(jacobian, extended(z))
        z -= change
        if mpmath.norm(change) < mpmath.mpf(10) ** -30:
            return z
        jacobian = _derivative(lambda z: extended(mpmath.matrix(z)), list(z))
    raise AssertionError("no singular point")


@pytest.mark.validate
def test_the_pitchfork_of_crossed_axes_is_found_to_round_off(equations):
    drive = Drive.load("zk-zn-90")
    (point,) = drive.limits().branch_points
    found = drive.contacts(point.angle - 1e-3)
    middle = found.solutions[np.argmin(np.linalg.norm(found.points - point.point, axis=1))]
    with mpmath.workdps(60):
        start = [*map(mpmath.mpf, map(float, middle)), mpmath.mpf(point.angle)]
        z = _polished(lambda y: equations(drive.design.parameters, y), start, len(start))
        assert abs(z[len(start) - 1] - mpmath.mpf(point.angle)) < 1e-12
        assert abs(z[len(z) - 1]) < 1e-13  # a right angle in binary unfolds it by no more


def test_a_fold_is_found_to_round_off(equations):
    drive = Drive.load("zk-zn-90").with_(misalignment={"center_distance_mm": 0.02})
    start = np.radians(-60.0)
    solution = drive.contacts(start).solutions[0]
    branch = follow(drive, start, solution, STEP, 150)
    angle, x = turning_point(drive, branch, branch.turns[0])
    with mpmath.workdps(60):
        y = [*map(mpmath.mpf, map(float, x)), mpmath.mpf(angle)]
        z = _polished(lambda y: equations(drive.design.parameters, y), y, len(y) - 1)
        assert abs(z[len(y) - 1] - mpmath.mpf(angle)) < 1e-12
