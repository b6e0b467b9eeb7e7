"""Forged records, every hash, link, root and seal made anew by the forger: what is said must be wrong in itself."""

import json
import re

import pytest

from derive.audit.checker import certificates, check_record
from derive.audit.checker.refusal import Rejected
from tests.audit.forger import Forger, reseal, seal
from tests.quick import quick

MERSENNE = 2**61 - 1


@pytest.fixture
def forger(record):
    return Forger(record)


def test_a_record_that_is_only_hashed_again_holds(forger, record):
    forger.sealed()
    check_record.verify(record)


# ---- mathematics -----------------------------------------------------------------------------------------------------


def root_with_two_divisors(forger):
    """sqrt(x^2) = -sqrt(1) x, by a divisor whose sign is chosen."""
    roots = [root(4), root(1, divisor="-2")]
    forger.proof(["sqrt", 4], ["-", ["*", 2, ["sqrt", 1]]], roots=roots, generators=["sqrt0"],
                 text="sqrt(4) = -2*sqrt(1)", lhs=["2"], rhs=["-2"])  # fmt: skip


def fermat(forger):
    """x^(p - 1) = 1 by nested powers."""
    tree = "x"
    for factor in (2, 3, 3, 5, 5, 7, 11, 13, 31, 41, 61):
        tree = ["^", tree, factor]
    tree = ["*", ["^", ["^", ["^", tree, 1321 // 64], 32], 60], 1]
    forger.proof(tree, 1, text="x = 1", point={"symbols": {"x": "1"}, "half_tangents": {}}, lhs=["1"], rhs=["1"])


def enormous_degree(forger):
    """(((x^64)^64)^64 ...) = the same times one."""
    tree = "x"
    for _ in range(8):
        tree = ["^", tree, 64]
    forger.proof(tree, ["*", 1, tree], text="x = 1*x")


def leading_zero(forger):
    """One number written in two ways: two records would say one thing."""
    component = {"numerator": "", "denominators": [["01*0", 1]], "cofactors": []}
    forger.proof("x", ["*", 1, "x"], generators=["x"], components=[component], text="x = 1*x")


def refuted_circle(forger):
    """cos^2 + sin^2 = 1 for an angle that is defined by a length over a radius, called exact and refuted."""
    equation, certificate = (
        forger.equation("recess-action/eq-12/as printed/1"), forger.certificate("recess-action/eq-12/as printed/1")
    )  # fmt: skip
    forger.objects.append(
        {"object": "step", "id": "forged.a", "op": "define", "tree": ["/", "u", "r"], "inputs": [], "read": None,
         "sha256": "e" * 64}
    )
    equation |= {
        "lhs": ["+", ["^", ["cos", "a"], 2], ["^", ["sin", "a"], 2]], "rhs": 1, "where": {"a": "e" * 64},
        "signs": [], "jets": {},
    }  # fmt: skip
    for key in ("generators", "relations", "components", "degree"):
        certificate.pop(key, None)
    certificate |= {
        "kind": "exact_point", "outcome": "refuted", "angles": [{"symbol": "a", "divisor": 1}], "arcs": [], "roots": [],
        "point": {"symbols": {"u": "2", "r": "3"}, "half_tangents": {}}, "rounded": False, "lhs": ["1"], "rhs": ["1"],
        "differs": [0],
    }  # fmt: skip
    verdict = forger.verdict("recess-action/eq-12")
    verdict |= {"status": "false", "described": []}
    verdict["readings"][0]["texts"] = ["cos(a)**2 + sin(a)**2 = 1"]
    forger.source("recess-action/eq-12")["reading"] = {"as printed": ["cos(a)**2 + sin(a)**2 = 1"]}


def proof_with(forger, what):
    return next(c for c in forger.objects if c.get("kind") == "ring_nf" and what(c))


def worked_numbers(forger):
    certificate = proof_with(forger, lambda c: c["lhs"][0] != "0")
    certificate["lhs"] = certificate["rhs"] = ["7" for _ in certificate["lhs"]]


# ---- printed numbers -------------------------------------------------------------------------------------------------


def figure(forger):
    source = next(item for item in forger.objects if item["object"] == "source" and item["figures"])
    verdict = forger.verdict(source["id"])
    equation = forger.equation(f"{source['id']}/as printed/1")
    return source, verdict, equation, forger.certificate(equation["id"])


def misprint_called_proved(forger):
    """3 printed as 2.86."""
    source, verdict, equation, certificate = figure(forger)
    source["figures"] = verdict["readings"][0]["texts"] = [["3", "2.86"]]
    verdict["readings"][0]["parts"] = verdict["readings"][0]["parts"][:1]
    source["verbatim"] = "2.86"
    equation |= {"lhs": 3, "rhs": "2.86"}
    certificate |= {"value": "3", "outcome": "proved"}
    verdict |= {"status": "proved", "corrected": []}


def wide_pi(forger):
    """pi = 100, printed to no digit."""
    source, verdict, equation, certificate = figure(forger)
    misprint_called_proved(forger)
    source["figures"] = verdict["readings"][0]["texts"] = [["pi", "100"]]
    source["verbatim"] = "100"
    equation |= {"lhs": "pi", "rhs": "100"}
    certificate["value"] = "3.14159265"


def number_with_exponent(forger):
    source, verdict, equation, certificate = figure(forger)
    misprint_called_proved(forger)
    source["figures"] = verdict["readings"][0]["texts"] = [["3", "3e2"]]
    source["verbatim"], equation["rhs"] = "3e2", "3e2"


# ---- bindings --------------------------------------------------------------------------------------------------------


def proof_of_something_true(forger):
    """The same with the reading left as it is."""
    text = forger.source("recess-action/eq-12")["reading"]["as printed"][0]
    forger.proof(["+", "x", "y"], ["+", "y", "x"], text=text, lhs=["2"], rhs=["2"],
                 point={"symbols": {"x": "1", "y": "1"}, "half_tangents": {}})  # fmt: skip


def correction_that_corrects_nothing(forger):
    verdict = forger.verdict("recess-action/eq-16")
    verdict["corrected"][0]["parts"] = verdict["readings"][0]["parts"]
    verdict["status"] = "proved_with_correction"


def correction_of_both_sides(forger):
    equation = forger.equation("recess-action/eq-16/corrected/1")
    equation |= {"lhs": ["+", equation["lhs"], 1], "rhs": ["+", equation["rhs"], 1]}


def two_certificates(forger):
    certificate = forger.certificate("recess-action/eq-16/as printed/1")
    forger.objects.append({**certificate, "differs": [0, 1], "sha256": "d" * 64})


def unused_object(forger):
    forger.objects.append(
        {"object": "step", "id": "forged.x", "op": "define", "tree": "y", "inputs": [], "read": None,
         "sha256": "c" * 64}
    )


def definition_of_another_name(forger):
    equation = next(e for e in forger.objects if e["object"] == "equation" and len(e["where"]) > 1)
    first, second = list(equation["where"])[:2]
    equation["where"][first] = equation["where"][second]


def step_with_an_input_it_does_not_use(forger):
    steps = [item for item in forger.objects if item["object"] == "step"]
    steps[-1]["inputs"] = sorted({*steps[-1]["inputs"], steps[0]["sha256"]})


def read(forger):
    """Where the worm's surface was read."""
    return forger.step("rack-and-pinion.R1")["read"]


def read_with_other_letters(forger):
    letters = forger.step("rack-and-pinion.r1")["read"]["letters"]
    letters[[old for old, _ in letters].index("phi_worm")][1] = "-phi1"


def read_from_a_vector_of_a_high_power(forger):
    vector = ["given", ["vec", ["^", "x", 10**9], 0, 0]]
    read(forger)["part"] = ["carried", ["sweep", "pinion", 0, 2], vector]


def read_from_parts_in_parts(forger):
    part = ["given", "P"]
    for _ in range(400):
        part = ["carried", ["sweep", "pinion", 0, 2], part]
    read(forger)["part"] = part


def read_from_no_drive(forger):
    for step in forger.objects:
        if step.get("read"):
            step["read"]["drive"] = "../audit/artifacts"
    for verdict in forger.objects:
        if verdict.get("described"):
            verdict["described"] = ["../audit/artifacts"]


def read_and_called_typed(forger):
    for step in forger.objects:
        if "read" in step:
            step["read"] = None


FORGED = [
    (root_with_two_divisors, "two divisors"),
    (fermat, "degree|not 'x = 1'|exponent"),
    (enormous_degree, "degree|is not"),
    (leading_zero, "canonical form"),
    (refuted_circle, "agree at the counterexample"),
    (worked_numbers, "recorded numbers"),
    (misprint_called_proved, "half a unit"),
    (wide_pi, "half a unit"),
    (number_with_exponent, "not a decimal"),
    (proof_of_something_true, "is not"),
    (correction_that_corrects_nothing, "status does not follow|nothing is corrected|rests on"),
    (correction_of_both_sides, "more than one side|recorded numbers|trees"),
    (two_certificates, "two certificates"),
    (unused_object, "no verdict rests on"),
    (definition_of_another_name, "another step's name"),
    (step_with_an_input_it_does_not_use, "not used"),
    (read_with_other_letters, "not what the description"),
    (read_from_a_vector_of_a_high_power, "exponent"),
    (read_from_parts_in_parts, "not what the description|Recursion|nested"),
    (read_from_no_drive, "is no drive"),
    (read_and_called_typed, "not the drives"),
]


def root(radicand, generator="sqrt0", divisor="1"):
    return {"radicand": radicand, "generator": generator, "divisor": divisor}


def multiple_of_a_prime(forger):
    """x + (2^61 - 1) y = x."""
    forger.proof(["+", "x", ["*", MERSENNE, "y"]], "x", text=f"x + {MERSENNE}*y = x",
                 point={"symbols": {"x": "1", "y": "0"}, "half_tangents": {}}, lhs=["1"], rhs=["1"])  # fmt: skip


#: The same of forgeries in one step.
IN_ONE_STEP = {
    "multiple of a prime": (multiple_of_a_prime, "trees differ"),
    "one name for two roots": (
        lambda f: f.proof(["sqrt", 2], ["sqrt", 3], roots=[root(2), root(3)], text="sqrt(2) = sqrt(3)"),
        "not of its radicand"
    ),
    "root named as cosine": (
        lambda f: f.proof(["sqrt", "x"], ["cos", "a"], roots=[root("x", "cos(a)")],
                          angles=[{"symbol": "a", "divisor": 1}], text="sqrt(x) = cos(a)"), "cannot be the name"
    ),
    "root named as symbol": (
        lambda f: f.proof(["sqrt", "x"], "y", roots=[root("x", "y")], text="sqrt(x) = y"), "cannot be the name"
    ),
    "arc named as symbol": (
        lambda f: f.proof(["atan2", "a", "b"], "z", arcs=[{"tree": ["atan2", "a", "b"], "generator": "z"}],
                          text="atan2(a, b) = z"), "cannot be the name"
    ),
    "symbol named as root": (
        lambda f: f.proof(["sqrt", "x"], "sqrt0", roots=[root("x")], text="sqrt(x) = sqrt0"), "no name of a symbol"
    ),
    "pi that is 3": (
        lambda f: f.one(object="certificate", kind="exact_point")["point"]["symbols"].update(pi="3"), "one value twice"
    ),
    "sign of two": (
        lambda f: proof_with(f, lambda c: "s" in c["point"]["symbols"])["point"]["symbols"].update(s="2"), "neither"
    ),
    "understated degree": (
        lambda f: proof_with(f, lambda c: c["degree"] > 1).update(degree=1), "recorded degree"
    ),
    "sign that is an angle": (
        lambda f: f.equation("recess-action/eq-16/as printed/1").update(
            signs=[f.certificate("recess-action/eq-16/as printed/1")["angles"][0]["symbol"]]), "two things"
    ),
    "number that is not printed": (
        lambda f: figure(f)[0].update(verbatim="no number at all"), "does not stand in the print"
    ),
    "rests on operands exchanged": (
        lambda f: f.proof(["+", "x", "y"], ["+", "y", "x"], text="x + y = y + x", lhs=["3"], rhs=["3"],
                          point={"symbols": {"x": "1", "y": "2"}, "half_tangents": {}}), "same expression"
    ),
    "refuted, on the proof of another verdict": (
        lambda f: f.verdict("recess-action/eq-16")["readings"][0].update(
            parts=f.verdict("recess-action/eq-12")["readings"][0]["parts"]), "another verdict|missing or added"
    ),
    "emptied readings": (
        lambda f: f.verdict("recess-action/eq-16").update(readings=[], corrected=[], status="not_mathematical"),
        "readings are not"
    ),
    "letter that stands for two things": (
        lambda f: read(f)["letters"].insert(0, ["tan(lambda_hob)", "p/r_hob"]), "stands for two things"
    ),
    "letter that is no expression": (lambda f: read(f)["letters"].__setitem__(0, ["p", "p q"]), "SyntaxError"),
    "prime is zero": (lambda f: f.proof(MERSENNE, 0, text=f"{MERSENNE} = 0"), "trees differ"),
    "enormous exponent": (
        lambda f: f.proof(["^", "x", 10**9], ["*", 1, ["^", "x", 10**9]], text=f"x**{10**9} = 1*x**{10**9}"), "exponent"
    ),
    "enormous integer": (lambda f: f.proof(10**4000, 0, text="1 = 0"), "integer|is not|digits"),
    "half unit of the forger": (lambda f: figure(f)[3].update(half_unit="1000"), "not the keys"),
    "value of another formula": (lambda f: figure(f)[3].update(value="12.5"), "recorded value"),
    "formula of another text": (
        lambda f: figure(f)[2].update(lhs=["+", figure(f)[2]["lhs"], 0]), "not that of the source"
    ),
    "no arcs as an object": (lambda f: f.certificate("recess-action/eq-16/as printed/1").update(arcs={}), "no list"),
    "rests on x is x": (
        lambda f: f.proof("x", "x", point={"symbols": {"x": "1"}, "half_tangents": {}},
                          text="x = x", lhs=["1"], rhs=["1"]), "same expression"
    ),
    "verdict on another source": (
        lambda f: f.verdict("recess-action/eq-16").update(source=f.source("recess-action/eq-12")["sha256"]),
        "another source"
    ),
    "reading left out": (lambda f: f.verdict("rack-and-pinion/ratio-sign")["readings"].pop(), "readings are not"),
    "emptied parts": (lambda f: f.verdict("recess-action/eq-16")["readings"][0].update(parts=[]), "missing or added"),
    "damage invented": (lambda f: f.verdict("recess-action/eq-12").update(damage="illegible"), "another damage"),
    "status without evidence": (lambda f: f.verdict("recess-action/eq-16").update(status="proved"), "does not follow"),
    "step under another operation": (
        lambda f: next(item for item in f.objects if item.get("op") == "diff").update(op="define"),
        "operation of its tree"
    ),
    "read from another part": (
        lambda f: read(f).update(part=["carried", ["sweep", "wheel", 0, 2], ["given", "P"]]), "not what the description"
    ),
    "read with a letter of a high power": (
        lambda f: read(f)["letters"].append(["r_worm", "r_worm**1000000000"]), "more than one digit"
    ),
    "read from the rule before the first": (lambda f: read(f).update(part=["rule", "lambda_worm", 0]), "no number 0"),
    "read from factors that are none": (
        lambda f: read(f).update(part=["carried", ["sweep", "pinion", 0, 0], ["given", "P"]]), "no such factors"
    ),
    "read from another drive": (lambda f: read(f).update(drive="cylindrical_worm_za_za"), "not the drives"),
    "typed and called read": (lambda f: f.step("rack-and-pinion.n").update(read=read(f)), "no vector that is read"),
    "key added": (lambda f: f.verdict("recess-action/eq-12").update(note="believe me"), "not the keys"),
    "key left out": (lambda f: f.equation("recess-action/eq-12/as printed/1").pop("side_conditions"), "not the keys"),
    "print left out": (lambda f: f.source("recess-action/eq-12").update(verbatim=""), "print is missing"),
}  # fmt: skip
CASES = {forge.__name__: (forge, reason) for forge, reason in FORGED} | IN_ONE_STEP


@pytest.mark.parametrize("case", quick(CASES, *[*CASES][::3]))
def test_forged_object_is_refused(forger, record, case):
    forge, reason = CASES[case]
    forge(forger)
    forger.sealed(everything=forge in (two_certificates, unused_object))
    with pytest.raises(Rejected, match=reason):
        check_record.verify(record)


def test_every_part_of_a_proof_that_fits_is_expanded_and_the_rest_meets_random_primes(forger, record, monkeypatch):
    """x + (2^61 - 1) y = x is refused at random points too: no prime is known beforehand."""
    monkeypatch.setattr(certificates, "EXPANSION", 0)
    multiple_of_a_prime(forger)
    forger.sealed()
    with pytest.raises(Rejected, match="trees differ"):
        check_record.verify(record)


# ---- files -----------------------------------------------------------------------------------------------------------


def altered(name, old, new):
    def edit(folder):
        path = folder / name
        text = path.read_text(encoding="utf-8")
        assert old in text
        path.write_bytes(text.replace(old, new, 1).encode())

    return edit


def emptied_list_of_files(folder):
    path = folder / "artifacts.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), "files": {}}, indent=1, sort_keys=True) + "\n")


def emptied_equations_of_a_header(folder):
    path = folder / "artifacts.json"
    sealed = json.loads(path.read_text())
    sealed["files"]["c/drive.h"]["equations"] = {}
    path.write_text(json.dumps(sealed, indent=1, sort_keys=True) + "\n")


def header_on_what_is_not_held(folder):
    altered("../c/drive.h", "rack-and-pinion/eq-1", "rack-and-pinion/eq-77")(folder)
    reseal(folder)


def header_on_what_is_false(folder):
    altered("../c/drive.h", "rack-and-pinion/eq-1", "rack-and-pinion/twice")(folder)
    reseal(folder)


def header_of_other_definitions(folder):
    """Made when the statement read something else: its key is that of then."""
    path = folder.parent / "c" / "drive.h"
    path.write_text(re.sub(r"(eq-1) [0-9a-f]{16}", rf"\1 {'0' * 16}", path.read_text()))
    seal(folder, json.loads((folder / "artifacts.json").read_text())["root"])


def function_on_what_is_not_listed(folder):
    path = folder.parent / "c" / "drive.h"
    comment = "/* Equations: rack-and-pinion/eq-4. */\nstatic inline void drive_eval(void)\n{\n}\n"
    path.write_text(path.read_text() + comment)
    reseal(folder)


def header_without_its_equations(folder):
    text = "/* A drive. */\nstatic inline int drive_setup(const double *p, double *s)\n{\n}\n"
    (folder.parent / "c" / "drive.h").write_text(text)
    reseal(folder)


def emptied_record(folder):
    for name in ("ledger.jsonl", "certificates.jsonl"):
        (folder / name).write_text("\n")
    (folder / "ledger.jsonl").write_text("")


def duplicate_key(folder):
    path = folder / "ledger.jsonl"
    text = path.read_text()
    path.write_text(text.replace('{"change":', '{"change":"","change":', 1))


def repeated_line(folder):
    path = folder / "ledger.jsonl"
    lines = path.read_text().splitlines(keepends=True)
    path.write_text("".join([lines[0], *lines]))


def edited_description(folder):
    """The wheel turns the other way in the mesh; the record is that of before."""
    path = folder.parent / "descriptions" / "cylindrical_worm_zn_zn.json"
    data = json.loads(path.read_text(encoding="utf-8"))
    turn = data["bodies"][1]["motion"][-1]
    turn[2] = ["*", -1, turn[2]]
    path.write_text(json.dumps(data), encoding="utf-8")
    reseal(folder)


def no_description(folder):
    (folder.parent / "descriptions" / "cylindrical_worm_zn_zn.json").unlink()
    reseal(folder)


FILES = [
    (edited_description, "not what the description of cylindrical_worm_zn_zn says"),
    (no_description, "there is no description"),
    (altered("index.html", "proved", "false"), "index.html has been changed"),
    (altered("audit.tex", "proved", "false"), "audit.tex has been changed"),
    (altered("checker/refusal.py", "Rejected", "Accepted"), "checker/refusal.py has been changed"),
    (emptied_list_of_files, "not sealed"),
    (emptied_equations_of_a_header, "other equations than its seal"),
    (lambda folder: (folder.parent / "c" / "other.h").write_text("double y;\n"), "other.h is not sealed"),
    (lambda folder: (folder / "audit.tex").unlink(), "audit.tex is missing"),
    (header_on_what_is_not_held, "not a proved statement"),
    (header_on_what_is_false, "not a proved statement"),
    (header_of_other_definitions, "rests on another rack-and-pinion/eq-1"),
    (function_on_what_is_not_listed, "which the header does not list"),
    (header_without_its_equations, "names no equation"),
    (lambda folder: (folder.parent / "manifest.json").write_text('{"files": {}}\n'), "manifest"),
    (emptied_record, "does not end|cannot be read|Expecting"),
    (duplicate_key, "key stands twice"),
    (repeated_line, "repeated"),
    (altered("ledger.jsonl", '{"', '{ "'), "not canonical"),
    (altered("ledger.jsonl", '"object":"source"', '"object": "source"'), "not canonical"),
    (altered("ledger.jsonl", "\n", "\r\n"), "end its lines"),
    (altered("ledger.jsonl", "\n", "\n\n"), "line 2"),
    (altered("certificates.jsonl", '"degree":0', '"degree":0.0'), "not a number of the record"),
    (altered("artifacts.json", '"root"', ' "root"'), "not canonical"),
]


@pytest.mark.parametrize(
    ("edit", "reason"), quick(FILES, *FILES[::3]), ids=[f"{k} {reason}" for k, (_, reason) in enumerate(FILES)]
)
def test_forged_file_is_refused(record, edit, reason):
    edit(record)
    with pytest.raises(Rejected, match=reason):
        check_record.verify(record)
