"""Which quotients are computed as products: those by a divisor whose reciprocal the same function computes anyway.

A division takes as long as a dozen products.
"""

from collections.abc import Iterable

from derive.passes import check
from derive.program.routine import Operation, Routine
from derive.program.tape import Tape


def reciprocals(routine: Routine) -> Routine:
    """The routine with products for quotients whose divisor's reciprocal is at hand."""
    tape, readable = routine.tape, routine.known
    computed = [i for i, _ in routine.steps]
    further = tape.needed(routine.later, {*readable, *computed}) if routine.later else []
    factors = by_reciprocal(tape, [*computed, *further], readable)
    if not factors:
        return routine
    steps: list[tuple[int, Operation]] = []
    for i in tape.needed(routine.outputs, readable, factors):
        node = tape.nodes[i]
        steps.append((i, Operation("mul", factors[i]) if i in factors else Operation(node.op, node.args)))
    after = Routine(tape, routine.outputs, readable, tuple(steps), routine.later, routine.name)
    return check.same("reciprocals", routine, after)


def by_reciprocal(tape: Tape, computed: Iterable[int], known: Iterable[int]) -> dict[int, tuple[int, int]]:
    """Quotient → its dividend and the reciprocal of its divisor, in a function that computes these nodes from those
    that it is given.
    """
    one, order, nodes = tape.constant(1), {*computed}, tape.nodes
    factors: dict[int, tuple[int, int]] = {}
    quotients = [i for i in order if nodes[i].op == "div" and nodes[i].args[0] != one]
    at_hand = order.union(known) if quotients else order
    for i in quotients:
        dividend, divisor = nodes[i].args
        reciprocal = tape.find("div", one, divisor)
        if reciprocal is not None and reciprocal in at_hand:
            factors[i] = (dividend, reciprocal)
    return factors
