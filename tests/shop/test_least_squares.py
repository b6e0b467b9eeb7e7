"""Least squares with tolerances: recovered errors, honest covariance, combinations that cannot be told apart."""

import numpy as np
import pytest

from meshwright.shop.least_squares import estimate

TOLERANCES = np.array([0.05, 0.05, 0.1, 2.0])


def _columns(n=60):
    x = np.linspace(-1.0, 1.0, n)
    return np.stack([np.ones(n), x, x**2, 0.1 * np.sin(5 * x)], axis=1)


def test_without_noise_the_parameters_come_back():
    truth = np.array([0.01, -0.02, 0.03, 0.4])
    found = estimate(_columns(), _columns() @ truth, TOLERANCES, sigma=1e-3)
    assert np.abs(found.values - truth).max() < 1e-12
    assert found.undetermined == ()


def test_the_covariance_is_that_of_many_repetitions():
    """Squared, normalised errors of 4 parameters follow χ² with 4 degrees: mean 4, variance 8."""
    truth, sigma, squares = np.array([0.01, -0.02, 0.03, 0.4]), 1e-3, []
    clean = _columns() @ truth
    for seed in range(200):
        noise = np.random.default_rng(seed).normal(0.0, sigma, len(clean))
        found = estimate(_columns(), clean + noise, TOLERANCES, sigma)
        off = found.values - truth
        squares.append(off @ np.linalg.solve(found.covariance, off))
    # Huber weights give up five per cent of efficiency
    assert 4.0 - 3 * np.sqrt(8 / 200) < np.mean(squares) < 4.0 / 0.93 + 3 * np.sqrt(8 / 200)


def test_equal_columns_are_named_and_not_estimated():
    columns = _columns()
    columns[:, 1] = 2.0 * columns[:, 0]
    found = estimate(columns, columns @ [0.01, 0.02, 0.03, 0.4], TOLERANCES, sigma=1e-3)
    (lost,) = found.undetermined
    assert sorted(lost.members()) == [0, 1]
    assert np.isnan(found.values[:2]).all()
    assert found.values[2:] == pytest.approx([0.03, 0.4], abs=1e-12)


def test_a_combination_less_certain_than_its_tolerance_is_not_estimated():
    columns = _columns()
    columns[:, 1] = columns[:, 0] + 1e-3 * columns[:, 1]
    assert estimate(columns, columns[:, 0], TOLERANCES, sigma=1e-7).undetermined == ()
    assert len(estimate(columns, columns[:, 0], TOLERANCES, sigma=1e-3).undetermined) == 1


def test_dirt_on_the_part_is_distrusted_and_does_no_harm():
    truth, sigma = np.array([0.01, -0.02, 0.03, 0.4]), 1e-3
    measured = _columns() @ truth + np.random.default_rng(3).normal(0.0, sigma, 60)
    measured[[7, 40]] += 0.05
    found = estimate(_columns(), measured, TOLERANCES, sigma)
    assert set(found.distrusted()) >= {7, 40} and len(found.distrusted()) < 6
    assert (np.abs(found.values - truth) < 4 * found.deviations).all()


def test_a_scatter_that_is_not_given_is_estimated():
    truth, sigma = np.array([0.01, -0.02, 0.03, 0.4]), 2e-3
    measured = _columns(400) @ truth + np.random.default_rng(5).normal(0.0, sigma, 400)
    found = estimate(_columns(400), measured, TOLERANCES)
    assert found.sigma == pytest.approx(sigma, rel=0.15)
    assert np.isnan(found.chi_square_per_degree)


def test_too_few_measurements_are_refused():
    with pytest.raises(ValueError, match="4 measurements cannot determine 4"):
        estimate(_columns()[:4], np.ones(4), TOLERANCES)
