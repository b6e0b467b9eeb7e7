"""Grids over the flanks: on the surface, within the blank, normals out of the material; and the files made of them."""

import json
import struct
import xml.etree.ElementTree as xml

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.flank.exports import quadrilaterals, stl, vtu
from meshwright.flank.grids import grid


def test_a_spherical_grid_spans_face_and_tip_of_the_blank():
    """Convex tooth: tip radius r − R + √((R+a)² − Z²) over the axial position."""
    found = grid(Drive.load("spherical-table-3-1-concave"), "pinion", (7, 9))
    x, y, z = found.points.reshape(7, 9, 3).transpose(2, 0, 1)
    assert z == pytest.approx(np.tile(np.linspace(-7.5, 7.5, 9), (7, 1)), abs=1e-9)
    tip = 72.0 - 72.0 + np.sqrt((72.0 + 4.0) ** 2 - z[-1] ** 2)
    assert np.hypot(x, y)[-1] == pytest.approx(tip, abs=1e-9)
    assert found.values.reshape(7, 9, 2)[0, :, 0] == pytest.approx(np.zeros(9), abs=1e-12)


def test_an_undercut_tooth_begins_at_the_undercut_line():
    found = grid(Drive.load("spherical-table-2-3"), "pinion", (5, 5))
    lowest = found.values.reshape(5, 5, 2)[0, :, 0]
    drive = Drive.load("spherical-table-2-3")
    assert drive.flank("pinion")(found.values[:5]).regular == pytest.approx(np.zeros(5), abs=1e-9)
    assert (lowest > 1.0).all()


def test_the_wheel_of_a_worm_drive_keeps_within_its_blank():
    drive = Drive.load("recess-action-full").with_(blank={"wheel_face_width_mm": 12.0})
    found = grid(drive, "wheel", (6, 7))
    assert np.hypot(found.points[:, 0], found.points[:, 1]).max() == pytest.approx(277.380139841, abs=1e-9)
    assert np.abs(found.points[:, 2]).max() == pytest.approx(6.0, abs=1e-9)
    blade_end = np.pi * 2.0 / (4.0 * np.sin(np.radians(10.0))) + 4.0 / np.cos(np.radians(10.0))
    assert found.values[:, 0].max() == pytest.approx(blade_end, abs=1e-9)


def test_flank_and_fillet_of_the_face_gear_join_along_one_line():
    drive = Drive.load("face-worm-conical-convex")
    flank, fillet = (grid(drive, "wheel", (4, 9), region) for region in ("flank", "fillet"))
    assert fillet.points.reshape(4, 9, 3)[-1] == pytest.approx(flank.points.reshape(4, 9, 3)[0], abs=1e-8)
    assert fillet.normals.reshape(4, 9, 3)[-1] == pytest.approx(flank.normals.reshape(4, 9, 3)[0], abs=1e-8)
    radii = np.hypot(flank.points[:, 0], flank.points[:, 1])
    assert (radii.min(), radii.max()) == pytest.approx((38.53, 52.5), abs=1e-9)


@pytest.mark.parametrize(
    ("design", "member"),
    [("recess-action-full", "pinion"), ("face-worm-conical-convex", "pinion"), ("spherical-table-3-1-convex", "wheel")],
)
def test_normals_stand_on_the_surface(design, member):
    """Differences of neighbouring points are tangent to the flank, to the square of their distance."""
    found = grid(Drive.load(design), member, (41, 161))
    points, normals = (a.reshape(41, 161, 3) for a in (found.points, found.normals))
    assert np.linalg.norm(normals, axis=2) == pytest.approx(np.ones((41, 161)), abs=1e-12)
    for near, far, normal in (
        (points[:-2], points[2:], normals[1:-1]),
        (points[:, :-2], points[:, 2:], normals[:, 1:-1]),
    ):
        across = far - near
        slope = np.einsum("ijk,ijk->ij", across, normal) / np.linalg.norm(across, axis=2)
        assert np.abs(slope).max() < 2e-3


