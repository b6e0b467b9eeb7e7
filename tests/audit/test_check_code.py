"""The generated C is run modulo a prime against calculus: it holds as committed, and a changed sign does not."""

import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

from derive.audit.checker import attempts, check_code
from derive.audit.checker.kernels import check_kernels
from derive.audit.checker.refusal import Rejected
from meshwright.base.drives import folder_of
from tests.quick import quick

ALL_ATTEMPTS = attempts.ATTEMPTS
GENERATED = Path(__file__).resolve().parents[2] / "generated"
ZN = "cylindrical_worm_zn_zn"


@pytest.mark.parametrize("drive", ["cylindrical_worm_zn_zn", "spherical_convex_spur"])
def test_a_generated_header_is_its_own_mathematics(drive, monkeypatch):
    monkeypatch.setattr(attempts, "ATTEMPTS", ALL_ATTEMPTS)
    assert check_code.check_header(GENERATED / "c" / f"{drive}.h") > 10


@pytest.mark.validate
def test_every_generated_header_is_its_own_mathematics():
    script = GENERATED / "audit" / "check_code.py"
    result = subprocess.run([sys.executable, "-I", "-S", script], capture_output=True, text=True, cwd="/")
    assert result.returncode == 0, result.stderr
    assert "J = dR/dx" in result.stdout


def header(name):
    generated = GENERATED / "c" / f"{name}.h"
    path = generated if generated.is_file() else folder_of(name) / "include" / f"{name}.h"
    return path.read_text(encoding="utf-8")


def rejected(tmp_path, text, match):
    path = tmp_path / "drive.h"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(Rejected, match=match):
        check_code.check_header(path)


@pytest.fixture(autouse=True)
def few_attempts(monkeypatch):
    monkeypatch.setattr(attempts, "ATTEMPTS", 400)


def test_a_changed_jacobian_entry_is_caught(tmp_path):
    text = re.sub(r"J\[7\] = (.+);", r"J[7] = -(\1);", header("spherical_convex_spur"), count=1)
    text = re.sub(r"J\[7\] = -\((\w+)\);", r"J[7] = 2.0 * \1;", text)
    rejected(tmp_path, text, r"J\[1\]\[2\] is not the derivative")


@pytest.mark.parametrize(
    ("kept", "wrong", "message"),
    [
        (r"(_by_anchor\(const.*?)R\[2\] = (\w+);", r"\1R[2] = -\2;", r"by_anchor: R\[2\] is not that of eval"),
        (r"(_anchor\(const.*?)at\[3\] = (\S+);", r"\1at[3] = 2.0 * \2;", r"anchor: at\[3\] is another angle"),
        (r"at \+ 4, at \+ 5\);", "at + 5, at + 4);", "anchor: sines at other places"),
        (r", at \+ 6, &away", ", at + 3, &away", "anchor: at.3. is another angle"),
        (r"0\.16666666666666666\), r\);", "0.125), r);", "near_sincos: 1/6 is another number"),
        (r"\*cosine = at\[2\] - ", "*cosine = at[2] + ", "near_sincos: other statements"),
        (r"_NEAREST 3\.8\S+\n", "_NEAREST 1e-4\n", "near_sincos: the series leave more than round-off"),
    ],
)
def test_a_change_of_the_residual_by_an_anchor_is_caught(tmp_path, kept, wrong, message):
    text = header("spherical_convex_spur")
    changed = re.sub(kept, wrong, text, count=1, flags=re.DOTALL)
    assert changed != text
    rejected(tmp_path, changed, message)


def test_a_changed_normal_is_caught(tmp_path):
    source = header("cylindrical_worm_zn_zn")
    body = source[source.index("_flank_wheel(const") :]
    wrong = re.sub(r"o\[4\] = (\w+);", r"o[4] = -\1;", body, count=1)
    rejected(tmp_path, source.replace(body, wrong), "not perpendicular")


def test_a_changed_point_is_caught(tmp_path):
    source = header("cylindrical_worm_zk_zn")
    body = source[source.index("_flank_wheel(const") :]
    wrong = re.sub(r"o\[2\] = (\w+);", r"o[2] = \1 * \1;", body, count=1)
    rejected(tmp_path, source.replace(body, wrong), "not the derivative of the point")


def test_a_statement_that_cannot_be_read_is_an_error(tmp_path):
    head, signature, tail = header("spherical_spur_spur").partition("_eval(const double *s, const double *x")
    tail = tail.replace("if (J == NULL) return;", "R[0] += 1.0;\nif (J == NULL) return;", 1)
    rejected(tmp_path, head + signature + tail, "not a straight-line statement")


@pytest.mark.parametrize("every", quick([24, 3], 24))
def test_changed_signs_inside_the_programs_are_caught(capsys, tmp_path, every):
    """Sums turned into a difference, one at a time, in the residual and the wheel flank."""
    source = header("cylindrical_worm_zn_zn")
    opposite = {" + ": " - ", "MW_FMA": "MW_FNMA"}
    caught = total = 0
    for function in ("_eval(const", "_flank_wheel(const"):
        start = source.index(function)
        body = source[start : source.index("\n}", start)]
        sums = list(re.finditer(r" \+ |MW_FMA", body))
        for match in sums[::every]:
            total += 1
            wrong = body[: match.start()] + opposite[match[0]] + body[match.end() :]
            path = tmp_path / "drive.h"
            path.write_text(source.replace(body, wrong), encoding="utf-8")
            try:
                check_code.check_header(path)
            except Rejected:
                caught += 1
    with capsys.disabled():
        print(f"\n{caught} of {total} changed signs in generated C caught")
    assert caught == total >= 90 // every


