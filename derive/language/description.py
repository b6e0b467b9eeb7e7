"""A drive's description as plain data: what a checker, the runtime or a page reads instead of our Python.

Expressions are nested prefix lists over named symbols and exact numbers.
"""

import sympy as sp

from derive.language.choice import excess, unit_step

_FUNCTIONS = {
    sp.sin: "sin", sp.cos: "cos", sp.tan: "tan", sp.asin: "asin", sp.acos: "acos", sp.atan: "atan",
    sp.atan2: "atan2", sp.Abs: "abs", sp.Min: "min", sp.Max: "max", sp.sign: "sign",
    unit_step: "unit_step", excess: "excess",
}  # fmt: skip


def prefix(expression):
    """An expression as a prefix list: a symbol's name, an integer, or ``[operation, operand, …]``.

    Rational numbers are ``["/", p, q]``. Raises TypeError for what has no exact form.
    """
    expression = sp.sympify(expression)
    if expression.is_Symbol:
        return expression.name
    if expression.is_Integer:
        return int(expression)
    if expression.is_Rational:
        return ["/", int(expression.p), int(expression.q)]
    if expression is sp.pi:
        return ["pi"]
    operands = [prefix(argument) for argument in expression.args]
    if expression.is_Add:
        return ["+", *operands]
    if expression.is_Mul:
        return ["*", *operands]
    if expression.is_Pow:
        return ["sqrt", operands[0]] if expression.exp == sp.Rational(1, 2) else ["^", *operands]
    if expression.func in _FUNCTIONS:
        return [_FUNCTIONS[expression.func], *operands]
    raise TypeError(f"{expression} has no exact form in a description")
