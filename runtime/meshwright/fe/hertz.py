"""Hertz contact in closed form, for any elliptic contact and for the line contact.

The two bodies touch with the gap ``(kappa_min x^2 + kappa_max y^2) / 2``.  Elliptic integrals come
from SciPy in Carlson's symmetric form, in which nothing cancels between the circle and the line.
Source of the formulae: K. L. Johnson, Contact Mechanics, sections 4.2 and 4.2(c).
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import pi, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, minimize_scalar
from scipy.special import elliprd, elliprf

from meshwright.fe.material import von_mises

_THINNEST_AXIS_RATIO = 1e-9


@dataclass(frozen=True)
class HertzContact:
    """The solved contact: lengths in mm, stresses in MPa.

    semi_major lies along the direction of the least relative curvature; it is infinite for a line contact.
    approach is the approach of distant points, infinite for a line contact (it has no half-space value).
    subsurface_von_mises is the largest von Mises stress on the axis through the centre, at ``depth``.
    """

    semi_major: float
    semi_minor: float
    peak_pressure: float
    approach: float
    subsurface_von_mises: float
    depth: float


def axis_ratio(curvature_min: float, curvature_max: float) -> float:
    """b/a of the contact ellipse for relative curvatures 0 < curvature_min <= curvature_max."""
    wanted = np.log(curvature_max / curvature_min)

    def mismatch(log_ratio: float) -> float:
        square = np.exp(2.0 * log_ratio)
        return float(np.log(elliprd(0.0, 1.0, square) / elliprd(0.0, square, 1.0)) - wanted)

    if wanted <= 0.0:
        return 1.0
    return float(np.exp(brentq(mismatch, np.log(_THINNEST_AXIS_RATIO), 0.0, xtol=1e-15)))


def elliptic_contact(
    force: float, curvature_min: float, curvature_max: float, modulus: float, poisson_ratio: float
) -> HertzContact:
    """Contact under a normal force.

    force in N; curvatures of the gap in 1/mm, 0 < curvature_min <= curvature_max; modulus is the contact
    modulus E* in MPa; poisson_ratio is that of the body whose subsurface stress is wanted.
    Raises ValueError if the bodies interfere or touch along a line.
    """
    if not 0.0 < curvature_min <= curvature_max:
        raise ValueError(
            f"relative curvatures {curvature_min:g} and {curvature_max:g} 1/mm: an elliptic contact needs "
            "0 < least <= largest; a line contact (least = 0) has its own formula"
        )
    ratio = axis_ratio(curvature_min, curvature_max)
    semi_major = (force * elliprd(0.0, ratio**2, 1.0) / (pi * modulus * curvature_min)) ** (1.0 / 3.0)
    semi_minor = ratio * semi_major
    peak = 1.5 * force / (pi * semi_major * semi_minor)
    approach = peak * semi_minor / modulus * elliprf(0.0, ratio**2, 1.0)

    def stress(depth: float) -> NDArray[np.floating[Any]]:
        return peak * _axis_stress(depth / semi_major, ratio, poisson_ratio)

    subsurface, depth = _largest_von_mises(stress, semi_minor)
    return HertzContact(float(semi_major), float(semi_minor), peak, float(approach), subsurface, depth)


def line_contact(force_per_length: float, curvature: float, modulus: float, poisson_ratio: float) -> HertzContact:
    """Contact of two cylinders with parallel axes, plane strain; force_per_length in N/mm."""
    semi_minor = sqrt(4.0 * force_per_length / (pi * modulus * curvature))
    peak = 2.0 * force_per_length / (pi * semi_minor)

    def stress(depth: float) -> NDArray[np.floating[Any]]:
        root = np.hypot(semi_minor, depth)
        across = -((semi_minor**2 + 2.0 * depth**2) / root - 2.0 * depth) / semi_minor
        normal = -semi_minor / root
        along = poisson_ratio * (across + normal)
        return peak * np.array([along, across, normal, 0.0, 0.0, 0.0])

    subsurface, depth = _largest_von_mises(stress, semi_minor)
    return HertzContact(float("inf"), semi_minor, peak, float("inf"), subsurface, depth)


def _largest_von_mises(stress: Callable[[float], NDArray[np.floating[Any]]], scale: float) -> tuple[float, float]:
    found = minimize_scalar(
        lambda depth: -float(von_mises(stress(depth))),
        bounds=(1e-6 * scale, 2.0 * scale),
        method="bounded",
        options={"xatol": 1e-10 * scale},
    )
    return -float(found.fun), float(found.x)


def _axis_stress(zeta: float, k: float, nu: float) -> NDArray[np.floating[Any]]:
    """Stress over peak pressure at depth zeta = z/a below the centre of an ellipse with b/a = k.

    Johnson (4.28) with every difference that vanishes with the eccentricity written out.
    """
    slope = 1.0 / (1.0 + zeta**2)
    sine, cosine = sqrt(slope), zeta * sqrt(slope)
    t = sqrt((k**2 + zeta**2) * slope)
    one_minus_t = slope / (1.0 + t)
    major_integral = zeta * sine**3 * elliprd(cosine**2, t**2, 1.0) / 3.0
    minor_integral = zeta * (sine**3 * elliprd(cosine**2, 1.0, t**2) / 3.0 + sine * cosine / (k**2 * t))
    omega_x = -0.5 * one_minus_t + major_integral
    omega_x_poisson = (one_minus_t - 1.0) / k**2 + minor_integral
    omega_y = 0.5 * one_minus_t / t + omega_x_poisson
    omega_y_poisson = -one_minus_t + major_integral
    along = 2.0 * k * (omega_x + nu * omega_x_poisson)
    across = 2.0 * k * (omega_y + nu * omega_y_poisson)
    return np.array([along, across, -k * slope / t, 0.0, 0.0, 0.0])
