"""A design system on its tape: with homotopy any guess solves it where the path begins; where it ends it is itself."""

import pytest

from derive.language.drive import PATH, DesignSystem
from derive.language.symbols import Quantity, Unknown
from derive.passes import check
from derive.passes.completion import at_end, lower_system
from derive.program.tape import Tape

size, given, other = Quantity("m", "mm"), Quantity("a", "mm"), Quantity("b", "mm")


def system(**more):
    return DesignSystem(
        name="size", unknowns=(Unknown(size, given),), residual=(size**2 - given,), guess={size: given / 2},
        fills={other: 2 * size}, message="none", keys=("b",), **more,
    )  # fmt: skip


class _Given:
    symbol = given


@pytest.mark.parametrize(("path", "root"), [(0.0, 4.5), (1.0, 3.0)])
def test_the_path_leads_from_the_guess_to_the_solution(path, root):
    tape = lower_system(system(homotopy=True), [_Given])
    inputs = {given: 9.0, size: root, PATH: path}
    assert tape.tape.evaluate(tape.residual, inputs) == [pytest.approx(0.0, abs=1e-14)]
    assert tape.tape.evaluate(tape.values, inputs) == [2.0 * root]
    assert tape.unknowns == [size] and tape.watch is None


def test_the_slope_is_that_of_the_equation():
    tape = lower_system(system(), [_Given])
    assert tape.tape.evaluate(tape.jacobian[0], {given: 9.0, size: 5.0}) == [10.0]


def test_at_its_end_a_path_leaves_the_equation_itself_on_a_tape_of_its_own():
    tape = lower_system(system(homotopy=True), [_Given])
    count, ended = len(tape.tape.nodes), at_end(tape)
    assert len(tape.tape.nodes) == count
    assert ended.tape.inputs_of([*ended.residual, *ended.jacobian[0]]) == {given, size}
    assert ended.tape.evaluate(ended.residual, {given: 9.0, size: 5.0}) == [16.0]
    assert ended.tape.evaluate(ended.jacobian[0], {given: 9.0, size: 5.0}) == [10.0]


def test_a_wrong_slope_is_caught(monkeypatch):
    monkeypatch.setattr(Tape, "derivative", lambda tape, node, variable: tape.constant(1))
    with pytest.raises(check.PassError, match="design system size: entry 0, 0"):
        lower_system(system(), [_Given])
