"""C that is printed means what the tape computes: read back as an expression it has the same value."""

import math
import re

import pytest
import sympy as sp

from derive.emit.c99 import Printer, estrin
from derive.passes.arrange import fused
from derive.passes.order import order
from derive.program.names import Names
from derive.program.routine import routine
from tests.derive.small import VALUES, lowered, p, x, y


def value(body, result, **names):
    """What C statements compute, as Python reads them."""
    known = {
        "MW_FMA": lambda a, b, c: a * b + c, "MW_FMS": lambda a, b, c: a * b - c,
        "MW_FNMA": lambda a, b, c: c - a * b, "sqrt": math.sqrt, **names,
    }  # fmt: skip
    for statement in body.statements:
        declared = re.fullmatch(r"(?:const )?double (\w+) = (.+);", statement)
        assert declared, statement
        known[declared[1]] = eval(declared[2], known)
    return eval(result, known)


@pytest.mark.parametrize("count", [1, 2, 3, 5, 8])
def test_estrin_is_the_polynomial(count):
    coefficients = [(-1) ** k / (k + 1) for k in range(count)]
    body = estrin("e", "z", coefficients)
    assert value(body, body.results[0], z=0.3) == pytest.approx(sum(c * 0.3**k for k, c in enumerate(coefficients)))


def test_statements_compute_the_nodes():
    expressions = (x * y + p, sp.sqrt(x**2 + p) / (y - p))
    tape, lower, nodes = lowered(*expressions)
    leaves = {lower(s): str(s) for s in (x, y, p)}
    body = Printer(Names(tape, {}), "none", leaves).body(fused(routine(tape, nodes)))[0]
    numbers = {str(s): v for s, v in VALUES.items()}
    for result, expression in zip(body.results, expressions, strict=True):
        assert value(body, result, **numbers) == pytest.approx(float(expression.subs(VALUES)), rel=1e-15)
    assert body.operations == 7  # a sum that takes a product counts as two


def test_a_function_that_is_printed_in_another_order_computes_the_same():
    expression = (x * y + p) * sp.sqrt(x**2 + p) - y / (x + p)
    tape, lower, nodes = lowered(expression)
    leaves, numbers = {lower(s): str(s) for s in (x, y, p)}, {str(s): v for s, v in VALUES.items()}
    made = fused(routine(tape, nodes))
    bodies = [Printer(Names(tape, {}), "none", leaves).body(each)[0] for each in (order(made), made)]
    assert len({value(body, body.results[0], **numbers) for body in bodies}) == 1
    assert sorted(bodies[0].statements) == sorted(bodies[1].statements)
