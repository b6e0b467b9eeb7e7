"""Undercut of the worm, of the gear and of the hob-cut reference gear."""

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from meshwright.limits.results import Request
from meshwright.limits.singular_lines import edges
from tests.face_worm.designs import NAMES, independent
from tests.quick import quick

CONVEX = [name for name in NAMES if name.endswith("convex")]


@pytest.mark.parametrize("name", CONVEX)
def test_inner_radius_lies_just_outside_the_undercut_edge_of_the_hob_cut_gear(name):
    """On the mid line of the convex side, as the report's choice of radii suggests."""
    drive = Drive.load(name)
    surface = drive.flank("reference_wheel")
    radii = [np.hypot(*surface([q]).points[0, :2]) for q in edges(surface, 0.0)]
    assert 0 < drive.design.value("gear_inner_radius_mm") - max(radii) < 1.5


@pytest.mark.parametrize("name", NAMES)
def test_at_an_edge_the_tangents_of_the_cut_surface_are_dependent(name):
    """Tangents (r_u, r_θ, r_ψ) over slopes (f_u, f_θ, f_ψ) have rank 2: differences in 50 digits, own formulation."""
    drive = Drive.load(name)
    with mpmath.workdps(50):
        twin = independent(drive)
        phase = twin.placed["phase"]
        for q in edges(drive.flank("reference_wheel"), 0.4):
            at = [mpmath.mpf(x) for x in q]
            columns = []
            for k in range(3):
                order = tuple(int(i == k) for i in range(3))
                rows = [
                    mpmath.diff(lambda *x, i=i: twin.hob_cut(*x, phase)[0][i], at, order) for i in range(3)
                ]
                columns.append([*rows, mpmath.diff(lambda *x: twin.hob_meshing(*x, phase), at, order)])
            matrix = np.array([[float(x) for x in column] for column in columns]).T
            singular_values = np.linalg.svd(matrix / np.linalg.norm(matrix, axis=1)[:, None], compute_uv=False)
            assert singular_values[2] < 1e-11
            assert singular_values[1] > 1e-3


@pytest.mark.parametrize("name", quick(NAMES, NAMES[0]))
def test_undercut_points_are_singular_and_lie_off_the_flanks_of_the_packaged_designs(name):
    drive = Drive.load(name)
    found = list(drive.limits(Request(grid=5)).undercut)
    assert {"wheel", "reference_wheel"} <= {p.member for p in found}
    for p in found:
        flank = drive.flank(p.member)([list(p.parameters.values())])
        assert abs(flank.regular[0]) < 1e-9
        assert np.allclose(flank.points[0], p.point, rtol=0, atol=1e-12)
        assert not p.on_flank


def test_cone_is_singular_at_its_apex_on_the_tool_axis():
    drive = Drive.load(NAMES[0])
    (apex,) = (p for p in drive.limits(Request(grid=2)).undercut if p.member == "wheel")
    expected = -drive.design.value("head_cutter_radius_mm") / np.sin(drive.design.value("blade_angle_deg"))
    assert apex.parameters["u_gear"] == pytest.approx(expected, rel=1e-12)


def test_contact_beyond_an_undercut_edge_of_the_worm_is_flagged():
    """A strong plunge of the wrong sign with three threads undercuts the worm on its path; bodies interfere there."""
    drive = Drive.load(NAMES[0]).with_(design={"plunge_mm_per_rad2": -0.02, "worm_threads": 3})
    result = drive.tca(np.radians(np.arange(-600.0, 601.0, 10.0)))
    solved = result.solved
    flagged = np.array(["undercut" in flags for flags in result.flags])[solved]
    interfering = np.array(["interference" in flags for flags in result.flags])[solved]
    places = np.column_stack([result.unknowns[u] for u in ("u_worm", "theta_worm", "psi_worm")])[solved]
    assert flagged.any()
    assert np.array_equal(flagged, drive.flank("pinion")(places).regular < 0)
    assert np.array_equal(flagged, interfering)
