"""Every packaged design, both members: what is exported keeps to the blank, is within 1 µm of the flank and closed.

A solid's triangles and its B-spline faces are made from different points; their volumes agree. Three teeth stand for
all of them, since they are copies.

All of them are hours for a processor (``make validate SIZE=full``); otherwise one design a family, drawn by lot, and
those that were once refused or written beyond 1 µm.
"""

import random
import struct

import numpy as np
import pytest

from meshwright import Drive
from meshwright.design.design import packaged_names, read
from meshwright.fe.closed_body import solid_body
from meshwright.flank import exports
from meshwright.flank.step import Spline, step
from tests.flank.step_files import valid_shape
from tests.quick import full

MICROMETRE = 1e-3
TEETH = 3

SEED = 17

ONCE_WRONG = [
    ("plain-zc", "wheel"), ("zk-zn-45", "wheel"), ("zk-zn-60", "wheel"), ("face-worm-conical-concave", "wheel"),
    ("face-worm-cylindrical-concave", "wheel"), ("bevel-crowned-profile", "pinion"),
]  # fmt: skip


def _chosen():
    """Designs and members: all in full size, otherwise a sample of which every family has its share."""
    every = [(name, member) for name in packaged_names() for member in ("pinion", "wheel")]
    if full():
        return every
    families = {}
    for name in packaged_names():
        families.setdefault(read(name)["drive"], []).append(name)
    lot = random.Random(SEED)
    drawn = {lot.choice(names) for _, names in sorted(families.items())}
    return [case for case in every if case[0] in drawn or case in ONCE_WRONG]


CHOSEN = _chosen()


def _beyond(drive, member, points):
    """How far points (N, 3) of a member lie outside its blank at most, mm, by the keys of its design."""
    radius, z = np.hypot(points[:, 0], points[:, 1]), points[:, 2]
    beyond = [np.full(1, -np.inf)]

    def given(key, table):
        value = drive.design.tables.get(table, {}).get(key)
        return value if isinstance(value, (int, float)) else None

    def outside(values, limit):
        if limit is not None:
            beyond.append(values - limit)

    match drive.design.family:
        case "cylindrical-worm" if member == "pinion":
            outside(radius, given("worm_tip_radius_mm", "blank"))
        case "cylindrical-worm":
            outside(radius, given("wheel_tip_radius_mm", "blank"))
            if (width := given("wheel_face_width_mm", "blank")) is not None:
                outside(np.abs(z), width / 2)
            if (throat := given("wheel_throat_radius_mm", "blank")) is not None:
                distance = drive.design.value("center_distance_mm")
                outside(distance - np.hypot(distance - radius, z), throat)
        case "spherical" | "cylindrical-gears":
            outside(np.abs(z), drive.design.value("face_width_mm") / 2)
            outside(radius, given(f"{member}_tip_radius_mm", "blank"))
        case "face-worm" if member == "wheel":
            outside(radius, drive.design.value("gear_outer_radius_mm"))
            outside(-radius, -drive.design.value("gear_inner_radius_mm"))
        case "bevel":
            table = "pinion" if member == "pinion" else "gear"
            size = {key: drive.design.value(key, table) for key in (
                "pitch_angle_deg", "pitch_apex_mm", "face_angle_deg", "face_apex_mm", "outer_cone_distance_mm",
                "face_width_mm",
            )}  # fmt: skip
            delta, tip = size["pitch_angle_deg"], size["face_angle_deg"]
            along = (z + size["pitch_apex_mm"]) * np.cos(delta) + radius * np.sin(delta)
            outside(along, size["outer_cone_distance_mm"])
            outside(-along, size["face_width_mm"] - size["outer_cone_distance_mm"])
            outside(radius * np.cos(tip) - (z + size["face_apex_mm"]) * np.sin(tip), 0.0)
    return max(float(b.max()) for b in beyond)


def _volume(shape):
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties)
    return properties.Mass()


def _of_stl(content):
    """Volume of a binary STL, which has to be watertight as it is written, in single precision."""
    (count,) = struct.unpack("<I", content[80:84])
    rows = np.frombuffer(content[84:], dtype=[("facet", "<f4", (4, 3)), ("attribute", "<u2")])
    assert len(rows) == count
    corners = rows["facet"][:, 1:]
    _, number = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    triangles = number.reshape(-1, 3)
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges = edges[edges[:, 0] != edges[:, 1]]
    ends = int(number.max()) + 1
    there, back = (np.sort(a * ends + b) for a, b in (edges.T, edges[:, ::-1].T))
    assert np.array_equal(there, back)
    a, b, c = np.swapaxes(corners.astype(float), 0, 1)
    return float(np.sum(np.cross(a, b) * c) / 6.0)


@pytest.mark.validate
@pytest.mark.parametrize("region", ["flank", "fillet"])
@pytest.mark.parametrize(("name", "member"), CHOSEN)
def test_a_step_file_is_within_a_micrometre_of_its_surface_and_valid(name, member, region):
    pytest.importorskip("OCP.TColgp")
    whole, _ = Drive.load(name).design.with_whole_blank()
    drive = Drive(whole)
    if region != "flank" and all((r["name"], r["region"]) != (member, region) for r in whole.description["regions"]):
        return
    made = step(drive, drive.region(member, region), (11, 21))
    assert made.deviation <= MICROMETRE
    valid_shape(made.content)
    points = drive.surface(member, (11, 21), region)
    points = np.concatenate([points.points[np.isfinite(points.points).all(axis=1)], points.mesh.points])
    assert _beyond(drive, member, points) < 1e-6


@pytest.mark.validate
@pytest.mark.parametrize(("name", "member"), CHOSEN)
def test_a_solid_is_closed_whole_and_inside_its_blank(name, member):
    pytest.importorskip("OCP.TColgp")
    from meshwright.flank.solid_step import solid_step

    drive = Drive.load(name)
    body = solid_body(drive, member)
    if body.whole > TEETH:
        body = solid_body(drive, member, TEETH)
    patches, departure = body.splined(MICROMETRE)
    assert departure <= MICROMETRE
    content, volume = solid_step(patches, name)
    assert _volume(valid_shape(content)) == pytest.approx(volume, rel=1e-6)
    between = np.linspace(0.0, 1.0, 23)
    for patch in patches:
        if patch.kind in ("flank", "fillet", "step", "tip", "end"):
            exported = Spline.through(patch.points).sampled(between, between).reshape(-1, 3)
            assert _beyond(drive, member, exported) < 1e-6, patch.kind
    faceted = body.faceted(4 * MICROMETRE)
    assert faceted.departure <= 4 * MICROMETRE
    assert _of_stl(exports.stl(faceted.points, faceted.triangles, name)) == pytest.approx(volume, rel=2e-3)
    assert _beyond(drive, member, faceted.points) < 1e-6
