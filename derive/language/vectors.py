"""Three-vectors of SymPy expressions as plain tuples: nothing is expanded, simplified or evaluated.

Roots and arcs are built here without the questions that SymPy asks (is it zero, finite, real): of gear
parameters they have no answer, and the search for one takes longer than a derivation.
"""

from collections.abc import Iterable
from functools import reduce
from typing import TypeAlias

import sympy as sp

#: What SymPy takes for an expression.
Number: TypeAlias = sp.Expr | int | float

#: Three components.
Vector: TypeAlias = tuple[sp.Expr, ...]

_0, _1 = sp.S.Zero, sp.S.One
I, J, K = (_1, _0, _0), (_0, _1, _0), (_0, _0, _1)
AXES = {"x": I, "y": J, "z": K}
ORIGIN = (_0, _0, _0)


def vector(x: Number, y: Number, z: Number) -> Vector:
    """A vector from three SymPy-compatible numbers or expressions."""
    return tuple(sp.sympify(c) for c in (x, y, z))


def add(a: Vector, b: Vector) -> Vector:
    return tuple(p + q for p, q in zip(a, b, strict=True))


def sub(a: Vector, b: Vector) -> Vector:
    return tuple(p - q for p, q in zip(a, b, strict=True))


def scale(factor: Number, a: Vector) -> Vector:
    return tuple(times(factor, p) for p in a)


def combined(factors: Vector, vectors: Iterable[Vector]) -> Vector:
    """The sum of vectors, each times its factor."""
    return reduce(add, (scale(c, a) for c, a in zip(factors, vectors, strict=True)))


def signed(sign: Number, a: Vector) -> Vector:
    """A vector times ±1, where that occurs in its components already: sign² = 1."""
    return tuple(sp.expand(sp.sympify(p) * sign).subs(sp.sympify(sign) ** 2, 1) for p in a)


def dot(a: Vector, b: Vector) -> sp.Expr:
    return sp.Add(*(times(p, q) for p, q in zip(a, b, strict=True)))


def cross(a: Vector, b: Vector) -> Vector:
    return tuple(times(a[i], b[j]) - times(a[j], b[i]) for i, j in ((1, 2), (2, 0), (0, 1)))


def times(p: Number, q: sp.Expr) -> sp.Expr:
    """p q, without asking whether a factor of zero is finite, or the terms of a sum under a root."""
    if p == 0 or q == 0:
        return sp.S.Zero
    return p * q if sp.S.One in (p, q) or not (_of_sum(p) or _of_sum(q)) else sp.Mul(p, q, evaluate=False)


def _of_sum(a: Number) -> bool:
    return isinstance(a, sp.Pow) and isinstance(a.base, sp.Add)


def unit(a: Vector) -> Vector:
    """The vector over its length."""
    length = norm(a)
    return tuple(p / length for p in a)


def norm(a: Vector) -> sp.Expr:
    return root(dot(a, a))


def radius(x: sp.Expr, y: sp.Expr) -> sp.Expr:
    """√(x² + y²)."""
    return root(_power(x, 2) + _power(y, 2))


def root(a: Number) -> sp.Expr:
    return _power(sp.sympify(a), sp.Rational(1, 2))


def _power(a: sp.Expr, exponent: Number) -> sp.Expr:
    """A power, of a sum without asking whether its terms are finite."""
    return sp.Pow(a, exponent, evaluate=not isinstance(a, sp.Add))


def sine(angle: Number) -> sp.Expr:
    """sin angle, of a sum or product without asking whether it is real."""
    angle = sp.sympify(angle)
    if not _composed(angle):
        return sp.sin(angle)
    return -sp.sin(-angle, evaluate=False) if angle.could_extract_minus_sign() else sp.sin(angle, evaluate=False)


def cosine(angle: Number) -> sp.Expr:
    """cos angle, of a sum or product without asking whether it is real."""
    angle = sp.sympify(angle)
    if not _composed(angle):
        return sp.cos(angle)
    return sp.cos(-angle if angle.could_extract_minus_sign() else angle, evaluate=False)


def _composed(angle: sp.Expr) -> bool:
    return isinstance(angle, sp.Add | sp.Mul) and not angle.has(sp.pi)


def arc(y: Number, x: Number) -> sp.Expr:
    """Angle of the direction (x, y)."""
    return sp.atan2(y, x, evaluate=False)


def circle_centre(a: Vector, b: Vector, c: Vector) -> tuple[Vector, Vector]:
    """Centre of the circle through three points, and a normal of its plane (zero where they are in line)."""
    p, q = sub(a, b), sub(c, b)
    normal = cross(p, q)
    offset = cross(sub(scale(dot(p, p), q), scale(dot(q, q), p)), normal)
    return add(b, scale(1 / (2 * dot(normal, normal)), offset)), normal
