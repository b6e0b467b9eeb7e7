"""Polynomials of the generated functions, against 50 digits: within an ulp of what they stand for."""

import mpmath
import pytest

from derive.emit import approximation


def polynomial(coefficients, z):
    return sum(mpmath.mpf(c) * z**k for k, c in enumerate(coefficients))


@pytest.mark.parametrize(
    ("coefficients", "assembled", "exact", "end"),
    [
        (approximation.sine, lambda r, q: r + r**3 * q, mpmath.sin, mpmath.pi / 4),
        (approximation.cosine, lambda r, q: 1 - r**2 / 2 + r**4 * q, mpmath.cos, mpmath.pi / 4),
        (approximation.arctangent, lambda r, q: r + r**3 * q, mpmath.atan, mpmath.tan(mpmath.pi / 8)),
    ],
)
def test_a_polynomial_is_as_good_as_a_double(coefficients, assembled, exact, end):
    with mpmath.workdps(50):
        for k in range(1, 41):
            r = mpmath.mpf(k) / 40 * end
            found = assembled(r, polynomial(coefficients(), r**2))
            assert abs(found / exact(r) - 1) < mpmath.mpf(2) ** -55


def test_the_parts_of_a_right_angle_add_up_and_multiply_without_rounding():
    with mpmath.workdps(60):
        high, middle, low = approximation.half_pi_parts()
        assert abs(mpmath.mpf(high) + middle + low - mpmath.pi / 2) < mpmath.mpf(2) ** -110
        assert sum(map(mpmath.mpf, approximation.half_pi_halves())) == pytest.approx(mpmath.pi / 2, abs=1e-30)
    for part in (high, middle):
        assert float(part * (2**20 - 1)) == mpmath.mpf(part) * (2**20 - 1)
