"""A change of one function in one generated file is refused by the checkers that read it, hashes left out."""

import random
from collections import Counter
from types import SimpleNamespace

import pytest

from derive.audit.checker.tables import OPERATIONS
from derive.audit.mutations.equality import same_programs, same_reals
from derive.audit.mutations.measure import Measured, measure
from derive.audit.mutations.stages import EQUAL, REFUSED, STAGES, SURVIVED
from derive.audit.mutations.table import measured
from tests.quick import full

ALL = ("spherical_convex_spur", "cylindrical_worm_zn_zn", "face_worm", "cylindrical_gears", "bevel_formate")


@pytest.mark.validate
@pytest.mark.parametrize("drive", ALL)
def test_a_changed_file_is_refused(drive, capsys):
    """Of all functions once with SIZE=full, in about ten minutes of a processor."""
    outcomes = list(measure([drive], 1, sample=None if full() else 12))
    counted = Counter(outcome.by for outcome in outcomes)
    with capsys.disabled():
        print(f"\n{drive}", dict(counted), *(" ".join(o.mutant.key) for o in outcomes if o.by == SURVIVED), sep="\n  ")
    assert len(outcomes) >= 12
    assert counted[REFUSED] >= 0.97 * (counted[REFUSED] + counted[SURVIVED])


@pytest.mark.validate
def test_a_change_of_each_stage_is_made_and_refused():
    """Some of each kind of file of the smallest drive; those that change no value tell nothing."""
    drive, rng = Measured(ALL[0]), random.Random(1)
    first = {stage: [] for stage in STAGES}
    for mutant in drive.mutants(1, rng):
        if "derive" not in mutant.function and len(first[mutant.stage]) < 3:
            first[mutant.stage].append(mutant)
    for stage, mutants in first.items():
        outcomes = [drive.judged(mutant).by for mutant in mutants if stage != "description"]
        assert mutants and set(outcomes) <= {REFUSED, EQUAL} and (REFUSED in outcomes or not outcomes), stage


def test_an_exchange_that_changes_no_value_is_told_apart():
    """a + b as b + a is another program and the same function."""
    old = {"t0": ("expression", "p[1] * p[2]"), "o[0]": ("expression", "t0 + p[3]")}
    new = {"t0": ("expression", "p[2] * p[1]"), "o[0]": ("expression", "p[3] + t0")}
    wrong = {"t0": ("expression", "p[2] * p[1]"), "o[0]": ("expression", "p[3] - t0")}
    header = Measured(ALL[0]).checks.header
    assert same_programs([(old, new)], header)
    assert not same_programs([(old, wrong)], header)


def test_a_scale_that_leaves_a_unit_vector_is_told_apart():
    """x/sqrt(x²) is 3x/sqrt((3x)²) of real numbers, whatever stands for the root modulo a prime; 3x/sqrt(9x) is not."""
    words = ("{a} * {b}", "{a} * {a}", "sqrt({a})", "{a} / {b}")
    multiply, square, root, divide = map(OPERATIONS.index, words)
    end = [(root, 3, 3, 0), (divide, 4, 2, 3)]
    kept, scaled, wrong = (
        SimpleNamespace(inputs=[0], constants=["(3.0)"], instructions=[*start, *end], outputs=[4])
        for start in (
            [(multiply, 2, 0, 0), (divide, 2, 2, 0), (square, 3, 2, 0)],
            [(multiply, 2, 0, 1), (square, 3, 2, 0)],
            [(multiply, 2, 0, 1), (multiply, 3, 2, 1)],
        )
    )
    assert same_reals(kept, scaled)
    assert not same_reals(kept, wrong)


def test_the_measured_table_adds_up():
    kept = measured()
    assert {row["stage"] for row in kept["rows"]} >= set(STAGES) - {"description"}
    assert kept[SURVIVED] == len(kept["survivors"])
    assert kept[REFUSED] >= 0.97 * (kept[REFUSED] + kept[SURVIVED])
    assert kept[EQUAL] >= 0
    edits = kept["edits"]
    assert edits["survivor"] == len(edits["survivors"])
    assert edits["refused"] >= 0.97 * (edits["refused"] + edits["survivor"])
