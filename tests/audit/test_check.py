"""The checker accepts the record as written and nothing else. It runs alone, with the standard library."""

import ast
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest

from derive.audit import checker
from derive.audit.checker import certificates, check_record
from derive.audit.checker.enclosure import number_of
from derive.audit.checker.notation import read_formula
from derive.audit.checker.record import definitions_of
from derive.audit.checker.refusal import Rejected
from derive.audit.checker.verdicts import check_certificate


def run(folder):
    """The shipped copy, isolated from every installed package."""
    return subprocess.run([sys.executable, "-I", "-S", folder / "check.py"], capture_output=True, text=True, cwd="/")


def change(path, old, new):
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))


def test_shipped_checker_accepts_the_record_without_any_package(record, small_ledger):
    result = run(record)
    assert result.returncode == 0, result.stderr
    assert small_ledger.root in result.stdout


def test_checkers_import_only_the_standard_library():
    """And each other; CasADi, where it is there, to read its own files."""
    modules = set()
    for path in Path(checker.__file__).parent.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                modules |= {name.name.split(".")[0] for name in node.names}
            elif isinstance(node, ast.ImportFrom) and not node.level:
                modules.add(node.module.split(".")[0])
    assert modules - sys.stdlib_module_names == {"casadi"}


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("certificates.jsonl", '"kind":"ring_nf"', '"kind":"ring_nF"'),
        ("ledger.jsonl", '"omega1"', '"omega2"'),
        ("ledger.jsonl", '"status":"proved_with_correction"', '"status":"proved"'),
        ("artifacts.json", '"root": "', '"root": "0'),
        ("../c/drive.h", "a - b", "a + b"),
    ],
    ids=["certificate", "equation", "verdict", "root", "generated C file"],
)
def test_one_changed_token_is_caught(record, name, old, new):
    change(record / name, old, new)
    result = run(record)
    assert result.returncode == 1
    assert "REJECTED" in result.stderr


def test_a_missing_line_is_caught(record):
    path = record / "certificates.jsonl"
    path.write_text("".join(path.read_text().splitlines(keepends=True)[1:]))
    assert run(record).returncode == 1


def test_no_record_is_reported_as_such(tmp_path):
    assert check_record.main([str(tmp_path)]) == 1


# A forger who recomputes the hash of the certificate: the mathematics itself has to catch him.


@pytest.fixture
def proof(objects):
    """A certificate of one component that needs a relation, its equation and definitions."""
    certificate = next(
        item
        for item in objects.values()
        if item["object"] == "certificate"
        and item["kind"] == "ring_nf"
        and [bool(component["numerator"]) for component in item["components"]] == [True]
    )
    equation = objects[certificate["equation"]]
    return certificate, equation, definitions_of(equation, objects)


def bare(angles=(), roots=(), symbols=None, tangents=None, sides=("0", "0")):
    """A certificate of one component with an empty numerator: the trees alone must agree."""
    return {
        "kind": "ring_nf",
        "angles": [{"symbol": name, "divisor": 1} for name in angles],
        "roots": list(roots),
        "arcs": [],
        "generators": [],
        "relations": [],
        "components": [{"numerator": "", "denominators": [], "cofactors": []}],
        "degree": 0,
        "point": {"symbols": symbols or {}, "half_tangents": tangents or {}},
        "lhs": [sides[0]],
        "rhs": [sides[1]],
    }


def equation_of(lhs, rhs, signs=(), jets=None):
    return {"lhs": lhs, "rhs": rhs, "signs": list(signs), "jets": jets or {}}


def rejected(proof, match):
    with pytest.raises(Rejected, match=match):
        certificates.check_proof(*proof)


def emptied(component):
    """No numerator and no cofactors: an equation that needs relations, proved without them."""
    component |= {"numerator": "", "cofactors": ["" for _ in component["cofactors"]]}


