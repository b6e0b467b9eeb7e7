"""Does a drive whose transmission error is designed as a parabola run on an edge?

The parabola absorbs the errors of assembly while its vertex lies between the ends of contact. If the extreme of a
pair's error is at an end, the pair drives until its contact leaves the flank over the edge of a face.
"""

import dataclasses

import numpy as np

from meshwright.cycle.first_contact import OVERLAP
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.transmission import rides_on_edge
from meshwright.cycle.windows import contact_window

FLAG = "edge_contact"


def edge_window(drive):
    """Smaller and larger pinion angle, rad, of a pair that runs on an edge; None if it does not, or has no ends."""
    window = contact_window(drive)
    if window.path is None or not window.complete:
        return None
    if not rides_on_edge(Mesh(drive, window)):
        return None
    return tuple(sorted((window.begin.angle, window.end.angle)))


def inside(window, angles):
    """Which pinion angles (N,), rad, lie in a window; none if there is no window, or an empty one."""
    low, high = window or (np.inf, -np.inf)
    return (low <= angles) & (angles <= high)


def flagged(result, window):
    """The :class:`~meshwright.contact.results.TCA` with the flag at every solved point of the window."""
    if window is None:
        return result
    on_edge = result.solved & inside(window, result.angles)
    flags = tuple((*words, FLAG) if on else words for on, words in zip(on_edge, result.flags, strict=True))
    return dataclasses.replace(result, flags=flags)


def not_first(result, first):
    """The :class:`~meshwright.contact.results.TCA` with the flag ``not_first`` at every tangency inside all its limits
    that another place of the same flanks, a first contact, precedes.
    """
    late = result.solved & (first.overlaps(result.error) > OVERLAP)
    late &= np.array([not any(f != FLAG for f in words) for words in result.flags], dtype=bool)
    flags = tuple((*words, "not_first") if on else words for on, words in zip(late, result.flags, strict=True))
    return dataclasses.replace(result, flags=flags)
