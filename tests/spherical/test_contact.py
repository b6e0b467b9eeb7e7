"""Contact of spherical gears: against 50 digits, closed forms, and the report's statements."""

import math

import mpmath
import numpy as np
import pytest

from meshwright.contact.results import ARCSEC
from tests.independent.spherical import Gear, Pair, involute
from tests.quick import quick

#: Pairs that touch in a point: (forms, sphere radii).
POINT_CONTACT = [
    ("convex", "convex", 72.0, 144.0),
    ("convex", "concave", 72.0, 144.0),
    ("convex", "spur", 72.0, None),
    ("concave", "convex", 144.0, 72.0),
    ("spur", "convex", None, 72.0),
]


def _pair(pair, forms, radii, **changes):
    names = ("pinion_sphere_radius_mm", "wheel_sphere_radius_mm")
    return pair(*forms, **{name: r for name, r in zip(names, radii, strict=True) if r}, **changes)


def _exact(forms, radii, s, misalignment, module=4):
    alpha = mpmath.radians(20)
    gears = [
        Gear(module, teeth, alpha, form, radius and mpmath.mpf(radius), s)
        for teeth, form, radius in zip((36, 72), forms, radii, strict=True)
    ]
    return Pair(
        *gears,
        dc=mpmath.mpf(misalignment.get("center_distance_mm", 0)),
        dh=mpmath.radians(misalignment.get("horizontal_deg", 0)),
        dv=mpmath.radians(misalignment.get("vertical_deg", 0)),
    )


@pytest.mark.parametrize("flank", ["left", "right"])
@pytest.mark.parametrize(("pinion", "wheel", "r1", "r2"), quick(POINT_CONTACT, *POINT_CONTACT[:-1]))
def test_contact_agrees_with_fifty_digits(pair, pinion, wheel, r1, r2, flank):
    errors = {"center_distance_mm": 0.25, "horizontal_deg": 0.125, "vertical_deg": -0.5}
    drive = _pair(pair, (pinion, wheel), (r1, r2), flank=flank, misalignment=errors)
    result = drive.tca([0.0625])
    assert result.status == ("converged",)
    values = [*(result.unknowns[name][0] for name in list(result.unknowns)[:4]), result.error[0]]
    with mpmath.workdps(50):
        exact = _exact((pinion, wheel), (r1, r2), 1 if flank == "left" else -1, errors)
        exact = exact.refined(mpmath.mpf("0.0625"), values)
    assert values == pytest.approx([float(x) for x in exact], rel=1e-12, abs=1e-13)


@pytest.mark.parametrize(
    ("module", "forms", "radii", "errors"),
    [
        (0.1, ("convex", "convex"), (20.0, 20.0), (0.005, 0.1, 0.2)),
        (0.1, ("convex", "convex"), (1e7, 1e7), (0.001, 1e-8, 1e-7)),
        (4.0, ("convex", "concave"), (5e6, 1e7), (0.1, 1e-6, 1e-5)),
        (50.0, ("convex", "spur"), (1e7, None), (1.0, 1e-5, 1e-5)),
    ],
)
def test_extreme_sizes_agree_with_fifty_digits(pair, module, forms, radii, errors):
    keys = ("center_distance_mm", "horizontal_deg", "vertical_deg")
    misalignment = dict(zip(keys, errors, strict=True))
    drive = _pair(pair, forms, radii, module_mm=module, face_width_mm=2 * module, misalignment=misalignment)
    result = drive.tca([0.03])
    found = [*(result.unknowns[name][0] for name in list(result.unknowns)[:4]), result.error[0]]
    with mpmath.workdps(50):
        exact = _exact(forms, radii, 1, misalignment, module)
        exact = [float(x) for x in exact.refined(mpmath.mpf(0.03), found)]
    assert found[:4] == pytest.approx(exact[:4], rel=1e-13)
    assert found[4] == pytest.approx(exact[4], abs=1e-15)


