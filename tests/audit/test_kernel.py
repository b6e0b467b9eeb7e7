"""Every proof of the record is a theorem that Coq's kernel accepts; a certificate with a changed coefficient is not."""

import json
import re
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from derive.audit import kernel, record
from derive.audit.checker.trees import evaluate
from derive.audit.kernel import derivatives, translate
from derive.drives import cylindrical_worm

needs_coq = pytest.mark.skipif(not kernel.available(), reason=kernel.MISSING)


def test_a_theorem_reads_as_the_equation_it_proves(objects):
    """d(R)/dl of the worm of Eq (1): denominators and circles stand before the equation, both sides after."""
    stated = [theorem for found in translate.theorems(objects).values() for theorem in found]
    assert len({theorem.name for theorem in stated}) == len(stated) >= 20
    helicoid = next(theorem for theorem in stated if "helicoid" in theorem.name)
    assert re.search(r"Theorem \w+ : forall \([\w ]+ : R\)", helicoid.text)
    assert all("Admitted" not in theorem.text and "Axiom" not in theorem.text for theorem in stated)


@pytest.mark.validate
@needs_coq
def test_proofs_are_accepted_and_a_changed_coefficient_is_not(objects, tmp_path):
    chosen = [item for item in objects.values() if item.get("kind") == "ring_nf" and item["relations"]][:2]
    kept = {key: item for key, item in objects.items() if item["object"] != "certificate"}
    kept |= {item["sha256"]: item for item in chosen}
    shutil.copy(Path(kernel.__file__).with_name("Certificate.v"), tmp_path)
    kernel.compile_file(tmp_path / "Certificate.v")
    _, axioms = kernel.compile_file(written(kept, tmp_path / "Right.v"))
    assert axioms <= kernel.AXIOMS
    wrong = {**kept, chosen[0]["sha256"]: with_changed_coefficient(chosen[0])}
    with pytest.raises(kernel.Refused, match="proves"):
        kernel.compile_file(written(wrong, tmp_path / "Wrong.v"))


@pytest.mark.validate
@needs_coq
def test_what_the_kernel_reduces_itself_needs_no_cofactors(objects, tmp_path, monkeypatch):
    """And a side that is doubled is refused."""
    monkeypatch.setattr(translate, "LONGEST", 0)
    shutil.copy(Path(kernel.__file__).with_name("Certificate.v"), tmp_path)
    kernel.compile_file(tmp_path / "Certificate.v")
    chosen = [item for item in objects.values() if item.get("kind") == "ring_nf" and item["relations"]][:2]
    kept = {key: item for key, item in objects.items() if item["object"] != "certificate"}
    kept |= {item["sha256"]: item for item in chosen}
    path = written(kept, tmp_path / "Right.v")
    assert "by_reduction" in path.read_text(encoding="utf-8")
    _, axioms = kernel.compile_file(path)
    assert axioms <= kernel.AXIOMS
    equation = kept[chosen[0]["equation"]]
    doubled = {**kept, chosen[0]["equation"]: {**equation, "lhs": ["*", 2, equation["lhs"]]}}
    with pytest.raises(kernel.Refused):
        kernel.compile_file(written(doubled, tmp_path / "Wrong.v"))


def written(objects, path):
    theorems = next(iter(translate.theorems(objects).values()))
    path.write_text(translate.file_text("case", theorems), encoding="utf-8")
    return path


def with_changed_coefficient(certificate):
    """The first coefficient of a cofactor one more."""
    wrong = json.loads(json.dumps(certificate))
    component = next(part for part in wrong["components"] if any(part["cofactors"]))
    k = next(k for k, text in enumerate(component["cofactors"]) if text)
    factor, star, rest = component["cofactors"][k].partition("*")
    component["cofactors"][k] = f"{int(factor) + 1}{star}{rest}"
    return wrong


def test_a_wrong_equation_of_meshing_is_no_identity_of_the_description(monkeypatch):
    """The hob rolled the wrong way in the condition alone: the exporter finds a remainder and writes no theorem."""
    honest = derivatives.envelope

    def turned(surface, motion, variable):
        wheel = honest(surface, motion, variable)
        other = honest(surface, cylindrical_worm.cutting(-variable), variable)
        return replace(wheel, conditions=(other.conditions[-1],))

    monkeypatch.setattr(derivatives, "envelope", turned)
    with pytest.raises(ValueError, match="meshing is not an identity"):
        derivatives.file_text()


@pytest.mark.validate
@needs_coq
def test_the_whole_record_and_the_chain_of_the_zn_wheel_are_accepted(tmp_path, capsys):
    objects = {key: json.loads(json.dumps(item)) for key, item in record.ledger().objects.items()}
    report = kernel.check_record(objects, tmp_path)
    assert sum(report.seconds.values()) < 300
    proofs = [item for item in objects.values() if item.get("kind") == "ring_nf"]
    stated = [theorem for found in translate.theorems(objects).values() for theorem in found]
    assert len(stated) == sum(len(item["components"]) + len(item["roots"]) for item in proofs)
    accepted = sum(count for name, count in report.theorems.items() if name != derivatives.CHAIN)
    assert accepted == len(stated)
    for name, axioms in report.axioms.items():
        assert axioms <= kernel.AXIOMS | ({kernel.CLASSICAL} if name == derivatives.CHAIN else set())
    if not report.real_derivatives:
        pytest.skip("Coquelicot not found: the chain with real derivatives was not checked")


def test_translated_names_are_names_of_coq():
    empty = dict.fromkeys(("definitions", "roots", "arcs", "jets"), {})
    scope = {**empty, "angles": {"I": "I"}, "signs": [], "generators": []}
    value = evaluate(["+", "R", ["cos", "I"], "as"], translate.Written(scope))
    variables = {}
    translate.collect(value.node, variables)
    assert set(translate._readable(variables).values()) == {"R_", "cos_I", "as_"}
