"""Limits of a drive: undercut, edges of regression, limit points of contact, meshing axes, branches.

A family adds its limits as a module with ``limits(drive, request) -> Limits``, listed in :data:`FAMILIES`; the
generated flank functions (with their singular function and margins) and the drive's own generated functions are
all it needs. Families whose tooth pairs may touch at several points at once add a search to :data:`SEARCHES`.
"""

from meshwright.base.errors import UsageError
from meshwright.limits import contacts, cylindrical_worm, face_worm, spherical
from meshwright.limits.results import Limits, Request

FAMILIES = {
    "cylindrical-worm": cylindrical_worm.limits,
    "face-worm": face_worm.limits,
    "spherical": spherical.limits,
}
SEARCHES = {"cylindrical-worm": contacts.contacts}

__all__ = ["FAMILIES", "Limits", "Request", "contacts_of", "limits_of"]


def limits_of(drive, request=None):
    """The :class:`Limits` of a drive for a :class:`Request`; lengths in mm, angles in rad."""
    request, family = request or Request(), drive.design.family
    if family != "cylindrical-worm" and (request.section_y is not None or request.radii):
        raise UsageError(f"drive = {family!r}: sections and radii are those of a cylindrical worm; leave them out")
    return _of_family(drive, FAMILIES, "limits")(drive, request)


def contacts_of(drive, angle):
    """Every contact of a pair at a pinion angle, rad: a :class:`~meshwright.contact.results.TCA`, one row each."""
    return _of_family(drive, SEARCHES, "a search for all contacts")(drive, angle)


def _of_family(drive, table, what):
    family = drive.design.family
    if family not in table:
        raise UsageError(f"drive = {family!r}: {what} not available; families that have it: {', '.join(table)}")
    return table[family]
