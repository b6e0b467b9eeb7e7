"""Contact of the face worm drive: what its geometry must give, against closed form and 50-digit arithmetic."""

import math
from itertools import product

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from tests.face_worm.designs import ERRORS, NAMES, UNKNOWNS, changed, driving, independent
from tests.quick import quick

ARCSEC = math.pi / 648000
LATER = pytest.mark.validate


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("rule", ["mid", "cones"])
def test_without_plunge_and_errors_there_is_no_transmission_error_and_contact_keeps_to_the_middle_line(name, rule):
    for crown in (0.002, 0.05):
        drive = changed(
            name, {"plunge_mm_per_rad2": 0.0, "blade_parabola_per_mm": crown, "pitch_point_rule": rule}
        )
        result = drive.tca(np.radians(np.arange(-400.0, 401.0, 80.0)))
        assert set(result.status) == {"converged"}
        assert np.max(np.abs(result.error)) < 1e-9 * ARCSEC
        assert np.max(np.abs(result.unknowns["u_worm"])) < 1e-11
        assert np.max(np.abs(result.unknowns["u_gear"])) < 1e-11
        assert np.allclose(result.unknowns["psi_worm"], result.angles, rtol=0, atol=1e-12)
        assert np.allclose(result.unknowns["theta_worm"], result.unknowns["theta_gear"], rtol=0, atol=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_gear_lags_along_a_parabola_with_its_vertex_in_the_middle(name):
    drive = Drive.load(name)
    angles = np.linspace(-0.5, 0.5, 21) * drive.pitch()
    error = drive.tca(angles).relative_error / ARCSEC
    lag = -driving(drive) * error
    assert lag[10] == 0.0 and np.all(np.delete(lag, 10) > 0)
    square, line, _ = np.polyfit(angles, lag, 2)
    assert abs(line / (2 * square)) < 0.1 * drive.pitch()
    assert np.max(np.abs(np.polyval([square, line, 0], angles) - lag)) < 0.05 * np.max(lag)
    assert 5 < np.max(lag) < 50


@pytest.mark.parametrize("name", NAMES)
def test_path_of_contact_is_longitudinal(name):
    """The radius runs across the whole face; |u| on the gear stays below 0.25 mm for a turn of the worm to either side.

    Another pair leads from half a pitch on, a quarter of a turn; under the report's 50 N m a pair carries up to seven
    eighths of a turn. Towards the ends of the face |u| grows with the square of the turn: up to 0.64 mm on the conical
    concave side.
    """
    drive = Drive.load(name)
    result = drive.tca(np.radians(np.arange(-700.0, 701.0, 5.0)))
    radius = np.hypot(*result.body_points["wheel"][:, :2].T)
    inside = np.array(["off_face" not in flags for flags in result.flags])
    inner, outer = drive.design.value("gear_inner_radius_mm"), drive.design.value("gear_outer_radius_mm")
    assert np.array_equal(inside, (radius > inner) & (radius < outer))
    assert np.ptp(radius[inside]) > 0.95 * (outer - inner)
    turn = inside & (np.abs(result.angles) <= 2 * np.pi)
    assert np.ptp(radius[turn]) > 0.4 * (outer - inner)
    assert np.max(np.abs(result.unknowns["u_gear"][turn])) <= 0.25


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("signs", quick([((0, 0, 0),), ((1, 1, 1),), ((-1, 1, -1),)], ((1, 1, 1),)))
def test_double_precision_agrees_with_fifty_digits(name, signs):
    errors = {key: sign * value for (key, value), sign in zip(ERRORS.items(), signs, strict=True)}
    for rule in ("mid", "cones") if signs == (0, 0, 0) else ("mid",):
        drive = changed(name, {"pitch_point_rule": rule}, errors)
        angles = np.radians([-130.0, 210.0])
        result = drive.tca(angles)
        with mpmath.workdps(50):
            twin = independent(drive)
            for k, angle in enumerate(angles):
                start = [result.unknowns[u][k] for u in UNKNOWNS]
                exact = twin.contact(mpmath.mpf(angle), [*start, result.wheel_angles[k]])
                error = exact[5] - mpmath.mpf(angle) * twin.ratio
                assert abs(float(error - mpmath.mpf(result.error[k]))) < 1e-10 * ARCSEC
                assert np.allclose([float(x) for x in exact[:5]], start, rtol=0, atol=1e-10)
                point, normal = twin.in_mesh(*exact[:3], mpmath.mpf(angle))
                assert np.allclose([float(c) for c in point], result.points[k], rtol=0, atol=1e-10)
                assert np.allclose([-float(c) for c in normal], result.normals[k], rtol=0, atol=1e-11)


@pytest.mark.parametrize("name", NAMES[:2])
def test_both_backends_agree(name):
    angles = np.radians([-200.0, 0.0, 170.0])
    errors = {"misalignment": ERRORS}
    c, casadi = (Drive.load(name, backend).with_(**errors).tca(angles) for backend in ("c", "casadi"))
    assert np.allclose(c.error, casadi.error, rtol=0, atol=1e-12)
    assert np.allclose(c.points, casadi.points, rtol=0, atol=1e-10)


def test_straight_blade_without_plunge_touches_along_a_line():
    """Worm and gear are then cut by one and the same cone."""
    drive = changed(NAMES[0], {"plunge_mm_per_rad2": 0.0, "blade_parabola_per_mm": 0.0})
    result = drive.tca(np.radians([-100.0, 0.0, 100.0]))
    assert set(result.status) == {"line_contact"}
    assert np.max(np.abs(result.error)) < 1e-9 * ARCSEC


@pytest.mark.parametrize(
    ("design", "errors", "status", "flags"),
    [
        ({"blade_parabola_per_mm": 0.0}, {}, {"edge_contact"}, set()),
        pytest.param({"blade_parabola_per_mm": 1e-6}, {"offset_mm": 0.1}, {"edge_contact"}, set(), marks=LATER),
        pytest.param({"blade_parabola_per_mm": 0.0, "plunge_mm_per_rad2": 0.0}, {"offset_mm": 0.1}, {"edge_contact"},
                     set(), marks=LATER),
        ({"blade_parabola_per_mm": -0.01}, {}, {"converged"}, {"interference"}),
    ],  # fmt: skip
)
def test_uncrowned_blades_touch_on_an_edge_and_hollow_ones_interfere(design, errors, status, flags):
    """Without crowning, plunge or errors drive the contact off the profile, to its end."""
    result = changed(NAMES[0], design, errors).tca(np.radians([-180.0, -90.0, 90.0, 180.0]))
    assert set(result.status) == status
    assert set().union(*result.flags) == flags


@pytest.mark.parametrize("name", NAMES)
def test_aligned_designs_do_not_run_on_an_edge(name):
    assert _edge_flags(name, (0, 0, 0)) == {False}


@pytest.mark.parametrize("name", [n for n in NAMES if n.endswith("convex")])
def test_convex_side_absorbs_all_errors(name):
    """For all signs of the three errors the gear lags on both sides of a vertex inside the path."""
    for signs in SIGNS:
        assert _edge_flags(name, signs) == {False}


@pytest.mark.parametrize("name", [n for n in NAMES if n.endswith("concave")])
def test_concave_side_says_where_it_does_not_absorb_them(name):
    """Some signs move the vertex out of the path; every point of the pair is then flagged and keeps its numbers."""
    flags = [_edge_flags(name, signs) for signs in SIGNS]
    assert all(len(f) == 1 for f in flags)
    assert {True} in flags and {False} in flags


SIGNS = tuple(product((-1, 1), repeat=3))


def _edge_flags(name, signs):
    """Whether points inside the face are flagged; checked against the extreme of the error over the whole path."""
    errors = {key: sign * value for (key, value), sign in zip(ERRORS.items(), signs, strict=True)}
    drive = changed(name, misalignment=errors)
    result = drive.tca(np.radians(np.arange(-900.0, 901.0, 10.0)))
    outside = np.flatnonzero(["off_face" in flags for flags in result.flags])
    middle = len(result.angles) // 2
    inside = slice(outside[outside < middle][-1] + 1, outside[outside > middle][0])
    ahead = driving(drive) * result.error[inside]
    at_an_end = int(np.argmax(ahead)) in (0, len(ahead) - 1)
    flagged = {"edge_contact" in flags for flags in result.flags[inside]}
    assert flagged == {at_an_end}
    assert np.all(np.isfinite(result.error[inside]))
    return flagged
