"""Placement of the head-cutter: against an independent search, its own equations, and what it must refuse."""

import mpmath
import numpy as np
import pytest

from meshwright import DesignError, Drive
from meshwright.design import design
from tests.face_worm.designs import NAMES, changed, independent


def _vector(drive, name):
    return np.array([drive.design.value(key, "placement") for key in (f"{name}_{axis}_mm" for axis in "xyz")])


def _axis(drive, name):
    return np.array([drive.design.value(f"tool_axis_{name}_{axis}", "placement") for axis in "xyz"])


def test_lead(reference):
    """Two threads of axial module 1.334 mm: lead π·m·N1."""
    design = Drive.load(NAMES[0]).design
    table = reference("face-worm")["table_1"]
    assert design.sizes["lead_worm_mm"] == pytest.approx(np.pi * table["axial_module_mm"] * 2, abs=1e-14)
    assert round(design.sizes["lead_worm_mm"], 5) == 8.38177


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("rule", ["mid", "cones"])
def test_placement_agrees_with_fifty_digits(name, rule):
    drive = changed(name, {"pitch_point_rule": rule})
    with mpmath.workdps(50):
        placed = independent(drive).placed
    for point in ("A1", "P", "A2"):
        assert np.allclose(_vector(drive, point), [float(c) for c in placed[point]], rtol=0, atol=1e-11)
    for axis in "xyz":
        assert np.allclose(_axis(drive, axis), [float(c) for c in placed[axis]], rtol=0, atol=1e-11)
    assert drive.design.value("head_cutter_radius_mm") == pytest.approx(float(placed["radius"]), abs=1e-9)
    assert drive.design.value("blade_angle_deg") == pytest.approx(float(placed["blade"]), abs=1e-11)
    tilt = np.radians(drive.design.sizes["head_cutter_tilt_deg"])
    assert tilt == pytest.approx(float(placed["tilt"]), abs=1e-11)


def test_echo_names_points_axes_and_angles():
    """What every JSON document shows of the design."""
    echo = Drive.load(NAMES[0]).design.as_solved()
    placement, design = echo["placement"], echo["design"]
    for point in ("A1", "P", "A2", "tool_origin"):
        assert placement[f"{point}_mm"] == [placement[f"{point}_{axis}_mm"] for axis in "xyz"]
    axes = np.array([placement[f"tool_axis_{axis}"] for axis in "xyz"])
    assert np.allclose(axes @ axes.T, np.eye(3), rtol=0, atol=1e-14)
    assert np.linalg.det(axes) > 0
    assert {"head_cutter_radius_mm", "blade_angle_deg", "head_cutter_tilt_deg", "lead_worm_mm"} <= design.keys()
    assert design["pitch_point_rule"] == "mid"


@pytest.mark.validate
def test_a_search_from_nothing_finds_the_same_roots():
    """Hob phase by sign changes over a turn, A1 and A2 by small steps from the section of L."""
    drive = Drive.load(NAMES[1])
    twin = independent(drive)
    phase = twin._phase()
    assert drive.design.value("hob_phase_deg", "placement") == pytest.approx(float(phase), abs=1e-12)
    for point, radius in (("A1", twin.inner), ("A2", twin.outer)):
        found = [float(q) for q in twin._at_radius(radius, phase)]
        ours = [drive.design.value(f"hob_{q}_{point}_deg", "placement") for q in ("theta", "psi")]
        assert np.allclose(ours, found, rtol=0, atol=1e-10)


@pytest.mark.parametrize("name", NAMES)
def test_points_lie_on_the_hob_cut_flank_and_on_the_circle(name):
    drive = Drive.load(name)
    flank = drive.flank("reference_wheel")
    for point, radius_key in (("A1", "gear_inner_radius_mm"), ("A2", "gear_outer_radius_mm")):
        place = [0.0, *(drive.design.value(f"hob_{q}_{point}_deg", "placement") for q in ("theta", "psi"))]
        found = flank([place])
        assert abs(found.conditions[0, 0, 0]) < 1e-11
        assert found.regular[0] > 0
        assert np.allclose(found.points[0], _vector(drive, point), rtol=0, atol=1e-12)
        assert np.hypot(*found.points[0, :2]) == pytest.approx(drive.design.value(radius_key), abs=1e-11)
    centre, axis = _vector(drive, "tool_origin"), _axis(drive, "z")
    spokes = np.array([_vector(drive, point) - centre for point in ("A1", "P", "A2")])
    assert np.allclose(np.linalg.norm(spokes, axis=1), drive.design.value("head_cutter_radius_mm"), rtol=0, atol=1e-9)
    assert np.allclose(spokes @ axis, 0, rtol=0, atol=1e-11)


