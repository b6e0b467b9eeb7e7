"""The shared library as CasADi functions by ``casadi.external``: values, derivatives, and IPOPT on top of them."""

import casadi
import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.library import SHIPPED, library
from meshwright.contact import analysis
from meshwright.design.design import given_vector
from meshwright.sensitivity import sensitivity

DESIGNS = ("recess-action-full", "plain-zk", "spherical-table-4-4-convex", "face-worm-conical-convex")
PHI = 0.3


def _external(drive, name):
    drive_name = drive.design.description["name"]
    return casadi.external(f"{drive_name}_{name}", str(SHIPPED / f"{drive_name}.so"))


def _places(drive, keys):
    entries = [f"{p['table']}.{p['key']}" for p in drive.design.description["parameters"]]
    return [entries.index(key) for key in keys]


def _contact(drive, keys):
    """CasADi function (values of the keys, angle, start) → unknowns: the design completed, then its contact."""
    v, phi, given = casadi.MX.sym("v", len(keys)), casadi.MX.sym("phi"), casadi.MX(given_vector(drive.design))
    start = casadi.MX.sym("start", len(drive.design.description["unknowns"]))
    given[_places(drive, keys)] = v
    p = _external(drive, "complete")(given)
    return casadi.Function("contact", [v, phi, start], [_external(drive, "contact")(p, phi, start)[0]])


def _given_keys(drive):
    result = sensitivity(drive, [PHI])
    open_ = np.isnan(given_vector(drive.design))[_places(drive, result.keys)]
    return result, [key for key, left_open in zip(result.keys, open_, strict=True) if not left_open]


@pytest.mark.parametrize("name", DESIGNS)
def test_completed_designs_and_contacts_are_those_of_the_library(name):
    drive = Drive.load(name).with_(misalignment={"center_distance_mm": 0.02} if "worm" not in name else {})
    p = np.array(_external(drive, "complete")(given_vector(drive.design))).ravel()
    assert np.array_equal(p, drive.design.parameters, equal_nan=True)
    x = np.array(_external(drive, "contact")(p, PHI, drive.trace([PHI])[0][0] + 1e-4)[0]).ravel()
    assert x == pytest.approx(drive.trace([PHI])[0][0], abs=1e-11)


@pytest.mark.parametrize("name", DESIGNS)
def test_jacobians_are_exact(name):
    """By the design's keys the sensitivities, by the angle central differences of the trace."""
    drive = Drive.load(name)
    result, keys = _given_keys(drive)
    contact = _contact(drive, keys)
    v, phi = casadi.MX.sym("v", len(keys)), casadi.MX.sym("phi")
    x = contact(v, phi, drive.trace([PHI])[0][0])
    slopes = casadi.Function("slopes", [v, phi], [casadi.jacobian(x, v), casadi.jacobian(x, phi)])
    by_key, by_angle = map(np.array, slopes(drive.design.parameters[_places(drive, keys)], PHI))
    columns = [result.of(key) for key in keys]
    expected = np.stack([values[0, columns] for values in result.unknowns.values()])
    assert np.abs(by_key - expected).max() < 1e-9 * np.abs(expected).max()
    step = 1e-3
    ends = drive.trace(PHI + step * np.arange(-2, 3))[0]
    difference = (ends[0] - 8 * ends[1] + 8 * ends[3] - ends[4]) / (12 * step)
    assert by_angle.ravel() == pytest.approx(difference, rel=1e-7, abs=1e-9)


def test_a_design_that_cannot_be_completed_is_an_error_of_the_call():
    drive = Drive.load("face-worm-conical-convex")
    given = given_vector(drive.design)
    given[_places(drive, ["design.offset_mm"])] = 1.0
    with pytest.raises(RuntimeError, match="face_worm_complete"):
        _external(drive, "complete")(given)


def _contact_of(drive):
    names = [*analysis.flag_names(drive.model), "other_branch"]

    def solved(phi, start):
        x, status, flags = _external(drive, "contact")(drive.design.parameters, phi, start)
        return np.array(x).ravel(), int(status), {n for n, f in zip(names, np.array(flags).ravel(), strict=True) if f}

    return solved


