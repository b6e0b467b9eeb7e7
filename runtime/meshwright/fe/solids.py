"""The loaded-contact view of a drive: teeth of its family, placement and contact from its analysis."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Literal

import numpy as np

from meshwright.base.errors import DesignError, UsageError
from meshwright.contact.placement import placed
from meshwright.cycle.contact_ratio import ContactRatio
from meshwright.drive import Drive
from meshwright.fe import cylindrical_worm, face_worm, spherical
from meshwright.fe.generated import about_z
from meshwright.fe.hexahedra import Floats
from meshwright.fe.material import Material, Materials
from meshwright.fe.pair import GearPair, Member, Touch
from meshwright.fe.rim import check_rim
from meshwright.fe.tooth import Teeth

# Depth of the rim below the root in modules: twice a standard whole depth acts as a solid body.
_RIM_MODULES = 4.5
_STEP_PITCHES = 0.25

MemberName = Literal["pinion", "wheel"]


@dataclass(frozen=True)
class _Family:
    """What a family says of its teeth.

    module: key of the module.  pinion, wheel: teeth of each member, given the rim's depth in mm.  root_radii: in mm,
    that bound the rim.  completed: the drive with a whole blank, and what of it the design leaves open.
    """

    module: str
    pinion: Callable[[Drive, float], Teeth]
    wheel: Callable[[Drive, float], Teeth]
    root_radii: Callable[[Drive], dict[str, float]]
    completed: Callable[[Drive], tuple[Drive, dict[str, float]]] = lambda drive: (drive, {})


def gear_pair(drive: Drive, rim_thickness: float | None = None) -> GearPair:
    """The loaded-contact view of a drive, materials from its design.

    rim_thickness: depth of the rims below the root in mm; None takes 4.5 modules.
    Raises UsageError for a family that has no solid model, DesignError where the flanks touch along a line.
    """
    if drive.design.family not in _FAMILIES:
        known = ", ".join(_FAMILIES)
        raise UsageError(f"{drive.design.family}: no solid teeth for this family of drives; there are {known}")
    family = _FAMILIES[drive.design.family]
    drive, assumed = family.completed(drive)
    if rim_thickness is not None:
        check_rim(rim_thickness, family.root_radii(drive))
    else:
        rim_thickness = _RIM_MODULES * drive.design.value(family.module)
    if not (np.isfinite(rim_thickness) and rim_thickness > 0.0):
        raise UsageError(f"--rim-mm {rim_thickness:g}: the depth of the rim must be above zero")
    _check_point_contact(drive)
    materials = Materials.of_table(drive.design.tables["material"])
    pinion = _member(drive, "pinion", family.pinion(drive, rim_thickness), materials.pinion)
    wheel = _member(drive, "wheel", family.wheel(drive, rim_thickness), materials.wheel)
    sense = 1 if drive.design.flank > 0 else -1
    touch = cache(lambda angle: _touch(drive, angle))
    window = drive.contact_ratio()
    middle = _middle_pair(window, drive.pitch())
    ends = dict.fromkeys(f"{end.reason} of the {end.member}" for end in (window.begin, window.end) if end.member)
    return GearPair(pinion, wheel, drive.ratio, sense, touch, middle, assumed, window.contact_ratio, tuple(ends))


def _middle_pair(window: ContactRatio, pitch: float) -> Callable[[float], int]:
    """The reference pair if it touches at pinion angle 0; else the one in the middle of its contact at each angle."""
    ends = [end.angle for end in (window.begin, window.end) if end is not None and end.angle is not None]
    if len(ends) < 2 or min(ends) <= 0.0 <= max(ends):
        return lambda angle: 0
    middle = 0.5 * sum(ends)
    return lambda angle: round((angle - middle) / pitch)


def _check_point_contact(drive: Drive) -> None:
    if drive.tca([0.0]).status[0] == "line_contact":
        raise DesignError(
            "flank", drive.design.tables["flank"], "the flanks touch along a line", "misalign or crown a flank"
        )


def _touch(drive: Drive, angle: float) -> Touch | None:
    """The contact followed from angle 0: a worm's equations have the contact of a turn earlier as a solution too."""
    steps = max(1, int(np.ceil(abs(angle) / (_STEP_PITCHES * drive.pitch()))))
    path = drive.tca(np.linspace(0.0, angle, steps + 1))
    if not path.solved[-1] or any(flag.startswith("off_") for flag in path.flags[-1]):
        return None
    smaller, larger = path.curvatures[-1]
    if smaller <= 0.0:
        return None
    normal = path.normals[-1] / np.linalg.norm(path.normals[-1])
    major = path.major[-1] - (path.major[-1] @ normal) * normal
    return Touch(
        angle,
        float(path.wheel_angles[-1]),
        path.points[-1],
        normal,
        float(smaller),
        float(larger),
        major / np.linalg.norm(major),
    )


def _member(drive: Drive, name: MemberName, teeth: Teeth, material: Material) -> Member:
    """The member in its placement, turning about its own z axis."""
    if not np.all(np.isfinite(drive.tca([0.0]).wheel_angles)):
        raise DesignError(
            "design", drive.design.tables["name"], "no contact at a pinion angle of 0", "check the design"
        )
    stand = placed(drive, [0.0], [0.0])
    zero, direction = stand.matrices[name][0], stand.axes[name][0][0]
    turning = 1 if direction @ zero[:3, 2] > 0.0 else -1

    def pose(angle: float) -> Floats:
        return zero @ about_z(turning * angle)

    pitch = drive.pitch() if name == "pinion" else drive.pitch() * drive.ratio
    return Member(teeth.at, teeth.working, pose, pitch, turning, material)


_FAMILIES = {
    "spherical": _Family(
        "module_mm",
        lambda drive, rim: spherical.gear_teeth(drive, "pinion", rim),
        lambda drive, rim: spherical.gear_teeth(drive, "wheel", rim),
        spherical.root_radii,
    ),
    "face-worm": _Family(
        "axial_module_mm",
        face_worm.worm_teeth,
        face_worm.gear_teeth,
        face_worm.root_radii,
    ),
    "cylindrical-worm": _Family(
        "axial_module_mm",
        cylindrical_worm.worm_teeth,
        cylindrical_worm.wheel_teeth,
        cylindrical_worm.root_radii,
        cylindrical_worm.completed,
    ),
}
