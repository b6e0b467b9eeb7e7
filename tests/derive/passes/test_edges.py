"""Equations of edge contact and the limits of flanks beyond their values: C, CasADi and the derivations agree, and what
they say of a pair is what a search over both flanks finds.
"""

import casadi
import mpmath
import numpy as np
import pytest

from derive import drives
from derive.language.drive import Role
from derive.passes import check
from derive.passes.edges import EDGES, edge_contact
from derive.passes.schedule import schedule
from meshwright import Drive
from meshwright.base.drives import folder_of
from meshwright.base.library import ffi, library, model, pointer
from meshwright.cycle.edge_contact import edge_paths
from meshwright.cycle.pairs import Mesh

FAMILIES = ("cylindrical_worm_zn_zn", "face_worm", "spherical_concave_convex")


@pytest.fixture(scope="module", params=FAMILIES)
def plan(request):
    return schedule(drives.catalogue([request.param])[request.param]())


@pytest.fixture(scope="module")
def state(plan):
    """The compiled model and its state at the sample's contact; contact and parameters as floats."""
    compiled = model(plan.drive.name)
    numbers = {symbol: float(value) for symbol, value in plan.sample.items()}
    parameters = np.array([numbers[p.symbol] for p in plan.drive.parameters])
    s = np.empty(compiled.ns)
    assert compiled.setup(pointer(parameters), pointer(s)) == 0
    compiled.set_phi(pointer(s), plan.drive.sample_angle)
    return compiled, s, parameters, np.array([numbers[u] for u in plan.unknowns])


def test_every_edge_of_a_blank_has_a_system_with_the_mating_flank_and_one_with_each_mating_edge(plan):
    counts = [sum(m.role in EDGES for m in body.margins) for body in plan.drive.bodies]
    assert len(plan.edges.systems) == sum(counts) + counts[0] * counts[1]
    for system in plan.edges.systems:
        assert len(set(system.equations)) == len(plan.unknowns)
        for body, k in zip(plan.drive.bodies, system.margins, strict=True):
            assert k is None or body.margins[k].role in (Role.TIP, Role.THROAT, Role.FACE)


def test_a_wrong_slope_of_an_edge_is_caught(plan):
    found = edge_contact(plan)
    unknowns = [plan.lower(u) for u in plan.unknowns]
    wrong = [list(row) for row in found.jacobian]
    wrong[-1] = wrong[-1][1:] + wrong[-1][:1]
    with pytest.raises(check.PassError):
        check.derives("edges", plan.tape, found.equations, unknowns, wrong)


def test_c_and_casadi_have_the_same_equations_of_edge_contact(plan, state):
    compiled, s, parameters, x = state
    x = x + 1e-3 * np.arange(1, len(x) + 1)
    function = casadi.Function.load(str(folder_of(plan.drive.name) / f"{plan.drive.name}_edges.casadi"))
    for name, system in zip(function.name_out(), plan.edges.systems, strict=True):
        number = library().mw_edge(compiled, *(-1 if k is None else k for k in system.margins))
        residual, slopes = np.empty(len(x)), np.empty((len(x), len(x)))
        library().mw_edge_eval(compiled, number, pointer(s), pointer(x), pointer(residual), pointer(slopes))
        wanted = function(p=parameters, phi=plan.drive.sample_angle, x=x)[name]
        assert np.allclose(residual, np.asarray(wanted).ravel(), rtol=1e-11, atol=1e-11, equal_nan=True), name
        by_casadi = function.factory("slopes", ["p", "phi", "x"], [f"jac:{name}:x"])(
            p=parameters, phi=plan.drive.sample_angle, x=x
        )[f"jac_{name}_x"]
        assert np.allclose(slopes, np.asarray(by_casadi), rtol=1e-9, atol=1e-9, equal_nan=True), name


def test_c_and_casadi_have_the_same_surfaces(plan, state):
    compiled, s, parameters, x = state
    function = casadi.Function.load(str(folder_of(plan.drive.name) / f"{plan.drive.name}_surfaces.casadi"))
    for k, body in enumerate(plan.drive.bodies):
        q = x[[plan.unknowns.index(p) for p in body.surface.parameters]]
        told = compiled.bodies[k]
        wanted, bent = np.empty(told.outputs), np.empty(11)
        told.flank(pointer(s), pointer(q), pointer(wanted))
        told.curvature(pointer(s), pointer(q), pointer(bent))
        found = function(**{"p": parameters, f"q_flank_{body.name}": q})
        for name, numbers in ((f"flank_{body.name}", wanted), (f"curvature_flank_{body.name}", bent)):
            assert np.allclose(np.asarray(found[name]).ravel(), numbers, rtol=1e-9, atol=1e-11, equal_nan=True), name


