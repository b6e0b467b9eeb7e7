"""What fuzzing showed, and a little of it in every run of the tests: the rest is ``make fuzz``."""

import random

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from meshwright import DesignError, Drive
from meshwright.design import design
from tests.audit import forger
from tests.fuzz import designs, interface, mutate, pages, records

SMALL = settings(max_examples=60, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))

#: Any number that TOML can hold, a word, or what no key takes.
VALUES = st.one_of(
    st.floats(), st.floats(-100.0, 100.0), st.integers(), st.sampled_from(mutate.EXTREMES), st.text(max_size=20),
    st.booleans(), st.lists(st.integers(), max_size=2),
)  # fmt: skip


@st.composite
def changed(draw):
    """Tables of a packaged design with one to four keys of any table set to anything."""
    tables = design.read(draw(st.sampled_from(("plain-zn", "spherical-table-2-3", "helical-crowned", "zk-zn-45"))))
    for _ in range(draw(st.integers(1, 4))):
        table, key = draw(st.sampled_from(mutate.places(tables["drive"])))
        target = tables if table == "flank" else tables.setdefault(table, {})
        target[key] = draw(VALUES)
    return tables


@SMALL
@given(changed())
def test_any_value_of_any_key_is_a_design_or_an_error_that_says_why(tmp_path_factory, tables):
    found = designs.loaded(mutate.toml(tables), tmp_path_factory.mktemp("design"))
    assert isinstance(found, Drive | DesignError)


def test_mutated_designs_are_read_or_refused_and_what_they_call_contact_touches():
    total, failures, _ = designs.run(150, 12)
    assert not failures, failures
    assert total["refused"] > 50 and total["analysed"] > 5


@pytest.mark.parametrize("path", sorted(mutate.CORPUS.glob("*.toml")), ids=lambda path: path.stem)
def test_what_was_once_trouble_is_read_or_refused_and_analysed(path, tmp_path):
    found = designs.loaded(path.read_bytes(), tmp_path)
    if isinstance(found, Drive):
        designs.analysed(found, random.Random(0), deep=False)


@pytest.mark.validate
@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("path", sorted((mutate.CORPUS / "pages").glob("*.toml")), ids=lambda path: path.stem)
def test_what_was_once_trouble_is_exported_and_reported(path, tmp_path):
    assert pages.outcomes(path.read_bytes(), tmp_path)


def test_the_c_interface_does_as_it_says_of_random_bytes(tmp_path):
    """Some thousand calls of every function; what it calls a success or a proof is held against both surfaces."""
    built = interface.ROOT / ".venv" / "objects"
    if not built.exists() or not interface.gcc():
        pytest.skip("the drives were not built in this checkout, or there is no gcc")
    program = interface.build_quickly(tmp_path, "gcc", built, "spherical-table-2-3")
    ended, said = interface.run(program, (5, 20), 300)
    assert ended == 0, said
    assert interface.counted(said)["calls"] > 2_000 and interface.counted(said)["successes"] > 100


def test_a_changed_record_is_refused_with_a_reason(tmp_path):
    """Those that were once accepted or ended in a traceback, and a few more."""
    ledger = forger.small_ledger()
    for seed in (1, 9, 28, 136, 148, 215, 283, 1029, 1192):
        (tmp_path / str(seed)).mkdir()
        outcome, wrong = records.one(random.Random(seed), ledger, tmp_path / str(seed))
        assert not wrong, (seed, outcome, wrong)
