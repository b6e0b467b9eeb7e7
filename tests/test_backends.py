"""Generated C against CasADi: residual and Jacobian of the same tape, derivatives found in two different ways."""

import casadi
import numpy as np
import pytest

from meshwright import Drive, design
from meshwright._library import SHIPPED, ffi


def _compiled(drive, s, x):
    n = drive.model.nx
    residual, jacobian = np.empty(n), np.empty((n, n))
    pointers = (ffi.from_buffer("double[]", a) for a in (s, x, residual, jacobian))
    drive.model.eval(*pointers)
    return residual, jacobian


@pytest.mark.parametrize("name", design.packaged_names())
def test_jacobian_agrees_with_casadi_automatic_differentiation(name):
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
        assert np.abs((j - j_casadi) / scale).max() < 1e-14
        assert np.abs((r - r_casadi.ravel()) / scale.ravel()).max() < 1e-12
