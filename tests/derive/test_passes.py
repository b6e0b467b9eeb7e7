"""Passes keep the values of a program, and a pass that does not is caught; the program can be read after each."""

from dataclasses import FrozenInstanceError, replace

import pytest
import sympy as sp

from derive import command, drives
from derive.passes import check
from derive.passes.after import PASSES
from derive.passes.fuse import fuse
from derive.passes.order import order
from derive.passes.quotients import reciprocals
from derive.passes.schedule import schedule
from derive.program.routine import routine
from tests.derive import small
from tests.derive.small import lowered
from tests.quick import quick

DRIVE = "cylindrical_worm_zn_zn"
SYMBOLS = small.x, small.y
ROOT = sp.sqrt(small.y + 10)


@pytest.fixture(scope="module")
def plan():
    return schedule(drives.catalogue([DRIVE])[DRIVE]())


@pytest.fixture(scope="module")
def step(plan):
    return routine(plan.tape, plan.newton_step, frozenset(plan.state), name="step")


def test_each_pass_computes_the_same_and_fusing_leaves_fewer_steps(step):
    values = check.residues(step)
    for done in (reciprocals(step), fuse(reciprocals(step)), order(fuse(reciprocals(step)))):
        assert check.residues(done) == values
        assert len(done.steps) <= len(step.steps)
    assert len(fuse(step).steps) < len(step.steps) - 50


@pytest.mark.parametrize("wrong", ["add", "sub", "mul", "sin"])
def test_one_wrong_operation_is_caught(step, wrong):
    other = {"add": "sub", "sub": "add", "mul": "add", "sin": "cos"}[wrong]
    at = next(k for k, (_, operation) in enumerate(step.steps) if operation.op == wrong)
    i, operation = step.steps[at]
    harmed = replace(step, steps=(*step.steps[:at], (i, operation._replace(op=other)), *step.steps[at + 1 :]))
    with pytest.raises(check.PassError, match="step computes other values"):
        check.same("harm", step, harmed)


def test_an_operation_before_its_arguments_is_caught(step):
    last, before = step.steps[-1], step.steps[:-1]
    with pytest.raises(check.PassError):
        check.same("reverse", step, replace(step, steps=(last, *before)))


def test_another_order_has_the_same_operations_each_after_its_arguments(step):
    ordered = order(step)
    assert ordered.steps != step.steps and check.reordered("order", step, ordered) is ordered
    last, before = step.steps[-1], step.steps[:-1]
    with pytest.raises(check.PassError, match=r"step reads node \d+ before it is computed"):
        check.reordered("order", step, replace(step, steps=(last, *before)))
    for lost in (before, (*before, before[0]), (*before, (last[0], last[1]._replace(op="sign")))):
        with pytest.raises(check.PassError, match="step has other operations"):
            check.reordered("order", step, replace(step, steps=lost))


def test_a_product_subtracted_from_the_wrong_side_is_caught(step):
    fused = fuse(step)
    at = next(k for k, (_, operation) in enumerate(fused.steps) if operation.op == "fms")
    i, operation = fused.steps[at]
    harmed = (*fused.steps[:at], (i, operation._replace(op="fnma")), *fused.steps[at + 1 :])
    with pytest.raises(check.PassError):
        check.same("fuse", step, replace(fused, steps=harmed))


def test_a_wrong_entry_of_the_jacobian_and_a_wrong_step_are_caught(plan):
    unknowns, jacobian = [plan.lower(u) for u in plan.unknowns], [list(row) for row in plan.jacobian]
    check.derives("linearise", plan.tape, plan.residual, unknowns, jacobian)
    check.solves("pivot order", plan.tape, plan.jacobian, plan.change, plan.residual)
    jacobian[0][1], jacobian[0][0] = jacobian[0][0], jacobian[0][1]
    with pytest.raises(check.PassError, match="entry 0, 0"):
        check.derives("linearise", plan.tape, plan.residual, unknowns, jacobian)
    with pytest.raises(check.PassError, match="equation 0"):
        check.solves("pivot order", plan.tape, plan.jacobian, plan.change[::-1], plan.residual)


@pytest.mark.parametrize(
    ("value", "by_x", "by_y"),
    [
        (lambda t, x, y, wave, root: t.mul(y, t.add(*(t.mul(f, f) for f in wave))), lambda x, y: 0 * x, lambda x, y: 1),
        (lambda t, x, y, wave, root: t.mul(x, t.mul(root, root)), lambda x, y: y + 10, lambda x, y: x),
    ],
    ids=["by the circle", "by a root"],
)
def test_what_is_a_derivative_by_an_identity_alone_passes_and_what_is_none_does_not(value, by_x, by_y):
    """y (sin²x + cos²x) and x √(y + 10)²."""
    tape, lower, (x, y, sine, cosine, root) = lowered(*SYMBOLS, sp.sin(SYMBOLS[0]), sp.cos(SYMBOLS[0]), ROOT)
    values, slopes = [value(tape, x, y, (sine, cosine), root)], [lower(sp.sympify(s(*SYMBOLS))) for s in (by_x, by_y)]
    check.derives("right", tape, values, [x, y], [slopes])
    for wrong in ([slopes[0], tape.add(slopes[1], slopes[1])], [tape.add(slopes[0], y), slopes[1]]):
        with pytest.raises(check.PassError, match="wrong: entry 0, . is not the derivative"):
            check.derives("wrong", tape, values, [x, y], [wrong])


def test_a_routine_is_immutable(step):
    with pytest.raises(FrozenInstanceError):
        step.steps = ()


@pytest.mark.parametrize("after", PASSES)
def test_the_program_can_be_read_after_each_pass(after, capsys):
    assert command.main(["show", DRIVE, "--after", after]) == 0
    shown = capsys.readouterr().out
    assert "residual(" in shown or "eval(" in shown
    assert "return " in shown and "operations" in shown


def test_the_description_names_keys_rules_motions_and_equations(capsys):
    assert command.main(["show", DRIVE]) == 0
    shown = capsys.readouterr().out
    for words in ("design.normal_module_mm: m_n [mm]", "rotation about z by phi_worm", "limit tip:", "contact, each 0"):
        assert words in shown


@pytest.mark.parametrize(
    "drive", quick(["bevel_formate", "cylindrical_gears", "face_worm", "spherical_convex_spur"], "cylindrical_gears")
)
def test_the_description_of_every_family_can_be_read(drive, capsys):
    assert command.main(["show", drive]) == 0
    shown = capsys.readouterr().out
    for p in drives.catalogue([drive])[drive]().parameters:
        assert f"  {p.table}.{p.key}: {p.symbol.name}" in shown


def test_show_says_which_drives_there_are(capsys):
    assert command.main(["show", "nonsense"]) == 2
    assert "no drive 'nonsense'" in capsys.readouterr().err
