"""Expressions with parts replaced, each distinct part rebuilt once.

As SymPy's ``xreplace``, without the question (is it infinite) that its powers ask of every sum.
"""

import sympy as sp


def replaced(expression, replacement):
    """The expression with the keys of ``replacement`` (expression → expression) replaced by their values."""
    return _replaced(sp.sympify(expression), replacement, {})


def _replaced(expression, replacement, known):
    if expression in replacement:
        return replacement[expression]
    if not expression.args:
        return expression
    if expression not in known:
        arguments = [_replaced(argument, replacement, known) for argument in expression.args]
        same = all(new is old for new, old in zip(arguments, expression.args, strict=True))
        known[expression] = expression if same else _rebuilt(expression, arguments)
    return known[expression]


def _rebuilt(expression, arguments):
    if expression.is_Pow and arguments[0].is_Add:
        return sp.Pow(*arguments, evaluate=False)
    return expression.func(*arguments)
