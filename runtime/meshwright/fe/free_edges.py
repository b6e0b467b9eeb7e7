"""What free edges of a tooth add to the half-space below cells of a flank near its tip or its faces.

A load beside a free edge has no material to lean on beyond it: the half-space becomes a quarter-space, and the image of
the load beyond the edge, times a factor, makes up for what is missing; of two edges an eighth with the image of the
image. Teeth end at their tips under more than a right angle, which makes them somewhat stiffer than that.
Source: R. Guilbault, A fast correction for elastic quarter-space applied to 3D modeling of edge contact problems, ASME
Journal of Tribology 133 (2011) 031402.

Finite elements of the whole tooth know its edges, but not closer than to a patch. Images are therefore taken by weights
that fall from 1 at the edge to 0 in the middle of the flank, of the load and of the place that it moves alike, and what
the patches know of the same images is taken off the compliance of the tooth. Weights that fell within a patch or two
would leave a ripple of that length along a line of contact.

The images of loads on one side of an edge store a positive energy: 1/r is reflection positive (K. Osterwalder and R.
Schrader, Axioms for Euclidean Green's functions, 1973), and weights on both sides are a congruence. Distances from an
edge are therefore those of the flank's own coordinates: no cell lies beyond the edge that has its image. Displacements
are those of the middles of cells, which leaves a small remainder of either sign.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations

import numpy as np

from meshwright.fe.compliance import ToothCompliance
from meshwright.fe.gap import ContactGrid
from meshwright.fe.halfspace import far_or_near, image_factor, symmetric
from meshwright.fe.hexahedra import Floats
from meshwright.fe.material import Material

# Cells that show where an edge runs: one in so many, but so many at least.
_NEAREST, _FEWEST_CELLS = 3, 3
# Cells along either side of a patch that its mean takes.
_PER_PATCH = 5
# Of two slopes that cells tell as well, that of the straighter edge counts: by this much in the measure of bends.
_BENT = 1e-3
# A slope below this part of that beside the edge has no direction.
_LEVEL = 1e-3
# From so much of the flank away on an edge has no images.
_WITHIN = 0.5


@dataclass(frozen=True)
class _Beside:
    """Cells beside a free edge: ``axis`` 0 for the tip, 1 for a face, at the ``end`` (0 or 1) of arc length or width.

    away, along (N,): mm from the edge and along it; weight (N,): of their images; half (2, N): half lengths in mm of
    the cells across the edge and along it.
    """

    axis: int
    end: float
    away: Floats
    along: Floats
    weight: Floats
    half: Floats


def free_edge_displacements(
    grid: ContactGrid, name: str, material: Material, tooth: ToothCompliance | None
) -> tuple[Floats, Floats | None] | None:
    """Work (N, N) of unit pressures on the displacements that free edges of a member add by unit pressures on cells of
    a grid, N mm, and what the patches of its tooth know of these: (P Q, P Q) by unit forces, None without a tooth.

    None where no edge is within half of the flank of the cells.
    """
    edges = list(_edges(grid, name))
    if not edges:
        return None
    sets = list(_sets(edges))
    whole = np.zeros((len(grid.area),) * 2)
    for of in sets:
        _add_images(whole, of, material)
    whole = symmetric(whole, grid.area)
    if tooth is None:
        return whole, None
    return whole, np.sum([_known(tooth, material, tuple((e.axis, e.end) for e in of)) for of in sets], axis=0)


def _sets(edges: Sequence[_Beside]) -> Iterator[tuple[_Beside, ...]]:
    """Each edge, and each two that meet in a corner."""
    for count in (1, 2):
        for of in combinations(edges, count):
            if count == 1 or of[0].axis != of[1].axis:
                yield of


def _add_images(whole: Floats, of: tuple[_Beside, ...], material: Material) -> None:
    """Add to (N, N) displacements in mm of cells those by the images of unit pressures on all of them beyond an edge or
    a corner.
    """
    first, *others = of
    weight = np.prod([edge.weight for edge in of], axis=0)
    (near,) = np.nonzero(weight)
    weight, from_edge, beside = weight[near], first.away[near], first.along[near]
    from_others = [other.away[near] for other in others]

    def apart(rows: slice) -> tuple[Floats, Floats]:
        across = from_edge[rows, None] + from_edge
        for from_other in from_others:
            return across, from_other[rows, None] + from_other
        return across, beside[rows, None] - beside

    moved = far_or_near(apart, first.half[:, near], material.plane_strain_modulus)
    moved *= image_factor(material.poisson_ratio) ** len(of) * weight[:, None]
    moved *= weight
    if len(near) == len(whole):
        whole += moved
    else:
        whole[np.ix_(near, near)] += moved


def _edges(grid: ContactGrid, name: str) -> Iterator[_Beside]:
    """The cells of a grid beside the free edges of a member, of each edge that has images of them."""
    place, centres = grid.place[name], grid.centres
    for axis, end in grid.free_edges[name]:
        shares = np.abs(end - place[:, axis])
        if len(centres) < _FEWEST_CELLS or not shares.min() < _WITHIN:
            continue
        slope, slopes = _slopes(centres, place[:, axis], shares)
        steepness = float(np.hypot(*slope))
        if not steepness > 0.0:
            continue
        across = slope / steepness
        own = slopes / np.maximum(np.linalg.norm(slopes, axis=1), _LEVEL * steepness)[:, None]
        size = np.linalg.norm(grid.rectangle * np.einsum("nij,nj->ni", grid.ways, own), axis=1)
        away = shares / steepness
        along = centres @ np.array([-across[1], across[0]])
        yield _Beside(axis, end, away, along, _weight(shares), np.stack([size, grid.half.prod(axis=1) / size]))


def _slopes(centres: Floats, share: Floats, away: Floats) -> tuple[Floats, Floats]:
    """Change per mm of a share of the flank along the axes of the contact plane, in the middle of cells beside an edge
    (2,) and at each cell (N, 2). Along an edge that is not straight, a share of it is no linear function of places.
    """
    nearest = np.argsort(away)[: max(_FEWEST_CELLS, len(away) // _NEAREST)]
    middle = centres[nearest].mean(axis=0)
    size = float(np.abs(centres[nearest] - middle).max())
    x, y = (centres[nearest] - middle).T / size
    terms = np.column_stack([x, y, np.ones(len(x)), _BENT * x * x, _BENT * x * y, _BENT * y * y])
    first, second, _, *bent = np.linalg.lstsq(terms, share[nearest], rcond=None)[0]
    own = _BENT * np.array([[2.0 * bent[0], bent[1]], [bent[1], 2.0 * bent[2]]])
    slope = np.array([first, second])
    return slope / size, (slope + (centres - middle) / size @ own) / size


def _weight(shares: Floats) -> Floats:
    """1 at the edge, 0 from half of the flank away on, level at both."""
    left = np.clip(1.0 - shares / _WITHIN, 0.0, 1.0)
    return left**2 * (3.0 - 2.0 * left)


@lru_cache(maxsize=64)
def _known(tooth: ToothCompliance, material: Material, edges: tuple[tuple[int, float], ...]) -> Floats:
    """(P Q, P Q) mean displacements in mm of patches by the images of unit loads on others beyond an edge or a corner,
    each by its axis and end, on the flank laid flat.
    """
    ends, n = dict(edges), _PER_PATCH
    lengths = [2.0 * half for half in tooth.half]
    # Patches along both axes from the edge, where there is one, and cells in them.
    counts = [math.ceil(_WITHIN * count) if axis in ends else count for axis, count in enumerate(tooth.shape)]
    index = np.stack(np.meshgrid(*(np.arange(k) for k in counts), *(np.arange(n),) * 2, indexing="ij")).reshape(4, -1)
    steps = index[:2] + (index[2:] + 0.5) / n
    half = (0.5 * lengths[0] / n, 0.5 * lengths[1] / n)
    cells = tuple(
        _Beside(
            axis, end, lengths[axis] * steps[axis], lengths[1 - axis] * steps[1 - axis],
            _weight(steps[axis] / tooth.shape[axis]),
            np.array([[half[axis]], [half[1 - axis]]]).repeat(len(steps[axis]), axis=1),
        )
        for axis, end in ends.items()
    )  # fmt: skip
    patches = counts[0] * counts[1]
    moved = np.zeros((patches * n * n,) * 2)
    _add_images(moved, cells, material)
    moved = moved.reshape(patches, n * n, patches, n * n).sum(axis=(1, 3))
    chosen = [
        np.arange(tooth.shape[axis])[:: -1 if ends.get(axis) == 1.0 else 1][: counts[axis]] for axis in (0, 1)
    ]
    at = np.arange(tooth.shape[0] * tooth.shape[1]).reshape(tooth.shape)[np.ix_(*chosen)].ravel()
    whole = np.zeros((tooth.shape[0] * tooth.shape[1],) * 2)
    whole[np.ix_(at, at)] = moved / (n**2 * lengths[0] * lengths[1])
    return whole
