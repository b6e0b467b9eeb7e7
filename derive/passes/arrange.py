"""The generated functions as the routines that are printed: quotients as products, products in sums, in the order in
which a processor takes them.

Input: generated functions, each by what it returns and what it is given. Output: by key their routines.
"""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import TypeAlias

from derive.passes.fuse import fuse
from derive.passes.guards import Evaluated
from derive.passes.order import interleaved, order
from derive.passes.plan import Schedule
from derive.passes.quotients import reciprocals
from derive.program.routine import Routine, routine

#: Key of a generated function → its routines, part by part; a part that goes on from another follows it.
Routines: TypeAlias = Mapping[str, tuple[Routine, ...]]


#: Functions that are called at every step and angle. All others, for a design, a start, a solved contact or a point of
#: a flank, are called seldom, and stay in the order in which their results need them: there a change of a page changes
#: its own lines, where the order of urgency moves others too.
OFTEN = ("set_phi", "eval", "step", "by_anchor", "scale", "guess", "start_scale")

#: Operations from which on a function that is seldom called is compiled as it stands: the time that a compiler takes to
#: allot registers grows with the square of them, and is then seconds, more than any analysis spends in the function.
LONG = 2500

#: Cycles by which a second copy of a program lags behind the first: one is wide where the other waits.
LAG = 80


@dataclass(frozen=True)
class SideBySide:
    """A routine as two copies, operation beside operation: ``places`` are pairs (copy, node) in their order."""

    routine: Routine
    places: tuple[tuple[int, int], ...]


def arrange(plan: Schedule, functions: Iterable[Evaluated], often: Collection[str] = OFTEN) -> Routines:
    """The :data:`Routines` of these functions of a drive, of which those with keys among ``often`` are called often."""
    return _by_key(
        (f.key, tuple(_ordered(made, f.key in often) for made in _routines(f, _outputs(plan, f)))) for f in functions
    )


def _ordered(made: Routine, often: bool) -> Routine:
    return order(made) if often else replace(made, long=made.operations >= LONG)


def side_by_side(plan: Schedule) -> SideBySide:
    """The Newton step for two lanes in a turn."""
    step = fused(routine(plan.tape, plan.newton_step, plan.state))
    return SideBySide(step, tuple(interleaved(step, (0, LAG))))


def unfused(plan: Schedule, functions: Iterable[Evaluated]) -> Routines:
    """The same for arithmetic that encloses what it computes, where a sum gains nothing by a product: each in one."""
    return _by_key(
        (f.key, (reciprocals(routine(f.tape, _outputs(plan, f), f.known)),)) for f in functions
    )


def _by_key(made: Iterable[tuple[str, tuple[Routine, ...]]]) -> Routines:
    found: dict[str, tuple[Routine, ...]] = {}
    for key, routines in made:
        found[key] = (*found.get(key, ()), *routines)
    return found


def _outputs(plan: Schedule, f: Evaluated) -> list[int]:
    """What a function returns, and what it tests."""
    tests = plan.tests.get((f.name, f.part), {})
    return [*f.outputs, *(i for group in f.groups for _ in group for i in tests.get(group, ()))]


def _routines(f: Evaluated, outputs: list[int]) -> tuple[Routine, ...]:
    if f.leading is None:
        return (fused(routine(f.tape, outputs, f.known)),)
    leading, others = outputs[: f.leading], outputs[f.leading :]
    first = fused(routine(f.tape, leading, f.known, others))
    return first, fused(routine(f.tape, others, f.known | _computed(first)))


def fused(made: Routine) -> Routine:
    """A routine with its quotients as products and its products in sums."""
    return fuse(reciprocals(made))


def _computed(done: Routine) -> set[int]:
    """Nodes that a routine has computed: of sine and cosine of an angle both."""
    angles = [step.args[0] for _, step in done.steps if step.op in ("sin", "cos")]
    turned = (done.tape.find(op, angle) for angle in angles for op in ("sin", "cos"))
    return {i for i, _ in done.steps}.union(i for i in turned if i is not None)
