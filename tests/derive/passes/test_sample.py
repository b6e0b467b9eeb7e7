"""The sample's Newton iteration: all of 40 digits after doubles, and directions that no equation sees stay put."""

import math

import mpmath
import pytest
import sympy as sp

from derive.passes.sample import Equations, in_double, observation, solution, solve
from tests.derive.small import lowered, p, plan, x


def test_a_root_is_found_to_all_digits():
    tape, lower, (residual,) = lowered(x**2 - p)
    with mpmath.workdps(40):
        inputs = {p: mpmath.mpf(2), x: mpmath.mpf(1)}
        Equations(tape, [residual], [[tape.derivative(residual, lower(x))]], [x], "the system").solve(inputs, mpmath)
        assert abs(inputs[x] - mpmath.sqrt(2)) < mpmath.mpf(10) ** -38


def test_without_a_root_it_says_which_sample_does_not_converge():
    tape, lower, (residual,) = lowered(x**2 + 1)
    with pytest.raises(ArithmeticError, match=r"the system of the sample does not converge in \[x\]"):
        equations = Equations(tape, [residual], [[tape.derivative(residual, lower(x))]], [x], "the system")
        equations.solve({x: mpmath.mpf("0.7")}, mpmath)


def test_what_needs_a_root_of_a_negative_number_is_said_to_leave_the_real_numbers():
    tape, lower, (residual,) = lowered(sp.sqrt(x) + 1)
    equations = Equations(tape, [residual], [[tape.derivative(residual, lower(x))]], [x], "the system")
    with pytest.raises(ArithmeticError, match="the system leaves the real numbers at the sample"):
        equations.solve({x: mpmath.mpf(1)}, mpmath)


def test_equations_that_contradict_one_another_have_no_solution_where_no_change_is_left():
    tape, lower, residual = lowered(x - p, x - 2 * p)
    rows = [[tape.derivative(r, lower(x)), tape.constant(0)] for r in residual]
    with pytest.raises(ArithmeticError, match="the system of the sample does not converge"):
        Equations(tape, residual, rows, [x, p], "the system").solve({p: mpmath.mpf(2), x: mpmath.mpf(1)}, mpmath)


def test_what_nothing_gives_is_named():
    tape, lower, (residual,) = lowered(x**2 - p)
    equations = Equations(tape, [residual], [[tape.derivative(residual, lower(x))]], [x], "the system")
    with pytest.raises(ArithmeticError, match=r"the system of the sample needs p .*, which nothing gives"):
        equations.solve({p: mpmath.nan, x: mpmath.mpf(1)}, mpmath)


def test_a_division_by_zero_is_said_to_be_one():
    tape, lower, (residual,) = lowered(1 / x - p)
    equations = Equations(tape, [residual], [[tape.derivative(residual, lower(x))]], [x], "the system")
    with pytest.raises(ArithmeticError, match="the system divides by zero or overflows at the sample"):
        equations.solve({p: mpmath.mpf(2), x: mpmath.mpf(0)}, mpmath)


def test_doubles_are_enough_where_they_are_asked_for():
    tape, lower, (residual,) = lowered(x**2 - p)
    inputs = {p: 2.0, x: 1.0}
    Equations(tape, [residual], [[tape.derivative(residual, lower(x))]], [x], "the system").solve(inputs, math)
    assert inputs[x] == pytest.approx(math.sqrt(2.0), abs=1e-15)


def test_a_direction_that_the_equations_do_not_see_stays_put():
    """x + y = 3 twice: the change solves it by the one unknown, and leaves the other."""
    rows = [[mpmath.mpf(1), mpmath.mpf(1), mpmath.mpf(3)]] * 2
    change = solution(rows, mpmath.mpf)
    assert sum(change) == 3 and 0 in change


def test_the_sample_of_a_drive_is_a_contact():
    made = plan()
    numbers = made.tape.evaluate(made.residual, made.sample, mpmath)
    assert max(map(abs, numbers)) < mpmath.mpf(10) ** -12
    normal = observation(made)["normal_pinion_f"]
    assert sum(n * n for n in normal) == pytest.approx(1.0, abs=1e-14)


def test_another_angle_has_a_contact_of_its_own():
    made = plan()
    with mpmath.workdps(40):
        moved = solve(made, {p.symbol: made.sample[p.symbol] for p in made.drive.parameters}, 0.01)
        assert max(map(abs, made.tape.evaluate(made.residual, moved, mpmath))) < mpmath.mpf(10) ** -20
    assert in_double(moved) != in_double(made.sample)


