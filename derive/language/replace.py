"""Expressions with parts replaced, each distinct part rebuilt once.

As SymPy's ``xreplace``, without the question (is it infinite) that its powers ask of every sum.
"""

from collections.abc import Mapping
from typing import TypeVar

import sympy as sp

from derive.language.vectors import Number

_Part = TypeVar("_Part", bound=sp.Expr)


def replaced(expression: Number, replacement: Mapping[_Part, sp.Expr]) -> sp.Expr:
    """The expression with the keys of ``replacement`` (expression → expression) replaced by their values."""
    return _replaced(sp.sympify(expression), dict(replacement.items()), {})


def _replaced(expression: sp.Expr, replacement: Mapping[sp.Expr, sp.Expr], known: dict[sp.Expr, sp.Expr]) -> sp.Expr:
    if expression in replacement:
        return replacement[expression]
    if not expression.args:
        return expression
    if expression not in known:
        arguments = [_replaced(argument, replacement, known) for argument in expression.args]
        same = all(new is old for new, old in zip(arguments, expression.args, strict=True))
        known[expression] = expression if same else _rebuilt(expression, arguments)
    return known[expression]


def _rebuilt(expression: sp.Expr, arguments: list[sp.Expr]) -> sp.Expr:
    if isinstance(expression, sp.Pow) and isinstance(arguments[0], sp.Add):
        return sp.Pow(*arguments, evaluate=False)
    return expression.func(*arguments)
