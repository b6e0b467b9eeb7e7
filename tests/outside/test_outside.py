"""Drives outside the tree, and drives that are derived and compiled when they are first asked for."""

import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

from derive import drive_folder, pages
from derive.audit.checker import attempts
from derive.passes.equations import derive
from derive.passes.pivot_order import reduce
from meshwright import Drive
from meshwright.base import cache, drives, first_use
from meshwright.base import compile as build
from meshwright.base.errors import DesignError, LibraryError
from meshwright.base.library import text
from meshwright.cli import main
from meshwright.design import design
from meshwright.sweep import samples

ROOT = Path(__file__).resolve().parents[2]
FILE = Path(__file__).parent / "drives" / "crowned_worm.py"
NAME = "cylindrical_worm_zx_zx"
CALL = "import sys; from meshwright.cli import main; sys.exit(main(sys.argv[1:]))"


def run(*arguments, module=None, **environment):
    command = [sys.executable, *(("-m", module) if module else ("-c", CALL)), *map(str, arguments)]
    return subprocess.run(command, cwd=ROOT, env=os.environ | environment, capture_output=True, text=True)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder of drives with the one that the file defines, written where an older one was."""
    place = tmp_path_factory.mktemp("drives")
    for part in build.PARTS:
        (place / f"{NAME}{part.ending}.so").write_bytes(b"of other sources")
    done = run(FILE, "--into", place, module="derive")
    assert done.returncode == 0, done.stderr
    return place


@pytest.fixture
def crowned(tmp_path):
    """A design of that drive: the plain ZA worm with a crown of the blade."""

    def written(crown):
        tables = tomllib.loads((design.PACKAGED / "plain-za.toml").read_text(encoding="utf-8"))
        tables["design"] |= {"worm_profile": "ZX", "blade_crown_per_mm": crown}
        path = tmp_path / "crowned.toml"
        path.write_text(design.toml_text(tables), encoding="utf-8")
        return path

    return written


def _errors(*arguments, **environment):
    done = run(*arguments, "--json", "-", **environment)
    assert done.returncode == 0, done.stderr
    return np.array([p["transmission_error_arcsec"] for p in json.loads(done.stdout)["points"]])


def test_a_drive_of_one_file_is_solved_by_every_way_to_name_its_folder(folder, crowned):
    """A blade without crown is the straight one of a ZA worm; a crowned one bends the transmission error."""
    angles = ("--phi-deg", "-20:20:10")
    straight = _errors("tca", "plain-za", *angles)
    plain = crowned(0.0)
    assert np.abs(_errors("--drives", folder, "tca", plain, *angles) - straight).max() < 1e-9
    assert np.abs(_errors("tca", plain, *angles, MESHWRIGHT_DRIVES=str(folder)) - straight).max() < 1e-9
    bent = _errors("--drives", folder, "tca", crowned(0.002), *angles) - straight
    assert np.ptp(bent) > 1e-3


def test_no_object_of_what_the_drive_was_before_stays(folder):
    """An object beside the drive's own would be of its old equations."""
    assert [path.name for path in folder.glob("*.so")] == [f"{NAME}.so"]
    assert build.sealed(folder / f"{NAME}.so")


def test_many_designs_of_it_are_traced_in_lanes_of_their_own_object(folder, crowned, tmp_path, monkeypatch):
    """Compiled from the folder's headers when first asked for, into the cache: one by one they are the same."""
    monkeypatch.setenv(cache.CACHE, str(tmp_path / "cache"))
    own = Drive.load(crowned(0.001), drives=folder)
    crowns = np.linspace(0.0, 0.002, 9)
    found = samples.solve(own, ["design.blade_crown_per_mm"], crowns[:, None], np.radians([-10.0, 10.0]))
    for crown, errors in zip(crowns, found.error, strict=True):
        one = own.with_(design={"blade_crown_per_mm": crown}).tca(np.radians([-10.0, 10.0]))
        assert np.abs(errors - one.error).max() < 1e-12
    assert [path.name for path in tmp_path.glob("cache/*/*.so")] == [f"{NAME}_in_lanes.so"]
    assert text(own.design.model_in_lanes.drive) == NAME


def test_a_folder_may_be_called_like_a_command(folder, crowned, tmp_path, monkeypatch, capsys):
    (tmp_path / "drives").symlink_to(folder)
    monkeypatch.chdir(tmp_path)
    assert main(["--drives", "drives", "tca", str(crowned(0.001)), "--phi-deg", "0", "--json", "-"]) == 0
    assert json.loads(capsys.readouterr().out)["points"][0]["status"] == "converged"


