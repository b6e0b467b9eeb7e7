"""How the statements that a drive cites stand today: read from the pages as they are and decided anew.

Nothing is looked up in a record that was written before: a statement holds of the definitions that it reads at the
moment, and of the pages on which they stand. One that is false, undecided or said of other pages is open.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cache

from derive import drives
from derive.audit.checker.seal import KEY
from derive.audit.claims import Figure
from derive.audit.ledger import Judged, Ledger, Verdict, drives_read, judged
from derive.language.drive import citations
from derive.language.written import shown
from derive.prove import Outcome


@dataclass(frozen=True)
class Standing:
    """What is known of a statement.

    key:    hash of the statement with all definitions that it reads, and of what shows it
    open:   why it is not proved, with a counterexample where there is one; "" for a proved one
    pages:  files whose definitions it is proved of; none where it reads no description and is true of any
    """

    key: str
    open: str = ""
    pages: frozenset[str] | None = None

    def open_for(self, statement: str) -> str:
        """Why a citation does not hold; "" if it does."""
        page = getattr(statement, "page", "")
        if self.open or self.pages is None or page in self.pages:
            return self.open
        return f"proved of the definitions of {', '.join(map(shown, sorted(self.pages)))}, not of {shown(page)}"


#: Of a name that the record does not have.
UNKNOWN = Standing("", "the audit record has no statement of this name")


def standings(names: Collection[str]) -> dict[str, Standing]:
    """The statements of these names, each read and decided now."""
    from derive.audit import record

    found: dict[str, Standing] = dict.fromkeys(names, UNKNOWN)
    for chapter in record.chapters({name.partition("/")[0] for name in names}):
        for claim in chapter.claims:
            if (name := f"{chapter.document.key}/{claim.key}") in found:
                found[name] = _standing(judged(Ledger(), chapter.document, claim))
    return found


def of_ledger(ledger: Ledger) -> dict[str, Standing]:
    """All statements of a ledger that was just built."""
    return {verdict.id: _standing(verdict) for verdicts in ledger.verdicts.values() for verdict in verdicts}


def _standing(verdict: Verdict) -> Standing:
    if verdict.unreadable:
        return Standing("", f"cannot be read of the description any more: {verdict.unreadable}")
    read = drives_read(verdict)
    pages = frozenset(page for name in read for page in _pages_citing(name).get(verdict.id, ())) if read else None
    return Standing(verdict.sha256[:KEY], _open(verdict), pages)


def _open(verdict: Verdict) -> str:
    """Why a verdict is no proof of what is printed; "" where it is, or is for one reading of a damaged print."""
    if any(reading.parts and reading.outcome is Outcome.PROVED for reading in verdict.readings):
        return ""
    parts = [part for reading in verdict.readings for part in reading.parts if part.outcome is not Outcome.PROVED]
    return _counterexample(parts[0]) if parts else f"no statement that can be proved: {verdict.status}"


def _counterexample(part: Judged) -> str:
    words = "not decided by the prover"
    if part.outcome is Outcome.REFUTED:
        words = "false"
        if not isinstance(part.of, Figure) and (instance := part.decision.instance):
            values = {**instance.point.symbols, **{f"tan({a}/2)": v for a, v in instance.point.half_tangents.items()}}
            at = ", ".join(f"{name} = {value}" for name, value in values.items())
            left, right = (", ".join(f"{float(v):.6g}" for v in side) for side in (instance.lhs, instance.rhs))
            words += f": at {at} its left side is {left}, its right {right}"
    return words


@cache
def _pages_citing(name: str) -> Mapping[str, frozenset[str]]:
    """Statement → files that cite it where a drive of the tree is described."""
    found: dict[str, set[str]] = {}
    for statement in citations(drives.drive(name)):
        found.setdefault(statement, set()).add(statement.page)
    return {statement: frozenset(pages) for statement, pages in found.items()}
