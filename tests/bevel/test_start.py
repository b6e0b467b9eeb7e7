"""Where the search for contact starts is a hint: a pair whose path misses the gear's mean point is analysed too."""

import tomllib

import numpy as np
import pytest

from meshwright import Drive
from meshwright.contact.results import ARCSEC

#: The concave flank of a Formate hypoid gear. The nearest point that its pinion's settings cut passes the gear's mean
#: point at 5 µm.
CONCAVE = """
drive = "bevel"
flank = "concave"
[design]
pinion_teeth = 11
gear_teeth = 41
shaft_angle_deg = 90.0
offset_mm = 30.0
hand = "left"
[pinion]
point_radius_mm = 93.017728
blade_angle_deg = 21.0
radial_setting_mm = 87.331219
cradle_angle_deg = 62.876825
tilt_deg = 16.4
swivel_deg = -63.176825
root_angle_deg = -0.5
blank_offset_mm = 29.400011
sliding_base_mm = 9.702189
center_to_back_mm = 0.0
ratio_of_roll = 3.743039
roll_2c = 0.03
roll_6d = 0.03
roll_24e = -0.1
roll_120f = 0.2
roll_720g = -0.5
pitch_angle_deg = 15.7
pitch_apex_mm = 12.3
face_angle_deg = 15.7
face_apex_mm = 27.081941639359982
outer_cone_distance_mm = 116.5
face_width_mm = 34.0
[gear]
method = "formate"
point_radius_mm = 92.94681578978751
blade_angle_deg = 21.0
radial_setting_mm = 89.92828651053962
cradle_angle_deg = 63.92680486259193
root_angle_deg = 74.0
sliding_base_mm = -6.0
pitch_angle_deg = 74.0
pitch_apex_mm = 0.0
face_angle_deg = 74.0
face_apex_mm = 1.2483593230339225
outer_cone_distance_mm = 104.0
face_width_mm = 30.0
[contact]
separation_mm = 0.00635
"""


def test_a_pair_whose_path_misses_the_mean_point_of_the_gear_is_analysed():
    """Errors at 1.25 and 1.35 rad, from an independent calculation of the same settings."""
    drive = Drive.from_tables(tomllib.loads(CONCAVE))
    result = drive.tca([1.25, 1.35])
    assert result.status == ("converged", "converged") and result.flags == ((), ())
    assert result.error / ARCSEC == pytest.approx([10.475849204, 2.624310346], abs=1e-6)
    first = drive.first_contact(result.angles, result)
    assert first.kinds == ("tangency", "tangency")
    assert np.abs(first.errors - result.error).max() < 1e-10
