"""The window of contact where flanks touch along lines: while any point of the line lies on both flanks."""

import math

import numpy as np

from meshwright.base.roots import bracketed
from meshwright.contact.analysis import analyse
from meshwright.contact.contact_line import deepest

#: Angles looked at per pitch.
SAMPLES_PER_PITCH = 4

#: Contact is looked for this many pitches to either side of angle 0.
PITCHES = 2
ANGLE_TOLERANCE = 1e-10


def line_ends(drive, limits):
    """Lower and upper end of line contact near the reference angle: (angle, limit) pairs, None where nothing ends it.

    Contact is judged by the point of the line that lies deepest inside the limits; its limit names the end.
    """
    tried = np.arange(PITCHES * SAMPLES_PER_PITCH) / SAMPLES_PER_PITCH * drive.pitch()
    around = drive.design.reference_angle + np.stack([tried, -tried], axis=1).ravel()[1:]
    inside = next((float(a) for a in around if _depth(drive, limits, a)[0] >= 0.0), None)
    if inside is None:
        return None, None
    return tuple(_end(drive, limits, inside, sign) for sign in (-1.0, 1.0))


def _end(drive, limits, inside, sign):
    step, farthest = sign * drive.pitch() / SAMPLES_PER_PITCH, math.pi / drive.ratio
    while abs(inside - drive.design.reference_angle) < farthest:
        depth, _ = _depth(drive, limits, inside + step)
        if not math.isfinite(depth):
            return None
        if depth < 0.0:
            ends = inside, inside + step
            angle = bracketed(lambda a: _depth(drive, limits, a)[0], *ends, ANGLE_TOLERANCE)
            names = (_depth(drive, limits, angle + share * step)[1] for share in (1e-6, 1e-4, 1e-2, 1.0))
            return float(angle), next(limit for limit in names if limit)
        inside += step
    return None


def _depth(drive, limits, angle):
    """How deep the deepest point of the line lies within the limits, and which of them says so."""
    found = analyse(drive, np.array([drive.design.mirror.sign * angle]))
    if found.status[0] != "line_contact":
        return math.nan, None
    margins = deepest(drive, angle, found.solutions[0])[[limit.index for limit in limits]]
    if np.isnan(margins).all():
        return math.nan, None
    k = int(np.nanargmin(margins))
    return float(margins[k]), limits[k]
