"""Commands say the same of the same angle: whether teeth touch, how, and at which error."""

import numpy as np
import pytest

from meshwright import Drive
from tests.cycle.agreement import disagreements, drawn
from tests.quick import full, quick

#: Designs in all, and those of a short run, in parts.
ALL = 3_000
SOME = 60
PARTS = 20


def told(seed):
    """What commands say differently of the design of a seed, and the design; nothing where they agree."""
    rng = np.random.default_rng([44, *seed])
    drive = drawn(rng)
    words = disagreements(drive, rng)
    return [*words, drive.design.given()] if words else []


@pytest.mark.parametrize("number", quick(range(3), 1, 2))
def test_commands_agree_on_random_designs(number):
    assert not told([1, number])


@pytest.mark.validate
@pytest.mark.parametrize("part", range(PARTS))
def test_commands_agree_on_many_random_designs(part):
    count = (ALL if full() else SOME) // PARTS
    told_of = [told([2, part, number]) for number in range(count)]
    assert not [words for words in told_of if words]


@pytest.mark.validate
@pytest.mark.parametrize("number", [5062, 5071, 5107])
def test_a_sweep_past_places_that_bodies_cannot_make_says_what_an_analysis_says(number):
    assert not told([9, number])


def test_an_angle_far_from_the_middle_has_its_contact_whether_or_not_others_were_asked_for():
    """Crown-cut bevel gears shifted by 5 µm touch at the heel from end to end of their window."""
    shifted = {"pinion_axial_mm": -0.005}
    far = Drive.load("bevel-crown-pair").with_(misalignment=shifted)
    angles = np.linspace(far.window.begin.angle, far.window.end.angle, 9)[1:-1]
    alone = [Drive.load("bevel-crown-pair").with_(misalignment=shifted).tca([angle]).status[0] for angle in angles[::3]]
    assert alone == [*far.tca(angles).status[::3]] == ["edge_contact"] * 3


def test_a_pair_whose_teeth_do_not_reach_each_other_turns_without_contact():
    """Of tips 1 mm lower than the path of contact."""
    drive = Drive.load("zk-zn-30")
    low = drive.with_(blank={"wheel_tip_radius_mm": drive.design.value("wheel_tip_radius_mm", "blank") - 4.0})
    assert low.past_the_tips
    angles = low.about_the_middle([-0.3, 0.0, 0.3])
    turned = low.turn(angles)
    assert set(turned.statuses) == {"no_contact"} and np.isnan(turned.errors).all()
    assert set(low.tca(turned.own_angles).status) <= {"no_contact", "edge_contact", "corner_contact"}
