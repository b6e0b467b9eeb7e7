"""A change of one function in one generated file is refused by the checkers that read it, hashes left out."""

import os
from collections import Counter

import pytest

from derive.audit import mutations
from derive.audit.mutations import EQUAL, REFUSED, SURVIVED

ALL = ("spherical_convex_spur", "cylindrical_worm_zn_zn", "face_worm", "cylindrical_gears", "bevel_formate")
#: Every function of every drive once with SIZE=full, in about ten minutes of a processor.
FULL = os.environ.get("SIZE") == "full"


@pytest.mark.validate
@pytest.mark.parametrize("drive", ALL)
def test_a_changed_file_is_refused(drive, capsys):
    outcomes = list(mutations.measure([drive], 1, sample=None if FULL else 24))
    counted = Counter(outcome.by for outcome in outcomes)
    with capsys.disabled():
        print(f"\n{drive}", dict(counted), *(" ".join(o.mutant.key) for o in outcomes if o.by == SURVIVED), sep="\n  ")
    assert len(outcomes) >= 20
    assert counted[REFUSED] >= 0.97 * (counted[REFUSED] + counted[SURVIVED])


@pytest.mark.validate
def test_a_change_of_each_stage_is_made_and_refused():
    """One of each kind of file of the smallest drive."""
    drive, rng = mutations.Measured(ALL[0]), mutations.random.Random(1)
    first = {}
    for mutant in drive.mutants(1, rng):
        if "derive" not in mutant.function:
            first.setdefault(mutant.stage, mutant)
    assert set(first) == set(mutations.STAGES)
    outcomes = {stage: drive.judged(mutant).by for stage, mutant in first.items() if stage != "description"}
    assert set(outcomes.values()) == {REFUSED}


def test_an_exchange_that_changes_no_value_is_told_apart():
    """a + b as b + a is another program and the same function."""
    old = {"t0": ("expression", "p[1] * p[2]"), "o[0]": ("expression", "t0 + p[3]")}
    new = {"t0": ("expression", "p[2] * p[1]"), "o[0]": ("expression", "p[3] + t0")}
    wrong = {"t0": ("expression", "p[2] * p[1]"), "o[0]": ("expression", "p[3] - t0")}
    header = mutations.Measured(ALL[0]).checks.header
    assert mutations.same_programs([(old, new)], header)
    assert not mutations.same_programs([(old, wrong)], header)


def test_the_measured_table_adds_up():
    kept = mutations.measured()
    assert {row["stage"] for row in kept["rows"]} >= set(mutations.STAGES) - {"description"}
    assert kept[SURVIVED] == len(kept["survivors"])
    assert kept[REFUSED] >= 0.97 * (kept[REFUSED] + kept[SURVIVED])
    assert kept[EQUAL] >= 0
