"""What became of the changes: a table by stage and function, and the one that is kept for the page of validation."""

import json
import re
from pathlib import Path

from derive.audit.mutations.stages import EQUAL, REFUSED, STAGES, SURVIVED
from derive.files import replace_text

MEASURED = Path(__file__).with_name("measured.json")


def kind_of(function: str) -> str:
    """A function without the names of its system and margin, so that drives can be added up."""
    return re.sub(r"^(edge|rule)_.*", r"\1_*", function) or "contact"


def table(outcomes: dict[tuple[str, ...], tuple[str, str]]) -> list[dict]:
    """Rows by stage and function, over all drives."""
    rows: dict[tuple[str, str], dict] = {}
    for (_, stage, function, _), (by, _) in outcomes.items():
        key = stage, kind_of(function)
        row = rows.setdefault(key, {"stage": key[0], "function": key[1], REFUSED: 0, SURVIVED: 0, EQUAL: 0})
        row[by] += 1
    return [rows[key] for key in sorted(rows, key=lambda key: (STAGES.index(key[0]), key[1]))]


def measured() -> dict:
    """The tables as last measured, with their sums."""
    kept = json.loads(MEASURED.read_text(encoding="utf-8"))
    edits = kept["edits"]
    names = [name for name in edits["rows"][0] if name != "file"]
    edits |= {name: sum(row[name] for row in edits["rows"]) for name in names}
    return kept | {key: sum(row[key] for row in kept["rows"]) for key in (REFUSED, SURVIVED, EQUAL)}


def keep(**found: object) -> None:
    """Replace a part of what was last measured."""
    kept = json.loads(MEASURED.read_text(encoding="utf-8")) | found
    replace_text(MEASURED, json.dumps(kept, indent=1, ensure_ascii=False) + "\n")
