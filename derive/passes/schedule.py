"""Schedule: all that is read from a drive's equations, with binding times and guards."""

from derive.language.drive import Drive
from derive.language.functions import Function
from derive.passes import geometry
from derive.passes.binding import bind
from derive.passes.directional import along
from derive.passes.edges import edge_contact
from derive.passes.equations import derive
from derive.passes.flanks import expansion, flank, region
from derive.passes.guards import guard
from derive.passes.observation import observe
from derive.passes.pivot_order import reduce
from derive.passes.plan import FunctionOutputs, Observed, Output, Read, Reduced, Schedule


def schedule(drive: Drive) -> Schedule:
    """All functions of a drive on one tape: derived, reduced and scheduled."""
    return scheduled(reduce(derive(drive)))


def scheduled(plan: Reduced) -> Schedule:
    """The equations with all that is read from them, each value at the earliest stage that knows its inputs."""
    return guard(bind(read(observe(plan))))


def read(plan: Observed) -> Read:
    """The equations with all functions that read neither contact nor step: of surfaces, along a direction, of edges."""
    plan = plan.copy()
    flanks = tuple(flank(plan, body) for body in plan.drive.bodies)
    regions = tuple(region(plan, of) for of in plan.drive.regions)
    functions = tuple(_function(plan, function) for function in geometry.functions(plan.drive))
    derivatives, edges = along(plan), edge_contact(plan)
    expansions = [expansion(plan, of, second=True) for of in flanks]
    expansions += [expansion(plan, of, second=False) for of in regions]
    return Read(
        **vars(plan),
        flanks=flanks,
        regions=regions,
        functions=functions,
        along=derivatives,
        edges=edges,
        expansions=tuple(expansions),
    )


def _function(plan: Observed, function: Function) -> FunctionOutputs:
    outputs = (Output(r.name, tuple(map(plan.lower, r.values)), r.unit, r.frame) for r in function.results)
    return FunctionOutputs(function.name, function.meaning, function.arguments, tuple(outputs), function.rests_on)
