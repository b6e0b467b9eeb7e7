"""The record as a whole: quick to prove, quick to re-check, the same every time, readable from the command line."""

import os
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from derive.audit import __main__ as command
from derive.audit import ledger, record
from derive.audit.checker.record import read_record
from derive.audit.provenance import cited, provenance
from derive.audit.standing import standings
from derive.drives import catalogue
from derive.language.chain import Rz
from derive.passes.schedule import schedule

ROOT = Path(__file__).resolve().parents[2]
GENERATED = ROOT / "generated"


@pytest.mark.parametrize(
    "setting",
    [
        pytest.param({"PYTHONHASHSEED": "1"}, id="other hash seed", marks=pytest.mark.validate),
        pytest.param({"PYTHONHASHSEED": "2", "BACKEND": "sympy"}, id="SymPy rings", marks=pytest.mark.validate),
    ],
)
def test_root_does_not_depend_on_machine_or_back_end(setting):
    program = (
        "import os, derive.prove.polynomial as p\n"
        "if os.environ.get('BACKEND'): p.BACKENDS = (os.environ['BACKEND'],)\n"
        "import derive.audit.ledger as l\n"
        "from derive.audit.documents import rack_and_pinion as d\n"
        "print(l.build([d.CHAPTER]).root)"
    )
    here = ledger.build([record.chapters()[1]]).root
    result = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, cwd=ROOT, env={**os.environ, **setting}
    )
    assert result.stdout.strip() == here, result.stderr


def files_of(folder):
    """Every file of a folder by its place in it."""
    return {path.relative_to(folder).as_posix(): path for path in folder.rglob("*") if path.is_file()}


def test_record_contains_no_time_and_no_path_of_this_machine():
    for text in map(Path.read_text, files_of(GENERATED / "audit").values()):
        assert str(ROOT) not in text
        assert not re.search(r"20\d\d-\d\d-\d\dT", text)


@pytest.mark.validate  # `make test` derives them a second time as well
def test_pages_are_written_alike_every_time(tmp_path, capsys):
    assert command.main(["html", "--output", str(tmp_path)]) == 0
    written, kept = (
        {name: path.read_bytes() for name, path in files_of(f).items()} for f in (tmp_path, GENERATED / "audit")
    )
    assert written == kept


def test_pages_need_no_network():
    for path in (GENERATED / "audit").glob("*.html"):
        text = path.read_text(encoding="utf-8")
        assert not re.search(r'(src|href)="(https?:)?//', text) and "<script" not in text and "@import" not in text


def test_latex_is_plain_letters_that_every_engine_knows():
    text = (GENERATED / "audit" / "audit.tex").read_text(encoding="utf-8")
    assert text.isascii()
    assert text.count(r"\begin{") == text.count(r"\end{")


def test_every_header_names_its_statements_by_the_keys_of_the_record():
    verdicts = read_record(GENERATED / "audit").values()
    keys = {item["id"]: item["sha256"][:16] for item in verdicts if item["object"] == "verdict"}
    headers = [path.with_suffix(".h") for path in (GENERATED / "c").glob("*.json")]
    assert len(headers) >= 10
    for path in headers:
        text = path.read_text(encoding="utf-8")
        functions = record.functions_of(text)
        named = {key for named in functions.values() for key in named}
        assert named and all(re.search(rf"\n \*   {re.escape(key)} +{keys[key]}\n", text) for key in named)
        assert any(name.endswith("_eval") for name in functions)
        assert any("_flank_wheel" in name for name in functions)


def test_explain_walks_from_c_function_to_source(capsys):
    assert command.main(["explain", "cylindrical_worm_zn_zn_flank_wheel"]) == 0
    assert "cylindrical_worm/meshing" in capsys.readouterr().out
    assert command.main(["explain", "cylindrical_worm.meshing"]) == 0
    text = capsys.readouterr().out
    assert "derive/drives/cylindrical_worm.py" in text
    assert "generated/c/cylindrical_worm_zn_zn.h:" in text
    assert "n_hob := cross(d(hob; t), d(hob; psi))" in text


