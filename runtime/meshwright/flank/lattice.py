"""Nodes over a chart that lie inside limits and hang together."""

from dataclasses import dataclass

import numpy as np

from meshwright.flank.lines import SINGULAR


@dataclass(frozen=True)
class Lattice:
    """Nodes over a chart: ``lines``, two ascending arrays; ``q`` (n, m, k) parameters, ``inside`` (n, m)."""

    lines: tuple[np.ndarray, np.ndarray]
    q: np.ndarray
    inside: np.ndarray

    @property
    def shape(self):
        return self.inside.shape


def flooded(chart, limits, lines, seed):
    """The :class:`Lattice` on two lines: nodes inside the limits that can be reached from ``seed`` (k,) node by node
    without leaving any but singular limits.
    """
    if len(chart.sizes) == 2:
        grid = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)
        q = grid.reshape(-1, 2)
    else:
        q = _completed_outwards(chart, lines, seed).reshape(-1, len(chart.sizes))
    values = limits.values(chart.flank(q))
    shape = tuple(len(line) for line in lines)
    singular = np.array([name in SINGULAR for name in limits.names])
    inside = (values.min(axis=1) >= 0.0).reshape(shape)
    exists = np.isfinite(values.min(axis=1))
    within = (exists & (values[:, ~singular].min(axis=1, initial=np.inf) >= 0.0)).reshape(shape)
    return Lattice(lines, q.reshape(*shape, -1), inside & _connected(within, _nearest(lines, seed[list(chart.free)])))


def _nearest(lines, place):
    return tuple(int(np.argmin(np.abs(line - x))) for line, x in zip(lines, place, strict=True))


def _connected(within, start):
    """The nodes of a mask that hang together with the node ``start``, or with the nearest one in it."""
    if not within.any():
        return within
    if not within[start]:
        nodes = np.argwhere(within)
        start = tuple(nodes[np.argmin(((nodes - start) ** 2).sum(axis=1))])
    reached = np.zeros_like(within)
    reached[start] = True
    while True:
        grown = reached.copy()
        grown[1:] |= reached[:-1]
        grown[:-1] |= reached[1:]
        grown[:, 1:] |= reached[:, :-1]
        grown[:, :-1] |= reached[:, 1:]
        grown &= within
        if (grown == reached).all():
            return reached
        reached = grown


def _completed_outwards(chart, lines, seed):
    """Parameters (n, m, k) on the lattice, each line solved from its neighbour on the side of the seed."""
    shape, (i, j) = tuple(len(line) for line in lines), _nearest(lines, seed[list(chart.free)])
    q = np.full((*shape, len(seed)), np.nan)
    start = seed[None]
    for order in (range(j, shape[1]), range(j - 1, -1, -1)):
        near = start if order.step > 0 else q[i, j][None]
        for b in order:
            q[i, b] = near = chart.complete(np.array([[lines[0][i], lines[1][b]]]), near)
    for order in (range(i + 1, shape[0]), range(i - 1, -1, -1)):
        near = q[i]
        for a in order:
            places = np.stack([np.full(shape[1], lines[0][a]), lines[1]], axis=1)
            q[a] = chart.complete(places, near)
            near = np.where(np.isfinite(q[a]), q[a], near)
    return q
