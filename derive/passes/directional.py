"""Derivatives along a direction: the tangent of every value on a tape, by the chain rule."""

from collections.abc import Mapping

import sympy as sp

from derive.passes import check
from derive.passes.plan import Along, Derived
from derive.program.tape import Stage, Tape


class Derivatives:
    """Tangent nodes on a tape: those of the ``seeds`` (input node → node) are given, all others follow."""

    def __init__(self, tape: Tape, seeds: Mapping[int, int]) -> None:
        self.tape, self._done = tape, dict(seeds)

    def __call__(self, i: int) -> int:
        tape, since = self.tape, len(self.tape.nodes)
        for k in [*tape.needed([i], self._done), i]:
            if k not in self._done:
                args, zero = tape.arguments[k], tape.constant(0)
                change = tape.rule(k, [self._done.get(a, zero) for a in args]) if args else zero
                self._done[k] = tape.means(change, since, "change", k)
        return self._done[i]


def along(plan: Derived) -> Along:
    """Derivatives of the residual along a direction: see :class:`~derive.passes.plan.Along`."""
    tape, symbols = plan.tape, [*plan.unknowns, plan.drive.instant]
    seeds = {plan.lower(s): tape.input(sp.Symbol(f"along_{s}"), Stage.ITERATE) for s in symbols}
    tangent = Derivatives(tape, seeds)
    first = tuple(tangent(i) for i in plan.residual)
    second = tuple(tangent(i) for i in first)
    check.moves("along", tape, (*plan.residual, *first), seeds, (*first, *second))
    return Along(tuple(seeds.values()), first, second)
