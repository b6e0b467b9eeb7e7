"""Flanks that touch nearly along a line, by any amount down to rounding, touch where those do that touch along it."""

import random

import numpy as np
import pytest

from meshwright import Drive
from meshwright.contact.results import TOUCHING
from tests.cycle.agreement import equal_hob
from tests.quick import full, quick

#: How far a change of a size by 1 mm moves the flanks along their common normal at most, mm: a few times.
MOVED = 10.0


def changed_a_little(seed):
    """A worm and its equal hob, the same with the hob or the setting of the wheel a little off, by how much, mm."""
    draw = random.Random(seed)
    exact = equal_hob(Drive.load(draw.choice(["plain-za", "plain-zi", "plain-zk", "plain-zn"])))
    off = draw.choice([-1.0, 1.0]) * 10.0 ** draw.uniform(-10.0, -3.0)
    key = draw.choice(["hob_pitch_radius_mm", "cutting_center_distance_mm", "center_distance_mm"])
    return exact, exact.with_(design={key: exact.design.value(key) + off}), abs(off)


@pytest.mark.parametrize("seed", quick(range(400 if full() else 30), 0, 1))
def test_what_is_nearly_a_line_touches_where_the_line_does(seed):
    exact, near, off = changed_a_little(seed)
    angles = exact.about_the_middle(np.linspace(-0.5, 0.5, 5))
    here, there = exact.tca(angles), near.tca(angles)
    assert set(here.status) <= {"line_contact", "converged"}
    assert set(there.status) <= {*TOUCHING}, there.status
    lever = np.abs(here.lever_arms["wheel"][np.isfinite(here.lever_arms["wheel"])]).min(initial=10.0)
    assert np.abs(there.error - here.error).max() <= MOVED * off / lever + 1e-12
