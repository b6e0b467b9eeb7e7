"""The tooth of a wheel that a threaded tool generates, with the fillets cut by the rounding of the tool's tip.

Its teeth are those of its regions; what the tool leaves no whole tooth of is refused with the keys of the design that
the description names, and the widest face that can be had.
"""

import numpy as np

from meshwright.base.errors import DesignError
from meshwright.design.description import table_and_key
from meshwright.drive import Drive
from meshwright.fe.region_teeth import region_teeth
from meshwright.fe.sizes import key_of
from meshwright.fe.tooth import Teeth
from meshwright.fe.tooth_patches import NoLand
from meshwright.flank.region import region


def generated_wheel(drive: Drive, member: str, rim_thickness: float) -> Teeth:
    """The teeth that flank and fillet regions make; rim_thickness in mm from the root to the bore.

    Raises DesignError where the tool leaves no whole tooth in the face, with the widest face found whole.
    """
    place = key_of(drive, "wheel_face")
    width = drive.design.value(*reversed(table_and_key(place)))
    _check_rounding(drive, member)
    try:
        return region_teeth(drive, member, rim_thickness)
    except NoLand as error:
        raise _named(drive, "tool_rounding" if error.where == "root land" else "wheel_tip", error.reason) from error
    except DesignError:
        raise
    except ValueError as error:
        widest, narrowest = _widest_face(drive, member, width)
        reason = f"the tool leaves no whole tooth there: {error if widest else narrowest}"
        remedy = f"choose at most {widest:g}, the widest face found whole" if widest else (
            f"no narrower face is found whole either: change {key_of(drive, 'wheel_tip')}"
        )
        raise DesignError(place, width, reason, remedy) from error


def _widest_face(drive: Drive, member: str, width: float) -> tuple[float | None, str]:
    """Largest face width in mm, of three digits and less than a given one, that has whole sides, None if no width has;
    and what the narrowest one without lacks.
    """
    decimals = 2 - int(np.floor(np.log10(width)))
    table, key = table_and_key(key_of(drive, "wheel_face"))

    def lacks(steps: int) -> str:
        try:
            region_teeth(drive.with_(**{table: {key: round(steps * 10.0**-decimals, decimals)}}), member, None)
        except ValueError as error:
            return str(error)
        return ""

    narrow, wide, reason = 0, int(np.ceil(width * 10.0**decimals)), ""
    while wide - narrow > 1:
        middle = (narrow + wide) // 2
        lacking = lacks(middle)
        narrow, wide, reason = (narrow, middle, lacking) if lacking else (middle, wide, reason)
    return round(narrow * 10.0**-decimals, decimals) if narrow else None, reason


def _check_rounding(drive: Drive, member: str) -> None:
    """Refuse a rounding of the tool's tip that cuts no fillet."""
    fillet = region(drive, member, "fillet", drive.uses)
    if fillet.empty:
        raise _named(drive, "tool_rounding", fillet.why_empty)


def _named(drive: Drive, size: str, reason: str) -> DesignError:
    """An error of the key of a size that had better be less."""
    key = key_of(drive, size)
    return DesignError(key, drive.design.value(*reversed(table_and_key(key))), reason, "choose less")
