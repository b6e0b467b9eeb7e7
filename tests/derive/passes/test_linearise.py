"""The sparse tangent system eliminates to the Jacobian; an angle that several unknowns turn is a variable."""

import random

import pytest
import sympy as sp

from derive.passes.linearise import forward, jacobian, linearise
from tests.derive.small import VALUES, lowered, p, x, y

EQUATIONS = (p * sp.cos(x + y) - x, sp.sin(x + y) * x + y**2)


def values(tape, rows):
    return [tape.evaluate(row, VALUES) for row in rows]


@pytest.mark.parametrize("method", [linearise, forward])
def test_the_angles_eliminated_give_the_jacobian(method):
    tape, lower, residual = lowered(*EQUATIONS)
    found = values(tape, jacobian(tape, method(tape, residual, [lower(x), lower(y)])))
    exact = sp.Matrix(EQUATIONS).jacobian([x, y]).subs(VALUES)
    assert found == [pytest.approx([float(e) for e in exact.row(k)], rel=1e-13) for k in range(2)]


def test_the_turned_angle_is_one_variable():
    tape, lower, residual = lowered(*EQUATIONS)
    linear = linearise(tape, residual, [lower(x), lower(y)])
    assert (linear.unknowns, linear.equations, linear.variables) == (2, 2, 1)
    assert tape.const_value(linear.matrix[2][2]) == -1


def test_the_solution_of_an_equation_is_differentiated_by_its_slope():
    """With w from w² = x + y + 10: ∂w/∂x = 1/(2w), whatever w was solved with."""
    tape, lower, (w,) = lowered((x + y + 10) ** sp.Rational(1, 2))
    equation = tape.sub(tape.mul(w, w), lower(x + y + 10))
    slope = tape.mul(tape.constant(2), w)
    residual = [tape.mul(w, lower(sp.cos(x)))]
    rows = jacobian(tape, linearise(tape, residual, [lower(x), lower(y)], [(w, equation, slope)]))
    exact = [sp.diff(sp.sqrt(x + y + 10) * sp.cos(x), v).subs(VALUES) for v in (x, y)]
    assert values(tape, rows)[0] == pytest.approx([float(e) for e in exact], rel=1e-13)


def test_of_a_negative_solution_the_positive_is_held():
    """−n/d from w·d + n = 0, where all that is read is n/d."""
    n, d = sp.cos(x) * y + sp.sin(y) * x, x**2 + p * sp.sin(y) + 5
    tape, lower, (solution, slope) = lowered(-n / d, d)
    equation = tape.add(tape.mul(solution, slope), lower(n))
    residual = [tape.sub(lower(q), tape.mul(solution, tape.mul(solution, lower(sp.cos(q))))) for q in (x, y)]
    linear = linearise(tape, residual, [lower(x), lower(y)], [(solution, equation, slope)])
    exact = sp.Matrix([q - (n / d) ** 2 * sp.cos(q) for q in (x, y)]).jacobian([x, y]).subs(VALUES)
    assert tape.nodes[solution].op == "neg"
    assert linear.variables == 1
    assert values(tape, jacobian(tape, linear)) == [pytest.approx([float(e) for e in exact.row(k)]) for k in range(2)]


@pytest.mark.parametrize("seed", range(6))
def test_a_solution_whose_product_is_rearranged_gives_the_same_jacobian(seed):
    """w = −n/d from w·d + n = 0, where n and d share factors: where these cancel, the equation reads n for w."""
    rng = random.Random(seed)
    shared = rng.sample([p, x**2 + 5, sp.cos(y) + 3, p + 2], 2)
    n = rng.choice([x * y + p, sp.sin(x) + y, x - y]) * rng.choice([1, *shared])
    d = sp.Mul(*shared[: rng.randint(1, 2)])
    tape, lower, (solution, slope, over) = lowered(-n / d, d, n)
    equation = tape.add(tape.mul(slope, solution), over)
    residual = [tape.add(tape.mul(lower(q), solution), lower(sp.cos(q))) for q in (x, y)]
    linear = linearise(tape, residual, [lower(x), lower(y)], [(solution, equation, slope)])
    exact = sp.Matrix([sp.cos(q) - q * n / d for q in (x, y)]).jacobian([x, y]).subs(VALUES)
    found = values(tape, jacobian(tape, linear))
    assert found == [pytest.approx([float(e) for e in exact.row(k)], rel=1e-12, abs=1e-12) for k in range(2)]
