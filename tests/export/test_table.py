"""Tables of a drive's error: pieces within their bound of contacts solved one by one, in every format."""

import csv
import ctypes
import json

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.errors import UsageError
from meshwright.cli import main
from meshwright.contact.results import ARCSEC
from meshwright.cycle.pairs import Mesh
from meshwright.export import stiffness
from meshwright.export.table import DEGREE, STEP, table
from tests.contact.test_paths_agree import VARIED, _random
from tests.embedding import compile as c
from tests.quick import quick

TOLERANCE = 1e-6 * ARCSEC

#: A contact that is solved: what its error lacks, rad.
SOLVED = 2e-9 * ARCSEC


def _away_from_joints(pieces, angles, pitch):
    """Angles (M,) of a pitch that are not beside a place where one piece ends and the next begins."""
    joints = np.array([end for piece in pieces for end in (piece.begin, piece.end)])
    return angles[(np.abs(angles[:, None] - joints) > 1e-8 * pitch).all(axis=1)]


@pytest.mark.parametrize("name", quick(VARIED, "helical-crowned", "recess-action-full", "bevel-face-hobbed"))
def test_a_table_is_within_its_bound_of_contacts_solved_one_by_one(name):
    """Of both flanks: the error of the pair that the piece names, and of the drive with all its pairs."""
    generator = np.random.default_rng(len(name))
    for drive in (Drive.load(name), _random(name, generator)):
        if not Mesh.of(drive).window.complete or Mesh.of(drive).path is None:
            continue
        try:
            found, pitch = table(drive, TOLERANCE), drive.pitch()
        except UsageError as error:  # of a random design, which may ride on a place where nothing is proved
            assert "no proof of contact" in str(error) and drive.design.tables["misalignment"]
            continue
        angles = _away_from_joints((*found.drive, *found.coast), np.sort(generator.uniform(0.0, pitch, 60)), pitch)
        at = drive.cycle(angles)
        assert found.errors(angles) == pytest.approx(at.drive.errors, abs=found.bound + SOLVED, nan_ok=True)
        slopes = 1e3 * found.bound / pitch + 1e-12
        assert found.ratios(angles) == pytest.approx(at.drive.ratios, abs=slopes, nan_ok=True)
        if found.coast:
            assert found.errors(angles, "coast") == pytest.approx(
                at.coast.errors, abs=found.bound + SOLVED, nan_ok=True
            )
        for piece in found.drive:
            own = np.linspace(piece.begin, piece.end, 5)[1:-1]
            alone = drive.tca(own - piece.pair * pitch).error
            assert piece.at(own) == pytest.approx(alone, abs=found.bound + SOLVED)


@pytest.mark.parametrize(
    "name", ["helical-crowned", pytest.param("spur-profile-shift", marks=pytest.mark.validate), "crossed-helical-17-23"]
)
def test_pieces_cover_a_pitch_and_join(name):
    found = table(Drive.load(name), TOLERANCE)
    for pieces in (found.drive, found.coast):
        assert pieces[0].begin == 0.0 and pieces[-1].end == found.pitch
        for before, after in zip(pieces, pieces[1:], strict=False):
            assert before.end == after.begin
            assert abs(before.at(before.end) - after.at(after.begin)) < max(STEP, found.bound)
        assert max(len(piece.chebyshev) for piece in pieces) <= DEGREE + 1
        last, first = pieces[-1], pieces[0]
        assert float(last.at(last.end)) == pytest.approx(float(first.at(0.0)), abs=found.bound)


@pytest.mark.validate
def test_flanks_that_touch_along_lines_have_one_error():
    drive = Drive.load("spur-profile-shift").with_(design={"center_distance_mm": 56.6})
    found = table(drive, TOLERANCE)
    (one,), (other,) = found.drive, found.coast
    assert len(one.chebyshev) == len(other.chebyshev) == 1
    assert other.chebyshev[0] - one.chebyshev[0] == pytest.approx(found.backlash, abs=2.0 * SOLVED)
    assert found.backlash / ARCSEC == pytest.approx(538.943571928485, abs=1e-9)


def _written(folder, name, *options):
    path = folder / name
    assert main(["export", "helical-crowned", "--table", str(path), *options]) == 0
    return path


def test_c_of_a_table_gives_its_errors_at_any_angle(tmp_path):
    source, library = _written(tmp_path, "te.c"), tmp_path / "te.so"
    (command, plus) = sorted(c.compilers().items())[-1][1]
    c.run(*command, "-std=c99", "-O2", *c.STRICT, *c.EXACT, "-shared", "-fPIC", source, "-o", library)
    c.run(*plus, "-std=c++11", *c.STRICT, "-x", "c++", "-fsyntax-only", source)
    loaded = ctypes.CDLL(library)
    for function in (loaded.te_error, loaded.te_ratio):
        function.restype, function.argtypes = ctypes.c_double, [ctypes.c_double, ctypes.c_int]
    bound, drive = ctypes.c_double.in_dll(loaded, "te_bound").value, Drive.load("helical-crowned")
    assert 0.0 < bound < TOLERANCE
    angles = np.concatenate([np.random.default_rng(7).uniform(-9.0, 9.0, 200), [0.0, drive.pitch(), -1e6, 1e9]])
    at = drive.cycle(angles)
    assert [loaded.te_error(a, 0) for a in angles] == pytest.approx(at.drive.errors, abs=bound + SOLVED)
    assert [loaded.te_error(a, 1) for a in angles] == pytest.approx(at.coast.errors, abs=bound + SOLVED)
    assert [loaded.te_ratio(a, 0) for a in angles] == pytest.approx(at.drive.ratios, abs=1e-8)
    for none in (np.nan, np.inf, 2e12):
        assert np.isnan(loaded.te_error(none, 0))


