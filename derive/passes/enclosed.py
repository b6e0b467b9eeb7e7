"""What is computed with error bounds: rules, design systems at the end of their path, contact, and what proofs read of
it and of both flanks.

Input: a plan whose design systems are at the end of their path. Output: generated functions.
"""

from collections.abc import Iterable, Iterator

from derive.passes import guards
from derive.passes.guards import Evaluated
from derive.passes.plan import Schedule

#: Functions of the generated header that are computed with error bounds too.
_SAME = ("derive", "setup", "set_phi", "eval", "along")


def functions(plan: Schedule) -> Iterator[Evaluated]:
    """The functions that are tables of operations."""
    state = frozenset(plan.state)

    def put(name: str, outputs: Iterable[int], known: frozenset[int] = state) -> Evaluated:
        return Evaluated(name, plan.tape, plan.lower, (tuple(outputs),), known, "result")

    of_systems = {f"system {system.system.name}_{part}" for system in plan.systems for part in ("eval", "fill")}
    yield from (f for f in (*guards.functions(plan), *guards.moving(plan)) if f.key in {*_SAME, *of_systems})
    yield put("watched", _watched(plan))
    for body, outputs in _flanks(plan):
        yield put(f"on_{body}", outputs)
    placed = (i for o in plan.placement.outputs for i in o.nodes)
    yield put("placed", placed, frozenset(list(plan.state)[: plan.design_slots]))


def _flanks(plan: Schedule) -> Iterator[tuple[str, list[int]]]:
    """Both flanks: point, then regular and margins, then its tangents. The pinion's in the fixed frame, where its turn
    and its parameters meet in fewer angles; the wheel's in its own.
    """
    found = {o.name: o.nodes for o in plan.observed}
    for body, flank in zip(plan.drive.bodies, plan.flanks, strict=True):
        local = {o.name: o.nodes for o in flank.outputs}
        fixed = body is plan.drive.bodies[0]
        point = found[f"point_{body.name}_f"] if fixed else local["point"]
        tangents = [i for q in flank.parameters for i in (found if fixed else local)[f"tangent_{q}"]]
        yield body.name, [*point, *flank.limits, *tangents]


def _watched(plan: Schedule) -> list[int]:
    """What is enclosed at a contact: points and normals of both members in the fixed frame, the pinion's first; wheel
    angle; principal curvatures of the gap; of each body whether it is regular, and its margins.
    """
    found, flat = {o.name: o.nodes for o in plan.observed}, [i for o in plan.observed for i in o.nodes]
    nodes: list[int] = []
    for body in plan.drive.bodies:
        nodes += [*found[f"point_{body.name}_f"], *found[f"normal_{body.name}_f"]]
    nodes += [*found["wheel_angle"], *found["curvature_gap"]]
    for body in plan.drive.bodies:
        places = plan.bodies[body.name]
        nodes += [flat[at] for at in (places.singular, *places.margins)]
    return nodes
