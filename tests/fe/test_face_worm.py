"""Gear teeth, worm thread and semi-analytic contact of the face worm drive."""

import numpy as np
import pytest
from on_flank import distance_from_flank, turn_onto_flank

from meshwright import Drive
from meshwright.fe.body import PlacedTooth, mesh_body, placed_tooth, tooth_order
from meshwright.fe.compliance import tooth_compliance
from meshwright.fe.generated import about_z
from meshwright.fe.grading import MeshDensity
from meshwright.fe.hexahedra import FACES
from meshwright.fe.loaded import loaded_contact
from meshwright.fe.model import Load, build_model
from meshwright.fe.pictures import view
from meshwright.fe.solids import gear_pair, teeth_of

FLANKS = {"convex": ("convex", "concave"), "concave": ("concave", "convex")}
DENSITY = MeshDensity(coarse_rows=(4, 8, 12), coarse_fillet_rows=6)


@pytest.mark.parametrize("name", ["face-worm-conical-convex", "face-worm-cylindrical-concave"])
def test_gear_teeth(name):
    """Valid elements; fillet and flank nodes on the head-cutter's surfaces, found by their distance to its axis."""
    drive = Drive.load(name)
    form = teeth_of(drive, "wheel", 6.0).at(0.0)
    placed = [PlacedTooth(form, about_z(k * 2.0 * np.pi / 60), None) for k in (0, 1)]
    body = mesh_body(placed, DENSITY)
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


@pytest.fixture(scope="module", params=["face-worm-conical-convex", "face-worm-cylindrical-concave"])
def threads(request):
    """(drive, worm angle, body of five threads, their order) at an angle off the middle of a pitch."""
    drive = Drive.load(request.param)
    worm, angle = gear_pair(drive).pinion, 0.7
    order = tooth_order(worm, angle, range(-2, 3))
    return drive, worm, angle, order, mesh_body([placed_tooth(worm, angle, k, None) for k in order], DENSITY)


def test_threads_are_one_valid_body(threads):
    """Right-handed elements; neighbouring threads, of different radius on a cone, share the nodes of their cuts."""
    _, _, _, order, body = threads
    assert order == sorted(order)
    assert body.mesh.smallest_jacobian() > 0.3
    for k in range(len(order) - 1):
        cut = body.nodes(k, "right_cut")
        assert np.array_equal(cut, body.nodes(k + 1, "left_cut"))
    quads = np.sort(body.mesh.elements[:, FACES].reshape(-1, 4), axis=1)
    assert set(np.unique(quads, axis=0, return_counts=True)[1]) == {1, 2}


