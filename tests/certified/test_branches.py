"""Folds and crossings of branches, where no contact is single, are certain as solutions of their own equations."""

import json

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.contact.branch import follow, turning_point
from meshwright.contact.certificate import certify, certify_branch
from meshwright.cycle.path import Path
from tests.certified import trials


def test_the_pitchfork_of_a_drive_at_right_angles_lies_between_two_angles(capsys):
    """ZK worm and ZN hob at right angles: 4.832354 degrees, without that proof."""
    assert main(["limits", "zk-zn-90", "--json", "-"]) == 0
    (point,) = json.loads(capsys.readouterr().out)["branch_points"]
    certificate = point["certificate"]
    low, high = certificate["pinion_angle_deg"]
    assert certificate["outcome"] == "unique" and point["kind"] == "pitchfork"
    assert 4.8323535 < low < high < 4.8323545 and high - low < 1e-9
    assert low <= point["pinion_angle_deg"] <= high
    low, high = certificate["unfolding"]
    assert low <= 0.0 <= high and high - low < 1e-12


def test_beside_the_pitchfork_the_branches_part_as_the_square_root_of_the_angle():
    """Two branches leave the one that goes on: half their distance squared is linear in the angle, and zero there."""
    drive = Drive.load("zk-zn-90")
    (point,) = drive.limits().branch_points
    side = 1.0 if len(drive.contacts(point.angle + 1e-3).solutions) == 3 else -1.0
    steps, squares = side * np.array([4e-4, 2e-4]), []
    for step in steps:
        found = drive.contacts(point.angle + step).solutions
        certain = certify(drive, np.full(3, point.angle + step), found, [0] * 3)
        assert len(found) == 3 and set(certain.outcomes) == {"unique"}
        squares.append(max(np.sum((a - b) ** 2) for a in found for b in found))
    zero = steps[1] - squares[1] * (steps[0] - steps[1]) / (squares[0] - squares[1])
    assert abs(zero) < 1e-6
    low, high = point.certificate.angle
    assert low <= point.angle <= high


@pytest.fixture(scope="module")
def fold():
    """A drive, and angle and unknowns where its branch of contact turns back."""
    drive, _ = trials.fold()
    start = np.radians(-60.0)
    for solution in drive.contacts(start).solutions:
        path = Path.through(drive, start, solution).extended(start + drive.pitch())
        branch = follow(drive, path.angles[-1], path.unknowns[-1], 0.05, 400)
        if path.ended[1] and len(branch.turns):
            return drive, *turning_point(drive, branch, branch.turns[0])
    raise AssertionError("no fold")


def test_a_fold_lies_between_two_angles_and_its_contacts_meet_there(fold):
    drive, angle, unknowns = fold
    found = certify_branch(drive, angle, unknowns, crossing=False)
    assert found.outcome == "unique" and found.unfolding == (0.0, 0.0)
    low, high = found.angle
    assert low <= high < low + 1e-10
    steps, squares = -np.array([4e-4, 2e-4]), []
    for step in steps:
        both = sorted(drive.contacts(angle + step).solutions, key=lambda x: np.abs(x - unknowns).max())[:2]
        squares.append(np.sum((both[0] - both[1]) ** 2))
    zero = angle + steps[1] - squares[1] * (steps[0] - steps[1]) / (squares[0] - squares[1])
    assert abs(zero - low) < 1e-6
    assert not len([x for x in drive.contacts(high + 1e-3).solutions if np.abs(x - unknowns).max() < 0.1])


def test_an_ordinary_contact_is_neither_and_an_open_design_says_why(fold):
    drive = Drive.load("recess-action-full")
    angle = 0.5
    for crossing in (False, True):
        found = certify_branch(drive, angle, drive.trace([angle])[0][0], crossing)
        assert found.outcome == "unknown" and found.reason in ("fold", "wide") and found.angle is None
        assert certify_branch(fold[0], np.nan, fold[2], crossing).outcome == "unknown"


def test_the_mirror_image_has_its_branch_point_at_the_other_angle():
    right = Drive.load("zk-zn-90")
    left = right.with_(design={"hand": "left"})
    (there,), (mirrored,) = right.limits().branch_points, left.limits().branch_points
    assert mirrored.certificate.angle == (-there.certificate.angle[1], -there.certificate.angle[0])