def test_the_python_package_takes_a_folder_of_drives(folder, crowned):
    """The folder travels with the drive: the process knows nothing of it, drives made from the drive do."""
    angles = np.radians([-20.0, 0.0, 20.0])
    own = Drive.load(crowned(0.0), drives=folder)
    assert np.abs(own.tca(angles).error - Drive.load("plain-za").tca(angles).error).max() < 1e-14
    bent = own.with_(design={"blade_crown_per_mm": 0.002})
    casadi = Drive.load(crowned(0.002), backend="casadi", drives=folder).tca(angles)
    assert np.abs(casadi.error - bent.tca(angles).error).max() < 1e-12
    with pytest.raises(DesignError, match="blade_crown_per_mm|ZX"):
        Drive.load(crowned(0.002))
    assert str(folder) not in os.environ.get(drives.ENVIRONMENT, "")


def test_the_schema_offers_its_words_and_its_key(folder):
    shown = run("--drives", folder, "drives", "--json", "-").stdout
    (family,) = (f for f in json.loads(shown)["families"] if f["name"] == "cylindrical-worm")
    keys = {entry["key"]: entry for entry in family["keys"]}
    assert {"ZX", "ZA", "ZC"} <= set(keys["worm_profile"]["words"])
    assert "blade_crown_per_mm" in keys


def test_its_audit_entry_says_what_is_proved_checked_and_not(folder):
    entry = json.loads((folder / "audit" / f"{NAME}.json").read_text(encoding="utf-8"))
    assert "cylindrical_worm/contact" in entry["proved"]
    assert entry["not_proved"] == {}
    assert set(entry["checked"].values()) == {"holds"}
    assert entry["counts"] == {"holds": len(entry["checked"]), "does not hold": 0, "not decided": 0}
    assert entry["not_checked"] and entry["source"]["file"] == FILE.name


def test_a_generating_motion_may_turn_by_any_polynomial_of_its_angle(tmp_path):
    """The worm of a plane that does not roll evenly: its equation of meshing is linear by identities alone."""
    text = (FILE.parent / "hourglass_worm.py").read_text(encoding="utf-8")
    path = tmp_path / "uneven.py"
    path.write_text(text.replace("Rz(-ratio * theta)", "Rz(-ratio * theta - theta**3 / 1000)"), encoding="utf-8")
    assert path.read_text(encoding="utf-8") != text
    (page,) = pages.of_file(path)
    plan = reduce(derive(page.build()))
    assert len(plan.change) == len(plan.unknowns) == 5


GENERATED = ROOT / "generated" / "c" / "spherical_convex_spur.h"


@pytest.fixture
def header(monkeypatch):
    """A header that was generated, checked in seconds whatever is changed in it."""
    monkeypatch.setattr(attempts, "ATTEMPTS", 400)
    return GENERATED.read_text(encoding="utf-8")


def test_what_the_checker_of_c_does_not_foresee_is_neither_right_nor_wrong(header):
    """An eleventh of an angle, a word that is no statement, a header that is none."""
    angle = re.compile(r"(\n *)(double sin_\w+, cos_\w+; \w+_sincos\()(x\[\d+\]|p\[\d+\])(, &s)")
    eleventh = angle.sub(r"\1const double t_eleventh = \3 * 0.09090909090909091;\1\2t_eleventh\4", header)
    changed = {
        "an angle is a fraction of": eleventh,
        "not a straight-line statement": header.replace("    R[0] = ", "    goto R[0] = ", 1),
        "": "int main(void);\n",
    }
    for reason, wrong in changed.items():
        assert wrong != header
        found = drive_folder.checked(wrong)
        open_ = [verdict for verdict in found.values() if verdict != "holds"]
        assert open_ and all(verdict.startswith("not decided: ") and reason in verdict for verdict in open_), found


def test_what_is_wrong_in_c_does_not_hold_and_the_entry_counts_it(header):
    wrong = re.sub(r"J\[7\] = (.+);", r"J[7] = 2.0 * (\1);", header, count=1)
    wrong = re.sub(r"J\[7\] = 2.0 \* \((\w+)\);", r"J[7] = 2.0 * \1;", wrong)
    found = drive_folder.checked(wrong)
    assert found["jacobian of the residual"] == "does not hold: eval: J[1][2] is not the derivative of R[1]"
    about = {"name": "a_drive", "specification_hash": "", "equations": {}, "equations_of": {}, "keys": {}, "open": {}}
    entry = drive_folder.audit_entry(about, found | {"one more": "not decided: for a reason"}, None)
    failed = entry["counts"]["does not hold"]
    assert failed > 0 and entry["counts"]["not decided"] == 1 and sum(entry["counts"].values()) == len(found) + 1
    assert drive_folder.undecided_or_wrong(entry).endswith(f" holds, {failed} does not hold, 1 not decided")


