"""Objects name themselves in one line; equal designs are told by equal digests."""

import pytest

from meshwright import Drive


@pytest.mark.parametrize("shown", [lambda d: d, lambda d: d.design, lambda d: d.flank("wheel")])
def test_what_a_prompt_prints_is_one_line_that_names_the_design(shown):
    text = repr(shown(Drive.load("recess-action-full")))
    assert "recess-action-full (cylindrical_worm_zn_zn, right flank, " in text
    assert len(text) < 120 and "\n" not in text


def test_the_digest_tells_designs_apart_and_equal_ones_not():
    drive = Drive.load("recess-action-full")
    assert repr(drive) == repr(Drive.load("recess-action-full"))
    assert repr(drive) != repr(drive.with_(misalignment={"axial_mm": 0.01}))


def test_a_region_is_named():
    drive = Drive.load("recess-action-full").with_(blank={"hob_tip_rounding_mm": 0.48})
    assert repr(drive.flank("wheel", "fillet")).startswith("<Flank fillet of the wheel of recess-action-full")
