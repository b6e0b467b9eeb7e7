"""Binding times: what is kept for a design depends on that alone, what is kept for an angle not on the unknowns."""

import pytest

from derive.passes import check
from derive.program.tape import Stage
from tests.derive.small import plan


def test_the_state_is_known_before_it_is_read():
    made = plan()
    slots = list(made.state)
    assert {made.tape.stages[i] for i in slots[: made.design_slots]} <= {Stage.CONSTANT, Stage.DESIGN}
    assert {made.tape.stages[i] for i in slots} <= {Stage.CONSTANT, Stage.DESIGN, Stage.INSTANT}


def test_a_value_that_is_not_kept_is_caught():
    made = plan()
    slots = list(made.state)
    check.bound("step", made.tape, made.newton_step, slots, {Stage.ITERATE})
    with pytest.raises(check.PassError, match="binding times: step computes node"):
        check.bound("step", made.tape, made.newton_step, slots[1:], {Stage.ITERATE})
