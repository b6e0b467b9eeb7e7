"""Which statements each generated function rests on, as the derivation itself says.

Every step of :mod:`derive` names its statements where it is carried out; they travel with surfaces, motions,
definitions and the operations of the tape. How each stands is decided beside the other stages
(:mod:`derive.audit.standing`): what is not proved of this drive's definitions is open, and cited nowhere.
"""

from collections.abc import Callable, Collection, Iterator, Mapping
from itertools import chain
from typing import TypeAlias, TypedDict

from derive.audit.standing import Standings
from derive.language.origin import ANGLES, CONTACT, ELIMINATION, SINGULAR, STEP_SIZE, UNIT, joined
from derive.passes.guards import functions, partial_operations
from derive.passes.plan import Schedule

#: What says how the statements of these names stand.
Decide: TypeAlias = Callable[[Collection[str]], Standings]


class Provenance(TypedDict):
    """What a generated file says of its origin: proved statements, their keys, the functions that rest on them, and
    the open ones with the reason.
    """

    equations: list[str]
    keys: dict[str, str]
    equations_of: dict[str, list[str]]
    open: dict[str, str]


def cited(plan: Schedule) -> dict[str, tuple[str, ...]]:
    """Function name, without the drive's prefix → the statements behind it."""
    steps = dict(_steps(plan))
    for f in functions(plan):
        operations = (f.tape.origins[i].statement for i in partial_operations(f))
        steps[f.name] = joined(steps.get(f.name, ()), operations)
    return steps


def provenance(standings: Standings, steps: Mapping[str, Collection[str]]) -> Provenance:
    """What is proved and what is open of the statements behind each function (:func:`cited`)."""
    open_: dict[str, str] = {}
    for name in chain.from_iterable(steps.values()):
        if reason := standings[name].open_for(name):
            open_.setdefault(str(name), reason)
    # of several surfaces that cite a statement, it holds of all or of none: what rests on both names it once
    of_all = {function: [str(name) for name in names if name not in open_] for function, names in steps.items()}
    held = {function: names for function, names in of_all.items() if names}
    equations = sorted({*chain.from_iterable(held.values())})
    return {
        "equations": equations,
        "keys": {name: standings[name].key for name in equations},
        "equations_of": held,
        "open": dict(sorted(open_.items())),
    }


def _steps(plan: Schedule) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Function name and the steps behind it, beside those of its single operations."""
    drive = plan.drive
    on_surface = (UNIT.statement, SINGULAR)
    for body in drive.bodies:
        yield f"flank_{body.name}", joined(body.surface.rests_on, on_surface)
        yield f"curvature_flank_{body.name}", joined(body.surface.rests_on, on_surface)
    for region in drive.regions:
        yield f"{region.name}_{region.member}", joined(region.surface.rests_on, on_surface)
        yield f"curvature_{region.name}_{region.member}", joined(region.surface.rests_on, on_surface)
    mesh = joined(*(body.placed.rests_on for body in drive.bodies), (CONTACT, ANGLES))
    yield "eval", mesh
    yield "along", mesh
    yield "step", joined(mesh, (ELIMINATION, STEP_SIZE.statement))
    yield "observe", joined(mesh, on_surface)
    yield from ((function.name, function.rests_on) for function in plan.functions)