def test_both_backends_agree(pair):
    drive = pair("convex", "concave", misalignment={"center_distance_mm": 0.2, "horizontal_deg": 0.2})
    other = type(drive)(drive.design, "casadi")
    angles = np.radians([-4.0, 0.0, 5.0])
    assert other.tca(angles).error == pytest.approx(drive.tca(angles).error, abs=1e-14)


def test_semi_axes_at_the_pitch_point(pair):
    axes = [pair("convex", wheel).tca([0.0]).semi_axes[0] for wheel in ("convex", "spur", "concave")]
    assert [minor for _, minor in axes] == pytest.approx([0.4555] * 3, abs=5e-5)
    assert [major for major, _ in axes] == pytest.approx([1.332, 1.631, 2.307], abs=5e-4)


@pytest.mark.parametrize(("pinion", "wheel", "r1", "r2"), quick(POINT_CONTACT, *POINT_CONTACT[:-1]))
def test_relative_curvatures_at_the_pitch_point_in_closed_form(pair, pinion, wheel, r1, r2):
    result = _pair(pair, (pinion, wheel), (r1, r2)).tca([0.0])
    sense = {"convex": 1.0, "concave": -1.0}
    across = sum(sense[form] / r for form, r in ((pinion, r1), (wheel, r2)) if r)
    alpha = math.radians(20)
    expected = [math.sin(alpha) * across, (1 / 72 + 1 / 144) / math.sin(alpha)]
    assert result.curvatures[0] == pytest.approx(expected, rel=1e-12)
    assert np.abs(result.major[0]) == pytest.approx([0, 0, 1], abs=1e-10)


def _random_designs(count):
    """Designs of every size; the axes are tilted by as much as moves contact about a third of the face."""
    rng = np.random.default_rng(20)
    forms = [("convex", "convex"), ("convex", "concave"), ("convex", "spur"), ("concave", "convex")]
    for _ in range(count):
        pinion, wheel = forms[rng.integers(len(forms))]
        module, teeth, alpha = 10 ** rng.uniform(-1, 1.7), rng.integers(18, 120, 2), rng.uniform(12, 30)
        small = rng.uniform(10, 60) * module
        large = small * rng.uniform(1.2, 3)
        radii = (large, small) if pinion == "concave" else (small, large)
        senses = [{"convex": 1, "concave": -1, "spur": 0}[form] for form in (pinion, wheel)]
        across = sum(sense / radius for sense, radius in zip(senses, radii, strict=True))
        tilt = math.degrees(module * across * math.tan(math.radians(alpha)))
        yield (
            (pinion, wheel),
            (radii[0], None if wheel == "spur" else radii[1]),
            {
                "module_mm": module, "pinion_teeth": int(teeth[0]), "wheel_teeth": int(teeth[1]),
                "pressure_angle_deg": alpha, "face_width_mm": 4 * module, "flank": ("left", "right")[rng.integers(2)],
                "misalignment": {
                    "center_distance_mm": rng.uniform(-0.02, 0.1) * module,
                    "horizontal_deg": rng.uniform(-1, 1) * tilt, "vertical_deg": rng.uniform(-1, 1) * tilt,
                },
            },
        )  # fmt: skip


def test_no_misalignment_makes_the_transmission_error_vary(pair):
    for forms, radii, changes in _random_designs(60):
        drive = _pair(pair, forms, radii, **changes)
        result = drive.tca(np.linspace(-0.5, 0.5, 5) * drive.pitch())
        assert result.status == ("converged",) * 5, (forms, radii, changes)
        assert np.ptp(result.error) / ARCSEC < 1e-7, (forms, radii, changes)


def test_path_of_contact_is_straight_at_constant_angle_of_the_arc(pair):
    drive = pair("convex", "concave", misalignment={"horizontal_deg": 0.3, "vertical_deg": 1.0})
    angles = np.linspace(-0.08, 0.08, 9)
    result = drive.tca(angles)
    assert np.ptp(result.unknowns["theta_pinion"]) < 1e-13
    assert np.ptp(result.unknowns["theta_wheel"]) < 1e-13
    assert np.ptp(result.normals, axis=0) == pytest.approx([0, 0, 0], abs=1e-13)
    assert np.diff(result.unknowns["l_pinion"]) == pytest.approx(72 * math.sin(math.radians(20)) * 0.02, rel=1e-11)
    assert np.diff(result.unknowns["l_wheel"]) == pytest.approx(-72 * math.sin(math.radians(20)) * 0.02, rel=1e-11)


