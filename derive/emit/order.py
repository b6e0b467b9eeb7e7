"""The order in which a straight-line program is printed.

Any order that respects the arguments gives the same numbers. A processor looks only some hundred operations ahead, so
the program starts early what most other operations wait for (list scheduling).
"""

import heapq

#: Cycles until a result can be used, on a current desktop or server processor; only the proportions matter.
_LATENCY = {"add": 4, "sub": 4, "mul": 4, "div": 24, "sqrt": 30, "neg": 1, "sin": 56, "cos": 56, "atan2": 120}

#: Operations behind one node, where it is more than one; sine and cosine of one argument come together.
_OPERATIONS = {"div": 3, "sqrt": 3, "sin": 16, "cos": 16, "atan2": 40}

#: Operations started in one cycle.
_WIDTH = 2


def latency_order(tape, arguments, lags=(0,)):
    """Pairs (copy, node) of a program, each after its arguments, those with the longest chain behind them first.

    ``arguments`` lists what each node waits for, in any order of evaluation. The program is printed once for each of
    ``lags``, copy beside copy; a copy's operations count as so many cycles less urgent.
    """
    users, waits = _dependencies(arguments)
    height = {}
    for i in reversed(arguments):
        height[i] = _LATENCY[tape.nodes[i].op] + max((height[u] for u in users[i]), default=0)
    rank = {i: k for k, i in enumerate(arguments)}
    waiting = [dict(waits) for _ in lags]

    def entry(copy, i):
        return lags[copy] - height[i], rank[i], copy, i

    ready = [entry(copy, i) for copy in range(len(lags)) for i in arguments if not waits[i]]
    heapq.heapify(ready)
    running, result, time, free = [], [], 0, 0
    while ready or running:
        while ready and free <= time:
            *_, copy, i = heapq.heappop(ready)
            op = tape.nodes[i].op
            result.append((copy, i))
            heapq.heappush(running, (time + _LATENCY[op], copy, i))
            free += _OPERATIONS.get(op, 1) / _WIDTH
        time = max(time, min([*(r[0] for r in running[:1]), *([free] if ready else [])]))
        free = max(free, time)
        while running and running[0][0] <= time:
            _, copy, i = heapq.heappop(running)
            for u in users[i]:
                waiting[copy][u] -= 1
                if not waiting[copy][u]:
                    heapq.heappush(ready, entry(copy, u))
    return result


def _dependencies(arguments):
    """Who uses each node, and for how many arguments each node waits."""
    users, waits = {i: [] for i in arguments}, {}
    for i, args in arguments.items():
        within = {a for a in args if a in users}
        waits[i] = len(within)
        for a in within:
            users[a].append(i)
    return users, waits
