"""Face worm gear drives: gear teeth from two designs, one a flank, and the worm's flank.

Sections of a gear tooth are cylinders about the gear axis. The convex flank bounds a tooth on the side of smaller
azimuth, the concave one on the other. Both flanks of the worm's thread are the generated ones; its height follows from
the gear's blade, since the source gives none, and an arc of the blade's edge radius joins flank and root.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.interpolate import CubicSpline

from meshwright.design import design as designs
from meshwright.drive import Drive
from meshwright.fe.generated import about_z, constant, region_surface, tip_parameter
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import Section, SectionCurves, Surface
from meshwright.fe.rim import bore_radius
from meshwright.fe.rounding import Span
from meshwright.fe.thread import SideName, ThreadBlank, ThreadFlank, opposite, side_of, thread_teeth
from meshwright.fe.tooth import Teeth, ToothForm, ToothSide

_FLANKS = ("convex", "concave")
_TIP_SAMPLES = 33
# The gear's tip is looked for up to so many axial modules above the middle of the profile.
_HIGHEST = 2.0
_NEWTON_STEPS = 30
# The tip of the worm's flank is looked for up to so many axial modules along its blade.
_WORM_HIGHEST = -1.6
_FIXED_POINT_STEPS = 20
_THICKNESS_TOLERANCE = 1e-9


def root_radii(drive: Drive) -> dict[str, float]:
    """Root radius in mm of the worm at its reference section; the gear's rim is flat and has no such bound."""
    value = drive.design.value
    return {"pinion": 0.5 * value("worm_pitch_diameter_mm") - value("blade_depth_mm")}


def gear_teeth(drive: Drive, rim_thickness: float) -> Teeth:
    """The gear tooth; rim_thickness in mm from the lowest root to the plane back of the gear."""
    sides = {flank: _side(_of_flank(drive, flank)) for flank in _FLANKS}
    faces = (drive.design.value("gear_inner_radius_mm"), drive.design.value("gear_outer_radius_mm"))
    pitch = 2.0 * np.pi / drive.design.value("gear_teeth")
    middle = np.array([0.5 * (faces[0] + faces[1])])
    thickness = _azimuth(sides["concave"], middle) - _azimuth(sides["convex"], middle)
    other = _FLANKS[1 - _FLANKS.index(drive.design.tables["flank"])]
    # Tooth and space are equally wide at u = 0; the flank in hand keeps its place.
    shift = (0.5 * pitch - thickness) * (1.0 if other == "concave" else -1.0)
    sides[other] = _turned(sides[other], float(shift))
    low = min(_root_height(sides[flank], np.array(faces)) for flank in _FLANKS)

    def back(points: Floats) -> Floats:
        flat = points.copy()
        flat[..., 2] = low - rim_thickness
        return flat

    form = ToothForm.repeated(sides["convex"], sides["concave"], faces, about_z(pitch), back)
    return Teeth(lambda angle: form, "left" if drive.design.flank > 0 else "right")


def _of_flank(drive: Drive, flank: str) -> Drive:
    """The drive itself, or that of the other flank: the packaged partner, else this one with the flank changed."""
    if drive.design.tables["flank"] == flank:
        return drive
    own = drive.design.tables["flank"]
    name = drive.design.tables["name"].replace(own, flank)
    if name != drive.design.tables["name"] and name in designs.packaged_names():
        return Drive.load(name)
    return drive.with_(flank=flank)


def _side(drive: Drive) -> ToothSide:
    sizes, design = drive.design.sizes, drive.design
    root, rounding = sizes["flank_root_mm"], np.radians(sizes["fillet_angle_deg"])
    faces = np.linspace(design.value("gear_inner_radius_mm"), design.value("gear_outer_radius_mm"), _TIP_SAMPLES)
    heights = (0.0, _HIGHEST * design.value("axial_module_mm"))
    tip = CubicSpline(faces, tip_parameter(drive, "wheel", _radius, faces, heights))
    flank = SectionCurves(region_surface(drive, "wheel", "flank"), _radius, constant(root), tip)
    fillet = SectionCurves(region_surface(drive, "wheel", "fillet"), _radius, constant(0.0), constant(rounding))
    return ToothSide(fillet, flank)


def _radius(points: Floats) -> Floats:
    return np.hypot(points[..., 0], points[..., 1])


def _azimuth(side: ToothSide, sections: Floats) -> float:
    """Azimuth in rad at u = 0."""
    point = side.flank.points(sections, np.zeros((1, 1)))[0, 0]
    return float(np.arctan2(point[1], point[0]))


def _root_height(side: ToothSide, sections: Floats) -> float:
    return float(side.fillet.points(sections, np.zeros((2, 1)))[..., 2].min())


def _turned(side: ToothSide, angle: float) -> ToothSide:
    """The side turned about z."""
    rotation = about_z(angle)[:3, :3].T

    def turned(surface: Surface) -> Surface:
        def evaluate(profile: Floats, face: Floats) -> tuple[Floats, Floats]:
            points, normals = surface(profile, face)
            return points @ rotation, normals @ rotation

        return evaluate

    curves = (SectionCurves(turned(c.surface), c.section, c.first, c.last) for c in (side.fillet, side.flank))
    return ToothSide(*curves)


