"""The order in which a straight-line program is printed.

Any order that respects the arguments gives the same numbers. A processor looks only some hundred operations ahead and
has sixteen or thirty-two registers, so the program starts early what most other operations wait for, and soon what the
last use of a value is (list scheduling).
"""

import heapq
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from derive.passes import check
from derive.program.routine import Operation, Routine

#: Cycles until a result can be used, on a current desktop or server processor; only the proportions matter.
_LATENCY = {
    "fma": 4, "fms": 4, "fnma": 4,
    "add": 4, "sub": 4, "mul": 4, "div": 24, "sqrt": 30, "neg": 1, "sign": 4, "sin": 56, "cos": 56, "atan2": 120,
}  # fmt: skip

#: Operations behind one node, where it is more than one; sine and cosine of one argument come together.
_OPERATIONS = {"div": 3, "sqrt": 3, "sign": 2, "sin": 44, "cos": 44, "atan2": 40}

#: Operations started in one cycle.
_WIDTH = 2

#: Cycles by which an operation may be printed before its arguments are there.
_AHEAD = 4

#: Cycles of urgency for each register that an operation sets free, or that it takes.
_REGISTER = 30


def order(routine: Routine) -> Routine:
    """The routine in the order in which it is printed."""
    return _reordered(routine, [i for _, i in latency_order(dict(routine.steps), routine.outputs)])


def interleaved(routine: Routine, lags: Sequence[int]) -> list[tuple[int, int]]:
    """Pairs (copy, node) in the order in which copies of the routine are printed side by side."""
    pairs = latency_order(dict(routine.steps), routine.outputs, lags)
    for copy in range(len(lags)):
        _reordered(routine, [i for k, i in pairs if k == copy])
    return pairs


def _reordered(routine: Routine, nodes: Iterable[int]) -> Routine:
    """The routine in the order of these nodes; of sine and cosine of one argument the first stands for both."""
    program = dict(routine.steps)
    turned: dict[tuple[int, ...], list[tuple[int, Operation]]] = {}
    for i, step in routine.steps:
        if step.op in ("sin", "cos"):
            turned.setdefault(step.args, []).append((i, step))
    alone = ([(i, program[i])] if program[i].op not in ("sin", "cos") else turned[program[i].args] for i in nodes)
    steps = tuple(step for steps in alone for step in steps)
    return check.reordered("order", routine, replace(routine, steps=steps))


def latency_order(
    program: Mapping[int, Operation], outputs: Iterable[int], lags: Sequence[int] = (0,)
) -> list[tuple[int, int]]:
    """Pairs (copy, node) of a program, each after its arguments, the most urgent first.

    ``program`` holds the operation of each node, in any order of evaluation; of sine and cosine of one
    argument the first stands for both. Urgent is what a long chain waits for, and what is the last to use a value.
    The program is printed once for each of ``lags``, copy beside copy; a copy's operations count as so many cycles
    less urgent.
    """
    graph = _Graph(program, outputs)
    copies = [_Copy(graph, lag) for lag in lags]
    nodes, cost, pop, push = graph.nodes, graph.cost, heapq.heappop, heapq.heappush
    first = [n for n, args in enumerate(graph.args) if not args]
    coming = [(0.0, k, nodes[n], n) for k in range(len(lags)) for n in first]
    heapq.heapify(coming)
    ready: list[tuple[int, int, int]] = []
    result: list[tuple[int, int]] = []
    time = 0.0
    while coming or ready:
        while coming and (coming[0][0] <= time + _AHEAD or not ready):
            at, k, _, n = pop(coming)
            time = max(time, at - _AHEAD)
            copies[k].ready[n] = True
            push(ready, (copies[k].lateness[n], n, k))
        _, n, k = pop(ready)
        copy = copies[k]
        if not copy.ready[n]:  # it was more urgent, and came sooner
            continue
        result.append((k, nodes[n]))
        hastened, released = copy.start(n, time)
        for u in hastened:
            push(ready, (copy.lateness[u], u, k))
        for u in released:
            push(coming, (copy.possible[u], k, nodes[u], u))
        time += cost[n] / _WIDTH
    return result


class _Graph:
    """The operations of a program by their numbers in its order: the node, what each waits for and who waits for it,
    how long the chain behind it is, what it costs, how many results it has and whether one is an output.
    """

    def __init__(self, program: Mapping[int, Operation], outputs: Iterable[int]) -> None:
        self.nodes: list[int] = []
        self.args: list[list[int]] = []
        self.users: list[list[int]] = []
        self.latency: list[int] = []
        self.cost: list[int] = []
        self.results: list[int] = []
        turned: dict[tuple[int, ...], int] = {}
        number: dict[int, int] = {}
        for i, step in program.items():
            op, own = step.op, len(self.nodes)
            if op in ("sin", "cos") and (other := turned.setdefault(step.args, own)) != own:
                number[i] = other
                self.results[other] += 1
                continue
            number[i] = own
            args = list(dict.fromkeys([number[a] for a in step.args if a in number]))
            for n in args:
                self.users[n].append(own)
            self.nodes.append(i)
            self.args.append(args)
            self.users.append([])
            self.latency.append(_LATENCY[op])
            self.cost.append(_OPERATIONS.get(op, 1))
            self.results.append(1)
        self.height = [0] * len(self.nodes)
        for n, users in reversed([*enumerate(self.users)]):
            self.height[n] = self.latency[n] + max([self.height[u] for u in users], default=0)
        self.kept = {number[i] for i in outputs if i in number}


class _Copy:
    """How far one copy of the program has come.

    ``lateness`` sorts operations, the most urgent first; it only falls. ``possible`` is when the arguments are there.
    """

    def __init__(self, graph: _Graph, lag: int) -> None:
        self._graph, count = graph, len(graph.nodes)
        self._uses = uses = [len(users) + (n in graph.kept) for n, users in enumerate(graph.users)]
        self._waits = [len(args) for args in graph.args]
        self.possible = [0.0] * count
        self.ready = [False] * count
        self.lateness = [
            lag - height + _REGISTER * results for height, results in zip(graph.height, graph.results, strict=True)
        ]
        for users, left in zip(graph.users, uses, strict=True):
            if left == 1:
                self._hasten(users)

    def start(self, n: int, time: float) -> tuple[list[int], list[int]]:
        """Start operation n; returns those ready that have become more urgent, and those that may come now."""
        graph, uses, waits, possible = self._graph, self._uses, self._waits, self.possible
        finished = max(time, possible[n]) + graph.latency[n]
        self.ready[n] = False
        hastened: list[int] = []
        for a in graph.args[n]:
            uses[a] -= 1
            if uses[a] == 1:
                hastened += self._hasten(graph.users[a])
        released: list[int] = []
        for u in graph.users[n]:
            waits[u] -= 1
            if possible[u] < finished:
                possible[u] = finished
            if not waits[u]:
                released.append(u)
        return hastened, released

    def _hasten(self, users: Iterable[int]) -> list[int]:
        """One of these is the last to use a value, and more urgent; returns those of them that are ready."""
        for u in users:
            self.lateness[u] -= _REGISTER
        return [u for u in users if self.ready[u]]
