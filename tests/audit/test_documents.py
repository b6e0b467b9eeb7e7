"""What the proofs say of the four documents.

Verdicts come from the prover; here they are compared with what is known of the prints.
"""

import json
from pathlib import Path

import pytest

from derive.audit import record
from derive.audit.ledger import build
from derive.prove import Outcome

#: The four documents that print what they derive.
DOCUMENTS = ("recess-action", "rack-and-pinion", "zk-zn", "spherical")


@pytest.fixture(scope="module")
def verdicts():
    built = build(record.chapters(DOCUMENTS))
    return {verdict.id: verdict for found in built.verdicts.values() for verdict in found}


@pytest.mark.validate
def test_the_committed_record_is_what_the_prover_says_now():
    committed = Path(__file__).resolve().parents[2] / "generated" / "audit" / "artifacts.json"
    assert json.loads(committed.read_text(encoding="utf-8"))["root"] == record.ledger().root


@pytest.mark.validate
def test_every_identity_about_our_own_derivations_is_proved():
    verdicts = [verdict for found in record.ledger().verdicts.values() for verdict in found]
    own = [verdict for verdict in verdicts if verdict.claim.kind == "identity"]
    assert len(own) >= 40
    assert {verdict.status for verdict in own} == {"proved"}
    assert not [verdict.id for verdict in verdicts if verdict.status == "undecided"]


def test_chapters_of_our_own_name_the_source_that_they_are_about():
    root = Path(__file__).resolve().parents[2]
    own = [chapter.document for chapter in record.chapters() if not chapter.document.sha256]
    assert len(own) >= 8
    assert [document.file for document in own if not (root / document.file).exists()] == []


MISPRINTS = {
    "recess-action/eq-7": "sign of a term",
    "recess-action/eq-13": "omega2 for omega1",
    "recess-action/eq-16": "cos for sin",
    "recess-action/eq-22": "phi2p for phi3p",
    "recess-action/eq-29": "phi2p for phi3p throughout; dgh for dgv",
    "recess-action/errors": "dgv for dgh",
    "recess-action/eq-36": "",
    "recess-action/throat": "",
    "recess-action/thickness": "",
    "recess-action/table-2-heading": "",
    "recess-action/table-2-wheel-angle": "",
    "rack-and-pinion/eq-4": "sign of the whole",
    "rack-and-pinion/worm-axis": "",
    "zk-zn/eq-5-row-2": "a22 for a11",
    "spherical/node-wheel": "",
}


@pytest.mark.parametrize("key", MISPRINTS)
def test_misprint_is_refuted_and_its_correction_proved(verdicts, key):
    verdict = verdicts[key]
    assert verdict.status == "proved_with_correction"
    assert verdict.readings[0].outcome is Outcome.REFUTED
    assert verdict.corrected.outcome is Outcome.PROVED
    assert MISPRINTS[key] in verdict.change


@pytest.mark.parametrize(
    "key",
    [
        *(f"eq-{n}" for n in (2, 8, 9, 10, 11, 12, 14, 15, 21, 23, 24, 25, 28, 31, 35, 37, 38)),
        "acr",
        "table-1",
        "count",
    ],
)
def test_the_recess_action_paper_is_right_here(verdicts, key):
    assert verdicts[f"recess-action/{key}"].status == "proved"


@pytest.mark.parametrize(
    "key",
    ["recess-action/eq-1", "recess-action/eq-5", "recess-action/eq-6", "spherical/eq-2.5", "zk-zn/eq-1", "zk-zn/eq-4"],
)
def test_lost_signs_leave_exactly_one_reading_that_holds(verdicts, key):
    outcomes = [reading.outcome for reading in verdicts[key].readings]
    assert verdicts[key].status == "ambiguous"
    assert outcomes.count(Outcome.PROVED) == 1 and outcomes.count(Outcome.REFUTED) == len(outcomes) - 1
    assert verdicts[key].claim.damage


RIGHT = (
    "helicoid", "rack-form", "eq-1", "eq-2", "eq-3", "eq-5", "psi", "normal-meets-axis", "elimination", "lemma",
    "planar-limit", "decomposition", "axis-2", "wheel-profile",
)  # fmt: skip


@pytest.mark.parametrize("key", RIGHT)
def test_the_rack_and_pinion_paper_is_right_here_for_every_profile(verdicts, key):
    assert verdicts[f"rack-and-pinion/{key}"].status == "proved"


@pytest.mark.parametrize("key", ["twice", "existence", "uniqueness"])
def test_the_rack_and_pinion_paper_claims_too_much(verdicts, key):
    assert verdicts[f"rack-and-pinion/{key}"].status == "false"


def test_four_entries_of_table_2_are_misprinted(verdicts):
    wrong = [
        part.figure.formula
        for part in verdicts["recess-action/table-2-wheel-angle"].readings[0].parts
        if part.outcome is Outcome.REFUTED
    ]
    assert [formula.partition("/")[0] for formula in wrong] == ["800", "1200", "1600", "800"]
    corrected = [part.figure.printed for part in verdicts["recess-action/table-2-wheel-angle"].corrected.parts]
    assert {"2.8881", "4.3323", "5.7764"} <= set(corrected)


def test_nothing_is_undecided(verdicts):
    assert not [key for key, verdict in verdicts.items() if verdict.status == "undecided"]
