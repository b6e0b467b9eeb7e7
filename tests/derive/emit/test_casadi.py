"""The CasADi functions compute what the tape does, at the sample's contact and beside it."""

import casadi
import numpy as np
import pytest

from derive.emit import casadi as printer
from tests.derive.small import plan


def test_residual_and_guards_are_those_of_the_tape():
    made = plan()
    function = printer.function(made)
    drive = made.drive
    x = np.array([float(made.sample[u]) for u in made.unknowns]) + 0.01
    inputs = {s: float(v) for s, v in made.sample.items()} | dict(zip(made.unknowns, x, strict=True))
    parameters = [inputs[p.symbol] for p in drive.parameters]
    found = function(p=parameters, phi=inputs[drive.instant], x=x)
    assert np.array(found["residual"]).ravel() == pytest.approx(made.tape.evaluate(made.residual, inputs), abs=1e-11)
    guards = made.tape.evaluate([g.node for g in made.guards], inputs)
    assert np.array(found["guards"]).ravel() == pytest.approx(guards, rel=1e-13)


def test_a_sign_is_one_at_zero_and_above():
    s = casadi.SX.sym("s")
    sign = casadi.Function("sign", [s], [printer._Symbolic.sign(s)])
    assert [float(sign(v)) for v in (-2.0, 0.0, 3.0)] == [-1.0, 1.0, 1.0]
