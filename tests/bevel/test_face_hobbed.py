"""Face-hobbed pairs: conjugate and crowned ones in closed form, teeth that are epicycloids, what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.errors import DesignError
from tests.bevel.exact import crown_pair, formate_cradle
from tests.bevel.test_exact import ARCSEC, HANDS, path
from tests.quick import quick

GROUPS = 13


def hobbed(flank="convex", **kind):
    return Drive.from_tables(crown_pair(flank, blade_groups=GROUPS, **kind))


@pytest.mark.parametrize(("flank", "hand"), quick(HANDS, HANDS[0]))
def test_a_pair_hobbed_by_one_crown_gear_touches_along_lines_and_runs_true(flank, hand):
    found = path(hobbed(flank, hand=hand))
    assert set(found.status) == {"line_contact"}
    assert np.abs(found.error).max() < 1e-9 * ARCSEC


@pytest.mark.parametrize(("flank", "hand"), HANDS)
@pytest.mark.parametrize(("crowned", "fixed"), [({"lengthwise": 2.0}, "theta"), ({"profile": 0.002}, "u")])
def test_crowning_in_one_direction_makes_points_without_error(flank, hand, crowned, fixed):
    """Another cutter of the same blade groups, its blade normal to the tooth, or a blade that is an arc."""
    found = path(hobbed(flank, hand=hand, **crowned))
    assert set(found.status) == {"converged"}
    assert np.ptp(found.error) < 1e-9 * ARCSEC  # another cutter cuts its tooth at an angle of its own
    assert (found.curvatures[:, 0] > 0).all()
    for member in ("pinion", "gear"):
        assert np.ptp(found.unknowns[f"{fixed}_{member}"]) < 1e-9
    assert not any("undercut" in flags for flags in found.flags)


@pytest.mark.parametrize(("flank", "hand"), HANDS)
def test_crowned_both_ways_the_gear_lags_on_both_sides(flank, hand):
    found = path(hobbed(flank, hand=hand, lengthwise=2.0, profile=0.002), points=17)
    drives = (1 if flank == "convex" else -1) * (1 if hand == "left" else -1)
    error = drives * found.error
    assert error.argmax() not in (0, len(error) - 1)
    assert np.ptp(error) > ARCSEC
    assert (np.diff(error, 2) < 0).all()


def test_the_other_hand_is_the_mirror_image():
    errors = {"offset_mm": 0.05, "pinion_axial_mm": -0.04, "gear_axial_mm": 0.03, "shaft_angle_deg": 0.02}
    left, right = (
        hobbed(lengthwise=2.0, profile=0.002, hand=hand).with_(misalignment=errors) for hand in ("left", "right")
    )
    angles = left.design.reference_angle + np.linspace(-0.15, 0.15, 5)
    a, b = left.tca(angles), right.tca(-angles)
    assert set(a.status) == {"converged"}
    np.testing.assert_allclose(b.error, -a.error, atol=1e-15)
    np.testing.assert_allclose(b.points, a.points * [1, -1, 1], atol=1e-12)


@pytest.mark.parametrize(("member", "h"), [("pinion", -1), ("wheel", 1)])
def test_in_the_developed_pitch_cone_a_tooth_is_an_extended_epicycloid(member, h):
    """The pitch cone rolls on the pitch plane: what the reference point cuts on their common line stands in the cone,
    developed, where it stands in the crown gear. There the point, at the radius r of a circle that rolls on another
    one by N_b/N_c of its turn, describes the epicycloid S_r e^{i ν θ} + r e^{i (1 + ν) θ}.
    """
    drive = hobbed()
    table = drive.design.tables["pinion" if member == "pinion" else "gear"]
    teeth = drive.design.tables["design"]["pinion_teeth" if member == "pinion" else "gear_teeth"]
    cone, rolled = np.radians(table["pitch_angle_deg"]), table["ratio_of_roll"]
    turns = GROUPS * np.sin(cone) / teeth
    u = table["blade_reference_mm"]
    q, theta = np.radians(table["cradle_angle_deg"]), np.linspace(-2.3, -1.8, 7)
    drawn = table["radial_setting_mm"] + 76.2 * np.exp(1j * theta)  # on the head, before the cradle and the crown turn
    phi = -q - np.angle(drawn)  # of the cradle, which brings the point to the common line
    found = drive.flank(member)(np.column_stack([np.full_like(theta, u), theta, phi]))
    x, y, z = found.points.T
    distance = (z + 0.0) / np.cos(cone)
    np.testing.assert_allclose(np.hypot(x, y), z * np.tan(cone), rtol=1e-13)
    np.testing.assert_allclose(distance, np.abs(drawn), rtol=1e-13)
    assert np.abs(found.conditions[:, 0, 0]).max() < 1e-12
    developed = distance * np.exp(1j * h * np.arctan2(y, x) / rolled)
    crown = drawn * np.exp(1j * (q + turns * theta))
    apart = np.unwrap(np.angle(developed / crown), period=2 * np.pi / rolled)
    np.testing.assert_allclose(np.ptp(apart), 0.0, atol=1e-13)


def test_a_cutter_without_blade_groups_mills():
    """N_b = 0 and a blade in the plane of the axis, put into the solver of face-hobbed pairs: the milled pair."""
    crowned = {"lengthwise": 3.0, "profile": 0.002}
    tables = crown_pair(**crowned)
    for member, reference in (("pinion", 3.9), ("gear", 2.0)):
        tables[member] |= {"blade_reference_mm": reference, "tilt_deg": 0.05, "roll_2c": 0.01}
    milled = Drive.from_tables(tables)
    tables["design"]["blade_groups"] = GROUPS
    design = Drive.from_tables(tables).design
    parameters = design.parameters.copy()
    parameters[[p["key"] for p in design.description["parameters"]].index("blade_groups")] = 0.0
    still = Drive(replace(design, parameters=parameters))
    angles = milled.design.reference_angle + np.radians(np.linspace(-6.0, 6.0, 5))
    a, b = milled.tca(angles), still.tca(angles)
    assert set(a.status) == set(b.status) == {"converged"}
    np.testing.assert_allclose(b.error, a.error, atol=1e-10 * ARCSEC)
    np.testing.assert_allclose(b.points, a.points, atol=1e-11)
    np.testing.assert_allclose(b.curvatures, a.curvatures, rtol=1e-9)


def test_past_the_edge_of_regression_the_flank_turns_over():
    """A pinion of six teeth is undercut: there its points, followed over u and θ, run round the other way, but where
    the equation of meshing falls with φ_c instead of rising, in which u and θ then run the other way themselves.
    """
    flank = hobbed(lengthwise=2.0, teeth=(6, 44)).flank("pinion")
    places = [(u, theta) for u in (-2.0, 0.0, 1.0, 3.0, 6.0) for theta in (-2.2, -2.0, -1.8)]
    at = [cut(flank, *place) for place in places]
    found = flank(at)
    assert 0 < (found.regular < 0).sum() < len(places)
    step = 1e-4
    for k, (u, theta) in enumerate(places):
        ends = flank([cut(flank, u + a * step, theta + b * step) for a, b in ((1, 0), (-1, 0), (0, 1), (0, -1))]).points
        rise = flank([at[k] + [0.0, 0.0, step]]).conditions[0, 0, 0]
        round_ = found.normals[k] @ np.cross(ends[0] - ends[1], ends[2] - ends[3])
        assert np.sign(found.regular[k]) == -np.sign(rise * round_)


def cut(flank, u, theta):
    """(u, θ, φ_c) at which a point of the edge cuts the flank, by bisection of the equation of meshing."""
    low, high = (np.array([u, theta, turn]) for turn in (-1.5, 1.5))
    below = flank([low]).conditions[0, 0, 0]
    assert below * flank([high]).conditions[0, 0, 0] < 0
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (middle, high) if below * flank([middle]).conditions[0, 0, 0] > 0 else (low, middle)
    return low


@pytest.mark.parametrize(
    ("change", "refused", "reason"),
    [
        ({"pinion": {"blade_offset_angle_deg": 5.0}}, "pinion.blade_offset_angle_deg", "blade_groups is 1 or more"),
        ({"design": {"blade_groups": -1}}, "design.blade_groups", "must not be less than 0"),
        ({"design": {"blade_groups": 2.5}}, "design.blade_groups", "whole number"),
        ({"design": {"blade_groups": 13}, "gear": {"blade_offset_angle_deg": 91.0}}, "gear.blade_offset_angle_deg",
         "less than 90"),
    ],
)  # fmt: skip
def test_what_cannot_be_hobbed_is_refused(change, refused, reason):
    tables = crown_pair(lengthwise=2.0)
    for table, entries in change.items():
        tables[table] |= entries
    with pytest.raises(DesignError) as error:
        Drive.from_tables(tables)
    assert str(error.value).startswith(refused)
    assert reason in str(error.value)


def test_a_formate_gear_is_not_hobbed():
    tables = formate_cradle()
    tables["design"]["blade_groups"] = GROUPS
    with pytest.raises(DesignError) as error:
        Drive.from_tables(tables)
    assert "gear.method" in str(error.value)
    assert "design.blade_groups = 13" in str(error.value)


def test_without_blade_groups_a_design_is_milled():
    tables = crown_pair(lengthwise=2.0)
    tables["design"]["blade_groups"] = 0
    assert Drive.from_tables(tables).design.description["name"] == "bevel_generated"
