"""Decide statements: proved, refuted with a point, or undecided. Nothing is simplified, nothing is tested numerically
first.

Input: a Statement. Output: a Decision per scalar component. A remainder of zero is a theorem wherever no denominator
vanishes; a point at which the sides differ is a refutation; anything else is undecided.
"""

from dataclasses import dataclass, replace
from enum import StrEnum

from derive.prove.evaluate import Evaluator, components
from derive.prove.fraction import Factors, Quotient
from derive.prove.normal_form import Relation, reduce
from derive.prove.points import THRESHOLD, Point, is_rounded, sample_points, value_at
from derive.prove.polynomial import BACKENDS, Terms, text_of
from derive.prove.statement import Statement
from derive.prove.tree import NotationError, Tree

ATTEMPTS = 24


class Outcome(StrEnum):
    PROVED = "proved"
    REFUTED = "refuted"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Component:
    """One scalar equation: its outcome and what shows it.

    A proof is numerator = sum of cofactor * relation for the numerator over `denominators` of lhs - rhs.
    """

    outcome: Outcome
    numerator: Terms
    denominators: tuple[tuple[Terms, int], ...]
    cofactors: tuple[Terms, ...]
    remainder: Terms


@dataclass(frozen=True)
class Instance:
    """Both sides at one point."""

    point: Point
    lhs: tuple
    rhs: tuple
    rounded: bool


@dataclass(frozen=True)
class Decision:
    """The outcome for a statement, with all that a certificate needs."""

    statement: Statement
    names: tuple[str, ...]
    relations: tuple[Relation, ...]
    roots: tuple[tuple[Tree, str, Terms], ...]
    arcs: dict[Tree, str]
    components: tuple[Component, ...]
    instance: Instance | None

    @property
    def outcome(self) -> Outcome:
        outcomes = {component.outcome for component in self.components}
        for outcome in (Outcome.REFUTED, Outcome.UNDECIDED):
            if outcome in outcomes:
                return outcome
        return Outcome.PROVED


def decide(statement: Statement, backend: str = BACKENDS[0]) -> Decision:
    """Prove or refute a statement in the ring of its symbols."""
    evaluator = Evaluator(statement, backend)
    sides = components(evaluator.value(statement.lhs)), components(evaluator.value(statement.rhs))
    if len(sides[0]) != len(sides[1]):
        raise NotationError(f"{statement.id}: the sides have {len(sides[0])} and {len(sides[1])} components")
    reduced = [_reduced(evaluator, left - right) for left, right in zip(*sides, strict=True)]
    instance, refuted = _instance(evaluator, sides, [bool(part.remainder) for part in reduced])
    parts = tuple(
        replace(part, outcome=Outcome.REFUTED) if k in refuted else part for k, part in enumerate(reduced)
    )
    roots = tuple((root.radicand, root.generator, evaluator.ring.terms(root.divisor)) for root in evaluator.roots)
    return Decision(statement, evaluator.ring.names, evaluator.relations, roots, evaluator.arcs, parts, instance)


def _reduced(evaluator: Evaluator, difference: Quotient) -> Component:
    ring = evaluator.ring
    numerator = ring.terms(difference.numerator)
    reduction = reduce(numerator, evaluator.relations, ring.index)
    outcome = Outcome.UNDECIDED if reduction.remainder else Outcome.PROVED
    return Component(
        outcome, numerator, _as_terms(evaluator, difference.factors), reduction.cofactors, reduction.remainder
    )


def _as_terms(evaluator: Evaluator, factors: Factors) -> tuple[tuple[Terms, int], ...]:
    return tuple(
        sorted(((evaluator.ring.terms(factor), times) for factor, times in factors), key=lambda item: text_of(item[0]))
    )


def _instance(evaluator: Evaluator, sides, open_parts: list[bool]) -> tuple[Instance | None, set[int]]:
    """A point at which every component with a remainder differs, or as many of them as one point shows."""
    best: tuple[Instance | None, set[int]] = (None, set())
    rounded = is_rounded(evaluator, sides[0] + sides[1])
    for point in sample_points(evaluator, ATTEMPTS if any(open_parts) else 4):
        left, right = ([value_at(part, point) for part in side] for side in sides)
        if any(value is None for value in left + right):
            continue
        differing = {
            k
            for k, (a, b) in enumerate(zip(left, right, strict=True))
            if a is not None and b is not None and open_parts[k] and abs(a - b) > (THRESHOLD if rounded else 0)
        }
        if best[0] is None or len(differing) > len(best[1]):
            best = Instance(point, tuple(left), tuple(right), rounded), differing
        if len(best[1]) == sum(open_parts):
            break
    return best
