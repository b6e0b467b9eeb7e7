"""Face worm gear drives: gear teeth from two designs, one a flank, and the worm's flank.

Sections of a gear tooth are cylinders about the gear axis. The convex flank bounds a tooth on the side of smaller
azimuth, the concave one on the other. The worm has no solid here: its thread is an elastic half-space on a rigid
shaft, so only the flank is described.
"""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline

from meshwright import design as designs
from meshwright.drive import Drive
from meshwright.fe.generated import about_z, constant, region_surface, tip_parameter
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import SectionCurves, Surface
from meshwright.fe.tooth import ToothForm, ToothSide

_FLANKS = ("convex", "concave")
_TIP_SAMPLES = 33
# The gear's tip is looked for up to so many axial modules above the middle of the profile.
_HIGHEST = 2.0
_NEWTON_STEPS = 30
# The worm's thread in axial modules along its blade: tip towards the gear's root, and root.
_WORM_TIP, _WORM_ROOT = -1.0, 1.25
_WORM_REACH = 1e3


def gear_form(drive: Drive, rim_thickness: float) -> ToothForm:
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

    return ToothForm(sides["convex"], sides["concave"], faces, about_z(pitch), back)


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


def worm_form(drive: Drive) -> ToothForm:
    """The worm's flank alone, in (u, angle of cutting); it has no fillet and no bore."""
    module = drive.design.value("axial_module_mm")
    curves = SectionCurves(
        _worm_surface(drive),
        lambda points: points[..., 2],
        constant(_WORM_TIP * module),
        constant(_WORM_ROOT * module),
    )
    side = ToothSide(curves, curves)
    return ToothForm(side, side, (-_WORM_REACH, _WORM_REACH), np.eye(4), None)


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
