"""Roots of a system of equations in many digits, from a start that is good to double precision."""

import mpmath
import numpy as np
from mpmath import mpf


def jacobian(residual, x):
    """∂(residual)/∂x (n, n) in doubles: central differences in many digits, exact to more than double precision."""
    columns, step = [], mpf(10) ** -15
    for k in range(len(x)):
        ends = [residual([v + h * (j == k) for j, v in enumerate(x)]) for h in (step, -step)]
        columns.append([float((a - b) / (2 * step)) for a, b in zip(*ends, strict=True)])
    return np.array(columns).T


def chords(residual, start, inverse=None, digits=None):
    """The root near ``start``, to ten digits less than the working precision unless ``digits`` says how many.

    ``inverse`` is an approximate inverse of the Jacobian there, which is formed if it is not given.
    """
    x = [mpf(v) if isinstance(v, mpf) else mpf(float(v)) for v in start]
    inverse = np.linalg.inv(jacobian(residual, x)) if inverse is None else inverse
    for _ in range(40):
        value = residual(x)
        size = max(map(abs, value))
        if size < mpf(10) ** -(digits or mpmath.mp.dps - 10):
            return x
        change = inverse @ np.array([float(r / size) for r in value])
        x = [v - size * mpf(float(c)) for v, c in zip(x, change, strict=True)]
    raise ArithmeticError("the chords do not settle")
