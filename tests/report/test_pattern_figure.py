"""The picture of a contact pattern shows the flank and what lies on it: nothing invented between or beyond."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.report import analyse, pattern_figure
from meshwright.report.branches import broken

from .conftest import quiet


@pytest.fixture(scope="module")
def jumping():
    """At 60° one branch of contact interferes over part of the mesh, so that another one takes its place."""
    return analyse(Drive.load("plain-zk").with_(design={"shaft_angle_deg": 60.0}), quiet)


def _jumps(points):
    """Steps between points (N, 3) that are more than twice as long as both neighbours: how many."""
    steps = np.pad(np.linalg.norm(np.diff(points, axis=0), axis=1), 1, constant_values=np.nan)
    return int(np.sum(steps[1:-1] > 2.0 * np.fmax(steps[:-2], steps[2:])))


@pytest.mark.parametrize("member", ["pinion", "wheel"])
def test_no_line_joins_two_branches(jumping, member):
    """Towards a fold the contact moves faster and faster, but no step is twice as long as the one before."""
    points = jumping.tca.body_points[member]
    assert _jumps(points) >= 2
    assert _jumps(broken(points, jumping.breaks)) == 0


def test_one_branch_is_drawn_in_one_stroke(analysed):
    for name in ("recess-action-full", "face-worm-conical-convex"):
        assert analysed(name).breaks.size == 0


def test_the_picture_ends_where_the_worm_does(jumping):
    """Ellipses of almost flat contact would be ten times as long as the thread is high."""
    axes = pattern_figure.draw(jumping, "pinion").axes[0]
    tip = jumping.drive.design.value("worm_tip_radius_mm", "blank")
    assert axes.get_ylabel() == "radius on the pinion, mm"
    assert tip < axes.get_ylim()[1] < 1.1 * tip


def test_points_that_bodies_cannot_make_have_no_patch(jumping):
    flags = dict(zip(jumping.tca.angles, jumping.tca.flags, strict=True))
    assert jumping.pattern
    assert not any("interference" in flags[contour.angle] for contour in jumping.pattern)


def test_a_thread_of_several_turns_is_drawn_round(analysed):
    """The flank's grid follows the thread with its implicit parameter: cells of a few degrees, not of twenty."""
    points = analysed("face-worm-conical-convex").patches["pinion"].points
    turns = np.degrees(np.unwrap(np.arctan2(points[10, :, 1], points[10, :, 0])))
    assert np.ptp(turns) > 720.0
    assert np.abs(np.diff(turns)).max() < 6.0


@pytest.mark.parametrize("name", ["recess-action-full", "face-worm-conical-convex"])
def test_a_thread_is_unrolled_turn_by_turn(name, analysed):
    """The angle of the contact along the thread is that about the axis, counted on over the turns."""
    analysis = analysed(name)
    points = analysis.tca.body_points["pinion"]
    angle, radius = analysis.patch("pinion").projection(points)
    about = np.degrees(np.unwrap(np.arctan2(points[:, 1], points[:, 0])))
    assert np.ptp(about) > 720.0
    assert angle - angle[0] == pytest.approx(about - about[0], abs=1e-9)
    assert radius == pytest.approx(np.hypot(points[:, 0], points[:, 1]))


def test_a_left_hand_thread_unrolls_the_other_way():
    """Flank and path of the mirror image lie together, at opposite angles."""
    right = analyse(Drive.load("plain-zk"), quiet)
    left = analyse(right.drive.with_(design={"hand": "left"}), quiet)
    places = [np.array(a.patch("pinion").projection(a.tca.body_points["pinion"])) for a in (right, left)]
    assert left.tca.angles == pytest.approx(-right.tca.angles[::-1])
    assert places[1][0] == pytest.approx(-places[0][0, ::-1], abs=1e-6)
    assert places[1][1] == pytest.approx(places[0][1, ::-1], abs=1e-8)
    across, up = left.patch("pinion").projection(left.patch("pinion").points)
    for place, grid in zip(places[1], (across, up), strict=True):
        assert np.nanmin(grid) < place.min() < place.max() < np.nanmax(grid)
