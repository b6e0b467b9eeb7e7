"""The generated C is the description: it holds as generated; a changed rule, size, chain or direction does not."""

import json
import re
from pathlib import Path

import pytest

from derive.audit.checker import attempts, check_description
from derive.audit.checker.drive import Drive
from derive.audit.checker.kernels import check_arc_kernel
from derive.audit.checker.lanes import check_lanes
from derive.audit.checker.refusal import Rejected
from derive.audit.checker.straight_line import read_header

GENERATED = Path(__file__).resolve().parents[2] / "generated"
ZN, SPUR = "cylindrical_worm_zn_zn", "spherical_convex_spur"


def paths(name):
    return GENERATED / "descriptions" / f"{name}.json", GENERATED / "c" / f"{name}.h"


@pytest.fixture(autouse=True)
def few_attempts(monkeypatch):
    monkeypatch.setattr(attempts, "ATTEMPTS", 2000)


def only(drive, words):
    """Of all checks those whose words hold a text."""
    chosen = [check for name, check in check_description.checks_of(drive) if words in name]
    assert chosen
    for check in chosen:
        attempts.attempt(*check)


@pytest.mark.parametrize("name", [SPUR, pytest.param("face_worm", marks=pytest.mark.validate)])
def test_a_drive_is_its_description(name):
    assert check_description.check_drive(*paths(name)) > 80


@pytest.mark.validate
@pytest.mark.parametrize("name", [ZN, "cylindrical_worm_za_za", "cylindrical_worm_zc_zc", "spherical_convex_concave"])
def test_further_drives_are_their_descriptions(name, capsys):
    assert check_description.main([str(GENERATED / "audit"), name]) == 0


def test_a_drive_without_description_is_refused(tmp_path, capsys):
    assert check_description.main([str(tmp_path / "audit")]) == 1
    assert "no description" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("function", "pattern", "other", "words"),
    [
        ("derive", r"p\[12\] = p\[3\];", "p[12] = p[4];", "rule"),
        ("size", r"d\[0\] = (\w+);", r"d[0] = -\1;", "size"),
        ("start_solution", r"x\[1\] = (\w+);", r"x[1] = -\1;", "solution"),
        ("observe", r"o\[3\] = (\S+);", r"o[3] = -\1;", "normal_pinion_f"),
        ("generation", r"o\[6\] = (\S+);", r"o[6] = -\1;", "generation"),
        ("placement", r"o\[22\] = (\S+);", r"o[22] = -\1;", "placement of the wheel"),
        ("placement", r"o\[30\] = MW_S\(\w+\);", "o[30] = s[0];", "placement of the wheel"),
        ("setup", r"= 1\.0 \+ (t_\w+);", r"= 1.0 - \1;", "guard 0"),
        ("observe", r"o\[27\] = (\S+);", r"o[27] = -\1;", "regular_pinion"),
        ("observe", r"o\[49\] = (\S+);", r"o[49] = -\1;", "second_form_pinion"),
        ("observe", r"o\[59\] = (\S+);", r"o[59] = -\1;", "lever arms"),
        ("curvature_flank_pinion", r"o\[7\] = (\S+);", r"o[7] = -\1;", "curvature of flank_pinion"),
    ],
)
def test_a_changed_function_is_refused(function, pattern, other, words):
    with pytest.raises(Rejected, match="description"):
        only(changed(function, pattern, other), words)


def changed(function, pattern, other, count=1):
    """The drive with the first places of one of its functions changed."""

    def change(header):
        head, signature, body = header.partition(f"{ZN}_{function}(")
        head, signature, body = (head, signature, body) if "double *" in body[:40] else header.rpartition(signature)
        other_body, found = re.subn(pattern, other, body, count=count)
        assert found == count
        return head + signature + other_body

    return drive_of(ZN, change)


@pytest.mark.parametrize(
    ("pattern", "other"),
    [
        (r"return 24;", "return 25;"),
        (r"    if \(p\[4\].*\n", ""),
        (r"return otherwise", "return 0"),
        (r"p\[7\] !=", "p[8] !="),
    ],
)
def test_a_key_that_is_missing_under_another_name_is_refused(pattern, other):
    with pytest.raises(Rejected, match="missing"):
        only(changed("missing", pattern, other), "keys that are missing")


