"""Gears: both flanks and fillets of a tooth from the generated surfaces of one design, or of one design a flank.

Sections are planes z = constant where the tooth runs along the axis, cylinders about the axis where it runs along the
radius, as on a face gear. The flank of sign +1 is the tooth's left side, at the larger azimuth of a tooth along the
axis and at the smaller of one along the radius. Sizes come from the drive's function ``solid_<member>``
(``derive.language.functions``).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import CubicSpline

from meshwright.base.errors import DesignError
from meshwright.contact.placement import about_z
from meshwright.drive import Drive
from meshwright.fe.generated import constant, region_surface, tip_parameter, turned
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import Section, SectionCurves
from meshwright.fe.rim import bore_radius, bored
from meshwright.fe.sizes import body_of, flank_pair, solid_sizes
from meshwright.fe.tooth import Cut, SideName, Teeth, ToothForm, ToothSide
from meshwright.flank.sections import ANGLES, Sections
from meshwright.flank.undercut import undercut_side

_TIP_SAMPLES = 33


def gear_teeth(drive: Drive, member: str, rim_thickness: float) -> Teeth:
    """The teeth of a member.

    rim_thickness: in mm from the root to a bore, not deeper than 0.8 radii; of an internal gear to its outside; of a
    tooth along the radius, from the lowest root to the plane back of the gear. An undercut flank ends where its fillet
    cuts it; raises DesignError where that does not reach it.
    """
    sizes = solid_sizes(drive, member)
    faces = (sizes["face_first"], sizes["face_last"])
    pitch = 2.0 * np.pi / sizes["teeth"]
    lie = _LIES[body_of(drive, member)["lengthwise"]]
    pair = flank_pair(drive)
    sides: dict[SideName, ToothSide] = {name: _side(one, member, lie.section) for name, one in pair.items()}
    own: SideName = "left" if drive.design.flank > 0 else "right"
    if lie is _LIES["axial"] and _points_inwards(sides[own], faces):
        lie = _INTERNAL
    if "middle" in sizes:
        _set_apart(sides, own, faces, pitch, sizes["middle"])
    elif lie is _INTERNAL:
        _of_one_tooth(sides, own, faces, pitch)
    back = lie.back(sides, faces, sizes, rim_thickness)
    form = ToothForm.repeated(sides["left"], sides["right"], faces, about_z(lie.right * pitch), back)
    return Teeth(lambda angle: form, own)


def _side(drive: Drive, member: str, section: Section) -> ToothSide:
    sizes = solid_sizes(drive, member)
    faces = np.linspace(sizes["face_first"], sizes["face_last"], _TIP_SAMPLES)
    tip = CubicSpline(faces, tip_parameter(drive, member, section, faces, (sizes["tip_first"], sizes["tip_last"])))
    flank = SectionCurves(region_surface(drive, member, "flank"), section, constant(sizes["flank_root"]), tip)
    root, end = flank.first, constant(sizes["fillet_junction"])
    if _undercut(drive, member, flank, faces):
        root, end = (CubicSpline(faces, at) for at in _crossing(drive, member, faces))
    land = constant(sizes["fillet_land"])
    fillet = SectionCurves(region_surface(drive, member, "fillet"), section, land, end)
    return ToothSide(fillet, replace(flank, first=root))


def _undercut(drive: Drive, member: str, flank: SectionCurves, sections: Floats) -> bool:
    """Whether the tool has cut the flank off somewhere: fillet and flank then cross instead of touching."""
    root = flank.first(sections)
    places = np.stack([root, flank.solve(sections, root[:, None])[:, 0]], axis=1)
    return bool(np.any(drive.flank(member)(places).regular < 0.0))


def _crossing(drive: Drive, member: str, sections: Floats) -> tuple[Floats, Floats]:
    """Profile parameters (K,) of flank and fillet where they meet in sections (K,); raises DesignError if nowhere."""
    side = undercut_side(drive, member)
    if side is None or side.fillet is None:
        raise DesignError(
            "design",
            drive.design.tables.get("name"),
            f"the teeth of the {member} are undercut and their fillet does not reach their flank",
            "choose more teeth or a larger profile shift; `meshwright limits` says where their flanks begin",
        )
    flank, fillet = side.joint(sections)
    return flank[:, side.flank.region.profile], fillet[:, side.fillet.region.profile]


def _set_apart(
    sides: dict[SideName, ToothSide], own: SideName, faces: tuple[float, float], pitch: float, middle: float
) -> None:
    """Turn the other side so that tooth and space are equally wide at ``middle``; the flank in hand keeps its place."""
    at = np.array([0.5 * (faces[0] + faces[1])])
    thickness = _azimuth(sides["right"], at, middle) - _azimuth(sides["left"], at, middle)
    _turn_other(sides, own, 0.5 * pitch - thickness)


def _of_one_tooth(sides: dict[SideName, ToothSide], own: SideName, faces: tuple[float, float], pitch: float) -> None:
    """Turn the other side by pitches, from the flank across the space to that across the tooth."""
    at = np.array([0.5 * (faces[0] + faces[1])])
    left, right = (_azimuth(sides[name], at, float(sides[name].flank.last(at)[0])) for name in ("left", "right"))
    _turn_other(sides, own, -pitch * np.floor((right - left) / pitch))


def _turn_other(sides: dict[SideName, ToothSide], own: SideName, angle: float) -> None:
    """Turn the other side about the axis by an angle in rad, which widens a tooth with its right side further on."""
    other: SideName = "right" if own == "left" else "left"
    angle = angle if other == "right" else -angle
    side = sides[other]
    curves = (SectionCurves(turned(c.surface, angle), c.section, c.first, c.last) for c in (side.fillet, side.flank))
    sides[other] = ToothSide(*curves)


def _points_inwards(side: ToothSide, faces: tuple[float, float]) -> bool:
    """Whether the tip lies nearer the axis than the root, as of an internal gear."""
    at, flank = np.array([0.5 * (faces[0] + faces[1])]), side.flank
    root, tip = (_radius(flank.points(at, end(at)[:, None]))[0, 0] for end in (flank.first, flank.last))
    return bool(tip < root)


def _azimuth(side: ToothSide, sections: Floats, profile: float) -> float:
    """Azimuth in rad at a profile parameter."""
    point = side.flank.points(sections, np.full((1, 1), profile))[0, 0]
    return float(np.arctan2(point[1], point[0]))


def _radius(points: Floats) -> Floats:
    return np.hypot(points[..., 0], points[..., 1])


def _bore(
    sides: dict[SideName, ToothSide], faces: tuple[float, float], sizes: dict[str, float], rim_thickness: float
) -> Cut:
    return bored(bore_radius(sizes["root_radius"], rim_thickness))


def _outside(
    sides: dict[SideName, ToothSide], faces: tuple[float, float], sizes: dict[str, float], rim_thickness: float
) -> Cut:
    return bored(sizes["root_radius"] + rim_thickness)


def _plane_back(
    sides: dict[SideName, ToothSide], faces: tuple[float, float], sizes: dict[str, float], rim_thickness: float
) -> Cut:
    ends, profile = np.array(faces), np.full((2, 1), sizes["fillet_land"])
    low = min(float(side.fillet.points(ends, profile)[..., 2].min()) for side in sides.values())

    def back(points: Floats) -> Floats:
        flat = points.copy()
        flat[..., 2] = low - rim_thickness
        return flat

    return back


@dataclass(frozen=True)
class _Lie:
    """How a tooth lies: its sections, on which side (of the azimuth) the right neighbour is, and what ends the rim."""

    section: Section
    right: int
    back: Callable[..., Cut]


_LIES = {"axial": _Lie(Sections(0.0), -1, _bore), "radius": _Lie(Sections(ANGLES["radius"]), 1, _plane_back)}
_INTERNAL = _Lie(Sections(0.0), 1, _outside)
