"""A routine: one generated function as a straight-line list of operations, immutable, between passes and printers.

Values are nodes of a tape; a routine says which of them it computes, how and in which order, and which it returns. What
it reads is what it does not compute.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from derive.program.tape import Tape


class Operation(NamedTuple):
    """An operation of a routine. ``op`` is one of the tape's, or a sum that takes a product: fma a·b + c, fms a·b − c,
    fnma c − a·b; there ``product`` is the node of a·b, which is no operation of its own.
    """

    op: str
    args: tuple[int, ...]
    product: int | None = None


@dataclass(frozen=True)
class Routine:
    """``steps`` (node, operation) in an order of evaluation that leads to ``outputs``; ``known`` are nodes to be read.

    ``later`` are outputs of a routine that goes on from this one; ``long`` says that it is to be compiled as it stands.
    ``found`` keeps what passes found out about it.
    """

    tape: Tape
    outputs: tuple[int, ...]
    known: frozenset[int]
    steps: tuple[tuple[int, Operation], ...]
    later: tuple[int, ...] = ()
    name: str = ""
    long: bool = False
    found: dict[str, list[int]] = field(default_factory=dict, init=False, compare=False, repr=False)

    @property
    def operations(self) -> int:
        """Number of operations, the products inside of sums included."""
        return len(self.steps) + len({step.product for _, step in self.steps} - {None})

    def reads(self) -> Iterator[int]:
        """Nodes that it reads, in order of their first use."""
        computed = {i for i, _ in self.steps} | {step.product for _, step in self.steps}
        used = dict.fromkeys([*(a for _, step in self.steps for a in step.args), *self.outputs])
        return (i for i in used if i not in computed)


def routine(
    tape: Tape,
    outputs: Iterable[int],
    known: Iterable[int] = frozenset(),
    later: Iterable[int] = (),
    name: str = "",
) -> Routine:
    """The routine that computes ``outputs`` as the tape has them."""
    results, read = tuple(outputs), frozenset(known)
    steps = tuple([(i, Operation(tape.nodes[i].op, tape.arguments[i])) for i in tape.needed(results, read)])
    return Routine(tape, results, read, steps, tuple(later), name)
