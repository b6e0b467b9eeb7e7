"""The least number of teeth of a member without undercut anywhere on its face."""

import numpy as np

from meshwright.base.errors import DesignError
from meshwright.limits.undercut import at_section, sections_of_face

#: The singular function is 1 at the reference point; a zero exactly at the end of the profile is not undercut.
TOUCHING = -1e-12

#: No gear of practical use has more teeth.
MOST_TEETH = 2**16


def least_teeth(drive, member):
    """The least number of teeth; None if there is none below 2¹⁶, or the drive does not say how to vary them.

    The tool and the face width are kept, as are the ratios of the sizes that the drive names to the pitch radius.
    More teeth are always better: the number is found by bisection. The middle and the end of the face are looked at,
    one of which is the worst section.
    """
    search = drive.design.description["least_teeth"].get(member)
    if search is None:
        return None
    most = 1
    while not _is_free(drive, member, search, most):
        most *= 2
        if most > MOST_TEETH:
            return None
    least = most // 2
    while most - least > 1:
        middle = (most + least) // 2
        least, most = (least, middle) if _is_free(drive, member, search, middle) else (middle, most)
    return most


def _is_free(drive, member, search, teeth):
    """Whether the member with another number of teeth can be made and is not undercut."""
    value = drive.design.value
    changes = {search["teeth"]: teeth}
    for key in search["proportional"]:
        if np.isfinite(value(key)):
            changes[key] = value(key) * teeth / value(search["teeth"])
    try:
        changed = drive.with_(design=changes)
    except DesignError:
        return False
    flank, start = changed.flank(member), float(changed.function(f"undercut_range_{member}")()["start"])
    sections = sections_of_face(flank, start, 3)[-2:]
    profile = np.full(len(sections), start)
    return bool(np.all(flank(np.column_stack([profile, at_section(flank, profile, sections)])).regular >= TOUCHING))
