"""Lines along which an envelope turns back: where undercut begins on the surface that a tool cuts.

An envelope in three parameters related by its equation of meshing is followed, at a fixed place of the tool's
profile, along the curve of the other two until its singular function changes sign.
"""

import numpy as np

#: Step along the curve and how far it is followed either way, in the parameters' units (rad).
STEP, FARTHEST = 0.1, 28.0

CORRECTIONS, HALVINGS = 25, 60


def edges(surface, profile, near=(0.0, 0.0)):
    """Where the surface becomes singular at this place of the profile, nearest either way to the place where the other
    two parameters are ``near`` some.

    ``surface`` is a :class:`~meshwright.flank.surface.Flank` of three parameters, the profile's first. Returns
    parameter triples (M, 3), M from 0 to 2; none if the surface is singular already where the curve starts, or the
    place of the profile generates nothing there.
    """
    start = begun(surface, profile, near)
    if start is None:
        return np.empty((0, 3))
    found = [_followed(surface, start, sign) for sign in (-1.0, 1.0)]
    return np.array([q for q in found if q is not None]).reshape(-1, 3)


def begun(surface, profile, near):
    """Where the curve of :func:`edges` starts; None if the surface is singular there, or generates nothing."""
    start = _on_curve(surface, np.array([profile, *near]))
    return None if start is None or surface([start]).regular[0] <= 0 else start


def _on_curve(surface, q):
    """The point of the curve next to q, by Newton along the gradient of the equation of meshing, or None."""
    for _ in range(CORRECTIONS):
        value, *slopes = surface([q]).conditions[0, 0]
        gradient = np.array([0.0, *slopes[1:]])
        change = value * gradient / (gradient @ gradient)
        if not np.all(np.isfinite(change)) or np.max(np.abs(change)) > 1.0:
            return None
        q = q - change
        if np.max(np.abs(change)) < 1e-13:
            return q
    return None


def _followed(surface, q, sign):
    """The first singular point along the curve from q, ahead or behind; None if there is none near."""
    ahead = sign * np.array([0.0, 0.0, 1.0])
    for _ in range(int(FARTHEST / STEP)):
        ahead = _direction(surface, q, ahead)
        following = _on_curve(surface, q + STEP * ahead)
        if following is None:
            return None
        if surface([following]).regular[0] <= 0:
            return _between(surface, q, following)
        q = following
    return None


def _direction(surface, q, previous):
    """Unit tangent of the curve, on the side of the previous one."""
    _, slope, other = surface([q]).conditions[0, 0, 1:]
    tangent = np.array([0.0, -other, slope])
    tangent /= np.linalg.norm(tangent)
    return tangent if tangent @ previous > 0 else -tangent


def _between(surface, regular, singular):
    """The singular point between two neighbours on the curve, by bisection."""
    for _ in range(HALVINGS):
        middle = _on_curve(surface, 0.5 * (regular + singular))
        if middle is None or np.array_equal(middle, regular) or np.array_equal(middle, singular):
            break
        if surface([middle]).regular[0] > 0:
            regular = middle
        else:
            singular = middle
    return regular
