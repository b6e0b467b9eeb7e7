"""Grids over the flanks: on the surface, within the blank, normals out of the material; and the files made of them."""

import json
import struct
import xml.etree.ElementTree as xml
from importlib.resources import files

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.flank import lines
from meshwright.flank.exports import stl, vtu
from tests.flank.step_files import valid_shape
from tests.quick import ONE_OF_A_KIND, some


def grid(drive, member, shape, region="flank"):
    return drive.surface(member, shape, region)


def test_a_spherical_grid_spans_face_and_tip_of_the_blank():
    """Convex tooth: tip radius r − R + √((R+a)² − Z²) over the axial position."""
    found = grid(Drive.load("spherical-table-3-1-concave"), "pinion", (7, 9))
    x, y, z = found.points.reshape(7, 9, 3).transpose(2, 0, 1)
    assert z == pytest.approx(np.tile(np.linspace(-7.5, 7.5, 9), (7, 1)), abs=1e-9)
    tip = 72.0 - 72.0 + np.sqrt((72.0 + 4.0) ** 2 - z[-1] ** 2)
    assert np.hypot(x, y)[-1] == pytest.approx(tip, abs=1e-9)
    assert found.values.reshape(7, 9, 2)[0, :, 0] == pytest.approx(np.zeros(9), abs=1e-12)


def test_an_undercut_tooth_begins_on_its_fillet():
    """Above its undercut line, where flank and fillet end in one edge."""
    drive = Drive.load("spherical-table-2-3")
    flank, fillet = (grid(drive, "pinion", (5, 5), region) for region in ("flank", "fillet"))
    assert (drive.flank("pinion")(flank.values[:5]).regular > 0.1).all()
    ends = fillet.points.reshape(5, 5, 3)[[0, -1]]
    assert np.linalg.norm(ends - flank.points[:5], axis=2).min(axis=0) == pytest.approx(np.zeros(5), abs=1e-7)


@pytest.mark.parametrize("design", ["helical-crowned", "bevel-hypoid", "face-worm-conical-concave"])
def test_a_ray_along_a_normal_meets_the_flank_where_it_began(design):
    """From outside or inside the material; away from the flank it meets nothing that is nearer than it may be."""
    drive = Drive.load(design)
    q = np.repeat(drive.tca([0.0]).solutions[:, drive.design.description["bodies"][1]["unknowns"]], 2, axis=0)
    flank = drive.flank("wheel")
    found, away = flank(q), np.array([0.3, -0.2])
    points, near = found.points + away[:, None] * found.normals, q * (1.0 + 1e-3)
    distance, met = flank.met(points, -found.normals, near, 8.0, 1.0)
    assert distance == pytest.approx(away, abs=1e-12)
    assert met == pytest.approx(q, abs=1e-10)
    for longest, farthest in ((8.0, 0.1), (0.0, 1.0), (np.nan, 1.0), (8.0, -1.0), (8.0, np.nan)):
        assert np.isnan(flank.met(points, -found.normals, near, longest, farthest)[0]).all()
    across = np.cross(found.normals, [0.6, 0.0, 0.8])
    across /= np.linalg.norm(across, axis=1)[:, None]
    assert not (np.abs(flank.met(points, across, near, 8.0, 1.0)[0]) < 0.19).any()


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
    found = grid(Drive.load("spherical-table-3-1-concave"), "pinion", (9, 17)).mesh
    content = stl(found.points, found.triangles, "pinion flank")
    (count,) = struct.unpack("<I", content[80:84])
    assert count == len(found.triangles) and len(content) == 84 + 50 * count
    facets = np.frombuffer(content[84:], dtype=[("facet", "<f4", (4, 3)), ("attribute", "<u2")])["facet"]
    assert (facets[:, 0] @ found.normals.mean(axis=0) > 0.5).all()
    area = 0.5 * np.linalg.norm(np.cross(facets[:, 2] - facets[:, 1], facets[:, 3] - facets[:, 1]), axis=1).sum()
    assert area == pytest.approx(_area_between_face_and_tip(), rel=1e-3)


def _area_between_face_and_tip():
    """The flank's area from its own grid: lines from root to tip across the face, trapezia between them."""
    points = grid(Drive.load("spherical-table-3-1-concave"), "pinion", (41, 41)).points.reshape(41, 41, 3)
    first, second = points[1:, 1:] - points[:-1, :-1], points[1:, :-1] - points[:-1, 1:]
    return 0.5 * np.linalg.norm(np.cross(first, second), axis=2).sum()


def test_vtu_holds_points_normals_and_cells():
    found = grid(Drive.load("spherical-table-3-1-spur"), "wheel", (3, 4))
    piece = xml.fromstring(vtu(found)).find("UnstructuredGrid/Piece")
    counts = str(len(found.mesh.points)), str(len(found.mesh.triangles))
    assert (piece.get("NumberOfPoints"), piece.get("NumberOfCells")) == counts
    points = np.array(piece.find("Points/DataArray").text.split(), dtype=float).reshape(-1, 3)
    assert (points == found.mesh.points).all()
    offsets = piece.find("Cells/DataArray[@Name='offsets']").text.split()
    assert offsets == [str(3 * k) for k in range(1, len(found.mesh.triangles) + 1)]


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
    """Within half a micrometre, trimmed along tip, face and root: the faces have the area of the flank."""
    pytest.importorskip("OCP.TColgp")
    from meshwright.flank.step import step

    drive = Drive.load("spherical-table-3-1-concave")
    made = step(drive, drive.region("pinion"), (11, 11))
    assert made.content.startswith(b"ISO-10303-21;")
    assert made.deviation < 5e-4
    assert _area_of_faces(made.content) == pytest.approx(_area_between_face_and_tip(), rel=1e-4)


