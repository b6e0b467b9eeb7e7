"""Which limits of a drive are not computed, and why: the drive does not offer, or the request not ask, what they need.

An empty list of limits says that there are none only where it is not named here.
"""

import numpy as np

from meshwright.contact import functions
from meshwright.flank.pointed import unknown
from meshwright.limits import branches, rack

#: Limits of the generation of a wheel as rack and pinion; those of them with closed forms at right angles alone.
_GENERATED = ("regression", "first_type", "second_type", "meshing_axes", "section_profile", "tip_thickness")
_RIGHT_ANGLED = ("first_type", "second_type", "section_profile")


def omitted(drive, request, thickness, unsought):
    """{name in the schema: why it is not computed} of a drive for a :class:`~meshwright.limits.results.Request`;
    ``thickness``: the tips that were found; ``unsought``: undercut, or that of a member, and why it is not sought.
    """
    found = _searched(drive, unsought)
    if not functions.has(drive, "generation"):
        return found | dict.fromkeys(_GENERATED, "known of a wheel that a cylindrical helicoid generates alone")
    if request.section_y is None:
        found["section_profile"] = "needs --section-y-mm"
    if not rack.is_right_angle(drive):
        angle = np.degrees(rack.sizes(drive)["cutting_angle"])
        found |= dict.fromkeys(_RIGHT_ANGLED, f"known at a cutting shaft angle of 90° alone, here it is {angle:g}°")
    if not thickness:
        found["tip_thickness"] = "[blank] gives no tip that the profiles reach"
    return found


def _searched(drive, unsought):
    """Of what is sought on every drive that says where."""
    found = {}
    for name, why in unsought.items():
        found[name] = f"{why}; `tca` flags contact that lies past undercut"
    if branches.start(drive) is None:
        found["branch_points"] = "no contact in a point about angle 0 from which a branch could be followed"
    if apart := unknown(drive):
        found["pointed_teeth"] = apart
    if not drive.design.description["least_teeth"]:
        found["least_teeth_without_undercut"] = "this drive does not say which sizes go with the number of teeth"
    return found
