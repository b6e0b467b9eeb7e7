"""Interpolating cubic splines as weights of the values at their knots: smooth, with exact slopes."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Knots:
    """Ascending places (n,), n from 2 on, and the matrix (n, n) from values there to the second derivatives of the
    spline with equal third derivatives across the first and the last inner knot: a line for two, a parabola for three.
    """

    places: np.ndarray
    bending: np.ndarray

    @classmethod
    def at(cls, places):
        places = np.asarray(places, dtype=float)
        n, h = len(places), np.diff(places)
        matrix, right = np.eye(n), np.zeros((n, n))
        for k in range(1, n - 1):
            matrix[k, k - 1 : k + 2] = h[k - 1], 2.0 * (h[k - 1] + h[k]), h[k]
            right[k, k - 1 : k + 2] = 6.0 / h[k - 1], -6.0 / h[k - 1] - 6.0 / h[k], 6.0 / h[k]
        if n == 3:
            matrix[0, 1] = matrix[2, 1] = -1.0
        elif n > 3:
            matrix[0, :3] = h[1], -h[0] - h[1], h[0]
            matrix[-1, -3:] = h[-1], -h[-2] - h[-1], h[-2]
        return cls(places, np.linalg.solve(matrix, right))

    def weights(self, x):
        """Weights (P, n) of the values at the knots for the value at x (P,), its slope and its second derivative."""
        p, x = self.places, np.asarray(x, dtype=float)
        k = np.clip(np.searchsorted(p, x, side="right") - 1, 0, len(p) - 2)
        rows, h = np.arange(len(x)), np.diff(p)[k]
        b = (x - p[k]) / h
        a = 1.0 - b
        value, slope = np.zeros((2, len(x), len(p)))
        value[rows, k], value[rows, k + 1] = a, b
        slope[rows, k], slope[rows, k + 1] = -1.0 / h, 1.0 / h
        first, second = self.bending[k], self.bending[k + 1]
        value += ((a**3 - a) * h**2 / 6.0)[:, None] * first + ((b**3 - b) * h**2 / 6.0)[:, None] * second
        slope += ((1.0 - 3.0 * a**2) * h / 6.0)[:, None] * first + ((3.0 * b**2 - 1.0) * h / 6.0)[:, None] * second
        return value, slope, a[:, None] * first + b[:, None] * second
