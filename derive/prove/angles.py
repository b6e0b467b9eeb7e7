"""Angles: integer combinations of base angles, plus quarter turns.

A base angle is a symbol, or a defined name whose definition is no such combination (a rolling length over a radius,
say): its cosine and sine are then generators of their own, moving at the rate of its value.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from derive.prove.tree import NotationError, Tree

PI = "pi"


@dataclass(frozen=True)
class BaseAngle:
    """The angle symbol / divisor whose cosine and sine are ring generators."""

    symbol: str
    divisor: int

    @property
    def name(self) -> str:
        return self.symbol if self.divisor == 1 else f"{self.symbol}/{self.divisor}"

    @property
    def cosine(self) -> str:
        return f"cos({self.name})"

    @property
    def sine(self) -> str:
        return f"sin({self.name})"


def linear_form(tree: Tree, definitions: Mapping[str, Tree]) -> dict[str, Fraction]:
    """An angle as rational multiples of symbols and of pi."""
    if isinstance(tree, str):
        if tree in definitions and (form := _form_of(definitions[tree], definitions)) is not None:
            return form
        return {tree: Fraction(1)}
    if tree == 0:
        return {}
    if isinstance(tree, tuple):
        match tree[0]:
            case "+":
                return _sum(linear_form(term, definitions) for term in tree[1:])
            case "-":
                return _scaled(linear_form(tree[1], definitions), Fraction(-1))
            case "/" if isinstance(tree[2], int):
                return _scaled(linear_form(tree[1], definitions), Fraction(1, tree[2]))
            case "*" if isinstance(tree[1], int) and len(tree) == 3:
                return _scaled(linear_form(tree[2], definitions), Fraction(tree[1]))
    raise NotationError(f"not an angle (a rational combination of symbols): {tree!r}")


def _form_of(tree: Tree, definitions: Mapping[str, Tree]) -> dict[str, Fraction] | None:
    try:
        return linear_form(tree, definitions)
    except NotationError:
        return None


def _sum(forms) -> dict[str, Fraction]:
    total: dict[str, Fraction] = {}
    for form in forms:
        for symbol, factor in form.items():
            total[symbol] = total.get(symbol, Fraction(0)) + factor
    return {symbol: factor for symbol, factor in total.items() if factor}


def _scaled(form: dict[str, Fraction], factor: Fraction) -> dict[str, Fraction]:
    return {symbol: factor * value for symbol, value in form.items()}


def base_angles(forms: list[dict[str, Fraction]]) -> list[BaseAngle]:
    """One base angle per symbol, fine enough for every form that uses it."""
    divisors: dict[str, int] = {}
    for form in forms:
        for symbol, factor in form.items():
            if symbol != PI:
                divisors[symbol] = lcm(divisors.get(symbol, 1), factor.denominator)
    return [BaseAngle(symbol, divisors[symbol]) for symbol in sorted(divisors)]


def quarter_turns(form: Mapping[str, Fraction]) -> int:
    """How many right angles the multiple of pi in a form is."""
    turns = 2 * form.get(PI, Fraction(0))
    if turns.denominator != 1:
        raise NotationError(f"only multiples of a right angle may stand beside symbols, not {turns / 2} pi")
    return int(turns)
