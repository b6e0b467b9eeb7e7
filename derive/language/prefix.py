"""SymPy's expressions as data: names, whole numbers and prefix lists (:mod:`meshwright.base.expression`)."""

from functools import cache
from typing import TypeAlias

import sympy as sp

from derive.language.choice import excess, unit_step
from derive.language.vectors import Number

#: An expression as plain data: see :func:`prefix`.
Prefix: TypeAlias = "str | int | list[Prefix]"

#: Functions that generated code computes.
COMPUTED: dict[type[sp.Expr], str] = {
    sp.sin: "sin", sp.cos: "cos", sp.tan: "tan", sp.asin: "asin", sp.acos: "acos", sp.atan: "atan",
    sp.atan2: "atan2", sp.Abs: "abs", sp.sign: "sign", unit_step: "unit_step", excess: "excess",
}  # fmt: skip
_OPERATIONS = {**COMPUTED, sp.Add: "+", sp.Mul: "*", sp.Min: "min", sp.Max: "max"}


def prefix(expression: Number) -> Prefix:
    """An expression as a prefix list: a symbol's name, an integer, or ``[operation, operand, …]``.

    Rational numbers are ``["/", p, q]``. Raises TypeError for what has no exact form.
    """
    return _prefix(sp.sympify(expression))


@cache
def _prefix(e: sp.Expr) -> Prefix:
    top = node(e)
    if not isinstance(top, tuple):
        return top
    return [_prefix(part) if isinstance(part, sp.Expr) else part for part in top]


def node(e: sp.Expr) -> "str | int | tuple[str | int | sp.Expr, ...]":
    """The uppermost part of an expression as data: a name, an integer, or an operation with SymPy's operands."""
    if isinstance(e, sp.Symbol):
        return e.name
    if isinstance(e, sp.Integer):
        return int(e)
    if isinstance(e, sp.Rational):
        return "/", int(e.p), int(e.q)
    if e is sp.pi:
        return ("pi",)
    if isinstance(e, sp.Pow):
        return ("sqrt", e.base) if e.exp == sp.Rational(1, 2) else ("^", *e.args)
    if e.func in _OPERATIONS:
        return _OPERATIONS[e.func], *e.args
    raise TypeError(f"{e} has no exact form in a description")
