"""Programs are compared modulo a prime: what computes the same passes, one wrong operation does not."""

from dataclasses import replace

import pytest
import sympy as sp

from derive.passes import check
from derive.program.routine import routine
from derive.program.tape import Stage
from tests.derive.small import lowered, p, program, x, y

EVERY = sp.sqrt(x * y + p) / (y - p) + sp.atan2(x, y) * sp.cos(x) - sp.sin(x + y) * sp.Abs(x) + sp.pi / 3


def test_equal_programs_written_in_other_ways_have_equal_residues():
    tape, _, (product, difference) = lowered((x + y) * (x - y), x**2 - y**2)
    assert product != difference
    one, other = (check.residues(routine(tape, [i])) for i in (product, difference))
    assert one == other


def test_odd_and_even_functions_keep_their_symmetry():
    tape, lower, (a,) = lowered(x - y)
    b = tape._new("sub", (lower(y), lower(x)))  # the opposite, which the tape would write as −a
    odd = check.residues(routine(tape, [tape.sin(a), tape.sin(b), tape.cos(a), tape.cos(b)]))
    assert (odd[0] + odd[1]) % check._prime() == 0 and odd[2] == odd[3]


def test_slopes_of_every_operation_are_those_of_the_chain_rule():
    tape, lower, (node,) = lowered(EVERY)
    inputs = [lower(s) for s in (x, y, p)]
    slopes = [tape.derivative(node, i) for i in inputs]
    check.derives("test", tape, [node], inputs, [slopes])
    for k in range(3):
        wrong = [tape.add(s, tape.constant(1)) if k == j else s for j, s in enumerate(slopes)]
        with pytest.raises(check.PassError, match=f"test: entry 0, {k}"):
            check.derives("test", tape, [node], inputs, [wrong])


def test_a_change_along_a_direction_is_the_sum_of_slopes():
    tape, lower, (node, one, other) = lowered(EVERY, x - p, y)
    a, b = lower(x), lower(y)
    along = tape.add(tape.mul(tape.derivative(node, a), one), tape.mul(tape.derivative(node, b), other))
    check.moves("test", tape, [node], {a: one, b: other}, [along])
    with pytest.raises(check.PassError, match="test: entry 0 is not the derivative along the direction"):
        check.moves("test", tape, [node], {a: other, b: one}, [along])


def test_linear_equations_are_put_in():
    tape, _, (a, b, r) = lowered(x, y, p)
    unknown = tape.div(tape.sub(r, b), a)
    check.solves("test", tape, [[a]], [unknown], [tape.sub(r, b)])
    with pytest.raises(check.PassError, match="test: equation 0 is not solved"):
        check.solves("test", tape, [[a]], [unknown], [r])


def test_a_routine_returns_what_it_returned():
    made = program(EVERY, x * y)
    assert check.same("test", made, made) is made
    with pytest.raises(check.PassError, match="test: a routine computes other values"):
        check.same("test", made, replace(made, outputs=made.outputs[::-1]))


def test_what_is_computed_at_another_time_is_caught():
    tape, lower, (node,) = lowered(p * p + x)
    check.bound("test", tape, [node], [lower(p * p)], {Stage.ITERATE})
    with pytest.raises(check.PassError, match="test computes node"):
        check.bound("test", tape, [node], [], {Stage.ITERATE})
