"""The window of a pair whose flanks touch along lines, or at an end of one: while any of the line lies on both flanks.

Where the flanks are aligned the line is that of contact; where they are not, it is the ridge of the wheel's turn over
them, at an end of which they touch.
"""

import math

from meshwright.base.roots import bracketed
from meshwright.cycle.search import Search

#: Angles looked at per pitch.
SAMPLES_PER_PITCH = 4

#: Contact is looked for this many pitches to either side of angle 0.
PITCHES = 2
ANGLE_TOLERANCE = 1e-10

#: Where the line ceases, steps are halved down to this share of a pitch.
LAST_STEP = 1e-6


def line_ends(drive, limits):
    """Lower and upper end of the window near the reference angle: (angle, limit) pairs, None where nothing ends it.

    Contact is judged by the point of the line that lies deepest inside the limits; its limit names the end.
    """
    search, _ = Search.of(drive)
    if search is None:
        return None, None
    named = {(limit.member, limit.reason): limit for limit in reversed(limits)}

    def depth(angle):
        """A line that leaves the flanks in a corner, where the face ends too, ends at the other limit."""
        value, nearest = search.depth(angle)
        nearest = [(member, "fold" if event == "spurious_sheet" else event) for member, event in nearest]
        found = sorted((named[key] for key in nearest), key=lambda limit: limit.reason == "face")
        return value, found[0] if found else None

    pitch, middle = drive.pitch(), drive.design.reference_angle
    shares = [k / SAMPLES_PER_PITCH for k in range(PITCHES * SAMPLES_PER_PITCH)]
    around = [middle + sign * share * pitch for share in shares for sign in (1.0, -1.0)][1:]
    inside = next((angle for angle in around if depth(angle)[0] >= 0.0), None)
    if inside is None:
        return None, None
    return tuple(_end(drive, depth, inside, sign) for sign in (-1.0, 1.0))


def _end(drive, depth, inside, sign):
    """The end of the window to one side of an angle inside.

    Where the line ceases, as it does at the end of a flank soon after its limits, the step is halved from then on.
    """
    step, shrunk, farthest = sign * drive.pitch() / SAMPLES_PER_PITCH, 1.0, math.pi / drive.ratio
    while abs(inside - drive.design.reference_angle) < farthest and abs(step) > LAST_STEP * drive.pitch():
        beyond, _ = depth(inside + step)
        if beyond < 0.0:
            angle = bracketed(lambda a: depth(a)[0], inside, inside + step, ANGLE_TOLERANCE)
            names = (depth(angle + share * step)[1] for share in (1e-6, 1e-4, 1e-2, 1.0))
            return float(angle), next(limit for limit in names if limit)
        if math.isfinite(beyond):
            inside += step
        else:
            shrunk = 0.5
        step *= shrunk
    return None
