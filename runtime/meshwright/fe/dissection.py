"""Nested dissection of a mesh whose sections all have the same quadrilaterals: the order in which nodes are eliminated.

A part of the mesh is so many quadrilaterals of a section over so many rows of elements. It is cut where that separates
it by the fewest nodes: between two rows, or along a line of the section. What a cut leaves on both sides is eliminated
after either side: A. George, Nested dissection of a regular finite element mesh (1973).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshwright.fe.hexahedra import Floats, HexMesh, Ints

# Parts of so many elements are not cut any further.
_LEAST_ELEMENTS = 48
# Directions of the lines that are tried across a section, and the shares of its quadrilaterals on one side of them.
_DIRECTIONS, _SHARES = 12, (0.4, 0.5, 0.6)


@dataclass(frozen=True)
class Part:
    """A part of a mesh, children before parents in the list that holds it.

    elements (M,): its elements, none where it is cut; children: numbers of its two sides in the list.
    own (O,): nodes whose elements all lie in this part, not in one side alone; border (B,): those that it shares with
    others; both in the order of elimination, without the held ones.
    """

    elements: Ints
    children: tuple[int, ...]
    own: Ints
    border: Ints


def dissected(mesh: HexMesh, rows: int, held: Ints, kept: Ints) -> list[Part]:
    """The parts of a mesh with ``rows`` elements of each quadrilateral of its section in a row; the whole is last.

    held: nodes that do not move; kept: nodes that no part eliminates, the border of the whole.
    """
    section = _Section.of(mesh, rows)
    cuts: list[tuple[Ints, tuple[int, ...]]] = []

    def cut(quads: Ints, low: int, high: int) -> int:
        if len(quads) * (high - low) <= _LEAST_ELEMENTS:
            cuts.append(((quads[:, None] * rows + np.arange(low, high)).ravel(), ()))
            return len(cuts) - 1
        between_rows = section.nodes(quads)
        across = section.cut(quads)
        if across is None or (high - low > 1 and between_rows <= across[0] * (high - low + 1)):
            middle = (low + high) // 2
            sides = cut(quads, low, middle), cut(quads, middle, high)
        else:
            sides = cut(across[1], low, high), cut(across[2], low, high)
        cuts.append((np.empty(0, dtype=np.int64), sides))
        return len(cuts) - 1

    cut(np.arange(len(mesh.elements) // rows), 0, rows)
    return _eliminated(mesh, cuts, held, kept)


def chained(borders: list[Ints]) -> tuple[list[Ints], list[Part]]:
    """Nodes on each of some ``borders`` in the order of elimination, and the parts that join what lies behind these one
    after another: their numbers follow those of the borders, and the whole is last.
    """
    nodes, at = np.unique(np.concatenate(borders), return_inverse=True)
    last = np.zeros(len(nodes), dtype=np.int64)
    np.maximum.at(last, at, np.repeat(np.arange(len(borders)), [len(border) for border in borders]))
    order = np.argsort(last, kind="stable")
    nodes, last = nodes[order], last[order]
    rank = np.argsort(order)
    ranks = np.split(rank[at], np.cumsum([len(border) for border in borders])[:-1])
    parts, open_ = [], np.empty(0, dtype=np.int64)
    for number, own in enumerate(ranks):
        open_ = np.union1d(open_, own)
        done = last[open_] <= number
        children = (len(borders) + number - 1, number) if number else (number,)
        parts.append(Part(np.empty(0, dtype=np.int64), children, nodes[open_[done]], nodes[open_[~done]]))
        open_ = open_[~done]
    return [nodes[np.sort(own)] for own in ranks], parts


def _eliminated(
    mesh: HexMesh, cuts: list[tuple[Ints, tuple[int, ...]]], held: Ints, kept: Ints
) -> list[Part]:
    """The parts, with the nodes that each eliminates: those that no element outside it has."""
    free = np.ones(len(mesh.nodes), dtype=bool)
    free[held] = False
    everywhere = np.bincount(mesh.elements.ravel(), minlength=len(mesh.nodes))
    everywhere[kept] += 1
    shared: list[tuple[Ints, Ints]] = []
    owned: list[Ints] = []
    for elements, children in cuts:
        if children:
            nodes, at = np.unique(np.concatenate([shared[k][0] for k in children]), return_inverse=True)
            counts = np.bincount(at, weights=np.concatenate([shared[k][1] for k in children])).astype(np.int64)
        else:
            nodes, counts = np.unique(mesh.elements[elements], return_counts=True)
            nodes, counts = nodes[free[nodes]], counts[free[nodes]]
        inner = counts == everywhere[nodes]
        owned.append(nodes[inner])
        shared.append((nodes[~inner], counts[~inner]))
    rank = np.empty(len(mesh.nodes), dtype=np.int64)
    order = np.concatenate([*owned, kept])
    rank[order] = np.arange(len(order))
    borders = [nodes[np.argsort(rank[nodes])] for nodes, _ in shared]
    return [Part(*cut, own, border) for cut, own, border in zip(cuts, owned, borders, strict=True)]


@dataclass(frozen=True)
class _Section:
    """The quadrilaterals of a section: their nodes (Q, 4), and the places (Q, D) of their middles in D directions."""

    corners: Ints
    places: Floats
    known: dict[bytes, tuple[int, Ints, Ints] | None]

    @classmethod
    def of(cls, mesh: HexMesh, rows: int) -> _Section:
        middle = mesh.elements.reshape(-1, rows, 8)[:, rows // 2]
        centres = mesh.nodes[middle].mean(axis=1)
        centres = centres - centres.mean(axis=0)
        plane = np.linalg.eigh(centres.T @ centres)[1][:, 1:]
        turns = np.arange(_DIRECTIONS) * np.pi / _DIRECTIONS
        return cls(middle[:, :4], centres @ plane @ np.stack([np.cos(turns), np.sin(turns)]), {})

    def nodes(self, quads: Ints) -> int:
        """How many nodes these quadrilaterals have."""
        return len(np.unique(self.corners[quads]))

    def cut(self, quads: Ints) -> tuple[int, Ints, Ints] | None:
        """How many nodes the best line across some quadrilaterals separates, and the two sides; None for a few."""
        key = quads.tobytes()
        if key not in self.known:
            self.known[key] = self._best(quads) if len(quads) > 3 else None
        return self.known[key]

    def _best(self, quads: Ints) -> tuple[int, Ints, Ints]:
        found = []
        for places in self.places[quads].T:
            for share in _SHARES:
                count = int(share * len(quads))
                order = np.argpartition(places, count)
                sides = quads[order[:count]], quads[order[count:]]
                between = len(np.intersect1d(self.corners[sides[0]], self.corners[sides[1]]))
                found.append((between * (1.0 + (2.0 * share - 1.0) ** 2), between, *sides))
        return min(found, key=lambda one: one[0])[1:]
