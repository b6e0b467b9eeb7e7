"""Settings that make no gear are refused with the key, the value and the reason."""

import pytest

from meshwright import Drive
from meshwright.base.errors import DesignError
from tests.bevel.exact import crown_pair, formate_cradle


@pytest.mark.parametrize(
    ("member", "key", "value", "named"),
    [
        ("pinion", "radial_setting_mm", 0.0, "pinion.radial_setting_mm"),
        ("gear", "point_radius_mm", -76.0, "gear.point_radius_mm"),
        ("gear", "blade_angle_deg", 61.0, "gear.blade_angle_deg"),
        ("pinion", "face_width_mm", 200.0, "pinion.outer_cone_distance_mm"),
        ("pinion", "method", "formate", "pinion.method"),
        ("pinion", "ratio_of_roll", None, "pinion.ratio_of_roll"),
        ("pinion", "ratio_of_roll", float("inf"), "pinion.ratio_of_roll"),
        ("gear", "ratio_of_rol", 1.0, "gear.ratio_of_rol"),
    ],
)
def test_the_key_of_the_member_is_named(member, key, value, named):
    tables = crown_pair(lengthwise=2.0)
    tables[member] = {k: v for k, v in (tables[member] | {key: value}).items() if v is not None}
    with pytest.raises(DesignError) as refused:
        Drive.from_tables(tables)
    assert str(refused.value).startswith(named)


def test_a_formate_gear_has_no_ratio_of_roll():
    tables = formate_cradle()
    tables["gear"]["ratio_of_roll"] = 1.05
    with pytest.raises(DesignError, match="gear.ratio_of_roll"):
        Drive.from_tables(tables)


def test_a_point_past_the_edge_of_regression_is_flagged():
    tables = crown_pair(lengthwise=2.0, teeth=(6, 44))
    flank = Drive.from_tables(tables).flank("pinion")
    found = flank([[phi, -2.03] for phi in (-0.4, -0.2, -0.1, 0.0, 0.1)])
    assert (found.regular > 0).any()
    assert (found.regular < 0).any()
