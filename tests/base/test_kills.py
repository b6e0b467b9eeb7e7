"""Whatever is killed, and wherever: run again, it ends with the same bytes; and a full disk is called that.

A process is killed before any of its writes, locks, renamings and removals: see :mod:`tests.kills`.
"""

import gzip
import itertools
import os
import random
import subprocess
import sys
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

from derive import command, compiler, generated, pages, products
from derive.audit.standing import standings
from meshwright import Drive
from meshwright.base.errors import UsageError
from meshwright.base.files import locked
from meshwright.cli import main
from meshwright.design import design as designs
from meshwright.fe.solver import SolverRun
from meshwright.sweep import run as sweep
from tests import kills
from tests.quick import full, quick

if not hasattr(os, "fork"):
    pytest.skip("needs fork", allow_module_level=True)


def _resumed(run, folder, times, seed):
    """Folders in which ``run(place)`` was killed again and again, ``times`` in all, and then came to its end.

    The first attempt in a folder is killed before a write of its own, in random order: every write's turn comes where
    ``times`` allows, and in any case at full size.
    """
    (folder / "counted").mkdir()
    count, chance = kills.writes(lambda: run(folder / "counted"), folder / "counted"), random.Random(seed)
    assert count > 5
    yield folder / "counted"
    done, turns = 0, chance.sample(range(1, count + 1), count)
    for k, at in enumerate(itertools.cycle(turns)):
        if done >= times and not (full() and k < count):
            break
        place = folder / f"killed-{k}"
        place.mkdir()
        fresh = True
        while (fresh or done < times) and kills.killed(lambda place=place: run(place), place, at):
            fresh, done, at = False, done + 1, chance.randint(1, count)
        kills.ended(lambda place=place: run(place), place)
        yield place
    assert done >= times


def _all_alike(run, folder, times, seed, but=(".lock",)):
    want, *found = (kills.contents(place, but) for place in _resumed(run, folder, times, seed))
    assert found and all(one.keys() == want.keys() for one in found)
    assert all(one == want for one in found)


# ---- sweeps ----------------------------------------------------------------------------------------------------------


def _sweep(form="csv"):
    variations = (sweep.Variation("misalignment.vertical_deg", "uniform", -0.01, 0.01),)
    angles = tuple(np.radians(np.arange(-10.0, 11.0, 2.0)))
    plan = sweep.Plan(designs.read("plain-za"), variations, angles, 40, 0, seed=4)
    return lambda place: sweep.run(plan, place, form, threads=1)


@pytest.mark.validate
def test_a_sweep_killed_anywhere_ends_with_the_same_bytes(tmp_path, monkeypatch):
    monkeypatch.setattr(sweep, "SLICE_POINTS", 110)
    _all_alike(_sweep(), tmp_path, 100, seed=1)


@pytest.mark.parametrize("at", [1, 2, 3, 5, 8])
def test_a_sweep_on_a_full_disk_says_so_and_goes_on_when_there_is_room(tmp_path, monkeypatch, at):
    monkeypatch.setattr(sweep, "SLICE_POINTS", 110)
    run, want = _sweep(), tmp_path / "whole"
    run(want)
    place = tmp_path / "full"
    with kills.full_disk(monkeypatch, at), pytest.raises(UsageError, match="No space left on device.*make room"):
        run(place)
    run(place)
    assert kills.contents(place) == kills.contents(want)


# ---- generated files -------------------------------------------------------------------------------------------------

DRIVE = "spherical_spur_spur"


@pytest.fixture(scope="module")
def derived():
    """Files of a drive, derived once: what is killed here is their writing."""
    (page,) = pages.pages([DRIVE])
    return compiler.compile_drive(page, standings, command.log).files


@pytest.mark.parametrize("write", quick([generated.replace, generated.add], generated.add))
@pytest.mark.parametrize("times", quick([8, 100], 8))
def test_files_whose_writing_was_killed_anywhere_end_as_the_same_bytes(tmp_path, derived, times, write):
    """Over a folder of an earlier version, with a file that there is no more."""
    old = {"c/old_drive.h": "", **dict.fromkeys([*derived][:3], "of an earlier version\n")}

    def over_an_older(place):
        if not (place / "manifest.json").exists():
            for name, text in old.items():
                (place / name).parent.mkdir(exist_ok=True)
                (place / name).write_text(text)
            (place / "manifest.json").write_text(products.manifest(old))
        write(place, derived)

    _all_alike(over_an_older, tmp_path, times, seed=2)


def test_a_full_disk_is_named_and_leaves_the_old_files(tmp_path, monkeypatch, capsys, derived):
    generated.replace(tmp_path, derived)
    before = kills.contents(tmp_path)
    grown = compiler.Compiled(DRIVE, {name: text + "\n" for name, text in derived.items()}, {}, {})
    monkeypatch.setattr(compiler, "compile_drive", lambda *arguments, **options: grown)
    with kills.full_disk(monkeypatch, 1):
        assert command.main([DRIVE, "--output", str(tmp_path)]) == 2
    assert "No space left on device" in capsys.readouterr().err
    after = kills.contents(tmp_path)
    assert all(after[name] == before[name] for name in after)


