"""Descriptions are as printed and obey the laws of enveloping; wrong physics that program and code share is refused."""

import copy
import json
from pathlib import Path

import pytest

from derive import drives
from derive.audit.checker import check_print
from derive.audit.checker.printed import alternatives, is_about, read_printed, statements_of
from derive.audit.checker.refusal import Rejected
from derive.language import description
from tests.quick import full, quick

GENERATED = Path(__file__).resolve().parents[2] / "generated"
PRINTED = read_printed(Path(check_print.__file__).parent.with_name("printed.txt").read_text(encoding="utf-8"))
ZN, SPUR, FACE = "cylindrical_worm_zn_zn", "spherical_convex_spur", "face_worm"
REGROUND = "cylindrical_worm_zi_zc_reground"
RING = "internal_gears"


def description_of(name):
    """As generated, or made of the drive where generated/ does not hold it."""
    kept = GENERATED / "descriptions" / f"{name}.json"
    return json.loads(kept.read_text(encoding="utf-8") if kept.is_file() else made(name))


def made(name):
    return description.text(drives.catalogue([name])[name]())


def checked(name, described, folder):
    path = folder / f"{name}.json"
    path.write_text(json.dumps(described), encoding="utf-8")
    return check_print.check_drive(path, PRINTED)


def minus(e):
    return ["*", -1, e]


def rule(described, target, change):
    for entry in described["rules"]:
        if entry[0] == target:
            entry[1] = change(entry[1])


def definition(described, name, change):
    entry = next(e for e in described["definitions"] if e["name"] == name)
    entry["value"] = change(entry["value"])


def turned(motion, place):
    motion[place][2] = minus(motion[place][2])


def negated(entries, *places):
    for place in places:
        entries[place] = minus(entries[place])


@pytest.mark.parametrize("name", [ZN, SPUR, FACE, REGROUND])
def test_a_description_is_as_printed(name, tmp_path):
    assert checked(name, description_of(name), tmp_path) > 60


@pytest.mark.validate
def test_all_descriptions_are_as_printed(capsys):
    assert check_print.main([str(GENERATED / "audit")]) == 0
    drives = len(list((GENERATED / "descriptions").glob("*.json")))
    assert f"of {drives} descriptions hold" in capsys.readouterr().out


@pytest.mark.validate
def test_a_drive_that_no_packaged_design_uses_is_as_printed_too(tmp_path):
    every = drives.catalogue()
    assert len(every) > 60
    for name in every if full() else list(every)[::4]:
        assert checked(name, json.loads(made(name)), tmp_path) > 60


def test_patterns_name_alternatives_and_leave_drives_out():
    patterns = [p for word in ("a_{b,c}{,_d}", "!*_d") for p in alternatives(word)]
    assert [name for name in ("a_b", "a_c", "a_b_d", "a_e") if is_about(name, patterns)] == ["a_b", "a_c"]


def test_abbreviations_alone_hold_from_there_on():
    alone, both, last = "[a_*]\nlet p: q\n", "[*_b]\nlet r: p\nsize y_mm: r | x\n", "[a_*]\nsize z_mm: p + r | x\n"
    printed = read_printed(alone + both + last)
    assert [s.sides for s in statements_of("a_b", printed)] == [("q",), (["+", "q", "r"],)]