def test_a_normal_that_points_inward_is_refused():
    """All three components turned round: the length, and the right angle to every tangent, stay."""
    with pytest.raises(Rejected, match="normal"):
        only(changed("flank_pinion", r"o\[([345])\] = (\S+);", r"o[\1] = -\2;", count=3), "normal of flank_pinion")


def test_a_rule_that_rests_on_its_own_value_is_refused(tmp_path):
    description, header = paths(SPUR)
    for path in header.parent.glob(f"{SPUR}*.h"):
        text = path.read_text(encoding="utf-8")
        (tmp_path / path.name).write_text(text.replace("p[10] = p[5];", "p[10] = p[10];"), encoding="utf-8")
    with pytest.raises(Rejected, match=header.name):
        check_description.check_drive(description, tmp_path / header.name)


def test_a_changed_factor_of_a_motion_is_refused():
    description, header = (path.read_text(encoding="utf-8") for path in paths(SPUR))
    described = json.loads(description)
    motion = described["bodies"][1]["motion"]
    turned = next(factor for factor in motion if factor[0] == "rotation")
    turned[2] = ["*", -1, turned[2]]
    with pytest.raises(Rejected, match="point_wheel_f"):
        only(Drive(described, header), "point_wheel_f")


def drive_of(name, change=lambda text: text, changes=lambda text: text):
    """A drive with its header or the changes of its rules altered."""
    description, header = paths(name)
    beside = header.with_name(f"{name}_sensitivity.h").read_text(encoding="utf-8")
    text = change(header.read_text(encoding="utf-8"))
    return Drive(json.loads(description.read_text(encoding="utf-8")), text, changes(beside))


@pytest.mark.parametrize(
    ("old", "new"),
    [(" = dp[2] * 0.5;", " = dp[2] * 0.25;"), (" && known[2] == known[2]", "")],
)
def test_a_wrong_change_of_a_rule_is_refused(old, new):
    only(drive_of(ZN), "changes by rule 10 ")
    with pytest.raises(Rejected, match="rule 10"):
        only(drive_of(ZN, changes=lambda text: text.replace(old, new, 1)), "changes by rule 10 ")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("J[8] = t", "J[8] = -t", "pitch_point_eval"),
        ("if (q[21] != q[21]) q[21] = y[1];", "if (q[21] != q[21]) q[21] = y[2];", "pitch_point_fill"),
        ("    y[0] = q[3];", "    y[0] = q[4];", "pitch_point_scale"),
        ("    return t_", "    return -t_", "inner_point_watch"),
    ],
)
def test_a_changed_system_of_a_design_is_refused(old, new, words):
    def change(text):
        returned = "double" if "watch" in words else "void"
        head, signature, body = text.partition(f"static inline {returned} face_worm_{words}(")
        assert old in body
        return head + signature + body.replace(old, new, 1)

    with pytest.raises(Rejected, match="description"):
        only(drive_of("face_worm", change), words)


@pytest.mark.parametrize(
    ("old", "new"),
    [("z, 0.1999999999999552,", "z, 0.1999999999995,"), ("3.141592653589793 - octant", "3.141592653589793 + octant"),
     ("small > 0.41421356237309503", "small > 0.4142135")],
)  # fmt: skip
def test_a_changed_kernel_of_atan2_is_refused(old, new):
    text = paths(ZN)[1].read_text(encoding="utf-8")
    check_arc_kernel(text)
    assert old in text
    with pytest.raises(Rejected, match="atan2"):
        check_arc_kernel(text.replace(old, new))


def test_a_guard_of_the_lanes_that_is_not_that_of_setup_is_refused():
    text, lanes = (paths(ZN)[1].with_name(f"{ZN}{end}.h").read_text(encoding="utf-8") for end in ("", "_lanes"))
    header = read_header(text, lanes)
    changed = re.sub(r"\(t_\w+ > 0\.0 \?", "(p[1 * MW_LANES + l] > 0.0 ?", lanes, count=1)
    with pytest.raises(Rejected, match="guard 0"):
        attempts.attempt(check_lanes, header, changed)
