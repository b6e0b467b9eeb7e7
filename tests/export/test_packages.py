"""Packages for Rust and for JavaScript: what they print has the bits of the library."""

import json
import subprocess

import numpy as np
import pytest

import meshwright
from meshwright import Drive
from meshwright.cli import main
from tests.embedding import compile as c

ANGLES = np.array([0.05, 0.15, -3.0, 0.0, 1e6, -1e12, 7.0])
GIVEN = "".join(f"{float(angle)!r}\n" for angle in ANGLES)

#: Prints every number of the whole drive at the angles on standard input.
CYCLES = """
import { readFileSync } from "node:fs";
import { load } from "./index.js";
const mesh = await load();
const all = readFileSync(0, "utf8").trim().split("\\n").map((line) => mesh.cycle(Number(line)));
console.log(JSON.stringify(all.map((at) => [at, String(at.coast.error), String(at.backlash)])));
try { mesh.follow("1"); } catch (error) { console.log(error.message); }
"""


def _exported(folder, kind, *options):
    design, *options = options or ("helical-crowned",)
    assert main(["export", design, f"--{kind}", str(folder), *options]) == 0
    return folder


def _lines(command, folder, **environment):
    done = subprocess.run(command, input=GIVEN, capture_output=True, text=True, cwd=folder, env=environment or None)
    assert done.returncode == 0, done.stderr
    return [line.split() for line in done.stdout.splitlines()]


def _as_the_library(drive, lines):
    turned = drive.turn(ANGLES)
    assert [float(pair) for pair, _ in lines] == turned.pairs.tolist()
    assert np.array_equal([float(error) for _, error in lines], turned.errors, equal_nan=True)


def test_a_crate_follows_a_drive_with_the_bits_of_the_library(tmp_path):
    if not c.tool("cargo"):
        pytest.skip("cargo is not installed")
    folder = _exported(tmp_path / "helical", "crate")
    command = [c.tool("cargo"), "run", "--quiet", "--offline", "--example", "follow"]
    _as_the_library(Drive.load("helical-crowned"), _lines(command, folder))


@pytest.fixture(scope="module")
def module(tmp_path_factory):
    """The folder of a left-handed worm drive as an npm package: the mirror image of what is solved."""
    if not c.tool("node"):
        pytest.skip("node is not installed")
    folder = tmp_path_factory.mktemp("packages") / "left-worm"
    return _exported(folder, "npm", "plain-zn", "--set", "design.hand=left")


def test_an_npm_package_follows_a_drive_with_the_bits_of_the_library(module):
    drive = Drive.load("plain-zn").with_(design={"hand": "left"})
    _as_the_library(drive, _lines([c.tool("node"), "example.mjs"], module))
    assert json.loads((module / "package.json").read_text())["name"] == "left-worm"


def test_an_npm_package_gives_the_whole_drive(module):
    (module / "cycles.mjs").write_text(CYCLES)
    done = subprocess.run(
        [c.tool("node"), "cycles.mjs"], input=GIVEN, capture_output=True, text=True, cwd=module, check=True
    )
    told, refused = done.stdout.splitlines()
    assert refused == "phi = 1: no number; give a pinion angle, rad"
    known = Drive.load("plain-zn").with_(design={"hand": "left"}).cycle(ANGLES)
    for k, (at, coast, backlash) in enumerate(json.loads(told)):
        assert float(coast) == known.coast.errors[k] and float(backlash) == known.backlash[k]
        assert at["drive"]["error"] == known.drive.errors[k] and at["drive"]["ratio"] == known.drive.ratios[k]
        assert at["drive"]["pair"] == known.drive.pairs[k] and at["drive"]["edge"] == known.drive.edges[k]
        assert at["drive"]["status"] == known.drive.statuses[k] and at["coast"]["pairs"] == known.coast.touching[k]


def test_flanks_with_designs_of_their_own_make_one_package(tmp_path):
    folder = _exported(tmp_path / "pair", "crate", "face-worm-conical-convex", "--coast", "face-worm-conical-concave")
    source = (folder / "c" / "mesh.c").read_text()
    assert "HAS_COAST = 1" in source
    alone = _exported(tmp_path / "alone", "crate", "face-worm-conical-convex")
    assert "HAS_COAST = 0" in (alone / "c" / "mesh.c").read_text()


@pytest.mark.parametrize(
    ("name", "said"), [("Helical", "use small letters, digits, - and _ alone"), ("full", "name a new folder")]
)
def test_a_folder_that_makes_no_package_is_refused(tmp_path, capsys, name, said):
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "file").touch()
    assert main(["export", "helical-crowned", "--crate", str(tmp_path / name)]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize("standard", ["c99"])
def test_the_folder_of_headers_is_named_by_python(tmp_path, standard):
    (tmp_path / "a.c").write_text('#include "face_worm.h"\n#include "meshwright.h"\nint main(void) { return 0; }\n')
    command = sorted(c.compilers().items())[-1][1][0]
    c.run(*command, f"-std={standard}", "-fsyntax-only", f"-I{meshwright.get_include()}", tmp_path / "a.c")
