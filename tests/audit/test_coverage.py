"""Every statement that the four texts display has an entry in the record, or a reason why it has none."""

import json
import os
from pathlib import Path

import pytest

from derive.audit import coverage, displayed, record

SOURCES = os.environ.get("MESHWRIGHT_SOURCES")


@pytest.fixture(scope="module")
def claims():
    return {chapter.document.key: chapter.claims for chapter in record.chapters() if chapter.document.sha256}


def test_nothing_displayed_is_left_open(claims):
    found = coverage.rows(claims)
    assert not [row for row in found if row.is_gap]
    assert coverage.unknown(claims) == []
    equations = {row.document: 0 for row in found}
    for row in found:
        equations[row.document] += row.kind == "equation"
        assert row.kind != "equation" or row.entries, f"{row.document} {row.label} has no entry"
    assert equations == {"recess-action": 38, "rack-and-pinion": 21, "zk-zn": 14, "spherical": 25, "face-worm": 14}


def test_a_range_of_numbers_covers_those_within():
    assert coverage.mentions("(2.19)–(2.22)", "(2.20)")
    assert coverage.mentions("Eqs (19), (20)", "(20)")
    assert not coverage.mentions("(2.19)–(2.22)", "(2.23)")


def test_statements_of_a_text_are_found():
    text = "As follows:\n\na = b + c (1)\n\nwhere b is small.\n\nThus a is small. It holds.\n\nTable 1 Sizes\nA 2 mm\n"
    found = [(s.kind, s.label) for s in displayed.statements("any", text + displayed.END)]
    assert found == [("equation", "(1)"), ("where", "where 1"), ("table", "Table 1, row 1"), ("claim", "claim 1")]


def test_a_changed_quotation_is_a_transliteration(claims):
    literal = {claim.key: claim for claim in claims["rack-and-pinion"]}["lemma"]
    assert coverage.offset("rack-and-pinion/lemma", literal.verbatim) is not None
    assert coverage.offset("rack-and-pinion/lemma", literal.verbatim + " ") is None
    assert coverage.offset("rack-and-pinion/eq-1", "f = 0") is None


@pytest.mark.skipif(not SOURCES, reason="MESHWRIGHT_SOURCES does not name the folder of the four texts")
def test_the_list_of_statements_is_that_of_the_texts():
    assert json.loads(json.dumps(displayed.measured(Path(SOURCES)))) == json.loads(
        coverage.DISPLAYED.read_text(encoding="utf-8")
    )