@pytest.mark.parametrize(
    ("start", "flag"), [([4.8, 0.0, 4.8, 0.0, 0.0], "interference"), ([4.8, -7.0, 4.8, -7.0, 0.0], "other_branch")]
)
def test_a_start_that_leads_into_the_bodies_or_to_the_next_tooth_is_refused(start, flag):
    x, _, flags = _contact_of(Drive.load("recess-action-full"))(7.0, start)
    assert np.isnan(x).all()
    assert flag in flags


@pytest.mark.parametrize("name", DESIGNS)
def test_starts_from_anywhere_end_in_the_contact_of_the_pair_or_in_a_reason(name):
    drive, generator = Drive.load(name), np.random.default_rng(3)
    solved, ends = _contact_of(drive), set()
    for phi in generator.uniform(-1.5, 1.5, 40) * min(drive.pitch(), 1.0):
        own = drive.trace([phi])[0][0]
        x, status, flags = solved(phi, own + generator.normal(size=len(own)) * generator.choice([1e-3, 1.0]))
        ends.add(np.isfinite(x).all())
        if np.isfinite(x).all():
            assert status >= 0 and not {"interference", "spurious_sheet", "other_branch"} & flags
            assert x == pytest.approx(own, abs=1e-7)
        else:
            assert np.isnan(x).all() and (status < 0 or {"interference", "spurious_sheet", "other_branch"} & flags)
    assert ends == {True, False}


def test_what_is_no_contact_has_no_derivatives():
    drive = Drive.load("recess-action-full")
    phi = casadi.MX.sym("phi")
    x, status, flags = _external(drive, "contact")(drive.design.parameters, phi, [4.8, 0.0, 4.8, 0.0, 0.0])
    slopes = casadi.Function("slopes", [phi], [casadi.jacobian(each, phi) for each in (x, status, flags)])
    by_angle, *others = map(np.array, slopes(7.0))
    assert np.isnan(by_angle).all()
    assert not any(other.any() for other in others)


def test_a_design_that_is_none_has_no_contact():
    drive = Drive.load("recess-action-full")
    p = drive.design.parameters.copy()
    p[_places(drive, ["design.normal_module_mm"])] = -1.0
    x, status, _ = _external(drive, "contact")(p, PHI, np.zeros(5))
    assert np.isnan(np.array(x)).all() and int(status) == library().MW_BAD_INPUT


@pytest.mark.parametrize(
    ("name", "hidden"),
    [
        ("plain-zk", {"misalignment.vertical_deg": 0.02, "misalignment.center_distance_mm": 0.03}),
        ("face-worm-conical-convex", {"misalignment.axial_mm": 0.04, "design.plunge_mm_per_rad2": 0.0034}),
    ],
)
def test_ipopt_finds_what_a_measured_transmission_error_tells_of_the_drive(name, hidden):
    """Least squares over half a pitch, IPOPT driven by the external functions and their Jacobians alone."""
    drive = Drive.load(name)
    angles = PHI + np.linspace(-0.25, 0.25, 5) * drive.pitch()
    changed = drive
    for key, value in hidden.items():
        table, entry = key.split(".")
        changed = changed.with_(**{table: {entry: value}})
    measured = changed.tca(angles).error
    places, error = _places(drive, hidden), drive.design.description["error"]
    nominal, wanted = drive.design.parameters[places], changed.design.parameters[places]
    scale = np.abs(wanted - nominal)
    z, contact = casadi.MX.sym("z", len(hidden)), _contact(drive, list(hidden))
    starts = drive.trace(angles)[0]
    values = nominal + scale * z
    found = casadi.vertcat(*(contact(values, *at)[error] for at in zip(angles, starts, strict=True)))
    problem = {"x": z, "f": casadi.sumsqr((found - measured) / np.abs(measured).max())}
    options = {
        "ipopt": {"hessian_approximation": "limited-memory", "print_level": 0, "tol": 1e-12, "sb": "yes"},
        "print_time": False,
    }
    solver = casadi.nlpsol("fit", "ipopt", problem, options)
    solution = solver(x0=[0.1] * len(hidden), lbx=-2.0, ubx=2.0)
    assert solver.stats()["success"]
    assert nominal + scale * np.array(solution["x"]).ravel() == pytest.approx(wanted, rel=1e-6)
