"""In lanes an operand is that of the scalar program, at the place of its lane."""

from derive.emit.lanes import _in_lane, _in_lanes


def test_arrays_are_laid_out_lane_beside_lane():
    assert _in_lane("s[3]", "l") == "s[3 * MW_LANES + l]"
    assert _in_lane("phi", "l") == "phi[l]"
    assert _in_lanes({7: "x[0]"}, "h") == {7: "x[0 * MW_LANES + h]"}
