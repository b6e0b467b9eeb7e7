"""What proofs read is what the drive's other functions return, in the order in which the runtime looks for it."""

from derive.passes.arrange import unfused
from derive.passes.enclosed import functions
from derive.program.routine import Operation
from tests.derive.small import plan


def test_what_is_enclosed_of_a_contact_and_of_flanks_is_what_is_observed():
    made = plan()
    found = {f.name: f for f in functions(made)}
    nodes = {o.name: o.nodes for o in made.observed}
    watched = found["watched"].outputs
    assert tuple(watched[:6]) == (*nodes["point_pinion_f"], *nodes["normal_pinion_f"])
    for flank in made.flanks:
        point, limits = found[f"on_{flank.body}"].outputs[:3], found[f"on_{flank.body}"].outputs[3:]
        assert limits[: len(flank.limits)] == flank.limits
        own = next(o.nodes for o in flank.outputs if o.name == "point")
        assert tuple(point) == (nodes["point_pinion_f"] if flank.body == "pinion" else own)


def test_nothing_is_fused_where_sums_gain_nothing_by_it():
    made = plan()
    routines = unfused(made, functions(made))
    assert {"derive", "setup", "set_phi", "eval", "along", "placed"} <= routines.keys()
    steps = [step for parts in routines.values() for part in parts for _, step in part.steps]
    assert steps and all(isinstance(s, Operation) and s.product is None for s in steps)
