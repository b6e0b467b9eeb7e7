"""Tangents of a schedule are its slopes: against a difference in 40 digits along one misalignment."""

import mpmath
import pytest
import sympy as sp

from derive import drives
from derive.emit.sensitivity import tangents
from derive.passes.schedule import schedule
from tests.derive.small import DRIVE


def test_the_tangent_of_the_residual_is_its_slope_along_a_parameter():
    plan = schedule(drives.catalogue([DRIVE])[DRIVE]())  # its tape grows
    contact = tangents(plan).contact
    moved = next(p.symbol for p in plan.drive.parameters if p.table == "misalignment")
    tape, along = plan.tape, {sp.Symbol(f"d_{p.symbol}"): 0 for p in plan.drive.parameters}
    along[sp.Symbol(f"d_{moved}")] = 1
    nodes = list(contact.nodes[: len(plan.residual)])
    inputs = {symbol: along.get(symbol, plan.sample.get(symbol, 0)) for symbol in tape.inputs_of(nodes)}
    with mpmath.workdps(40):
        h = mpmath.mpf(10) ** -15
        places = [plan.sample | {moved: plan.sample[moved] + sign * h} for sign in (1, -1)]
        ahead, behind = (tape.evaluate(plan.residual, place, mpmath) for place in places)
        slopes = [(a - b) / (2 * h) for a, b in zip(ahead, behind, strict=True)]
        found = tape.evaluate(nodes, inputs, mpmath)
    assert [float(v) for v in found] == pytest.approx([float(s) for s in slopes], rel=1e-12, abs=1e-12)
