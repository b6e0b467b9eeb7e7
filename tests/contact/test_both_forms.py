"""The papers' system, with the meshing equation of the wheel kept, against the reduced one that the runtime solves."""

import mpmath
import pytest

from derive.drives import cylindrical_worm as family
from derive.language.chain import Rz
from derive.language.contact import contact
from derive.language.definitions import Definitions
from derive.language.envelope import envelope
from derive.language.symbols import Quantity
from derive.passes import sample
from derive.passes.schedule import schedule
from derive.program.lowering import Lowering
from derive.program.tape import Stage, Tape


def _unreduced(worm_profile, hob_profile):
    """Residual of six equations, and the six unknowns, straight from the chains."""
    definitions = Definitions()
    phi_1, phi_h = Quantity("phi_worm", "rad"), Quantity("phi_hob", "rad")
    error = Quantity("transmission_error", "rad")
    worm, hob = family.helicoids(worm_profile, hob_profile, definitions)
    wheel = envelope(hob.flank, family.cutting(phi_h), phi_h)
    phi_2 = family.T_1 / family.T_2 * phi_1 + error
    residual = contact(worm.flank.placed(Rz(phi_1)), wheel.placed(family.mounting(phi_2)))
    return residual, (*worm.flank.parameters, *wheel.parameters, error), definitions


@pytest.mark.parametrize("profiles", [("ZN", "ZN"), ("ZK", "ZN"), ("ZA", "ZI"), ("ZI", "ZC")])
def test_the_explicit_wheel_satisfies_the_papers_system(profiles):
    plan = schedule(family.cylindrical_worm(*profiles))
    residual, unknowns, definitions = _unreduced(*profiles)
    tape = Tape()
    inputs = {p.symbol: Stage.DESIGN for p in plan.drive.parameters} | {plan.drive.instant: Stage.INSTANT}
    lower = Lowering(tape, inputs | dict.fromkeys(unknowns, Stage.ITERATE), definitions)
    assert len(residual) == len(unknowns) == 6
    with mpmath.workdps(sample.DIGITS):
        solved = sample.solve(plan, sample.sample_parameters(plan.drive), 0.5)
        recovered = plan.tape.evaluate([plan.lower(s) for s in plan.drive.wheel.recovered], solved, mpmath)
        values = solved | dict(zip(plan.drive.wheel.recovered, recovered, strict=True))
        errors = tape.evaluate([lower(r) for r in residual], values, mpmath)
        assert max(map(abs, errors)) < mpmath.mpf(10) ** -30


def test_the_papers_system_has_one_equation_more():
    plan = schedule(family.cylindrical_worm("ZN", "ZN"))
    assert len(plan.residual) == 5
    assert not plan.drive.wheel.surface.conditions
