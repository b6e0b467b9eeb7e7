"""Tangents of a schedule are its slopes: against a difference in 40 digits along one misalignment."""

import mpmath
import pytest
import sympy as sp

from derive.passes import check
from derive.passes.tangents import differentiate
from tests.derive.small import plan


def test_the_tangent_of_the_residual_is_its_slope_along_a_parameter():
    made = differentiate(plan())
    moved = next(p.symbol for p in made.drive.parameters if p.table == "misalignment")
    tape, along = made.tape, {sp.Symbol(f"d_{p.symbol}"): 0 for p in made.drive.parameters}
    along[sp.Symbol(f"d_{moved}")] = 1
    nodes = list(made.contact_tangent.nodes[: len(made.residual)])
    inputs = {symbol: along.get(symbol, made.sample.get(symbol, 0)) for symbol in tape.inputs_of(nodes)}
    with mpmath.workdps(40):
        h = mpmath.mpf(10) ** -15
        places = [made.sample | {moved: made.sample[moved] + sign * h} for sign in (1, -1)]
        ahead, behind = (tape.evaluate(made.residual, place, mpmath) for place in places)
        slopes = [(a - b) / (2 * h) for a, b in zip(ahead, behind, strict=True)]
        found = tape.evaluate(nodes, inputs, mpmath)
    assert [float(v) for v in found] == pytest.approx([float(s) for s in slopes], rel=1e-12, abs=1e-12)


def test_tapes_of_the_schedule_do_not_grow():
    tapes = [plan().tape, *(system.tape for system in plan().systems)]
    before = [list(tape.nodes) for tape in tapes]
    made = differentiate(plan())
    assert [tape.nodes for tape in tapes] == before
    assert made.tape.nodes[: len(before[0])] == before[0] and len(made.tape.nodes) > len(before[0])


def test_a_wrong_tangent_is_caught():
    made = differentiate(plan())
    tangent = made.flank_tangents[0]
    seeds = dict(zip(tangent.inputs["p"], tangent.inputs["dp"], strict=True))
    point = next(o.nodes for o in made.flanks[0].outputs if o.name == "point")
    check.moves("tangents", made.tape, point, seeds, tangent.nodes)
    with pytest.raises(check.PassError, match="entry 0 is not the derivative along the direction"):
        check.moves("tangents", made.tape, point, seeds, tangent.nodes[::-1])
