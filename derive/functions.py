"""Functions that a drive offers beside its contact: placements, limit points, axes, of arguments of their own.

A function's results are expressions in the design, the drive's definitions and the function's arguments; it is
scheduled on the drive's tape and printed like a flank.
"""

from dataclasses import dataclass

import sympy as sp


@dataclass(frozen=True)
class Result:
    """A named result: one number or several, with their unit and frame."""

    name: str
    values: tuple
    unit: str = ""
    frame: str = ""


@dataclass(frozen=True)
class Function:
    """``results`` as a function of ``arguments`` (symbols) and the design."""

    name: str
    meaning: str
    arguments: tuple
    results: tuple[Result, ...]


def cosine_form(expression, angle):
    """Coefficients (a, b, c) of an expression that reads a·cos + b·sin − c in one angle.

    Raises ``ValueError`` for any other form.
    """
    cosine, sine = sp.Symbol("_cos"), sp.Symbol("_sin")
    form = sp.sympify(expression).xreplace({sp.cos(angle): cosine, sp.sin(angle): sine})
    a, b = sp.diff(form, cosine), sp.diff(form, sine)
    if {cosine, sine, angle} & (a.free_symbols | b.free_symbols):
        raise ValueError("the expression is not linear in the cosine and sine of one angle")
    return a, b, -form.xreplace({cosine: sp.Integer(0), sine: sp.Integer(0)})


def solve_cosine_form(a, b, c):
    """Both angles with a·cos + b·sin = c; not a number where there is none (a² + b² < c²)."""
    middle, half = sp.atan2(b, a), sp.atan2(sp.sqrt(a**2 + b**2 - c**2), c)
    return middle + half, middle - half
