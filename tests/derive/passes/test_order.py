"""The printed order respects the arguments; sine and cosine of one angle stand side by side."""

import sympy as sp

from derive.passes.order import interleaved, order
from tests.derive.small import p, program, x, y, z

LONG = sp.sqrt(x**2 + p) / (y - p) + sp.cos(x + y) * z + sp.sin(x + y) * p


def in_order(routine, nodes):
    computed, seen = {i for i, _ in routine.steps}, set()
    program = dict(routine.steps)
    for i in nodes:
        assert {a for a in program[i].args if a in computed} <= seen
        seen.add(i)
        yield i


def test_an_operation_comes_after_its_arguments():
    done = order(program(LONG))
    assert len(list(in_order(done, [i for i, _ in done.steps]))) == len(done.steps)


def test_sine_and_cosine_of_one_angle_are_neighbours():
    ops = [step.op for _, step in order(program(LONG)).steps]
    assert abs(ops.index("sin") - ops.index("cos")) == 1


def test_what_takes_longest_is_begun_first():
    """The root and the quotient behind it are the longest chain: what leads there comes before the short sums."""
    ops = [step.op for _, step in order(program(sp.sqrt(x * p) / y + (z + p))).steps]
    assert ops.index("sqrt") < ops.index("add")


def test_two_copies_side_by_side_compute_the_same():
    pairs = interleaved(program(LONG), (0, 20))
    both = [[i for k, i in pairs if k == copy] for copy in (0, 1)]
    assert sorted(both[0]) == sorted(both[1])
