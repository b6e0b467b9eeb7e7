"""Branches of contact: several contacts on one tooth pair, folds, the spurious sheet."""

import json

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.contact import analysis
from meshwright.contact.branch import follow
from meshwright.contact.results import ARCSEC
from tests.worm.designs import PROFILES, plain


def test_before_the_pitchfork_two_contacts_of_equal_error_and_a_saddle_after_it_one():
    drive = Drive.load("zk-zn-90")
    before, after = drive.contacts(np.radians(-30.0)), drive.contacts(np.radians(10.0))
    errors = before.error / ARCSEC
    assert np.allclose(errors[[0, 2]], 133.65148, atol=1e-5) and errors[1] < errors[0]
    assert [bool(c > 0) for c in before.curvatures[:, 0]] == [True, False, True]
    assert before.flags == ((), ("interference",), ())
    assert len(after.error) == 1 and after.error[0] / ARCSEC < 133.0


def test_the_saddle_meets_the_constant_branches_at_the_pitchfork():
    """The difference of their errors vanishes there as the square of the angle does."""
    drive = Drive.load("zk-zn-90")
    fork = drive.limits().branch_points[0].angle
    gaps = [np.ptp(drive.contacts(fork - step).error) for step in (0.02, 0.04)]
    assert gaps[1] / gaps[0] == pytest.approx(4.0, rel=0.05)


def test_a_drive_at_an_acute_angle_has_one_contact():
    drive = Drive.load("zk-zn-45")
    for angle in np.radians([-100.0, 0.0, 60.0]):
        result = drive.contacts(angle)
        assert len(result.error) == 1
        assert np.allclose(result.points, drive.tca([angle]).points, atol=1e-9)


def test_misalignment_unfolds_the_pitchfork_into_a_fold():
    drive = Drive.load("zk-zn-90").with_(misalignment={"center_distance_mm": 0.005})
    kinds = {point.kind for point in drive.limits().branch_points}
    assert "pitchfork" not in kinds


@pytest.mark.parametrize("flank", ["right", "left"])
def test_arclength_passes_a_fold_that_stepping_in_angle_cannot(flank):
    """A nearly spur wheel: the branch turns back, and both arms hold contacts of the same equations."""
    drive = Drive.from_tables(plain("ZN", hob_pitch_radius_mm=21.5, shaft_angle_deg=70.0, flank=flank))
    sense = drive.design.flank
    angle = -sense * np.radians(25.0)
    x, _ = drive.trace([angle])
    branch = follow(drive, angle, x[0], sense * 0.05, 40)
    turn = np.argmax(sense * branch.angles)
    assert 0 < turn < len(branch.angles) - 1
    assert branch.slopes[0] * branch.slopes[-1] < 0
    folds = [p for p in drive.limits().branch_points if p.kind == "fold"]
    fold = min(folds, key=lambda p: abs(p.angle - branch.angles[turn]))
    assert abs(fold.angle - branch.angles[turn]) < 0.02
    assert drive.tca([fold.angle + sense * np.radians(3.0)]).status[0] != "converged"
    for k in (0, turn, len(branch.angles) - 1):
        residual = analysis.at_solutions(drive, branch.angles[[k]], branch.unknowns[[k]]).residual
        assert residual[0] < 1e-10


@pytest.mark.parametrize("profile", PROFILES)
def test_a_solution_on_the_spurious_sheet_is_flagged_and_never_among_the_contacts(profile):
    """Beyond n_x = 0 every equation still holds; the wheel's flank does not lie there."""
    drive = Drive.from_tables(plain(profile, hob_pitch_radius_mm=21.0))
    flank = drive.flank("wheel")
    t = float(drive.function("profile_range_tool")()["pitch_point"])
    inside, beyond = (flank([[t, psi]]).margins["spurious_sheet"][0] for psi in (0.3, 0.3 + np.pi))
    assert inside > 0 > beyond
    for angle in np.radians([-40.0, 0.0, 40.0]):
        assert not any("spurious_sheet" in flags for flags in drive.contacts(angle).flags)


def test_the_command_reports_the_other_contacts(capsys):
    assert main(["tca", "zk-zn-90", "--phi-deg=-30", "--all-contacts", "--json", "-"]) == 0
    (point,) = json.loads(capsys.readouterr().out)["points"]
    assert len(point["other_contacts"]) == 2
    assert sum("interference" in other["flags"] for other in point["other_contacts"]) == 1
    assert main(["tca", "zk-zn-90", "--phi-deg=-30", "--all-contacts"]) == 0
    assert "+2 contacts" in capsys.readouterr().out
