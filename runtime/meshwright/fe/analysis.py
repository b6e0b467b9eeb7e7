"""One finite-element position from gear pair to judged result, kept in a folder so that it need not be solved twice."""

import hashlib
import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshwright.base.files import remove_parts, write_json, write_text
from meshwright.fe import stress
from meshwright.fe.compliance import ToothCompliance
from meshwright.fe.deck import write
from meshwright.fe.gate import LARGEST_ROTATION, Check, accept
from meshwright.fe.grading import MeshDensity
from meshwright.fe.hertz import elliptic_contact
from meshwright.fe.hexahedra import HexMesh
from meshwright.fe.loaded import FAR_TOO_FAR, LoadedContact, LoadedPair, loaded_contact
from meshwright.fe.material import contact_modulus, max_principal, von_mises
from meshwright.fe.model import Load, PairModel, build_model
from meshwright.fe.pair import GearPair, tangencies_only
from meshwright.fe.pictures import draw
from meshwright.fe.solver import SolverRun, run_ccx
from meshwright.fe.stress import Solution
from meshwright.fe.vtu import vtu_text

SCHEMA = "meshwright.fe/1"

_INPUT = "model.inp"
_RESULT = "result.json"


@dataclass(frozen=True)
class Settings:
    """How a position is analysed: pairs modelled, time limit in s, threads of the solver, mesh."""

    pairs: int
    time_limit: float
    threads: int = 1
    density: MeshDensity = MeshDensity()


@dataclass(frozen=True)
class Prepared:
    """A position whose input is written: semi-analytic contact, model, folder and fingerprint of the input.

    refine: how many times as many elements to a semi-minor axis the mesh has as it has by default.
    """

    gear: GearPair
    loaded: LoadedContact
    model: PairModel
    refine: float
    folder: Path
    fingerprint: str

    @property
    def input_file(self) -> Path:
        """The CalculiX input."""
        return self.folder / _INPUT


def prepare(
    gear: GearPair,
    compliance: dict[str, ToothCompliance],
    pinion_angle: float,
    load: Load,
    settings: Settings,
    folder: Path,
) -> Prepared:
    """Find the forces semi-analytically, build the mesh for them and write the input into ``folder``.

    Whoever calls this holds the lock of the folder. Raises ArithmeticError where the loaded contact does not settle, or
    the teeth give way so far that no mesh can be made for it.
    """
    loaded = loaded_contact(tangencies_only(gear), pinion_angle, settings.pairs, load, compliance)
    if abs(loaded.rotation) > FAR_TOO_FAR * LARGEST_ROTATION:
        raise ArithmeticError(
            f"the loaded member would turn by {loaded.rotation:.3g} rad, where up to {LARGEST_ROTATION:g} rad are "
            "small: choose a smaller torque"
        )
    forces = np.array([pair.force for pair in loaded.pairs])
    model = build_model(gear, pinion_angle, settings.pairs, load, forces, settings.density)
    text = write(model.deck)
    folder.mkdir(parents=True, exist_ok=True)
    remove_parts(folder)
    refine = settings.density.per_semi_minor / MeshDensity().per_semi_minor
    prepared = Prepared(gear, loaded, model, refine, folder, hashlib.sha256(text.encode()).hexdigest())
    write_text(prepared.input_file, text)
    return prepared


