"""First contact: the wheel angle at which the two bounded flanks of a tooth pair touch first, wherever that is.

A tangency satisfies the equations of contact, but the flanks may touch before it: on an edge or at a corner. Every
point of the wheel's bounded flank, turned about the wheel's axis, meets the pinion's flank at one wheel angle; the
extreme of these over what both limits leave is the first contact. C searches a mesh of the wheel's region for it.
Where the extreme is one value all along a curve, the flanks touch along that line.
"""

import math

import numpy as np

from meshwright.cycle.first_results import OPEN_ENDED, UNKNOWN, gathered
from meshwright.cycle.search import Search


def first_contacts(drive, angles, result=None):
    """:class:`~meshwright.cycle.first_results.FirstContacts` at pinion angles (N,), rad. ``result``: a TCA of the same
    angles, if there is one.
    """
    result = drive.tca(angles) if result is None else result
    search, reason = Search.of(drive, drive.design.mirror.sign * result.angles, result.solutions)
    angles = np.asarray(angles, dtype=float)
    if search is None:
        return gathered(drive, angles, [OPEN_ENDED] * len(angles), [None] * len(angles), reason)
    return search.first(angles)


def first_contact_of(mesh):
    """Function of a pair's own pinion angles (N,), rad, to :class:`~meshwright.cycle.first_results.FirstContacts`; None
    if there is no search.
    """
    search = mesh.search
    return None if search is None else lambda angles: search.first(np.atleast_1d(np.asarray(angles, dtype=float)))


def pair_errors(mesh):
    """Function of a pair's own pinion angles (N,), rad, to the transmission error at which its bounded flanks touch
    first, NaN where they never do, infinite where they meet, but it is not found; None where the blank does not bound
    them. Given an error ``until``, a contact that comes no earlier may be a later one of the pair, or missing: it is
    found in less time.
    """
    search = mesh.search
    if search is None:
        return None

    def errors(angles, until=None):
        found = search.at(mesh.mirror * np.asarray(angles), None if until is None else mesh.mirror * until)
        return mesh.mirror * np.array([_wheel_turn(f) for f in found])

    return errors


def _wheel_turn(found):
    if found is None or found is OPEN_ENDED:
        return math.nan
    return math.inf if found is UNKNOWN else found.wheel_turn


def search_from(drive, path):
    """What :func:`first_contact_of` and :func:`pair_errors` search with, from the contacts of a path, if there is one;
    None where the blank does not bound the flanks.
    """
    return Search.of(drive)[0] if path is None else Search.of(drive, path.angles, path.unknowns)[0]
