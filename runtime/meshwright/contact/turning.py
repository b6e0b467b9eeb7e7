"""A drive that turns on: at each angle, of any size, the contact of the tooth pair that is in mesh there."""

from dataclasses import dataclass

import numpy as np

from meshwright.base.library import library, pointer, record
from meshwright.contact.analysis import at_solutions, checked_angles, statuses


@dataclass(frozen=True)
class Turning:
    """Pairs in mesh at pinion angles (N,), as the user counts them; angles in rad.

    ``pairs``: number of the pair whose reference angle is the nearest; 0 is the pair that ``tca`` solves.
    ``own_angles``: the angle less so many pitches, at which ``tca`` has the same contact: pair k runs as pair 0 does, k
    pitches later. ``errors``: its transmission error, NaN without contact. ``statuses``: how each solve ended, in the
    words of ``tca``.
    """

    angles: np.ndarray
    pairs: np.ndarray
    own_angles: np.ndarray
    errors: np.ndarray
    statuses: list[str]


def turning(drive, angles):
    """:class:`Turning` of a drive at pinion angles (N,), rad, in any order; quickest where each is near the one before.

    Raises :class:`~meshwright.base.errors.UsageError` for what is no angle or beyond 10¹² rad.
    """
    m, lib, sign = drive.model, library(), drive.design.mirror.sign
    angles = checked_angles(angles, lib.mw_largest_angle())
    n = len(angles)
    s, work, x = np.empty(m.ns), np.empty(m.np), np.empty((n, m.nx))
    records = np.zeros(n, record("mw_info"))
    right_handed = np.ascontiguousarray(sign * angles)
    lib.mw_turn(
        m, pointer(drive.design.parameters), pointer(right_handed), n, pointer(s), pointer(work), pointer(x),
        pointer(records, "mw_info[]"),
    )  # fmt: skip
    words = statuses()
    named = [words[code] for code in records["status"].tolist()]
    errors = sign * x[:, m.error]
    if drive.past_the_tips:  # of the flanks as they go on: as of tca, the teeth do not reach each other
        for k in np.flatnonzero(at_solutions(drive, records["angle"], x).outside_the_tips):
            named[k], errors[k] = "no_contact", np.nan
    return Turning(angles, (sign * records["pair"]).astype(np.int64), sign * records["angle"], errors, named)
