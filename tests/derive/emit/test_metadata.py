"""A description names what the header computes: sizes, offsets and a hash of the arithmetic."""

from dataclasses import replace

from derive.emit import metadata
from tests.derive.small import plan


def test_the_hash_is_that_of_the_arithmetic():
    made = plan()
    assert metadata.specification_hash(made) == metadata.specification_hash(made)
    turned = replace(made, residual=made.residual[::-1])
    assert metadata.specification_hash(turned) != metadata.specification_hash(made)


def test_parameters_keep_the_order_of_the_parameter_vector():
    drive = plan().drive
    described = metadata.parameters(drive)
    assert [p["key"] for p in described] == [p.key for p in drive.parameters]
    angle = next(p for p in described if p["key_unit"] == "deg")
    assert abs(angle["factor"] - 0.017453292519943295) < 1e-18


def test_the_self_test_starts_beside_the_contact_that_it_expects():
    test = metadata.self_test(plan())
    assert test and all(isinstance(part, dict | list | float | int | str) for part in test.values())
