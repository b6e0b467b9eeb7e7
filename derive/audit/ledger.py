"""Build the record: every claim judged by the prover, every object hashed and linked, one root over all.

Input: chapters, each a document with its claims. Output: a Ledger whose `objects` are ready to be written as canonical
JSON.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

from derive.audit.checker.lines import sha256_of
from derive.audit.checker.record import root_of
from derive.audit.checker.verdicts import status_of
from derive.audit.claims import AS_PRINTED, Claim, Document, Figure, FigureClaim, Scope, as_list
from derive.audit.coverage import offset
from derive.audit.described import Origin, origin_of
from derive.prove import Decision, Outcome, Statement, certificate, decide
from derive.prove.edits import correction
from derive.prove.tree import parse_formula, symbols

OPERATIONS = {"d": "diff", "cross": "cross", "dot": "dot", "triple": "dot", "@": "matmul"}


@dataclass(frozen=True)
class Chapter:
    """A document and what is claimed in it, in reading order; or why that is `unreadable`."""

    document: Document
    claims: Sequence[Claim | FigureClaim]
    unreadable: str = ""


@dataclass(frozen=True)
class Judged:
    """One equation or printed number: its outcome, what it was decided from, and the hashes of its two objects."""

    outcome: Outcome
    equation: str
    certificate: str
    of: tuple[Statement, Decision] | Figure

    @property
    def statement(self) -> Statement:
        """The equation; TypeError for a printed number."""
        return self._equation[0]

    @property
    def decision(self) -> Decision:
        """How the equation was decided; TypeError for a printed number."""
        return self._equation[1]

    @property
    def figure(self) -> Figure:
        """The printed number; TypeError for an equation."""
        if not isinstance(self.of, Figure):
            raise TypeError(f"{self.statement.id} is no printed number")
        return self.of

    @property
    def _equation(self) -> tuple[Statement, Decision]:
        if isinstance(self.of, Figure):
            raise TypeError(f"{self.of.formula} is no equation")
        return self.of


@dataclass(frozen=True)
class Reading:
    """Equations that together are one way to read a claim."""

    label: str
    parts: tuple[Judged, ...]
    texts: tuple = ()
    """The notation of each part; empty for a correction that was searched for."""

    @property
    def outcome(self) -> Outcome:
        outcomes = [part.outcome for part in self.parts]
        return next(outcome for outcome in (Outcome.REFUTED, Outcome.UNDECIDED, Outcome.PROVED) if outcome in outcomes)


@dataclass(frozen=True)
class Verdict:
    """What came out for one claim. `change` says which token a correction changes, `unreadable` why nothing came out:
    a description has no longer what the claim reads.
    """

    claim: Claim | FigureClaim
    status: str
    readings: tuple[Reading, ...] = ()
    corrected: Reading | None = None
    contradiction: Reading | None = None
    change: str = ""
    id: str = ""
    sha256: str = ""
    unreadable: str = ""


@dataclass
class Ledger:
    """Every object of the record by its hash, the verdicts in reading order, and documents that cannot be read."""

    objects: dict[str, dict] = field(default_factory=dict)
    verdicts: dict[str, list[Verdict]] = field(default_factory=dict)
    unreadable: dict[str, str] = field(default_factory=dict)

    @property
    def root(self) -> str:
        return root_of(self.objects)

    def add(self, body: dict) -> str:
        """Enter an object; its hash."""
        key = sha256_of(body)
        self.objects.setdefault(key, {**body, "sha256": key})
        return key


def build(chapters: Sequence[Chapter]) -> Ledger:
    """Judge every claim."""
    ledger = Ledger()
    for chapter in chapters:
        document = chapter.document
        ledger.verdicts[document.key] = [judged(ledger, document, claim) for claim in chapter.claims]
        if chapter.unreadable:
            ledger.unreadable[document.key] = chapter.unreadable
    return ledger


def judged(ledger: Ledger, document: Document, claim: Claim | FigureClaim) -> Verdict:
    """Judge one claim and enter all that it rests on; nothing of one that cannot be read."""
    identifier = f"{document.key}/{claim.key}"
    entered = Ledger(dict(ledger.objects))
    try:
        source = entered.add(_source(document, claim))
        if isinstance(claim, FigureClaim):
            verdict = _judge_figures(entered, document, claim, source)
        else:
            verdict = _judge(entered, document, claim, source)
    except Exception as error:  # noqa: BLE001  whatever a description holds now where the claim read something else
        return Verdict(claim, "undecided", id=identifier, unreadable=f"{type(error).__name__}: {error}")
    ledger.objects.update(entered.objects)
    return replace(verdict, id=identifier, sha256=ledger.add(_verdict_body(verdict, identifier, source)))


def _source(document: Document, claim: Claim | FigureClaim) -> dict:
    return {
        "object": "source",
        "id": f"{document.key}/{claim.key}",
        "document": document.file,
        "document_sha256": document.sha256,
        "locator": claim.where,
        "verbatim": claim.verbatim,
        "offset": offset(f"{document.key}/{claim.key}", claim.verbatim),
        "ocr_doubt": getattr(claim, "damage", ""),
        "reading": claim.read() if isinstance(claim, Claim) and not claim.contradiction else {},
        "figures": [[figure.formula, figure.printed] for figure in getattr(claim, "figures", ())],
    }


def _judge(ledger: Ledger, document: Document, claim: Claim, source: str) -> Verdict:
    identifier = f"{document.key}/{claim.key}"
    readings = tuple(_reading(ledger, claim, identifier, label, texts, source) for label, texts in claim.read().items())
    if claim.contradiction:
        against = _reading(ledger, claim, identifier, "contradiction", as_list(claim.contradiction), source)
        return Verdict(claim, status_of([], [], [str(against.outcome)], bool(claim.damage)), contradiction=against)
    if not readings:
        return Verdict(claim, "ambiguous" if claim.missing else claim.kind)
    outcomes = [str(reading.outcome) for reading in readings]
    # a print may be mistaken, a definition of ours is not to be guessed
    printed_wrong = set(outcomes) == {"refuted"} and claim.kind != "identity"
    corrected, change = _correct(ledger, claim, identifier, readings[0], source) if printed_wrong else (None, "")
    status = status_of(outcomes, [str(corrected.outcome)] if corrected else [], [], bool(claim.damage))
    return Verdict(claim, status, readings, corrected, change=change)


def _reading(ledger: Ledger, claim: Claim, identifier: str, label: str, texts: Sequence[str], source: str) -> Reading:
    parts = (_judge_text(ledger, claim, f"{identifier}/{label}/{k}", text, source) for k, text in enumerate(texts, 1))
    return Reading(label, tuple(parts), tuple(texts))


def _scope(claim: Claim) -> Scope:
    if claim.scope is None:
        raise ValueError(f"{claim.key}: an equation needs a scope in which its names mean something")
    return claim.scope


def _judge_text(ledger: Ledger, claim: Claim, identifier: str, text: str, source: str) -> Judged:
    kind = "derived" if claim.kind == "identity" else "printed"
    return _enter(ledger, claim, _scope(claim).statement(identifier, text), kind, source)


def _enter(ledger: Ledger, claim: Claim, statement: Statement, kind: str, source: str) -> Judged:
    decision = decide(statement)
    equation = ledger.add(
        {
            "object": "equation",
            "id": statement.id,
            "kind": kind,
            "lhs": statement.lhs,
            "rhs": statement.rhs,
            "where": _enter_steps(ledger, _scope(claim).key, statement),
            "jets": {name: list(statement.jets[name]) for name in statement.used_jets},
            "signs": sorted(statement.signs & set(statement.free_symbols)),
            "side_conditions": list(claim.conditions),
            "unit": "",
            "sources": [source],
        }
    )
    shown = ledger.add({"object": "certificate", "equation": equation, **certificate(decision)})
    return Judged(decision.outcome, equation, shown, (statement, decision))


def _enter_steps(ledger: Ledger, scope: str, statement: Statement) -> dict[str, str]:
    """Name -> hash of the step that defines it; each step rests on those whose names it uses."""
    entered: dict[str, str] = {}
    for name, tree in statement.used.items():
        operation = OPERATIONS.get(tree[0], "define") if isinstance(tree, tuple) else "define"
        inputs = sorted(entered[other] for other in symbols(tree) if other in entered)
        origin = origin_of(tree)
        entered[name] = ledger.add(
            {
                "object": "step",
                "id": f"{scope}.{name}",
                "op": operation,
                "tree": tree,
                "inputs": inputs,
                "read": origin and origin.as_json(),
            }
        )
    return entered


def _correct(
    ledger: Ledger, claim: Claim, identifier: str, reading: Reading, source: str
) -> tuple[Reading | None, str]:
    """What should stand there: the claim's own correction, else the first one-token change that is true."""
    if claim.corrected:
        statements = [
            _scope(claim).statement(f"{identifier}/corrected/{k}", text)
            for k, text in enumerate(as_list(claim.corrected), 1)
        ]
        entered = tuple(_enter(ledger, claim, statement, "corrected", source) for statement in statements)
        return Reading("corrected", entered, tuple(as_list(claim.corrected))), ""
    changes: list[str] = []
    parts: list[Judged] = []
    for number, part in enumerate(reading.parts, 1):
        if part.outcome is Outcome.PROVED:
            parts.append(part)
            continue
        found = correction(part.statement, claim.confusable)
        if found is None:
            return None, ""
        edit, statement = found
        changes.append(edit.change)
        parts.append(
            _enter(ledger, claim, replace(statement, id=f"{identifier}/corrected/{number}"), "corrected", source)
        )
    return Reading("corrected", tuple(parts)), "; ".join(dict.fromkeys(changes))


