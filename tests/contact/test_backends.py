"""Generated C against CasADi: residual and Jacobian of the same tape, derivatives found in two different ways."""

import sys
from functools import cache

import casadi
import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.library import SHIPPED, ffi
from meshwright.cli import main
from meshwright.contact import casadi_backend
from meshwright.design import design


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
    for angle in drive.design.reference_angle + np.linspace(-0.3, 0.3, 5) * drive.pitch():
        x, _ = drive.trace([angle])
        point = x[0] + 1e-3 * rng.standard_normal(drive.model.nx)
        r, j = _compiled(drive, drive.state(angle), point)
        r_casadi, j_casadi = (np.asarray(a) for a in exact(drive.design.parameters, angle, point))
        scale = np.abs(j_casadi).max(axis=1, keepdims=True)
        scale[scale == 0.0] = 1.0  # spur gears touch along a line: an equation that nothing changes
        assert np.abs((j - j_casadi) / scale).max() < 1e-14
        assert np.abs((r - r_casadi.ravel()) / scale.ravel()).max() < 1e-12


@pytest.mark.parametrize(("name", "calls"), [("setup", 0), ("step", 7), ("step", 27), ("set_phi", 9)])
def test_an_exception_in_a_function_that_c_calls_reaches_the_caller(monkeypatch, name, calls):
    """C goes on with not-a-number; a number found without the function must not come out as a result."""
    original, left = getattr(casadi_backend._Arithmetic, name), [calls]

    def interrupted(self, *arguments):
        left[0] -= 1
        if left[0] == -1:
            raise KeyboardInterrupt
        return original(self, *arguments)

    monkeypatch.setattr(casadi_backend._Arithmetic, name, interrupted)
    monkeypatch.setattr(casadi_backend, "_table", cache(casadi_backend._table.__wrapped__))
    drive = Drive.load("recess-action-full", backend="casadi")
    with pytest.raises(KeyboardInterrupt):
        drive.tca(np.linspace(-0.5, 0.5, 9))
    assert Drive.load("recess-action-full", backend="casadi").tca([0.0]).complete


def test_a_backend_that_is_not_installed_is_named_with_what_brings_it(monkeypatch, capsys):
    monkeypatch.setattr(casadi_backend, "_table", cache(casadi_backend._table.__wrapped__))
    monkeypatch.setitem(sys.modules, "casadi", None)
    assert main(["tca", "recess-action-full", "--phi-deg", "0", "--backend", "casadi"]) == 2
    message = capsys.readouterr().err
    assert "casadi is not installed" in message and "meshwright[casadi]" in message
