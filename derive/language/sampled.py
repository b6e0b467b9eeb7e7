"""Expressions in numbers: at given places, or where nothing vanishes by chance, a guard against slips, not a proof.

The record proves what a derivation claims; here a claim that is false is noticed where it is made.
"""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import mpmath
import sympy as sp

from derive.language.definitions import Definitions
from derive.language.prefix import node
from derive.language.vectors import Number
from meshwright.base.expression import Evaluator, real_operations

DIGITS, NEGLIGIBLE, PLACES = 60, mpmath.mpf(10) ** -40, 3

_OPERATIONS = real_operations(mpmath, mpmath.power)


class NoValue(ArithmeticError):
    """An expression without a real value where it is evaluated."""


def value_of(expression: Number, values: Mapping[Any, Any], definitions: Definitions) -> mpmath.mpf:
    """Value of the expression where its symbols have values (symbol → number) or are defined; NaN where one that it
    needs is. Raises :class:`NoValue` where it divides by zero or leaves the real numbers.
    """
    whole = sp.sympify(expression)
    known = {q.name: mpmath.mpf(values[q]) for q in definitions.free(whole) if q in values}
    try:
        value = _evaluator(known, definitions)(whole)
        return value if mpmath.isnan(value) else mpmath.mpf(value)
    except (ArithmeticError, AttributeError, TypeError, ValueError) as error:  # what is said to complex numbers too
        raise NoValue(f"{whole} has no real value") from error


def sampled(expressions: Iterable[Number]) -> Iterator[list[mpmath.mpf]]:
    """Values of the expressions at each of a few places of their symbols, in 60 digits."""
    wanted = [sp.sympify(e) for e in expressions]
    symbols = sorted({q for e in wanted for q in e.free_symbols}, key=str)
    for k in range(PLACES):
        with mpmath.workdps(DIGITS):
            roots = [mpmath.sqrt(sp.prime(1 + k + PLACES * n)) for n in range(len(symbols))]
            values = {q.name: root - mpmath.floor(root) for q, root in zip(symbols, roots, strict=True)}
            yield list(map(_evaluator(values, Definitions()), wanted))


def vanishes(expression: sp.Expr) -> bool:
    """Whether an expression is zero at every place."""
    return all(abs(value) < NEGLIGIBLE for (value,) in sampled([expression]))


def _evaluator(known: Mapping[str, mpmath.mpf], definitions: Definitions) -> Evaluator[mpmath.mpf]:
    """Evaluates SymPy's expressions, and numbers without an exact form, which are refused elsewhere."""
    named = {symbol.name: value for symbol, value in definitions.items() if symbol.name not in known}

    def read(part: "int | sp.Expr") -> Any:  # noqa: ANN401  an expression as data, or a number of SymPy
        inexact = not isinstance(part, int | sp.Rational) and part.is_number and not part.args
        return part if isinstance(part, int) or inexact else node(part)

    def leaf(part: "str | int | sp.Expr") -> mpmath.mpf:
        if isinstance(part, str):
            return evaluator(named[part]) if part in named else known[part]
        return mpmath.mpf(part if isinstance(part, int) else sp.N(part, DIGITS))

    evaluator: Evaluator[mpmath.mpf] = Evaluator(leaf, _OPERATIONS, key=lambda part: part, read=read)
    return evaluator
