"""Where a region joins a flank: the place is found that both come nearest at, and the ways there are compared."""

import math

import pytest

from derive.passes.joints import _least, _Place, joints
from tests.derive.small import plan


def place(tangents, slopes):
    return _Place([0.0] * 3, [0.0, 0.0, 1.0], tangents, 1.0, [0.0] * len(slopes), slopes)


def test_every_fillet_of_the_smallest_drive_goes_on_from_either_flank():
    made = plan()
    found = joints(made)
    assert {(j.member, j.region, j.flank) for j in found} == {
        (region.member, region.name, word) for region in made.drive.regions for word in ("left", "right")
    }
    assert all(j.normals > 0.99 and j.ways > 0.99 and min(j.regular) > 0.0 for j in found)


def test_the_way_across_a_joint_is_where_the_margin_grows():
    way = place([[2.0, 0.0, 0.0], [0.0, 3.0, 0.0]], [[0.0, 5.0]]).way()
    assert way == pytest.approx([0.0, 1.0, 0.0])
    oblique = place([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[1.0, 1.0]]).way()
    assert oblique == pytest.approx([math.sqrt(0.5), math.sqrt(0.5), 0.0])


def test_a_condition_keeps_the_way_on_the_surface():
    tangents = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    way = place(tangents, [[1.0, 0.0, 0.0], [1.0, -1.0, 0.0]]).way()  # the first two parameters change alike
    assert way == pytest.approx([math.sqrt(0.5), math.sqrt(0.5), 0.0])


def test_the_least_of_squares_is_found_where_equations_hold_and_where_they_cannot():
    def circle_and(line):
        return lambda q: ([q[0] ** 2 + q[1] ** 2 - 1.0, q[0] - line], [[2.0 * q[0], 2.0 * q[1]], [1.0, 0.0]])

    assert _least(circle_and(0.6), [1.0, 1.0]) == pytest.approx([0.6, 0.8], abs=1e-8)
    x, y = _least(circle_and(2.0), [1.0, 0.5])  # least of (x² − 1)² + (x − 2)² on y = 0: 2x³ − x = 2
    assert abs(y) < 0.1 and 2.0 * x**3 - x == pytest.approx(2.0, abs=0.1)


def test_an_open_size_is_no_place_to_start_from():
    with pytest.raises(ArithmeticError, match="a size of the sample is missing"):
        _least(lambda q: ([math.nan], [[1.0]]), [0.0])
