"""Limits of a drive: undercut, edges of regression, limit points of contact, meshing axes, branches.

Every analysis here rests on functions that a drive offers by name (``derive.language.functions``), and applies to every
drive that offers them.
"""

from dataclasses import replace

from meshwright.base.errors import UsageError
from meshwright.contact import functions
from meshwright.flank.blank import with_whole_blank
from meshwright.flank.pointed import pointed
from meshwright.limits import clearance, contacts, rack
from meshwright.limits.branches import branch_points
from meshwright.limits.least_teeth import least_teeth
from meshwright.limits.omitted import omitted
from meshwright.limits.results import Limits, Request
from meshwright.limits.thickness import tip_thicknesses
from meshwright.limits.undercut import undercut_lines, within_limits

__all__ = ["STEPS", "Limits", "Request", "contacts_of", "limits_of"]


#: How often :func:`limits_of` says what it is about to do.
STEPS = 5


def limits_of(drive, request=None, step=lambda text: None):
    """The :class:`Limits` of a drive for a :class:`Request`; lengths in mm, angles in rad. ``step(text)`` is called
    :data:`STEPS` times.

    Where the blank is open the standard proportions bound the flanks, as they do under load: ``assumed_blank`` says
    which, ``blank_left_open`` why none do. Raises :class:`~meshwright.base.errors.UsageError` for sections or radii of
    a drive that has none.
    """
    request = Request() if request is None else request
    if not isinstance(request, Request):
        raise UsageError(f"request = {request!r}: says nothing of limits; give a meshwright.limits.Request")
    given, (drive, assumed, left_open) = drive, with_whole_blank(drive)
    step("limits of contact")
    generated = rack.generation_limits(drive, request) if functions.has(drive, "generation") else rack.none(request)
    searched = drive.design.description["least_teeth"]
    step("undercut lines")
    undercut, (beside, unsought) = undercut_lines(drive, request), within_limits(drive, request)
    step("branch points")
    branches = branch_points(drive)
    step("thickness of the tips")
    thickness = tip_thicknesses(drive)
    step("least numbers of teeth and clearance of the tool")
    found = Limits(
        undercut=undercut + beside,
        branch_points=branches,
        assumed_blank=assumed,
        blank_left_open=left_open,
        tip_thickness=thickness,
        pointed_teeth=pointed(given),
        least_teeth={member: least_teeth(drive, member) for member in searched} or None,
        tool_clearance=clearance.judged(drive) if drive.design.description["tool_clearance"] else None,
        omitted=omitted(drive, request, thickness, unsought),
        **generated,
    )
    mirror = drive.design.mirror
    names = ("undercut", "regression", "first_type", "second_type", "axes", "section_profile", "branch_points")
    return replace(found, **{name: tuple(entry.seen_in(mirror) for entry in getattr(found, name)) for name in names})


def contacts_of(drive, angle):
    """Every contact of a pair at a pinion angle, rad: a :class:`~meshwright.contact.results.TCA`, one row each."""
    return contacts.contacts(drive, angle)
