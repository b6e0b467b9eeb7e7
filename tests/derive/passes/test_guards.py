"""Guards hold at the sample design, and every operation that is not defined everywhere has one."""

from derive.passes import guards
from tests.derive.small import plan


def test_the_sample_passes_every_guard():
    made = plan()
    values = made.tape.evaluate([g.node for g in made.guards], made.sample)
    assert values and min(values) > 0.0


def test_every_condition_names_what_answers_where_it_fails():
    made = plan()
    functions = list(guards.functions(made))
    assert {f.guard for f in functions} <= set(guards.GUARDS)
    assert [f.name for f in functions if f.name in guards.EARLY] == ["setup", "setup", "set_phi"]
    assert {"eval", "step", "observe"} <= {f.name for f in functions}
