"""A first design: how a family turns module and numbers of teeth into a design file, and why each size is what it is.

Suggestions are made in order; each may use the options and the suggestions before it, under their names. Nothing here
takes part in analysis: the file that is written gives its numbers like any other.
"""

from dataclasses import dataclass, field

import sympy as sp

from derive.language.symbols import Quantity

#: What a person gives: module (mm), numbers of teeth or threads, centre distance (mm; not a number if left out).
m, z_1, z_2, a = (Quantity(name, unit) for name, unit in (("m", "mm"), ("z_1", ""), ("z_2", ""), ("a", "mm")))
OPTIONS = m, z_1, z_2, a


@dataclass(frozen=True)
class Suggestion:
    """``place`` ("table.key") takes the first of ``values`` that is a number, in the unit of the key; none: it is open.

    Without a place it only has a ``name`` by which later suggestions use it. ``decimals`` round it, ``whole`` makes it
    an integer. ``why`` becomes the comment in the file. ``words`` are those of the drives that it is for ("key" →
    words), if not for all; of two suggestions for one place or name, the later counts if it is a number. ``within`` are
    the least and the largest value of a sound design: beyond them the options contradict each other.
    """

    place: str
    values: tuple[sp.Expr | int, ...]
    why: str = ""
    name: str = ""
    decimals: int | None = None
    whole: bool = False
    words: dict[str, tuple[str, ...]] = field(default_factory=dict)
    within: tuple[sp.Expr | float, sp.Expr | float] | None = None

    @property
    def symbol(self) -> sp.Symbol:
        """The name by which later suggestions use this one."""
        return sp.Symbol(self.name or self.place.replace(".", "_"), real=True)


@dataclass(frozen=True)
class Outline:
    """What ``meshwright new`` needs of a family: what its options mean, words that choose a drive, suggestions.

    ``apart`` are words (key → words) of which no first design has all together, each with the reason.
    """

    options: dict[str, str]
    words: dict[str, str]
    suggestions: tuple[Suggestion, ...]
    apart: tuple[tuple[dict[str, tuple[str, ...]], str], ...] = ()