@pytest.mark.validate
def test_a_derivation_killed_at_any_time_ends_as_the_same_bytes(tmp_path):
    """The whole process, killed by the clock: eight times, from its start to its writing."""
    line = [sys.executable, "-m", "derive", DRIVE, "--output"]
    subprocess.run([*line, tmp_path / "whole"], check=True, capture_output=True)
    chance = random.Random(3)
    for _ in range(8):
        with subprocess.Popen([*line, tmp_path / "killed"], stderr=subprocess.DEVNULL) as process:
            try:
                process.wait(chance.uniform(0.1, 6.0))
            except subprocess.TimeoutExpired:
                process.kill()
    subprocess.run([*line, tmp_path / "killed"], check=True, capture_output=True)
    found, want = kills.contents(tmp_path / "killed"), kills.contents(tmp_path / "whole")
    assert {name: text for name, text in found.items() if not name.endswith(".part")} == want


# ---- finite elements -------------------------------------------------------------------------------------------------


@pytest.fixture
def analysis(monkeypatch):
    """The analysis of a position, its coarse mesh made once; its solver writes recorded results, which are accepted."""
    pytest.importorskip("scipy")
    from meshwright.fe import analysis, solids, stress
    from meshwright.fe.model import build_model
    from tests.fe.test_stress import COARSE, RECORDED, TORQUE

    gear, forces = solids.gear_pair(Drive.load("spherical-table-4-4-concave")), np.array([1612.4])
    model = build_model(gear, 0.0, 1, TORQUE, forces, COARSE)
    found = {".frd": gzip.decompress((RECORDED / "model.frd.gz").read_bytes()),
             ".dat": (RECORDED / "model.dat").read_bytes()}  # fmt: skip
    deck = analysis.write(model.deck)

    def solved(ccx, input_file, *limits):
        for ending, content in found.items():
            input_file.with_suffix(ending).write_bytes(content)
        return SolverRun(0, 1.0, "Job finished")

    def accepted(prepared, run):
        solution = stress.read_solution(prepared.model, prepared.input_file)
        return analysis._document(prepared, {}, solution), solution

    def drawn(model, solution, folder):
        (folder / "pressure.png").write_bytes(b"a picture")
        return {"pressure": "pressure.png"}

    loaded = SimpleNamespace(pairs=[SimpleNamespace(force=f) for f in forces], pinion_angle=0.0, rotation=1e-4)
    for name, stands_in in {
        "loaded_contact": lambda *given: loaded, "build_model": lambda *given: model, "write": lambda *given: deck,
        "run_ccx": solved, "judge": accepted, "draw": drawn,
    }.items():  # fmt: skip
        monkeypatch.setattr(analysis, name, stands_in)
    settings = analysis.Settings(1, 600.0, density=COARSE)

    def run(folder):
        with locked(folder, "finite-element run"):
            prepared = analysis.prepare(gear, {}, 0.0, TORQUE, settings, folder / "at-0")
            if analysis.earlier_result(prepared) is None:
                analysis.solve(prepared, None, settings)

    return run


@pytest.mark.parametrize("times", quick([3, 60], 3))
def test_a_finite_element_run_killed_anywhere_ends_with_the_same_bytes(tmp_path, analysis, times):
    def plain(place):
        """Contents, but for the name of the folder itself."""
        files = kills.contents(place, (".lock",))
        return {name: text.replace(str(place).encode(), b"") for name, text in files.items()}

    want, *found = (plain(place) for place in _resumed(analysis, tmp_path, times, seed=5))
    assert found and all(one == want for one in found)
    assert {"at-0/result.json", "at-0/pinion.vtu", "at-0/wheel.vtu", "at-0/model.inp"} <= want.keys()


def test_a_folder_has_one_finite_element_run_at_a_time(tmp_path, capsys):
    arguments = ["fe", "spherical-table-4-4-concave", "--torque-nm", "100", "--folder", str(tmp_path)]
    with locked(tmp_path, "finite-element run"):
        assert main(arguments) == 2
    assert "another finite-element run is at work here; wait for it to end" in capsys.readouterr().err
    (tmp_path / "file").write_text("")
    assert main([*arguments[:-1], str(tmp_path / "file" / "folder")]) == 2
    assert "cannot be made (Not a directory); name another folder" in capsys.readouterr().err


@pytest.mark.parametrize("at", [1, 3])
def test_a_finite_element_run_on_a_full_disk_says_so_and_goes_on(tmp_path, monkeypatch, analysis, at):
    place = tmp_path / "full"
    place.mkdir()
    with kills.full_disk(monkeypatch, at), pytest.raises(UsageError, match="No space left on device.*make room"):
        analysis(place)
    analysis(place)
    assert {"result.json", "pinion.vtu", "wheel.vtu", "model.inp"} <= {path.name for path in place.rglob("*")}


# ---- a power cut -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("what", ["sweep", "derive", "fe"])
def test_whatever_takes_a_place_is_on_the_disk_before(tmp_path, monkeypatch, request, what):
    if what == "fe":
        run = request.getfixturevalue("analysis")
    elif what == "sweep":
        run = _sweep()
    else:
        run = partial(generated.replace, files=request.getfixturevalue("derived"))
    synchronised, placed, sync, replace = set(), [], os.fsync, os.replace

    def noted(handle):
        sync(handle)
        found = os.fstat(handle)
        synchronised.add((found.st_ino, found.st_size))

    def checked(source, target):
        found = os.stat(source)
        placed.append((os.path.basename(target), (found.st_ino, found.st_size) in synchronised))
        replace(source, target)

    monkeypatch.setattr(os, "fsync", noted)
    monkeypatch.setattr(os, "replace", checked)
    (tmp_path / "place").mkdir()
    run(tmp_path / "place")
    assert len(placed) >= 3 and all(safe for _, safe in placed), placed