@pytest.mark.parametrize("wheel", ["convex", "concave", "spur"])
@pytest.mark.parametrize(("flank", "s"), [("left", 1), ("right", -1)])
@pytest.mark.parametrize("error", [-0.5, 0.01, 3.0])
def test_centre_distance_error_alone_gives_the_involute_offset(pair, wheel, flank, s, error):
    drive = pair("convex", wheel, flank=flank, misalignment={"center_distance_mm": error})
    alpha = math.radians(20)
    working = math.acos(216 * math.cos(alpha) / (216 + error))
    expected = -s * 1.5 * (involute(working) - involute(alpha))
    assert drive.tca([0.0]).error[0] == pytest.approx(float(expected), abs=1e-14)


def test_the_flanks_are_mirror_images(pair):
    errors = {"center_distance_mm": 0.1, "horizontal_deg": 0.2, "vertical_deg": 0.7}
    left = pair("convex", "concave", misalignment=errors).tca([0.05])
    mirrored = errors | {"horizontal_deg": -0.2}
    right = pair("convex", "concave", flank="right", misalignment=mirrored).tca([-0.05])
    for name in ("l_pinion", "theta_pinion", "l_wheel", "theta_wheel"):
        assert right.unknowns[name] == pytest.approx(left.unknowns[name], abs=1e-13)
    assert right.error == pytest.approx(-left.error, abs=1e-14)


def test_a_small_horizontal_error_moves_contact_as_the_law_says(pair):
    turn = 1e-4
    for wheel, across in (("convex", 1 / 72 + 1 / 144), ("concave", 1 / 72 - 1 / 144), ("spur", 1 / 72)):
        result = pair("convex", wheel, misalignment={"horizontal_deg": math.degrees(turn)}).tca([0.0])
        expected = -turn / math.tan(math.radians(20)) / across
        assert result.body_points["pinion"][0, 2] == pytest.approx(expected, rel=1e-3)


def test_contact_stays_near_mid_face_at_a_vertical_error_of_two_degrees(pair):
    for wheel in ("convex", "concave", "spur"):
        result = pair("convex", wheel, misalignment={"vertical_deg": 2.0}).tca([0.0])
        assert abs(result.body_points["wheel"][0, 2]) < 0.5
        assert result.flags == ((),)


@pytest.mark.parametrize("radius", [1e3, 1e4, 1e5, 1e6, 1e7])
def test_a_large_sphere_tends_to_a_spur_gear(pair, radius):
    errors = {"center_distance_mm": 0.1, "vertical_deg": 0.5}
    spur = pair("convex", "spur", misalignment=errors).tca([0.05])
    for form in ("convex", "concave"):
        result = pair("convex", form, wheel_sphere_radius_mm=radius, misalignment=errors).tca([0.05])
        assert result.error == pytest.approx(spur.error, abs=2e-3 / radius)
        assert result.curvatures[0] == pytest.approx(spur.curvatures[0], rel=200 / radius)


@pytest.mark.parametrize("module", [0.1, 1.0, 50.0])
@pytest.mark.parametrize("radius", [20.0, 1e3, 1e7])
def test_every_size_is_solved(pair, module, radius):
    if radius < 4 * module:
        pytest.skip("the arc does not reach the face")
    drive = pair(
        "convex", "convex", module_mm=module, face_width_mm=module, pinion_sphere_radius_mm=radius,
        wheel_sphere_radius_mm=1.5 * radius,
        misalignment={"center_distance_mm": 0.02 * module, "vertical_deg": 0.1, "horizontal_deg": 1e-7},
    )  # fmt: skip
    result = drive.tca([-0.05, 0.0, 0.05])
    assert result.status == ("converged",) * 3
    assert np.ptp(result.error) / ARCSEC < 1e-7
