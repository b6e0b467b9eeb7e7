"""What modifications and misalignments do, by first-order formulae and symmetries."""

import math

import numpy as np
import pytest

from meshwright import Drive
from tests.cylindrical_gears.designs import ARCSEC, tables

SPUR = {"pinion_teeth": 21, "wheel_teeth": 43}
HELICAL = {**SPUR, "pinion_helix_angle_deg": 18.0}
ANGLES = np.radians([-6.0, -2.0, 0.0, 3.0, 7.0])


def trace(design, angles=ANGLES, errors=None, flank="left"):
    found = Drive.from_tables(tables(design, errors, flank)).tca(angles)
    assert set(found.status) == {"converged"}
    return found


@pytest.mark.parametrize("flank, s", [("left", 1), ("right", -1)])
@pytest.mark.parametrize("errors", [{"vertical_deg": 0.01}, {"horizontal_deg": 0.01}, {"vertical_deg": -0.01}])
def test_a_crowned_spur_pair_touches_where_the_axes_errors_put_it(errors, flank, s):
    """Z = −(Δv sin α_w + s Δh cos α_w)/κ with κ = 8 (C_β1/b1² + C_β2/b2²), to first order in the error.

    The tilt shifts the wheel along its axis where they touch: of both places the mean, weighted by the crowning.
    """
    design = {**SPUR, "pinion_lead_crowning_um": 8.0, "wheel_lead_crowning_um": 5.0}
    tilt = {key: math.radians(errors.get(f"{key}_deg", 0.0)) for key in ("vertical", "horizontal")}
    alpha, curvatures = math.radians(20.0), 8.0 * np.array([0.008, 0.005]) / 20.0**2
    place = -(tilt["vertical"] * math.sin(alpha) + s * tilt["horizontal"] * math.cos(alpha)) / curvatures.sum()
    found = trace(design, np.array([0.0]), errors, flank)
    places = [found.unknowns[f"z_{name}"][0] for name in ("pinion", "wheel")]
    assert np.average(places, weights=curvatures) == pytest.approx(place, rel=2e-3)


def test_lead_crowning_alone_leaves_a_parallel_pair_without_error():
    """Contact in the middle of the face; the curvature along it is 8 (C_β1/b1² + C_β2/b2²) cos² β_b."""
    found = trace({**HELICAL, "pinion_lead_crowning_um": 6.0, "wheel_lead_crowning_um": 9.0})
    assert np.abs(found.error).max() < 1e-9 * ARCSEC
    assert np.abs(found.unknowns["z_pinion"]).max() < 1e-7
    base = math.asin(math.sin(math.radians(18.0)) * math.cos(math.radians(20.0)))
    expected = 8.0 * (0.006 + 0.009) / 20.0**2 * math.cos(base) ** 2
    assert found.curvatures[:, 0] == pytest.approx(expected, rel=3e-3)


@pytest.mark.parametrize("flank, s", [("left", 1), ("right", -1)])
def test_the_error_is_the_depth_of_the_modifications(flank, s):
    """TE ≈ −s (E1 + E2)/(r_b2 cos β_b2) on spur gears with lead crowning to hold the contact in mid face."""
    design = {**SPUR, "pinion_lead_crowning_um": 4.0, "pinion_profile_crowning_um": 0.3, "wheel_tip_relief_um": 0.5,
              "wheel_tip_relief_radius_mm": 64.5, "pinion_profile_slope_um": -0.2}  # fmt: skip
    found = trace(design, flank=flank)
    solved = Drive.from_tables(tables(design)).design.as_solved()["design"]
    start, end = solved["pinion_edge_start_mm"], solved["pinion_edge_end_mm"]
    u = (2.0 * found.unknowns["l_pinion"] - end - start) / (end - start)
    depth = 0.0003 * u**2 - 0.0002 * u / 2.0
    base, alpha = solved["wheel_base_radius_mm"], math.radians(20.0)
    begin = (math.sin(alpha) * (math.sqrt(64.5**2 - base**2) - 64.5 * math.sin(alpha))) / math.cos(alpha)
    share = (found.unknowns["l_wheel"] - begin) / (solved["wheel_edge_end_mm"] - begin)
    depth += 0.0005 * np.maximum(share, 0.0) ** 2
    assert (share > 0.0).any() and (share < 0.0).any()
    assert found.error == pytest.approx(-s * depth / base, rel=5e-3, abs=1e-4 * ARCSEC)