@pytest.mark.validate
def test_what_a_c_compiler_refuses_is_said_by_the_function_of_the_description(tmp_path):
    """A function of the description that is called like one which every drive has."""
    path = tmp_path / "mine.py"
    another = 'functions=(Function("eval", "a function", (), (Result("one", (S(1),)),)),)'
    imported = "from derive.language.functions import Function, Result\nfrom sympy import S"
    text = CONTRADICTION.replace('handed="upright"', another).replace("from sympy import S", imported)
    path.write_text(text, encoding="utf-8")
    done = run(path, "--into", tmp_path / "out", module="derive")
    said = done.stderr.splitlines()[-1]
    assert done.returncode == 2 and "Traceback" not in done.stderr and "cc1" not in done.stderr
    assert said.startswith("a_drive: the C that is made of the description does not compile: the function eval, a_dri")
    assert said.endswith("another name in the description, or what it lacks") and "a_drive_eval" in said


def test_a_folder_that_is_none_is_refused(tmp_path):
    done = run("--drives", tmp_path / "nothing", "tca", "plain-za")
    assert done.returncode == 2 and "no such folder" in done.stderr and "python -m derive" in done.stderr


#: A drive of the tree under another name, with a hand that is none.
CONTRADICTION = """
from dataclasses import replace
from sympy import S
from derive.drives import spherical
from derive.language.symbols import Quantity, Unknown

def catalogue():
    d, L = spherical.spherical("spur", "spur"), Quantity("l_pinion", "mm")
    drive = replace(d, name="a_drive", handed="upright")
    return {"a_drive": lambda: drive}
"""


@pytest.mark.parametrize(
    ("text", "reason"),
    [("x = 1\n", "offers no catalogue()"), ("def catalogue(:\n", "line 1"),
     ("def catalogue():\n    return {'a': lambda: 1}\n", "builds a int"),
     ("def catalogue():\n    return ['a']\n", "catalogue() returns ['a']; return a dict"),
     ("def catalogue():\n    return {}\n", "catalogue() returns {}; return a dict"),
     (CONTRADICTION, "handed = 'upright'"),
     (CONTRADICTION.replace('handed="upright"', 'family="own"'), "outline of the family own: pinion_form = 'convex'"),
     (CONTRADICTION.replace('handed="upright"', 'sample=d.sample | {"module_mm": None}'), "None for 'module_mm'; give"),
     (CONTRADICTION.replace('handed="upright"', 'unknowns=(Unknown(L, S(-1)), *d.unknowns[1:])'),
      "natural size of the unknown l_pinion is -1 at the sample design; give one that is above 0"),
     (CONTRADICTION.replace('"a_drive"', '"face_worm"'), "name 'face_worm' is that of a drive of another family")],
)  # fmt: skip
def test_a_file_that_defines_no_drive_is_refused_with_the_reason(tmp_path, text, reason):
    path = tmp_path / "mine.py"
    path.write_text(text, encoding="utf-8")
    done = run(path, "--into", tmp_path / "out", module="derive")
    assert done.returncode == 2 and reason in done.stderr and "Traceback" not in done.stderr


@pytest.mark.validate
def test_a_combination_is_made_once_by_two_processes_and_again_where_its_file_is_damaged(tmp_path):
    """One line says so; a truncated object is compiled anew, not loaded."""
    pair = ["tca", "spherical-table-4-4-concave", "--set", "design.pinion_form=spur", "--set", "design.wheel_form=spur"]
    environment = os.environ | {cache.CACHE: str(tmp_path)}
    command = [sys.executable, "-c", CALL, *pair, "--phi-deg", "0"]
    both = [subprocess.Popen(command, cwd=ROOT, env=environment, stderr=subprocess.PIPE, text=True) for _ in range(2)]
    said = [process.communicate()[1] for process in both]
    assert [text.count("first use") for text in sorted(said, key=len)] == [0, 1], said
    (made,) = tmp_path.glob("*/*.so")
    whole = made.read_bytes()
    made.write_bytes(whole[: len(whole) // 2])
    again = run(*pair, "--phi-deg", "0", MESHWRIGHT_CACHE=str(tmp_path))
    assert "made anew" in again.stderr and made.read_bytes() == whole
    assert "first use" not in run(*pair, "--phi-deg", "0", MESHWRIGHT_CACHE=str(tmp_path)).stderr


def test_without_derive_the_remedy_is_named(tmp_path, monkeypatch):
    monkeypatch.setenv(cache.CACHE, str(tmp_path))
    monkeypatch.setattr(first_use.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(LibraryError, match=r"meshwright\[derive\]"):
        drives.folder_of("spherical_spur_convex")


def test_without_a_compiler_the_remedy_is_named(monkeypatch):
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setattr(build.shutil, "which", lambda name: None)
    monkeypatch.setattr(build.subprocess, "run", lambda *a, **k: subprocess.CompletedProcess(a, 1))
    with pytest.raises(build.CompileError, match="install gcc or clang"):
        build.compiler()