@pytest.mark.parametrize("name", NAMES)
def test_gear_touches_the_hob_cut_flank_at_the_pitch_point(name):
    drive = Drive.load(name)
    copied = drive.flank("wheel")([[0.0, 0.0]])
    cut = drive.flank("reference_wheel")([[0.0, 0.0, 0.0]])
    assert np.allclose(copied.points, cut.points, rtol=0, atol=1e-12)
    along = _axis(drive, "y")
    assert abs(along @ copied.normals[0]) < 1e-12
    section = np.cross(cut.normals[0], along)
    assert abs(section @ copied.normals[0]) < 1e-12


def test_published_head_cutter_radii_do_not_follow_from_the_text(reference):
    """Neither rule gives both printed mean radii; ours are within a few millimetres, on both sides of them."""
    published = [reference("face-worm")[t]["mean_head_cutter_radius_mm"] for t in ("table_1", "table_2")]
    for rule in ("mid", "cones"):
        radii = [changed(n, {"pitch_point_rule": rule}).design.value("head_cutter_radius_mm") for n in NAMES]
        means = [(radii[0] + radii[1]) / 2, (radii[2] + radii[3]) / 2]
        share = [mean / print_ - 1 for mean, print_ in zip(means, published, strict=True)]
        assert all(-0.035 < s < -0.005 for s in share)


def test_radius_may_be_given():
    drive = changed(NAMES[0], {"head_cutter_radius_mm": 24.398})
    free = Drive.load(NAMES[0])
    for point in ("A1", "P", "A2"):
        assert np.array_equal(_vector(drive, point), _vector(free, point))
    assert np.array_equal(_axis(drive, "z"), _axis(free, "z"))
    away = _vector(drive, "P") - _vector(drive, "tool_origin")
    assert np.linalg.norm(away) == pytest.approx(24.398, abs=1e-12)
    assert np.allclose(np.cross(away, _axis(free, "x")), 0, atol=1e-12)
    assert set(drive.tca(np.radians([-90.0, 0.0, 90.0])).status) == {"converged"}


@pytest.mark.parametrize("name", NAMES)
def test_a_change_of_tilt_keeps_the_tangent_plane_and_the_lengthwise_curvature_at_the_pitch_point(name):
    before, after = Drive.load(name), changed(name, {"head_cutter_tilt_change_deg": 6.0})
    at = [drive.flank("wheel")([[0.0, 0.0]]) for drive in (before, after)]
    assert np.allclose(at[0].points, at[1].points, rtol=0, atol=1e-12)
    assert np.allclose(at[0].normals, at[1].normals, rtol=0, atol=1e-12)
    curvature = [
        np.cos(d.design.value("blade_angle_deg")) / d.design.value("head_cutter_radius_mm") for d in (before, after)
    ]
    assert curvature[0] == pytest.approx(curvature[1], rel=1e-12)
    turned = np.arccos(np.clip(_axis(before, "z") @ _axis(after, "z"), -1, 1))
    assert turned == pytest.approx(np.radians(6.0), abs=1e-7)


@pytest.mark.parametrize(
    ("name", "change", "keys"),
    [
        (NAMES[0], {"offset_mm": 1.0}, ("worm_axial_position_mm", "offset_mm", "no pitch point")),
        (NAMES[1], {"profile_angle_deg": 10.0}, ("gear_inner_radius_mm", "profile_angle_deg")),
        (NAMES[0], {"gear_inner_radius_mm": 36.0}, ("gear_inner_radius_mm", "profile_angle_deg")),
        (NAMES[0], {"gear_outer_radius_mm": 38.0}, ("gear_outer_radius_mm", "gear_inner_radius_mm")),
        (NAMES[0], {"blade_angle_deg": 90.0}, ("blade_angle_deg",)),
        (NAMES[0], {"fillet_radius_mm": 3.0}, ("fillet_radius_mm", "blade_depth_mm")),
        (NAMES[0], {"pitch_point_rule": "middle"}, ("pitch_point_rule",)),
    ],
)
def test_designs_that_cannot_be_made_are_refused(name, change, keys):
    with pytest.raises(DesignError) as refused:
        changed(name, change)
    for key in keys:
        assert key in str(refused.value)


@pytest.mark.parametrize(
    "given",
    [
        {"placement.tool_axis_x_y": 0.1},
        {"placement.tool_axis_z_x": 0.0, "placement.tool_axis_z_y": 0.0, "placement.tool_axis_z_z": 1.0},
    ],
)
def test_a_part_of_a_frame_is_refused(given):
    """One component of an axis would be combined with the derived others into a frame that is none."""
    with pytest.raises(DesignError, match=r"given without placement\.\w+.*give all of them or none"):
        Drive.from_tables(design.changed(design.read(NAMES[0]), given))


@pytest.mark.parametrize("name", NAMES)
def test_a_whole_frame_may_be_given_and_is_taken(name):
    found = Drive.load(name)
    keys = [f"tool_axis_{axis}_{q}" for axis in "xyz" for q in "xyz"]
    axes = {f"placement.{key}": found.design.value(key, "placement") for key in keys}
    again = Drive.from_tables(design.changed(design.read(name), axes))
    assert again.tca([0.0]).error == pytest.approx(found.tca([0.0]).error, abs=1e-15)
