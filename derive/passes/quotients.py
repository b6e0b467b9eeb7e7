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
    nodes, order = tape.nodes, {*computed}
    divisions = [i for i in order if nodes[i].op == "div"]
    quotients = [i for i in divisions if tape.const_value(nodes[i].args[0]) != 1]
    if not quotients:
        return {}
    given = (i for i in known if nodes[i].op == "div")
    reciprocals = {nodes[i].args[1]: i for i in (*divisions, *given) if tape.const_value(nodes[i].args[0]) == 1}
    return {i: (nodes[i].args[0], reciprocals[nodes[i].args[1]]) for i in quotients if nodes[i].args[1] in reciprocals}
