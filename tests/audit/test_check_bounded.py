"""Edge systems, limits beyond first order and CasADi's functions hold as generated; a changed sign or row does not."""

import json
import re
from pathlib import Path

import pytest

from derive.audit.checker import attempts, check_bounded
from derive.audit.checker.any_root import kept_draws, with_any_root
from derive.audit.checker.casadi_functions import Casadi
from derive.audit.checker.edges import BoundedDrive, check_systems
from derive.audit.checker.refusal import Rejected

GENERATED = Path(__file__).resolve().parents[2] / "generated"
SPUR = "spherical_convex_spur"


def drive_of(name, change=lambda text: text):
    texts = [(GENERATED / "c" / f"{name}{end}.h").read_text(encoding="utf-8") for end in ("", "_bounded")]
    description = json.loads((GENERATED / "descriptions" / f"{name}.json").read_text(encoding="utf-8"))
    return BoundedDrive(description, texts[0], change(texts[1]))


def only(drive, words, functions=None):
    """Of all checks those whose words hold a text, where roots exist or may be any function."""
    chosen = [check for name, check in check_bounded.checks_of(drive, functions) if words in name]
    assert chosen
    draws = kept_draws()
    for check, *arguments in chosen:
        with_any_root(check, tuple(arguments), draws)


@pytest.fixture(autouse=True)
def few_attempts(monkeypatch):
    monkeypatch.setattr(attempts, "ATTEMPTS", 500)


@pytest.mark.parametrize("name", [SPUR, pytest.param("face_worm", marks=pytest.mark.validate)])
def test_edges_limits_and_casadi_hold(name):
    header = GENERATED / "c" / f"{name}.h"
    assert check_bounded.check_drive(GENERATED / "descriptions" / f"{name}.json", header, GENERATED / "casadi") > 30


@pytest.mark.parametrize(
    ("function", "pattern", "other", "words"),
    [
        ("edges", r"R\[4\] = (\S+);", r"R[4] = -\1;", "edges"),
        ("edges", r"R\[8\] = (\S+);", r"R[8] = -\1;", "edges"),
        ("edges", r"J\[7\] = (\S+);", r"J[7] = -(\1);", "slopes of edges"),
        ("slopes_flank_pinion", r"o\[4\] = (\S+);", r"o[4] = -(\1);", "derivatives of flank_pinion"),
        ("second_flank_wheel", r"o\[1\] = (\S+);", r"o[1] = q[0];", "derivatives of flank_wheel"),
    ],
)
def test_a_changed_function_is_refused(function, pattern, other, words):
    def change(text):
        head, name, body = text.partition(f" {SPUR}_{function}(")
        changed, count = re.subn(pattern, other, body, count=1)
        assert count == 1
        return head + name + changed

    with pytest.raises(Rejected):
        only(drive_of(SPUR, change), words)


@pytest.mark.parametrize(("old", "new"), [("{ 0, 1, 2, 4, 8 }", "{ 0, 1, 2, 4, 7 }"), ("{ { -1, 1 }", "{ { -1, 0 }")])
def test_a_system_of_other_equations_is_refused(old, new):
    drive = drive_of(SPUR, lambda text: text.replace(old, new, 1))
    with pytest.raises(Rejected, match="edges"):
        check_systems(drive)


def test_a_changed_instruction_of_casadi_is_refused():
    drive, functions = drive_of(SPUR), Casadi(GENERATED / "casadi", SPUR)
    only(drive, "CasADi: residual", functions)
    function, loaded = functions("")
    at, _ = function.outputs["residual"]
    function.definitions[f"o[{at + 1}]"] = ("expression", f"-{function.definitions[f'o[{at + 1}]'][1]}")
    with pytest.raises(Rejected, match="residual"):
        only(drive, "CasADi: residual", functions)


@pytest.mark.parametrize(
    ("pattern", "other", "reason"),
    [
        (r"(certified_setup_operation\[\] = {\n[^\n]*\n)2,", r"\g<1>0,", "table setup"),
        (r"(certified_equations_output\[\] = { )(\d+),(\d+)", r"\g<1>\3,\2", "table equations"),
        (r"(certified_rule_7_constant\[\] = {) { 0\.785", r"\1 { 0.786", "within its radius"),
        (r"(certified_observed_input\[\] = { )(\d+),(\d+)", r"\g<1>\3,\2", "table observed"),
        (r"(certified_along_input\[\] = { )(\d+),(\d+)", r"\g<1>\3,\2", "table along"),
        (r"(certified_flank_0_input\[\] = { )(\d+),(\d+)", r"\g<1>\3,\2", "table flank_0"),
        (r"(certified_flank_1_output\[\] = { )(\d+),(\d+)", r"\g<1>\3,\2", "table flank_1"),
        (r"(certified_placement_output\[\] = { )(\d+),(\d+)", r"\g<1>\3,\2", "table placement"),
        (r"3\.061616997868383e-17", "3.1e-17", "within its radius"),
        (r"2\.9486522708701687e-19", "2.8e-19", "the unit of"),
    ],
)
def test_a_changed_table_is_refused(pattern, other, reason):
    drive = drive_of(SPUR)
    text = (GENERATED / "c" / f"{SPUR}_certified.h").read_text(encoding="utf-8")
    drive.tables, count = re.subn(pattern, other, text, count=1)
    assert count == 1
    with pytest.raises(Rejected, match=reason):
        only(drive, "table")
