"""All of a header is read: as generated it is accepted, and a change of what stands around its functions is refused."""

import json
import math
import random
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from derive.audit.checker import check_code, check_description, check_shipped
from derive.audit.checker.refusal import Rejected
from derive.audit.checker.shipped import COMMENT, TOKEN, Runtime

ROOT = Path(__file__).resolve().parents[2]
GENERATED = ROOT / "generated"
SPUR, ZN = "spherical_convex_spur", "cylindrical_worm_zn_zn"
ENDINGS = (".h", "_certify.h", "_lanes.h", "_sensitivity.h", ".json")


@pytest.fixture
def shipped(tmp_path):
    """A folder of one drive's files, and what checks them."""

    def made(drive):
        for ending in ENDINGS:
            shutil.copy(GENERATED / "c" / f"{drive}{ending}", tmp_path)
        shutil.copy(GENERATED / "descriptions" / f"{drive}.json", tmp_path / "description.json")
        return tmp_path

    return made


def read(folder, drive):
    runtime = Runtime(ROOT / "runtime" / "c")
    return check_shipped.check_drive(folder / "description.json", folder / f"{drive}.h", runtime)


def changed(path, old, new):
    text = path.read_text(encoding="utf-8")
    result, count = re.subn(old, new, text, count=1)
    assert count == 1, f"{path.name} has no {old}"
    assert result != text
    path.write_text(result, encoding="utf-8")


@pytest.mark.parametrize("drive", [SPUR, ZN])
def test_a_generated_header_is_read_whole(drive, shipped):
    assert read(shipped(drive), drive) > 400


@pytest.mark.validate
def test_every_generated_header_is_read_whole():
    script = GENERATED / "audit" / "check_shipped.py"
    result = subprocess.run([sys.executable, "-I", "-S", script], capture_output=True, text=True, cwd="/")
    assert result.returncode == 0, result.stderr
    assert "headers are read" in result.stdout


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (r"_U_transmission_error \d+", "_U_transmission_error 0"),
        (r"_O_wheel_angle \d+", "_O_wheel_angle 0"),
        (r"_P_separation_mm (\d+)", r"_P_separation_mm 1\1"),
        (r"_W_flank_right \(1\)", "_W_flank_right (-1)"),
        (r"#define (\w+)_P_flank 0\n", r"#define \1_P_flank 0\n#define \1_P_flankk 0\n"),
        (r"_flags\[\] = { \"off_tip\"", '_flags[] = { "off_root"'),
        (r"_events\[\] = { \"tip\"", '_events[] = { "root"'),
        (r"\"bad_input\"", '"bad"'),
        (r"X\(MW_NO_CONTACT, (-?\d+)", r"X(MW_NO_CONTACT, 1\1"),
        (r"_SPEC_HASH \"..", '_SPEC_HASH "zz'),
        (r"_OTHER_FLANK 0", "_OTHER_FLANK -1"),
        (r"_NFLAGS (\d+)", r"_NFLAGS 1\1"),
        (r"MWI_NEWTON_STEP_DONE = 1e-9", "MWI_NEWTON_STEP_DONE = 1e-3"),
        (r"MWI_BELIEVED = 1e-9", "MWI_BELIEVED = 1e-2"),
        (r"static inline int mwi_usable", "static inline int mwi_unusable"),
        (r"= NAN;", "= 0.0;"),
        (r"#if defined\(__FAST_MATH__\)", "#if defined(__NO_FAST_MATH__)"),
        (r"0\.017453292519943295, 0\.0", "0.017453292519943299, 0.0"),
        (r"\"mm\", \"normal module\"", '"rad", "normal module"'),
        (r"\"normal_module_mm\", \"design\"", '"normal_module_mm", "blank"'),
        (r"missing from the design: give it a value\"", 'missing"'),
        (r"_geometry\(const double \*s, const double \*x,", "_geometry(const double *x, const double *s,"),
        (r"touch < 0 \? touch : kind", "touch < 0 ? kind : touch"),
        (r"return failed \? \w+ : 0;|return failed \? \w+\(p, failed\) : 0;", "return 0;"),
        (r"if \(J == NULL\) return;", ""),
        (r"_sample_angle = 1\.0", "_sample_angle = 1.5"),
        (r"_sample_contact\[\] = { ([-\d.e]+)", r"_sample_contact[] = { 1.0\1"),
        (r"static const double \w+_sample\[\] = { 1\.0, 2\.0", "static const double x_sample[] = { 1.0, 2.5"),
        (r"#define MW_SIGN\(a\) \(\(a\) < 0\.0", "#define MW_SIGN(a) ((a) <= 0.0"),
        (r"\(\(c\) - \(a\) \* \(b\)\)", "((a) * (b) - (c))"),
        (r"mwi_flag\(&\w+_model, bit\)", "NULL"),
        (r"#undef MW_S\n", ""),
    ],
)
def test_a_change_of_what_stands_around_functions_is_refused(old, new, shipped):
    folder = shipped(ZN)
    changed(folder / f"{ZN}.h", old, new)
    with pytest.raises(Rejected):
        read(folder, ZN)


