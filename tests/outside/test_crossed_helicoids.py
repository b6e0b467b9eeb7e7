"""Involute helicoids on crossed axes, a file outside the tree: every command against closed forms.

The common normal of two involute helicoids touches both base cylinders and stands still (F. L. Litvin, A. Fuentes,
"Gear Geometry and Applied Theory", 2004, chapter 16): no transmission error under any error of assembly.
"""

import csv
import ctypes
import json
import math

import numpy as np
import pytest

from meshwright.contact.results import ARCSEC
from meshwright.sensitivity import sensitivity
from tests.embedding import compile as c

pytestmark = pytest.mark.validate

M, ALPHA, T, BETA = 2.0, math.radians(20.0), (20, 30), tuple(map(math.radians, (50.0, 35.0)))
R = tuple(M * t / (2 * math.cos(b)) for t, b in zip(T, BETA, strict=True))
ALPHA_T = tuple(math.atan(math.tan(ALPHA) / math.cos(b)) for b in BETA)
R_B = tuple(r * math.cos(a) for r, a in zip(R, ALPHA_T, strict=True))
SIN_BASE = tuple(math.sin(b) * math.cos(ALPHA) for b in BETA)
ERRORS = {"center_distance_mm": 0.1, "shaft_angle_deg": 0.3}
TABLES = {
    "drive": "crossed-helicoids",
    "name": "pair",
    "design": {
        "normal_module_mm": M, "pressure_angle_deg": 20.0, "pinion_teeth": T[0], "wheel_teeth": T[1],
        "pinion_helix_angle_deg": 50.0, "wheel_helix_angle_deg": 35.0, "face_width_mm": 30.0,
    },
}  # fmt: skip


@pytest.mark.parametrize("hand", [1.0, -1.0])
@pytest.mark.parametrize("flank", ["left", "right"])
def test_the_error_is_constant_and_the_normal_stands_still_under_any_error_of_assembly(drive, flank, hand):
    design = TABLES["design"] | {"hand": "right" if hand > 0 else "left"}
    angles = np.radians(np.linspace(-15.0, 15.0, 9))
    aligned = drive(flank=flank, design=design).tca(angles)
    assert np.abs(aligned.error).max() < 1e-9 * ARCSEC
    turned = drive(flank=flank, design=design, misalignment=ERRORS).tca(angles)
    assert set(turned.status) == {"converged"}
    assert np.ptp(turned.error) < 1e-9 * ARCSEC
    sigma = sum(BETA) + math.radians(ERRORS["shaft_angle_deg"])
    for result, angle in ((aligned, sum(BETA)), (turned, sigma)):
        axis = np.array([0.0, hand * math.sin(angle), math.cos(angle)])
        assert np.ptp(result.normals, axis=0).max() < 1e-12
        assert abs(result.normals[:, 2]) == pytest.approx(SIN_BASE[0], abs=1e-13)
        assert abs(result.normals @ axis) == pytest.approx(SIN_BASE[1], abs=1e-13)
        moment = np.cross(result.points, result.normals)
        assert abs(moment[:, 2]) == pytest.approx(R_B[0] * math.sqrt(1 - SIN_BASE[0] ** 2), abs=1e-11)


def test_the_pitch_point_is_reached_half_a_tooth_from_the_middle(drive):
    """The left flank of a tooth lies a quarter of a pitch beside its middle."""
    result = drive().tca([-math.pi / (2 * T[0])])
    assert result.points[0] == pytest.approx([R[0], 0.0, 0.0], abs=1e-12)


def test_the_contact_ratio_is_the_length_of_action_over_the_base_pitch(run):
    length = sum(
        (math.sqrt((r + M) ** 2 - b**2) - math.sqrt(r**2 - b**2)) / math.sqrt(1 - sine**2)
        for r, b, sine in zip(R, R_B, SIN_BASE, strict=True)
    )
    found = run.json("ratio")
    assert found["contact_ratio"] == pytest.approx(length / (math.pi * M * math.cos(ALPHA)), abs=1e-10)
    assert (found["begin"]["event"], found["end"]["event"]) == ("tip", "tip")
    assert found["backlash_arcsec"] == pytest.approx(0.0, abs=1e-6)


