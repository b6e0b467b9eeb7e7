"""A derived equation tolerates no change: every sign or term mutation is refuted."""

from dataclasses import replace

import pytest

from derive.audit.documents import rack_and_pinion, recess_action
from derive.audit.identities import (
    bevel,
    conventions,
    cylindrical_gears,
    cylindrical_worm,
    derivation,
    face_worm,
    helicoids,
    spherical,
)
from derive.prove import Outcome, decide
from derive.prove.edits import mutations
from tests.quick import quick

#: What a change that makes a scalar of a vector, or divides by zero, ends in: no equation any more.
MALFORMED = (ValueError, TypeError, ZeroDivisionError, IndexError)
CHAPTERS = (
    recess_action, conventions, helicoids, cylindrical_worm, face_worm, bevel, derivation, rack_and_pinion,
    spherical, cylindrical_gears,
)  # fmt: skip
QUICK = CHAPTERS[:4]


def derived_equations(chapters):
    """Every proved single-reading equation whose right side has something to change."""
    for chapter in chapters:
        for claim in chapter.CLAIMS:
            readings = claim.read() if hasattr(claim, "read") else {}
            if len(readings) == 1 and claim.scope is not None:
                for number, text in enumerate(next(iter(readings.values())), 1):
                    statement = claim.scope.statement(f"{chapter.DOCUMENT.key}/{claim.key}/{number}", text)
                    if decide(statement).outcome is Outcome.PROVED:
                        yield statement


@pytest.mark.parametrize(("chapters", "least"), quick([(QUICK, 600), (CHAPTERS, 1600)], (QUICK, 600)))
def test_every_mutation_is_refuted(capsys, chapters, least):
    outcomes, survivors = [], []
    for statement in derived_equations(chapters):
        for mutant in mutations(statement):
            try:
                outcome = decide(mutant).outcome
            except MALFORMED:
                continue
            outcomes.append(outcome)
            if outcome is not Outcome.REFUTED and not _says_the_same(mutant, statement):
                survivors.append(mutant.id)
    refuted = outcomes.count(Outcome.REFUTED)
    with capsys.disabled():
        print(f"\n{refuted} of {len(outcomes)} mutations refuted, {len(survivors)} survive, the rest change no value")
    assert refuted >= least
    assert not survivors


def _says_the_same(mutant, statement):
    """A change that leaves the value of the right side as it is (the sign of a zero, of a factor in a square) is no
    mutation.
    """
    return decide(replace(statement, lhs=mutant.rhs, rhs=statement.rhs)).outcome is Outcome.PROVED