def test_thread_flanks_are_the_generated_ones(threads):
    """Nodes of either flank lie on the enveloped surface of its own design; the second one is turned about the axis.

    The turn is that which the first of its nodes asks for; all others must then agree.
    """
    drive, worm, angle, order, body = threads
    for place, later in enumerate(order):
        back = about_z(later * worm.pitch)[:3, :3]
        own = body.mesh.nodes[body.nodes(place, f"flank_{worm.working}")] @ back.T
        starts = worm_places(drive, angle - later * worm.pitch)
        assert distance_from_flank(drive.flank("pinion"), own, starts).max() < 1e-9
    partner = Drive.load(drive.design.tables["name"].replace(*FLANKS[drive.design.tables["flank"]]))
    flank, starts = partner.flank("pinion"), worm_places(partner, angle)
    other = "right" if worm.working == "left" else "left"
    nodes = body.mesh.nodes[body.nodes(order.index(0), f"flank_{other}")]
    turn = turn_onto_flank(flank, nodes[len(nodes) // 2], starts)
    turned = nodes @ about_z(-turn)[:3, :3].T
    assert distance_from_flank(flank, turned, worm_places(partner, angle + turn)).max() < 1e-9


def worm_places(drive, angle):
    """Parameters (S, 3) on the worm's flank around what is cut at a worm angle, its equation of meshing solved."""
    flank = drive.flank("pinion")
    here = drive.tca([0.0]).unknowns
    profile, turn = np.meshgrid(np.linspace(-1.5, 1.8, 12), np.linspace(-2.5, 2.5, 25))
    places = np.stack([profile.ravel(), np.full(profile.size, here["theta_worm"][0]), angle + turn.ravel()], axis=1)
    for _ in range(30):
        found = flank(places)
        places[:, 1] -= found.conditions[:, 0, 0] / found.conditions[:, 0, 2]
    return places


def test_thread_is_half_a_pitch_thick(threads):
    """Along the axis at mid height, which tooth and space of the gear are too."""
    drive, worm, _, _, _ = threads
    form = worm.tooth(0.0)
    own, other = (form.left, form.right) if worm.working == "left" else (form.right, form.left)
    section = np.zeros(1)
    mid = [side.flank.points(section, np.zeros((1, 1)))[0, 0] for side in (own, other)]
    assert abs(mid[1][2] - mid[0][2]) == pytest.approx(0.5 * np.pi * drive.design.value("axial_module_mm"), abs=1e-8)


def test_thread_rounding_is_smooth():
    """The arc at the root joins the flank with its tangent plane, and the root with its normal."""
    form = teeth_of(Drive.load("face-worm-conical-convex"), "pinion", 4.0).at(0.0)
    sections = np.linspace(*form.faces, 5)
    for side in (form.left, form.right):
        ends = [
            side.fillet.points(sections, np.ones((5, 1))),
            side.flank.points(sections, side.flank.first(sections)[:, None]),
        ]
        assert np.abs(ends[0] - ends[1]).max() < 1e-9
        azimuth = np.arctan2(ends[0][:, 0, 1], ends[0][:, 0, 0])
        across = np.stack([-np.sin(azimuth), np.cos(azimuth), np.zeros(5)], axis=-1)
        normals = [
            side.fillet.normals(sections, np.ones((5, 1)))[:, 0],
            side.flank.normals(sections, side.flank.first(sections)[:, None])[:, 0],
        ]
        within = normals[1] - np.sum(normals[1] * across, axis=1, keepdims=True) * across
        within /= np.linalg.norm(within, axis=1, keepdims=True)
        assert np.abs(within - normals[0]).max() < 1e-9
        upward = side.fillet.normals(sections, np.zeros((5, 1)))[:, 0]
        taper = np.tan(np.radians(5.0))
        radial = np.stack([np.cos(azimuth), np.sin(azimuth), np.full(5, -taper)], axis=-1) / np.hypot(1.0, taper)
        assert np.abs(upward - radial).max() < 1e-9


def test_worm_points_satisfy_their_meshing_equation():
    drive = Drive.load("face-worm-conical-convex")
    curves = teeth_of(drive, "pinion", 4.0).at(0.0).left.flank
    contact = drive.tca([0.0])
    along = contact.unknowns["u_worm"], contact.unknowns["psi_worm"]
    assert curves.surface(*along)[0][0] == pytest.approx(contact.body_points["pinion"][0], abs=1e-9)


@pytest.mark.parametrize("member", ["pinion", "wheel"])
def test_pictures_look_at_the_flank_in_contact(member):
    """From outside it, and from the side of the tips: the worm's threads, above the gear, from below."""
    gear = gear_pair(Drive.load("face-worm-conical-convex"))
    model = build_model(gear, 0.0, 1, Load(50e3, "wheel"), np.array([700.0]), DENSITY)
    elevation, azimuth = np.radians(view(model, member))
    sight = np.array([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)])
    touch = model.contacts[0].touch
    from_pinion = model.frame[:3, :3] @ touch.normal
    point = model.frame[:3, :3] @ touch.point + model.frame[:3, 3]
    tips = np.array([0.0, 0.0, point[2]])  # the worm's axis is at z = 0, square to the gear's
    assert sight @ (from_pinion if member == "pinion" else -from_pinion) > 0.5
    assert sight @ (tips if member == "pinion" else -tips) > 0.0


@pytest.mark.validate
@pytest.mark.parametrize(
    "name", ["face-worm-conical-convex", "face-worm-conical-concave", "face-worm-cylindrical-convex"]
)
def test_pairs_share_the_load(name):
    """50 N m on the gear, five pairs modelled, at the beginning of a pitch: three share, as the report says."""
    gear = gear_pair(Drive.load(name))
    load = Load(50e3, "wheel")
    compliance = {name: tooth_compliance(getattr(gear, name), 2) for name in ("pinion", "wheel")}
    found = loaded_contact(gear, 0.0, 5, load, compliance)
    carrying = [pair for pair in found.pairs if pair.force > 0.0]
    assert len(carrying) == 3
    for pair in loaded_contact(gear, 0.0, 5, load, None).pairs:
        assert pair.force == 0.0 or pair.peak_pressure == pytest.approx(pair.hertz.peak_pressure, rel=0.01)
    arms = [abs(np.cross(p.contact.touch.point, p.contact.touch.normal)[2]) for p in carrying]
    assert sum(a * p.force for a, p in zip(arms, carrying, strict=True)) == pytest.approx(load.torque, rel=2e-3)
