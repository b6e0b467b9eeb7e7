"""What is read on a flank is checked where it is made: a wrong slope goes no further."""

import pytest

from derive.passes import check
from derive.passes.flanks import expansion, second_form, slopes
from derive.program.tape import Tape
from tests.derive.small import plan


def _flat(tape, node, variable):
    return tape.constant(0)


def test_an_expansion_is_that_of_its_flank():
    made = plan()
    assert expansion(made, made.flanks[0], second=True) == made.expansions[0]
    assert not expansion(made, made.flanks[0], second=False).second


def test_a_wrong_slope_of_a_limit_is_caught(monkeypatch):
    made = plan()
    monkeypatch.setattr(Tape, "derivative", _flat)
    with pytest.raises(check.PassError, match="expansion: entry"):
        expansion(made, made.flanks[0], second=False)


def test_a_wrong_tangent_or_turning_of_the_normal_is_caught(monkeypatch):
    made = plan()
    body = made.drive.pinion
    basis = next(o.nodes for o in made.flanks[0].curvature if o.name == "tangent_basis")
    assert len(second_form(made, body.surface, (basis[:3], basis[3:]))) == 3
    monkeypatch.setattr(Tape, "derivative", _flat)
    with pytest.raises(check.PassError, match="geometry: entry"):
        second_form(made, body.surface, (basis[:3], basis[3:]))


def test_a_surface_has_a_row_of_slopes_for_each_condition():
    made = plan()
    for body in made.drive.bodies:
        rows = slopes(made, body.surface)
        assert [len(row) for row in rows] == [len(body.surface.parameters)] * len(body.surface.conditions)
