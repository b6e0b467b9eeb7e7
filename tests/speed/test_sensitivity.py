"""Sensitivities against differences in 50-digit arithmetic, rules of the design followed."""

import mpmath
import numpy as np
import pytest

from derive import drives, newton
from derive.schedule import schedule
from meshwright import Drive, UsageError
from meshwright.design import given_vector
from meshwright.sensitivity import sensitivity

STEP = mpmath.mpf(10) ** -18

CASES = {"recess-action-full": 7.0, "spherical-table-2-3": 0.01}


def _completed(drive, given):
    """Parameters by symbol from what is given, as the rules say, in the current precision."""
    values = dict(zip((p.symbol for p in drive.parameters), given, strict=True))
    for p in drive.parameters:
        if p.default is not None and mpmath.isnan(values[p.symbol]):
            values[p.symbol] = mpmath.mpf(float(p.default))
    for rule in drive.rules:
        if mpmath.isnan(values[rule.target]):
            known = {s: values[s] for s in rule.value.free_symbols if s in values}
            open_ = any(mpmath.isnan(v) for v in known.values())
            values[rule.target] = mpmath.nan if open_ else mpmath.mpf(rule.value.evalf(60, subs=known))
    return values


def _solution(plan, given, angle, start):
    """Unknowns and contact point of a design near ``start``, to 50 digits."""
    inputs = _completed(plan.drive, given)
    inputs[plan.drive.instant] = mpmath.mpf(angle)
    inputs.update(zip(plan.unknowns, map(mpmath.mpf, start), strict=True))
    newton._iterate(plan.tape, plan.residual, plan.jacobian, plan.unknowns, inputs)
    point = next(o for o in plan.observed if o.name == "point_pinion_f")
    return [inputs[u] for u in plan.unknowns] + plan.tape.evaluate(point.nodes, inputs, mpmath)


@pytest.mark.parametrize("name", CASES)
def test_every_parameter_agrees_with_differences_in_50_digits(name):
    drive, angle = Drive.load(name), CASES[name]
    result = sensitivity(drive, [angle])
    description = drive.design.description
    plan = schedule(drives.catalogue()[description["name"]]())
    columns = {f"{p['table']}.{p['key']}": k for k, p in enumerate(description["parameters"])}
    start = drive.trace(np.array([angle]))[0][0]
    assert len(result.keys) >= 8
    for key in result.keys:
        with mpmath.workdps(50):
            ends = []
            for sign in (1, -1):
                given = [mpmath.mpf(float(g)) for g in given_vector(drive.design)]
                given[columns[key]] = mpmath.mpf(float(drive.design.parameters[columns[key]])) + sign * STEP
                ends.append(_solution(plan, given, angle, start))
            slopes = [float((a - b) / (2 * STEP)) for a, b in zip(*ends, strict=True)]
        ours = [*(u[0, result.of(key)] for u in result.unknowns.values()), *result.points[0, result.of(key)]]
        scale = max(1.0, *map(abs, slopes))
        assert ours == pytest.approx(slopes, abs=1e-8 * scale), key


def test_a_drive_whose_parameters_are_solved_says_that_it_has_none():
    with pytest.raises(UsageError, match="system of equations"):
        sensitivity(Drive.load("face-worm-cylindrical-convex"), [0.0])
