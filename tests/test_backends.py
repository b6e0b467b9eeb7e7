"""Generated C against CasADi: residual and Jacobian of the same tape, derivatives found in two different ways."""

from functools import cache

import casadi
import mpmath
import numpy as np
import pytest

from derive import drives
from derive.schedule import schedule
from meshwright import Drive, design
from meshwright._library import SHIPPED, ffi


def _compiled(drive, s, x):
    n = drive.model.nx
    residual, jacobian = np.empty(n), np.empty((n, n))
    pointers = (ffi.from_buffer("double[]", a) for a in (s, x, residual, jacobian))
    drive.model.eval(*pointers)
    return residual, jacobian


@cache
def _plan(name):
    return schedule(drives.catalogue()[name]())


def _exact(drive, angle, point):
    """The Jacobian in 50 digits."""
    plan = _plan(drive.design.description["name"])
    with mpmath.workdps(50):
        numbers = [*drive.design.parameters, angle, *point]
        symbols = [*(p.symbol for p in plan.drive.parameters), plan.drive.instant, *plan.unknowns]
        inputs = {s: mpmath.mpf(float(v)) for s, v in zip(symbols, numbers, strict=True)}
        values = plan.tape.evaluate([e for row in plan.jacobian for e in row], inputs, mpmath)
    return np.array(values, dtype=object).reshape(drive.model.nx, drive.model.nx)


@pytest.mark.parametrize("name", design.packaged_names())
def test_jacobian_agrees_with_casadi_automatic_differentiation_and_fifty_digits(name):
    """Relative to the largest entry: small ones are differences of large ones, in double precision in any order."""
    drive = Drive.load(name)
    function = casadi.Function.load(str(SHIPPED / f"{drive.design.description['name']}.casadi"))
    p, phi, x = (casadi.SX.sym(n, k) for n, k in zip("pax", (drive.model.np, 1, drive.model.nx), strict=True))
    residual = function(p, phi, x)[0]
    exact = casadi.Function("exact", [p, phi, x], [residual, casadi.jacobian(residual, x)])
    rng = np.random.default_rng(1)
    for angle in np.linspace(-0.3, 0.3, 5) * drive.pitch():
        x, _ = drive.trace([angle])
        point = x[0] + 1e-3 * rng.standard_normal(drive.model.nx)
        r, j = _compiled(drive, drive.state(angle), point)
        r_casadi, j_casadi = (np.asarray(a) for a in exact(drive.design.parameters, angle, point))
        scale = np.abs(j_casadi).max(axis=1, keepdims=True)
        largest = np.abs(j_casadi).max()
        assert np.abs(j - j_casadi).max() < 1e-14 * largest
        assert np.abs(j - _exact(drive, angle, point)).max() < 1e-14 * largest
        assert np.abs((r - r_casadi.ravel()) / scale.ravel()).max() < 1e-12
