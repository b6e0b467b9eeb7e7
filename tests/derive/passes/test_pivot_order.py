"""One Newton step solves linear equations exactly, in whatever order their pivots are taken."""

from types import SimpleNamespace

import pytest

from derive.passes.linearise import linearise
from derive.passes.pivot_order import newton_step
from tests.derive.small import VALUES, lowered, p, plan, x, y, z

SYMBOLS = (x, y, z)


def step(equations):
    tape, lower, residual = lowered(*equations)
    unknowns = [lower(s) for s in SYMBOLS[: len(equations)]]
    system = SimpleNamespace(
        tape=tape, lower=lower, residual=residual, unknowns=SYMBOLS[: len(equations)],
        scales=[tape.constant(1)] * len(equations), linear=linearise(tape, residual, unknowns),
    )  # fmt: skip
    return tape, newton_step(system, VALUES)[0]


@pytest.mark.parametrize(
    "equations",
    [
        (p * x + y - 3, x - p * y + 1),
        (y - 2, x + y + z - p, x - z),  # no pivot on the diagonal of the first row
        (1e-12 * x + y - 1, x + y - 2, z - x * p),  # a pivot that would lose all digits
    ],
)
def test_linear_equations_are_solved_in_one_step(equations):
    tape, updated = step(equations)
    solution = dict(zip(SYMBOLS, tape.evaluate(updated, VALUES), strict=False))
    for equation in equations:
        assert float(equation.subs({**VALUES, **solution})) == pytest.approx(0.0, abs=1e-11)


def test_an_unknown_in_no_equation_is_refused():
    with pytest.raises(ArithmeticError, match="occurs in no equation"):
        step((x - 1, x - p))


def test_a_newton_step_at_the_solution_goes_nowhere():
    made = plan()
    changes = made.tape.evaluate(made.change, made.sample)
    assert len(changes) == len(made.unknowns) and max(map(abs, map(float, changes))) < 1e-12
