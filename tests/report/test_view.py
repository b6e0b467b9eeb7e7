"""What the 3-D view draws is the drive: flanks that touch at the contact points, mirrored with the hand."""

import base64

import numpy as np
import pytest

from meshwright import Drive
from meshwright.pattern.pattern import along_ellipse
from meshwright.report import analyse
from meshwright.report.scene import scene, tooth_data

from .conftest import DESIGNS, quiet


def unpacked(text, *shape):
    return np.frombuffer(base64.b64decode(text), dtype="<f4").astype(float).reshape(shape)


def drawn(body, patch, position):
    """Points and normals of a drawn flank in the fixed frame at a position, every copy of it: (M, 3) each."""
    matrix = unpacked(body["matrices"], -1, 3, 4)[position]
    points, normals = (unpacked(patch[key], -1, 3) for key in ("points", "normals"))
    found = [], []
    for turn in body["copies"]:
        c, s = np.cos(turn), np.sin(turn)
        turned = matrix[:, :3] @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        found[0].append(points @ turned.T + matrix[:, 3])
        found[1].append(normals @ turned.T)
    return tuple(np.concatenate(f) for f in found)


def distance(point, facets):
    """From a point to the nearest of triangles (T, 3, 3)."""
    near, side = facets - point, np.roll(facets, -1, axis=1) - facets
    normals = np.cross(side[:, 0], side[:, 1])
    along = np.clip(-np.sum(near * side, axis=2) / np.sum(side**2, axis=2), 0.0, 1.0)
    edges = np.linalg.norm(near + along[:, :, None] * side, axis=2).min(axis=1)
    over = (np.einsum("tkj,tj->tk", np.cross(near, side), normals) >= 0.0).all(axis=1)
    planes = np.abs(np.sum(near[:, 0] * normals, axis=1)) / np.linalg.norm(normals, axis=1)
    return np.where(over, planes, edges).min()


@pytest.mark.parametrize("name", DESIGNS)
@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_every_contact_lies_on_both_drawn_flanks(name, share, analysed):
    """No contact is further from either drawn flank than a small part of what the view shows."""
    view = scene(analysed(name))
    steps, last = view["steps_per_pitch"], len(view["contacts"]) - 1
    position = round(share * last)
    contact_points = [view["contacts"][at]["point"] for at in range(position % steps, last + 1, steps)]
    for body in view["bodies"]:
        points, _ = drawn(body, body["tooth"], position)
        corners = np.frombuffer(base64.b64decode(body["tooth"]["triangles"]), dtype="<u4").reshape(-1, 3)
        count = len(points) // len(body["copies"])
        facets = points[np.concatenate([corners + count * k for k in range(len(body["copies"]))])]
        for contact in np.array(contact_points):
            assert distance(contact, facets) < view["radius"] / 150


@pytest.mark.parametrize("name", ["zk-zn-90", "plain-zc"])
def test_drawn_flanks_keep_within_the_blank(name):
    """Also where the surface has a pole beyond the tip: no vertex past tip or face."""
    drive = Drive.load(name)
    data = tooth_data(drive, "wheel", drive.design.value("wheel_teeth"), 0.5)
    points = unpacked(data["points"], -1, 3)
    corners = np.frombuffer(base64.b64decode(data["triangles"]), dtype="<u4").reshape(-1, 3)
    assert len(corners) > 500 and corners.max() < len(points)
    assert np.hypot(points[:, 0], points[:, 1]).max() < drive.design.value("wheel_tip_radius_mm", "blank") + 1e-5
    assert np.abs(points[:, 2]).max() < 0.5 * drive.design.value("wheel_face_width_mm", "blank") + 1e-5


@pytest.mark.validate
def test_a_left_hand_drive_is_drawn_as_the_mirror_image(analysed):
    right = scene(analysed("recess-action-full"))
    left = scene(analyse(Drive.load("recess-action-full").with_(design={"hand": "left"}), quiet))
    flip = np.array([1.0, -1.0, 1.0])
    assert left["angles_deg"] == pytest.approx([-a for a in reversed(right["angles_deg"])])
    for ours, theirs in zip(left["contacts"], reversed(right["contacts"]), strict=True):
        assert ours["point"] == pytest.approx(theirs["point"] * flip, abs=1e-5)
    for ours, theirs in zip(left["bodies"], right["bodies"], strict=True):
        mirrored, _ = drawn(ours, ours["tooth"], 0)
        points, _ = drawn(theirs, theirs["tooth"], len(right["contacts"]) - 1)
        assert np.nanmin(mirrored, axis=0) == pytest.approx(np.nanmin(points * flip, axis=0), abs=2e-3)
        assert np.nanmax(mirrored, axis=0) == pytest.approx(np.nanmax(points * flip, axis=0), abs=2e-3)


def test_directions_along_an_ellipse_are_those_of_its_points():
    smaller, larger = 0.04, 1.3
    angle = 2 * np.pi * np.arange(24) / 24
    x, y = np.cos(angle) / np.sqrt(smaller), np.sin(angle) / np.sqrt(larger)
    assert along_ellipse(24, smaller, larger) == pytest.approx(np.arctan2(y, x) % (2 * np.pi))