def earlier_result(prepared: Prepared) -> dict | None:
    """The accepted result of the same input from an earlier call, if its folder holds one."""
    try:
        kept = json.loads((prepared.folder / _RESULT).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return kept["result"] if kept.get("input_sha256") == prepared.fingerprint else None


def solve(
    prepared: Prepared, ccx: Path, settings: Settings, progress: Callable[[str], None] = lambda line: None
) -> dict:
    """Run the solver, judge what it returns, and keep it, with fields and pictures, if it is accepted."""
    for stale in (prepared.folder / _RESULT, *map(prepared.input_file.with_suffix, (".frd", ".dat"))):
        stale.unlink(missing_ok=True)
    run = run_ccx(ccx, prepared.input_file, settings.time_limit, settings.threads, progress)
    document, solution = judge(prepared, run)
    document["message"] = _ending(run, prepared.input_file)
    if solution is not None:
        document["files"] |= _write_fields(prepared, solution) | draw(prepared.model, solution, prepared.folder)
        write_json(prepared.folder / _RESULT, {"input_sha256": prepared.fingerprint, "result": document})
    return document


def _ending(run: SolverRun, input_file: Path) -> str:
    """Why the solver did not finish; empty if it did."""
    if run.finished:
        return ""
    if run.stopped:
        return run.stopped
    return f"the solver did not finish: {input_file.with_suffix('.log')} says why"


def judge(prepared: Prepared, run: SolverRun) -> tuple[dict, Solution | None]:
    """The position's document and, if it passes the acceptance gate, its solution; else there is no stress in it."""
    solution = _read(prepared, run)
    checks = accept(run, solution, prepared.model.load.torque, _references(prepared, solution))
    accepted = solution if all(check.held for check in checks.values()) else None
    return _document(prepared, checks, accepted), accepted


def without_solver(prepared: Prepared) -> dict:
    """The document of a position that is written but not solved."""
    unsolved = SolverRun(None, 0.0, "")
    document = _document(prepared, accept(unsolved, None, prepared.model.load.torque, []), None)
    return document | {"message": "the input is written, not solved: there is no solver"}


def _read(prepared: Prepared, run: SolverRun) -> Solution | None:
    if not run.finished:
        return None
    try:
        return stress.read_solution(prepared.model, prepared.input_file)
    except (OSError, KeyError, ValueError, IndexError):
        return None


def _references(prepared: Prepared, solution: Solution | None) -> list[list[float]]:
    """Peak pressures that each pair may be compared with: Hertz under its own force and the semi-analytic one."""
    if solution is None:
        return []
    references: list[list[float]] = []
    for pair, found in zip(prepared.loaded.pairs, solution.pairs, strict=True):
        force = float(np.linalg.norm(found.force))
        if force <= 0.0 or pair.hertz is None or not _inside(pair):
            references.append([])
            continue
        touch, gear = pair.contact.touch, prepared.gear
        modulus = contact_modulus(gear.pinion.material, gear.wheel.material)
        hertz = elliptic_contact(
            force, touch.curvature_min, touch.curvature_max, modulus, gear.pinion.material.poisson_ratio
        )
        semi_analytic = pair.peak_pressure * (force / pair.force) ** (1.0 / 3.0)
        references.append([hertz.peak_pressure, semi_analytic])
    return references


def _inside(pair: LoadedPair) -> bool:
    """Whether the whole contact ellipse lies inside both flanks."""
    if pair.hertz is None:
        return False
    return not pair.cut_off


def _document(prepared: Prepared, checks: dict[str, Check], solution: Solution | None) -> dict:
    deck = prepared.model.deck
    document = {
        "schema": SCHEMA,
        "message": "",
        "torque_nm": prepared.model.load.torque / 1000.0,
        "torque_on": prepared.model.load.member,
        "pinion_angle_deg": float(np.degrees(prepared.loaded.pinion_angle)),
        "elements": deck.element_count,
        "nodes": deck.node_count,
        "refine": prepared.refine,
        "gate": {name: {"value": c.value, "limit": c.limit, "held": c.held} for name, c in checks.items()},
        "pairs": [],
        "bending": None,
        "rotation_rad": None,
        "files": {"input": str(prepared.input_file)},
    }
    if solution is not None:
        document["pairs"] = [
            {
                "pairs_later": contact.pairs_later,
                "force_n": float(np.linalg.norm(pair.force)),
                "peak_pressure_mpa": pair.peak_pressure,
                "subsurface_von_mises_mpa": pair.subsurface_von_mises,
            }
            for contact, pair in zip(prepared.model.contacts, solution.pairs, strict=True)
        ]
        document["bending"] = {
            name: {"von_mises_mpa": b.von_mises, "max_principal_mpa": b.max_principal}
            for name, b in solution.bending.items()
        }
        document["rotation_rad"] = solution.rotation
    return document


def _write_fields(prepared: Prepared, solution: Solution) -> dict[str, str]:
    files = {}
    for name in prepared.model.bodies:
        mesh: HexMesh = prepared.model.deck.part(name.upper()).mesh
        nodal = {
            "displacement_mm": solution.displacements[name],
            "von_mises_mpa": von_mises(solution.stresses[name]),
            "max_principal_mpa": max_principal(solution.stresses[name]),
        }
        if name == "pinion":
            nodal["contact_pressure_mpa"] = np.zeros(len(mesh.nodes))
            for nodes, values in solution.pressures:
                nodal["contact_pressure_mpa"][nodes] = values
        path = prepared.folder / f"{name}.vtu"
        write_text(path, vtu_text(mesh, nodal))
        files[f"vtu_{name}"] = str(path)
    return files
