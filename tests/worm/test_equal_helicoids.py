"""A wheel cut by the worm's own helicoid: line contact and no transmission error, for every form and shaft angle."""

import numpy as np
import pytest

from meshwright import Drive
from tests.worm.designs import PROFILES, plain


@pytest.mark.parametrize("shaft_angle", [50.0, 90.0, 115.0])
@pytest.mark.parametrize("profile", PROFILES)
def test_equal_hob_and_worm_touch_along_a_line_without_transmission_error(profile, shaft_angle):
    result = Drive.from_tables(plain(profile, shaft_angle_deg=shaft_angle)).tca(np.radians([-30.0, 0.0, 20.0]))
    assert result.status == ("line_contact",) * 3
    assert np.abs(result.error).max() < 1e-14
    assert np.all(np.isnan(result.points)) and result.complete


@pytest.mark.parametrize("profile", PROFILES)
def test_an_oversize_hob_of_the_same_form_gives_point_contact(profile):
    result = Drive.from_tables(plain(profile, hob_pitch_radius_mm=21.0)).tca(np.radians([-30.0, 0.0, 20.0]))
    assert set(result.status) == {"converged"}
    assert np.all(result.curvatures > 0)


@pytest.mark.parametrize("flank", ["right", "left"])
@pytest.mark.parametrize("profile", PROFILES)
def test_an_undersize_hob_interferes_at_every_angle(profile, flank):
    """The gap rises from the middle of the face to either side: a saddle. On one side it falls again, and the tangency
    there is a contact by its curvatures; but teeth that touch in it overlap on the other half of the face."""
    drive = Drive.from_tables(plain(profile, hob_pitch_radius_mm=19.8, flank=flank))
    result = drive.tca(np.linspace(-0.5, 0.5, 7) * drive.pitch())
    assert set(result.status) == {"converged"} and set(result.flags) == {("interference",)}
    assert np.abs(result.unknowns["psi_fixed_hob"][3]) < 0.05
    assert not result.complete


@pytest.mark.parametrize("profile", PROFILES)
def test_the_tangency_beside_the_middle_of_an_undersize_hob_s_face_is_no_contact_of_bodies(profile):
    found = Drive.from_tables(plain(profile, hob_pitch_radius_mm=19.8)).contacts(0.0)
    middle = np.argmin(np.abs(found.unknowns["psi_fixed_hob"]))
    side = np.argmax(found.unknowns["psi_fixed_hob"])
    assert found.flags[middle] == ("interference",) and found.flags[side] == ()
    assert found.error[side] > found.error[middle]  # s = +1: the larger wheel angle leads


def test_a_side_contact_off_the_face_does_not_displace_the_saddle_of_an_undersize_hob():
    drive = Drive.load("plain-zi").with_(design={"hob_pitch_radius_mm": 20.289172746317988})
    result = drive.tca([0.0])
    assert result.flags == (("interference",),)
    assert abs(result.unknowns["psi_fixed_hob"][0]) < 0.05


@pytest.mark.parametrize("form", PROFILES)
def test_every_packaged_plain_drive_carries_load_across_its_pitch(form):
    drive = Drive.load(f"plain-{form.lower()}")
    result = drive.tca(np.linspace(-0.5, 0.5, 9) * drive.pitch())
    assert result.complete
    assert not any(result.flags[2:7])
