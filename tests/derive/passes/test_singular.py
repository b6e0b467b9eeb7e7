"""The singular function vanishes where a surface's two directions of motion fall together, conditions or none."""

import pytest
import sympy as sp

from derive.language.definitions import Definitions
from derive.language.surface import Surface
from derive.passes.singular import determinant, singular_function
from tests.derive.small import VALUES, lowered, p, x, y, z


def cone(height, parameters, conditions=()):
    """A cone: x along its generators, y about its axis."""
    point = (x * sp.cos(y), x * sp.sin(y), height)
    normal = (-sp.cos(y), -sp.sin(y), sp.Integer(1))
    return Surface(Definitions(), parameters, point, (point, point), normal, conditions=conditions)


def value(surface, **at):
    tape, lower, _ = lowered(x)
    inputs = {s: at.get(s.name, number) for s, number in VALUES.items()}
    return tape.evaluate([singular_function(lower, surface)], inputs)[0]


def test_a_cone_is_singular_at_its_apex_alone():
    plain = cone(x, (x, y))
    assert value(plain, x=0.0) == 0.0
    assert value(plain, x=0.7) == pytest.approx(2.0 * 0.7)  # n · (r_x × r_y), of length √2 each, times x
    assert value(plain, x=-0.7) == pytest.approx(-2.0 * 0.7)


def test_a_parameter_more_and_a_condition_leave_the_function_as_it_is():
    implicit = cone(z, (x, y, z), (z - x,))
    assert value(implicit, x=0.7, z=0.7) == pytest.approx(value(cone(x, (x, y)), x=0.7))
    twice = cone(z, (x, y, z, p), (z - p, p - x))
    assert value(twice, x=0.7, z=0.7, p=0.7) == pytest.approx(value(cone(x, (x, y)), x=0.7))


@pytest.mark.parametrize("n", [1, 2, 3, 4])
def test_a_determinant_is_that_of_its_numbers(n):
    matrix = sp.Matrix(n, n, lambda i, j: (x, y, p, z)[(i + 2 * j) % 4] ** (i + 1) + j * i)
    tape, _, nodes = lowered(*matrix)
    rows = [nodes[k * n : k * n + n] for k in range(n)]
    found = tape.evaluate([determinant(tape, rows)], VALUES)[0]
    assert found == pytest.approx(float(matrix.det().subs(VALUES)), rel=1e-12)
