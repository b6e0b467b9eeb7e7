"""CasADi as the design tool: exact derivatives of a solved contact, and one worked optimisation."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

casadi = pytest.importorskip("casadi")

from meshwright import Drive  # noqa: E402
from meshwright._library import SHIPPED  # noqa: E402
from meshwright.optimise import Completion, contact, semi_major  # noqa: E402
from meshwright.sensitivity import sensitivity  # noqa: E402

KEYS = ("design.hob_pitch_radius_mm", "design.pitch_line_shift_mm")
ROOT = Path(__file__).resolve().parents[2]


def test_casadi_differentiates_the_contact_as_the_library_does():
    drive, angle = Drive.load("recess-action-full"), 7.0
    completion, tca = Completion(drive, KEYS), contact(drive)
    q = casadi.MX.sym("q", len(KEYS))
    start = drive.trace(np.array([angle]))[0][0]
    unknowns = tca(completion(q), angle, start)[0]
    slopes = casadi.Function("slopes", [q], [casadi.jacobian(unknowns, q)])
    at = [drive.design.as_solved()["design"][key.partition(".")[2]] for key in KEYS]
    ours = sensitivity(drive, [angle])
    columns = [ours.of(key) for key in KEYS]
    expected = np.stack([ours.unknowns[u["name"]][0, columns] for u in drive.design.description["unknowns"]])
    assert np.asarray(slopes(at)) == pytest.approx(expected, rel=1e-7, abs=1e-7)


def test_the_ellipse_as_an_expression_is_that_of_the_analysis():
    drive = Drive.load("recess-action-full")
    p, start = drive.design.parameters, drive.trace(np.array([7.0]))[0][0]
    observed = contact(drive)(np.nan_to_num(p), 7.0, start)[1]
    axis = float(semi_major(drive, observed, drive.design.value("separation_mm", "contact")))
    assert axis == pytest.approx(drive.tca([7.0]).semi_axes[0, 0], rel=1e-6)


def test_ipopt_finds_a_hob_with_the_wanted_ellipse_within_the_bound_on_the_error():
    example = ROOT / "runtime" / "examples" / "optimise_hob.py"
    done = subprocess.run([sys.executable, example], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "semi-major axis 6.0000 mm" in done.stdout


def test_the_library_itself_is_an_external_function_of_casadi():
    drive = Drive.load("recess-action-full")
    solve = casadi.external("cylindrical_worm_zn_zn_contact", str(SHIPPED / "libmeshwright.so"))
    expected = drive.trace(np.array([7.0]))[0][0]
    found = solve(drive.design.parameters, 7.0, expected + 1e-4)
    assert np.asarray(found).ravel() == pytest.approx(expected, abs=1e-10)
