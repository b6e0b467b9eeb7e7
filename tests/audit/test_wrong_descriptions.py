"""Wrong physics in a description is noticed by its own C: a sign, factor, exponent, axis or function changed at a time.

The C stays as it was generated. What changes no value (the sign of a zero) is a survivor, printed with its place.
"""

import json
import random
from pathlib import Path

import pytest

from derive.audit.checker import attempts, check_description
from derive.audit.checker.design import check_unit
from derive.audit.checker.draws import on_both_flanks
from derive.audit.checker.drive import Drive
from derive.audit.checker.refusal import Rejected
from derive.audit.mutations import of_descriptions
from tests.quick import full, quick

GENERATED = Path(__file__).resolve().parents[2] / "generated"
SPUR = "spherical_convex_spur"
SEED = 21
SECTIONS = [section for section in of_descriptions.SECTIONS if section != "design_systems"]


def wrong_descriptions(description, count):
    """Section by section in turn: words, and a description with one change."""
    rng = random.Random(SEED)
    found = {section: list(of_descriptions.places(description[section])) for section in SECTIONS}
    queues = {section: rng.sample(paths, len(paths)) for section, paths in found.items() if paths}
    made = 0
    while made < count and any(queues.values()):
        for section, queue in queues.items():
            if queue and made < count:
                made += 1
                yield of_descriptions.changed_at(description, (section, *queue.pop()), rng)


def is_refused(description, header, tangents):
    drive = Drive(description, header, tangents)
    try:
        for number in range(len(description["keys"])):
            check_unit(drive, number)
        for _, check in check_description.checks_of(drive):
            on_both_flanks(*check)
    except Rejected:
        return True
    return False


@pytest.mark.parametrize(("count", "least"), quick([(200 if full() else 60, 0.95), (5, 0.9)], (5, 0.9)))
def test_a_wrong_description_is_refused(count, least, capsys, monkeypatch):
    monkeypatch.setattr(attempts, "ATTEMPTS", 2000)
    monkeypatch.setattr(attempts, "REFUSALS", 8)
    description = json.loads((GENERATED / "descriptions" / f"{SPUR}.json").read_text(encoding="utf-8"))
    header, tangents = (
        (GENERATED / "c" / f"{SPUR}{end}.h").read_text(encoding="utf-8") for end in ("", "_sensitivity")
    )
    made, survivors = 0, []
    for words, wrong in wrong_descriptions(description, count):
        made += 1
        if not is_refused(wrong, header, tangents):
            survivors.append(words)
    with capsys.disabled():
        print(f"\n{made - len(survivors)} of {made} wrong descriptions refused", *survivors, sep="\n  ")
    assert made == count
    assert made - len(survivors) >= least * made
