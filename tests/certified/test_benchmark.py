"""The benchmark set: designs, certified tables and a manifest that are consistent with one another."""

import csv
import hashlib
import json
from pathlib import Path

import pytest

from meshwright import Drive
from meshwright.cli import main

ROOT = Path(__file__).resolve().parents[2]
COMMITTED = ROOT / "generated" / "benchmark"


def written(folder, *names):
    arguments = [word for name in names for word in ("--design", name)]
    assert main(["benchmark", str(folder), *arguments]) == 0
    return json.loads((folder / "contacts.json").read_text(encoding="utf-8"))["cases"]


def check(folder, cases):
    with open(folder / "contacts.csv", encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == sum(len(case["points"]) for case in cases)
    graph = json.loads((folder / "ro-crate-metadata.json").read_text(encoding="utf-8"))["@graph"]
    files = {entry["@id"]: entry for entry in graph if entry["@type"] == "File"}
    assert {case["design"] for case in cases} | {"contacts.json", "contacts.csv"} == set(files)
    for name, entry in files.items():
        assert hashlib.sha256((folder / name).read_bytes()).hexdigest() == entry["sha256"]
    (root,) = [entry for entry in graph if entry["@id"] == "./"]
    assert {part["@id"] for part in root["hasPart"]} == set(files)


def test_each_case_has_a_design_file_and_bounds_that_hold_what_it_solves(tmp_path):
    cases = written(tmp_path, "recess-action-semi")
    check(tmp_path, cases)
    assert len(cases) >= 4  # aligned, and each misalignment
    for case in cases[:2]:
        drive = Drive.load(str(tmp_path / case["design"])).with_(**case["changes"])
        point = case["points"][2]
        assert point["outcome"] == "unique"
        result = drive.tca([float(point["pinion_angle_deg"]) * 3.141592653589793 / 180])
        low, high = point["transmission_error_arcsec"]
        assert low - 1e-9 <= result.error[0] * 648000 / 3.141592653589793 <= high + 1e-9
        for bounds, curvature in zip(point["relative_curvature_per_mm"], result.curvatures[0], strict=True):
            assert bounds[0] - 1e-9 <= curvature <= bounds[1] + 1e-9


@pytest.mark.validate
def test_the_whole_set_has_thirty_cases_over_all_families(tmp_path):
    cases = written(tmp_path)
    check(tmp_path, cases)
    assert len(cases) >= 30
    assert sum(point["outcome"] == "unique" for case in cases for point in case["points"]) >= 150
    assert (tmp_path / "contacts.json").stat().st_size < 2_000_000
    assert_committed(tmp_path, cases)


def assert_committed(folder, cases):
    """What is written is what is committed, byte for byte: design files, and every number of each case."""
    committed = json.loads((COMMITTED / "contacts.json").read_text(encoding="utf-8"))["cases"]
    known = {case["name"]: case for case in committed}
    for case in cases:
        assert json.dumps(case) == json.dumps(known[case["name"]])
        assert (folder / case["design"]).read_bytes() == (COMMITTED / case["design"]).read_bytes()


def test_published_angles_are_enclosed_to_the_last_printed_digit(tmp_path):
    """Kinematic error of Table 2 (Chen and Tsay 2011), arcsec, relative to the contact at 0 degrees."""
    cases = {case["name"]: case for case in written(tmp_path, "recess-action-semi")}
    points = cases["recess-action-semi--published"]["points"]
    bounds = {float(point["pinion_angle_deg"]): point["transmission_error_arcsec"] for point in points}
    printed = ROOT / "tests" / "reference" / "recess-action-worm.json"
    table = json.loads(printed.read_text(encoding="utf-8"))["table_2"]
    rows = [row for row in table["rows"] if row[0] == "semi"]
    assert len(rows) == len(points) == 5
    for row in rows:
        low, high = bounds[row[1]][0] - bounds[0.0][1], bounds[row[1]][1] - bounds[0.0][0]
        assert high - low < 1e-9
        assert row[-1] - table["tolerance"]["ke_arcsec"] <= low <= high <= row[-1] + table["tolerance"]["ke_arcsec"]
    assert_committed(tmp_path, cases.values())


def test_contact_that_is_nearly_a_line_is_one_point_or_unknown_and_edges_come_first(tmp_path):
    cases = {case["name"]: case["points"] for case in written(tmp_path, "plain-zn")}
    for words, outcome in (("3", "unique"), ("5", "unique"), ("7", "unknown")):
        assert {point["outcome"] for point in cases[f"plain-zn--near-line-{words}"]} == {outcome}
    inside, outside = (
        [p for p in cases["plain-zn--face-edge"] if ("off_face" in p["flags"]) == off] for off in (False, True)
    )
    assert len(inside) == 2 and len(outside) == 3
    for point in inside:
        low, high = point["transmission_error_arcsec"]
        assert (point["tangency_comes_first"], point["first_contact"]["kind"]) == ("first", "tangency")
        assert low - 1e-10 <= point["first_contact"]["transmission_error_arcsec"] <= high + 1e-10
    for point in outside:
        assert (point["tangency_comes_first"], point["first_contact"]["kind"]) == ("unknown", "edge")
        # the worm drives for positive angles: a wheel that lags lets nothing else touch before the edge does
        assert point["first_contact"]["transmission_error_arcsec"] < point["transmission_error_arcsec"][0]
