"""Hertz contact against published values, limits and direct integration of Boussinesq's solution."""

import numpy as np
import pytest
from scipy.integrate import dblquad

from meshwright.fe.hertz import axis_ratio, elliptic_contact, line_contact
from meshwright.fe.material import Material, contact_modulus, max_principal, von_mises
from tests.quick import quick

STEEL = Material(205000.0, 0.29)
MODULUS = contact_modulus(STEEL, STEEL)
ALPHA = np.radians(20.0)
PROFILE = (1 / 66 + 1 / 94) / np.sin(ALPHA)
FORCE = 100e3 / (66 * np.cos(ALPHA))


@pytest.mark.parametrize(
    ("sigma", "pressure", "stress"),
    [(-1, 1054, 604), (0, 1364, 801), (1, 1542, 918)],
    ids=["concave", "spur", "convex"],
)
def test_pitch_point_of_spherical_pairs(sigma, pressure, stress):
    """Convex pinion, 33/47 teeth, 100 N m: peak pressure and subsurface von Mises stress to the printed digits."""
    along = np.sin(ALPHA) * (1 / 66 + sigma / 94)
    contact = elliptic_contact(FORCE, along, PROFILE, MODULUS, 0.29)
    assert contact.peak_pressure == pytest.approx(pressure, abs=0.5)
    assert contact.subsurface_von_mises == pytest.approx(stress, abs=0.5)
    assert contact.depth == pytest.approx(0.71 * contact.semi_minor, rel=0.03)


def test_line_contact_of_spur_gears():
    assert line_contact(FORCE / 30, PROFILE, MODULUS, 0.29).peak_pressure == pytest.approx(380, abs=0.5)


def test_sphere():
    """Equal curvatures: a^3 = 3 F R / 4 E*, approach a^2/R, no difference between the axes."""
    radius = 20.0
    contact = elliptic_contact(1000.0, 1 / radius, 1 / radius, MODULUS, 0.29)
    expected = (3 * 1000.0 * radius / (4 * MODULUS)) ** (1 / 3)
    assert contact.semi_major == pytest.approx(expected, rel=1e-12)
    assert contact.semi_minor == pytest.approx(expected, rel=1e-12)
    assert contact.approach == pytest.approx(expected**2 / radius, rel=1e-12)


def test_sphere_is_approached_continuously():
    nearly = elliptic_contact(1000.0, 0.05, 0.05 * (1 + 1e-9), MODULUS, 0.29)
    exactly = elliptic_contact(1000.0, 0.05, 0.05, MODULUS, 0.29)
    assert nearly.subsurface_von_mises == pytest.approx(exactly.subsurface_von_mises, rel=1e-8)


def test_a_long_ellipse_is_locally_a_line():
    """A very long ellipse is at its centre the line contact with the same load per length."""
    contact = elliptic_contact(1000.0, 1e-9, 0.1, MODULUS, 0.29)
    per_length = 0.5 * np.pi * contact.peak_pressure * contact.semi_minor
    line = line_contact(per_length, 0.1, MODULUS, 0.29)
    assert contact.peak_pressure == pytest.approx(line.peak_pressure, rel=1e-3)
    assert contact.subsurface_von_mises == pytest.approx(line.subsurface_von_mises, rel=1e-3)


@pytest.mark.parametrize("ratio", quick([0.9, 0.5, 0.1], 0.5))
def test_subsurface_stress_against_boussinesq(ratio):
    """The largest von Mises stress on the axis from the point-load solution, integrated numerically."""
    wanted = np.linspace(1e-4, 1.0, 20001)
    curvatures = next(k for k in wanted if axis_ratio(k, 1.0) > ratio)
    contact = elliptic_contact(100.0, curvatures, 1.0, MODULUS, 0.29)
    a, b, p0, z, nu = contact.semi_major, contact.semi_minor, contact.peak_pressure, contact.depth, 0.29

    def integral(kernel):
        def integrand(angle, radius):
            x, y = a * radius * np.cos(angle), b * radius * np.sin(angle)
            return a * b * radius * p0 * np.sqrt(1 - radius**2) * kernel(x, y)

        return dblquad(integrand, 1e-9, 1, 0, 2 * np.pi, epsabs=1e-6, epsrel=1e-8)[0] / (2 * np.pi)

    def lateral(x, y):
        big, flat = np.sqrt(x * x + y * y + z * z), x * x + y * y
        return (1 - 2 * nu) / flat * (
            (1 - z / big) * (x * x - y * y) / flat + z * y * y / big**3
        ) - 3 * z * x * x / big**5

    stress = [
        integral(lateral),
        integral(lambda x, y: lateral(y, x)),
        integral(lambda x, y: -3 * z**3 / np.sqrt(x * x + y * y + z * z) ** 5),
        0,
        0,
        0,
    ]
    assert contact.subsurface_von_mises == pytest.approx(von_mises(np.array(stress)), rel=1e-5)


def test_interference_is_refused():
    with pytest.raises(ValueError, match="elliptic contact needs"):
        elliptic_contact(100.0, -1e-3, 0.1, MODULUS, 0.29)


def test_stress_invariants():
    """Uniaxial tension and pure shear."""
    tension, shear = np.array([250.0, 0, 0, 0, 0, 0]), np.array([0, 0, 0, 0, 0, 100.0])
    assert von_mises(tension) == pytest.approx(250.0)
    assert von_mises(shear) == pytest.approx(100.0 * np.sqrt(3))
    assert max_principal(shear) == pytest.approx(100.0)
