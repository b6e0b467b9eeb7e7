"""Differentiable contact analysis: its values against the C solver, its derivatives against 50-digit differences."""

import casadi
import mpmath
import numpy as np
import pytest

from meshwright import Drive, differentiable
from meshwright.base.errors import UsageError
from meshwright.design import design
from meshwright.sensitivity import sensitivity
from tests.independent.recess_action import Paper
from tests.quick import ONE_OF_A_KIND, quick

FREE = ("design.hob_pitch_radius_mm", "design.pitch_line_shift_mm", "misalignment.center_distance_mm")
POINT = (20.3, 3.7, 0.05)
PHI = 2.5


def _at(values):
    return Drive.load("recess-action-full").with_(
        design={"hob_pitch_radius_mm": values[0], "pitch_line_shift_mm": values[1]},
        misalignment={"center_distance_mm": values[2]},
    )


@pytest.fixture(scope="module")
def sensitivities():
    """Derivatives of transmission error (3,) and of semi-axes (2, 3) by the free keys, at POINT."""
    drive = _at(POINT)
    v = casadi.MX.sym("v", len(FREE))
    p = differentiable.parameters(drive.design, FREE)(v)
    contact = differentiable.differentiable_tca(drive.design.description)(p=p, phi=PHI, x0=drive.trace([PHI])[0][0])
    slopes = [casadi.jacobian(contact[name], v) for name in ("error", "semi_axes")]
    error, axes = casadi.Function("slopes", [v], slopes)(POINT)
    return np.array(error).ravel(), np.array(axes)


@pytest.mark.parametrize("name", quick(design.packaged_names(), *ONE_OF_A_KIND))
def test_contact_and_curvatures_are_those_of_the_c_solver(name):
    drive = Drive.load(name)
    angles = np.linspace(-0.2, 0.3, 4) * drive.pitch()
    solved = drive.tca(angles)
    tca = differentiable.differentiable_tca(drive.design.description)
    mirror = -1.0 if drive.design.mirrored else 1.0
    for k in np.flatnonzero([word == "converged" for word in solved.status]):
        seen = tca(p=drive.design.parameters, phi=mirror * angles[k], x0=solved.solutions[k] + 1e-5)
        assert np.array(seen["x"]).ravel() == pytest.approx(solved.solutions[k], abs=1e-11)
        assert np.array(seen["curvatures"]).ravel() == pytest.approx(solved.curvatures[k], rel=1e-10)
        assert np.array(seen["semi_axes"]).ravel() == pytest.approx(solved.semi_axes[k], rel=1e-10, nan_ok=True)
        assert float(seen["residual"]) < 1e-11


@pytest.mark.parametrize("name", design.packaged_names())
def test_a_design_is_completed_as_when_it_is_read(name):
    checked = Drive.load(name).design
    p = np.array(differentiable.parameters(checked, ())(casadi.DM(0, 1))).ravel()
    solved = len(checked.description["systems"]) > 0
    assert p == pytest.approx(checked.parameters, rel=1e-11 if solved else 1e-15, nan_ok=True)


def test_what_follows_from_a_free_parameter_follows_it():
    p = np.array(differentiable.parameters(_at((20.0, 4.0, 0.0)).design, FREE)(POINT)).ravel()
    assert p == pytest.approx(_at(POINT).design.parameters, rel=1e-15, nan_ok=True)


def test_derivatives_of_the_transmission_error_agree_with_fifty_digits(sensitivities):
    """Differences of the paper's own system, in which the hob's lead and the cutting set-up follow the hob radius."""
    with mpmath.workdps(50):
        step = mpmath.mpf(10) ** -15
        for k, slope in enumerate(sensitivities[0]):
            above, below = ([mpmath.mpf(v) for v in POINT] for _ in range(2))
            above[k] += step
            below[k] -= step
            exact = (_papers_wheel_angle(above) - _papers_wheel_angle(below)) / (2 * step)
            assert slope == pytest.approx(float(exact), rel=1e-9)


def _papers_wheel_angle(values):
    degree = mpmath.pi / 180
    numbers = {"m_n": 2, "T1": 1, "T2": 277, "lam3": 3 * degree, "alpha": 10 * degree, "sigma": 90 * degree, "s": 1}
    numbers |= dict(zip(("r1", "dx", "dC"), values, strict=True)) | {"dgh": 0, "dgv": 0}
    paper = Paper({key: n if key == "s" else mpmath.mpf(n) for key, n in numbers.items()}, mpmath)
    solved = _at(POINT).tca([PHI])
    u = solved.unknowns
    start = [u["t_hob"], -u["psi_hob"], u["phi_hob"], u["t_worm"], -u["psi_worm"], solved.wheel_angles]
    phi = mpmath.mpf(PHI)
    found = mpmath.findroot(lambda *a: paper.residual(a, phi), [mpmath.mpf(float(x[0])) for x in start], tol=1e-70)
    return found[5]


def test_derivatives_of_the_ellipse_agree_with_differences_of_the_c_solver(sensitivities):
    for k, slope in enumerate(sensitivities[1].T):
        step = 1e-4 * np.eye(len(FREE))[k]
        axes = [_at(np.array(POINT) + n * step).tca([PHI]).semi_axes[0] for n in (-2, -1, 1, 2)]
        difference = (axes[0] - 8 * axes[1] + 8 * axes[2] - axes[3]) / (12 * 1e-4)
        assert slope == pytest.approx(difference, rel=1e-6, abs=1e-9)


