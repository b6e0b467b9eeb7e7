"""Structured tooth meshes of a spherical gear: nodes on the surfaces, valid elements, closed-form junctions."""

import numpy as np
import pytest
from spherical_gear import SphericalGear

from meshwright.fe.body import PlacedTooth, mesh_body
from meshwright.fe.grading import ContactZone, MeshDensity
from meshwright.fe.hexahedra import FACES
from meshwright.fe.tooth import Stations, face_rows, mesh_tooth, section_values

PINION = SphericalGear(33, 1, 66.0)
WHEELS = {
    name: SphericalGear(47, sigma, 94.0, bore=15.0) for name, sigma in (("concave", -1), ("spur", 0), ("convex", 1))
}
GEARS = [PINION, *WHEELS.values()]
DENSITY = MeshDensity()


def zone_of(gear, height=0.0, z=0.0):
    """A contact ellipse of the size at 100 N m at rack section height ``height`` in the section ``z``."""
    curves = gear.form().left.flank
    face = curves.solve(np.array([z]), np.array([[height]]))
    point, normal = gear.flank_surface(np.array([[height]]), face)
    point, normal = point[0, 0], normal[0, 0]
    direction = np.array([0.0, 0.0, 1.0]) - normal[2] * normal
    return ContactZone("left", point, direction / np.linalg.norm(direction), normal, 2.95, 0.25)


def tooth_of(gear, zone, density=DENSITY):
    form = gear.form()
    values = section_values(form, zone, density, face_rows(form, zone, density))
    return mesh_tooth(form, zone, density, *Stations.between([values]))


@pytest.mark.parametrize("gear", GEARS, ids=["pinion", *WHEELS])
@pytest.mark.parametrize("place", [None, (0.0, 0.0), (-2.5, 6.0), (3.0, -12.0)])
def test_elements_are_valid(gear, place):
    zone = None if place is None else zone_of(gear, *place)
    assert tooth_of(gear, zone).mesh.smallest_jacobian() > 0.1


@pytest.mark.parametrize("gear", GEARS, ids=["pinion", *WHEELS])
def test_nodes_lie_on_flank_and_fillet(gear):
    """Every surface node of both sides within 1e-9 mm of the surface, found again from its coordinates alone."""
    tooth = tooth_of(gear, zone_of(gear, 0.3, 1.0))
    for side in ("left", "right"):
        form_side = gear.form().side(side)
        for region in ("flank", "fillet"):
            points = tooth.mesh.nodes[tooth.nodes(f"{region}_{side}")]
            assert distance(getattr(form_side, region), points, points[:, 2]).max() < 1e-9


def distance(curves, points, z):
    """Distance (K,) of points from the section curves through their own z, by bisection."""

    def height(at):
        """Grows from the root land to the tip, also where the fillet runs along the root circle."""
        return np.hypot(at[:, 0], at[:, 1]) - 60.0 * np.abs(np.arctan2(at[:, 1], at[:, 0]))

    def curve(profile):
        return curves.points(z, profile[:, None])[:, 0]

    low, high = curves.first(z), curves.last(z)
    for _ in range(60):
        middle = 0.5 * (low + high)
        inside = height(curve(middle)) < height(points)
        low, high = np.where(inside, middle, low), np.where(inside, high, middle)
    return np.linalg.norm(curve(0.5 * (low + high)) - points, axis=1)


@pytest.mark.parametrize(("gear", "published"), [(PINION, 62.9665), (WHEELS["concave"], 90.6686)])
def test_junction_radius(gear, published):
    """The node row between fillet and flank: r_j^2 = (r + X)^2 + (X cot alpha)^2 at the end X of the straight edge."""
    tooth = tooth_of(gear, zone_of(gear))
    shared = np.intersect1d(tooth.nodes("flank_left"), tooth.nodes("fillet_left"))
    middle = shared[np.abs(tooth.mesh.nodes[shared, 2]) < 1e-9]
    radius = np.hypot(*tooth.mesh.nodes[middle, :2].T)
    x = gear.module * (-1.25 + 0.38 * (1 - np.sin(gear.alpha)))
    assert radius == pytest.approx(np.hypot(gear.r + x, x / np.tan(gear.alpha)), abs=1e-9)
    assert radius == pytest.approx(published, abs=5e-5)


def test_fillet_joins_flank_and_root_smoothly():
    """Position and normal of fillet and flank agree at the junction; at the root the fillet's normal is radial."""
    theta = np.array([[0.05]])
    flank = PINION.flank_surface(np.array([[PINION.junction_x]]), theta)
    fillet = PINION.fillet_surface(np.array([[PINION.alpha]]), theta)
    assert np.abs(flank[0] - fillet[0]).max() < 1e-12
    assert np.abs(flank[1] - fillet[1]).max() < 1e-12
    point, normal = (v[0, 0] for v in PINION.fillet_surface(np.array([[np.pi / 2]]), np.array([[0.0]])))
    assert np.hypot(point[0], point[1]) == pytest.approx(PINION.r - 1.25 * PINION.module, abs=1e-12)
    assert normal[:2] == pytest.approx(point[:2] / np.hypot(point[0], point[1]), abs=1e-12)


@pytest.mark.parametrize("density", [DENSITY, DENSITY.refined(1.7)])
def test_contact_zone_is_fine(density):
    """At least the asked number of elements to a Hertz semi-axis around the contact point, a node on it."""
    zone = zone_of(PINION, 0.5, 2.0)
    tooth = tooth_of(PINION, zone, density)
    nodes = tooth.mesh.nodes[tooth.nodes("flank_left")] - zone.centre
    assert np.linalg.norm(nodes, axis=1).min() < 1e-3
    minor = np.cross(zone.normal, zone.major_direction)
    row = nodes[np.abs(nodes @ zone.major_direction) < 0.1]
    heights = np.sort(row @ minor)
    inside = heights[np.abs(heights) < zone.semi_minor]
    assert np.diff(inside).max() <= zone.semi_minor / density.per_semi_minor * 1.02


def test_teeth_share_their_cuts():
    """Neighbouring teeth with different zones join node to node: the body's boundary has no inner faces."""
    form = PINION.form()
    step = PINION.next_tooth
    teeth = [
        PlacedTooth(form, np.linalg.inv(step), zone_of(PINION, -2.0)),
        PlacedTooth(form, np.eye(4), zone_of(PINION, 1.0)),
        PlacedTooth(form, step, None),
    ]
    body = mesh_body(teeth, DENSITY)
    assert body.mesh.smallest_jacobian() > 0.1
    shared = [np.intersect1d(body.nodes(k, "right_cut"), body.nodes(k + 1, "left_cut")) for k in (0, 1)]
    assert [len(nodes) for nodes in shared] == [len(body.nodes(k, "right_cut")) for k in (0, 1)]
    quads = np.sort(body.mesh.elements[:, FACES].reshape(-1, 4), axis=1)
    assert set(np.unique(quads, axis=0, return_counts=True)[1]) == {1, 2}
