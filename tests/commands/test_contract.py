"""What other programs rely on: commands, keys and statuses of the JSON."""

import csv
import json

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.commands import tca
from meshwright.design import description as metadata
from meshwright.design import design


def _json(arguments, capsys, status=0):
    assert main([*arguments, "--json", "-"]) == status
    return json.loads(capsys.readouterr().out)


def test_drives_lists_families_keys_and_packaged_designs(capsys):
    families = {f["name"]: f for f in _json(["drives"], capsys)["families"]}
    assert set(families) == set(metadata.families())
    for family in families.values():
        assert {"name", "keys", "designs"} <= set(family)
    assert "recess-action-full" in families["cylindrical-worm"]["designs"]
    assert sorted(name for f in families.values() for name in f["designs"]) == design.packaged_names()


def test_schema_describes_every_family(capsys):
    document = _json(["schema"], capsys)
    assert set(document["$defs"]) == set(metadata.families())


def test_tca_writes_every_key_of_every_point(capsys):
    document = _json(["tca", "recess-action-full", "--phi-deg", "400,1600"], capsys)
    assert document["schema"] == "meshwright.tca/1"
    assert document["drive"] == "cylindrical-worm"
    assert document["design"]["design"]["center_distance_mm"] == pytest.approx(296.4874624507, abs=1e-9)
    assert [p["pinion_angle_deg"] for p in document["points"]] == pytest.approx([400.0, 1600.0], abs=1e-9)
    for point in document["points"]:
        assert point["status"] == "converged"
        assert set(point["unknowns"]) >= {"t_worm", "psi_worm", "t_hob", "psi_fixed_hob", "psi_hob", "phi_hob"}
        assert np.linalg.norm(point["contact_normal"]) == pytest.approx(1.0, abs=1e-14)
        for key in ("contact_point_mm", "contact_point_pinion_mm", "contact_point_wheel_mm"):
            assert len(point[key]) == 3
        assert point["curvature"]["relative_min_per_mm"] < point["curvature"]["relative_max_per_mm"]
        assert abs(np.dot(point["curvature"]["major_direction"], point["contact_normal"])) < 1e-12
        assert point["ellipse"]["semi_major_mm"] > point["ellipse"]["semi_minor_mm"]


ONE_OF_EACH = (
    "plain-zn", "face-worm-cylindrical-concave", "spherical-table-4-4-spur", "helical-crowned", "bevel-crowned-both",
    "internal-22-70",
)  # fmt: skip


def _choices():
    """One design of each family under every word of every choice of its parameters."""
    for name in ONE_OF_EACH:
        for parameter in Drive.load(name).design.description["parameters"]:
            place = ".".join(dict.fromkeys((parameter["table"], parameter["key"])))
            yield from ((name, place, word) for word in parameter["choices"])


CASES = [("tca", *case) for case in _choices()]
CASES.append(("ratio", "spherical-table-4-4-spur", "contact.limit", "cutter"))


@pytest.mark.parametrize(("command", "name", "place", "word"), CASES)
def test_a_size_that_a_choice_leaves_open_is_null(command, name, place, word, capsys):
    assert {Drive.load(n).design.family for n in ONE_OF_EACH} == set(metadata.families())
    assert main([command, name, "--phi-deg", "0", "--set", f"{place}={word}", "--json", "-"]) in (0, 1)
    shown = json.loads(capsys.readouterr().out)["design"]["design"]
    sizes = Drive.from_tables(design.changed(design.read(name), {place: word})).design.sizes
    assert {key for key in sizes if shown[key] is None} == {key for key in sizes if np.isnan(sizes[key])}


def test_points_off_the_blank_are_written_with_a_flag_and_status_zero(capsys):
    document = _json(["tca", "recess-action-full", "--phi-deg", "-100"], capsys)
    assert "off_tip" in document["points"][0]["flags"]


def test_line_contact_is_a_result_with_an_error_but_no_point(capsys):
    settings = ["--set", "design.hob_pitch_radius_mm=19.107322609297408"]
    document = _json(["tca", "recess-action-full", "--phi-deg", "500", *settings], capsys, status=0)
    (point,) = document["points"]
    assert point["status"] == "line_contact"
    assert abs(point["transmission_error_arcsec"]) < 1e-9
    assert point["contact_point_mm"] is None


