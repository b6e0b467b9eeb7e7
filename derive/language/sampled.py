"""Expressions evaluated at places where nothing vanishes by chance: a guard against slips, not a proof.

The record proves what a derivation claims; here a claim that is false is noticed where it is made.
"""

import mpmath
import sympy as sp

DIGITS, NEGLIGIBLE, PLACES = 60, mpmath.mpf(10) ** -40, 3

_FUNCTIONS = {sp.sin: mpmath.sin, sp.cos: mpmath.cos, sp.tan: mpmath.tan, sp.atan2: mpmath.atan2, sp.Abs: abs}


def sampled(expressions):
    """Values of the expressions at each of a few places of their symbols, in 60 digits."""
    expressions = [sp.sympify(e) for e in expressions]
    symbols = sorted(set().union(*(e.free_symbols for e in expressions)), key=str)
    for k in range(PLACES):
        with mpmath.workdps(DIGITS):
            values = {q: mpmath.mpf(3 * k + n + 2) / (7 + 2 * n) for n, q in enumerate(symbols)}
            yield [_value(e, values) for e in expressions]


def vanishes(expression):
    """Whether an expression is zero at every place."""
    return all(abs(value) < NEGLIGIBLE for (value,) in sampled([expression]))


def _value(e, known):
    if e not in known:
        arguments = [_value(a, known) for a in e.args]
        if e.is_Add:
            known[e] = mpmath.fsum(arguments)
        elif e.is_Mul:
            known[e] = mpmath.fprod(arguments)
        elif e.is_Pow:
            known[e] = mpmath.power(*arguments)
        elif e.is_number and not e.args:
            known[e] = mpmath.mpf(e.p) / e.q if e.is_Rational else mpmath.mpf(sp.N(e, DIGITS))
        else:
            known[e] = _FUNCTIONS[e.func](*arguments)
    return known[e]
