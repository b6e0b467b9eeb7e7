"""The tooth that is drawn behind a flank: as thick as the closed forms of its profile say, at every place."""

import math

import numpy as np
import pytest

from meshwright import Drive
from meshwright.flank.mesh import mesh
from meshwright.flank.tooth import ASSUMED, tooth


def behind(drive, member, teeth):
    near = mesh(drive.region(member), (8, 8))
    return near, tooth(drive, member, near, teeth)


def test_an_involute_tooth_is_as_thick_as_iso_21771_says():
    """ISO 21771:2007, 5.3: s/r = π/z + 4 x tan α/z + 2 (inv α − inv α_y), cos α_y = r_b/r."""
    drive = Drive.load("spur-profile-shift")
    of = drive.design.value
    inv = lambda angle: np.tan(angle) - angle  # noqa: E731
    for member in ("pinion", "wheel"):
        z, x, alpha = of(f"{member}_teeth"), of(f"{member}_profile_shift_coefficient"), of("pressure_angle_deg")
        near, found = behind(drive, member, z)
        radius = np.hypot(near.points[:, 0], near.points[:, 1])
        at = np.arccos(np.minimum(drive.design.sizes[f"{member}_base_radius_mm"] / radius, 1.0))
        thickness = math.pi / z + 4 * x * math.tan(alpha) / z + 2 * (inv(alpha) - inv(at))
        assert np.abs(found.across) == pytest.approx(thickness, abs=2e-5)
        assert np.ptp(np.sign(found.across)) == 0


def test_a_straight_axial_thread_is_its_pitch_less_its_groove():
    """ISO 10828, form A: the groove widens by 2 tan α_x for each mm of radius; a circle at one axial position crosses
    the thread over its axial thickness by the screw parameter."""
    drive = Drive.load("plain-za")
    of, sizes = drive.design.value, drive.design.sizes
    near, found = behind(drive, "pinion", of("worm_threads"))
    lead, p = of("worm_lead_angle_deg"), sizes["screw_parameter_worm_mm_per_rad"]
    radius = np.hypot(near.points[:, 0], near.points[:, 1])
    beyond = radius - of("worm_pitch_radius_mm")
    groove = (sizes["groove_width_mm"] + 2 * beyond * math.tan(of("pressure_angle_deg"))) / math.cos(lead)
    thickness = 2 * math.pi * p / of("worm_threads") - groove
    assert np.abs(found.across) == pytest.approx(thickness / p, abs=1e-7)
    assert np.linalg.norm(found.normals, axis=1) == pytest.approx(1.0)


def test_a_side_with_a_design_of_its_own_is_not_invented():
    drive = Drive.load("bevel-hypoid")
    near, found = behind(drive, "wheel", 41)
    assert found.parameters is None and np.abs(found.across) == pytest.approx(ASSUMED * 2 * math.pi / 41)
