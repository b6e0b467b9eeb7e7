"""What the page on the shop shows runs as it stands, in its order."""

import re
import shlex
from pathlib import Path

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.shop.located import along, located
from meshwright.shop.tables import csv_text, read_csv

PAGE = Path(__file__).parents[2] / "runtime" / "site" / "reference" / "shop.md"
SECTION = PAGE.read_text(encoding="utf-8").replace("\\\n", " ")
LINES = re.findall(r"^    (\.venv/bin/meshwright .*)$", SECTION, re.M)
COMMANDS = [shlex.split(line, comments=True)[1:] for line in LINES]
LONG = [words for words in COMMANDS if words[0] in ("hob-life", "loaded")]


def _fill_in(file):
    """Deviations of a wheel whose hob stood 0.02 mm too far away."""
    points, remarks = read_csv(file)
    drive = Drive.load("plain-za")
    distance = drive.design.value("cutting_center_distance_mm")
    made = drive.with_(design={"cutting_center_distance_mm": distance + 0.02})
    found = located(drive, "wheel", points)
    for side, rows, q, ray in zip(found.drives, found.rows, found.parameters, found.rays, strict=True):
        flank = made.with_(flank=side.design.tables["flank"]).flank("wheel")
        points.deviations[rows] = along(flank, q, ray)[1]
    assert np.isfinite(points.deviations).all()
    Path(file).write_text(csv_text(points, remarks))


def test_each_command_has_a_first_use():
    assert {words[0] for words in COMMANDS} >= {
        "grid", "measured", "identify", "hob-life", "ratio", "tca", "export", "import"
    }  # fmt: skip


def test_the_commands_run(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("mu.csv").write_text("velocity_m_per_s,friction\n0,0.08\n20,0.03\n")
    for words in COMMANDS:
        if words[0] == "measured" and "--contact" not in words:
            _fill_in("wheel.csv")
        if words not in LONG:
            assert main(words) == 0, words
    out = capsys.readouterr().out
    assert "cutting_center_distance_mm" in out and "efficiency" in out
    corrected = Drive.load("corrected.toml").design.value("cutting_center_distance_mm")
    nominal = Drive.load("plain-za").design.value("cutting_center_distance_mm")
    assert corrected == pytest.approx(nominal - 0.02, abs=1e-6)


@pytest.mark.validate
@pytest.mark.parametrize("words", LONG, ids=[f"{k}-{words[0]}" for k, words in enumerate(LONG)])
def test_the_long_ones_run(words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    grid = ["grid", "helical-crowned", "--member", "pinion", "--lines", "5x9", "--csv", "pinion.csv"]
    assert main(grid) == 0
    points, remarks = read_csv("pinion.csv")
    points.deviations[:] = 0.0
    Path("pinion.csv").write_text(csv_text(points, remarks))
    assert main(words) == 0
    if "--toml" in words:
        assert Drive.load("oversize.toml").design.value("hob_pitch_radius_mm") > 20.6
