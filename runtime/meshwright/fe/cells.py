"""How the cells of all pairs move one another, and what bears given displacements of those that touch.

Half-space and free edges join the cells of one pair alone, teeth join all pairs through a few patches. The cells are
therefore factorised pair by pair, and what teeth add is solved for in the patches: M. A. Woodbury, Inverting modified
matrices (1950).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.linalg import LinAlgError, block_diag, cholesky, lu_factor, lu_solve, solve_triangular

from meshwright.fe.compliance import ToothCompliance, without_negative
from meshwright.fe.free_edges import free_edge_displacements
from meshwright.fe.gap import ContactGrid
from meshwright.fe.halfspace import between_cells, symmetric
from meshwright.fe.hexahedra import Floats, Ints
from meshwright.fe.material import contact_modulus
from meshwright.fe.pair import GearPair, PairTouch

# What a cell gives way at least, in parts of what it does on a half-space.
_LEAST_GIVING = 1e-6


@dataclass(frozen=True)
class PairCells:
    """The n cells of a pair, with ``areas`` (n,) in mm².

    work (n, n): work in N mm that a unit pressure on one does on the displacement of another by a unit pressure there,
    by half-space and free edges: symmetric (E. Betti, 1872).  weights (n, M): of the displacements of its own teeth,
    the pinion's before the wheel's.
    """

    work: Floats
    weights: Floats
    areas: Floats

    def under(self, pressure: Floats) -> Floats:
        """Displacements (n,) of all cells under pressures (n,), by half-space and free edges."""
        return self.work @ pressure / self.areas


@dataclass(frozen=True)
class Cells:
    """The cells of all ``pairs``, N together.

    Teeth move in Q ways that the patches under the cells tell apart. ways: of each pair, which of them are its own.
    smooth (Q, Q): displacements in these by unit forces in others, what teeth add to half-space and free edges.
    """

    pairs: tuple[PairCells, ...]
    ways: tuple[Ints, ...]
    smooth: Floats

    @classmethod
    def of(
        cls, gear: GearPair, contacts: tuple[PairTouch, ...], grids: list[ContactGrid],
        compliance: dict[str, ToothCompliance],
    ) -> Cells:
        modulus = contact_modulus(gear.pinion.material, gear.wheel.material)
        members = (("pinion", gear.pinion), ("wheel", gear.wheel))
        edges = {
            name: [free_edge_displacements(grid, name, of.material, compliance.get(name)) for grid in grids]
            for name, of in members
        }
        images = [[of[0] for of in both if of] for both in zip(*edges.values(), strict=True)]
        works = [
            positive(symmetric(between_cells(grid, modulus), grid.area), of)
            for grid, of in zip(grids, images, strict=True)
        ]
        later = tuple(contact.pairs_later for contact in contacts)
        weights: list[list[Floats]] = [[np.empty((len(grid.gap), 0))] for grid in grids]
        ways: list[list[Ints]] = [[np.empty(0, dtype=np.int64)] for _ in grids]
        blocks: list[Floats] = [np.empty((0, 0))]
        for name, tooth in compliance.items():
            known = tuple(None if of is None or of[1] is None else of[1].tobytes() for of in edges[name])
            spans = [tooth.span(*grid.place[name].T) for grid in grids]
            begin = sum(len(block) for block in blocks) + np.cumsum([0] + [span.shape[1] for span in spans])
            for k, (grid, span) in enumerate(zip(grids, spans, strict=True)):
                weights[k].append(tooth.weights(*grid.place[name].T) @ span)
                ways[k].append(np.arange(begin[k], begin[k + 1]))
            blocks.append(_within(_smooth(tooth, later, known), spans))
        pairs = tuple(
            PairCells(work, np.hstack(w), grid.area) for work, w, grid in zip(works, weights, grids, strict=True)
        )
        return cls(pairs, tuple(np.concatenate(of) for of in ways), block_diag(*blocks))

    @property
    def sizes(self) -> list[int]:
        """How many cells each pair has."""
        return [len(pair.weights) for pair in self.pairs]

    def of_pairs(self, values: Floats) -> list[Floats]:
        """Values (N, …) of all cells pair by pair."""
        return np.split(values, np.cumsum(self.sizes)[:-1])

    def under(self, pressure: Floats) -> Floats:
        """Displacements (N,) of all cells under pressures (N,)."""
        forces, parts = np.zeros(len(self.smooth)), self.of_pairs(pressure)
        for pair, at, own in zip(self.pairs, self.ways, parts, strict=True):
            forces[at] += (pair.areas * own) @ pair.weights
        moved = self.smooth @ forces
        return np.concatenate([
            pair.under(own) + pair.weights @ moved[at]
            for pair, at, own in zip(self.pairs, self.ways, parts, strict=True)
        ])  # fmt: skip

    @property
    def largest(self) -> float:
        """The largest displacement (mm) of a cell by a unit pressure on itself."""
        own = [
            np.diagonal(pair.work) / pair.areas
            + pair.areas * np.sum((pair.weights @ self.smooth[np.ix_(at, at)]) * pair.weights, axis=1)
            for pair, at in zip(self.pairs, self.ways, strict=True)
        ]
        return float(np.abs(np.concatenate(own)).max())

    def bearing(self, used: Ints) -> Bearing:
        """What bears displacements of the cells ``used`` (U,), ascending.

        Raises ArithmeticError where their pressures are not determined.
        """
        ends = np.searchsorted(used, np.cumsum(self.sizes))
        first = np.cumsum([0, *self.sizes[:-1]])
        lowers, joints = [], []
        joined = np.eye(len(self.smooth))
        for pair, at, begin, own in zip(self.pairs, self.ways, first, np.split(used, ends[:-1]), strict=True):
            cells = own - begin
            try:
                lowers.append(cholesky(pair.work[np.ix_(cells, cells)], lower=True, check_finite=False))
            except LinAlgError as error:
                raise ArithmeticError("the pressures of the cells in contact are not determined") from error
            joints.append(_lower_solved(lowers[-1], pair.areas[cells, None] * pair.weights[cells]))
            joined[:, at] += self.smooth[:, at] @ (joints[-1].T @ joints[-1])
        return Bearing(ends, tuple(lowers), tuple(joints), self.ways, self.smooth, lu_factor(joined, True, False))


@dataclass(frozen=True)
class Bearing:
    """Cells in contact, U together, factorised: what forces on them move one another by, times their areas. Two loads
    do the same work on one another's displacements (E. Betti, 1872), so it is symmetric.

    ends: numbers among U at which the cells of each pair end; lowers: of each pair the factor of Cholesky (u, u) of
    half-space and free edges; joints (u, M): the cells' forces in the ``ways`` of their teeth, solved with that;
    joined: factors of 1 + S G with S = ``smooth``, and G the forces by unit displacements in these ways.
    """

    ends: Ints
    lowers: tuple[Floats, ...]
    joints: tuple[Floats, ...]
    ways: tuple[Ints, ...]
    smooth: Floats
    joined: tuple[Floats, Ints]

    def pressures(self, work: Floats) -> Floats:
        """Pressures (U, K) under which cells move by displacements times their areas, ``work`` (U, K)."""
        forces = np.zeros((len(self.smooth), work.shape[1]))
        parts = [
            _lower_solved(low, own) for low, own in zip(self.lowers, np.split(work, self.ends[:-1]), strict=True)
        ]
        for joint, at, own in zip(self.joints, self.ways, parts, strict=True):
            forces[at] += joint.T @ own
        moved = lu_solve(self.joined, self.smooth @ forces, overwrite_b=True, check_finite=False)
        return np.vstack([
            _lower_solved(low, own - joint @ moved[at], transposed=True)
            for low, joint, at, own in zip(self.lowers, self.joints, self.ways, parts, strict=True)
        ])  # fmt: skip


def _lower_solved(lower: Floats, values: Floats, transposed: bool = False) -> Floats:
    return solve_triangular(lower, values, trans=int(transposed), lower=True, check_finite=False)


def positive(half_space: Floats, images: list[Floats]) -> Floats:
    """Work (n, n) of a half-space and the images of its loads, of which the middles of cells leave what is positive.

    Where cells are long and thin or smaller than their distance from an edge, middles are not the means that they stand
    for: what is negative is left out.
    """
    size = np.sqrt(np.diagonal(half_space))
    scaled = np.sum([half_space, *images], axis=0) / np.outer(size, size)
    least = _LEAST_GIVING * np.eye(len(size))
    try:
        cholesky(scaled - least, check_finite=False)
    except LinAlgError:
        scaled = without_negative(scaled) + least
    return scaled * np.outer(size, size)


def _within(whole: Floats, spans: list[Floats]) -> Floats:
    """B^T A B of a matrix (T K, T K) with the blocks (K, R) of T spans along the diagonal of B."""
    half = np.hstack([part @ span for part, span in zip(np.split(whole, len(spans), axis=1), spans, strict=True)])
    return np.vstack([span.T @ part for part, span in zip(np.split(half, len(spans)), spans, strict=True)])


@lru_cache(maxsize=16)
def _smooth(tooth: ToothCompliance, later: tuple[int, ...], known: tuple[bytes | None, ...]) -> Floats:
    """What patches of the teeth of T pairs, ``pairs_later``, move one another by unit forces: (T P Q, T P Q).

    known: of each tooth, the bytes of (P Q, P Q) of that which free edges add to the cells already, None for nothing.
    What is left stores no negative energy: teeth are cut out of the half-space, and stiffer by the coarseness of their
    mesh alone.
    """
    nothing = np.zeros_like(tooth.own)
    blocks = [[tooth.between(seen, pressed) for pressed in later] for seen in later]
    whole = np.block([[nothing if block is None else block for block in row] for row in blocks])
    of_edges = (nothing if k is None else np.frombuffer(k).reshape(nothing.shape) for k in known)
    return without_negative(whole - block_diag(*of_edges))
