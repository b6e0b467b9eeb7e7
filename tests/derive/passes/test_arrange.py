"""Generated functions as routines compute what the tape does, and a part goes on where the one before it ends."""

from dataclasses import replace

import sympy as sp

from derive.passes import arrange as arranging
from derive.passes import check, guards
from derive.passes.arrange import arrange, fused, side_by_side
from derive.passes.guards import Evaluated
from derive.passes.order import order
from derive.program.routine import routine
from tests.derive.small import lowered, p, plan, x, y


def test_every_function_computes_what_the_tape_does():
    made = plan()
    functions = [*guards.functions(made), *guards.moving(made), *guards.bounded(made)]
    routines = arrange(made, functions)
    for f in functions:
        if f.tape is made.tape and f.key != "setup":
            outputs = [i for part in routines[f.key] for i in part.outputs]
            assert outputs[: len(f.outputs)] == f.outputs
            values = [v for part in routines[f.key] for v in check.residues(part)]
            assert values == check.residues(routine(f.tape, outputs, f.known))
    assert len(routines["derive"]) == len(made.rules) and len(routines["setup"]) == 2


def test_a_part_that_goes_on_computes_nothing_again():
    tape, lower, nodes = lowered(sp.sin(x * y), sp.cos(x * y) * p + sp.sin(x * y))
    f = Evaluated("f", tape, lower, (tuple(nodes),), frozenset(), "result", leading=1)
    first, second = arrange(plan(), [f])["f"]
    assert [step.op for _, step in first.steps] == ["mul", "sin"]
    assert [step.op for _, step in second.steps] == ["fma"]  # the cosine comes with the sine


def test_quotients_of_what_follows_count_for_what_comes_first():
    tape, lower, nodes = lowered(x / y, 1 / y)
    whole = Evaluated("f", tape, lower, (tuple(nodes),), frozenset(), "result")
    alone, parts = (arrange(plan(), [f])["f"] for f in (whole, replace(whole, leading=1)))
    assert len(alone) == 1 and check.residues(alone[0]) == [v for part in parts for v in check.residues(part)]
    assert [step.op for _, step in parts[0].steps] == ["div", "mul"] and not parts[1].steps


def test_what_is_seldom_called_stays_in_the_order_of_its_tape_and_is_compiled_as_it_stands_where_long(monkeypatch):
    made = plan()
    functions = [f for f in guards.functions(made) if f.name in ("observe", "step")]
    kept = {f.name: fused(routine(f.tape, arrange(made, [f])[f.key][0].outputs, f.known)) for f in functions}
    placed = {name: arrange(made, functions)[name][0] for name in kept}
    assert placed["observe"] == kept["observe"] and placed["step"] == order(kept["step"]) != kept["step"]
    monkeypatch.setattr(arranging, "LONG", 1)
    assert {name: arrange(made, functions)[name][0].long for name in kept} == {"observe": True, "step": False}


def test_two_lanes_take_the_same_operations():
    step = side_by_side(plan())
    first, second = ([i for k, i in step.places if k == copy] for copy in (0, 1))
    assert sorted(first) == sorted(second) and step.places[0][0] == 0


def test_a_function_of_a_description_is_not_taken_for_one_that_every_drive_has():
    tape, lower, nodes = lowered(x + y, x * y)
    every, own = (Evaluated("eval", tape, lower, ((i,),), frozenset(), "result") for i in nodes)
    routines = arrange(plan(), [every, replace(own, of="function")])
    assert [routines[key][0].outputs for key in ("eval", "function eval")] == [(i,) for i in nodes]
