"""Vectors of three numbers in any arithmetic, for what is written down a second time."""

import mpmath as mp


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def rotate(axis, angle, a, m=mp):
    """Active right-handed rotation about a coordinate axis, in the arithmetic m."""
    c, s = m.cos(angle), m.sin(angle)
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    out = list(a)
    out[i], out[j] = c * a[i] - s * a[j], s * a[i] + c * a[j]
    return out
