"""``meshwright import`` and ``meshwright export``."""

import json

import pytest

from meshwright.cli import main
from meshwright.design import design as designs


@pytest.mark.parametrize("name", ["zk-zn-60", "recess-action-full", "helical-crowned"])
def test_a_packaged_design_there_and_back(name, tmp_path, capsys):
    first, design, second = tmp_path / "a.rexs", tmp_path / "sub" / "b.toml", tmp_path / "c.rexs"
    design.parent.mkdir()
    assert main(["export", name, "--rexs", str(first), "--json", "-"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["schema"] == "meshwright.rexs/1"
    given = {f"{t}.{k}" for t, entries in designs.read(name).items() if isinstance(entries, dict) for k in entries}
    assert given <= {e["key"] for e in report["mapped"]} | {e.get("key") for e in report["unmapped"]}
    assert main(["import", str(first), "--toml", str(design)]) == 0
    assert "mapped" in capsys.readouterr().err
    text = first.read_text(encoding="utf-8").replace("</model>", "<!-- mine --></model>")
    first.write_text(text, encoding="utf-8")
    assert main(["export", str(design), "--rexs", str(second)]) == 0
    assert second.read_text(encoding="utf-8") == text
    assert main(["export", str(design), "--rexs", str(second), "--new"]) == 0
    assert "mine" not in second.read_text(encoding="utf-8")


def test_the_file_that_a_design_came_from_is_gone(tmp_path, capsys):
    first, design = tmp_path / "a.rexs", tmp_path / "b.toml"
    main(["export", "zk-zn-60", "--rexs", str(first)])
    main(["import", str(first), "--toml", str(design)])
    first.unlink()
    capsys.readouterr()
    assert main(["export", str(design), "--rexs", str(tmp_path / "c.rexs")]) == 2
    assert "a.rexs" in capsys.readouterr().err


def test_a_family_that_rexs_does_not_have(tmp_path, capsys):
    assert main(["export", "spherical-table-2-1", "--rexs", str(tmp_path / "a.rexs")]) == 2
    assert "spherical" in capsys.readouterr().err


def test_an_impossible_design_is_not_written(tmp_path, capsys):
    out = tmp_path / "a.rexs"
    assert main(["export", "zk-zn-60", "--rexs", str(out), "--set", "design.worm_threads=0"]) == 2
    assert "worm_threads" in capsys.readouterr().err and not out.exists()
