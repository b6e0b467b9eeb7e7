"""An undercut tooth: its fillet cuts its flank off, and whatever is made of either ends there."""

import json
import math

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.flank.lines import lines
from meshwright.flank.region import region
from meshwright.flank.sides import RegionSide

NAME, MEMBER = "spherical-table-2-3", "pinion"

#: A spur pinion of 9 teeth, cut by the standard basic rack: module, teeth, dedendum and rounding of the rack.
MODULE, TEETH, DEDENDUM, ROUNDING, ANGLE = 3.0, 9, 3.75, 1.14, math.radians(20.0)


def _too_thick(flank, fillet, normals):
    """How far flank points (N, 3) of a section stand out of the tooth that the fillet (P, 3) leaves at most, rad."""
    radius, azimuth = np.hypot(fillet[:, 0], fillet[:, 1]), np.arctan2(fillet[:, 1], fillet[:, 0])
    upper = np.argmin(radius)  # from its lowest point to its end at the flank
    radius, azimuth = (v[upper:] if upper < len(v) / 2 else v[upper::-1] for v in (radius, azimuth))
    at = np.hypot(flank[:, 0], flank[:, 1])
    outward = np.sign(flank[:, 0] * normals[:, 1] - flank[:, 1] * normals[:, 0])
    within = (at > radius[0]) & (at < radius[-1])
    off = outward * (np.arctan2(flank[:, 1], flank[:, 0]) - np.interp(at, radius, azimuth))
    return float(off[within].max(initial=-np.inf))


def _in_the_middle(drive, name, count):
    """A region of the surface itself in the section z = 0, beyond where flank and fillet cross."""
    line = lines(region(drive, MEMBER, name, drive.uses)).at(np.array([0.0]))
    return drive.flank(MEMBER, name)(line.places(np.linspace(0.0, 1.0, count))[:, 0])


def test_an_undercut_flank_is_exported_up_to_where_its_fillet_cuts_it(tmp_path):
    path = tmp_path / "flank.json"
    assert main(["surface", NAME, "--member", MEMBER, "--grid", "41x3", "--json", str(path)]) == 0
    shown = json.loads(path.read_text(encoding="utf-8"))
    points, normals = (np.array(shown[key], dtype=float).reshape(41, 3, 3)[:, 1] for key in ("points_mm", "normals"))
    drive = Drive.load(NAME)
    fillet, whole = _in_the_middle(drive, "fillet", 401).points, _in_the_middle(drive, "flank", 41)
    assert _too_thick(points, fillet, normals) < 1e-6
    lowest = [int(np.argmin(np.hypot(points[:, 0], points[:, 1])))]
    assert abs(_too_thick(points[lowest], fillet, normals[lowest])) < 3e-5  # it ends on the fillet
    assert _too_thick(whole.points, fillet, whole.normals) > 1e-5  # the surface itself goes on below


def _turned(x, y, angle):
    c, s = mpmath.cos(angle), mpmath.sin(angle)
    return c * x - s * y, s * x + c * y


def _flank_of_rack(shift):
    """Point of the transverse profile that the rack's straight flank cuts at a shift along its pitch line (the law of
    gearing: the normal at the point of contact goes through the pitch point).
    """
    r = MODULE * TEETH / 2
    normal = (math.pi * MODULE / 4 + shift) * math.cos(ANGLE)
    return _turned(normal * math.cos(ANGLE), r - normal * math.sin(ANGLE), shift / r)


def _rounding_of_rack(shift):
    """The same of the rounding of the rack's tip, a circle whose centre moves along a line below the pitch line."""
    r = MODULE * TEETH / 2
    beside = math.pi * MODULE / 4 - DEDENDUM * math.tan(ANGLE) - ROUNDING * (1 - math.sin(ANGLE)) / math.cos(ANGLE)
    x, y = beside + shift, ROUNDING - DEDENDUM
    away = ROUNDING / mpmath.hypot(x, y)
    return _turned(x * (1 + away), r + y * (1 + away), shift / r)