def test_explain_shows_print_counterexample_and_correction(capsys):
    command.main(["explain", "recess-action/eq-16"])
    text = capsys.readouterr().out
    assert "Eq (16)" in text and "000_e4dc51872e8570c2.txt" in text
    assert "refuted by exact_point" in text and "proved by ring_nf" in text


def test_unknown_equation_is_bad_input_with_a_hint(capsys):
    assert command.main(["explain", "cylindrical_worm.meshin"]) == 2
    assert "cylindrical_worm/meshing" in capsys.readouterr().err


@pytest.mark.validate  # `make audit` re-checks it too; a smaller record, without any package: test_check.py
def test_verify_reports_success():
    assert command.main(["verify"]) == 0


def test_verify_reports_rejection(tmp_path, capsys):
    assert command.main(["--generated", str(tmp_path), "verify"]) == 1
    assert "REJECTED" in capsys.readouterr().err


def test_a_citation_holds_of_what_was_proved_and_of_nothing_else():
    """A statement that a surface names appears in every function that reads it; one that is false, unknown, or proved
    of the definitions of other pages is open, with the reason, and appears in none.
    """
    plan = schedule(catalogue()["spherical_spur_spur"]())
    drive = plan.drive

    def with_wheel_on(*statements):
        on = replace(drive, wheel=replace(drive.wheel, surface=drive.wheel.surface.on(*statements)))
        steps = cited(replace(plan, drive=on))
        return provenance(standings({key for keys in steps.values() for key in keys}), steps)

    true = "derivation/circle"
    other, unknown, false = "helicoids/zc-limit", "derivation/wish", "recess-action/eq-7"
    found = with_wheel_on(true, other, unknown, false)
    assert all(true in found["equations_of"][name] for name in ("flank_wheel", "eval", "step", "observe"))
    assert true not in found["equations_of"]["flank_pinion"]
    assert found["open"].keys() == {other, unknown, false} and not found["open"].keys() & found["keys"].keys()
    assert re.search(r"proved of the definitions of .*grinding_arc\.py, not of .*test_record\.py", found["open"][other])
    assert found["open"][unknown] == "the audit record has no statement of this name"
    assert re.match(r"false: at .* its left side is", found["open"][false])


def test_explain_shows_side_conditions_of_function_statement_and_drive(capsys):
    assert command.main(["explain", "cylindrical_worm_zn_zn_step"]) == 0
    text = capsys.readouterr().out
    assert "pivot 1 of the Newton step ≠ 0" in text or "pivot 2 of the Newton step ≠ 0" in text
    assert "[derivation/explicit" in text
    assert command.main(["explain", "cylindrical_worm_zn_zn_setup"]) == 0
    assert "sin(Sigma_gen) must not be 0" in capsys.readouterr().out
    assert command.main(["explain", "derivation/explicit"]) == 0
    assert "cos(theta_pinion) ≠ 0" in capsys.readouterr().out
    assert command.main(["explain", "face_worm"]) == 0
    assert "derive (" in capsys.readouterr().out


def test_a_page_answers_for_what_it_has_put_together_by_hand_and_for_every_statement_that_it_hands_on():
    """A surface of the tree changed outside it, and one that is given the statements of another, rest on no proof of
    the tree's page; made further by words of the language alone, it rests on all that it did.
    """
    name, here = "helicoids/zn-straight", __file__
    worm = catalogue()["cylindrical_worm_zn_zn"]().pinion.surface
    known = standings({name})[name]

    def said(surface):
        (statement,) = (step for step in surface.steps if step == name)
        return known.open_for(statement)

    assert not said(worm) and not said(worm.placed(Rz(1))) and not said(worm.turned_over())
    by_hand = replace(worm, point=(worm.point[0], worm.point[1], 2 * worm.point[2]))
    other = catalogue()["cylindrical_worm_za_za"]().pinion.surface.on(*worm.steps)
    for made in (by_hand, by_hand.placed(Rz(1)), other):
        assert Path(here).name in said(made)
