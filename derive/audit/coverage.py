"""What the source texts display (``displayed.json``), beside the entries of the record that judge it.

``judged.json`` says of each statement which entries judge it, or why none does. What is displayed and neither is a gap.
``displayed.py`` makes the list from the texts.
"""

import hashlib
import json
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

HERE = Path(__file__).parent
DISPLAYED, JUDGED = HERE / "displayed.json", HERE / "judged.json"
KINDS = ("equation", "where", "table", "claim")


@dataclass(frozen=True)
class Row:
    """A displayed statement and what judges it."""

    document: str
    kind: str
    label: str
    line: int
    entries: tuple[str, ...]
    reason: str

    @property
    def is_gap(self) -> bool:
        return not self.entries and not self.reason


def sha256(text: str) -> str:
    """SHA-256 of a text."""
    return hashlib.sha256(text.encode()).hexdigest()


@cache
def read(path: Path) -> dict:
    """A list of this folder."""
    return json.loads(path.read_text(encoding="utf-8"))


def offset(identifier: str, verbatim: str) -> int | None:
    """Where a verbatim text stands in its source, in characters; None if it is a transliteration."""
    at, written = read(DISPLAYED)["literal"].get(identifier, (None, ""))
    return at if written == sha256(verbatim) else None


def rows(claims: Mapping[str, Sequence]) -> list[Row]:
    """Every displayed statement with the entries that judge it. ``claims`` are those of each document."""
    judged, found = read(JUDGED), []
    for document, listed in read(DISPLAYED)["displayed"].items():
        for kind, label, line, _ in listed:
            own = judged.get(document, {}).get(label, "")
            reason = own if isinstance(own, str) else ""
            entries = tuple(own) if isinstance(own, list) else ()
            if kind == "equation" and not own:
                entries = tuple(claim.key for claim in claims.get(document, ()) if mentions(claim.where, label))
            found.append(Row(document, kind, label, line, entries, reason))
    return found


def mentions(where: str, label: str) -> bool:
    """Does "Eqs (19), (20)" or "(2.19)–(2.22)" hold the number in "(2.20)"?"""
    number = _number(label.strip("()"))
    ranges = re.findall(r"\(([\d.]+)\)[–-]\(([\d.]+)\)", where)
    return f"({label.strip('()')})" in where or any(_number(a) <= number <= _number(b) for a, b in ranges)


def _number(text: str) -> tuple[int, ...]:
    return tuple(int(part) for part in text.split(".") if part.isdigit())


def unknown(claims: Mapping[str, Sequence]) -> list[str]:
    """Entries or statements that the list of judgements names and that there are not."""
    displayed = {(d, label) for d, listed in read(DISPLAYED)["displayed"].items() for _, label, *_ in listed}
    wrong = []
    for document, labels in read(JUDGED).items():
        keys = {claim.key for claim in claims[document]}
        for label, own in labels.items():
            if (document, label) not in displayed:
                wrong.append(f"{document}: nothing displayed is called {label}")
            wrong += [f"{document}/{key} is no entry" for key in own if isinstance(own, list) and key not in keys]
    return wrong


def summary(found: Sequence[Row]) -> list[tuple[str, str, int, int, int, int]]:
    """(document, kind, displayed, with an entry, with a reason, gaps)."""
    lines = []
    for document in dict.fromkeys(row.document for row in found):
        for kind in KINDS:
            own = [row for row in found if (row.document, row.kind) == (document, kind)]
            count = Counter("entry" if r.entries else "reason" if r.reason else "gap" for r in own)
            lines.append((document, kind, len(own), count["entry"], count["reason"], count["gap"]))
    return lines
