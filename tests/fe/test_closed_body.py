"""Closed bodies: watertight, whole, with the volume of what they are."""

import struct
from dataclasses import replace

import numpy as np
import pytest

from meshwright import DesignError, Drive, UsageError
from meshwright.cli import main
from meshwright.fe.closed_body import closed_body, solid_body, volume


def _edges(triangles):
    return np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])


def test_the_volume_of_a_cube():
    points = np.array([[x, y, z] for x in (0.0, 2.0) for y in (0.0, 2.0) for z in (0.0, 2.0)])
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    triangles = np.array([[q[0], *pair] for q in quads for pair in (q[1:3], q[2:4])])
    assert volume(points, triangles) == pytest.approx(8.0)


@pytest.mark.parametrize(
    ("name", "member", "teeth"),
    [
        ("helical-crowned", "wheel", 2),
        pytest.param("spherical-table-4-4-concave", "pinion", 1, marks=pytest.mark.validate),
    ],
)
def test_a_body_is_closed_and_its_flanks_are_near(name, member, teeth):
    body = closed_body(Drive.load(name), member, teeth)
    edges = _edges(body.triangles)
    there, back = (set(map(tuple, e.tolist())) for e in (edges, edges[:, ::-1]))
    assert len(there) == len(edges) and there == back
    assert body.volume > 0.0 and body.departure <= 1e-3


@pytest.mark.validate
def test_a_further_tooth_always_adds_the_same_volume():
    body = solid_body(Drive.load("helical-crowned"), "wheel", 1)
    one, two, three = (replace(body, teeth=n).faceted(1e-2).volume for n in (1, 2, 3))
    assert three - two == pytest.approx(two - one, rel=1e-9)


@pytest.mark.validate
def test_a_whole_gear_lies_between_its_root_and_tip_cylinders():
    drive = Drive.load("helical-crowned")
    body = closed_body(drive, "pinion")
    assert body.departure <= 1e-3
    radii = np.hypot(body.points[:, 0], body.points[:, 1])
    tip = drive.design.value("pinion_tip_radius_mm", "blank")
    assert radii.max() == pytest.approx(tip, abs=1e-3)
    width, bore = np.ptp(body.points[:, 2]), radii.min()
    assert np.pi * width * (0.8 * tip) ** 2 < body.volume + np.pi * width * bore**2 < np.pi * width * tip**2


def test_a_left_hand_body_is_the_mirror_image():
    drive = Drive.load("plain-za")
    right = closed_body(drive, "pinion", departure=5e-2)
    left = closed_body(drive.with_(design={"hand": "left"}), "pinion", departure=5e-2)
    assert left.volume == pytest.approx(right.volume, rel=1e-9)


@pytest.mark.validate
def test_a_worm_is_a_screw_of_its_cross_section():
    """All sections of a helicoid across its axis are alike: the volume is the end face's area by the length."""
    body = closed_body(Drive.load("plain-za"), "pinion", departure=5e-3)
    there, back = (set(map(tuple, e.tolist())) for e in (_edges(body.triangles), _edges(body.triangles)[:, ::-1]))
    assert there == back and body.departure <= 5e-3
    ends = body.points[:, 2].min(), body.points[:, 2].max()
    corners = body.points[body.triangles]
    top = corners[(corners[:, :, 2] == ends[1]).all(axis=1)]
    (ax, ay), (bx, by) = (top[:, k, :2].T - top[:, 0, :2].T for k in (1, 2))
    area = 0.5 * (ax * by - ay * bx).sum()
    assert body.volume == pytest.approx(area * (ends[1] - ends[0]), rel=1e-3)  # facets 5 µm off on 44 mm
    tip = Drive.load("plain-za").design.value("worm_tip_radius_mm", "blank")
    assert np.hypot(body.points[:, 0], body.points[:, 1]).max() == pytest.approx(tip, abs=1e-6)


def test_the_command_writes_a_watertight_stl(tmp_path, capsys):
    path = tmp_path / "wheel.stl"
    assert main(["surface", "helical-crowned", "--member", "wheel", "--solid", "--teeth", "2", "--stl", str(path)]) == 0
    (count,) = struct.unpack("<I", path.read_bytes()[80:84])
    assert f"{count} facets" in capsys.readouterr().err


