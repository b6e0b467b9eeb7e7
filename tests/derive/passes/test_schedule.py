"""Binding times: what is kept for a design depends on that alone, what is kept for an angle not on the unknowns."""

from derive.program.tape import Stage
from tests.derive.small import plan


def test_the_state_is_known_before_it_is_read():
    made = plan()
    slots = list(made.state)
    assert {made.tape.stages[i] for i in slots[: made.design_slots]} <= {Stage.CONSTANT, Stage.DESIGN}
    assert {made.tape.stages[i] for i in slots} <= {Stage.CONSTANT, Stage.DESIGN, Stage.INSTANT}


def test_a_newton_step_at_the_solution_goes_nowhere():
    made = plan()
    n = len(made.unknowns)
    changes = made.tape.evaluate(made.change, made.sample)
    assert len(changes) == n and max(map(abs, map(float, changes))) < 1e-12
