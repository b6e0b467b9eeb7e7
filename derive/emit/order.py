"""The order in which a straight-line program is printed.

Any order that respects the arguments gives the same numbers. A processor looks only some hundred operations ahead, so
the program starts early what most other operations wait for (list scheduling): the scalar kernel gains a seventh.
"""

import heapq

#: Cycles until a result can be used, on a current desktop or server processor; only the proportions matter.
_LATENCY = {"add": 3, "sub": 3, "mul": 3, "div": 13, "sqrt": 20, "neg": 1, "sin": 50, "cos": 50, "atan2": 80}

#: Operations started in one cycle.
_WIDTH = 2


def latency_order(tape, order):
    """The same node indices, each after its arguments, those with the longest chain behind them first."""
    users, waiting = _dependencies(tape, order)
    height = {}
    for i in reversed(order):
        height[i] = _LATENCY[tape.nodes[i].op] + max((height[u] for u in users[i]), default=0)
    rank = {i: k for k, i in enumerate(order)}
    ready = [(-height[i], rank[i], i) for i in order if not waiting[i]]
    heapq.heapify(ready)
    running, result, time = [], [], 0
    while ready or running:
        for _ in range(min(_WIDTH, len(ready))):
            i = heapq.heappop(ready)[-1]
            result.append(i)
            heapq.heappush(running, (time + _LATENCY[tape.nodes[i].op], i))
        time += 1
        while running and running[0][0] <= time:
            for u in users[heapq.heappop(running)[1]]:
                waiting[u] -= 1
                if not waiting[u]:
                    heapq.heappush(ready, (-height[u], rank[u], u))
    return result


def _dependencies(tape, order):
    """Who uses each node, and for how many arguments each node waits, both within ``order``."""
    users, waiting = {i: [] for i in order}, {}
    for i in order:
        args = {a for a in tape.nodes[i].args if a in users}
        waiting[i] = len(args)
        for a in args:
            users[a].append(i)
    return users, waiting
