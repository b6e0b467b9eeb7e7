"""Rigid teeth do not penetrate: dense grids of the wheel flank against the pinion flank, without tangency equations."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.contact.placement import inverse, placements_at
from meshwright.cycle.edge_contact import edge_paths
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.transmission import envelopes
from tests.independent import gap_search
from tests.quick import quick

PENETRATION_MM = 1e-7
#: Errors of assembly of a worm, and designs of other families with some.
MISALIGNED = {"center_distance_mm": -0.1, "vertical_deg": 0.05}
DISPLACED = (
    ("face-worm-conical-convex", {"offset_mm": 0.05, "shaft_angle_deg": 0.02}),
    ("face-worm-conical-concave", {"offset_mm": 0.1}),
    ("spherical-table-3-1-concave", {"vertical_deg": 0.3}),
    ("spherical-table-3-1-convex", {"center_distance_mm": 0.1}),
)


def _transmitted(mesh, angle):
    found = envelopes(mesh, [angle], edge_paths(mesh))
    return (found.upper if mesh.sense > 0 else found.lower)[0]


@pytest.mark.parametrize(
    ("flank", "errors"),
    quick([("right", {}), ("right", MISALIGNED), ("left", {})], ("right", MISALIGNED)),
)
def test_no_point_of_the_wheel_enters_the_worm(flank, errors):
    """Each wheel point has a wheel angle at which it lies on the worm flank: none passes the envelope."""
    drive = Drive.load("recess-action-full").with_(flank=flank, misalignment=errors)
    mesh = Mesh.of(drive)
    solved, s = drive.design.as_solved(), 1 if flank == "right" else -1
    tip, lever = solved["blank"]["wheel_tip_radius_mm"], 273.0
    t = np.linspace(4.0, np.pi / (2 * np.sin(np.radians(10))) + 4 / np.cos(np.radians(10)), 301)
    psi = np.linspace(-0.3, 0.3, 601)
    on_blank = _radius(solved, flank, t, psi) <= tip
    for angle in np.radians([500.0, 620.0]):
        allowed, highest = s * _transmitted(mesh, angle), -np.inf
        for number in mesh.numbers(angle):
            height, _ = gap_search.gap(solved, flank, angle - number * mesh.drive.pitch())
            highest = max(highest, np.nanmax(np.where(on_blank, height(t, psi), np.nan)))
        assert highest <= allowed + PENETRATION_MM / lever
        assert highest >= allowed - 1e-5 / lever  # and it touches, to the spacing of the grid


def _radius(solved, flank, t, psi):
    """Wheel radius of the grid's points, by the search's own flank."""
    d = {k: np.radians(v) if k.endswith("_deg") else v for k, v in solved["design"].items() if isinstance(v, float)}
    groove = np.pi * d["normal_module_mm"] / 2 - 2 * d["pitch_line_shift_mm"] * np.tan(d["pressure_angle_deg"])
    s = 1 if flank == "right" else -1
    hob = gap_search.blade(d["hob_pitch_radius_mm"], d["hob_lead_angle_deg"], d["pressure_angle_deg"], groove, s)
    ratio = d["hob_threads"] / d["wheel_teeth"]
    (x, y, _), _ = gap_search.wheel_flank(hob, t[:, None], psi[None, :], d, ratio)
    return np.hypot(x, y)


def _distances(drive, angle, unknowns, points):
    """Signed distances (N,) of wheel points, wheel frame, from the pinion flank; NaN where the foot point is off it."""
    placed = placements_at(drive, np.array([angle]), unknowns[None, :]).matrices
    to_pinion = inverse(placed["pinion"][0]) @ placed["wheel"][0]
    points = points @ to_pinion[:3, :3].T + to_pinion[:3, 3]
    flank, body = drive.flank("pinion"), drive.design.description["bodies"][0]
    q = np.tile(unknowns[body["unknowns"]], (len(points), 1))
    for _ in range(25):
        found = flank(q)
        normal = found.normals
        off = points - found.points
        across = off - normal * np.sum(off * normal, axis=1, keepdims=True)
        matrix = np.concatenate([np.swapaxes(found.tangents, 1, 2), found.conditions[:, :, 1:]], axis=1)
        residual = np.concatenate([across, -found.conditions[:, :, 0]], axis=1)
        step = np.einsum("nij,nj->ni", np.linalg.pinv(matrix), residual)
        q = q + np.clip(step, -0.5, 0.5)
    found = flank(q)
    normal, off = found.normals, points - found.points
    distance = np.sum(off * normal, axis=1)
    foot = np.linalg.norm(off - normal * distance[:, None], axis=1) < 1e-9
    for values in (found.regular, *found.margins.values()):
        foot &= ~(values < -1e-9)
    return np.where(foot, distance, np.nan)


@pytest.mark.parametrize(
    ("design", "errors"),
    quick(DISPLACED, *DISPLACED[2:]),
)
def test_no_point_of_the_wheel_enters_the_pinion(design, errors):
    """Foot points on the pinion flank by least squares; each pair at its own angle, the wheel where the drive is."""
    drive = Drive.load(design).with_(misalignment=errors)
    mesh = Mesh.of(drive)
    wheel = drive.surface("wheel", (41, 61)).points
    closest = np.inf
    for angle in mesh.window.begin.angle + mesh.drive.pitch() * np.array([0.1, 0.6]):
        transmitted = _transmitted(mesh, angle)
        for number in mesh.numbers(angle):
            own = angle - number * drive.pitch()
            unknowns = mesh.window.path.solve([own])[0]
            unknowns[mesh.window.path.error_index] = transmitted
            distance = _distances(drive, own, unknowns, wheel)
            assert np.isfinite(distance).any()
            closest = min(closest, np.nanmin(distance))
    assert -PENETRATION_MM < closest < 2e-3
