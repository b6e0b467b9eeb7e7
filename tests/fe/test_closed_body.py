"""Closed bodies: watertight, whole, with the volume of what they are."""

import struct

import numpy as np
import pytest

from meshwright import Drive, UsageError
from meshwright.cli import main
from meshwright.fe.closed_body import closed_body, volume


def _edges(triangles):
    return np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])


def test_the_volume_of_a_cube():
    points = np.array([[x, y, z] for x in (0.0, 2.0) for y in (0.0, 2.0) for z in (0.0, 2.0)])
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    triangles = np.array([[q[0], *pair] for q in quads for pair in (q[1:3], q[2:4])])
    assert volume(points, triangles) == pytest.approx(8.0)


@pytest.mark.parametrize(
    ("name", "member", "teeth"),
    [("helical-crowned", "wheel", 2), ("spherical-table-4-4-concave", "pinion", 1)],
)
def test_a_body_is_closed_and_its_flanks_are_near(name, member, teeth):
    body = closed_body(Drive.load(name), member, teeth)
    edges = _edges(body.triangles)
    there, back = (set(map(tuple, e.tolist())) for e in (edges, edges[:, ::-1]))
    assert len(there) == len(edges) and there == back
    assert body.volume > 0.0 and body.departure <= 1e-3


def test_a_further_tooth_always_adds_the_same_volume():
    drive = Drive.load("helical-crowned")
    one, two, three = (closed_body(drive, "wheel", n).volume for n in (1, 2, 3))
    assert three - two == pytest.approx(two - one, rel=1e-9)


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
    right = closed_body(drive, "wheel", 1)
    left = closed_body(drive.with_(design={"hand": "left"}), "wheel", 1)
    assert left.volume == pytest.approx(right.volume, rel=1e-9)


def test_the_command_writes_a_watertight_stl(tmp_path, capsys):
    path = tmp_path / "wheel.stl"
    assert main(["surface", "helical-crowned", "--member", "wheel", "--solid", "--teeth", "2", "--stl", str(path)]) == 0
    (count,) = struct.unpack("<I", path.read_bytes()[80:84])
    assert f"{count} facets" in capsys.readouterr().err


def test_what_has_no_closed_body_says_why(capsys):
    with pytest.raises(UsageError, match="goes on as a thread"):
        closed_body(Drive.load("plain-za"), "pinion")
    assert main(["surface", "helical-crowned", "--member", "wheel", "--solid", "--teeth", "999", "--stl", "-"]) == 2
    assert main(["surface", "helical-crowned", "--member", "wheel", "--solid"]) == 2
    assert "choose from 1 to" in capsys.readouterr().err
