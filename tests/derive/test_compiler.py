"""Printers only print: what is emitted of a plan leaves its tapes as they are."""

import ast
from pathlib import Path

import pytest

from derive import emit as printers
from derive.compiler import checked, emit
from tests.derive.small import plan


def test_printers_add_nothing_to_the_tapes():
    made = plan.__wrapped__()  # one whose tapes no other test has read
    programs = (*made.rules, made.completion, made.sizes, *made.systems)
    tapes = [made.tape, *(program.tape for program in programs)]
    before = [list(tape.nodes) for tape in tapes]
    origin = {"equations": [], "keys": {}, "equations_of": {}, "open": {}}
    written = dict([*emit(made, lambda: origin), *checked(made)])
    assert [tape.nodes for tape in tapes] == before
    assert {f"c/{made.drive.name}{end}" for end in (".h", "_lanes.h", "_certify.h", "_sensitivity.h")} <= set(written)


@pytest.mark.parametrize("printer", sorted(Path(printers.__file__).parent.glob("*.py")), ids=lambda path: path.stem)
def test_printers_call_no_pass(printer):
    """What they import of the passes is the form of what they print."""
    nodes = ast.walk(ast.parse(printer.read_text(encoding="utf-8")))
    imports = [node for node in nodes if isinstance(node, ast.ImportFrom | ast.Import)]
    named = {(getattr(node, "module", ""), alias.name) for node in imports for alias in node.names}
    taken = {(module, name) for module, name in named if "derive.passes" in f"{module}.{name}"}
    forms = {"derive.passes.plan": {"Schedule"}, "derive.passes.arrange": {"Routines", "SideBySide"}}
    assert all(name in forms.get(module, ()) for module, name in taken), taken
