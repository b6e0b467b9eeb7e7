"""The tangent of a value along a direction is the sum of its slopes times the direction's components."""

import pytest
import sympy as sp

from derive.passes.directional import Derivatives
from tests.derive.small import VALUES, lowered, x, y


def test_the_tangent_is_the_directional_derivative():
    f = sp.sin(x * y) / (x**2 + 1)
    tape, lower, (node,) = lowered(f)
    tangent = Derivatives(tape, {lower(x): tape.constant(1), lower(y): tape.constant(2)})(node)
    exact = (sp.diff(f, x) + 2 * sp.diff(f, y)).subs(VALUES)
    assert tape.evaluate([tangent], VALUES)[0] == pytest.approx(float(exact), rel=1e-14)


def test_what_does_not_depend_on_the_direction_has_no_tangent():
    tape, lower, (node,) = lowered(sp.cos(y))
    assert tape.const_value(Derivatives(tape, {lower(x): tape.constant(1)})(node)) == 0
