"""Expressions in numbers: at given values, through definitions, with the functions that a description may use."""

import mpmath
import pytest
import sympy as sp

from derive.language.choice import excess, unit_step
from derive.language.definitions import Definitions
from derive.language.differentiate import partial
from derive.language.sampled import value_of, vanishes
from derive.language.symbols import Quantity

x, y = Quantity("x", "mm", "a length"), Quantity("y", "mm", "another")


def test_a_value_follows_definitions():
    definitions = Definitions()
    square = definitions.let("square", x**2 + y)
    assert value_of(square * sp.Rational(1, 3), {x: 3.0, y: mpmath.mpf(2)}, definitions) == mpmath.mpf(11) / 3


@pytest.mark.parametrize("number", [-0.75, 0.5])
def test_functions_have_the_values_and_slopes_of_floating_point(number):
    steep = 1e-6
    for function in (sp.sin, sp.cos, sp.tan, sp.atan, sp.asin, sp.acos, sp.Abs, excess, sp.sign, unit_step):
        values = [value_of(function(x), {x: number + change}, Definitions()) for change in (-steep, steep)]
        slope = value_of(partial(function(x), x), {x: number}, Definitions())
        assert float((values[1] - values[0]) / (2 * steep)) == pytest.approx(float(slope), abs=1e-9)


def test_an_identity_vanishes_and_a_slip_does_not():
    assert vanishes(sp.sin(x) ** 2 + sp.cos(x) ** 2 - 1)
    assert not vanishes(sp.sin(x) ** 2 + sp.cos(x) ** 2 - 1 + x / 10**9)
