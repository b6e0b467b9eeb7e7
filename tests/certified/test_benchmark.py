"""The benchmark set: designs, certified tables and a manifest that are consistent with one another."""

import csv
import hashlib
import json

import pytest

from meshwright import Drive
from meshwright.cli import main


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
    assert {case["design"] for case in cases} < set(files)
    for name, entry in files.items():
        assert hashlib.sha256((folder / name).read_bytes()).hexdigest() == entry["sha256"]
    (root,) = [entry for entry in graph if entry["@id"] == "./"]
    assert {part["@id"] for part in root["hasPart"]} == set(files)


def test_each_case_has_a_design_file_and_bounds_that_hold_what_it_solves(tmp_path):
    cases = written(tmp_path, "recess-action-semi")
    check(tmp_path, cases)
    assert len(cases) >= 4  # aligned, and each misalignment
    for case in cases[:2]:
        drive = Drive.load(str(tmp_path / case["design"]))
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
