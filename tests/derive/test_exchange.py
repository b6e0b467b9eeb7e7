"""What a family declares of an exchange is held against the public schema."""

from dataclasses import replace

import pytest

from derive.drives.cylindrical_gears_rexs import EXCHANGE
from derive.exchange import rexs


def test_an_attribute_that_rexs_does_not_have():
    wrong = replace(EXCHANGE.attributes[0], name="centre_distance")
    with pytest.raises(ValueError, match="centre_distance of cylindrical_stage"):
        rexs.check(replace(EXCHANGE, attributes=(wrong,)))


def test_a_relation_that_rexs_does_not_have():
    wrong = rexs.Relation("stage", (("stage", "stage"), ("gear_1", "pinion"), ("gear_2", "unit")))
    with pytest.raises(ValueError, match="no relation stage"):
        rexs.check(replace(EXCHANGE, relations=(wrong,)))