WRONG = {
    "cutting distance A - r_h + r_1": (
        ZN, lambda d: rule(d, "A_gen", lambda _: ["+", "A", "r_worm", minus("r_hob")])),
    "cutting angle Sigma - lambda + lambda_h": (
        ZN, lambda d: rule(d, "Sigma_gen", lambda _: ["+", "Sigma", minus("lambda_worm"), "lambda_hob"])),
    "the hob's lead angle as misprinted in Eq (36)": (
        ZN, lambda d: rule(d, "lambda_hob", lambda e: ["asin", ["*", e[1], ["cos", "lambda_worm"]]])),
    "groove width with plus": (
        ZN, lambda d: definition(d, "r_t_worm", lambda e: ["+", e[1], minus(e[2])])),
    "blade turned the other way": (
        ZN, lambda d: definition(d, "P_worm_y", minus)),
    "root of r_t with the other sign": (
        ZN, lambda d: definition(d, "r_t_hob", lambda e: ["+", minus(e[1]), e[2]])),
    "wheel turned the other way in mesh": (
        ZN, lambda d: turned(d["bodies"][1]["motion"], -1)),
    "rolling direction": (
        SPUR, lambda d: turned(d["bodies"][0]["surface"]["made"][1]["motion"], 0)),
    "phase of the pitch point": (
        SPUR, lambda d: turned(d["bodies"][0]["motion"], -1)),
    "sign of the plunge": (
        FACE, lambda d: negated(d["bodies"][0]["surface"]["made"][2]["motion"][2][1], 1)),
    "normal into the material": (
        ZN, lambda d: negated(d["bodies"][0]["surface"]["normal"], 0, 1, 2)),
    "velocity of a swing with the wrong sign": (
        FACE, lambda d: negated(d["bodies"][0]["surface"]["conditions"], 0)),
    "solution of the equation of meshing with the wrong sign": (
        ZN, lambda d: definition(d, "psi_hob", minus)),
    "a reground hob farther from its axis": (
        REGROUND, lambda d: definition(d, "R_reground_hob", lambda e: ["+", e, ["*", 2, "Delta_hob"]])),
    "a reground hob with the lead of its own pitch cylinder": (
        REGROUND,
        lambda d: rule(d, "lambda_hob", lambda _: ["asin", ["*", ["/", 1, 2], "T_hob", "m_n", ["^", "r_w", -1]]])
    ),
    "a reground hob that rolls at the radius of the new one": (
        REGROUND, lambda d: rule(d, "A_gen", lambda _: ["+", "A", "r_hob", minus("r_worm")])),
    "the disc of a reground hob inclined the other way": (
        REGROUND, lambda d: definition(d, "P_hob_y", minus)),
    "a ring gear turned the other way": (
        RING, lambda d: turned(d["bodies"][1]["motion"], -1)),
    "a space of the ring gear on the other side": (
        RING, lambda d: definition(d, "theta_wheel", minus)),
    "derivative of the cosine": (
        ZN, lambda d: definition(d, "P_hob_x_t_hob", minus)),
}  # fmt: skip


@pytest.mark.parametrize("words", quick(WRONG, *[*WRONG][::3]))
def test_wrong_physics_in_the_description_is_refused(words, tmp_path):
    name, change = WRONG[words]
    described = copy.deepcopy(description_of(name))
    change(described)
    with pytest.raises(Rejected):
        checked(name, described, tmp_path)


def test_a_drive_of_which_nothing_is_printed_is_refused(tmp_path):
    with pytest.raises(Rejected, match="nothing printed"):
        checked("cone_drive", description_of(SPUR), tmp_path)


def test_a_line_that_says_nothing_is_refused():
    with pytest.raises(Rejected, match="not a statement"):
        read_printed("[a_*]\nrule A\n")


def test_what_nothing_is_said_of_is_refused(tmp_path):
    described = copy.deepcopy(description_of(SPUR))
    described["sizes"].append({"key": "made_up_mm", "value": "m", "meaning": "made up"})
    with pytest.raises(Rejected, match="nothing says what size made_up_mm is"):
        checked(SPUR, described, tmp_path)


def test_a_result_that_gives_one_root_twice_is_refused(tmp_path):
    described = copy.deepcopy(description_of(ZN))
    function = next(f for f in described["functions"] if f["name"] == "tool_point")
    function["results"][0]["values"][1] = function["results"][0]["values"][0]
    with pytest.raises(Rejected, match="one root twice"):
        checked(ZN, described, tmp_path)


def test_abbreviations_hold_for_their_own_section_and_word():
    (_, first), (patterns, second), (_, other) = read_printed(
        "[a_* x:1 y:2:!a_b]\nlet p: q_%\nsize $_mm: p | source\n[b_*]\nsize z_mm: p | source\n"
    )
    assert [found.sides for found in (*first, *second)] == [("q_1",), ("q_2",)]
    assert is_about("a_c", patterns) and not is_about("a_b", patterns)
    assert other[0].sides == ("p",)
