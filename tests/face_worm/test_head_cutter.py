"""Does the head-cutter clear the teeth across the tool, and with how much tilt."""

import math

import mpmath
import numpy as np
import pytest

from meshwright import Drive, UsageError
from meshwright.limits.clearance import clearance, least_tilt
from tests.face_worm.designs import NAMES, changed, independent


def _ring_above_tips(drive):
    """Height of the blades' ends above the tips across the tool, from the placement alone, at 0.05° around the tool."""
    twin = independent(drive)
    g = {name: np.array([float(c) for c in value]) for name, value in twin.placed.items() if name in "xyzO"}
    a, radius = float(twin.placed["blade"]), float(twin.placed["radius"])
    depth, addendum = drive.design.value("blade_depth_mm"), drive.design.value("gear_addendum_mm", "blank")
    rounding, side = drive.design.value("fillet_radius_mm"), drive.design.flank
    inner, outer = drive.design.value("gear_inner_radius_mm"), drive.design.value("gear_outer_radius_mm")
    t = np.radians(np.arange(-180.0, 180.0, 0.05))[:, None]

    def ring(ring_radius, height):
        return g["O"] + ring_radius * (np.cos(t) * g["x"] + np.sin(t) * g["y"]) + height * g["z"]

    slope = math.tan(a)
    junction = (rounding * (1 + side * math.sin(a)) - depth) / math.cos(a)
    end = radius + junction * math.sin(a) + side * rounding * math.cos(a)
    tips = ring(radius + addendum * slope, addendum)
    tip_radius = np.hypot(tips[:, 0], tips[:, 1])
    near = np.abs(t[:, 0]) < math.radians(60)
    order = np.argsort(tip_radius[near])
    blades = [ring(end, -depth), ring(radius + addendum * slope, addendum)]
    worst = math.inf
    for points in blades:
        r = np.hypot(points[:, 0], points[:, 1])
        across = (np.abs(t[:, 0]) > math.radians(90)) & (r > inner) & (r < outer)
        height = points[:, 2] - np.interp(r, tip_radius[near][order], tips[near, 2][order])
        worst = min(worst, height[across].min())
    return worst


@pytest.mark.parametrize("name", NAMES)
def test_clearance_agrees_with_the_ring_of_the_blade_ends(name):
    drive = Drive.load(name)
    with mpmath.workdps(15):
        ring = _ring_above_tips(drive)
    found = clearance(drive).height
    assert found <= ring + 1e-4
    assert found == pytest.approx(ring, abs=0.05)


def test_conical_designs_clear_and_cylindrical_ones_need_more_tilt():
    """With the pitch point in the section L the cylindrical worm's head-cutter hardly tilts and cuts teeth away."""
    heights = {name: clearance(Drive.load(name)).height for name in NAMES}
    assert {name: height > 0 for name, height in heights.items()} == {name: "conical" in name for name in NAMES}
    for name in NAMES:
        assert clearance(changed(name, {"pitch_point_rule": "cones"})).height > 0


@pytest.mark.parametrize("name", [NAMES[0], NAMES[3]])
def test_least_tilt_just_clears(name):
    drive = Drive.load(name)
    least = least_tilt(drive)
    just = changed(name, {"head_cutter_tilt_change_deg": math.degrees(least.change)})
    assert 0 <= clearance(just).height < 1e-3
    assert math.radians(just.design.sizes["head_cutter_tilt_deg"]) == pytest.approx(least.tilt, abs=1e-12)
    assert (least.change < 0) == (clearance(drive).height > 0)


def test_design_tilted_to_clear_still_meshes():
    """The tilt keeps tangent plane and lengthwise curvature at P: contact stays longitudinal and the gear lags."""
    drive = Drive.load(NAMES[3])
    more = changed(NAMES[3], {"head_cutter_tilt_change_deg": math.degrees(least_tilt(drive).change) + 1.0})
    result = more.tca(np.radians([-90.0, 0.0, 90.0]))
    assert set(result.status) == {"converged"}
    assert result.relative_error[0] > 0 and result.relative_error[2] > 0


def test_other_families_have_no_head_cutter():
    with pytest.raises(UsageError, match="no tool that passes over finished teeth"):
        clearance(Drive.load("recess-action-full"))