def test_what_does_not_converge_is_not_a_number():
    drive = Drive.load("recess-action-full")
    tca = differentiable.differentiable_tca(drive.design.description)
    seen = tca(p=drive.design.parameters, phi=0.0, x0=1e4 * np.arange(1, 6))
    assert not float(seen["residual"]) <= differentiable.RESIDUAL
    for name in ("x", "error", "observation", "curvatures", "semi_axes"):
        assert np.isnan(np.array(seen[name])).all()


def test_an_unknown_place_is_named():
    with pytest.raises(UsageError, match="design.hob_radius: .* use one of .*design.hob_pitch_radius_mm"):
        differentiable.parameters(Drive.load("recess-action-full").design, ("design.hob_radius",))


@pytest.mark.parametrize("free", [("design.hob_pitch_radius_mm",) * 2, "design.hob_pitch_radius_mm"])
def test_places_are_different_ones(free):
    with pytest.raises(UsageError, match="give a tuple of different places"):
        differentiable.parameters(Drive.load("recess-action-full").design, free)


FACE_WORM = ("face-worm-conical-convex", "face-worm-cylindrical-concave")


@pytest.mark.parametrize("name", FACE_WORM)
@pytest.mark.parametrize("given", [{}, {"pitch_point_rule": "cones"}, {"head_cutter_radius_mm": 24.398}])
def test_the_placement_of_the_head_cutter_follows_its_keys(name, given):
    """Derivatives of the completed design and of its contact, against those of the C library."""
    drive = Drive.load(name).with_(design=given)
    exact = sensitivity(drive, [PHI])
    free = [key for key in exact.keys if _given(drive, key)]
    v = casadi.MX.sym("v", len(free))
    p = differentiable.parameters(drive.design, free)(v)
    tca = differentiable.differentiable_tca(drive.design.description)
    error = tca(p=p, phi=PHI, x0=drive.trace([PHI])[0][0])["error"]
    slopes = casadi.Function("slopes", [v], [casadi.jacobian(p, v), casadi.jacobian(error, v)])
    entries = {f"{p['table']}.{p['key']}": p for p in drive.design.description["parameters"]}
    factors = np.array([entries[key]["factor"] for key in free])
    at = [drive.design.value(*reversed(key.split("."))) for key in free] / factors
    of_design, of_error = (np.array(slope) / factors for slope in slopes(at))
    columns = [exact.of(key) for key in free]
    assert np.abs(of_design - exact.design[:, columns]).max() < 1e-9 * np.abs(of_design).max()
    assert of_error.ravel() == pytest.approx(exact.error[0, columns], rel=1e-9, abs=1e-14)


def _given(drive, key):
    table, name = key.split(".")
    return table == "misalignment" or drive.design.tables[table].get(name) is not None


@pytest.mark.parametrize("name", FACE_WORM)
def test_second_derivatives_reach_through_the_placement(name):
    drive, key = Drive.load(name), "design.axial_module_mm"
    v = casadi.MX.sym("v")
    p = differentiable.parameters(drive.design, (key,))(v)
    tca = differentiable.differentiable_tca(drive.design.description)
    error = tca(p=p, phi=PHI, x0=drive.trace([PHI])[0][0])["error"]
    module = drive.design.value("axial_module_mm")
    curvature = float(casadi.Function("second", [v], [casadi.hessian(error, v)[0]])(module))
    slopes = []
    for h in (-2, -1, 1, 2):
        moved = drive.with_(design={"axial_module_mm": module + h * 1e-4})
        result = sensitivity(moved, [PHI])
        slopes.append(result.error[0, result.of(key)])
    difference = (slopes[0] - 8 * slopes[1] + 8 * slopes[2] - slopes[3]) / (12 * 1e-4)
    assert curvature == pytest.approx(difference, rel=1e-5)


def test_a_placement_without_a_regular_solution_is_not_a_number():
    """The offset is too small for a pitch point: the design file is refused, the function gives NaN."""
    drive = Drive.load("face-worm-conical-convex")
    p = np.array(differentiable.parameters(drive.design, ("design.offset_mm",))(1.0)).ravel()
    (place,) = (k for k, q in enumerate(drive.design.description["parameters"]) if q["key"] == "tool_axis_z_z")
    assert np.isnan(p[place])


def test_a_left_hand_drive_turns_the_other_way():
    left = _at(POINT).with_(design={"hand": "left"})
    exact, free = sensitivity(left, [PHI]), FREE
    v = casadi.MX.sym("v", len(free))
    tca = differentiable.differentiable_tca(left.design.description, left.design.mirrored)
    start = left.tca([PHI]).solutions[0]
    error = tca(p=differentiable.parameters(left.design, free)(v), phi=PHI, x0=start)["error"]
    slopes = np.array(casadi.Function("slopes", [v], [casadi.jacobian(error, v)])(POINT)).ravel()
    assert slopes == pytest.approx([exact.error[0, exact.of(key)] for key in free], rel=1e-10)
