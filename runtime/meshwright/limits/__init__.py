"""Limits of a drive: undercut, edges of regression, limit points of contact, meshing axes, branches.

A family adds its limits as a module with ``limits(drive, request) -> Limits``, listed in :data:`FAMILIES`; the
generated flank functions (with their singular function and margins) and the drive's own generated functions are
all it needs.
"""

from meshwright.errors import UsageError
from meshwright.limits import cylindrical_worm, face_worm, spherical
from meshwright.limits.results import Limits, Request

FAMILIES = {
    "cylindrical-worm": cylindrical_worm.limits,
    "face-worm": face_worm.limits,
    "spherical": spherical.limits,
}

__all__ = ["FAMILIES", "Limits", "Request", "limits_of"]


def limits_of(drive, request=None):
    """The :class:`Limits` of a drive for a :class:`Request`; lengths in mm, angles in rad."""
    family = drive.design.family
    if family not in FAMILIES:
        raise UsageError(f"limits of {family}: not available; families that have them: {', '.join(FAMILIES)}")
    return FAMILIES[family](drive, request or Request())
