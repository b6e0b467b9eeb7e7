"""Values of the expressions of a description: nested prefix lists over named symbols and exact numbers.

``"m_n"`` is a symbol, ``3`` an integer, ``["/", 1, 4]`` a quotient, ``["*", "m_n", ["cos", "alpha"]]`` a product. What
is not a number (an open parameter, a root of a negative number) makes what depends on it not a number.
"""

import math

import numpy as np

_OPERATIONS = {
    "+": lambda *terms: math.fsum(terms) if all(map(math.isfinite, terms)) else math.nan,
    "*": lambda *factors: math.prod(factors),
    "/": lambda p, q: p / q,
    "^": lambda base, exponent: float(base) ** exponent,
    "pi": lambda: math.pi,
    "sqrt": math.sqrt, "sin": math.sin, "cos": math.cos, "tan": math.tan, "asin": math.asin, "acos": math.acos,
    "atan": math.atan, "atan2": math.atan2, "abs": abs, "sign": lambda x: float(np.sign(x)),
    "min": lambda *values: float(np.min(values)), "max": lambda *values: float(np.max(values)),
    "unit_step": lambda x: float(np.heaviside(x, 0.5)), "excess": lambda x: max(x, 0.0),
}  # fmt: skip


def value(expression, symbols):
    """The value of an expression; ``symbols`` are numbers by name, NaN where they are open."""
    if isinstance(expression, str):
        return float(symbols[expression])
    if isinstance(expression, int | float):
        return float(expression)
    operation, *operands = expression
    numbers = [value(operand, symbols) for operand in operands]
    if any(map(math.isnan, numbers)):
        return math.nan
    try:
        result = _OPERATIONS[operation](*numbers)
    except (ValueError, ZeroDivisionError, OverflowError):
        return math.nan
    return math.nan if isinstance(result, complex) else float(result)


def completed(rules, symbols):
    """``symbols`` with what rules (pairs of a name and an expression), in their order, give to those that are open."""
    known = dict(symbols)
    for name, expression in rules:
        if math.isnan(known[name]):
            known[name] = value(expression, known)
    return known
