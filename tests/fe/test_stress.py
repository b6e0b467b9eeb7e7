"""Finite elements of spherical pairs against Hertz, and the gate that refuses bad runs."""

import gzip
import json
import shutil
import stat
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.commands.fe import page
from meshwright.fe import analysis
from meshwright.fe.analysis import Settings, judge, prepare
from meshwright.fe.compliance import tooth_compliance
from meshwright.fe.deck import write
from meshwright.fe.grading import MeshDensity
from meshwright.fe.model import Load, build_model
from meshwright.fe.solids import gear_pair
from meshwright.fe.solver import SolverRun, run_ccx

TORQUE = Load(100e3, "pinion")
LIMIT = 600.0
RECORDED = Path(__file__).parents[1] / "reference" / "ccx-surface-to-surface"
# two rows of coarse fillet elements leave the solver a singular matrix
MODEST = MeshDensity(growth=3.0, fillet_rows=4, rim_rows=3, coarse_fillet_rows=3)
COARSE = replace(MODEST, per_semi_minor=1.0, per_semi_major=1.5, growth=3.5, first_layer=1.0)


@pytest.fixture(scope="module")
def concave():
    return gear_pair(Drive.load("spherical-table-4-4-concave"))


@pytest.fixture(scope="module")
def compliance(concave):
    return {name: tooth_compliance(getattr(concave, name)) for name in ("pinion", "wheel")}


@pytest.fixture(scope="module")
def coarse(ccx, concave, compliance, tmp_path_factory):
    """A coarse mesh in a folder of its own, and the solver's run of it."""
    prepared, _ = prepared_at(concave, compliance, tmp_path_factory.mktemp("coarse"), COARSE)
    return prepared, run_ccx(ccx, prepared.input_file, LIMIT)


def prepared_at(gear, compliance, folder, density, angle=0.0, pairs=1):
    settings = Settings(pairs, LIMIT, density=density)
    return prepare(gear, compliance, angle, TORQUE, settings, folder), settings


@pytest.mark.validate
def test_convex_on_concave_at_the_pitch_point(ccx, concave, compliance, tmp_path):
    """Pressure within 3 % and subsurface von Mises within 5 % of Hertz on at most 11 000 elements; the gate holds."""
    prepared, settings = prepared_at(concave, compliance, tmp_path / "run", MODEST)
    document = analysis.solve(prepared, ccx, settings)
    assert document["elements"] <= 11_000
    assert all(check["held"] for check in document["gate"].values())
    (pair,) = document["pairs"]
    assert pair["force_n"] == pytest.approx(1612.4, rel=1e-3)
    assert pair["peak_pressure_mpa"] == pytest.approx(1054, rel=0.03)
    assert pair["subsurface_von_mises_mpa"] == pytest.approx(604, rel=0.05)
    assert document["rotation_rad"] == pytest.approx(prepared.loaded.rotation, rel=0.05)
    assert all(Path(path).stat().st_size > 0 for path in document["files"].values())
    assert analysis.earlier_result(prepared) == document
    other = replace(prepared, fingerprint="of another input")
    assert analysis.earlier_result(other) is None


def test_gate_refuses_a_run_cut_by_the_time_limit(ccx, concave, compliance, tmp_path):
    prepared, settings = prepared_at(concave, compliance, tmp_path, MODEST)
    document = analysis.solve(prepared, ccx, replace(settings, time_limit=0.5))
    refused(document, "finished")
    assert "time limit of 0.5 s" in document["message"]


def test_gate_refuses_a_coarse_mesh(coarse):
    """Sound equilibrium, but one element to the Hertz half width."""
    document, _ = judge(*coarse)
    assert document["gate"]["pair_moment_error"]["held"]
    refused(document, "elements_per_semi_minor")


@pytest.mark.validate
def test_gate_refuses_a_start_with_a_gap(ccx, concave, compliance, tmp_path):
    """From 1 um apart the contact is not found: the solver diverges until it gives up or is cut."""
    prepared, settings = prepared_at(concave, compliance, tmp_path, COARSE)
    model = prepared.model
    apart = {
        "start_rotation": -1e-3 / (66.0 * np.cos(np.radians(20.0))),
        "deck": turned(model, -1e-3 / (66.0 * np.cos(np.radians(20.0))) - model.start_rotation),
    }
    gapped = replace(prepared, model=replace(model, **apart))
    gapped.input_file.write_text(write(gapped.model.deck))
    document = analysis.solve(gapped, ccx, replace(settings, time_limit=5.0))
    assert document["pairs"] == [] and not all(check["held"] for check in document["gate"].values())


def turned(model, angle):
    """The deck with the pinion turned back about its axis."""
    c, s = np.cos(angle), np.sin(angle)
    parts = [
        replace(part, mesh=replace(part.mesh, nodes=part.mesh.nodes @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])))
        if part.name == "PINION"
        else part
        for part in model.deck.parts
    ]
    return replace(model.deck, parts=tuple(parts))


