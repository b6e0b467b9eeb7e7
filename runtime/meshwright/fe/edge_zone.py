"""Pressure beside the sharp edges that cut a contact area off, and what is left of the peak without them.

Below a sharp edge that presses a flank which goes on, pressure grows without bound as cells shrink; the force beside it
does not (K. L. Johnson, Contact Mechanics, 1985, section 5.1). The peak of pressure is therefore that of the free
contact, no nearer to such an edge than a quarter of the contact's length along and of its width across; where more than
half of the force is nearer, of the half that is furthest away. What is nearer is told by its force, length and mean
pressure. Length and width are those of Hertz's ellipse with the same second moments of pressure: as all these are
integrals, the peak changes without a jump with load, form and place. Flush ends of both members are not sharp: material
is free on either side there, and pressure is bounded.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from meshwright.fe.gap import ContactGrid
from meshwright.fe.hexahedra import Floats, Ints

# Depth of the zone beside a sharp edge, in parts of width and length of the contact.
_DEPTH = 0.25
# Part of the force that the zone has at most.
_MOST = 0.5
# Axes of Hertz's ellipse, in standard deviations of its pressure along them.
_AXIS = 2.0 * math.sqrt(5.0)
# Cells that are so many lengths and widths apart are no neighbours across the border of the zone.
_NEIGHBOURS = 0.1


@dataclass(frozen=True)
class EdgeLoad:
    """What presses beside a sharp ``edge`` such as "tip of the wheel".

    force: in N on the zone; length: in mm of the edge that presses; pressure: mean in MPa of what presses in the zone.
    """

    edge: str
    force: float
    length: float
    pressure: float


@dataclass(frozen=True)
class EdgeZone:
    """Peak of pressure in MPa of the free contact; depth (2,) of the zone beside sharp edges, along and across the
    contact, mm, None where none presses; and what it carries.  holds: whether it carries as much as half of the force,
    so that there is no peak beyond it that finer cells would leave as it is.
    """

    peak: float
    holds: bool = False
    depth: tuple[float, float] | None = None
    loads: tuple[EdgeLoad, ...] = ()

    @classmethod
    def of(cls, grid: ContactGrid, pressures: Floats) -> EdgeZone:
        """pressures (N,): of the cells, MPa."""
        side, cell = np.nonzero(grid.sharp * (pressures > 0.0))
        if not len(cell):
            return cls(float(pressures.max()))
        places, forces = _places(grid), grid.area * pressures
        spread = _spread(grid, places, forces)
        # Lengths are measured in those of the contact, which is then as long as wide.
        measure = np.linalg.inv(_AXIS * np.linalg.cholesky(spread))
        away = _away(grid, places, side, cell, measure) / grid.sharp[side, cell]
        distance, next_side = away.min(axis=1), away.argmin(axis=1)
        depth = min(_DEPTH, _share_within(distance, forces))
        along, across = depth * _AXIS * np.sqrt(np.diagonal(spread))
        inside = distance < depth
        names = [_names(grid, int(of), int(at)) for of, at in zip(side, cell, strict=True)]
        loads = []
        for edge in sorted(set(names)):
            there = np.array([name == edge for name in names])
            zone = inside & there[next_side] & (pressures > 0.0)
            length = float(2.0 * grid.half[cell, 1 - side // 2] @ there)
            if zone.any():
                force = float(forces[zone].sum())
                loads.append(EdgeLoad(edge, force, length, force / float(grid.area[zone].sum())))
        peak = _peak(grid, pressures, distance, depth)
        return cls(peak, depth < _DEPTH, (float(along), float(across)), tuple(loads))


def _names(grid: ContactGrid, side: int, cell: int) -> str:
    """The edges on a side of a cell, in words."""
    return " and ".join(f"the {edge}" for edge, at in grid.beyond.items() if at[side, cell])


def _places(grid: ContactGrid) -> Floats:
    """Places (N, 2) of cells along the strip and across it from the least gap, mm: a bent strip laid out straight."""
    steps = 2.0 * grid.half[:, 0].reshape(grid.rows, -1).mean(axis=1)
    return np.stack([np.repeat(np.cumsum(steps) - 0.5 * steps, grid.columns), grid.offset], axis=1)


def _spread(grid: ContactGrid, places: Floats, forces: Floats) -> Floats:
    """Second moments (2, 2) in mm^2 of forces (N,) about their middle."""
    share = forces / forces.sum()
    apart = places - share @ places
    return (share * apart.T) @ apart + np.diag(share @ grid.half**2 / 3.0)


def _away(grid: ContactGrid, places: Floats, side: Ints, cell: Ints, measure: Floats) -> Floats:
    """Distances (N, M) of cells from M sides of cells, in the measure (2, 2) of lengths."""
    axis, rows = side // 2, np.arange(len(cell))
    middle, half = places[cell].copy(), np.zeros((len(cell), 2))
    middle[rows, axis] += (2.0 * (side % 2) - 1.0) * grid.half[cell, axis]
    half[rows, 1 - axis] = grid.half[cell, 1 - axis]
    middle, half, own = middle @ measure.T, half @ measure.T, places @ measure.T
    apart = own[:, None] - middle
    share = np.clip(np.einsum("nmi,mi->nm", apart, half) / np.einsum("mi,mi->m", half, half), -1.0, 1.0)
    return np.linalg.norm(apart - share[..., None] * half, axis=2)


def _share_within(distance: Floats, forces: Floats) -> float:
    """The distance within which there is so much of the forces (N,) as a zone has at most."""
    order = np.argsort(distance)
    whole = np.cumsum(forces[order]) - 0.5 * forces[order]
    return float(np.interp(_MOST * forces.sum(), whole, distance[order]))


def _peak(grid: ContactGrid, pressures: Floats, distance: Floats, depth: float) -> float:
    """The largest pressure at distances (N,) beyond a depth, between cells on either side at the depth itself."""
    highest = float(pressures[distance >= depth].max(initial=0.0))
    far, own = distance.reshape(grid.rows, grid.columns), pressures.reshape(grid.rows, grid.columns)
    for axis in (0, 1):
        (d0, d1), (p0, p1) = (
            (np.delete(of, -1, axis=axis), np.delete(of, 0, axis=axis)) for of in (far, own)
        )  # fmt: skip
        between = ((d0 < depth) != (d1 < depth)) & (np.abs(d1 - d0) < _NEIGHBOURS)
        share = (depth - d0[between]) / (d1 - d0)[between]
        highest = max(highest, float((p0[between] + share * (p1 - p0)[between]).max(initial=0.0)))
    return highest
