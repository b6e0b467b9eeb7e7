"""Bodies of teeth that are alike: a shape is eliminated once, and what it leaves turned to where it is repeated.

Teeth join one another at their cuts. What the inside of one leaves there, and the work of load cases on it, is that of
any other one like it, turned: the cyclic substructures of J. S. Przemieniecki, Theory of matrix structural analysis
(1968), chapter 9.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from meshwright.fe.dissection import chained, dissected
from meshwright.fe.factor import Remainder, eliminated
from meshwright.fe.gap import Bools
from meshwright.fe.hexahedra import Floats, HexMesh, Ints

# Teeth are alike where their nodes, and the loads on them, are so to this part of their size.
_ALIKE = 1e-10


@dataclass(frozen=True)
class _Tooth:
    """A tooth of a body: its ``elements`` (E, 8), numbered in itself, and numbers in the body of its ``nodes`` (L,).

    corners (L, 3): where they are, from their middle. held, joined (L,): which of them do not move, and which others it
    shares with its neighbours. cases (A,): the load cases on it, with ``forces`` (F, 3, A) on the ``loaded`` (F,).
    """

    elements: Ints
    nodes: Ints
    corners: Floats
    held: Bools
    joined: Bools
    cases: Ints
    loaded: Ints
    forces: Floats

    def turn_to(self, other: _Tooth) -> Floats | None:
        """The turn (3, 3), rows to rows, that makes this one the other, whose loads this one has; None for none."""
        if not np.array_equal(self.elements, other.elements):
            return None
        left, _, right = np.linalg.svd(self.corners.T @ other.corners)
        turn = left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
        if not _close(self.corners @ turn, other.corners):
            return None
        same = len(self.cases) == len(other.cases) and np.array_equal(self.loaded, other.loaded)
        same = same and _close(np.einsum("fia,ij->fja", self.forces, turn), other.forces)
        return turn if same or not len(other.cases) else None


def work(
    mesh: HexMesh, stiffness: Callable[[Floats], Floats], held: Ints, rows: int, nodes: Ints, forces: Floats, teeth: int
) -> Floats:
    """(C, C) matrix forces^T K^-1 forces of load cases ``forces`` (K, 3, C) on distinct ``nodes`` (K,).

    stiffness: corners (M, 8, 3) of elements to their (M, 24, 24); ``held`` nodes do not move. The mesh is made of so
    many ``teeth``, one after another, with ``rows`` elements of each quadrilateral of their sections in a row.
    """
    whole = _teeth(mesh, held, nodes, forces, teeth)
    total, left = np.zeros((forces.shape[2],) * 2), {}
    # loaded ones first: of their loads those that have none make no use
    waiting = sorted(range(teeth), key=lambda number: -len(whole[number].cases))
    while waiting:
        first, turns = whole[waiting[0]], {}
        for number in waiting:
            if (turn := first.turn_to(whole[number])) is not None:
                turns[number] = turn
        alike = [whole[number] for number in turns]
        held_by_all = np.all([tooth.held for tooth in alike], axis=0)
        border = np.any([tooth.joined | tooth.held for tooth in alike], axis=0) & ~held_by_all
        own = HexMesh(mesh.nodes[first.nodes], first.elements)
        inside = ~border[first.loaded]
        parts = dissected(own, rows, np.flatnonzero(held_by_all), np.flatnonzero(border))
        remainder, moved = eliminated(
            parts, own.elements, stiffness(own.nodes[own.elements]), first.loaded[inside], first.forces[inside], []
        )
        for number, turn in turns.items():
            left[number] = _turned(remainder, whole[number], turn)
            total[np.ix_(*(whole[number].cases,) * 2)] += moved if len(whole[number].cases) else 0.0
        waiting = [number for number in waiting if number not in turns]
    borders, parts = chained([left[number].border for number in range(teeth)])
    known = [_in_order(left[number], border) for number, border in enumerate(borders)]
    nothing = np.empty((0, 8), dtype=np.int64), np.empty((0, 24, 24))
    return total + eliminated(parts, *nothing, nodes, forces, known)[1]


def _close(found: Floats, wanted: Floats) -> bool:
    return bool(np.abs(found - wanted).max(initial=0.0) <= _ALIKE * np.abs(wanted).max(initial=0.0))


def _teeth(mesh: HexMesh, held: Ints, nodes: Ints, forces: Floats, teeth: int) -> list[_Tooth]:
    """The teeth of a mesh; loads on nodes that they share are on none of them."""
    fixed = np.zeros(len(mesh.nodes), dtype=bool)
    fixed[held] = True
    row = np.full(len(mesh.nodes), -1)
    row[nodes] = np.arange(len(nodes))
    own = [np.unique(elements, return_index=True, return_inverse=True) for elements in np.split(mesh.elements, teeth)]
    of_teeth = np.bincount(np.concatenate([numbers for numbers, _, _ in own]), minlength=len(mesh.nodes))
    found = []
    for elements, (numbers, begin, inside) in zip(np.split(mesh.elements, teeth), own, strict=True):
        order = np.argsort(begin)
        here, joined = elements.ravel()[begin[order]], of_teeth[numbers[order]] > 1
        loaded = np.flatnonzero((row[here] >= 0) & ~joined)
        acting, corners = forces[row[here[loaded]]], mesh.nodes[here]
        cases = np.flatnonzero(acting.any(axis=(0, 1)))
        found.append(
            _Tooth(
                np.argsort(order)[inside].reshape(elements.shape), here, corners - corners.mean(axis=0), fixed[here],
                joined & ~fixed[here], cases, loaded, acting[:, :, cases],
            )
        )  # fmt: skip
    return found


def _turned(remainder: Remainder, tooth: _Tooth, turn: Floats) -> Remainder:
    """What a tooth like another one leaves on its border, without the held nodes of it."""
    moving, count = np.flatnonzero(~tooth.held[remainder.border]), len(remainder.border)
    whole = np.tril(remainder.stiffness) + np.tril(remainder.stiffness, -1).T
    whole = whole.reshape(count, 3, count, 3)[moving][:, :, moving]
    whole = np.einsum("aibj,ik,jl->akbl", whole, turn, turn, optimize=True).reshape((3 * len(moving),) * 2)
    border, acting = tooth.nodes[remainder.border[moving]], remainder.cases if len(tooth.cases) else tooth.cases
    loads = remainder.loads[:, : len(acting)].reshape(count, 3, len(acting))[moving]
    loads = np.einsum("bia,ij->bja", loads, turn).reshape(len(whole), len(acting))
    return Remainder(border, whole, loads, tooth.cases[acting])


def _in_order(remainder: Remainder, border: Ints) -> Remainder:
    """The same with the nodes of its border in another order."""
    ascending = np.argsort(remainder.border)
    at = ascending[np.searchsorted(remainder.border[ascending], border)]
    freedoms = (3 * at[:, None] + np.arange(3)).ravel()
    return replace(
        remainder, border=border, stiffness=remainder.stiffness[np.ix_(freedoms, freedoms)],
        loads=remainder.loads[freedoms],
    )  # fmt: skip