#: What is changed in a certificate and its equation.
CHANGES = {
    "cofactor": (lambda c, _: c["components"][0]["cofactors"].append("1"), "do not match"),
    "empty numerator": (lambda c, _: emptied(c["components"][0]), "trees differ"),
    "no components": (lambda c, _: c["components"].clear(), "no component"),
    "expression": (lambda _, e: e.update(rhs=["+", e["rhs"], 1]), "trees differ"),
    "circle": (lambda c, _: c["relations"][0].update(square="2"), "not the circle"),
    "kind of relation": (lambda c, _: c["relations"][0].update(kind="wish"), "invented"),
    "two names for one angle": (lambda c, _: c["angles"].append({**c["angles"][0], "divisor": 2}), "two names"),
    "zero denominator": (lambda c, _: c["components"][0]["denominators"].append(["", 1]), "denominator is zero"),
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_changed_proof_is_rejected(proof, change):
    change, match = CHANGES[change]
    change(*proof[:2])
    rejected(proof, match)


def test_altered_numerator_with_matching_cofactors(proof):
    """Numerator and cofactors doubled: the integers agree, the trees do not."""
    component = proof[0]["components"][0]

    def double(text):
        terms = [term.partition("*") for term in text.split("+")] if text else []
        return "+".join(f"{2 * int(factor)}{star}{powers}" for factor, star, powers in terms)

    component["numerator"] = double(component["numerator"])
    component["cofactors"] = [double(text) for text in component["cofactors"]]
    rejected(proof, "trees differ")


def test_invented_relation(proof):
    certificate = proof[0]
    certificate["relations"].append({"kind": "circle", "generator": certificate["generators"][0], "square": "1"})
    for component in certificate["components"]:
        component["cofactors"].append("1")
    rejected(proof, "not the sine|invented or repeated")


def test_vacuous_statement_is_rejected():
    """1/(cos^2 + sin^2 - 1) never exists on the circle."""
    zero = ["+", ["^", ["cos", "a"], 2], ["^", ["sin", "a"], 2], -1]
    same = ["/", "x", zero]
    with pytest.raises(Rejected, match="denominator vanishes"):
        certificates.check_proof(bare(["a"], symbols={"x": "1"}, tangents={"a": "1/3"}), equation_of(same, same), {})


def test_a_root_without_a_real_point_proves_nothing():
    """sqrt(-1 - x^2) exists modulo a prime and nowhere else."""
    radicand = ["+", -1, ["-", ["^", "x", 2]]]
    root = {"radicand": radicand, "generator": "sqrt0", "divisor": "1"}
    certificate = bare(roots=[root], symbols={"x": "1"})
    with pytest.raises(Rejected, match="root of a negative number"):
        certificates.check_proof(
            certificate, equation_of(["*", 2, ["sqrt", radicand]], ["*", ["sqrt", radicand], 2]), {}
        )


def test_refutation_needs_sides_that_differ(objects):
    certificate = next(
        item for item in objects.values() if item["object"] == "certificate" and item["kind"] == "exact_point"
    )
    equation = objects[certificate["equation"]]
    equation["rhs"], certificate["rhs"] = equation["lhs"], certificate["lhs"]
    with pytest.raises(Rejected, match="agree"):
        certificates.check_refutation(certificate, equation, definitions_of(equation, objects))


def test_wrong_derivative_is_caught_by_dual_numbers():
    """d(sin)/da = -cos passed off as true."""
    certificate = bare(["a"], tangents={"a": "1/3"}, sides=("0.8", "0.8"))
    wrong = equation_of(["d", ["sin", "a"], ["a", 1]], ["-", ["cos", "a"]])
    with pytest.raises(Rejected, match="trees differ"):
        certificates.check_proof(certificate, wrong, {})
    certificates.check_proof(certificate, {**wrong, "rhs": ["cos", "a"]}, {})


@pytest.mark.parametrize("budget", [certificates.EXPANSION, 0], ids=["expanded", "at random points"])
def test_second_derivatives_of_jets_and_roots(monkeypatch, budget):
    """xi(u)^2 twice, and sqrt(u^2 + 1) once, by nested dual numbers."""
    monkeypatch.setattr(certificates, "EXPANSION", budget)

    def xi(order):
        return ["jet", "xi", order]

    twice = equation_of(
        ["d", ["d", ["^", xi(0), 2], ["u", 1]], ["u", 1]],
        ["+", ["*", 2, ["^", xi(1), 2]], ["*", 2, xi(0), xi(2)]],
        jets={"xi": ["u"]},
    )
    point = {"u": "1", "xi[0]": "2", "xi[1]": "3", "xi[2]": "5"}
    decided = certificates.check_proof(bare(symbols=point, sides=("38", "38")), twice, {})
    assert decided["expanded"] == bool(budget)
    squared = ["+", ["^", "u", 2], 1]
    root = ["sqrt", squared]
    named = {"radicand": squared, "generator": "sqrt0", "divisor": "1"}
    certificate = bare(roots=[named], symbols={"u": "3/4"}, sides=("0.6", "0.6"))
    certificates.check_proof(certificate, equation_of(["d", root, ["u", 1]], ["/", "u", root]), {})


def test_the_two_arithmetics_of_the_checker_agree(monkeypatch, objects):
    """What is expanded in exact integers holds at random points as well."""
    monkeypatch.setattr(certificates, "EXPANSION", 0)
    proofs = [item for item in objects.values() if item.get("kind") == "ring_nf"]
    assert len(proofs) >= 15
    for certificate in proofs:
        assert check_certificate(certificate, objects)["expanded"] == 0


@pytest.mark.parametrize(
    ("formula", "value"),
    [
        ("sin(1)", "0.8414709848078965066525023216302989996225630607983711"),
        ("tan(radians(20))", "0.3639702342662023613510478827768340438904717837537381"),
        ("asin(0.3) + acos(0.3)", "1.570796326794896619231321691639751442098584699687553"),
        ("degrees(atan(0.05))", "2.862405226111747532693344728483833352331412905512701"),
        ("sqrt(2)**3/pi", "0.9003163161571060695551991910067405826645741499552206"),
    ],
)
def test_enclosures_hold_the_value_to_forty_digits(formula, value):
    """Values from mpmath at 50 digits."""
    ball = number_of(read_formula(formula))
    assert abs(ball.middle - Fraction(value)) <= ball.radius + Fraction(1, 10**50)
    assert ball.radius < Fraction(1, 10**40)
