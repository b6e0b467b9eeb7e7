"""The words in which documents are encoded: scopes of definitions and the claims that stand in them.

A claim holds the print and our reading of it. Its verdict is never written here: it comes from the prover.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal

from derive.audit.checker import enclosure
from derive.prove.statement import Statement
from derive.prove.tree import Tree, parse, parse_formula

AS_PRINTED = "as printed"
DERIVED = "derived"


@dataclass(frozen=True)
class Document:
    """A source, or one of our own chapters of identities."""

    key: str
    name: str
    file: str
    sha256: str
    about: str
    symbols: Mapping[str, tuple[str, str, str]] = field(default_factory=dict)
    """name -> (how it is printed, unit, meaning)."""


@dataclass(frozen=True)
class Scope:
    """Names with their definitions, read when a statement needs them. `extends` makes a scope that adds names to
    another; `described` gives what is read from drives' descriptions, which `typed` may use.
    """

    key: str
    typed: Mapping[str, Tree]
    jets: Mapping[str, tuple[str, ...]]
    signs: frozenset[str]
    described: Callable[[], Mapping[str, Tree]] = dict
    extends: Scope | None = None

    @cached_property
    def definitions(self) -> dict[str, Tree]:
        """Name -> tree, in order."""
        return dict(self.extends.definitions if self.extends else {}) | dict(self.described()) | dict(self.typed)

    def read(self, text: str) -> Tree:
        return parse(text, self.jets)

    def statement(self, identifier: str, text: str) -> Statement:
        """A statement from `left = right`."""
        left, right = text.split(" = ")
        return Statement(identifier, self.read(left), self.read(right), self.definitions, self.jets, self.signs)


def scope(
    key: str,
    text: str,
    jets: Mapping[str, tuple[str, ...]] | None = None,
    signs: Sequence[str] = (),
    extends: Scope | None = None,
    described: Callable[[], Mapping[str, Tree]] = dict,
) -> Scope:
    """Read definitions, one `name = expression` a line; a line that starts with a space continues the one before.

    `described` gives definitions read from a drive's description; those of the text may use them.
    """
    merged = dict(extends.jets if extends else {}) | dict(jets or {})
    typed = {}
    for line in text.strip().replace("\n ", " ").splitlines():
        if line.strip():
            name, expression = line.split(" = ", 1)
            typed[name.strip()] = parse(expression, merged)
    all_signs = frozenset(signs) | (extends.signs if extends else frozenset())
    return Scope(key, typed, merged, all_signs, described, extends)


Texts = str | Sequence[str]


@dataclass(frozen=True)
class Claim:
    """One printed statement.

    readings   label -> equations `left = right` that together are what that reading says; more than one label only
               where the text is damaged or says two things
    corrected  the equations that should stand there, where no one-token change of the print is true
    confusable groups of symbols that a misprint may exchange, for the search of a correction
    contradiction  equations whose truth makes the claim false, for claims that are not equations themselves
    missing    what an incomplete text leaves out
    drops      a factor that the step to the printed form divides by
    """

    key: str
    where: str
    verbatim: str
    plain: str
    scope: Scope | None = None
    readings: Mapping[str, Texts] | Texts = ()
    corrected: Texts = ()
    contradiction: Texts = ()
    conditions: Sequence[str] = ()
    damage: str = ""
    missing: str = ""
    drops: str = ""
    kind: Literal["claim", "definition", "not_mathematical", "identity"] = "claim"
    confusable: Sequence[Sequence[str]] = ()

    def read(self) -> dict[str, list[str]]:
        """Label -> equations."""
        if isinstance(self.readings, Mapping):
            return {label: as_list(texts) for label, texts in self.readings.items()}
        texts = as_list(self.readings)
        return {DERIVED if self.kind == "identity" else AS_PRINTED: texts} if texts else {}


@dataclass(frozen=True)
class Figure:
    """A printed number and the formula it should come from, or only its sign, ">0" or "<0"."""

    formula: str
    printed: str
    unit: str = ""

    @cached_property
    def enclosed(self) -> enclosure.Ball:
        return enclosure.number_of(parse_formula(self.formula))

    @property
    def value(self) -> float:
        return float(self.enclosed.middle)

    @property
    def decimals(self) -> int:
        return len(self.printed.partition(".")[2])

    @property
    def is_sign(self) -> bool:
        return self.printed in (">0", "<0")

    @property
    def holds(self) -> bool:
        """Within half a unit of the last printed digit?"""
        return enclosure.holds(self.enclosed, self.printed)

    def amended(self) -> Figure:
        """The same formula with the number it gives."""
        return replace(self, printed=f"{self.value:.{self.decimals}f}")


@dataclass(frozen=True)
class FigureClaim:
    """Printed numbers judged against their formulas.

    `final` if what the formula gives is not what should be printed instead.
    """

    key: str
    where: str
    verbatim: str
    plain: str
    figures: Sequence[Figure]
    corrected: Sequence[Figure] = ()
    final: bool = False
    kind: str = "claim"


def as_list(texts: Texts) -> list[str]:
    return [texts] if isinstance(texts, str) else list(texts)
