"""Normal displacement of an elastic half-space under pressed rectangles.

Source: A. E. H. Love, The stress produced in a semi-infinite solid by pressure on part of the boundary (1929);
K. L. Johnson, Contact Mechanics, (3.25).
"""

import numpy as np

from meshwright.fe.hexahedra import Floats

# A force spread over a rectangle acts as one at its centre beyond so many of its longer half sides.
_FAR = 8.0


def rectangle_displacement(x: Floats, y: Floats, half_x: float, half_y: float, modulus: float) -> Floats:
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


def far_or_near(x: Floats, y: Floats, half_x: float, half_y: float, modulus: float) -> Floats:
    """As :func:`rectangle_displacement`, far away that of the same force at a point, there within 0.5 % of it."""
    distance = np.hypot(x, y)
    near = distance < _FAR * max(half_x, half_y)
    found = 4.0 * half_x * half_y / (np.pi * modulus * np.where(near, 1.0, distance))
    found[near] = rectangle_displacement(x[near], y[near], half_x, half_y, modulus)
    return found


def equal_cells(count: int, half_x: float, half_y: float, modulus: float) -> Floats:
    """(count, count) displacement at the centre of a rectangular cell so many cells away along x and along y, by a unit
    pressure on an equal one.
    """
    x, y = np.meshgrid(2.0 * half_x * np.arange(count), 2.0 * half_y * np.arange(count), indexing="ij")
    return rectangle_displacement(x, y, half_x, half_y, modulus)


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
