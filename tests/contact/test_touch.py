"""Success means touching: what the gate lets through, what it does not, and that everything asks it."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.library import ABI, ffi, library, model, pointer
from meshwright.contact import analysis

DESIGN = {
    "drive": "cylindrical-worm",
    "flank": "right",
    "design": {
        "normal_module_mm": 4.0, "worm_threads": 3, "wheel_teeth": 29, "worm_lead_angle_deg": 30.0,
        "pressure_angle_deg": 20.0, "worm_profile": "ZA", "hob_profile": "ZN", "hob_pitch_radius_mm": 12.5,
    },
    "misalignment": {
        "center_distance_mm": 0.0189602, "horizontal_deg": -2.21193, "vertical_deg": -0.4217639726,
        "axial_mm": 0.0395228,
    },
}  # fmt: skip


def _solution(drive, angle):
    """State, unknowns and observation of a solved contact."""
    x, records = analysis.trace(drive, np.array([angle]))
    assert records["status"][0] >= 0
    s, o = drive.state(angle), np.empty(drive.model.no)
    drive.model.observe(pointer(s), pointer(x[0]), pointer(o))
    return s, x[0], o


def _touch(drive, x, o):
    return library().mw_touch(drive.model, pointer(x), pointer(o))


@pytest.mark.parametrize("name", ["recess-action-full", "spherical-table-2-3", "face-worm-cylindrical-convex"])
def test_a_gap_a_turned_normal_and_a_parallel_normal_are_no_contact(name):
    drive = Drive.load(name)
    _, x, o = _solution(drive, 0.1)
    assert _touch(drive, x, o) == library().MW_CONVERGED
    for place, change in ((0, 1e-7), (6, -1e-7), (3, 1e-7), (10, 1e-7), (2, np.nan)):
        moved = o.copy()
        moved[place] += change
        assert _touch(drive, x, moved) == library().MW_DIVERGED
    parallel = o.copy()
    parallel[9:12] *= -1.0
    assert _touch(drive, x, parallel) == library().MW_NO_CONTACT


def test_a_surface_parameter_outside_its_domain_is_no_flank():
    drive = Drive.load("spherical-table-2-3")
    _, x, o = _solution(drive, 0.1)
    names = [u["name"] for u in drive.design.description["unknowns"]]
    x[names.index("theta_pinion")] = 2.0
    assert _touch(drive, x, o) == library().MW_LEFT_FLANK


@pytest.mark.validate
def test_normals_that_are_parallel_are_never_a_contact():
    """Both bodies on one side of the tangent plane, the worm at a negative radius: the equations hold all the same."""
    drive = Drive.from_tables(DESIGN)
    angles = np.radians([-28.64788975654116, -28.0, -29.0, 0.0, 28.0])
    result = drive.tca(angles)
    for k in np.flatnonzero(result.solved):
        assert result.residual[k] < 1e-9
        assert result.solutions[k, 0] > 0.0
    assert "converged" not in (result.status[0],) or abs(np.degrees(result.error[0])) < 1.0


@pytest.mark.parametrize("angle", [np.inf, -np.inf, np.nan, 1e300])
def test_a_branch_is_not_followed_to_an_angle_that_is_none(angle):
    drive = Drive.load("recess-action-full")
    s, x, _ = _solution(drive, 0.1)
    angles, found, info = np.array([0.2, angle]), np.empty((2, drive.model.nx)), ffi.new("mw_info[2]")
    count = library().mw_follow(drive.model, pointer(s), 0.1, pointer(x), pointer(angles), 2, pointer(found), info)
    assert count == 1
    assert info[1].status == library().MW_BAD_INPUT


def test_there_is_no_flag_before_the_first():
    m = model("face_worm")
    assert library().mw_flag(m, -1) == ffi.NULL
    assert library().mw_flag(m, 10_000) == ffi.NULL


OTHERS = [("abi", ABI - 1), ("abi", ABI + 1), ("nx", 9), ("np", 4000), ("no", 4000), ("nstart", 9), ("nanchor", 4000)]


@pytest.mark.parametrize(("field", "value"), OTHERS)
def test_a_table_of_another_version_or_too_large_is_refused(field, value):
    drive = Drive.load("recess-action-full")
    s, x, _ = _solution(drive, 0.1)
    table, info = ffi.new("mw_model *", drive.model[0]), ffi.new("mw_info[1]")
    setattr(table, field, value)
    work, p, phi = np.empty(5000), drive.design.parameters, np.array([0.1])
    lib, bad = library(), library().MW_BAD_INPUT
    room, o, contact = np.empty(5000), np.empty(5000), ffi.new("mw_contact[1]")
    assert lib.mw_solve(table, pointer(p), 0.1, pointer(s), pointer(work), pointer(room), info) == bad
    assert lib.mw_trace(table, pointer(p), pointer(phi), 1, pointer(s), pointer(work), pointer(room), info) == 0
    assert info[0].status == bad
    assert lib.mw_refine(table, pointer(s), pointer(x), info) == bad
    assert lib.mw_follow(table, pointer(s), 0.1, pointer(x), pointer(phi), 1, pointer(room), info) == 0
    assert info[0].status == bad
    assert lib.mw_contact_at(table, pointer(s), pointer(x), pointer(o), contact) == bad
    many = (pointer(room), pointer(room), pointer(room), pointer(room))
    assert lib.mw_arclength(table, pointer(s), 0.1, pointer(x), 0.1, 1, *many) == 0
