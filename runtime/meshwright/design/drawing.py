"""The drawing of a design: every size with its symbol, where it is from, and the relation that gives it."""

import math
from dataclasses import dataclass

from meshwright.base.expression import value
from meshwright.design import description as metadata
from meshwright.design import schema
from meshwright.design.relations import ASSUMED, DERIVED, GIVEN, Completion, Known, Symbols, outer

#: Longest relation that is shown in a line.
WIDEST = 72

#: Why a size has its value where a design's completion gives it without a relation of the drawing.
COMPLETED = "completes the design"

#: The same of a key that the design lists as assumed.
PROPOSED = "proposed, not given"


@dataclass(frozen=True)
class Size:
    """A size of a drawing: the ``table`` of its key, its ``value`` in the unit of the key, or its word.

    ``provenance`` is "given", "derived" or "assumed", ``relation`` the equation that derives it or the reason for which
    it is assumed.
    """

    table: str
    value: float | int | str
    symbol: str
    meaning: str
    provenance: str
    relation: str


@dataclass(frozen=True)
class Finding:
    """A check of a drawing: its ``margin`` is positive where nothing occurs, or where something is possible.

    ``word`` says which: "occurs" or "possible"; ``holds`` whether it does or is.
    """

    word: str
    holds: bool
    margin: float
    meaning: str

    @property
    def said(self):
        """In words, for readers."""
        return self.word if self.holds else {"occurs": "does not occur", "possible": "not possible"}[self.word]


@dataclass(frozen=True)
class Sheet:
    """What a drawing states: sizes by key (with its table, where a member has one of its own) and checks by name."""

    drive: str
    design: dict
    sizes: dict[str, Size]
    checks: dict[str, Finding]

    def as_json(self):
        """As plain data, ``meshwright.drawing/1``."""
        shown = ("value", "symbol", "provenance", "relation")
        return {
            "schema": "meshwright.drawing/1", "drive": self.drive, "design": self.design,
            "sizes": {key: {name: getattr(size, name) for name in shown} for key, size in self.sizes.items()},
            "checks": {name: {c.word: c.holds, "margin": c.margin} for name, c in self.checks.items()},
        }  # fmt: skip


def shortened(relation):
    """A relation or reason that fits on a line."""
    return relation if len(relation) <= WIDEST else f"{relation[: WIDEST - 1]}…"


def sheet(design):
    """The :class:`Sheet` of a :class:`~meshwright.design.design.Design`."""
    drawing = metadata.families(design.places)[design.family].drawing
    given = design.drawn or design.given()
    # a design of its own keys alone is what it is: a drawing says what it follows from, not whether it agrees
    completion = Completion.of(
        drawing, schema.drawn(design.family, given, design.places), judged=design.drawn is not None
    )
    known, proposed = completion.known, given.get("assumed", ())
    for number, p in zip(design.parameters, design.description["parameters"], strict=True):
        provenance = DERIVED if p["default"] is None else ASSUMED
        if p["key"] in design.given().get(p["table"], ()):
            provenance = GIVEN
        if math.isfinite(number):
            known.setdefault(p["name"], Known(float(number), provenance, "" if provenance == GIVEN else COMPLETED))
    completion.close()
    sizes = {}
    converted = [size for size in completion.given.values() if size["name"] == size["place"]]
    for p in [*drawing.listed, *converted]:
        if (size := known.get(p["name"])) is not None:
            symbol = "" if p["name"] in (p["key"], p.get("place")) else p["name"]
            key = drawing.table["tables"].get(p["table"], "") + p["key"]
            source, why = size.provenance, size.why(p["name"])
            if source == GIVEN and f"{p['table']}.{p['key']}" in proposed:
                source, why = ASSUMED, PROPOSED
            sizes[key] = Size(p["table"], outer(p, size.value), symbol, p["meaning"], source, why)
    for s in design.description["sizes"]:
        if s["key"] not in sizes and math.isfinite(design.sizes[s["key"]]):
            sizes[s["key"]] = Size("design", design.sizes[s["key"]], "", s["meaning"], DERIVED, s["meaning"])
    symbols = Symbols({name: size.value for name, size in known.items()})
    checks = {}
    for check in drawing.table["checks"]:
        margin = value(check["margin"], symbols)
        if math.isfinite(margin):
            word, holds = ("occurs", margin < 0.0) if check["occurs"] else ("possible", margin > 0.0)
            checks[check["name"]] = Finding(word, holds, margin, check["meaning"])
    return Sheet(design.family, design.as_solved(), sizes, checks)

