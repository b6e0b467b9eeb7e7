"""Normal displacement of an elastic half-space under pressed rectangles.

Source: A. E. H. Love, The stress produced in a semi-infinite solid by pressure on part of the boundary (1929);
K. L. Johnson, Contact Mechanics, (3.25).
"""

from __future__ import annotations

import numpy as np

from meshwright.fe.gap import ContactGrid
from meshwright.fe.hexahedra import Floats

# A force spread over a rectangle acts as one at its centre beyond so many of its longer half sides.
_FAR = 6.0


def rectangle_displacement(
    x: Floats, y: Floats, half_x: Floats | float, half_y: Floats | float, modulus: float
) -> Floats:
    """Displacement in mm at (x, y) mm from the centre of a rectangle under a pressure of 1 MPa.

    half_x, half_y: half lengths of its sides; modulus: plane-strain modulus E/(1 - nu^2), or the contact modulus
    for the sum over two bodies.
    """
    corners = (
        (_corner(x + half_x, y + half_y), 1.0),
        (_corner(x - half_x, y + half_y), -1.0),
        (_corner(x + half_x, y - half_y), -1.0),
        (_corner(x - half_x, y - half_y), 1.0),
    )
    return np.sum([sign * value for value, sign in corners], axis=0) / (np.pi * modulus)


def _corner(x: Floats, y: Floats) -> Floats:
    return x * _inverse_sinh_ratio(y, x) + y * _inverse_sinh_ratio(x, y)


def _inverse_sinh_ratio(numerator: Floats, denominator: Floats) -> Floats:
    """asinh(numerator / |denominator|); zero where the denominator is, since the product with it vanishes."""
    size = np.abs(denominator)
    return np.arcsinh(np.divide(numerator, size, out=np.zeros_like(numerator), where=size > 0.0))


def image_factor(poisson_ratio: float) -> float:
    """How many times the image of a load beyond a free edge acts, so that the half-space becomes a quarter-space.

    The image frees the side of the quarter-space of shear, the factor makes up for the normal stress left there.
    Source: R. Guilbault, A fast correction for elastic quarter-space applied to 3D modeling of edge contact problems,
    ASME Journal of Tribology 133 (2011) 031402.
    """
    return 1.29 - (0.08 - 0.5 * poisson_ratio) / (1.0 - poisson_ratio)


def far_or_near(x: Floats, y: Floats, half_x: Floats, half_y: Floats, modulus: float) -> Floats:
    """As :func:`rectangle_displacement`, of rectangles of half sides that broadcast with x and y.

    Far away the rectangle's force and its second moments act at its centre, there within 2e-4 of it.
    """
    x, y, half_x, half_y = np.broadcast_arrays(x, y, half_x, half_y)
    square = x**2 + y**2
    near = square < (_FAR * np.maximum(half_x, half_y)) ** 2
    square = np.where(near, 1.0, square)
    moments = (half_x**2 * (2.0 * x**2 - y**2) + half_y**2 * (2.0 * y**2 - x**2)) / (6.0 * square**2)
    found = 4.0 * half_x * half_y * (1.0 + moments) / (np.pi * modulus * np.sqrt(square))
    found[near] = rectangle_displacement(x[near], y[near], half_x[near], half_y[near], modulus)
    return found


def between_cells(grid: ContactGrid, modulus: float) -> Floats:
    """Displacements (N, N) in mm at the centres of cells by a unit pressure on each, laid flat where that is pressed.

    Cells of a bent strip are in planes of their own; where these are far apart it is their distance that counts.
    """
    apart = grid.points[:, None] - grid.points[None]
    x, y = (np.einsum("abi,bi->ab", apart, grid.frame[:, axis]) for axis in (0, 1))
    flat, distance = np.hypot(x, y), np.linalg.norm(apart, axis=2)
    stretch = np.divide(distance, flat, out=np.ones_like(flat), where=flat > 0.0)
    return far_or_near(x * stretch, y * stretch, grid.half[:, 0], grid.half[:, 1], modulus)


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
