"""How the statements that a drive cites stand today: read from the pages as they are and decided anew.

Nothing is looked up in a record that was written before: a statement holds of the definitions that it reads at the
moment, and of the pages on which they stand. One that is false, undecided or said of other pages is open.
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import chain
from typing import Any

import sympy as sp

from derive import drives
from derive.audit.checker.seal import KEY
from derive.audit.claims import Figure
from derive.audit.ledger import Judged, Ledger, Verdict, drives_read, edges_read, judged
from derive.language.drive import citations
from derive.language.replace import replaced
from derive.language.surface import Surface
from derive.language.written import is_tool, shown
from derive.prove import Outcome


@dataclass(frozen=True)
class Standing:
    """What is known of a statement.

    key:    hash of the statement with all definitions that it reads, and of what shows it
    open:   why it is not proved, with a counterexample where there is one; "" for a proved one
    pages:  files whose definitions it is proved of; none where it reads no description and is true of any
    shapes: of a statement about an edge, the surfaces that it is proved of (:func:`shape`), which a tool may make of
            another body too; none of any other statement
    """

    key: str
    open: str = ""
    pages: frozenset[str] | None = None
    shapes: frozenset[str] | None = None

    def open_for(self, statement: str) -> str:
        """Why a citation does not hold; "" if it does."""
        page = getattr(statement, "page", "")
        if self.open or self.pages is None:
            return self.open
        if page not in self.pages:
            return f"proved of the definitions of {', '.join(map(shown, sorted(self.pages)))}, not of {shown(page)}"
        of = getattr(statement, "of", None)
        if self.shapes is None or not is_tool(page) or not isinstance(of, Surface) or shape(of) in self.shapes:
            return ""
        return f"proved of another surface than that which {shown(page)} makes of {of.parameters[0].frame} here"


def shape(surface: Surface) -> str:
    """What point and normal of a surface are, without the names of the body: the same for a tool's other body."""
    if surface not in _SHAPES:
        vectors = [surface.definitions.resolve(c) for c in (*surface.point, *surface.normal)]
        symbols = set(chain.from_iterable(vector.free_symbols for vector in vectors))
        name = f"_{surface.parameters[0].frame}"
        letters = {q: sp.Symbol(str(q).removesuffix(name), real=True) for q in symbols}
        _SHAPES[surface] = str([replaced(vector, letters) for vector in vectors])
    return _SHAPES[surface]


_SHAPES: dict[Surface, str] = {}


class Standings(dict[str, Standing]):
    """Statements by their names, and documents that cannot be read, with the reason."""

    def __init__(self, known: Mapping[str, Standing], unreadable: Mapping[str, str]):
        super().__init__(known)
        self.unreadable = unreadable

    def __missing__(self, name: str) -> Standing:
        if reason := self.unreadable.get(name.partition("/")[0]):
            return Standing("", UNREADABLE + reason)
        return Standing("", "the audit record has no statement of this name")


#: How the reason begins why a statement is open that reads what is not there.
UNREADABLE = "cannot be read of the description any more: "


def standings(names: Collection[str]) -> Standings:
    """The statements of these names, each read and decided now."""
    from derive.audit import record

    chapters = record.chapters({name.partition("/")[0] for name in names})
    wanted = (
        judged(Ledger(), chapter.document, claim)
        for chapter in chapters
        for claim in chapter.claims
        if f"{chapter.document.key}/{claim.key}" in names
    )
    unreadable = {chapter.document.key: chapter.unreadable for chapter in chapters if chapter.unreadable}
    return Standings({verdict.id: _standing(verdict) for verdict in wanted}, unreadable)


def of_ledger(ledger: Ledger) -> Standings:
    """All statements of a ledger that was just built."""
    verdicts = (verdict for listed in ledger.verdicts.values() for verdict in listed)
    return Standings({verdict.id: _standing(verdict) for verdict in verdicts}, ledger.unreadable)


def _standing(verdict: Verdict) -> Standing:
    if verdict.unreadable:
        return Standing("", UNREADABLE + verdict.unreadable)
    read = drives_read(verdict)
    pages = frozenset(page for name in read for page in _pages_citing(name).get(verdict.id, ())) if read else None
    return Standing(verdict.sha256[:KEY], _open(verdict), pages, _shapes(verdict.id, edges_read(verdict)))


def _shapes(statement: str, places: Collection[tuple[str, str]]) -> frozenset[str] | None:
    """What the surfaces are at these places of drives where they cite the statement."""
    cited = (step for drive, place in places for step in _steps_at(drive, place) if step == statement)
    return frozenset(shape(step.of) for step in cited if isinstance(step.of, Surface)) or None


def _steps_at(drive: str, place: str) -> Collection[Any]:
    described = drives.drive(drive)
    parts = {body.name: body for body in described.bodies}
    parts |= {f"{region.member}/{region.name}": region for region in described.regions}
    return parts[place].surface.steps


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
