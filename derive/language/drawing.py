"""What a drawing states: named sizes, the relations between them, and what is assumed of those that it leaves open.

A drawing gives any closed subset of sizes. Relations complete it (:mod:`meshwright.design.relations`): a size that is
given stays as it is; a relation with one open size derives that; where nothing moves, the next default is assumed; a
relation without open sizes is a check. Keys of a design and sizes beside them are alike in this.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import sympy as sp

from derive.language.differentiate import partial
from derive.language.replace import replaced
from derive.language.symbols import Guard, Parameter, Quantity, Rule


@dataclass(frozen=True)
class Root:
    """The ``unknown`` between ``low`` and ``high`` at which a monotone ``residual`` vanishes; ``where`` are quantities
    that it reads, each found from the unknown and those before it.
    """

    unknown: Quantity
    residual: sp.Expr
    low: sp.Expr
    high: sp.Expr
    where: "tuple[tuple[Quantity, sp.Expr | Root], ...]" = ()


@dataclass(frozen=True)
class Relation:
    """``size`` = ``value``; ``solutions`` are what other sizes of the relation then are, where it is solved for them.

    A check compares in the unit of the size: a length is the best choice.
    """

    size: Quantity
    value: "sp.Expr | Root"
    solutions: Mapping[Quantity, "sp.Expr | Root"] = field(default_factory=dict["Quantity", "sp.Expr | Root"])


def relation(size: Quantity, value: sp.Expr, *linear: Quantity, **closed: "sp.Expr | Root") -> Relation:
    """The relation ``size`` = ``value``, solved for the sizes in which it is ``linear``, and for those whose ``closed``
    solution is given by the name of their symbol.
    """
    solutions: dict[Quantity, sp.Expr | Root] = {}
    for q in linear:
        slope = partial(value, q)
        if slope.has(q):
            raise ValueError(f"{size} = {value} is not linear in {q}: give its solution")
        solutions[q] = (size - replaced(value, {q: sp.Integer(0)})) / slope
    named = {q.name: q for q in value.free_symbols if isinstance(q, Quantity)}
    return Relation(size, value, solutions | {named[name]: solution for name, solution in closed.items()})


@dataclass(frozen=True)
class Assumed:
    """``target`` is taken to be ``value``, for the reason ``why``, where nothing else gives it.

    Only where every size of ``needs`` is known; not where one of ``unless`` is given.
    """

    target: Quantity
    value: sp.Expr
    why: str
    needs: tuple[Quantity, ...] = ()
    unless: tuple[Quantity, ...] = ()


@dataclass(frozen=True)
class Check:
    """Something that ``occurs`` where the ``margin`` is negative; or else is possible where it is positive.

    ``meaning`` says what, and what may be done about it.
    """

    name: str
    margin: sp.Expr
    meaning: str = ""
    occurs: bool = True


@dataclass(frozen=True)
class Elsewhere:
    """Where ``positive`` > 0, an expression of one size, a drawing is of another ``family``, which has ``what``."""

    positive: sp.Expr
    family: str
    what: str


@dataclass(frozen=True)
class Drawing:
    """What drawings of a family state beside its keys.

    ``sizes`` are named like keys; one of a drive's own sizes is named here to give it a symbol. ``defaults`` are tried
    in their order, before what completes the drive: of those targets nothing else is assumed. ``guards`` say what no
    drive of the family is, and what to do instead; ``elsewhere`` what another family is for.
    """

    sizes: tuple[Parameter, ...]
    relations: tuple[Relation, ...]
    defaults: tuple[Assumed | Rule, ...]
    checks: tuple[Check, ...] = ()
    guards: tuple[Guard, ...] = ()
    elsewhere: tuple[Elsewhere, ...] = ()
