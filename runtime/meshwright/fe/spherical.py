"""Spherical gears: both flanks and fillets of a tooth from the generated surfaces of one design.

Sections are planes z = constant; the rounding of the rack's tip ends where its normal is radial.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.interpolate import CubicSpline

from meshwright.drive import Drive
from meshwright.errors import UsageError
from meshwright.fe.generated import about_z, constant, region_surface, tip_parameter
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import SectionCurves
from meshwright.fe.tooth import ToothForm, ToothSide

# The rim reaches at most so many root radii below the root.
_DEEPEST_RIM = 0.8
_TIP_SAMPLES = 33


def check_rim(drive: Drive, rim_thickness: float) -> None:
    """Refuse a rim deeper than the members allow; members without a root radius have no bore and allow any."""
    for member in ("pinion", "wheel"):
        root = drive.design.sizes.get(f"{member}_root_radius_mm", np.inf)
        if rim_thickness > _DEEPEST_RIM * root:
            raise UsageError(
                f"--rim-mm {rim_thickness:g}: no bore is left in the {member}, whose root radius is {root:.4g} mm; "
                f"give at most {_DEEPEST_RIM * root:.4g}"
            )


def gear_form(drive: Drive, member: str, rim_thickness: float) -> ToothForm:
    """The tooth of a member; the rim ends at a bore ``rim_thickness`` mm below the root, not deeper than 0.8 radii."""
    design = drive.design
    half_face = 0.5 * design.value(f"{member}_face_width_mm")
    pitch = 2.0 * np.pi / design.value(f"{member}_teeth")
    left, right = (_side(drive.with_(flank=flank), member, half_face) for flank in ("left", "right"))
    root = design.sizes[f"{member}_root_radius_mm"]
    bore = root - min(rim_thickness, _DEEPEST_RIM * root)
    return ToothForm(left, right, (-half_face, half_face), about_z(-pitch), _bored(bore))


def _side(drive: Drive, member: str, half_face: float) -> ToothSide:
    sections = np.linspace(-half_face, half_face, _TIP_SAMPLES)
    edge = (0.0, drive.design.sizes[f"{member}_edge_end_mm"])
    tip = CubicSpline(sections, tip_parameter(drive, member, _axial, sections, edge))
    radial = 0.5 * np.pi - drive.design.value("pressure_angle_deg")
    flank = SectionCurves(region_surface(drive, member, "flank"), _axial, constant(0.0), tip)
    fillet = SectionCurves(region_surface(drive, member, "fillet"), _axial, constant(radial), constant(0.0))
    return ToothSide(fillet, flank)


def _axial(points: Floats) -> Floats:
    return points[..., 2]


def _bored(radius: float) -> Callable[[Floats], Floats]:
    """Moves points radially to a bore of the given radius about z."""

    def bore(points: Floats) -> Floats:
        scale = radius / np.hypot(points[..., 0], points[..., 1])
        return points * np.stack([scale, scale, np.ones_like(scale)], axis=-1)

    return bore
