"""Velocities at the contact against rigid motions written out by hand and closed forms of involute gears."""

import json
import math

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.contact.velocities import velocities

ANGLES = np.radians([-20.0, -3.0, 0.0, 11.0, 25.0])


def _turn(axis, angle, derivative=False):
    """Rotation (3, 3) about a coordinate axis, or its derivative by the angle."""
    i, j = [k for k in range(3) if k != axis]
    sign = -1.0 if axis == 1 else 1.0
    c, s = math.cos(angle), math.sin(angle)
    if derivative:
        c, s = -s, c
    matrix = np.zeros((3, 3)) if derivative else np.eye(3)
    matrix[i, i] = matrix[j, j] = c
    matrix[j, i], matrix[i, j] = sign * s, -sign * s
    return matrix


def test_a_misaligned_worm_drive_by_derivatives_of_its_motions():
    """r = Rz(φ1) r1 = Tx Rx(−Σ−Δh) Ry(Δv) Tz Rz(−φ2) r2 at fixed body points; wheel's speed from equal normal parts."""
    errors = {"horizontal_deg": 0.2, "vertical_deg": -0.1, "axial_mm": 0.3, "center_distance_mm": 0.1}
    drive = Drive.load("plain-za").with_(misalignment=errors)
    found = drive.tca(ANGLES)
    moving = velocities(drive, found)
    tilt = _turn(0, -math.radians(90.2)) @ _turn(1, math.radians(-0.1))
    for k, angle in enumerate(ANGLES):
        one = _turn(2, angle, True) @ found.body_points["pinion"][k]
        two = -tilt @ _turn(2, -found.wheel_angles[k], True) @ found.body_points["wheel"][k]
        two = two * (found.normals[k] @ one) / (found.normals[k] @ two)
        assert np.linalg.norm(moving.sliding[k] - (one - two)) < 1e-12 * np.linalg.norm(one)
        assert np.linalg.norm(moving.bodies["pinion"][k] - one) < 1e-12 * np.linalg.norm(one)


def test_crossed_helical_gears_in_closed_form():
    """The contact moves along its fixed normal, ċ = s r_b1 cos β_b1 n; the wheel turns by z1/z2."""
    drive = Drive.load("crossed-helical-17-23")
    found = drive.tca(ANGLES)
    moving = velocities(drive, found)
    radii = [z / (2 * math.cos(math.radians(45.0))) for z in (17, 23)]
    along = found.normals * 17 / 2 * math.cos(math.radians(20.0))  # r_b cos β_b = ½ m z cos α
    assert np.abs(moving.point - along).max() < 1e-12 * 17
    pinion = np.cross([0.0, 0.0, 1.0], found.points)
    wheel = np.cross([0.0, -1.0, 0.0], found.points - [sum(radii), 0.0, 0.0]) * 17 / 23
    assert np.abs(moving.sliding - (pinion - wheel)).max() < 1e-12 * 17
    assert np.abs(moving.entraining - (0.5 * (pinion + wheel) - along)).max() < 1e-12 * 17


@pytest.mark.parametrize(
    "design", ["plain-zc", "spherical-table-3-1-convex", "face-worm-conical-convex", "bevel-formate"]
)
def test_normal_parts_are_equal_and_turn_the_wheel_as_its_angle_says(design):
    """n·v1 = n·v2 = n·ċ, so no power is made; dφ2/dφ1 by eighth-order differences of the wheel angle."""
    drive = Drive.load(design)
    step, angles = 2e-3, ANGLES[1:4]
    found = drive.tca(angles)
    moving = velocities(drive, found)
    size = np.linalg.norm(moving.bodies["pinion"], axis=1)
    for tangential in (moving.sliding, moving.entraining):
        assert np.abs(np.sum(tangential * found.normals, axis=1) / size).max() < 1e-12
    weights = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
    slope = sum(
        w * (drive.tca(angles + k * step).wheel_angles - drive.tca(angles - k * step).wheel_angles)
        for k, w in weights.items()
    ) / step  # fmt: skip
    assert found.instantaneous_ratio == pytest.approx(slope, rel=1e-10)


def test_spur_gears_slide_in_proportion_to_the_distance_from_the_pitch_point():
    """|v_g| = (1 + z1/z2) × distance from the pitch point along the line of action, in the middle of crowned teeth.

    Specific sliding of the pinion then is 1 − (z1/z2) ϱ2/ϱ1, ϱ1 = r_b1 tan α_w + x, ϱ2 = r_b2 tan α_w − x.
    """
    drive = Drive.from_tables({
        "drive": "cylindrical-gears",
        "design": {
            "normal_module_mm": 3.0, "pressure_angle_deg": 20.0, "pinion_teeth": 20, "wheel_teeth": 30,
            "face_width_mm": 20.0, "pinion_lead_crowning_um": 10.0,
        },
    })  # fmt: skip
    found = drive.tca(np.radians([-6.0, -2.0, 3.0, 7.0]))
    moving = velocities(drive, found)
    base = 30.0 * math.cos(math.radians(20.0))
    along = base * found.angles  # of the contact from the pitch point, as φ = 0 touches there
    assert np.linalg.norm(moving.sliding, axis=1) == pytest.approx((1 + 20 / 30) * np.abs(along), rel=1e-9)
    one, two = base * math.tan(math.radians(20.0)) + along, 1.5 * base * math.tan(math.radians(20.0)) - along
    assert moving.specific_sliding["pinion"] == pytest.approx(1 - two / (1.5 * one), rel=1e-9)
    assert moving.specific_sliding["wheel"] == pytest.approx(1 - 1.5 * one / two, rel=1e-9)


def test_the_other_hand_moves_as_the_mirror_image():
    right = Drive.load("plain-za")
    left = right.with_(design={"hand": "left"})
    one, two = (velocities(d, d.tca(s * ANGLES)) for d, s in ((right, 1.0), (left, -1.0)))
    flip = np.array([1.0, -1.0, 1.0])
    assert two.sliding == pytest.approx(-flip * one.sliding, abs=1e-12)
    assert two.entraining == pytest.approx(-flip * one.entraining, abs=1e-12)


def test_the_command_writes_them_and_null_without_a_contact_point(capsys):
    main(["tca", "spur-profile-shift", "--phi-deg", "0", "--json", "-"])
    (point,) = json.loads(capsys.readouterr().out)["points"]
    assert point["status"] == "line_contact"
    assert point["sliding_velocity_mm_per_rad"] is None and point["entraining_velocity_mm_per_rad"] is None
    assert main(["tca", "plain-za", "--phi-deg", "0", "--json", "-"]) == 0
    (point,) = json.loads(capsys.readouterr().out)["points"]
    assert len(point["sliding_velocity_mm_per_rad"]) == len(point["entraining_velocity_mm_per_rad"]) == 3