def _judge_figures(ledger: Ledger, document: Document, claim: FigureClaim, source: str) -> Verdict:
    identifier = f"{document.key}/{claim.key}"
    parts = tuple(
        _judge_figure(ledger, f"{identifier}/{AS_PRINTED}/{k}", figure, "printed", source)
        for k, figure in enumerate(claim.figures, 1)
    )
    reading = Reading(AS_PRINTED, parts, _texts(claim.figures))
    if reading.outcome is Outcome.PROVED:
        return Verdict(claim, "proved", (reading,))
    if claim.final or any(part.figure.is_sign for part in parts):
        return Verdict(claim, "false", (reading,))
    amended = claim.corrected or [
        part.figure if part.outcome is Outcome.PROVED else part.figure.amended() for part in parts
    ]
    corrected = Reading(
        "corrected",
        tuple(
            _judge_figure(ledger, f"{identifier}/corrected/{k}", figure, "corrected", source)
            for k, figure in enumerate(amended, 1)
        ),
        _texts(amended),
    )
    return Verdict(claim, status_of(["refuted"], [str(corrected.outcome)], [], damaged=False), (reading,), corrected)


def _texts(figures: Sequence[Figure]) -> tuple:
    return tuple([figure.formula, figure.printed] for figure in figures)


def _judge_figure(ledger: Ledger, identifier: str, figure: Figure, kind: str, source: str) -> Judged:
    outcome = Outcome.PROVED if figure.holds else Outcome.REFUTED
    equation = ledger.add(
        {
            "object": "equation",
            "id": identifier,
            "kind": kind,
            "lhs": parse_formula(figure.formula),
            "rhs": figure.printed,
            "unit": figure.unit,
            "where": {},
            "jets": {},
            "signs": [],
            "side_conditions": [],
            "sources": [source],
        }
    )
    shown = ledger.add(
        {
            "object": "certificate",
            "kind": "numeric",
            "equation": equation,
            "outcome": str(outcome),
            "value": f"{figure.value:.9g}",
        }
    )
    return Judged(outcome, equation, shown, figure)


