"""Roots by bracketing: of many functions at once, against closed forms."""

import numpy as np
import pytest

from meshwright.base.roots import bracketed, narrowed

ROOTS = np.array([0.1, 0.5, 2.0 / 3.0, 0.999, 0.25])


def _narrowed(functions, count, steps=60):
    """The last places inside of functions that are not negative at 0 and negative or not a number at 1."""
    inside, asked = np.zeros(count), []

    def values(x, rows):
        asked.append(len(rows))
        found = np.array([functions[row](at) for at, row in zip(x, rows, strict=True)])
        inside[rows[found >= 0.0]] = x[found >= 0.0]
        return found

    ends = [np.array([f(x) for f in functions]) for x in (0.0, 1.0)]
    narrowed(values, np.zeros(count), np.ones(count), ends, np.full(count, 1e-14), 0.0, steps)
    return inside, asked


@pytest.mark.parametrize("power", [1, 3, 7])
def test_many_roots_are_found_from_inside_in_few_steps(power):
    functions = [lambda x, r=r: r**power - x**power for r in ROOTS]
    inside, asked = _narrowed(functions, len(ROOTS))
    assert np.abs(inside - ROOTS).max() < 2e-14
    assert all(f(x) >= 0.0 for f, x in zip(functions, inside, strict=True))
    assert len(asked) < 20  # bisection takes 47


def test_a_function_that_ends_is_narrowed_to_its_end():
    functions = [lambda x, r=r: 1.0 if x < r else np.nan for r in ROOTS]
    inside, _ = _narrowed(functions, len(ROOTS))
    assert np.abs(inside - ROOTS).max() < 2e-14
    assert (inside < ROOTS).all()


def test_the_smaller_of_two_limits_holds_the_root():
    functions = [lambda x, r=r: min(r - x, 3.0 * (0.4 - x)) for r in ROOTS]
    inside, _ = _narrowed(functions, len(ROOTS))
    assert np.abs(inside - np.minimum(ROOTS, 0.4)).max() < 2e-14


def test_one_root_and_many_agree():
    functions = [lambda x, r=r: np.cos(x) - np.cos(r) for r in ROOTS]
    inside, _ = _narrowed(functions, len(ROOTS))
    alone = [bracketed(f, 0.0, 1.0, 1e-14) for f in functions]
    assert np.abs(inside - alone).max() < 1e-13
