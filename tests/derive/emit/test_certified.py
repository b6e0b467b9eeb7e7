"""Instructions for ball arithmetic, carried out with numbers, give the values of the tape."""

import math

import pytest
import sympy as sp

from derive.emit.certified import OPERATIONS, TooDeep, code
from derive.passes.quotients import reciprocals
from derive.program.routine import routine
from tests.derive.small import VALUES, lowered, p, x, y

_APPLY = {
    "add": lambda a, b: a + b, "sub": lambda a, b: a - b, "mul": lambda a, b: a * b, "sqr": lambda a, _: a * a,
    "div": lambda a, b: a / b, "neg": lambda a, _: -a, "sqrt": lambda a, _: math.sqrt(a), "atan2": math.atan2,
    "magnitude": lambda a, _: abs(a),
}  # fmt: skip


def run(made, arguments):
    registers = [arguments[k] for k in made.inputs] + [high + low for high, low, _ in made.constants]
    registers += [math.nan] * (made.registers - len(registers))
    for number, result, first, second in made.instructions:
        op = OPERATIONS[number]
        if op == "sincos":
            registers[result], registers[second] = math.sin(registers[first]), math.cos(registers[first])
        else:
            registers[result] = _APPLY[op](registers[first], registers[second])
    return [registers[k] for k in made.outputs]


def test_registers_are_used_again_without_losing_a_value():
    expressions = (sp.sin(x * y) * sp.cos(x * y) - p, sp.sqrt(x**2 + p) / y, sp.atan2(y, x) ** 2)
    tape, lower, nodes = lowered(*expressions)
    symbols = (x, y, p)
    made = code(reciprocals(routine(tape, nodes)), {lower(s): k for k, s in enumerate(symbols)})
    exact = [float(e.subs(VALUES)) for e in expressions]
    assert run(made, [VALUES[s] for s in symbols]) == pytest.approx(exact, rel=1e-14)
    assert made.registers < len(made.inputs) + len(made.constants) + len(made.instructions)


def test_a_number_times_its_sign_is_a_magnitude():
    tape, lower, nodes = lowered(sp.Abs(x) - sp.sqrt(y), sp.Abs(x - y))
    made = code(reciprocals(routine(tape, nodes)), {lower(x): 0, lower(y): 1})
    operations = [OPERATIONS[number] for number, *_ in made.instructions]
    assert operations.count("magnitude") == 2 and "sign" not in operations
    assert run(made, [-3.0, 4.0]) == [1.0, 7.0]


def test_a_constant_that_is_no_double_has_a_radius():
    tape, lower, nodes = lowered(x * sp.pi)
    ((high, low, radius),) = code(reciprocals(routine(tape, nodes)), {lower(x): 0}).constants
    assert high == math.pi and abs(low) < 2.0**-52 and 0.0 < radius < 1e-30


def test_a_chain_that_is_rounded_too_often_is_refused():
    tape, lower, (node,) = lowered(x)
    for _ in range(700):
        node = tape.sqrt(tape.add(node, lower(y)))
    with pytest.raises(TooDeep, match="in two functions"):
        code(reciprocals(routine(tape, [node])), {lower(x): 0, lower(y): 1})
