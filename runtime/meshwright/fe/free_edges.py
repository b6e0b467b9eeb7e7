"""What free edges of a tooth add to the half-space below cells of a flank near its tip or its faces.

A load beside a free edge has no material to lean on beyond it: the half-space becomes a quarter-space, and the image of
the load beyond the edge, times a factor, makes up for what is missing; of two edges an eighth with the image of the
image. Teeth end at their tips under more than a right angle, which makes them somewhat stiffer than that.
Source: R. Guilbault, A fast correction for elastic quarter-space applied to 3D modeling of edge contact problems, ASME
Journal of Tribology 133 (2011) 031402.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from meshwright.fe.compliance import TOOTH_PATCHES, ToothCompliance
from meshwright.fe.gap import ContactGrid
from meshwright.fe.halfspace import far_or_near, image_factor, mean_displacement
from meshwright.fe.hexahedra import Floats, Ints
from meshwright.fe.material import Material

# Cells that show where an edge runs, at least.
_FEWEST_CELLS = 3


@dataclass(frozen=True)
class _Edge:
    """A free edge of a flank: ``axis`` 0 for the tip, 1 for a face, at the ``end`` (0 or 1) of arc length or width; in
    the contact plane it is where ``share`` + ``slope`` (2,) · (x, y) is ``end``.
    """

    axis: int
    end: float
    share: float
    slope: Floats

    def image(self, places: Floats) -> Floats:
        """Places (N, 2) of the contact plane beyond the edge, as far from it as others."""
        away = (self.end - self.share - places @ self.slope) / (self.slope @ self.slope)
        return places + 2.0 * np.outer(away, self.slope)


def free_edge_displacements(
    grid: ContactGrid, name: str, material: Material, tooth: ToothCompliance | None
) -> Floats | None:
    """Displacements (N, N) in mm of the cells of a grid by unit pressures that free edges of a member add.

    None where no edge is within a patch of the tooth's compliance. What that knows of the edges is taken off again.
    """
    (cells,) = np.nonzero(grid.inside)
    edges = list(_edges(grid, name, cells, tooth.shape if tooth else TOOTH_PATCHES))
    if not edges:
        return None
    factor, centres, found = image_factor(material.poisson_ratio), grid.centres[cells], np.zeros((len(cells),) * 2)
    weights = None if tooth is None else tooth.weights(grid.place[name][cells, 0], grid.place[name][cells, 1])
    for count in (1, 2):
        for of in combinations(edges, count):
            if count == 2 and of[0].axis == of[1].axis:
                continue
            image = centres
            for edge in of:
                image = edge.image(image)
            apart = np.abs(centres[:, None] - image[None])
            modulus = material.plane_strain_modulus
            near = far_or_near(apart[..., 0], apart[..., 1], grid.half_major, grid.half_minor, modulus)
            if tooth is not None and weights is not None:
                near -= grid.area * weights @ _between_patches(tooth, of, modulus) @ weights.T
            found += factor**count * near
    whole = np.zeros((len(grid.gap),) * 2)
    whole[np.ix_(cells, cells)] = found
    return whole


def _edges(grid: ContactGrid, name: str, cells: Ints, shape: tuple[int, int]) -> Iterator[_Edge]:
    """The free edges of a member within a patch of the cells of a grid."""
    known = [(0, 1.0)] + ([(1, 0.0), (1, 1.0)] if f"face of the {name}" in grid.beyond else [])
    place, centres = grid.place[name][cells], grid.centres[cells]
    for axis, end in known:
        near = np.abs(end - place[:, axis]) * shape[axis]
        if len(cells) < _FEWEST_CELLS or not near.min() < 1.0:
            continue
        chosen = near <= max(1.0, float(np.sort(near)[_FEWEST_CELLS - 1]))
        linear = np.column_stack([np.ones(int(chosen.sum())), centres[chosen]])
        share, *slope = np.linalg.lstsq(linear, place[chosen, axis], rcond=None)[0]
        if np.hypot(*slope) > 0.0:
            yield _Edge(axis, end, float(share), np.array(slope))


def _between_patches(tooth: ToothCompliance, edges: tuple[_Edge, ...], modulus: float) -> Floats:
    """(P Q, P Q) mean displacements in mm of patches by the images of unit loads on others, on the flank laid flat."""
    p, q = (index.ravel() for index in np.meshgrid(*(np.arange(n) for n in tooth.shape), indexing="ij"))
    steps = [np.abs(index[:, None] - index[None]) for index in (p, q)]
    for edge in edges:
        index, count = (p, q)[edge.axis], tooth.shape[edge.axis]
        both = index[:, None] + index[None] + 1
        steps[edge.axis] = both if edge.end == 0.0 else 2 * count - both
    half_x, half_y = tooth.half
    offsets = (2.0 * half * np.arange(2 * count) for half, count in zip(tooth.half, tooth.shape, strict=True))
    x, y = np.meshgrid(*offsets, indexing="ij")
    table = mean_displacement(x, y, half_x, half_y, modulus) / (4.0 * half_x * half_y)
    return table[steps[0], steps[1]]