def test_the_flank_that_drives_faces_the_other_member():
    """The thread lies above the groove flank on the +z side: its outward normal points to −z, the other's to +z."""
    drive = Drive.load("recess-action-full")
    right, left = (grid(drive.with_(flank=f), "pinion", (3, 5)).normals[:, 2] for f in ("right", "left"))
    assert (right < 0.0).all() and (left > 0.0).all()


def test_the_other_hand_is_the_mirror_image():
    right = grid(Drive.load("recess-action-full"), "pinion", (4, 6))
    left = grid(Drive.load("recess-action-full").with_(design={"hand": "left"}), "pinion", (4, 6))
    order = left.points.reshape(4, 6, 3) * [1, -1, 1]
    assert order == pytest.approx(right.points.reshape(4, 6, 3), abs=1e-7)
    assert left.values[:, 1] == pytest.approx(-right.values[:, 1], abs=1e-7)


def test_triangles_face_out_of_the_material_and_have_the_area_of_the_flank():
    found = grid(Drive.load("spherical-table-3-1-concave"), "pinion", (9, 17))
    content = stl(found)
    (count,) = struct.unpack("<I", content[80:84])
    assert count == 2 * 8 * 16 and len(content) == 84 + 50 * count
    facets = np.frombuffer(content[84:], dtype=[("facet", "<f4", (4, 3)), ("attribute", "<u2")])["facet"]
    assert (facets[:, 0] @ found.normals.mean(axis=0) > 0.5).all()
    area = 0.5 * np.linalg.norm(np.cross(facets[:, 2] - facets[:, 1], facets[:, 3] - facets[:, 1]), axis=1).sum()
    corners = found.points[quadrilaterals(found)]
    twice = np.linalg.norm(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]), axis=1).sum()
    assert area == pytest.approx(twice / 2, rel=1e-3)


def test_vtu_holds_points_normals_and_cells():
    found = grid(Drive.load("spherical-table-3-1-spur"), "wheel", (3, 4))
    piece = xml.fromstring(vtu(found)).find("UnstructuredGrid/Piece")
    assert (piece.get("NumberOfPoints"), piece.get("NumberOfCells")) == ("12", "6")
    points = np.array(piece.find("Points/DataArray").text.split(), dtype=float).reshape(-1, 3)
    assert (points == found.points).all()
    offsets = piece.find("Cells/DataArray[@Name='offsets']").text.split()
    assert offsets == [str(4 * k) for k in range(1, 7)]


def test_the_command_writes_the_contract(tmp_path, capsys):
    assert main(["surface", "recess-action-full", "--member", "wheel", "--grid", "3x5", "--json", "-"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["schema"] == "meshwright.surface/1"
    assert (document["member"], document["region"], document["shape"]) == ("wheel", "flank", [3, 5])
    points = Drive.load("recess-action-full").flank("wheel")(document["parameter_values"])
    assert points.points == pytest.approx(np.array(document["points_mm"]), abs=1e-12)
    files = ["--vtu", str(tmp_path / "a.vtu"), "--stl", str(tmp_path / "a.stl")]
    assert main(["surface", "recess-action-full", "--member", "pinion", *files]) == 0
    assert capsys.readouterr().out == ""
    assert {p.name for p in tmp_path.iterdir()} == {"a.vtu", "a.stl"}


@pytest.mark.parametrize(
    "arguments",
    [["--grid", "3"], ["--grid", "1x5"], ["--region", "fillet"]],
    ids=["one number", "one row", "no fillet"],
)
def test_what_cannot_be_spanned_is_an_error(arguments, capsys):
    assert main(["surface", "recess-action-full", "--member", "wheel", *arguments]) == 2
    assert capsys.readouterr().err


def test_step_passes_through_the_flank_and_says_how_far_it_departs():
    pytest.importorskip("OCP.TColgp")
    from meshwright.flank.step import step

    coarse, fine = (step(Drive.load("spherical-table-3-1-concave"), "pinion", n) for n in ((6, 6), (11, 11)))
    assert coarse.content.startswith(b"ISO-10303-21;")
    assert fine.deviation < coarse.deviation < 1e-3
