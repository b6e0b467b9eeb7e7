"""The record as a whole: quick to prove, quick to re-check, the same every time, readable from the command line."""

import json
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
from derive.audit.provenance import Proved, provenance
from derive.drives import catalogue
from derive.passes.schedule import schedule

ROOT = Path(__file__).resolve().parents[2]
GENERATED = ROOT / "generated"


@pytest.mark.validate  # `make audit` re-checks it too; a smaller record: test_check.py
def test_committed_record_holds_with_the_standard_library_alone():
    result = subprocess.run(
        [sys.executable, "-I", "-S", GENERATED / "audit" / "check.py"], capture_output=True, text=True, cwd="/"
    )
    assert result.returncode == 0, result.stderr


@pytest.mark.parametrize(
    "setting",
    [{"PYTHONHASHSEED": "1"}, {"PYTHONHASHSEED": "2", "BACKEND": "sympy"}],
    ids=["other hash seed", "SymPy rings"],
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


def test_every_header_carries_root_and_equations():
    root = json.loads((GENERATED / "audit" / "artifacts.json").read_text(encoding="utf-8"))["root"]
    headers = [path.with_suffix(".h") for path in (GENERATED / "c").glob("*.json")]
    assert len(headers) >= 10
    for path in headers:
        text = path.read_text(encoding="utf-8")
        assert root in text
        functions = record.functions_of(text)
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


@pytest.mark.validate
def test_verify_reports_success():
    assert command.main(["verify"]) == 0


def test_verify_reports_rejection(tmp_path, capsys):
    assert command.main(["--generated", str(tmp_path), "verify"]) == 1
    assert "REJECTED" in capsys.readouterr().err


def test_a_function_may_only_rest_on_what_is_proved():
    plan = schedule(catalogue()["spherical_spur_spur"]())
    with pytest.raises(ValueError, match="conventions/rotations, which the record does not hold"):
        provenance(Proved.by({}), plan)


def test_a_new_tool_brings_its_own_provenance():
    """The statement that a surface names appears in every function that reads it; one that is not proved is an error
    that names it.
    """
    proved = Proved.by(read_record(GENERATED / "audit"))
    plan = schedule(catalogue()["spherical_spur_spur"]())
    drive = plan.drive

    def with_wheel_on(statement):
        on = replace(drive, wheel=replace(drive.wheel, surface=drive.wheel.surface.on(statement)))
        return provenance(proved, replace(plan, drive=on))["equations_of"]

    used = with_wheel_on("helicoids/zc-limit")
    assert all("helicoids/zc-limit" in used[name] for name in ("flank_wheel", "eval", "step", "observe"))
    assert "helicoids/zc-limit" not in used["flank_pinion"]
    with pytest.raises(ValueError, match="spherical_spur_spur rests on derivation/wish, which the record does not"):
        with_wheel_on("derivation/wish")
    with pytest.raises(ValueError, match="rack-and-pinion/twice, which is not a proved statement"):
        with_wheel_on("rack-and-pinion/twice")


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
