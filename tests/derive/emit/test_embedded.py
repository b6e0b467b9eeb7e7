"""The part of the runtime that a header repeats stands alone: no include of ours, each text once, before its use."""

from pathlib import Path

from derive.emit import embedded

RUNTIME = Path(__file__).resolve().parents[3] / "runtime" / "c"


def test_the_solver_includes_nothing_of_ours():
    text = embedded.solver(RUNTIME)
    assert '#include "' not in text and "/*" not in text
    assert text.index("mwi_newton") < text.index("mwi_walk")


def test_the_tables_hold_the_model_and_every_status():
    text = embedded.tables(RUNTIME)
    assert "mw_model" in text and "MW_NO_CONTACT" in text
