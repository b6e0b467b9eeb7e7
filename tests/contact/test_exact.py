"""Numbers that enclose exact ones."""

from fractions import Fraction
from random import Random

import pytest

from meshwright.contact import exact


@pytest.mark.parametrize("sign", [1, -1])
def test_angles_in_degrees_lie_in_the_least_enclosures_of_three_doubles(sign):
    random = Random(4)
    degrees = [Fraction(random.randint(-(10**9), 10**9), random.choice((1, 1000, 3, 7**20))) for _ in range(200)]
    degrees += [Fraction(0), Fraction(90)]
    for angle, entry in zip(degrees, exact.angles(degrees, sign), strict=True):
        middle, radius = Fraction(float(entry["hi"])) + Fraction(float(entry["lo"])), Fraction(float(entry["radius"]))
        ends = [sign * angle * pi / 180 for pi in exact.PI]
        most = max(abs(end - middle) for end in ends)
        assert most <= radius <= most * (1 + Fraction(1, 2**52))
        assert float(entry["hi"]) == float(sum(ends) / 2)
