"""The generated C is the description: it holds as generated; a changed rule, size, chain or direction does not."""

import json
import re
from pathlib import Path

import pytest

from derive.audit import check_description as checker

GENERATED = Path(__file__).resolve().parents[2] / "generated"
ZN, SPUR = "cylindrical_worm_zn_zn", "spherical_convex_spur"


def paths(name):
    return GENERATED / "descriptions" / f"{name}.json", GENERATED / "c" / f"{name}.h"


@pytest.fixture(autouse=True)
def few_attempts(monkeypatch):
    monkeypatch.setattr(checker.CODE, "ATTEMPTS", 2000)


def only(drive, words):
    """Of all checks those whose words hold a text."""
    chosen = [check for name, check in checker.checks_of(drive) if words in name]
    assert chosen
    for check in chosen:
        checker.CODE.attempt(*check)


@pytest.mark.parametrize("name", [SPUR, "face_worm"])
def test_a_drive_is_its_description(name):
    assert checker.check_drive(*paths(name)) > 80


@pytest.mark.validate
@pytest.mark.parametrize("name", [ZN, "cylindrical_worm_za_za", "cylindrical_worm_zc_zc", "spherical_convex_concave"])
def test_further_drives_are_their_descriptions(name, capsys):
    assert checker.main([str(GENERATED / "audit"), name]) == 0


def test_a_drive_without_description_is_refused(tmp_path, capsys):
    assert checker.main([str(tmp_path / "audit")]) == 1
    assert "no description" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("function", "pattern", "other", "words"),
    [
        ("derive", r"p\[11\] = p\[3\];", "p[11] = p[4];", "rule"),
        ("size", r"d\[0\] = (\w+);", r"d[0] = -\1;", "size"),
        ("start_solution", r"x\[1\] = (\w+);", r"x[1] = -\1;", "solution"),
        ("observe", r"o\[3\] = (\S+);", r"o[3] = -\1;", "normal_pinion_f"),
        ("generation", r"o\[6\] = (\S+);", r"o[6] = -\1;", "generation"),
    ],
)
def test_a_changed_function_is_refused(function, pattern, other, words):
    description, header = (path.read_text(encoding="utf-8") for path in paths(ZN))
    head, signature, body = header.partition(f"{ZN}_{function}(")
    head, signature, body = (head, signature, body) if "double *" in body[:40] else header.rpartition(signature)
    changed, count = re.subn(pattern, other, body, count=1)
    assert count == 1
    with pytest.raises(checker.Rejected, match="description"):
        only(checker.Drive(json.loads(description), head + signature + changed), words)


def test_a_normal_that_points_inward_is_refused():
    """All three components turned round: the length, and the right angle to every tangent, stay."""
    description, header = (path.read_text(encoding="utf-8") for path in paths(ZN))
    head, signature, body = header.partition(f"{ZN}_flank_pinion(")
    changed = re.sub(r"o\[([345])\] = (\S+);", r"o[\1] = -\2;", body, count=3)
    assert changed != body
    with pytest.raises(checker.Rejected, match="normal"):
        only(checker.Drive(json.loads(description), head + signature + changed), "normal of flank_pinion")


def test_a_changed_factor_of_a_motion_is_refused():
    description, header = (path.read_text(encoding="utf-8") for path in paths(SPUR))
    described = json.loads(description)
    motion = described["bodies"][1]["motion"]
    turned = next(factor for factor in motion if factor[0] == "rotation")
    turned[2] = ["*", -1, turned[2]]
    with pytest.raises(checker.Rejected, match="point_wheel_f"):
        only(checker.Drive(described, header), "point_wheel_f")
