"""A quotient by what has its reciprocal computed anyway becomes a product."""

from derive.passes.quotients import reciprocals
from tests.derive.small import program, x, y, z


def operations(routine):
    return sorted(step.op for _, step in routine.steps)


def test_one_division_is_left():
    assert operations(reciprocals(program(x / y, 1 / y))) == ["div", "mul"]


def test_without_the_reciprocal_it_stays_a_division():
    assert operations(reciprocals(program(x / y, z / x))) == ["div", "div"]