def test_limits_and_flanks_bend_as_differences_in_fifty_digits_say(plan, state):
    compiled, s, _, _ = state
    for number, expansion in enumerate(plan.expansions[:2]):
        flank = expansion.of
        with mpmath.workdps(50):
            point = next(o.nodes for o in flank.outputs if o.name == "point")
            evaluate = plan.tape.evaluator([*point, *flank.limits, *flank.conditions], mpmath)
            h, k = mpmath.mpf(10) ** -12, len(flank.parameters)
            base = [mpmath.mpf(float(plan.sample[q]) + 0.01) for q in flank.parameters]  # beside |z| = 0

            def at(moves, flank=flank, evaluate=evaluate, base=base):
                return evaluate(plan.sample | {q: base[i] + moves.get(i, 0) for i, q in enumerate(flank.parameters)})

            first = [[(a - b) / (2 * h) for a, b in zip(at({i: h}), at({i: -h}), strict=True)] for i in range(k)]
            second = [
                [
                    (a - b - c + d) / (4 * h * h)
                    for a, b, c, d in zip(
                        *(at(_both(i, j, u * h, w * h)) for u, w in ((1, 1), (1, -1), (-1, 1), (-1, -1))), strict=True
                    )
                ]
                for i in range(k)
                for j in range(i, k)
            ]
        limits = slice(3, 3 + len(flank.limits))
        q = np.array(base, dtype=float)
        slopes, bent = np.empty(len(expansion.slopes)), np.empty(len(expansion.second))
        for order, numbers in ((1, slopes), (2, bent)):
            assert library().mw_bounds(compiled, number, order, pointer(s), pointer(q), 1, pointer(numbers)) == 0
        _equal(slopes, np.array(first, dtype=float)[:, limits].T)
        _equal(bent, np.array(second, dtype=float).T)


def _both(i, j, a, b):
    return {i: a + b} if i == j else {i: a, j: b}


def _equal(found, wanted):
    wanted = wanted.ravel()
    known = np.isfinite(wanted)
    assert known.any()
    assert found[known] == pytest.approx(wanted[known], rel=1e-9, abs=1e-9)


def test_what_is_no_edge_is_refused():
    compiled = model("face_worm")
    state, x, info = np.zeros(compiled.ns), np.zeros(compiled.nx), ffi.new("mw_info *")
    assert library().mw_edge(compiled, 0, -1) == -1  # the disk worm's blank has no edge
    assert library().mw_edge(compiled, -1, 2) == -1  # a root runs on into a fillet
    assert library().mw_edge_solve(compiled, -1, pointer(state), pointer(x), info) < 0
    assert library().mw_edge_eval(compiled, 99, pointer(state), pointer(x), pointer(x), ffi.NULL) < 0
    assert library().mw_bounds(compiled, 99, 1, pointer(state), pointer(x), 1, pointer(x)) < 0


def test_where_an_edge_runs_off_an_edge_both_touch_where_a_search_over_both_flanks_finds_them_first():
    mesh = Mesh.of(Drive.load("spherical-table-3-1-concave").with_(misalignment={"vertical_deg": 0.2}))
    corners = [edge for edge in edge_paths(mesh) if edge is not None and edge.corner is not None]
    assert corners
    for edge in corners:
        on_corner = np.flatnonzero(edge.systems == edge.systems[-1])
        angles = edge.angles[on_corner[1 : len(on_corner) // 2 : 2]]
        found = mesh.drive.first_contact(mesh.mirror * angles)
        assert found.members == ("both",) * len(angles)
        assert found.errors == pytest.approx(mesh.mirror * edge.errors(angles), abs=1e-11)


def test_an_edge_touches_where_a_search_over_both_flanks_finds_it_first():
    mesh = Mesh.of(Drive.load("helical-crowned"))
    _, edge = edge_paths(mesh)
    angles = edge.angles[0] + np.array([0.2, 0.5, 0.8]) * (edge.angles[-1] - edge.angles[0])
    found = mesh.drive.first_contact(mesh.mirror * angles)
    assert set(zip(found.kinds, found.members, found.limits, strict=True)) == {("edge", "pinion", ("face",))}
    assert found.errors == pytest.approx(mesh.mirror * edge.errors(angles), abs=1e-11)
