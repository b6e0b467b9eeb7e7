"""Gear teeth and semi-analytic contact of the face worm drive."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.fe.body import PlacedTooth, mesh_body
from meshwright.fe.compliance import tooth_compliance
from meshwright.fe.face_worm import gear_form, worm_form
from meshwright.fe.grading import MeshDensity
from meshwright.fe.loaded import loaded_contact
from meshwright.fe.model import Load
from meshwright.fe.solids import gear_pair

DENSITY = MeshDensity(coarse_rows=(4, 8, 12), coarse_fillet_rows=6)


@pytest.mark.parametrize("name", ["face-worm-conical-convex", "face-worm-cylindrical-concave"])
def test_gear_teeth(name):
    """Valid elements; fillet and flank nodes on the head-cutter's surfaces, found by their distance to its axis."""
    drive = Drive.load(name)
    form = gear_form(drive, 6.0)
    body = mesh_body(form, [PlacedTooth(np.eye(4), None), PlacedTooth(form.next_tooth, None)], DENSITY)
    assert body.mesh.smallest_jacobian() > 0.2
    own = "left" if drive.design.flank > 0 else "right"
    points = body.mesh.nodes[body.nodes(0, f"flank_{own}")]
    assert cone_miss(drive, points) < 1e-9
    radii = np.hypot(*body.mesh.nodes[:, :2].T)
    assert radii.min() == pytest.approx(drive.design.value("gear_inner_radius_mm"), abs=0.2)
    assert radii.max() == pytest.approx(drive.design.value("gear_outer_radius_mm"), abs=0.2)


def cone_miss(drive, points):
    """Largest distance of points from the cone through three parallel circles of the flank."""
    flank = drive.flank("wheel")
    angles = np.linspace(-0.5, 0.5, 7)
    rings = [flank(np.stack([np.full(7, u), angles], axis=1)).points for u in (-1.0, 1.0)]
    edges = rings[1] - rings[0]
    apex = np.linalg.lstsq(
        np.concatenate([np.eye(3) - np.outer(e, e) / (e @ e) for e in edges]),
        np.concatenate([p - e * (e @ p) / (e @ e) for e, p in zip(edges, rings[0], strict=True)]),
        rcond=None,
    )[0]
    directions = edges / np.linalg.norm(edges, axis=1, keepdims=True)
    axis = np.linalg.lstsq(directions, np.ones(7), rcond=None)[0]
    cosine = 1.0 / np.linalg.norm(axis)
    axis = axis * cosine
    from_apex = points - apex
    along = np.abs(from_apex @ axis)
    across = np.linalg.norm(from_apex - np.outer(from_apex @ axis, axis), axis=1)
    return np.abs(across * cosine - along * np.sqrt(1.0 - cosine**2)).max()


def test_worm_points_satisfy_their_meshing_equation():
    drive = Drive.load("face-worm-conical-convex")
    curves = worm_form(drive).left.flank
    axial = np.array([-5.0, 0.0, 5.0])
    points = curves.points(axial, np.zeros((3, 1)))[:, 0]
    assert points[:, 2] == pytest.approx(axial, abs=1e-9)
    contact = drive.tca([0.0])
    along = contact.unknowns["u_worm"], contact.unknowns["psi_worm"]
    assert curves.surface(*along)[0][0] == pytest.approx(contact.body_points["pinion"][0], abs=1e-9)


@pytest.mark.parametrize(
    "name", ["face-worm-conical-convex", "face-worm-conical-concave", "face-worm-cylindrical-convex"]
)
def test_pairs_share_the_load(name):
    """50 N m on the gear, five pairs modelled, at the beginning of a pitch: three share, as the report says."""
    gear = gear_pair(Drive.load(name))
    load = Load(50e3, "wheel")
    found = loaded_contact(gear, 0.0, 5, load, {"wheel": tooth_compliance(gear.wheel)})
    carrying = [pair for pair in found.pairs if pair.force > 0.0]
    assert len(carrying) == 3
    for pair in carrying:
        assert pair.peak_pressure == pytest.approx(pair.hertz.peak_pressure, rel=0.01)
    arms = [abs(np.cross(p.contact.touch.point, p.contact.touch.normal)[2]) for p in carrying]
    assert sum(a * p.force for a, p in zip(arms, carrying, strict=True)) == pytest.approx(load.torque, rel=2e-3)


def test_no_solid_worm(capsys):
    assert main(["fe", "face-worm-conical-convex", "--torque-nm", "50"]) == 2
    assert "no solid pinion" in capsys.readouterr().err
