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
    assert np.all(np.isnan(result.points)) and not result.complete


@pytest.mark.parametrize("profile", PROFILES)
def test_an_oversize_hob_of_the_same_form_gives_point_contact(profile):
    result = Drive.from_tables(plain(profile, hob_pitch_radius_mm=21.0)).tca(np.radians([-30.0, 0.0, 20.0]))
    assert set(result.status) == {"converged"}
    assert np.all(result.curvatures > 0)


@pytest.mark.parametrize("profile", ["ZA", "ZI", "ZN", "ZK"])
def test_with_an_undersize_hob_the_middle_of_the_face_interferes_and_contact_moves_to_its_side(profile):
    found = Drive.from_tables(plain(profile, hob_pitch_radius_mm=19.8)).contacts(0.0)
    middle = np.argmin(np.abs(found.unknowns["psi_fixed_hob"]))
    side = np.argmax(found.unknowns["psi_fixed_hob"])
    assert found.flags[middle] == ("interference",) and found.flags[side] == ()
    assert found.error[side] > found.error[middle]  # s = +1: the larger wheel angle leads


@pytest.mark.parametrize("form", PROFILES)
def test_every_packaged_plain_drive_carries_load_across_its_pitch(form):
    drive = Drive.load(f"plain-{form.lower()}")
    result = drive.tca(np.linspace(-0.5, 0.5, 9) * drive.pitch())
    assert result.complete
    assert not any(result.flags[2:7])
