"""Normal displacement of an elastic half-space under pressed rectangles.

Source: A. E. H. Love, The stress produced in a semi-infinite solid by pressure on part of the boundary (1929);
K. L. Johnson, Contact Mechanics, (3.25).
"""

from collections.abc import Callable

import numpy as np

from meshwright.fe.gap import ContactGrid
from meshwright.fe.hexahedra import Floats

# A force spread over a rectangle acts as one at its centre beyond so many of its longer half sides.
_FAR = 6.0
# Places at which displacements are found at once.
_AT_ONCE = 32
# Less than any sum of lengths in mm.
_LEAST = 1e-300


def rectangle_displacement(
    x: Floats, y: Floats, half_x: Floats | float, half_y: Floats | float, modulus: float
) -> Floats:
    """Displacement in mm at (x, y) mm from the centre of a rectangle under a pressure of 1 MPa.

    half_x, half_y: half lengths of its sides; modulus: plane-strain modulus E/(1 - nu^2), or the contact modulus
    for the sum over two bodies.
    """
    x, y = np.abs(x), np.abs(y)
    near_x, far_x, near_y, far_y = x - half_x, x + half_x, y - half_y, y + half_y
    corner, beside, above, away = (np.sqrt(u**2 + v**2) for v in (near_y, far_y) for u in (near_x, far_x))
    found = far_x * np.log((far_y + away) / (near_y + beside)) + far_y * np.log((far_x + away) / (near_x + above))
    found += near_x * np.log(_sum(near_y, corner, near_x) / (far_y + above))
    found += near_y * np.log(_sum(near_x, corner, near_y) / (far_x + beside))
    return found / (np.pi * modulus)


def _sum(leg: Floats, hypotenuse: Floats, other_leg: Floats) -> Floats:
    """leg + hypotenuse of right triangles to all digits where the leg is negative; never 0, since it multiplies one."""
    stable = np.where(leg < 0.0, other_leg**2 / np.maximum(hypotenuse + np.abs(leg), _LEAST), leg + hypotenuse)
    return np.maximum(stable, _LEAST)


def image_factor(poisson_ratio: float) -> float:
    """How many times the image of a load beyond a free edge acts, so that the half-space becomes a quarter-space.

    The image frees the side of the quarter-space of shear, the factor makes up for the normal stress left there.
    Source: R. Guilbault, A fast correction for elastic quarter-space applied to 3D modeling of edge contact problems,
    ASME Journal of Tribology 133 (2011) 031402.
    """
    return 1.29 - (0.08 - 0.5 * poisson_ratio) / (1.0 - poisson_ratio)


def far_or_near(apart: Callable[[slice], tuple[Floats, Floats]], half: Floats, modulus: float) -> Floats:
    """(N, N) as :func:`rectangle_displacement` at N places by rectangles of half sides ``half`` (2, N).

    apart: of some of the places, x and y (…, N) from the centres of all rectangles; a few places at a time, that the
    processor has at hand what it works on.  Far away the rectangle's force and its second moments act at its centre,
    there within 2e-4 of it.
    """
    count = half.shape[1]
    found = np.empty((count, count))
    force = 4.0 * half.prod(axis=0) / (np.pi * modulus)
    squares, reach = half**2 / 6.0, (_FAR * half.max(axis=0)) ** 2
    for begin in range(0, count, _AT_ONCE):
        rows = slice(begin, begin + _AT_ONCE)
        x, y = apart(rows)
        x2, y2 = x**2, y**2
        square = x2 + y2
        near = np.nonzero(square < reach)
        square[near] = 1.0
        moments = 3.0 * (squares[0] * x2 + squares[1] * y2) / square - squares.sum(axis=0)
        found[rows] = force * (1.0 + moments / square) / np.sqrt(square)
        across, along = (of[near[1]] for of in half)
        found[rows][near] = rectangle_displacement(x[near], y[near], across, along, modulus)
    return found


def between_cells(grid: ContactGrid, modulus: float) -> Floats:
    """Displacements (N, N) in mm at the centres of cells by a unit pressure on each, laid flat where that is pressed.

    Cells of a bent strip are in planes of their own; where these are far apart it is their distance that counts.
    """
    points = grid.points - grid.points.mean(axis=0)
    ways = [np.ascontiguousarray(grid.frame[:, axis].T) for axis in range(3)]
    own = [np.einsum("ni,in->n", points, way) for way in ways]

    def apart(rows: slice) -> tuple[Floats, Floats]:
        x, y, z = (points[rows] @ way - at for way, at in zip(ways, own, strict=True))
        flat = x**2 + y**2
        stretch = np.sqrt(1.0 + z**2 / np.where(flat > 0.0, flat, 1.0))
        return x * stretch, y * stretch

    return far_or_near(apart, grid.rectangle.T, modulus)


def symmetric(displacements: Floats, areas: Floats) -> Floats:
    """Work (N, N) of unit pressures on the displacements (N, N) of cells with areas (N,) by unit pressures on others.

    Of two loads each does the same work on the other's displacement (E. Betti, 1872), up to what the centres of cells
    of unequal size miss of their means.
    """
    work = areas[:, None] * displacements
    return 0.5 * (work + work.T)


def mean_displacement(offset_x: Floats, offset_y: Floats, half_x: float, half_y: float, modulus: float) -> Floats:
    """Mean displacement of a rectangle by a unit pressure on an equal one at given centre offsets.

    Gauss quadrature over the observed rectangle, its four quarters apart, since the kernel has kinks on the axes.
    """
    points, weights = np.polynomial.legendre.leggauss(6)
    points, weights = 0.5 * (points + 1.0), 0.5 * weights
    signed = np.concatenate([-points, points])
    both = 0.5 * np.concatenate([weights, weights])
    total = np.zeros_like(offset_x)
    for px, wx in zip(signed * half_x, both, strict=True):
        for py, wy in zip(signed * half_y, both, strict=True):
            total += wx * wy * rectangle_displacement(offset_x + px, offset_y + py, half_x, half_y, modulus)
    return total
