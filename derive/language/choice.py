"""Expressions that depend on whether a number is zero or positive, exact in floating point."""

import sympy as sp

#: Squares below this are zero.
_NOTHING = sp.Rational(1, 10**300)


class unit_step(sp.Function):  # noqa: N801 (written like a function)
    """1 where the argument is not negative, else 0; constant on either side."""

    nargs = 1
    is_real = True

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        return sp.S.Zero


class excess(sp.Function):  # noqa: N801
    """(a)₊: the argument where it is positive, else 0. Its powers have all derivatives that are continuous."""

    nargs = 1
    is_real = True

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        return unit_step(self.args[0])


def is_zero(a: sp.Expr) -> sp.Expr:
    """1 where ``a`` is 0, else 0."""
    return unit_step(_NOTHING - a**2)


def only_where_zero(a: sp.Expr, value: sp.Expr) -> sp.Expr:
    """``value`` where ``a`` is 0, else not a number: what has a default only as long as something else is not used."""
    return only_where_not_negative(_NOTHING - a**2, value)


def only_where_within(most: sp.Expr, a: sp.Expr, value: sp.Expr) -> sp.Expr:
    """``value`` where ``a`` is at most ``most`` from 0, else not a number."""
    return only_where_not_negative(most**2 - a**2, value)


def only_where_not_negative(a: sp.Expr, value: sp.Expr) -> sp.Expr:
    """``value`` where ``a`` is not negative, else not a number."""
    return value * sp.sqrt(sp.sign(a))
