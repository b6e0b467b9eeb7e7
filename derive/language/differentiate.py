"""Partial derivatives of expressions, each distinct part differentiated once.

The rules are SymPy's own, taken without the questions (is it zero, is it finite) that its ``diff`` asks of every part.
"""

import sympy as sp

from derive.language.vectors import Number


def partial(expression: Number, variable: sp.Expr) -> sp.Expr:
    """∂expression/∂variable of sums, products, powers and functions that know their own derivative (``fdiff``)."""
    return _partial(sp.sympify(expression), variable, {})


def _partial(expression: sp.Expr, variable: sp.Expr, known: dict[sp.Expr, sp.Expr]) -> sp.Expr:
    if expression == variable:
        return sp.S.One
    if not expression.args:
        return sp.S.Zero
    if expression not in known:
        inner = [_partial(argument, variable, known) for argument in expression.args]
        moved = any(d is not sp.S.Zero for d in inner)
        known[expression] = _chain_rule(expression, inner) if moved else sp.S.Zero
    return known[expression]


def _chain_rule(expression: sp.Expr, inner: list[sp.Expr]) -> sp.Expr:
    """The derivative from those of the arguments."""
    if isinstance(expression, sp.Add):
        return sp.Add(*inner)
    if isinstance(expression, sp.Mul):
        return sp.Add(*(_product(expression.args, k, d) for k, d in enumerate(inner) if d != 0))
    if isinstance(expression, sp.Pow) and inner[1] == 0:
        base, exponent = expression.args
        return exponent * base ** (exponent - 1) * inner[0]
    if isinstance(expression, sp.sign):  # constant on either side
        return sp.S.Zero
    if not isinstance(expression, sp.Function):
        raise ValueError(f"{expression} has no derivative here; use sums, products, powers and functions")
    return sp.Add(*(expression.fdiff(k) * d for k, d in enumerate(inner, 1) if d != 0))


def _product(factors: tuple[sp.Expr, ...], k: int, derivative: sp.Expr) -> sp.Expr:
    return sp.Mul(*factors[:k], derivative, *factors[k + 1 :])
