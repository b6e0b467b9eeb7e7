"""Cholesky factorisation of a stiffness matrix front by front, and what it says of many load cases at once.

Every part of a dissected mesh is a dense front: its children's remainders, or its own elements, are added up, nodes
that no other part has are eliminated, and what remains on its border goes to its parent: I. S. Duff and J. K. Reid,
The multifrontal solution of indefinite sparse symmetric linear equations (1983). The load cases go along; as only their
work on one another is asked for, nothing is kept of the factor.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.linalg.blas import dsyrk, dtrsm  # pyright: ignore[reportAttributeAccessIssue]  made when it is imported
from scipy.linalg.lapack import dpotrf  # pyright: ignore[reportAttributeAccessIssue]

from meshwright.fe.dissection import Part
from meshwright.fe.hexahedra import Floats, Ints

# Up to so many pieces in a row a remainder is added piece by piece, else by index.
_PIECES = 40


@dataclass(frozen=True)
class Remainder:
    """What a part leaves on its border: stiffness (3B, 3B), lower triangle, and loads (3B, A) of the ``cases`` (A,)."""

    border: Ints
    stiffness: Floats
    loads: Floats
    cases: Ints


def eliminated(
    parts: list[Part], elements: Ints, stiffness: Floats, nodes: Ints, forces: Floats, known: list[Remainder]
) -> tuple[Remainder, Floats]:
    """What the last of some parts leaves, and the (C, C) work of load cases on one another in what is eliminated.

    forces (K, 3, C) on ``nodes`` (K,): those on the last border are left out. The ``elements`` (M, 8) have the
    ``stiffness`` (M, 24, 24); of the parts with the first numbers what they leave is ``known``, and ``parts`` have the
    next numbers. Nodes that no part has do not move. Where nothing is left the work is forces^T K^-1 forces.
    """
    count = 1 + max(int(of.max(initial=0)) for of in (elements, *(part.own for part in parts)))
    total = np.zeros((forces.shape[2], forces.shape[2]))
    loads = _Loads.of(nodes, forces, max(count, int(nodes.max(initial=0)) + 1))
    place = np.full(count, -1)
    largest = max(3 * (len(part.own) + len(part.border)) for part in parts)
    room = np.empty(largest * largest)
    left = dict(enumerate(known))
    for number, part in enumerate(parts, len(known)):
        here = np.concatenate([part.own, part.border])
        place[here] = np.arange(len(here))
        size, own = 3 * len(here), 3 * len(part.own)
        front = room[: size * size].reshape((size, size), order="F")
        children = [left.pop(k) for k in part.children]
        if children:
            front[:] = 0.0
            for child in children:
                _add(front, child.stiffness, place[child.border])
        else:
            _assemble(front, place[elements[part.elements]], stiffness[part.elements])
        cases, moved = loads.on(part.own, children, place, size)
        place[here] = -1
        remainder = _eliminate(front, moved, own)
        total[np.ix_(cases, cases)] += moved[:own].T @ moved[:own]
        left[number] = Remainder(part.border, remainder, moved[own:], cases)
    (last,) = left.values()
    return last, total


def _eliminate(front: Floats, loads: Floats, own: int) -> Floats:
    """Eliminate the first ``own`` degrees of freedom, of the loads in place; the stiffness of the rest."""
    if own == 0:
        return front.copy(order="F")
    lower, info = dpotrf(front[:own, :own], lower=1, clean=0)
    if info != 0:
        raise ArithmeticError("the teeth are not held: their stiffness has a motion without resistance")
    if loads.shape[1]:
        loads[:own] = dtrsm(1.0, lower, loads[:own], lower=1)
    if own == len(front):
        return np.empty((0, 0))
    across = dtrsm(1.0, lower, front[own:, :own], side=1, lower=1, trans_a=1)
    if loads.shape[1]:
        loads[own:] -= across @ loads[:own]
    return dsyrk(-1.0, across, 1.0, front[own:, own:], lower=1)


def _freedoms(nodes: Ints) -> Ints:
    """The three degrees of freedom of each node, one after the other."""
    return (3 * nodes[..., None] + np.arange(3)).reshape(*nodes.shape[:-1], -1)


def _assemble(front: Floats, places: Ints, stiffness: Floats) -> None:
    """The front of elements with nodes at ``places`` (M, 8), -1 where one is held."""
    size = len(front)
    at = np.where(np.repeat(places, 3, axis=1) < 0, size, _freedoms(places))
    flat = (at[:, None, :] * (size + 1) + at[:, :, None]).ravel()
    summed = np.bincount(flat, weights=stiffness.ravel(), minlength=(size + 1) ** 2)
    front[:] = summed.reshape(size + 1, size + 1)[:size, :size]


def _add(front: Floats, remainder: Floats, places: Ints) -> None:
    """Add the lower triangle of a remainder at ascending places of its nodes."""
    if not len(places):
        return
    breaks = np.flatnonzero(np.diff(places) != 1) + 1
    if len(breaks) >= _PIECES:
        freedoms = _freedoms(places)
        front[np.ix_(freedoms, freedoms)] += remainder
        return
    pieces = [(3 * low, 3 * high, 3 * int(places[low])) for low, high in pairwise([0, *breaks.tolist(), len(places)])]
    for k, (low, high, at) in enumerate(pieces):
        for first, last, to in pieces[: k + 1]:
            front[at : at + high - low, to : to + last - first] += remainder[low:high, first:last]


@dataclass(frozen=True)
class _Loads:
    """Load cases: forces (K, 3, C), and which row of them a node has, -1 for none."""

    forces: Floats
    row: Ints

    @classmethod
    def of(cls, nodes: Ints, forces: Floats, count: int) -> _Loads:
        row = np.full(count, -1)
        row[nodes] = np.arange(len(nodes))
        return cls(forces, row)

    def on(self, own: Ints, children: list[Remainder], place: Ints, size: int) -> tuple[Ints, Floats]:
        """The cases (A,) that act on a front, and their loads (size, A): those of its children and on its own nodes."""
        loaded = own[self.row[own] >= 0]
        forces = self.forces[self.row[loaded]]
        acting = np.flatnonzero(forces.any(axis=(0, 1)))
        cases = np.unique(np.concatenate([acting, *(child.cases for child in children)]))
        loads = np.zeros((size, len(cases)), order="F")
        for child in children:
            if len(child.cases):
                loads[np.ix_(_freedoms(place[child.border]), np.searchsorted(cases, child.cases))] += child.loads
        if len(loaded):
            loads[_freedoms(place[loaded])] += forces[:, :, cases].reshape(-1, len(cases))
        return cases, loads
