"""Does a drive whose transmission error is designed as a parabola run on an edge?

The parabola absorbs the errors of assembly while its vertex lies between the ends of contact. If the extreme of a
pair's error is at an end, the pair drives until its contact leaves the flank over the edge of a face.
"""

import dataclasses

from meshwright.pairs import Mesh
from meshwright.transmission import rides_on_edge
from meshwright.windows import contact_window

FLAG = "edge_contact"


def edge_window(drive):
    """Smaller and larger pinion angle, rad, of a pair that runs on an edge; None if it does not, or has no ends."""
    window = contact_window(drive)
    if window.path is None or not window.complete:
        return None
    if not rides_on_edge(Mesh(drive, window)):
        return None
    return tuple(sorted((window.begin.angle, window.end.angle)))


def flagged(result, window):
    """The :class:`~meshwright.results.TCA` with the flag at every solved point of the window."""
    if window is None:
        return result
    low, high = window
    points = zip(result.angles, result.solved, result.flags, strict=True)
    flags = tuple((*words, FLAG) if solved and low <= angle <= high else words for angle, solved, words in points)
    return dataclasses.replace(result, flags=flags)