def test_what_has_no_closed_body_says_why(capsys):
    with pytest.raises(UsageError, match="one body with 2 threads"):
        closed_body(Drive.load("plain-za"), "pinion", 1)
    assert main(["surface", "helical-crowned", "--member", "wheel", "--solid", "--teeth", "999", "--stl", "-"]) == 2
    assert main(["surface", "helical-crowned", "--member", "wheel", "--solid"]) == 2
    assert main(["surface", "helical-crowned", "--member", "wheel", "--region", "fillet", "--solid", "--stl", "-"]) == 2
    assert "choose from 1 to" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "member", "changes", "words"),
    [
        ("spur-profile-shift", "pinion", {"design": {"pinion_profile_shift_coefficient": 1.4}}, "point below the tip"),
        ("plain-za", "wheel", {"blank": {"wheel_tip_radius_mm": 60.0}}, "is empty"),
    ],
)
def test_teeth_that_are_not_whole_are_refused_with_the_reason(name, member, changes, words):
    with pytest.raises((DesignError, UsageError), match=words):
        closed_body(Drive.load(name).with_(**changes), member, 1)


@pytest.mark.validate
def test_a_bevel_tooth_lies_between_its_cones():
    """Heel, toe and face cones of the blank (ISO 23509: cone distance along the pitch cone)."""
    drive = Drive.load("bevel-formate")
    body = solid_body(drive, "wheel", 1)
    points = np.concatenate([p.points.reshape(-1, 3) for p in body.splined(1e-3)[0] if p.kind != "bore"])

    def of(key):
        return drive.design.value(key, "gear")

    radius, z = np.hypot(points[:, 0], points[:, 1]), points[:, 2]
    delta, tip = of("pitch_angle_deg"), of("face_angle_deg")
    along = (z + of("pitch_apex_mm")) * np.cos(delta) + radius * np.sin(delta)
    outer, width = of("outer_cone_distance_mm"), of("face_width_mm")
    assert (along.min(), along.max()) == pytest.approx((outer - width, outer), abs=1e-9)
    above = radius * np.cos(tip) - (z + of("face_apex_mm")) * np.sin(tip)
    assert above.max() == pytest.approx(0.0, abs=1e-9)


@pytest.mark.validate
@pytest.mark.parametrize("name", ["zk-zn-30", "zk-zn-90"])
def test_a_wheel_whose_flank_narrows_to_a_cusp_is_whole_from_face_to_face(name):
    """The hob's axis crosses the wheel's symmetrically: a half turn about the middle of a tooth changes nothing."""
    drive = Drive.load(name)
    body = closed_body(drive, "wheel", 1, departure=2e-2)
    edges = _edges(body.triangles)
    there, back = (set(map(tuple, e.tolist())) for e in (edges, edges[:, ::-1]))
    assert len(there) == len(edges) and there == back
    half = 0.5 * drive.design.value("wheel_face_width_mm", "blank")
    assert (body.points[:, 2].min(), body.points[:, 2].max()) == pytest.approx((-half, half), abs=1e-9)
    tip = drive.design.value("wheel_tip_radius_mm", "blank")
    assert np.hypot(body.points[:, 0], body.points[:, 1]).max() == pytest.approx(tip, abs=1e-9)
    corners = body.points[body.triangles]
    parts = np.sum(np.cross(corners[:, 0], corners[:, 1]) * corners[:, 2], axis=1) / 6.0
    moment = (parts[:, None] * corners.sum(axis=1) / 4.0).sum(axis=0)
    assert abs(moment[2]) / body.volume < 1e-3 * half


def test_a_coarse_grid_reaches_as_far_as_a_fine_one():
    drive = Drive.load("zk-zn-30")
    coarse, fine = (drive.surface("wheel", shape).values[:, 0] for shape in ((2, 9), (41, 9)))
    assert (coarse.min(), coarse.max()) == pytest.approx((fine.min(), fine.max()), abs=0.05)


@pytest.mark.validate
def test_a_body_does_not_depend_on_which_of_its_flanks_is_in_hand():
    """Two head cutters make the flanks of a face gear; its tooth and space are equally wide at the middle."""
    one, other = (closed_body(Drive.load(f"face-worm-conical-{f}"), "wheel", 1, 2e-2) for f in ("concave", "convex"))
    assert one.volume == pytest.approx(other.volume, rel=1e-5)


@pytest.mark.validate
def test_the_root_of_an_undercut_tooth_is_where_the_tip_of_its_hob_passes():
    """The envelope of the hob's rounding goes on far above the flank that it cuts; the root is at its other end."""
    drive = Drive.load("zk-zn-60")
    tooth = solid_body(drive, "wheel", 1).tooth
    sizes = Drive(drive.design.with_whole_blank()[0]).design
    tip = sizes.value("hob_pitch_radius_mm") + sizes.value("hob_tip_addendum_mm", "blank")
    for side in tooth.sides:
        below, _, _ = side.grids(np.array([0.0]), np.array([0.0, 1.0]), np.array([0.0, 1.0]))
        root = np.hypot(below[0, 0, 0], below[0, 0, 1])
        assert sizes.value("cutting_center_distance_mm") - root == pytest.approx(tip, abs=2e-2)
