"""Differentiable contact analysis: its values against the C solver, its derivatives against 50-digit differences."""

import casadi
import mpmath
import numpy as np
import pytest

from meshwright import Drive, design, differentiable
from meshwright.errors import UsageError
from tests.independent.recess_action import Paper

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


@pytest.mark.parametrize("name", design.packaged_names())
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
        assert np.array(seen["semi_axes"]).ravel() == pytest.approx(solved.semi_axes[k], rel=1e-10)
        assert float(seen["residual"]) < 1e-11


@pytest.mark.parametrize("name", [n for n in design.packaged_names() if not n.startswith("face-worm")])
def test_a_design_is_completed_as_when_it_is_read(name):
    checked = Drive.load(name).design
    p = np.array(differentiable.parameters(checked, ())(casadi.DM(0, 1))).ravel()
    assert p == pytest.approx(checked.parameters, rel=1e-15, nan_ok=True)


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


def test_designs_completed_by_equations_are_refused():
    with pytest.raises(UsageError, match="by solving equations"):
        differentiable.parameters(Drive.load("face-worm-conical-convex").design, ())
