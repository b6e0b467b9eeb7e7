"""Flags that a contact gets from its place among others: on an edge, or later than the first touch of its flanks."""

import dataclasses

import numpy as np

#: Flag of contacts of a pair that drives until it leaves the flank over an edge.
ON_EDGE = "edge_contact"

#: Flag of tangencies that another place of the same flanks precedes.
NOT_FIRST = "not_first"

#: Flags of contacts on both flanks, which say how these stand to others; all other flags say that a limit is exceeded.
AMONG_OTHERS = frozenset({ON_EDGE, NOT_FIRST})

#: A contact further inside the other flank than this, mm, is not the first.
OVERLAP = 1e-6


def inside(window, angles):
    """Which pinion angles (N,), rad, lie in a window; none if there is no window, or an empty one."""
    low, high = window or (np.inf, -np.inf)
    return (low <= angles) & (angles <= high)


def flagged(result, window):
    """The :class:`~meshwright.contact.results.TCA` with the flag at every solved point of the window."""
    if window is None:
        return result
    on_edge = result.solved & inside(window, result.angles)
    flags = tuple((*words, ON_EDGE) if on else words for on, words in zip(on_edge, result.flags, strict=True))
    return dataclasses.replace(result, flags=flags)


def on_flanks(flags):
    """Whether a contact with these flags exceeds no limit of its flanks."""
    return AMONG_OTHERS.issuperset(flags)


def not_first(result, first):
    """The :class:`~meshwright.contact.results.TCA` with the flag ``not_first`` at every tangency inside all its limits
    that another place of the same flanks, a first contact, precedes.
    """
    late = result.solved & (first.overlaps(result.error) > OVERLAP)
    late &= np.array([on_flanks(words) for words in result.flags], dtype=bool)
    flags = tuple((*words, NOT_FIRST) if on else words for on, words in zip(late, result.flags, strict=True))
    return dataclasses.replace(result, flags=flags)
