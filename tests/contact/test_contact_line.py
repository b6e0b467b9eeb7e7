"""Where the tool that cut the wheel equals the pinion, the flanks touch along lines."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.contact.contact_line import contact_line
from meshwright.contact.placement import placements


def worm_cut_by_an_equal_hob():
    drive = Drive.load("recess-action-full")
    return drive.with_(design={"hob_pitch_radius_mm": drive.design.value("worm_pitch_radius_mm")})


def equal_spheres():
    return Drive.load("spherical-table-2-1")


CASES = [(worm_cut_by_an_equal_hob, np.radians([700.0, 1500.0])), (equal_spheres, np.array([0.0, 0.1]))]


@pytest.mark.parametrize(("made", "angles"), CASES, ids=["worm", "spherical"])
def test_the_flanks_share_points_and_normals_all_along_the_line(made, angles):
    drive = made()
    starts, _ = drive.trace(angles)
    placed = placements(drive, angles).matrices
    for k, angle in enumerate(angles):
        line = contact_line(drive, angle, starts[k])
        assert len(line.points) > 10
        found = {}
        for name, matrix in placed.items():
            at = drive.flank(name)(line.parameters[name])
            found[name] = at.points @ matrix[k, :3, :3].T + matrix[k, :3, 3], at.normals @ matrix[k, :3, :3].T
            assert all((margin >= 0.0).all() for margin in at.margins.values() if np.isfinite(margin).any())
        assert found["pinion"][0] == pytest.approx(found["wheel"][0], abs=1e-9)
        assert found["pinion"][0] == pytest.approx(line.points, abs=1e-9)
        assert found["pinion"][1] == pytest.approx(-found["wheel"][1], abs=1e-9)


def test_the_line_of_equal_spheres_is_an_arc_across_the_face():
    """The rack's edge point sweeps an arc of the sphere's radius: the line runs from face to face on it."""
    drive = equal_spheres()
    start, _ = drive.trace([0.0])
    points = contact_line(drive, 0.0, start[0]).points
    heights = points[:, 2]
    half_face = 0.5 * drive.design.value("face_width_mm")
    assert np.abs(heights).max() <= half_face
    assert np.ptp(heights) > 0.75 * 2 * half_face
