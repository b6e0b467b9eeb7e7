"""``python -m derive``: what it does to the folder it writes to."""

import json

import pytest

from derive import command, generated

DRIVE = "spherical_spur_spur"


def test_one_drive_replaces_its_own_files_alone(tmp_path):
    other = tmp_path / "c" / "thesis.txt"
    other.parent.mkdir()
    other.write_text("a year's work")
    assert command.main([DRIVE, "--output", str(tmp_path)]) == 0
    assert other.read_text() == "a year's work"
    assert {path.name for path in (tmp_path / "c").glob("*.h")} == {
        f"{DRIVE}{part}.h" for part in ("", "_bounded", "_certified", "_certify", "_lanes", "_sensitivity")
    }  # fmt: skip


def test_only_what_an_earlier_run_wrote_is_removed(tmp_path):
    for name in ("c/own.txt", "c/old_drive.h", "c/drive.h", ".ssh/key"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("")
    written = {"c/old_drive.h": "", "c/drive.h": "", "c/gone.h": ""}
    (tmp_path / "manifest.json").write_text(json.dumps({"files": written}))
    generated.replace(tmp_path, {"c/drive.h": ""})
    left = {str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*") if path.is_file()}
    assert left == {"c/own.txt", "c/drive.h", ".ssh/key", "manifest.json"}


def test_a_folder_without_a_manifest_loses_nothing(tmp_path):
    (tmp_path / "c").mkdir()
    (tmp_path / "c" / "own.txt").write_text("")
    generated.replace(tmp_path, {})
    assert (tmp_path / "c" / "own.txt").exists()


def test_an_unknown_drive_is_named_with_those_known(tmp_path, capsys):
    assert command.main(["gearbox", "--output", str(tmp_path)]) == 2
    assert "no drive 'gearbox'; known: cylindrical_worm_za_za" in capsys.readouterr().err
    assert command.main(["worm", "--output", str(tmp_path)]) == 2
    assert "no drive 'worm'; did you mean face_worm?" in capsys.readouterr().err
    assert not [*tmp_path.iterdir()]


def test_a_damaged_manifest_is_named(tmp_path, capsys):
    (tmp_path / "manifest.json").write_text('{"files": {"c/drive.h": "12')
    assert command.main([DRIVE, "--output", str(tmp_path)]) == 2
    assert "manifest.json is damaged" in capsys.readouterr().err
    (tmp_path / "manifest.json").write_text('{"files": {"../thesis.txt": "12"}}')
    assert command.main([DRIVE, "--output", str(tmp_path)]) == 2
    assert "outside its folder" in capsys.readouterr().err


def test_a_folder_that_cannot_be_written_is_named(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert command.main([DRIVE, "--output", str(tmp_path / "file")]) == 2
    assert "cannot be written" in capsys.readouterr().err


def test_what_a_killed_run_left_is_removed(tmp_path):
    (tmp_path / "c").mkdir()
    (tmp_path / "c" / ".drive.h.1234.part").write_text("half")
    generated.replace(tmp_path, {})
    assert not list((tmp_path / "c").iterdir())


def test_the_six_stages_are_told_in_their_order(tmp_path, capsys):
    assert command.main([DRIVE, "--output", str(tmp_path)]) == 0
    lines = [line.split() for line in capsys.readouterr().err.splitlines()]
    stages = ["define", "derive", "reduce", "schedule", "prove", "emit"]
    assert [stage for stage, name, *_ in lines if name == DRIVE] == stages


@pytest.mark.parametrize("option", ["--output", "--into"])
def test_an_empty_word_is_no_folder(option, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as ended:
        command.main(["cylindrical_worm_za_za", option, ""])
    assert ended.value.code == 2 and "is no folder; name one" in capsys.readouterr().err
    assert not [*tmp_path.iterdir()]


@pytest.mark.validate
@pytest.mark.parametrize("text", ["", "[]", "{}", '{"families": 3}'])
def test_a_damaged_table_of_families_is_made_anew(text, tmp_path):
    table = tmp_path / "families.json"
    table.write_text(text, encoding="utf-8")
    assert command.main(["spherical_convex_spur", "--output", str(tmp_path)]) == 0
    assert "spherical" in json.loads(table.read_text(encoding="utf-8"))["families"]