def _crossing_radius():
    """Radius at which the trochoid of the rounding crosses the involute of the flank."""
    def apart(on_flank, on_rounding):
        a, b = _flank_of_rack(on_flank), _rounding_of_rack(on_rounding)
        return [a[0] - b[0], a[1] - b[1]]

    place = mpmath.findroot(apart, _nearest_crossing())
    return float(mpmath.hypot(*_flank_of_rack(place[0])))


def _nearest_crossing():
    """About where they cross, by trial: on the regular part of the involute, the trochoid rising beside it."""
    r = MODULE * TEETH / 2
    ends = r * math.tan(ANGLE) - math.pi * MODULE / 4  # the base circle
    flank = [(s, _flank_of_rack(s)) for s in np.linspace(ends - 4.0, ends - 0.05, 200)]
    rounding = [(s, _rounding_of_rack(s)) for s in np.linspace(-1.0, 8.0, 400)]
    away = [[math.hypot(a[1][0] - b[1][0], a[1][1] - b[1][1]) for b in rounding] for a in flank]
    i, j = np.unravel_index(np.argmin(away), (200, 400))
    return [flank[i][0], rounding[j][0]]


@pytest.fixture(scope="module")
def spur():
    return Drive.from_tables({
        "drive": "cylindrical-gears",
        "flank": "left",
        "design": {
            "normal_module_mm": MODULE, "pressure_angle_deg": 20.0, "pinion_teeth": TEETH, "wheel_teeth": 40,
            "face_width_mm": 12.0, "basic_rack_dedendum_mm": DEDENDUM, "basic_rack_rounding_mm": ROUNDING,
        },
        "blank": {"pinion_tip_radius_mm": 16.0},
    })  # fmt: skip


def test_flank_and_fillet_end_where_involute_and_trochoid_cross(spur):
    """Every export has the region from :meth:`Drive.region`: the crossing from the law of gearing alone."""
    expected, base = _crossing_radius(), 0.5 * MODULE * TEETH * math.cos(ANGLE)
    assert expected - base > 0.05  # well above the singular line, which is on the base circle
    for name, end in (("flank", np.min), ("fillet", np.max)):
        found = spur.surface(MEMBER, (9, 5), name)
        radius = np.hypot(found.points[:, 0], found.points[:, 1]).reshape(9, 5)
        assert end(radius, axis=0) == pytest.approx(np.full(5, expected), abs=1e-7)
        border = found.mesh.points[found.mesh.border]
        assert end(np.hypot(border[..., 0], border[..., 1])) == pytest.approx(expected, abs=1e-6)


def test_a_tooth_that_is_not_undercut_ends_where_its_tool_does(spur):
    wheel = spur.region("wheel")
    assert spur.crossing("wheel") is None and "junction" not in wheel.limits.names


def test_undercut_begins_where_the_cusp_of_a_flank_meets_the_end_of_its_fillet():
    """Sections ever nearer to that where undercut begins: flank and fillet meet, in one point of both."""
    drive = Drive.load("plain-zc").with_(blank={"hob_tip_rounding_mm": 1.22})
    side = RegionSide.of(*(region(drive, "wheel", name, drive.uses) for name in ("flank", "fillet")))
    low, high = -2.5, -1.0  # not undercut, undercut
    tried = []
    while high - low > 1e-10:
        middle = 0.5 * (low + high)
        at = np.array([middle])
        tried.append(middle)
        places = zip(("flank", "fillet"), side.joint(at), strict=True)
        points = [drive.flank("wheel", name)(q).points for name, q in places]
        assert np.linalg.norm(points[0] - points[1]) < 1e-6
        low, high = (low, middle) if side.crossed(at)[0] else (middle, high)
    assert low > -2.5 and high < -1.0 and len(tried) > 30