def test_a_contact_that_left_the_flank_is_reported_and_the_others_are_written(capsys):
    arguments = ["tca", "recess-action-full", "--phi-deg=-6000,500"]
    document = _json(arguments, capsys, status=1)
    lost, kept = document["points"]
    assert lost["status"] in ("left_flank", "no_contact", "fold")
    assert lost["contact_point_mm"] is None
    assert kept["status"] == "converged"


def test_a_list_of_angles_may_begin_with_a_minus(capsys):
    apart = _json(["tca", "recess-action-full", "--phi-deg", "-100,500"], capsys)
    assert apart == _json(["tca", "recess-action-full", "--phi-deg=-100,500"], capsys)


def test_interference_exits_one_with_its_numbers(capsys):
    settings = ["--set", "design.hob_pitch_radius_mm=18.9"]
    document = _json(["tca", "recess-action-full", "--phi-deg", "500", *settings], capsys, status=1)
    (point,) = document["points"]
    assert "interference" in point["flags"]
    assert point["contact_point_mm"] is not None
    assert point["ellipse"]["semi_major_mm"] is None


def test_a_binary_result_goes_to_standard_output(tmp_path, capsysbinary, monkeypatch):
    monkeypatch.chdir(tmp_path)
    command = ["surface", "plain-zn", "--member", "wheel", "--grid", "3x4", "--stl"]
    assert main([*command, "-"]) == 0
    shown = capsysbinary.readouterr().out
    assert main([*command, "file"]) == 0
    assert shown == (tmp_path / "file").read_bytes()
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_csv_has_a_row_a_point(tmp_path):
    path = tmp_path / "out.csv"
    assert main(["tca", "recess-action-full", "--phi-deg", "400:800:100", "--csv", str(path)]) == 0
    header, *rows = path.read_text(encoding="utf-8").splitlines()
    assert header.startswith("pinion_angle_deg,status")
    assert len(rows) == 5


def test_the_left_hand_drive_is_the_mirror_image():
    right = Drive.load("recess-action-standard").with_(misalignment={"vertical_deg": 0.03, "center_distance_mm": 0.05})
    left = right.with_(design={"hand": "left"})
    angles = np.radians([-300.0, 0.0, 500.0])
    a, b = right.tca(-angles), left.tca(angles)
    assert np.array_equal(b.error, -a.error)
    assert np.array_equal(b.points, a.points * [1, -1, 1])
    assert np.array_equal(b.normals, a.normals * [1, -1, 1])
    assert np.array_equal(b.curvatures, a.curvatures)


def test_the_order_of_the_angles_does_not_matter():
    drive = Drive.load("recess-action-standard")
    angles = np.radians([500.0, -300.0, 100.0])
    mixed, ordered = drive.tca(angles), drive.tca(np.sort(angles))
    assert np.array_equal(np.sort(mixed.wheel_angles), ordered.wheel_angles)


def test_results_that_are_written_as_they_go_are_those_written_at_once(tmp_path, monkeypatch, capsys):
    """JSON, CSV and text of angles to both sides of the reference, none of them, some without first contact."""
    written = {}
    for at_once in (4096, 3):
        monkeypatch.setattr(tca, "AT_ONCE", at_once)
        files = [tmp_path / f"{at_once}.{ending}" for ending in ("json", "csv")]
        words = ["tca", "helical-crowned", "--phi-deg=-191:180:20.5"]
        codes = main([*words, "--json", str(files[0]), "--csv", str(files[1])]), main(words)
        rows = list(csv.reader(files[1].read_text().splitlines()))
        assert {len(row) for row in rows} == {len(rows[0])}
        points = [point["transmission_error_relative_arcsec"] for point in json.loads(files[0].read_text())["points"]]
        written[at_once] = codes, rows[0], [row[:2] for row in rows], points, capsys.readouterr().out
    assert written[3][:3] == written[4096][:3] and written[3][4] == written[4096][4]
    assert written[3][3] == pytest.approx(written[4096][3], abs=1e-10, nan_ok=True)
    assert "first_contact" in written[3][1] and "first_contact.kind" in written[3][1]
