"""Solid teeth of a drive: what the mesh needs to know of each family, taken from its generated surfaces."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Literal

import numpy as np
from scipy.interpolate import CubicSpline

from meshwright.drive import Drive
from meshwright.errors import DesignError, UsageError
from meshwright.fe.hexahedra import Floats
from meshwright.fe.material import Material, Materials
from meshwright.fe.pair import GearPair, Member, Touch
from meshwright.fe.profile import SectionCurves, Surface
from meshwright.fe.tooth import ToothForm, ToothSide
from meshwright.placement import placements

# Depth of the rim below the root in modules: twice a standard whole depth acts as a solid body.
_RIM_MODULES = 4.5
_DEEPEST_RIM = 0.8
_PROBE_ANGLE = 1e-3
_BISECTIONS = 60
_TIP_SAMPLES = 33

MemberName = Literal["pinion", "wheel"]


def gear_pair(drive: Drive, rim_thickness: float | None = None) -> GearPair:
    """The loaded-contact view of a drive, materials from its design.

    rim_thickness: radial depth of the rim below the root in mm; None takes 4.5 modules, at most 0.8 root radii.
    Raises UsageError for a family that has no solid model, DesignError where the flanks touch along a line.
    """
    if drive.design.family not in _FORMS:
        known = ", ".join(_FORMS)
        raise UsageError(f"{drive.design.family}: no solid teeth for this family of drives yet; there are {known}")
    form = _FORMS[drive.design.family]
    _check_point_contact(drive)
    materials = Materials.of_table(drive.design.tables["material"])
    members = {
        name: _member(drive, name, form(drive, name, rim_thickness), getattr(materials, name))
        for name in ("pinion", "wheel")
    }
    sense = 1 if drive.design.flank > 0 else -1
    return GearPair(members["pinion"], members["wheel"], drive.ratio, sense, cache(lambda angle: _touch(drive, angle)))


def _check_point_contact(drive: Drive) -> None:
    if drive.tca([0.0]).status[0] == "line_contact":
        raise DesignError(
            "flank", drive.design.tables["flank"], "the flanks touch along a line", "misalign or crown a flank"
        )


def _touch(drive: Drive, angle: float) -> Touch | None:
    found = drive.tca([angle])
    if not found.solved[0] or any(flag.startswith("off_") for flag in found.flags[0]):
        return None
    smaller, larger = found.curvatures[0]
    if smaller <= 0.0:
        return None
    normal = found.normals[0] / np.linalg.norm(found.normals[0])
    major = found.major[0] - (found.major[0] @ normal) * normal
    return Touch(
        angle,
        float(found.wheel_angles[0]),
        found.points[0],
        normal,
        float(smaller),
        float(larger),
        major / np.linalg.norm(major),
    )


def _member(drive: Drive, name: MemberName, form: ToothForm, material: Material) -> Member:
    """Placement from two solved contacts: the body turns about its own z axis between them."""
    angles = np.array([0.0, _PROBE_ANGLE])
    found = drive.tca(angles)
    turned = angles if name == "pinion" else found.wheel_angles
    start, end = placements(drive, angles).matrices[name]
    if not np.all(np.isfinite([start, end])):
        raise DesignError(
            "design", drive.design.tables["name"], "no contact at a pinion angle of 0", "check the design"
        )
    step = start[:3, :3].T @ end[:3, :3]
    turning = 1 if (step[1, 0] > 0.0) == (turned[1] > turned[0]) else -1
    zero = start @ _about_z(-turning * turned[0])

    def pose(angle: float) -> Floats:
        return zero @ _about_z(turning * angle)

    pitch = drive.pitch() if name == "pinion" else drive.pitch() * drive.ratio
    working = "left" if drive.design.flank > 0 else "right"
    return Member(form, working, pose, pitch, turning, material)


def _about_z(angle: float) -> Floats:
    motion = np.eye(4)
    c, s = np.cos(angle), np.sin(angle)
    motion[:2, :2] = [[c, -s], [s, c]]
    return motion


def _surface(drive: Drive, member: MemberName, region: str) -> Surface:
    """A generated region as a function of two parameter arrays."""
    generated = drive.flank(member, region)

    def evaluate(profile: Floats, face: Floats) -> tuple[Floats, Floats]:
        profile, face = np.broadcast_arrays(profile, face)
        found = generated(np.stack([profile.ravel(), face.ravel()], axis=1))
        return found.points.reshape(*profile.shape, 3), found.normals.reshape(*profile.shape, 3)

    return evaluate


# -- spherical gears ------------------------------------------------------------------------------------------------


def _spherical(drive: Drive, member: MemberName, rim_thickness: float | None) -> ToothForm:
    """Sections are planes z = constant; the rounding of the rack's tip ends where its normal is radial."""
    design = drive.design
    half_face = 0.5 * design.value(f"{member}_face_width_mm")
    pitch = 2.0 * np.pi / design.value(f"{member}_teeth")
    sides = [_spherical_side(drive.with_(flank=flank), member, half_face) for flank in ("left", "right")]
    root = design.sizes[f"{member}_root_radius_mm"]
    if rim_thickness is None:
        rim_thickness = min(_RIM_MODULES * design.value("module_mm"), _DEEPEST_RIM * root)
    if not 0.0 < rim_thickness < root:
        raise UsageError(f"--rim-mm {rim_thickness:g}: the rim of the {member} must end between its root and its axis")
    return ToothForm(sides[0], sides[1], (-half_face, half_face), _about_z(-pitch), _bored(root - rim_thickness))


def _spherical_side(drive: Drive, member: MemberName, half_face: float) -> ToothSide:
    sections = np.linspace(-half_face, half_face, _TIP_SAMPLES)
    tip = CubicSpline(sections, _spherical_tip(drive, member, sections))
    end = 0.5 * np.pi - drive.design.value("pressure_angle_deg")
    flank = SectionCurves(_surface(drive, member, "flank"), _axial, np.zeros_like, tip)
    fillet = SectionCurves(_surface(drive, member, "fillet"), _axial, lambda z: np.full_like(z, end), np.zeros_like)
    return ToothSide(fillet, flank)


def _axial(points: Floats) -> Floats:
    return points[..., 2]


def _spherical_tip(drive: Drive, member: MemberName, sections: Floats) -> Floats:
    """Edge parameter (K,) at which the flank meets the blank's tip, by bisection between root and end of the edge."""
    generated = drive.flank(member)
    curves = SectionCurves(_surface(drive, member, "flank"), _axial, np.zeros_like, np.zeros_like)
    low, high = np.zeros_like(sections), np.full_like(sections, drive.design.sizes[f"{member}_edge_end_mm"])
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        face = curves.solve(sections, middle[:, None])[:, 0]
        below = generated(np.stack([middle, face], axis=1)).margins["tip"] > 0.0
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return 0.5 * (low + high)


def _bored(radius: float) -> Callable[[Floats], Floats]:
    """Moves points radially to a bore of the given radius about z."""

    def bore(points: Floats) -> Floats:
        scale = radius / np.hypot(points[..., 0], points[..., 1])
        return points * np.stack([scale, scale, np.ones_like(scale)], axis=-1)

    return bore


_FORMS: dict[str, Callable[[Drive, MemberName, float | None], ToothForm]] = {"spherical": _spherical}
