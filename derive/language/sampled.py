"""Expressions in numbers: at given places, or where nothing vanishes by chance, a guard against slips, not a proof.

The record proves what a derivation claims; here a claim that is false is noticed where it is made.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

import mpmath
import sympy as sp

from derive.language.choice import excess, unit_step
from derive.language.definitions import Definitions
from derive.language.vectors import Number

DIGITS, NEGLIGIBLE, PLACES = 60, mpmath.mpf(10) ** -40, 3


def _unit_step(a: mpmath.mpf) -> mpmath.mpf:
    return mpmath.mpf(a >= 0)


def _excess(a: mpmath.mpf) -> mpmath.mpf:
    return max(a, mpmath.mpf(0))


_FUNCTIONS: Mapping[Any, Callable[..., mpmath.mpf]] = {
    sp.sin: mpmath.sin, sp.cos: mpmath.cos, sp.tan: mpmath.tan, sp.atan2: mpmath.atan2, sp.Abs: mpmath.mpf.__abs__,
    sp.atan: mpmath.atan, sp.asin: mpmath.asin, sp.acos: mpmath.acos, sp.sign: mpmath.sign,
    unit_step: _unit_step, excess: _excess, sp.Min: min, sp.Max: max,
}  # fmt: skip

#: Functions that generated code computes.
COMPUTED = tuple(function for function in _FUNCTIONS if function not in (sp.Min, sp.Max))


class NoValue(ArithmeticError):
    """An expression without a real value where it is evaluated."""


def value_of(expression: Number, values: Mapping[Any, Any], definitions: Definitions) -> mpmath.mpf:
    """Value of the expression where its symbols have values (symbol → number) or are defined; NaN where one that it
    needs is. Raises :class:`NoValue` where it divides by zero or leaves the real numbers.
    """
    whole = sp.sympify(expression)
    known: dict[sp.Expr, mpmath.mpf] = {q: mpmath.mpf(values[q]) for q in definitions.free(whole) if q in values}
    try:
        value = _value(whole, known, definitions)
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
            values: dict[sp.Expr, mpmath.mpf] = {
                q: root - mpmath.floor(root) for q, root in zip(symbols, roots, strict=True)
            }
            yield [_value(e, values, Definitions()) for e in wanted]


def vanishes(expression: sp.Expr) -> bool:
    """Whether an expression is zero at every place."""
    return all(abs(value) < NEGLIGIBLE for (value,) in sampled([expression]))


def _value(e: sp.Expr, known: dict[sp.Expr, mpmath.mpf], definitions: Definitions) -> mpmath.mpf:
    if e not in known:
        arguments = [_value(a, known, definitions) for a in e.args]
        if isinstance(e, sp.Symbol):
            known[e] = _value(definitions[e], known, definitions)
        elif isinstance(e, sp.Add):
            known[e] = mpmath.fsum(arguments)
        elif isinstance(e, sp.Mul):
            known[e] = mpmath.fprod(arguments)
        elif isinstance(e, sp.Pow):
            known[e] = mpmath.power(*arguments)
        elif e.is_number and not e.args:
            known[e] = mpmath.mpf(e.p) / e.q if isinstance(e, sp.Rational) else mpmath.mpf(sp.N(e, DIGITS))
        else:
            known[e] = _FUNCTIONS[e.func](*arguments)
    return known[e]
