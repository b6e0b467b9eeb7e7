"""The tape: value numbering, the forward chain rule, stages and printing of numbers."""

import math

import mpmath
import pytest
import sympy as sp

from derive.emit import c99
from derive.language.choice import excess
from derive.language.definitions import Definitions
from derive.program.lowering import Lowering
from derive.program.tape import Stage, Tape

x, y, p = sp.symbols("x y p", real=True)
INPUTS = {p: Stage.DESIGN, x: Stage.ITERATE, y: Stage.ITERATE}
VALUES = {x: 0.8, y: -1.7, p: 2.3}

EXPRESSIONS = [
    x * sp.cos(y) - p * sp.sin(x * y),
    sp.sqrt(x**2 + p) / (y - p),
    sp.atan2(y * p, x) * x**-3,
    sp.tan(x) - sp.asin(x / 2) + sp.acos(x / p) + sp.atan(y),
    (x + y) ** 5 / sp.sqrt(p) - sp.Rational(2, 7) * x,
    sp.Abs(y) * x,
]


def _lower(expression, definitions=None):
    tape = Tape()
    return tape, Lowering(tape, INPUTS, definitions)(expression)


@pytest.mark.parametrize("expression", EXPRESSIONS)
def test_values_are_those_of_sympy(expression):
    tape, node = _lower(expression)
    assert tape.evaluate([node], VALUES)[0] == pytest.approx(float(expression.subs(VALUES)), rel=1e-14)


@pytest.mark.parametrize("expression", EXPRESSIONS)
@pytest.mark.parametrize("variable", [x, y, p])
def test_derivatives_are_those_of_sympy(expression, variable):
    tape, node = _lower(expression)
    derivative = tape.derivative(node, tape.input(variable, INPUTS[variable]))
    exact = float(sp.diff(expression, variable).subs(VALUES).doit())
    assert tape.evaluate([derivative], VALUES)[0] == pytest.approx(exact, rel=1e-13, abs=1e-14)


def test_equal_values_have_one_node():
    tape = Tape()
    lower = Lowering(tape, INPUTS)
    assert lower(x * y + p) == lower(p + y * x)
    assert lower(sp.sin(x - y)) == tape.neg(lower(sp.sin(y - x)))


def test_what_is_known_early_is_folded_before_what_is_known_late():
    tape, node = _lower(x * p * sp.sin(p) * y)
    stages = [tape.stages[i] for i in tape.needed([node])]
    assert stages.count(Stage.DESIGN) == 2
    assert stages.count(Stage.ITERATE) == 2


def test_definitions_are_followed_by_values_and_derivatives():
    definitions = Definitions()
    inner = definitions.let("inner", sp.sin(x) * p)
    expression = inner**2 + y
    tape, node = _lower(expression, definitions)
    assert tape.evaluate([node], VALUES)[0] == pytest.approx((math.sin(0.8) * 2.3) ** 2 - 1.7)
    total = definitions.derivative(expression, x)
    tape, node = _lower(total, definitions)
    assert tape.evaluate([node], VALUES)[0] == pytest.approx(2 * math.sin(0.8) * math.cos(0.8) * 2.3**2)


def test_a_name_means_one_thing():
    definitions = Definitions()
    definitions.let("inner", x + 1)
    with pytest.raises(ValueError, match="already used"):
        definitions.let("inner", x + 2)


def test_substitution_replaces_inputs():
    tape, node = _lower(x**2 + p)
    replaced = tape.substitute(node, {tape.input(x, Stage.ITERATE): tape.input(p, Stage.DESIGN)})
    assert tape.evaluate([replaced], VALUES)[0] == pytest.approx(2.3**2 + 2.3)
    assert tape.stages[replaced] == Stage.DESIGN


def test_any_arithmetic_will_do():
    tape, node = _lower(sp.sqrt(x) * sp.pi)
    with mpmath.workdps(40):
        (value,) = tape.evaluate([node], {x: mpmath.mpf(2)}, mpmath)
        assert isinstance(value, mpmath.mpf)


@pytest.mark.parametrize("value", [0.1, 1 / 3, 1e-300, 123456789.123456789, 2.0, math.pi])
def test_printed_numbers_read_back_exactly(value):
    assert float(c99.number(value)) == value


def test_absolute_values_and_excesses_have_derivatives_where_they_bend():
    tape = Tape()
    lower = Lowering(tape, {x: Stage.ITERATE})
    size, above = lower(sp.Abs(x)), lower(excess(x) ** 3)
    outputs = [size, above, tape.derivative(size, lower(x)), tape.derivative(above, lower(x))]
    for value in (-2.0, 0.0, 3.0):
        found = tape.evaluate(outputs, {x: value})
        assert found == [abs(value), max(value, 0) ** 3, -1 if value < 0 else 1, 3 * max(value, 0) ** 2]
