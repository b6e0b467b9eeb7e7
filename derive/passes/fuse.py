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
    nodes, arguments = tape.nodes, tape.arguments
    users: dict[int, list[int]] = {}
    depth: dict[int, int] = {}
    for i in order:
        users[i], deepest = [], 0
        for a in arguments[i]:
            if a in depth:
                users[a].append(i)
                if depth[a] > deepest:
                    deepest = depth[a]
        depth[i] = deepest + 1
    kept = set(outputs)
    products = [i for i in order if nodes[i].op == "mul" and users[i] and i not in kept]
    taken: dict[int, int] = {}
    for i in sorted(products, key=depth.__getitem__, reverse=True):
        if all(u not in taken and _takes(nodes[u], i) for u in users[i]):
            taken.update(dict.fromkeys(users[i], i))
    return taken


def _takes(node: Node, product: int) -> bool:
    """Whether the node is a sum that has the product as one of its two arguments."""
    return node.op in _SUMS and node.args.count(product) == 1
