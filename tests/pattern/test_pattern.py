"""Contact patches by separation against closed forms, the quadratic ellipse and the placed flanks themselves."""

import json
import math

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.cycle.pairs import Mesh
from meshwright.pattern.pattern import contour, patches

AT = math.radians(1000.0)


@pytest.mark.parametrize(("hob_radius", "semi_major"), [(19.6, 8.700), (19.8, 7.368), (20.0, 6.518)])
def test_the_long_axis_shrinks_with_the_hob_while_the_short_one_stays(hob_radius, semi_major):
    result = Drive.load("recess-action-full").with_(design={"hob_pitch_radius_mm": hob_radius}).tca([AT])
    assert result.semi_axes[0] == pytest.approx([semi_major, 0.632], abs=5e-4)


def test_the_long_axis_grows_without_bound_towards_the_equal_hob():
    drive = Drive.load("recess-action-full")
    equal = drive.design.as_solved()["design"]["worm_pitch_radius_mm"]
    axes = [drive.with_(design={"hob_pitch_radius_mm": equal + d}).tca([AT]).semi_axes[0, 0] for d in (4e-3, 1e-3)]
    assert axes[1] / axes[0] == pytest.approx(2.0, rel=1e-3)
    assert drive.with_(design={"hob_pitch_radius_mm": equal}).tca([AT]).status == ("line_contact",)


#: Separations small against the size of the ellipse, large against round-off.
SEPARATIONS = {"recess-action-full": 1e-5, "face-worm-conical-convex": 1e-5, "spherical-table-3-1-concave": 1e-3}


@pytest.mark.parametrize("design", SEPARATIONS)
def test_contours_approach_the_ellipse_with_the_root_of_the_separation_one_sided_and_linearly_in_the_mean(design):
    drive = Drive.load(design)
    result = drive.tca([0.07])
    one_sided, mean = [], []
    for separation in (SEPARATIONS[design], SEPARATIONS[design] / 10):
        patch = contour(drive, 0.07, 12, separation, result)
        curvature = np.stack([np.cos(patch.directions), np.sin(patch.directions)], axis=1) ** 2 @ result.curvatures[0]
        deviation = patch.radii / np.sqrt(2 * separation / curvature) - 1.0
        one_sided.append(np.abs(deviation).max())
        mean.append(np.abs(deviation[:6] + deviation[6:]).max() / 2)
    assert one_sided[0] / one_sided[1] == pytest.approx(math.sqrt(10.0), rel=0.05)
    assert mean[0] / mean[1] == pytest.approx(10.0, rel=0.1)


def _in_mesh(drive, result, pinion, wheel):
    """Worm and wheel points in the fixed frame by the text's own matrices (shaft angle 90°, no errors)."""
    phi_1, phi_2 = result.angles[0], result.wheel_angles[0]

    def about_z(angle, points):
        c, s = math.cos(angle), math.sin(angle)
        return points @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T

    x, y, z = about_z(-phi_2, wheel).T
    distance = drive.design.as_solved()["design"]["center_distance_mm"]
    return about_z(phi_1, pinion), np.stack([x + distance, z, -y], axis=1)


def test_the_flanks_stand_the_separation_apart_on_the_contour():
    drive = Drive.load("recess-action-full")
    result = drive.tca([AT])
    patch = contour(drive, AT, 24, result=result)
    worm, wheel = _in_mesh(drive, result, patch.body_points["pinion"], patch.body_points["wheel"])
    assert wheel - worm == pytest.approx(np.outer(np.full(24, 0.00632), result.normals[0]), abs=1e-10)
    along = worm - result.points[0]
    radii = np.linalg.norm(along - np.outer(along @ result.normals[0], result.normals[0]), axis=1)
    assert radii == pytest.approx(patch.radii, abs=1e-9)


def test_the_patch_ends_at_the_edge_of_the_flank():
    window = Mesh.of(Drive.load("recess-action-full")).window
    drive = window.path.drive
    tip = drive.design.value("wheel_tip_radius_mm", "blank")
    patch = contour(drive, window.begin.angle + 0.05, 36)
    radii = np.hypot(*patch.body_points["wheel"][:, :2].T)
    cut = patch.radii_on_flank < patch.radii - 1e-9
    assert 0 < cut.sum() < 36
    assert radii[cut] == pytest.approx(tip, abs=1e-7)
    assert (radii <= tip + 1e-7).all()


def test_the_other_hand_has_the_mirrored_patch():
    right = contour(Drive.load("recess-action-full"), AT, 12)
    left = contour(Drive.load("recess-action-full").with_(design={"hand": "left"}), -AT, 12)
    assert left.radii[(-np.arange(12)) % 12] == pytest.approx(right.radii, abs=1e-8)
    assert left.points[(-np.arange(12)) % 12] * [1, -1, 1] == pytest.approx(right.points, abs=1e-8)


def test_pairs_that_lag_leave_smaller_patches():
    mesh = Mesh.of(Drive.load("recess-action-full"))
    found = patches(mesh, 1.0, 8)
    pairs = {p.number: p for p in mesh.pairs(1.0)}
    assert set(found) == set(pairs)  # all stand closer than the separation of 6.32 µm
    for number, patch in found.items():
        assert patch.separation == pytest.approx(0.00632 - pairs[number].separation, abs=1e-12)


def test_an_edge_that_touches_first_keeps_the_tangencies_apart():
    """Helical teeth out of line touch with the end of a face: patches of tangencies are then smaller."""
    drive = Drive.load("helical-crowned").with_(misalignment={"horizontal_deg": 0.08})
    mesh = Mesh.of(drive)
    teeth, angle = mesh.rigid, mesh.window.begin.angle + 0.5 * mesh.window.span
    (stands,) = teeth.transmitted([angle])
    found = patches(mesh, angle, 8, 0.1)
    assert found
    for pair in mesh.pairs(angle):
        at = mesh.mirror * pair.angle
        apart = abs(float(mesh.window.path.levers([at])[0])) * mesh.sense * (stands - pair.error)
        assert apart > 0.001
        if pair.number in found:
            assert found[pair.number].separation == pytest.approx(0.1 - apart, abs=1e-12)


def test_the_command_writes_the_contour_of_each_point(capsys):
    assert main(["tca", "recess-action-full", "--phi-deg", "900,1000", "--contour", "8", "--json", "-"]) == 0
    points = json.loads(capsys.readouterr().out)["points"]
    assert [[c["direction_deg"] for c in p["contour"]] for p in points] == [[45.0 * k for k in range(8)]] * 2
    assert main(["tca", "recess-action-full", "--contour", "2", "--json", "-"]) == 2
