"""Contact goes on with the edge of a flank: closed form of the planar pair, and what any edge contact must obey."""

import math

import numpy as np
import pytest

from meshwright import Drive
from meshwright.contact.placement import placements_at
from meshwright.contact.results import ARCSEC
from meshwright.cycle.edge_contact import edge_paths
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.transmission import envelopes, transmission_error


def _involute(angle):
    return math.tan(angle) - angle


def _tip_corner_error(design, phi_1):
    """Transmission error of plane gears (left flank) when the wheel's tip corner touches the pinion's involute.

    The pinion's flank point at radius ρ has the polar angle φ1 − (inv α_ρ − inv α), the wheel's corner
    π − φ2 − (inv α_a − inv α) about the wheel's centre.
    """
    alpha = math.radians(design["pressure_angle_deg"])
    base = [design[f"{m}_base_radius_mm"] for m in ("pinion", "wheel")]
    tip, distance = design["wheel_tip_radius_mm"], design["center_distance_mm"]
    corner = _involute(math.acos(base[1] / tip)) - _involute(alpha)

    def miss(phi_2):
        angle = math.pi - phi_2 - corner
        x, y = distance + tip * math.cos(angle), tip * math.sin(angle)
        flank = phi_1 - (_involute(math.acos(base[0] / math.hypot(x, y))) - _involute(alpha))
        return math.atan2(y, x) - flank

    low, high = phi_1 * design["ratio"] - 1e-2, phi_1 * design["ratio"] + 1e-2
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if miss(low) * miss(middle) > 0.0 else (low, middle)
    return 0.5 * (low + high) - phi_1 * design["ratio"]


def test_the_tip_corner_of_a_plane_gear_follows_the_mating_involute():
    """At mid face the convex–spur pair is the plane involute pair; the edge along the tooth touches at mid face."""
    drive = Drive.load("spherical-table-3-1-spur")
    lower, _ = edge_paths(Mesh.of(drive))
    assert (lower.limit.member, lower.limit.reason) == ("wheel", "tip")
    angles = lower.angles[0] - np.radians([0.1, 0.7, 1.5])
    errors = lower.errors(angles)
    expected = [_tip_corner_error(drive.design.as_solved()["design"], a) for a in angles]
    assert errors == pytest.approx(expected, abs=1e-12)
    assert (errors / ARCSEC < -1e-2).all()


DRIVES = [
    ("recess-action-full", {"center_distance_mm": -0.1}),
    ("face-worm-conical-convex", {}),
    ("face-worm-conical-concave", {}),
    ("spherical-table-3-1-concave", {"vertical_deg": 0.2, "horizontal_deg": 0.1}),
]


@pytest.mark.parametrize(("design", "errors"), DRIVES)
def test_an_edge_lags_behind_the_flank_it_ends_and_leaves_it_smoothly(design, errors):
    """Taking away the flank beyond its edge lets the wheel fall back, by the square of the angle at first."""
    mesh = Mesh.of(Drive.load(design).with_(misalignment=errors))
    for edge, sign in zip(edge_paths(mesh), (-1.0, 1.0), strict=True):
        if edge is None:
            continue
        step = 1e-2 * mesh.drive.pitch() * sign
        near = edge.angles[0] + step * np.array([0.0, 1.0, 2.0])
        lag = mesh.sense * (mesh.window.path.errors(near) - edge.errors(near))
        assert abs(lag[0]) < 1e-14
        assert lag[2] / lag[1] == pytest.approx(4.0, rel=0.1)


def test_the_edge_stays_on_its_circle_and_its_normal_condition_holds():
    """On the face gear the edge is the section of the flank with a cylinder: its tangent is normal to both."""
    drive = Drive.load("face-worm-conical-convex")
    mesh = Mesh.of(drive)
    for edge, radius in zip(edge_paths(mesh), (52.5, 38.53), strict=True):
        found = drive.flank("wheel")(edge.unknowns[:, drive.design.description["bodies"][1]["unknowns"]])
        radial = found.points * [1.0, 1.0, 0.0]
        assert np.linalg.norm(radial, axis=1) == pytest.approx(np.full(len(radial), radius), abs=1e-8)
        edge_tangent = np.cross(radial, found.normals)
        worm_normal = mesh.window.path.observe(edge.angles, edge.unknowns)[:, 3:6]
        placed = placements_at(drive, edge.angles, edge.unknowns).matrices["wheel"][:, :3, :3]
        along = np.einsum("nij,nj->ni", placed, edge_tangent)
        cosine = np.einsum("ni,ni->n", along, worm_normal) / np.linalg.norm(along, axis=1)
        assert np.abs(cosine).max() < 1e-9


def test_the_envelope_with_edges_has_no_jumps_while_flanks_alone_hand_over_with_one():
    """A pair misaligned past its vertex drives until its edge lets go: with the edge the error is continuous."""
    mesh = Mesh.of(Drive.load("face-worm-conical-concave").with_(misalignment={"offset_mm": 0.1}))
    assert transmission_error(mesh).rides_on_edge
    angles = np.linspace(0.0, mesh.drive.pitch(), 721)
    flanks, rigid = envelopes(mesh, angles), envelopes(mesh, angles, edge_paths(mesh))
    steps = [np.abs(np.diff(found.lower)).max() for found in (flanks, rigid)]
    assert steps[1] < 0.2 * steps[0]
    assert (rigid.lower <= flanks.lower + 1e-15).all()
    assert rigid.edge_contact.any() and not flanks.edge_contact.any()
