"""Spherical gears: both flanks and fillets of a tooth from the generated surfaces of one design.

Sections are planes z = constant; the rounding of the rack's tip ends where its normal is radial.
"""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline

from meshwright.drive import Drive
from meshwright.fe.generated import about_z, constant, region_surface, tip_parameter
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import SectionCurves
from meshwright.fe.rim import bore_radius, bored
from meshwright.fe.tooth import Teeth, ToothForm, ToothSide

_TIP_SAMPLES = 33


def root_radii(drive: Drive) -> dict[str, float]:
    """Root radius in mm of each member."""
    return {member: drive.design.sizes[f"{member}_root_radius_mm"] for member in ("pinion", "wheel")}


def gear_teeth(drive: Drive, member: str, rim_thickness: float) -> Teeth:
    """The teeth of a member; the rim ends at a bore ``rim_thickness`` mm below the root, not deeper than 0.8 radii."""
    design = drive.design
    half_face = 0.5 * design.value(f"{member}_face_width_mm")
    pitch = 2.0 * np.pi / design.value(f"{member}_teeth")
    left, right = (_side(drive.with_(flank=flank), member, half_face) for flank in ("left", "right"))
    bore = bored(bore_radius(root_radii(drive)[member], rim_thickness))
    form = ToothForm.repeated(left, right, (-half_face, half_face), about_z(-pitch), bore)
    return Teeth(lambda angle: form, "left" if design.flank > 0 else "right")


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