def drives_read(verdict: Verdict) -> list[str]:
    """The drives from whose descriptions the verdict's equations read; none where it is of mathematics in general."""
    return sorted({origin.drive for origin in _origins(verdict)})


def edges_read(verdict: Verdict) -> set[tuple[str, str]]:
    """The drives and places whose edges or normals the verdict's equations read."""
    found: set[tuple[str, str]] = set()
    for origin in _origins(verdict):
        left = [origin.part]
        while left:
            word, *rest = left.pop()
            if word in ("edge", "edge_normal", "normal"):
                found.add((origin.drive, rest[0]))
            elif word != "given":
                left += [part for part in rest if isinstance(part, list)]
    return found


def _origins(verdict: Verdict) -> Iterator[Origin]:
    for reading in filter(None, (*verdict.readings, verdict.corrected, verdict.contradiction)):
        for part in reading.parts:
            if not isinstance(part.of, Figure):
                yield from filter(None, map(origin_of, part.statement.used.values()))


def _verdict_body(verdict: Verdict, identifier: str, source: str) -> dict:
    return {
        "object": "verdict",
        "id": identifier,
        "source": source,
        "status": verdict.status,
        "plain": verdict.claim.plain,
        "readings": [_reading_body(reading) for reading in verdict.readings],
        "corrected": [_reading_body(verdict.corrected)] if verdict.corrected else [],
        "contradiction": [_reading_body(verdict.contradiction)] if verdict.contradiction else [],
        "change": verdict.change,
        "missing": getattr(verdict.claim, "missing", ""),
        "damage": getattr(verdict.claim, "damage", ""),
        "drops": getattr(verdict.claim, "drops", ""),
        "described": drives_read(verdict),
    }


def _reading_body(reading: Reading) -> dict:
    return {
        "label": reading.label,
        "texts": list(reading.texts),
        "parts": [{"equation": part.equation, "certificate": part.certificate} for part in reading.parts],
    }
