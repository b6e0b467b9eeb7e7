"""Each pass makes a plan of its own, with all that the passes before it found, and changes none."""

from dataclasses import FrozenInstanceError, fields

import pytest

from derive import drives
from derive.passes.binding import bind
from derive.passes.equations import derive
from derive.passes.guards import guard
from derive.passes.observation import observe
from derive.passes.pivot_order import reduce
from derive.passes.schedule import read
from tests.derive.small import DRIVE


def test_a_pass_adds_to_what_the_passes_before_it_found():
    plan = derive(drives.catalogue([DRIVE])[DRIVE]())
    for follows in (reduce, observe, read, bind, guard):
        before, nodes = dict(vars(plan)), list(plan.tape.nodes)
        further = follows(plan)
        assert vars(plan) == before and plan.tape.nodes == nodes == further.tape.nodes[: len(nodes)]
        assert len(fields(further)) > len(before)
        kept = before.keys() - {"tape", "lower"}
        assert all(getattr(further, name) is before[name] for name in kept)
        plan = further
    with pytest.raises(FrozenInstanceError):
        plan.state = {}
