"""The tooth of a wheel that a threaded tool generates, with the fillets cut by the rounding of the tool's tip.

Sections are planes z = constant; the root land is what the tip cylinder of the tool leaves. Sizes come from the drive's
function ``solid_<member>``, the design keys that messages name from its description.
"""

from __future__ import annotations

import numpy as np

from meshwright.base.errors import DesignError
from meshwright.contact.placement import about_z
from meshwright.design.description import table_and_key
from meshwright.drive import Drive
from meshwright.fe.generated_side import generated_side
from meshwright.fe.rim import bore_radius, bored
from meshwright.fe.sizes import key_of, other_flank, solid_sizes
from meshwright.fe.thread import opposite
from meshwright.fe.thread_flanks import contact, span
from meshwright.fe.tooth import SideName, Teeth, ToothForm, ToothSide


def generated_wheel(drive: Drive, member: str, rim_thickness: float) -> Teeth:
    """The tooth of a drive with a whole blank; the rim ends at a bore below the root of the middle plane.

    Raises DesignError where the tool leaves no whole tooth in the face, with the widest face found whole.
    """
    sizes = solid_sizes(drive, member)
    working, sides = _sides(drive, member)
    bore = bored(bore_radius(sizes["root_radius"], rim_thickness))
    next_tooth = about_z(-2.0 * np.pi / sizes["teeth"])
    faces = (sizes["face_first"], sizes["face_last"])
    form = ToothForm.repeated(sides["left"], sides["right"], faces, next_tooth, bore)
    _check_land(form, drive)
    return Teeth(lambda angle: form, working)


def _sides(drive: Drive, member: str) -> tuple[SideName, dict[SideName, ToothSide]]:
    """The working side of the wheel and both sides by name."""
    point, normal = contact(drive, member)
    working: SideName = "left" if point[0] * normal[1] > point[1] * normal[0] else "right"
    place = key_of(drive, "wheel_face")
    width = drive.design.value(*reversed(table_and_key(place)))
    try:
        return working, {working: _side(drive, member), opposite(working): _side(other_flank(drive), member)}
    except DesignError:
        raise
    except ValueError as error:
        widest, narrowest = _widest_face(drive, member, width)
        reason = f"the tool leaves no whole tooth there: {error if widest else narrowest}"
        remedy = f"choose at most {widest:g}, the widest face found whole" if widest else (
            f"no narrower face is found whole either: change {key_of(drive, 'wheel_tip')}"
        )
        raise DesignError(place, width, reason, remedy) from error


def _side(drive: Drive, member: str) -> ToothSide:
    """A side of the wheel between its faces; raises ValueError where the tool leaves no whole one."""
    sizes = solid_sizes(drive, member)
    return generated_side(drive, member, span(drive, member), (sizes["face_first"], sizes["face_last"]))


def _widest_face(drive: Drive, member: str, width: float) -> tuple[float | None, str]:
    """Largest face width in mm, of three digits and less than a given one, that has whole sides, None if no width has;
    and what the narrowest one without lacks.
    """
    decimals = 2 - int(np.floor(np.log10(width)))
    table, key = table_and_key(key_of(drive, "wheel_face"))

    def lacks(steps: int) -> str:
        try:
            for one in (drive, other_flank(drive)):
                _side(one.with_(**{table: {key: round(steps * 10.0**-decimals, decimals)}}), member)
        except ValueError as error:
            return str(error)
        return ""

    narrow, wide, reason = 0, int(np.ceil(width * 10.0**decimals)), ""
    while wide - narrow > 1:
        middle = (narrow + wide) // 2
        lacking = lacks(middle)
        narrow, wide, reason = (narrow, middle, lacking) if lacking else (middle, wide, reason)
    return round(narrow * 10.0**-decimals, decimals) if narrow else None, reason


def _check_land(form: ToothForm, drive: Drive) -> None:
    """Refuse a tool without land between its two roundings: then none is left at the root of the wheel either."""
    middle = np.array([0.5 * sum(form.faces)])
    right, cut = form.right.root_end(middle)[0], form.right_cut(middle)[0]
    if right[0] * cut[1] - right[1] * cut[0] >= 0.0:
        place = key_of(drive, "tool_rounding")
        rounding = drive.design.value(*reversed(table_and_key(place)))
        raise DesignError(place, rounding, "the tool's tip has no land between its roundings", "choose less")