def test_points_of_the_surface_lie_on_the_involute_helicoid(run):
    """The involute's polar angle grows by inv α with the radius and by z/p along the tooth."""
    shown = run.json("surface", "--member", "pinion", "--grid", "5x7")
    x, y, z = np.array([p for p in shown["points_mm"] if p], dtype=float).T
    radius, p = np.hypot(x, y), R[0] / math.tan(BETA[0])
    inv = np.sqrt(radius**2 - R_B[0] ** 2) / R_B[0] - np.arccos(R_B[0] / radius)
    middle = math.pi / (2 * T[0]) + math.tan(ALPHA_T[0]) - ALPHA_T[0]
    off = np.arctan2(y, x) - (middle - inv) - z / p
    assert np.abs(np.remainder(off + math.pi, 2 * math.pi) - math.pi).max() < 1e-12
    assert abs(radius.max() - R[0] - M) < 1e-9


def test_the_fillet_is_an_arc_that_touches_the_flank(run):
    """In the transverse plane all its points are as far from one centre as the rounding says."""
    for member in ("pinion", "wheel"):
        shown = run.json("surface", "--member", member, "--region", "fillet", "--grid", "5x7")
        parameters = np.array(shown["parameter_values"], dtype=float)
        points, normals = (np.array(shown[key], dtype=float) for key in ("points_mm", "normals"))
        k = ("pinion", "wheel").index(member)
        flat = normals[:, :2] / np.hypot(normals[:, 0], normals[:, 1])[:, None]
        turn = -points[:, 2] * math.tan(BETA[k]) / R[k]
        centres = (points[:, 0] + 1j * points[:, 1] + 0.38 * M * (flat[:, 0] + 1j * flat[:, 1])) * np.exp(1j * turn)
        assert np.ptp(centres.real) < 1e-10 and np.ptp(centres.imag) < 1e-10
        assert np.unique(parameters[:, 0].round(9)).size == 5


def test_the_solid_ends_at_tip_and_face(run):
    """Vertices of the binary STL; those of the teeth reach the tip cylinder."""
    path = run.design.with_suffix(".stl")
    run("surface", "--member", "wheel", "--solid", "--stl", path, "--set", "design.face_width_mm=10")
    facets = np.frombuffer(path.read_bytes()[84:], dtype=np.dtype([("values", "<f4", 12), ("of", "<u2")]))
    vertices = facets["values"][:, 3:].reshape(-1, 3)
    assert np.hypot(vertices[:, 0], vertices[:, 1]).max() == pytest.approx(R[1] + M, abs=1e-4)
    assert abs(vertices[:, 2]).max() == pytest.approx(5.0, abs=1e-5)


def test_limits_find_none_beyond_the_base_circle(run):
    found = run.json("limits")
    assert not any(found[key] for key in ("undercut", "regression", "branch_points"))


def _growth(drive):
    """Change of the error with the centre distance, rad/mm: n_x over the moment of the normal about the wheel's axis.

    The normal depends on the shaft angle alone, so the error is exactly proportional to the error of distance.
    """
    contact = drive.tca([0.1])
    n, at = contact.normals[0], contact.points[0] - [sum(R), 0.0, 0.0]
    axis = -np.array([0.0, math.sin(sum(BETA)), math.cos(sum(BETA))])
    return -n[0] / (np.cross(at, n) @ axis)


