"""Limits that a surface has by itself: where it is singular (an edge of regression, the edge of an undercut)."""


def singular_function(lower, surface):
    """Node of the function that vanishes where a surface is singular, body frame.

    Explicit surface: (∂r/∂a × ∂r/∂b)·n. Envelope with its condition f(a, b, c) = 0: the sum over cyclic (a, b, c)
    of f_a n·(∂r/∂b × ∂r/∂c).
    """
    tape = lower.tape
    parameters = [lower(p) for p in surface.parameters]
    point = [lower(c) for c in surface.body_point()]
    normal = [lower(c) for c in surface.body_normal()]
    tangents = [[tape.derivative(i, p) for i in point] for p in parameters]
    if not surface.conditions:
        return tape.triple(normal, *tangents)
    (condition,) = surface.conditions
    a, b, c = tangents
    slopes = [tape.derivative(lower(condition), p) for p in parameters]
    total = tape.constant(0)
    for slope, pair in zip(slopes, ((b, c), (c, a), (a, b)), strict=True):
        total = tape.add(total, tape.mul(slope, tape.triple(normal, *pair)))
    return total
