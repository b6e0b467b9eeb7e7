"""Exact symmetries of a worm drive: mirror image, half turn, scale."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.design.design import changed
from tests.quick import quick
from tests.worm.designs import PROFILES, misaligned

ANGLES = np.radians([-40.0, -15.0, 0.0, 20.0, 35.0])
ERRORS = {"center_distance_mm": 0.02, "horizontal_deg": 0.02, "vertical_deg": 0.03, "axial_mm": 0.04}
BUILT = [*((p, p) for p in PROFILES), ("ZK", "ZN")]

#: The others are derived and compiled when they are first asked for.
PAIRS = quick([*BUILT, ("ZI", "ZC"), ("ZN", "ZA")], *BUILT)
SHAFT_ANGLES = (60.0, 90.0, 115.0)


def _solved(tables, angles=ANGLES):
    result = Drive.from_tables(tables).tca(angles)
    assert set(result.status) == {"converged"}
    return result


@pytest.mark.parametrize("shaft_angle", SHAFT_ANGLES)
@pytest.mark.parametrize("worm, hob", PAIRS)
def test_a_left_hand_drive_is_the_mirror_image(worm, hob, shaft_angle):
    right = _solved(misaligned(worm, hob, shaft_angle, ERRORS))
    left = _solved(misaligned(worm, hob, shaft_angle, ERRORS, hand="left"), -ANGLES)
    assert np.allclose(left.error, -right.error, rtol=0, atol=1e-18)
    assert np.allclose(left.points, right.points * [1, -1, 1], rtol=0, atol=1e-14)
    assert np.allclose(left.normals, right.normals * [1, -1, 1], rtol=0, atol=1e-15)
    assert np.allclose(left.curvatures, right.curvatures, rtol=1e-12)


@pytest.mark.parametrize("shaft_angle", SHAFT_ANGLES)
@pytest.mark.parametrize("worm, hob", PAIRS)
def test_a_half_turn_about_the_common_perpendicular_swaps_the_flanks(worm, hob, shaft_angle):
    turned = ERRORS | {key: -ERRORS[key] for key in ("vertical_deg", "axial_mm")}
    right = _solved(misaligned(worm, hob, shaft_angle, ERRORS))
    left = _solved(misaligned(worm, hob, shaft_angle, turned, flank="left"), -ANGLES)
    assert np.allclose(left.error, -right.error, rtol=0, atol=1e-14)
    assert np.allclose(left.wheel_angles, -right.wheel_angles, rtol=0, atol=1e-14)
    assert np.allclose(left.points, right.points * [1, -1, -1], rtol=0, atol=1e-8)
    assert np.allclose(left.curvatures, right.curvatures, rtol=1e-7)


@pytest.mark.parametrize("scale", [0.01, 8.0, 300.0])
@pytest.mark.parametrize("worm, hob", PAIRS)
def test_angles_do_not_depend_on_size(worm, hob, scale):
    tables = misaligned(worm, hob, 65.0, ERRORS)
    lengths = {
        f"{table}.{key}": value * scale
        for table in ("design", "misalignment")
        for key, value in tables[table].items()
        if key.endswith("_mm")
    }
    small, large = _solved(tables), _solved(changed(tables, lengths))
    assert np.allclose(large.error, small.error, rtol=0, atol=1e-14)
    assert np.allclose(large.points, scale * small.points, rtol=0, atol=1e-8 * scale)
    assert np.allclose(large.curvatures * scale, small.curvatures, rtol=1e-7)
