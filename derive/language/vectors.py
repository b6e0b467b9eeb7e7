"""Three-vectors of SymPy expressions as plain tuples: nothing is expanded, simplified or evaluated.

Roots and arcs are built here without the questions that SymPy asks (is it zero, finite, real): of gear
parameters they have no answer, and the search for one takes longer than a derivation.
"""

import sympy as sp

I, J, K = (1, 0, 0), (0, 1, 0), (0, 0, 1)
AXES = {"x": I, "y": J, "z": K}


def vector(x, y, z):
    """A vector from three SymPy-compatible numbers or expressions."""
    return tuple(sp.sympify(c) for c in (x, y, z))


def add(a, b):
    return tuple(p + q for p, q in zip(a, b, strict=True))


def sub(a, b):
    return tuple(p - q for p, q in zip(a, b, strict=True))


def scale(factor, a):
    return tuple(_times(factor, p) for p in a)


def signed(sign, a):
    """A vector times ±1, where that occurs in its components already: sign² = 1."""
    return tuple(sp.expand(sign * sp.sympify(p)).subs(sp.sympify(sign) ** 2, 1) for p in a)


def dot(a, b):
    return sp.Add(*(_times(p, q) for p, q in zip(a, b, strict=True)))


def cross(a, b):
    return tuple(_times(a[i], b[j]) - _times(a[j], b[i]) for i, j in ((1, 2), (2, 0), (0, 1)))


def _times(p, q):
    """p q, without asking whether a factor of zero is finite."""
    return sp.S.Zero if p == 0 or q == 0 else p * q


def unit(a):
    """The vector over its length."""
    length = norm(a)
    return tuple(p / length for p in a)


def norm(a):
    return root(dot(a, a))


def radius(x, y):
    """√(x² + y²)."""
    return root(x**2 + y**2)


def root(a):
    return sp.Pow(a, sp.Rational(1, 2), evaluate=not sp.sympify(a).is_Add)


def arc(y, x):
    """Angle of the direction (x, y)."""
    return sp.atan2(y, x, evaluate=False)


def circle_centre(a, b, c):
    """Centre of the circle through three points, and a normal of its plane (zero where they are in line)."""
    p, q = sub(a, b), sub(c, b)
    normal = cross(p, q)
    offset = cross(sub(scale(dot(p, p), q), scale(dot(q, q), p)), normal)
    return add(b, scale(1 / (2 * dot(normal, normal)), offset)), normal