def test_json_of_a_table_says_what_the_page_says(tmp_path):
    found, drive = json.loads(_written(tmp_path, "te.json").read_text()), Drive.load("helical-crowned")
    assert found["schema"] == "meshwright.table/1"
    assert found["pitch_rad"] == drive.pitch() and found["ratio"] == drive.ratio and found["sense"] == 1
    assert found["backlash_rad"] / ARCSEC == pytest.approx(1.0082373729, abs=6e-11)
    piece = next(p for p in found["drive"] if p["begin_rad"] <= 0.15 <= p["end_rad"])
    share = (2.0 * 0.15 - piece["begin_rad"] - piece["end_rad"]) / (piece["end_rad"] - piece["begin_rad"])
    error = np.polynomial.chebyshev.chebval(share, piece["chebyshev"])
    assert piece["pair"] == 1
    assert error == pytest.approx(-5.1329091875 * ARCSEC, abs=found["error_bound_rad"] + 1e-10 * ARCSEC)


def test_sampled_formats_and_arrays_hold_the_same(tmp_path):
    drive = Drive.load("helical-crowned")
    with open(_written(tmp_path, "te.csv"), newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert list(rows[0]) == ["pinion_angle_rad", "drive_error_rad", "drive_ratio", "coast_error_rad"]
    angles = np.array([float(row["pinion_angle_rad"]) for row in rows])
    assert angles[0] == 0.0 and angles[-1] == drive.pitch()
    errors = np.array([float(row["drive_error_rad"]) for row in rows])
    assert errors == pytest.approx(drive.cycle(angles).drive.errors, abs=TOLERANCE)
    lines = _written(tmp_path, "te.txt").read_text().splitlines()
    assert lines[0] == "#1" and lines[2] == f"double te({len(rows)},2)"
    modelica = np.array([[float(word) for word in line.split()] for line in lines[3:]])
    assert modelica[0, 1] == modelica[-1, 1] and np.array_equal(modelica[:-1, 1], errors[:-1])
    arrays = np.load(_written(tmp_path, "te.npz"))
    assert arrays["drive_chebyshev"].shape[0] == len(arrays["drive_begin_rad"]) == len(arrays["drive_pair"])
    assert arrays["error_bound_rad"] < TOLERANCE


def test_what_edges_may_do_is_said(tmp_path, capsys):
    """Hypoid gears with a contact ratio below 1: a table with a gap, and exit status 1."""
    path = tmp_path / "te.c"
    assert main(["export", "bevel-hypoid-formate", "--table", str(path)]) == 1
    said = capsys.readouterr().err
    assert "an edge may touch before the pair that leads" in said and "no pair touches within its limits" in said
    assert path.exists()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--table", "te.xls"], "name a file that ends in .c"),
        (["--table", "1-te.c"], "use letters, digits and _ alone"),
        (["--table", "te.c", "--json", "-"], "--json: --table has no use for it"),
        (["--table", "te.c", "--torque-nm", "20"], "te.c has no place for stiffness"),
        (["--table", "te.json", "--torque-nm", "20,0"], "not torques above zero"),
        (["--rexs", "te.rexs", "--tolerance-arcsec", "1"], "--tolerance-arcsec: --rexs has no use for it"),
        (["--table", "te.c", "--tolerance-arcsec", "1e-9"], "the errors are proved to"),
        (["--table", "te.c", "--coast", "plain-za"], "not the other flank of"),
    ],
)
def test_what_makes_no_table_is_refused(tmp_path, monkeypatch, capsys, words, said):
    monkeypatch.chdir(tmp_path)
    assert main(["export", "helical-crowned", *words]) == 2
    assert said in capsys.readouterr().err
    assert not [*tmp_path.iterdir()]


def test_flanks_on_edges_have_no_table(tmp_path, capsys):
    words = ["export", "spur-profile-shift", "--set", "misalignment.vertical_deg=0.05", "--table"]
    assert main([*words, str(tmp_path / "te.json")]) == 2
    assert "flanks touch on edges" in capsys.readouterr().err


@pytest.mark.validate
def test_stiffness_at_the_wheel_is_that_of_loaded_contact(tmp_path, monkeypatch, capsys):
    """T/(m² rotation) of the pinion's torque, at the angles of the table; in Modelica's text too."""
    monkeypatch.setattr(stiffness, "SAMPLES", 2)
    path, drive = _written(tmp_path, "te.json", "--torque-nm", "20,50"), Drive.load("helical-crowned")
    for under in json.loads(path.read_text())["stiffness"]:
        torque, angles = under["torque_nm"], np.degrees(under["pinion_angle_rad"][:2])
        asked = ",".join(map(repr, angles.tolist()))
        assert main(["loaded", "helical-crowned", "--torque-nm", str(torque), f"--phi-deg={asked}", "--json", "-"]) == 0
        points = json.loads(capsys.readouterr().out)["points"]
        expected = [torque / (drive.ratio**2 * point["rotation_rad"]) for point in points]
        assert under["torque_on"] == "pinion"
        assert under["mesh_at_wheel_nm_per_rad"] == pytest.approx([*expected, expected[0]], rel=1e-9)
        assert 0.3 * min(expected) < under["pair_at_wheel_nm_per_rad"] < max(expected)
    lines = _written(tmp_path, "te.txt", "--torque-nm", "20,50").read_text().splitlines()
    at = lines.index("double stiffness(3,3)")
    last = [float(word) for word in lines[at + 3].split()]
    assert last[0] == drive.pitch() and last[2] == under["mesh_at_wheel_nm_per_rad"][2]
