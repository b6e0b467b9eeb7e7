"""Which products are fused with the sum that takes them, in one operation rounded once.

The choice is part of the program, not left to a compiler: compiled with fusing, scalar and lane kernels give equal
bits; without, the text means product and sum, and gives the same bits on every machine.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace

from derive.passes import check
from derive.program.routine import Operation, Routine
from derive.program.tape import Node, Tape

#: Sums that take a product as either argument.
_SUMS = {"add", "sub"}


def fuse(routine: Routine) -> Routine:
    """The routine with sums that take products; these products are no operations of their own."""
    taken = fused_products(routine.tape, [i for i, _ in routine.steps], routine.outputs)
    inside = set(taken.values())
    steps = tuple((i, _fused(routine.tape, i, step, taken.get(i))) for i, step in routine.steps if i not in inside)
    return check.same("fuse", routine, replace(routine, steps=steps))


def _fused(tape: Tape, i: int, step: Operation, product: int | None) -> Operation:
    if product is None:
        return step
    first, second = step.args
    op = "fma" if step.op == "add" else "fms" if first == product else "fnma"
    return Operation(op, (*tape.nodes[product].args, second if first == product else first), product)


def fused_products(tape: Tape, order: Sequence[int], outputs: Iterable[int]) -> dict[int, int]:
    """Sum → the product that it takes, for the operations in ``order``.

    A product goes into its sums if that leaves no other use of it. Where a sum could take either argument, it takes
    the one that is known later.
    """
    users: dict[int, list[int]] = {i: [] for i in order}
    depth: dict[int, int] = {}
    for i in order:
        args = [a for a in tape.nodes[i].args if a in users]
        depth[i] = 1 + max((depth[a] for a in args), default=0)
        for a in args:
            users[a].append(i)
    kept = set(outputs)
    taken: dict[int, int] = {}
    for i in sorted(order, key=lambda k: -depth[k]):
        if tape.nodes[i].op != "mul" or i in kept or not users[i]:
            continue
        if all(_takes(tape.nodes[u], i) and u not in taken for u in users[i]):
            taken |= dict.fromkeys(users[i], i)
    return taken


def _takes(node: Node, product: int) -> bool:
    """Whether the node is a sum that has the product as one of its two arguments."""
    return node.op in _SUMS and node.args.count(product) == 1
