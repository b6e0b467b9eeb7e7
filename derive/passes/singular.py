"""Where a surface is singular by itself: an edge of regression, the edge of an undercut."""

from collections.abc import Sequence
from itertools import combinations

from derive.language.surface import Surface
from derive.program.lowering import Lowering
from derive.program.tape import Tape


def singular_function(lower: Lowering, surface: Surface) -> int:
    """Node of the function that vanishes where a surface is singular, body frame.

    A surface r(q) of k + 2 parameters under k conditions is singular where its two directions of motion, those that
    keep the conditions, fall together. They span the plane that the conditions' slopes leave, so that the function is
    the sum over pairs of parameters (a, b) of ± n·(∂r/∂a × ∂r/∂b) times the minor of the slopes by all other
    parameters, with the sign of the permutation (others…, a, b). Without a condition it is (∂r/∂a × ∂r/∂b)·n, with one,
    f(a, b, c) = 0, the sum over cyclic (a, b, c) of f_a n·(∂r/∂b × ∂r/∂c).
    """
    tape = lower.tape
    parameters = [lower(p) for p in surface.parameters]
    point = [lower(c) for c in surface.body_point]
    normal = [lower(c) for c in surface.body_normal]
    tangents = [[tape.derivative(i, p) for i in point] for p in parameters]
    slopes = [[tape.derivative(lower(condition), p) for p in parameters] for condition in surface.conditions]
    if not slopes:
        return tape.triple(normal, *tangents)
    total = tape.constant(0)
    for others in combinations(range(len(parameters)), len(slopes)):
        minor = determinant(tape, [[row[k] for k in others] for row in slopes])
        a, b = (k for k in range(len(parameters)) if k not in others)
        pair = (a, b) if _is_even((*others, a, b)) else (b, a)
        total = tape.add(total, tape.mul(minor, tape.triple(normal, *(tangents[k] for k in pair))))
    return total


def determinant(tape: Tape, rows: Sequence[list[int]]) -> int:
    """Node of a determinant, by the minors of its first row."""
    if len(rows) == 1:
        return rows[0][0]
    total = tape.constant(0)
    for k, entry in enumerate(rows[0]):
        term = tape.mul(entry, determinant(tape, [row[:k] + row[k + 1 :] for row in rows[1:]]))
        total = tape.sub(total, term) if k % 2 else tape.add(total, term)
    return total


def _is_even(order: Sequence[int]) -> bool:
    """Whether a permutation of 0, 1, … is even."""
    return sum(order[i] > order[j] for i, j in combinations(range(len(order)), 2)) % 2 == 0
