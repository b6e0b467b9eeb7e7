"""The program of a drive after each pass, to be read: ``python -m derive show DRIVE --after PASS``."""

from collections.abc import Callable, Collection, Iterator
from typing import TypeAlias

from derive.passes import guards
from derive.passes.arrange import OFTEN
from derive.passes.fuse import fuse
from derive.passes.order import order
from derive.passes.plan import Schedule
from derive.passes.quotients import reciprocals
from derive.program.routine import Routine, routine

#: Name, outputs, and what is known.
Named: TypeAlias = tuple[str, Collection[int], frozenset[int]]


def _residual(plan: Schedule) -> Iterator[Named]:
    yield "residual", plan.residual, frozenset()


def _jacobian(plan: Schedule) -> Iterator[Named]:
    yield from _residual(plan)
    yield "jacobian", [e for row in plan.jacobian for e in row], frozenset()


def _step(plan: Schedule) -> Iterator[Named]:
    yield from _jacobian(plan)
    yield "step", plan.newton_step, frozenset()


def _all(plan: Schedule, chosen: Collection[str] = ()) -> Iterator[Named]:
    for f in (*guards.functions(plan), *guards.moving(plan)):
        if f.tape is plan.tape and (not chosen or f.key in chosen):
            yield f.name, f.outputs, f.known


def _often(plan: Schedule) -> Iterator[Named]:
    yield from _all(plan, OFTEN)


#: Passes by name: the routines that exist after them, and what has been done to each by then.
PASSES: dict[str, tuple[Callable[[Schedule], Iterator[Named]], tuple[Callable[[Routine], Routine], ...]]] = {
    "lower": (_residual, ()),
    "linearise": (_jacobian, ()),
    "pivot-order": (_step, ()),
    "binding-times": (_all, ()),
    "reciprocals": (_all, (reciprocals,)),
    "fuse": (_all, (reciprocals, fuse)),
    "order": (_often, (reciprocals, fuse, order)),
}


def routines(plan: Schedule, after: str) -> Iterator[Routine]:
    """The routines of a drive after one of :data:`PASSES`."""
    named, done = PASSES[after]
    for name, outputs, known in named(plan):
        made = routine(plan.tape, outputs, known, name=name)
        for apply in done:
            made = apply(made)
        yield made
