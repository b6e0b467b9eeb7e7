"""Loaded contact of any gap: whatever is said to have converged passes every gate."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.fe.loaded import loaded_contact
from meshwright.fe.material import contact_modulus
from meshwright.fe.model import Load
from meshwright.fe.solids import gear_pair
from tests.fe.random_loads import broken, random_load
from tests.quick import full, quick

#: Seeds that are tried.
COUNT = 6

#: And by the longer run.
MANY = 500
#: A worm's tip that cuts a bent piece off the contact; a wheel's tip on the undercut of a pinion.
BESIDE_EDGES = [
    ("plain-za", 63e3, 30.0), ("plain-za", 63e3, 60.0),
    ("bevel-formate", 247e3, 7.9141), ("bevel-formate", 247e3, 10.641),
]  # fmt: skip


@pytest.mark.validate
def test_no_result_of_a_random_load_breaks_a_gate():
    """Equilibrium, no pull, no pressure at a free border of the cells, no peak below what force and length need."""
    outcomes = [random_load(seed) for seed in range(MANY if full() else COUNT)]
    assert not [(outcome.case, outcome.broken) for outcome in outcomes if outcome.broken]
    assert sum(outcome.kind == "converged" for outcome in outcomes) > len(outcomes) // 2


@pytest.mark.parametrize(("name", "torque", "degrees"), quick(BESIDE_EDGES, BESIDE_EDGES[1]))
def test_contact_beside_bent_edges_and_undercuts_has_results(name, torque, degrees):
    gear = gear_pair(Drive.load(name))
    found = loaded_contact(gear, np.radians(degrees), 3, Load(torque, "wheel"), None)
    modulus = contact_modulus(gear.pinion.material, gear.wheel.material)
    assert not found.unresolved and not list(broken(found, gear.wheel, modulus, torque))
    for pair in found.pairs:
        assert pair.grid.gap.min() > -0.001
