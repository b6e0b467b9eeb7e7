"""The equations of a drive hold at its sample's contact, to which the start system leads."""

import mpmath
import pytest
import sympy as sp

from derive.passes.equations import fixed
from tests.derive.small import VALUES, lowered, p, plan, x, y


def test_the_equations_hold_at_the_contact_of_the_sample():
    made = plan()
    with mpmath.workdps(30):
        residual = made.tape.evaluate(made.residual, made.sample, mpmath)
        start = made.tape.evaluate(made.start_residual, made.sample, mpmath)
        sizes = made.tape.evaluate(made.scales, made.sample, mpmath)
    assert len(residual) == len(made.unknowns) == len(sizes) and max(map(abs, residual)) < 1e-25
    assert max(map(abs, start), default=0) < 1e-25 and min(sizes) > 0


def test_rules_on_their_own_tapes_and_together_are_the_same():
    made = plan()
    inputs = {q.symbol: 0.3 + 0.01 * k for k, q in enumerate(made.drive.parameters)}
    together = made.completion.tape.evaluate(made.completion.nodes, inputs)
    alone = [value for rule in made.rules for value in rule.tape.evaluate(rule.nodes, inputs)]
    assert len(alone) == len(made.drive.completion) and together == pytest.approx(alone, rel=1e-14)


def test_a_symbol_is_fixed_wherever_it_stands():
    expression = sp.sin(x) * y + x * p
    tape, lower, (node,) = lowered(expression)
    found = fixed(lower, node, {x: 2 * p})
    assert tape.inputs_of([found]) == {p, y}
    assert tape.evaluate([found], VALUES)[0] == pytest.approx(float(expression.subs(x, 2 * p).subs(VALUES)))
