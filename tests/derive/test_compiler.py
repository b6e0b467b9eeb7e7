"""Printers only print: what is emitted of a plan leaves its tapes as they are."""

from derive.compiler import checked, emit
from tests.derive.small import plan


def test_printers_add_nothing_to_the_tapes():
    made = plan.__wrapped__()  # one whose tapes no other test has read
    programs = (*made.rules, made.completion, made.sizes, *made.systems)
    tapes = [made.tape, *(program.tape for program in programs)]
    before = [list(tape.nodes) for tape in tapes]
    origin = {"root_hash": "", "equations": [], "equations_of": {}}
    written = dict([*emit(made, origin), *checked(made)])
    assert [tape.nodes for tape in tapes] == before
    assert {f"c/{made.drive.name}{end}" for end in (".h", "_lanes.h", "_certify.h", "_sensitivity.h")} <= set(written)