def worm_teeth(drive: Drive, rim_thickness: float) -> Teeth:
    """The worm's thread, as high as the gear's space is deep but for the clearance, and as wide at mid height."""
    own = drive.design.tables["flank"]
    drives = {flank: _of_flank(drive, flank) for flank in _FLANKS}
    surfaces = {flank: _worm_surface(drives[flank]) for flank in _FLANKS}
    value = drive.design.value
    pitch_radius, taper = 0.5 * value("worm_pitch_diameter_mm"), np.tan(value("worm_cone_angle_deg"))
    module = value("axial_module_mm")
    tip = pitch_radius + value("gear_addendum_mm", "blank")
    root = root_radii(drive)["pinion"]
    blank = ThreadBlank(tip, root, value("fillet_radius_mm"), bore_radius(root, rim_thickness), taper)
    (facing,), (normal,) = surfaces[own](np.zeros(1), np.zeros(1))
    working = side_of(normal)
    other = _FLANKS[1 - _FLANKS.index(own)]
    turn = _turn_to_thickness(surfaces, own, 0.5 * np.pi * module * (1.0 if working == "left" else -1.0), drive)
    flanks: dict[SideName, ThreadFlank] = {
        working: ThreadFlank(_facing(surfaces[own], 0.0), _worm_span(drives[own])),
        opposite(working): ThreadFlank(_facing(surfaces[other], turn), _worm_span(drives[other])),
    }
    return thread_teeth(flanks, working, blank, drive.pitch(), facing)


def _worm_span(drive: Drive) -> Span:
    """Along the blade: not deeper into the worm than the blade is into the gear."""
    value = drive.design.value
    slant = np.cos(value("blade_angle_deg"))
    return Span(value("blade_depth_mm") / slant, 0.0, _WORM_HIGHEST * value("axial_module_mm"))


def _turn_to_thickness(surfaces: dict[str, Surface], own: str, thickness: float, drive: Drive) -> float:
    """Angle in rad by which the other flank turns about the axis to stand ``thickness`` mm beyond the own along z."""
    other = _FLANKS[1 - _FLANKS.index(own)]
    screw = drive.design.sizes["screw_parameter_worm_mm_per_rad"]
    (own_point,), _ = surfaces[own](np.zeros(1), np.zeros(1))
    azimuth = np.arctan2(own_point[1], own_point[0])
    wanted = own_point[2] + thickness
    turn = 0.0
    for _ in range(_FIXED_POINT_STEPS):
        curves = SectionCurves(
            _facing(surfaces[other], turn)(0.0), _azimuth_from(azimuth), constant(0.0), constant(0.0)
        )
        found = float(curves.points(np.zeros(1), np.zeros((1, 1)))[0, 0, 2])
        # A right-hand thread turned forwards stands back by its screw parameter.
        turn += (found - wanted) / screw
        if abs(found - wanted) < _THICKNESS_TOLERANCE:
            return turn
    raise ValueError(f"the second flank of the thread finds no place ({found - wanted:.3g} mm off)")


def _azimuth_from(azimuth: float) -> Section:
    c, s = np.cos(azimuth), np.sin(azimuth)
    return lambda points: np.arctan2(c * points[..., 1] - s * points[..., 0], c * points[..., 0] + s * points[..., 1])


def _facing(surface: Surface, turn: float) -> Callable[[float], Surface]:
    """The flank turned about z, its face parameter counted from the cutting angle that faces the gear."""
    rotation = about_z(turn)[:3, :3].T

    def at(angle: float) -> Surface:
        def evaluate(profile: Floats, face: Floats) -> tuple[Floats, Floats]:
            points, normals = surface(profile, face + angle + turn)
            return points @ rotation, normals @ rotation

        return evaluate

    return at


def _worm_surface(drive: Drive) -> Surface:
    """Points over (u, psi): the tool's angle theta follows from the equation of meshing by Newton's method."""
    generated = drive.flank("pinion")
    parameters = list(generated.parameters)
    order = [parameters.index(name) for name in ("u_worm", "theta_worm", "psi_worm")]

    def evaluate(profile: Floats, face: Floats) -> tuple[Floats, Floats]:
        profile, face = np.broadcast_arrays(profile, face)
        places = np.zeros((profile.size, 3))
        places[:, order[0]], places[:, order[2]] = profile.ravel(), face.ravel()
        for _ in range(_NEWTON_STEPS):
            found = generated(places)
            value, slope = found.conditions[:, 0, 0], found.conditions[:, 0, 1 + order[1]]
            step = value / slope
            places[:, order[1]] -= step
            if np.abs(step).max() < 1e-14:
                break
        found = generated(places)
        return found.points.reshape(*profile.shape, 3), found.normals.reshape(*profile.shape, 3)

    return evaluate