def test_a_flank_that_ends_in_a_cusp_is_trimmed_within_a_micrometre():
    """The face's curve stands still in space where it meets the undercut line, but not in the chart."""
    pytest.importorskip("OCP.TColgp")
    from meshwright.flank.mesh import mesh
    from meshwright.flank.step import step

    drive = Drive.load("zk-zn-30")
    made = step(drive, drive.region("wheel"), (21, 41))
    assert made.deviation < 1e-3
    fine = mesh(drive.region("wheel"), (96, 96))
    a, b, c = (fine.points[fine.triangles[:, k]] for k in range(3))
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
    assert _area_of_faces(made.content) == pytest.approx(area, rel=2e-4)


def _area_of_faces(content):
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    properties = GProp_GProps()
    BRepGProp.SurfaceProperties_s(valid_shape(content), properties, 1e-6)
    return properties.Mass()


PACKAGED = sorted(path.name[:-5] for path in (files("meshwright") / "designs").iterdir())
SOME = ("plain-za", "zk-zn-90", "face-worm-conical-convex", "spherical-table-2-3")


def _outside(drive, member, region):
    """How far the exported points of a region lie outside the blank at most, mm: radii, face and throat."""
    found = drive.surface(member, (9, 17), region)
    known = np.isfinite(found.points).all(axis=1)
    points = np.concatenate([found.points[known], found.mesh.points])
    radius, z = np.hypot(points[:, 0], points[:, 1]), points[:, 2]
    beyond = [np.full(1, -np.inf)]
    for key, value in drive.design.tables.get("blank", {}).items():
        match (member, key):
            case ("wheel", "wheel_tip_radius_mm") | ("pinion", "worm_tip_radius_mm") if value:
                beyond.append(radius - value)
            case ("pinion", "worm_root_radius_mm") if value:
                beyond.append(value - radius)
            case ("wheel", "wheel_face_width_mm") if value:
                beyond.append(np.abs(z) - value / 2)
            case ("wheel", "wheel_throat_radius_mm") if value:
                distance = drive.design.value("center_distance_mm")
                beyond.append(distance - value - np.hypot(distance - radius, z))
    if drive.design.family == "spherical":
        beyond.append(np.abs(z) - drive.design.value("face_width_mm") / 2)
    if drive.design.family == "face-worm" and member == "wheel":
        inner, outer = (drive.design.value(f"gear_{end}_radius_mm") for end in ("inner", "outer"))
        beyond += [radius - outer, inner - radius]
    return max(float(b.max()) for b in beyond)


@pytest.mark.parametrize("name", SOME)
def test_no_exported_point_lies_outside_the_blank(name):
    drive = Drive.load(name)
    for body in drive.design.description["bodies"]:
        assert _outside(drive, body["name"], "flank") < 1e-6


@pytest.mark.validate
@pytest.mark.parametrize("name", some(PACKAGED, *ONE_OF_A_KIND))
def test_no_exported_point_of_any_packaged_design_lies_outside_its_blank_or_limits(name):
    """Beside the radii of the blank, every limit function of the surface itself."""
    drive = Drive.load(name)
    for body in drive.design.description["bodies"]:
        assert _outside(drive, body["name"], "flank") < 1e-6
        region, mesh = drive.region(body["name"]), drive.surface(body["name"], (9, 17)).mesh
        assert region.limits.least(region.flank(mesh.parameters)).min() > -1e-6


def test_two_limits_meet_in_a_corner_of_the_mesh():
    """Tip cylinder, throat torus and face of a wheel: at each corner of its flank two of them hold to rounding."""
    drive = Drive.load("plain-za")
    region, mesh = drive.region("wheel"), drive.surface("wheel", (9, 17)).mesh
    values = np.abs(region.limits.values(region.flank(mesh.parameters)))
    corners = (values < 1e-9).sum(axis=1) == 2
    assert corners.sum() >= 5
    names = {frozenset(region.limits.names[k] for k in np.flatnonzero(row < 1e-9)) for row in values[corners]}
    assert {frozenset({"throat", "tip"}), frozenset({"tip", "face"})} <= names


def test_a_face_that_contact_never_reaches_is_found_all_the_same():
    """The wheel is 1 mm wide and misalignment moves the contact some millimetres past it."""
    drive = Drive.load("plain-za").with_(blank={"wheel_face_width_mm": 1.0}, misalignment={"vertical_deg": 0.1})
    points = drive.surface("wheel", (5, 5)).mesh.points
    assert np.abs(points[:, 2]).max() == pytest.approx(0.5, abs=1e-9)


def test_an_empty_region_says_so(capsys):
    assert main(["surface", "plain-za", "--member", "wheel", "--set", "blank.wheel_tip_radius_mm=60"]) == 2
    assert "empty" in capsys.readouterr().err


@pytest.mark.parametrize("at_once", [1, 700, 10**9])
def test_the_nearest_places_are_the_same_in_blocks_of_any_size(monkeypatch, at_once):
    generator = np.random.default_rng(9)
    known, places = generator.uniform(size=(300, 2)), generator.uniform(size=(157, 2))
    monkeypatch.setattr(lines, "DISTANCES_AT_ONCE", at_once)
    apart = np.linalg.norm((places[:, None] - known) / np.ptp(known, axis=0), axis=2)
    assert np.array_equal(lines._nearest(known, places), np.argmin(apart, axis=1))
    assert len(lines._nearest(known, places[:0])) == 0
