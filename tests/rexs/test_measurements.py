"""Measured deviations as lists of points: there and back, valid, and broken ones refused by name."""

import json
from dataclasses import replace

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.rexs.document import parsed
from meshwright.rexs.measurements import points_of, with_points
from meshwright.shop.nominal import nominal
from meshwright.shop.tables import csv_text, read_csv
from tests.rexs.designs import file_text
from tests.rexs.test_schema import assert_valid

SETS, IDS = (f'<attribute id="{name}" unit="none"><array>' for name in ("set_ids", "point_ids"))


def _measured(drive, member, teeth=(1, 2)):
    points = nominal(drive, member, (3, 4), 0.05, teeth, ("right", "left"))
    spread = np.random.default_rng(8).normal(0.0, 2e-3, len(points.tooth))
    spread[5] = np.nan
    return replace(points, deviations=spread)


def _same(one, two):
    """Whether two sets of points are one, in whatever order."""
    order = [np.lexsort((p.j, p.i, np.array(p.flank), p.tooth)) for p in (one, two)]
    return all(
        np.array_equal(np.array(getattr(one, name))[order[0]], np.array(getattr(two, name))[order[1]])
        for name in ("tooth", "flank", "i", "j", "points", "normals", "deviations")
    )


@pytest.mark.parametrize(
    ("design", "member"), [("plain-za", "wheel"), ("plain-za", "pinion"), ("helical-crowned", "wheel")]
)
def test_there_and_back_and_valid(design, member):
    """To the last bit; the point that was not measured stays away; another member has none."""
    drive = Drive.load(design)
    points = _measured(drive, member)
    added = with_points(file_text(drive.design.given()).encode(), member, points)
    assert_valid(added.content.decode())
    known = np.isfinite(points.deviations)
    kept = replace(
        points, flank=tuple(np.array(points.flank)[known]),
        **{n: getattr(points, n)[known] for n in ("tooth", "i", "j", "points", "normals", "deviations")},
    )  # fmt: skip
    assert _same(points_of(parsed(added.content, "file"), member), kept)
    assert len(added.assumed) == 3 and added.unmapped[0]["reason"] == "1 points have no deviation"


def test_the_commands(tmp_path, capsys):
    drive, table, file = Drive.load("plain-za"), tmp_path / "m.csv", tmp_path / "pair.rexs"
    table.write_text(csv_text(_measured(drive, "wheel"), {}))
    words = ["--measured", str(table), "--member", "wheel"]
    assert main(["export", "plain-za", "--rexs", str(file), *words, "--json", "-"]) == 0
    made = json.loads(capsys.readouterr().out)
    assert "sign assumed" in [entry["reason"] for entry in made["assumed"]]
    back = tmp_path / "back.csv"
    assert main(["import", str(file), "--toml", str(tmp_path / "d.toml"), "--measured", str(back), *words[2:]]) == 0
    assert len(read_csv(back)[0].tooth) == len(read_csv(table)[0].tooth) - 1
    assert main(["measured", str(tmp_path / "d.toml"), "--member", "wheel", "--measured", str(back)]) == 0
    assert main(["export", "plain-za", "--rexs", str(file), *words[:2]]) == 2
    assert main(["import", str(file), "--toml", "-", "--measured", str(back), "--member", "pinion"]) == 2
    assert "gear_flank_data_set" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [('name="right flank of tooth 1', 'name="flank', ["point_list", "name", "which flank"]),
     ('_amounts_point_list" unit="mm"', '_amounts_point_list" unit="mum"', ["amounts_point_list", "'mum'"]),
     (f"{SETS}<c>1</c>", SETS, ["attribute", "entries"]),
     (f"{IDS}<c>1</c>", f"{IDS}<c>2</c>", ["point_ids", "twice"]),
     (f"{IDS}<c>1</c>", f"{IDS}<c>1.5</c>", ["point_ids", "no number"]),
     ("<matrix><r><c>", "<matrix><r><c>0</c><c>", ["deviation_normals", "three columns"]),
     ('id="point_coordinates_v_coord"', 'id="other"', ["v_coord", "missing"])],
)  # fmt: skip
def test_broken_lists_are_refused(old, new, words, good, tmp_path, capsys):
    assert old in good
    file = tmp_path / "broken.rexs"
    file.write_text(good.replace(old, new, 1))
    status = main(["import", str(file), "--toml", str(tmp_path / "d"), "--measured", "-", "--member", "wheel"])
    said = capsys.readouterr().err
    assert status == 2 and all(word in said for word in words), said


@pytest.fixture(scope="module")
def good():
    """A file with measured points of both flanks of a tooth."""
    drive = Drive.load("plain-za")
    points = _measured(drive, "wheel", (1,))
    return with_points(file_text(drive.design.given()).encode(), "wheel", points).content.decode()