def test_gate_refuses_a_recorded_run_with_wrong_pressures(concave, compliance, tmp_path):
    """Converged, "Job finished", return code 0, and pressures that carry twice the torque."""
    prepared, _ = prepared_at(concave, compliance, tmp_path, COARSE)
    results = prepared.input_file.with_suffix(".frd")
    results.write_bytes(gzip.decompress((RECORDED / "model.frd.gz").read_bytes()))
    shutil.copy(RECORDED / "model.dat", tmp_path)
    coordinates = [line for line in results.read_text().split("-3\n")[0].splitlines() if line.startswith(" -1")]
    recorded = {int(line[3:13]): [float(line[k : k + 12]) for k in (13, 25, 37)] for line in coordinates}
    nodes = np.concatenate([part.mesh.nodes for part in prepared.model.deck.parts])
    assert nodes[np.array(list(recorded)) - 1] == pytest.approx(np.array(list(recorded.values())), abs=1e-3)
    run = SolverRun(0, 15.0, (RECORDED / "model.log").read_text())
    document, solution = judge(prepared, run)
    assert run.finished and solution is None
    refused(document, "pair_moment_error")
    assert document["gate"]["pair_moment_error"]["value"] > 1.0
    assert "pair_moment_error" in page(document) and "no stress is given; --refine" in page(document)
    assert document["gate"]["reaction_moment_error"]["held"] and document["gate"]["rotation_rad"]["held"]


def test_gate_refuses_a_rotation_beyond_reason(coarse, tmp_path):
    """Return code 0 and a rotation of 1.5e8 rad, put by hand into the result of a run."""
    prepared, run = coarse
    prepared = replace(prepared, folder=shutil.copytree(prepared.folder, tmp_path / "turned"))
    dat = prepared.input_file.with_suffix(".dat")
    sound = dat.read_text().splitlines()
    turned_row = next(k for k, line in enumerate(sound) if "displacements" in line and "ROTATION_PINION" in line) + 2
    garbage = [*sound[:turned_row], sound[turned_row][:38] + "  1.500000E+08", *sound[turned_row + 1 :]]
    dat.write_text("\n".join(garbage) + "\n")
    document, solution = judge(prepared, run)
    assert run.return_code == 0 and run.finished
    assert solution is None
    refused(document, "rotation_rad")


def test_gate_refuses_empty_results(concave, compliance, tmp_path):
    """A solver that returns 0 and writes nothing that can be read."""
    prepared, settings = prepared_at(concave, compliance, tmp_path, COARSE)
    fake = tmp_path / "ccx"
    fake.write_text("#!/bin/sh\necho ' Job finished'\n")
    fake.chmod(fake.stat().st_mode | stat.S_IXUSR)
    refused(analysis.solve(prepared, fake, settings), "pair_moment_error")


def refused(document, reason):
    """The named check is missed and there is no stress in the document."""
    assert not document["gate"][reason]["held"]
    assert document["pairs"] == [] and document["bending"] is None and document["rotation_rad"] is None
    json.dumps(document, allow_nan=False)


@pytest.mark.validate
def test_without_solver_the_input_is_written(monkeypatch, capsys, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    arguments = ["--torque-nm", "100", "--pairs", "1", "--folder", str(tmp_path / "runs"), "--json", "-"]
    status = main(["fe", "spherical-table-4-4-concave", *arguments])
    shown = capsys.readouterr()
    document = json.loads(shown.out)
    assert status == 1
    assert "apt-get install calculix-ccx" in shown.err
    text = Path(document["files"]["input"]).read_text()
    assert "C3D8I" in text and "TYPE=MORTAR" in text and "PRESSURE-OVERCLOSURE=HARD" in text and "*RIGID BODY" in text
    assert document["pairs"] == [] and document["elements"] > 1000
    main(["fe", "spherical-table-4-4-concave", *arguments, "--refine", "1.5"])
    assert json.loads(capsys.readouterr().out)["elements"] > 1.5 * document["elements"]


def test_no_pair_at_this_angle(capsys, tmp_path):
    """Between two pairs whose low teeth have left contact and not yet met."""
    arguments = ["spherical-table-4-4-concave", "--torque-nm", "100", "--phi-deg", "5.4", "--folder", str(tmp_path)]
    low = [f"--set=blank.{member}_tip_addendum_mm=1" for member in ("pinion", "wheel")]
    assert main(["fe", *arguments, *low]) == 2
    assert "--phi-deg" in capsys.readouterr().err


@pytest.mark.validate
def test_a_load_that_no_flank_carries_is_bad_input(capsys, tmp_path):
    arguments = ["spherical-table-4-4-concave", "--torque-nm", "1e12", "--pairs", "1", "--folder", str(tmp_path)]
    assert main(["fe", *arguments]) == 2
    assert "--torque-nm" in capsys.readouterr().err


def test_every_loaded_tooth_has_its_own_zone(concave):
    """Two pairs at different heights: the rows of each flank are finest at its own contact point."""
    angle = 0.35 * concave.pinion.pitch
    model = build_model(concave, angle, 3, TORQUE, np.array([850.0, 760.0]), MODEST)
    assert len(model.contacts) == 2
    assert all(body.mesh.smallest_jacobian() > 0.05 for body in model.bodies.values())
    for contact, pair in zip(model.contacts, model.deck.contacts, strict=True):
        mesh = model.deck.part("PINION").mesh
        centre = model.frame[:3, :3] @ contact.touch.point + model.frame[:3, 3]
        distances = np.linalg.norm(mesh.nodes[np.unique(mesh.face_nodes(pair.slave))] - centre, axis=1)
        assert distances.min() < 0.02
