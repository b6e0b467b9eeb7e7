"""The order in which a straight-line program is printed.

Any order that respects the arguments gives the same numbers. A processor looks only some hundred operations ahead and
has sixteen or thirty-two registers, so the program starts early what most other operations wait for, and soon what the
last use of a value is (list scheduling).
"""

from __future__ import annotations

import heapq
from collections import Counter
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
    return check.same("order", routine, replace(routine, steps=steps))


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
    first = [i for i, args in graph.args.items() if not args]
    coming: list[tuple[float, int, int]] = [(0, k, i) for k in range(len(lags)) for i in first]
    heapq.heapify(coming)
    ready: list[tuple[float, int, int, int]] = []
    result: list[tuple[int, int]] = []
    time = 0.0
    while coming or ready:
        while coming and (coming[0][0] <= time + _AHEAD or not ready):
            at, k, i = heapq.heappop(coming)
            time = max(time, at - _AHEAD)
            copies[k].ready.add(i)
            heapq.heappush(ready, (*copies[k].urgency(i), k, i))
        *_, k, i = heapq.heappop(ready)
        if i not in copies[k].ready:  # it was more urgent, and came sooner
            continue
        result.append((k, i))
        released, hastened = copies[k].start(i, time)
        for n in hastened:
            heapq.heappush(ready, (*copies[k].urgency(n), k, n))
        for n in released:
            heapq.heappush(coming, (copies[k].possible[n], k, n))
        time += graph.cost[i] / _WIDTH
    return result


class _Graph:
    """What each operation waits for and who waits for it, how long the chain behind it is, what it costs."""

    def __init__(self, program: Mapping[int, Operation], outputs: Iterable[int]) -> None:
        turned: dict[tuple[int, ...], int] = {}
        alone = {i: turned.setdefault(o.args, i) if o.op in ("sin", "cos") else i for i, o in program.items()}
        nodes = dict.fromkeys(alone.values())
        within = {i: dict.fromkeys(alone[a] for a in program[i].args if a in alone) for i in nodes}
        self.args = {i: tuple(args) for i, args in within.items()}
        self.users: dict[int, list[int]] = {i: [] for i in nodes}
        for i, args in self.args.items():
            for a in args:
                self.users[a].append(i)
        self.latency = {i: _LATENCY[program[i].op] for i in nodes}
        self.cost = {i: _OPERATIONS.get(program[i].op, 1) for i in nodes}
        self.height: dict[int, int] = {}
        for i in reversed(nodes):
            self.height[i] = self.latency[i] + max((self.height[u] for u in self.users[i]), default=0)
        self.rank = {i: k for k, i in enumerate(nodes)}
        self.results = Counter(alone.values())
        self.kept = {alone[i] for i in outputs if i in alone}


class _Copy:
    """How far one copy of the program has come."""

    def __init__(self, graph: _Graph, lag: int) -> None:
        self._graph, self._lag = graph, lag
        self._uses = {i: len(users) + (i in graph.kept) for i, users in graph.users.items()}
        self._waits = {i: len(args) for i, args in graph.args.items()}
        self.possible: dict[int, float] = dict.fromkeys(graph.args, 0.0)  # when the arguments are there
        self.ready: set[int] = set()

    def urgency(self, i: int) -> tuple[float, int]:
        """Sorts operations, the most urgent first; it only grows."""
        graph, uses = self._graph, self._uses
        registers = -graph.results[i]
        for a in graph.args[i]:
            registers += uses[a] == 1
        return self._lag - graph.height[i] - _REGISTER * registers, graph.rank[i]

    def start(self, i: int, time: float) -> tuple[list[int], list[int]]:
        """Start operation i; returns those that may come now, and those ready that have become more urgent."""
        graph, uses, waits, possible = self._graph, self._uses, self._waits, self.possible
        finished = max(time, possible[i]) + graph.latency[i]
        self.ready.remove(i)
        released, hastened = list[int](), list[int]()
        for a in graph.args[i]:
            uses[a] -= 1
            if uses[a] == 1:
                hastened += [u for u in graph.users[a] if u in self.ready]
        for u in graph.users[i]:
            waits[u] -= 1
            if possible[u] < finished:
                possible[u] = finished
            if not waits[u]:
                released.append(u)
        return released, hastened