@pytest.mark.parametrize(
    ("ending", "old", "new"),
    [
        ("_certify.h", r"MWC_U = 1\.1102230246251565e-16", "MWC_U = 5.551115123125783e-17"),
        ("_certify.h", r"MWC_SINE = [\d.e-]+", "MWC_SINE = 0.0"),
        ("_certify.h", r"mwc_mul\((b_\w+), (b_\w+)\)", r"mwc_add(\1, \2)"),
        ("_certify.h", r"mwc_units_scaled\((m_\w+), r_\w+,", r"mwc_units_scaled(\1, 0.0,"),
        ("_certify.h", r"mwc_units_sum\((r_\w+), r_\w+,", r"mwc_units_sum(\1, 0.0,"),
        ("_certify.h", r"\.mid, mwc_units_size\(m_\w+, turn_\w+\.sine\.mid\)", ".mid, 0.0"),
        ("_certify.h", r"mwc_wide\(1\.5707963267948966, 6\.1\S+,", "mwc_wide(1.5707963267948966, 0.0,"),
        ("_certify.h", r"if \(!\(proved\[0\] > 0\.0 && .*", ""),
        ("_certify.h", r"return s\[\d+\] > 0\.0;", "return 1;"),
        ("_certify.h", r"MWC_KEEP\(sizes, 0, \w+\)", "MWC_KEEP(sizes, 0, mwc_make)"),
        ("_certify.h", r"mwc_put\(s, 0, mwc_of_wide\(\w+\)\)", "mwc_put(s, 0, mwc_of_wide(w_ratio))"),
        ("_certify.h", r"MWC_SHARED\(s,", "MWC_OWN(s,"),
        ("_certify.h", r"mwc_make\(1\.0, 0\.0\)", "mwc_make(1.0, 1.0)"),
        (".json", r'"parity": -1', '"parity": 1'),
        (".json", r'"lower": 0\.0', '"lower": -1.0'),
        (".json", r'"self_test": {\s*"p": \[\s*"0x1\.0', '"self_test": {"p": ["0x1.1'),
        (".json", r'"specification_hash": "..', '"specification_hash": "zz'),
    ],
)
def test_a_change_beside_the_header_is_refused(ending, old, new, shipped):
    folder = shipped(ZN)
    changed(folder / f"{ZN}{ending}", old, new)
    with pytest.raises(Rejected):
        read(folder, ZN)


@pytest.mark.parametrize("change", ["domain", "parity", "factor", "word", "ending"])
def test_a_description_of_another_interface_is_refused(change, shipped):
    folder = shipped(ZN)
    path = folder / "description.json"
    description = json.loads(path.read_text(encoding="utf-8"))
    key = next(entry for entry in description["keys"] if entry["key"] == "worm_thickness_allowance_um")
    match change:
        case "domain":
            description["contact"]["unknowns"][0]["domain"] = [None, None]
        case "parity":
            description["contact"]["unknowns"][0]["parity"] = -1
        case "factor":
            key["factor"] = ["/", 1, 10000]
        case "word":
            description["keys"][0]["choices"] = {"left": 1, "right": -1}
        case "ending":
            key["key"] = "worm_thickness_allowance_mm"
    path.write_text(json.dumps(description), encoding="utf-8")
    with pytest.raises(Rejected):
        read(folder, ZN)


def changed_token(text, tokens, rng):
    """A text with one token changed: a letter, an operator, a number by a unit of its last place or tenfold, a name."""
    while True:
        start, end, token = rng.choice(tokens)
        if token[0] == '"' and len(token) > 2:
            k = rng.randrange(1, len(token) - 1)
            other = token[:k] + rng.choice("abcxyz") + token[k + 1 :]
        elif re.fullmatch(r"\d+", token):
            other = str(int(token) + rng.choice((1, 2, 10)))
        elif re.fullmatch(r"\d[\d.]*(e[-+]?\d+)?", token):
            value = float(token)
            other = repr(rng.choice((math.nextafter(value, math.inf), 10.0 * value or 1.0)))
        elif re.fullmatch(r"[A-Za-z_]\w*", token):
            other = rng.choice([name for *_, name in tokens if re.fullmatch(r"[A-Za-z_]\w*", name)])
        else:
            other = {"+": "-", "-": "+", "*": "/", "<": ">", ">": ">=", "==": "!=", "&&": "||"}.get(token, token)
        if other != token:
            return text[:start] + other + text[end:], f"{text[max(0, start - 60) : end + 20]!r}: {other}"


def tokens_of(text):
    """Start, end and text of each token outside comments."""
    blank = COMMENT.sub(lambda found: found[1] or re.sub(r"[^\n]", " ", found[0]), text)
    return [(found.start(), found.end(), found[0]) for found in TOKEN.finditer(blank)]


@pytest.mark.validate
@pytest.mark.parametrize("ending", [".h", "_certify.h"])
def test_any_changed_token_is_refused(ending, shipped, monkeypatch):
    """By what reads the whole header, or, within a function, by what runs it; but for what no compiler accepts."""
    monkeypatch.setattr("derive.audit.checker.attempts.ATTEMPTS", 200)
    folder, rng = shipped(SPUR), random.Random(7)
    path = folder / f"{SPUR}{ending}"
    text = path.read_text(encoding="utf-8")
    tokens, accepted, count = tokens_of(text), [], 50
    for _ in range(count):
        other, words = changed_token(text, tokens, rng)
        path.write_text(other, encoding="utf-8")
        try:
            read(folder, SPUR)
            check_code.check_header(folder / f"{SPUR}.h")
            check_description.check_drive(folder / "description.json", folder / f"{SPUR}.h")
        except Rejected:
            continue
        accepted.append(words)
    assert len(accepted) <= 0.03 * count, accepted