def one_change(text, function, pattern, other):
    """The first match inside a function's body replaced."""
    start = text.index(f"_{function}(const")
    at = re.compile(pattern).search(text, start)
    assert at and at.start() < text.index("\n}", start)
    return text[: at.start()] + other + text[at.end() :]


@pytest.mark.parametrize(
    ("function", "pattern", "other", "reason"),
    [
        ("step", r"x\[1\] = (t_\w+)", "x[1] = x[0]", "step: row|J dx"),
        ("along", r"MW_FMA\(", "MW_FNMA(", "along|step|not the derivative"),
        ("start_eval", r"J\[0\] = (t_\w+)", "J[0] = y[0]", "start_eval"),
        ("curvature_flank_wheel", r"o\[6\] = (t_\w+)", "o[6] = q[0]", "change of the normal|sum"),
    ],
)
def test_a_change_of_other_functions_is_caught(tmp_path, function, pattern, other, reason):
    rejected(tmp_path, one_change(header("cylindrical_worm_zn_zn"), function, pattern, other), reason)


@pytest.mark.parametrize(
    ("ending", "change"), [("lanes", ("MW_FMA(", "MW_FNMA(")), ("sensitivity", ("dR[1] = ", "dR[1] = 2.0 * "))]
)
def test_a_change_of_lanes_and_of_tangents_is_caught(tmp_path, ending, change):
    name = "cylindrical_worm_zn_zn"
    for other in ("lanes", "sensitivity"):
        shutil.copy(GENERATED / "c" / f"{name}_{other}.h", tmp_path / f"drive_{other}.h")
    path = tmp_path / f"drive_{ending}.h"
    head, last, body = path.read_text(encoding="utf-8").rpartition("static inline")
    path.write_text(head + last + body.replace(*change, 1), encoding="utf-8")
    rejected(tmp_path, header(name), "lanes|tangent")


@pytest.mark.parametrize("body", ["pinion", "wheel"])
def test_a_change_of_the_tangents_of_a_flank_is_caught(tmp_path, body):
    name = "cylindrical_worm_zn_zn"
    text = (GENERATED / "c" / f"{name}_sensitivity.h").read_text(encoding="utf-8")
    head, signature, rest = text.partition(f"{name}_{body}_tangent(")
    assert signature
    changed = head + signature + rest.replace("dr[1] = ", "dr[1] = 2.0 * ", 1)
    (tmp_path / "drive_sensitivity.h").write_text(changed, encoding="utf-8")
    rejected(tmp_path, header(name), f"tangent of {body}")


@pytest.mark.parametrize("digits", ["0.008333333333330948", "1.5707963267341256", "-0.0013888888888887398"])
def test_a_changed_constant_of_sine_and_cosine_is_caught(tmp_path, digits):
    wrong = digits[:-6] + str(int(digits[-6]) ^ 1) + digits[-5:]
    rejected(tmp_path, header("spherical_convex_convex").replace(digits, wrong), "sincos")


def test_a_wrong_header_is_refused_within_seconds(tmp_path, monkeypatch):
    """A wrong normal, with as many inputs as the shipped checker may draw."""
    monkeypatch.setattr(attempts, "ATTEMPTS", ALL_ATTEMPTS)
    source = header("face_worm")
    body = source[source.index("_flank_wheel(const") :]
    wrong = re.sub(r"o\[4\] = (\w+);", r"o[4] = -\1;", body, count=1)
    started = time.process_time()
    rejected(tmp_path, source.replace(body, wrong), "perpendicular|not the derivative|slopes")
    assert time.process_time() - started < 10


def test_a_folder_without_the_programs_is_rejected(tmp_path):
    (tmp_path / "audit").mkdir()
    (tmp_path / "c").mkdir()
    shutil.copy(GENERATED / "c" / "face_worm_lanes.h", tmp_path / "c")
    (tmp_path / "c" / "drive.h").write_text("static inline int drive_setup(const double *p, double *s)\n{\n}\n")
    assert check_code.main([str(tmp_path / "audit")]) == 1


@pytest.mark.parametrize(
    ("kept", "wrong", "message"),
    [
        ("odd = 0 - (", "odd = 0 + (", "quadrant"),
        ("magic = 6755399441055744.0", "magic = 3377699720527872.0", "magic"),
        ("((a - k", "((a + k", "reduction"),
        ("sign = quadrant << 62", "sign = quadrant << 61", "sign"),
        ("*cosine = c.number", "*cosine = s.number", "cosine"),
    ],
)
def test_what_stands_around_the_polynomials_of_sine_and_cosine_is_read(kept, wrong, message):
    text = header("spherical_convex_spur")
    check_kernels(text)
    assert kept in text
    with pytest.raises(Rejected, match=message):
        check_kernels(text.replace(kept, wrong, 1))


@pytest.mark.parametrize(("old", "new"), [(f"work[{ZN}_NP + 1]", f"work[{ZN}_NP - 1]"), ("p[k] = s[", "p[0] = s[")])
def test_what_calls_the_solver_stands_as_it_must(tmp_path, old, new):
    path = tmp_path / "drive.h"
    text = (GENERATED / "c" / f"{ZN}.h").read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(Rejected, match="not the text"):
        check_code.check_header(path)