@pytest.mark.parametrize("key", ["profile_slope", "lead_slope"])
def test_a_constant_slope_leaves_a_line_on_crossed_axes(key):
    """Either slope alone leaves an involute helicoid: the error is linear, by the ratio of normal base pitches."""
    design = {"pinion_teeth": 17, "wheel_teeth": 23, "pinion_helix_angle_deg": 40.0, "wheel_helix_angle_deg": 35.0,
              f"pinion_{key}_um": 12.0}  # fmt: skip
    found = trace(design, np.radians([-8.0, -4.0, 0.0, 4.0, 8.0]))
    slopes = np.diff(found.error) / np.diff(found.angles)
    solved = Drive.from_tables(tables(design)).design.as_solved()["design"]
    beta, alpha, length = math.radians(40.0), math.radians(20.0), solved["pinion_edge_end_mm"]
    tilt = 0.012 / (length - solved["pinion_edge_start_mm"]) if key == "profile_slope" else 0.0
    feed = 0.012 / (20.0 * math.cos(alpha) * math.cos(beta)) if key == "lead_slope" else 0.0
    y_l = math.sin(alpha) + tilt * math.cos(alpha)
    x_l = math.cos(alpha) - tilt * math.sin(alpha)
    normal = np.array([y_l / math.cos(beta), x_l, -x_l * (math.tan(beta) - feed)])
    pitch = (normal[1] / np.linalg.norm(normal) / math.cos(beta)) / math.cos(alpha)
    assert slopes == pytest.approx(17.0 / 23.0 * (pitch - 1.0), rel=1e-9, abs=1e-12)
    assert abs(slopes[0]) > 1e-5


def test_profile_crowning_alone_runs_along_the_face_of_a_helical_pair():
    """Screw symmetry: contact at constant l, in the middle of the crowned edge, without transmission error."""
    found = trace({**HELICAL, "pinion_profile_crowning_um": 8.0}, np.radians([-3.0, 0.0, 2.0]))
    solved = Drive.from_tables(tables(HELICAL)).design.as_solved()["design"]
    middle = (solved["pinion_edge_start_mm"] + solved["pinion_edge_end_mm"]) / 2.0
    assert found.unknowns["l_pinion"] == pytest.approx(middle, abs=1e-6)
    assert np.ptp(found.unknowns["z_pinion"]) > 5.0
    assert np.abs(found.error).max() < 1e-9 * ARCSEC


def test_the_mirror_image_negates_the_error():
    """(s, β, Σ, φ, Δh) → −(…): TE negated, lengths and curvatures equal."""
    design = {"pinion_teeth": 19, "wheel_teeth": 31, "pinion_helix_angle_deg": 25.0, "wheel_helix_angle_deg": 15.0,
              "shaft_angle_deg": 39.5, "pinion_lead_crowning_um": 7.0, "wheel_flank_twist_um": 4.0,
              "wheel_profile_crowning_um": 5.0}  # fmt: skip
    errors = {"horizontal_deg": 0.02, "vertical_deg": -0.03, "axial_mm": 0.2, "center_distance_mm": 0.05}
    mirrored = {k: -v if k.endswith(("helix_angle_deg", "shaft_angle_deg")) else v for k, v in design.items()}
    one = trace(design, ANGLES, errors)
    other = trace(mirrored, -ANGLES, {**errors, "horizontal_deg": -0.02}, "right")
    assert other.error == pytest.approx(-one.error, rel=1e-10, abs=1e-9 * ARCSEC)
    assert other.curvatures == pytest.approx(one.curvatures, rel=1e-9)
    assert other.points * [1.0, -1.0, 1.0] == pytest.approx(one.points, abs=1e-9)


def test_reliefs_join_with_a_continuous_error():
    """A relief of exponent 2 or 3 leaves the error smooth where it begins, even exactly there."""
    begin = 33.2
    for exponent in (2, 3):
        design = {**SPUR, "pinion_lead_crowning_um": 4.0, "pinion_tip_relief_um": 20.0, "relief_exponent": exponent,
                  "pinion_tip_relief_radius_mm": begin}  # fmt: skip
        drive = Drive.from_tables(tables(design))
        found = drive.tca(np.radians(np.arange(-6.0, 10.0, 0.25)))
        radii = np.hypot(found.body_points["pinion"][:, 0], found.body_points["pinion"][:, 1])
        before = radii < begin
        assert np.abs(found.error[before]).max() < 1e-9 * ARCSEC
        assert np.all(np.diff(found.error[~before]) < 0.0)
