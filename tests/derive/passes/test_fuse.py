"""A product goes into the one sum that takes it; a product that is read elsewhere too stays a product."""

from derive.passes.fuse import fuse
from tests.derive.small import program, x, y, z


def operations(routine):
    return sorted(step.op for _, step in routine.steps)


def test_a_product_and_its_sum_become_one_operation():
    assert operations(fuse(program(x * y + z))) == ["fma"]
    assert operations(fuse(program(x * y - z))) == ["fms"]
    assert operations(fuse(program(z - x * y))) == ["fnma"]


def test_a_product_that_is_a_result_as_well_stays():
    assert operations(fuse(program(x * y + z, x * y))) == ["add", "mul"]