def test_a_sweep_gives_the_error_of_every_sample(run, drive, tmp_path):
    run("sweep", "--vary", "misalignment.center_distance_mm=-0.2:0.2", "--grid", 5, "--out", tmp_path / "rows",
        "--format", "csv", "--phi-deg=-9:9:9")  # fmt: skip
    (part,) = (tmp_path / "rows").glob("slice-*.csv")
    with part.open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    errors = np.array([float(row["transmission_error_arcsec"]) for row in rows]).reshape(5, 3)
    expected = np.linspace(-0.2, 0.2, 5) * _growth(drive()) / ARCSEC
    assert errors == pytest.approx(np.repeat(expected[:, None], 3, axis=1), abs=1e-8)


def test_sensitivities_are_those_of_the_normal(drive):
    found = sensitivity(drive(), [0.1])
    column = found.of("misalignment.center_distance_mm")
    assert found.error[0, column] == pytest.approx(_growth(drive()), rel=1e-10)


def test_casadi_and_the_left_hand_agree_with_the_compiled_drive(run):
    words = ("--phi-deg=-9,9", "--set", "misalignment.shaft_angle_deg=0.2")
    right, casadi = run.json("tca", *words), run.json("tca", *words, "--backend", "casadi")
    left = run.json("tca", *words, "--set", "design.hand=left")
    for ours, other, mirrored in zip(right["points"], casadi["points"], reversed(left["points"]), strict=True):
        assert ours["transmission_error_arcsec"] == pytest.approx(other["transmission_error_arcsec"], abs=1e-9)
        assert ours["transmission_error_arcsec"] == pytest.approx(-mirrored["transmission_error_arcsec"], abs=1e-9)
        assert ours["contact_point_mm"] == pytest.approx(np.multiply(mirrored["contact_point_mm"], (1, -1, 1)))


def test_under_load_the_pairs_carry_the_torque_at_the_pressure_of_hertz(run):
    """The lever arm of every normal force about the pinion's axis is that of the base helix."""
    (point,) = run.json("loaded", "--torque-nm", 5, "--phi-deg", 0)["points"]
    arm = R_B[0] * math.sqrt(1 - SIN_BASE[0] ** 2)
    assert sum(pair["force_n"] for pair in point["pairs"]) * arm == pytest.approx(5000.0, rel=1e-3)
    for pair in point["pairs"]:
        assert pair["peak_pressure_mpa"] == pytest.approx(pair["hertz_pressure_mpa"], rel=0.01)


def test_the_header_alone_solves(folder, drive, tmp_path):
    """``X_solve`` of one header that needs nothing else."""
    name, library = "crossed_helicoids", tmp_path / "solve.so"
    source = tmp_path / "solve.c"
    source.write_text(
        f'#include "{name}.h"\nint solve(const double *p, double phi, double *x)\n{{\n    double s[{name}_NS];\n'
        f"    return {name}_setup(p, s) ? -1000 : {name}_solve(s, phi, x, NULL);\n}}\n"
    )
    c.run(*c.compilers()["clang"][0], "-std=c99", "-O1", *c.STRICT, *c.EXACT, "-shared", "-fPIC",
          f"-I{folder / 'include'}", source, "-o", library, "-lm")  # fmt: skip
    parameters = drive(misalignment=ERRORS).design.parameters
    x = np.empty(5)
    pointers = [np.ascontiguousarray(a).ctypes.data_as(ctypes.c_void_p) for a in (parameters, x)]
    assert ctypes.CDLL(str(library)).solve(pointers[0], ctypes.c_double(0.1), pointers[1]) >= 0
    assert x[-1] == pytest.approx(drive(misalignment=ERRORS).tca([0.1]).error[0], abs=1e-14)


def test_the_report_and_the_audit_entry_are_written(run, folder, tmp_path):
    run("report", "--html", tmp_path / "pair.html")
    assert "Involute helicoids on crossed axes" in (tmp_path / "pair.html").read_text(encoding="utf-8")
    entry = json.loads((folder / "audit" / "crossed_helicoids.json").read_text(encoding="utf-8"))
    assert set(entry["checked"].values()) == {"holds"} and entry["not_proved"] == {}
