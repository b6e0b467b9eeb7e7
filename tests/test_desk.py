"""The first minutes at the command line: designs printed, words explained, misspelt keys named."""

import subprocess
import sys
import tomllib

import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.contact.analysis import statuses
from meshwright.design import design


def test_a_packaged_design_is_printed_as_it_is_written(capsys):
    assert main(["show", "plain-za"]) == 0
    assert capsys.readouterr().out == (design.PACKAGED / "plain-za.toml").read_text(encoding="utf-8")


def test_a_changed_design_is_printed_as_a_file_that_loads(capsys, tmp_path):
    assert main(["show", "plain-za", "--set", "misalignment.vertical_deg=0.05", "--out", str(tmp_path / "d.toml")]) == 0
    again = Drive.load(tmp_path / "d.toml")
    assert again.design.given() == Drive.load("plain-za").with_(misalignment={"vertical_deg": 0.05}).design.given()


@pytest.mark.parametrize("name", design.packaged_names())
def test_every_packaged_design_survives_printing(name):
    given = Drive.load(name).design.given()
    assert tomllib.loads(design.toml_text(given)) == given


def test_every_status_and_flag_is_explained(capsys):
    assert main(["explain"]) == 0
    shown = capsys.readouterr().out
    for word in (*statuses().values(), "interference", "throat"):
        assert f" {word} " in shown
    assert main(["explain", "interference"]) == 0
    assert "bodies cannot make" in capsys.readouterr().out


def test_an_unknown_word_is_answered_with_the_nearest(capsys):
    assert main(["explain", "of_tip"]) == 2
    assert "did you mean 'off_tip'?" in capsys.readouterr().err


def test_a_misspelt_key_is_named_before_the_missing_one():
    tables = design.read("recess-action-full")
    tables["design"]["wheel_tooth"] = tables["design"].pop("wheel_teeth")
    with pytest.raises(ValueError, match="wheel_tooth.*unknown key.*wheel_teeth"):
        Drive.from_tables(tables)


def test_the_package_is_a_command():
    shown = subprocess.run([sys.executable, "-m", "meshwright", "show", "plain-za"], capture_output=True, text=True)
    assert shown.returncode == 0 and 'drive = "cylindrical-worm"' in shown.stdout
