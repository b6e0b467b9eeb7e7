"""Flanks and fillets of spherical gears against the report's formulas and published points."""

import math

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from tests.independent.spherical import Gear

FORMS = [("convex", 72.0), ("concave", 72.0), ("convex", 1e7), ("spur", None)]


@pytest.mark.parametrize("flank", ["left", "right"])
@pytest.mark.parametrize(("form", "radius"), FORMS)
def test_flank_agrees_with_fifty_digits(pair, form, radius, flank):
    radii = {"pinion_sphere_radius_mm": radius} if radius else {}
    drive = pair(form, "spur", flank=flank, **radii)
    across = [z / (radius or 1.0) for z in (-7.5, -1.0, 0.0, 6.0)]
    places = np.array([(along, q) for along in (0.0, 3.0, 8.5) for q in across])
    found = drive.flank("pinion")(places)
    with mpmath.workdps(50):
        gear = Gear(4, 36, mpmath.radians(20), form, radius and mpmath.mpf(radius), 1 if flank == "left" else -1)
        exact = [gear.flank(mpmath.mpf(along), mpmath.mpf(q)) for along, q in places]
        points = np.array([[float(c) for c in point] for point, _ in exact])
        normals = np.array([[float(c) for c in normal] for _, normal in exact])
    assert found.points == pytest.approx(points, abs=1e-12)
    assert found.normals == pytest.approx(normals, abs=1e-14)


@pytest.mark.parametrize("flank", ["left", "right"])
@pytest.mark.parametrize("form", ["convex", "concave", "spur"])
def test_fillet_continues_the_flank_to_the_root(pair, form, flank):
    drive = pair(form, "spur", flank=flank)
    sweep = 5.0 / 72.0 if form != "spur" else 5.0
    edge = drive.flank("pinion")([[0.0, sweep]])
    bottom = math.pi / 2 - math.radians(20)
    fillet = drive.flank("pinion", "fillet")(np.column_stack([np.linspace(0, bottom, 9), np.full(9, sweep)]))
    assert fillet.points[0] == pytest.approx(edge.points[0], abs=1e-12)
    assert fillet.normals[0] == pytest.approx(edge.normals[0], abs=1e-14)
    assert np.all(fillet.regular > 0)
    assert np.all(np.diff(np.hypot(fillet.points[:, 0], fillet.points[:, 1])) < 0)


def test_fillet_ends_on_the_root_circle():
    drive = Drive.load("spherical-table-4-4-concave")
    for member, pitch_radius in (("pinion", 66.0), ("wheel", 94.0)):
        end = drive.flank(member, "fillet")([[math.pi / 2 - math.radians(20), 0.0]]).points[0]
        radius = math.hypot(end[0], end[1])
        assert radius == pytest.approx(drive.design.sizes[f"{member}_root_radius_mm"], abs=1e-12)
        assert radius == pytest.approx(pitch_radius - 1.25 * 4.0, abs=2e-4)


def test_flank_and_fillet_meet_in_the_published_nodes(reference):
    """Both nodes of section 4.4 are flank points at l = 0, Z = 0, in one frame centred on the pinion."""
    nodes = reference("spherical")["nodes"]
    drive = Drive.load("spherical-table-4-4-concave")
    pinion, wheel = np.array(nodes["pinion_mm"]), np.array(nodes["wheel_mm"])
    distances = math.hypot(pinion[0], pinion[1]), math.hypot(nodes["center_distance_mm"] - wheel[0], wheel[1])
    for member, published in zip(("pinion", "wheel"), distances, strict=True):
        point = drive.flank(member)([[0.0, 0.0]]).points[0]
        radius = math.hypot(point[0], point[1])
        assert radius == pytest.approx(published, abs=nodes["tolerance"])
        assert drive.design.sizes[f"{member}_limit_radius_mm"] == pytest.approx(radius, abs=1e-12)
