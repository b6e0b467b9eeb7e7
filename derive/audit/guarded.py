"""Side conditions of all generated drives in one table a family, for the pages."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass
class Row:
    """A condition of the drives of one family: where it is evaluated, which guards answer, in how many drives."""

    operation: str
    stage: str
    condition: str
    equations: tuple[str, ...]
    functions: dict[str, None] = field(default_factory=dict)
    guards: dict[str, None] = field(default_factory=dict)
    drives: set[str] = field(default_factory=set)


def by_family(generated: Mapping[str, str]) -> dict[str, list[Row]]:
    """Family → rows in order of appearance in the descriptions among the generated files, drives by name."""
    tables: dict[str, dict[tuple, Row]] = {}
    for path, text in sorted(generated.items()):
        if path.startswith("c/") and path.endswith(".json"):
            description = json.loads(text)
            for entry in description["side_conditions"]:
                _add(tables.setdefault(description["family"], {}), description["name"], entry)
    return {family: list(rows.values()) for family, rows in tables.items()}


def _add(rows: dict[tuple, Row], drive: str, entry: dict) -> None:
    key = entry["operation"], entry["stage"], entry["condition"], tuple(entry["equations"])
    row = rows.setdefault(key, Row(*key))
    row.drives.add(drive)
    for name, use in entry["functions"].items():
        row.functions[name] = None
        row.guards |= {"setup" if guard.startswith("setup ") else guard: None for guard in use["guards"]}
