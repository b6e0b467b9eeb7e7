"""Packaged designs of the face worm report and the same designs in the independent formulation."""

import mpmath

from meshwright import Drive
from tests.independent.face_worm import FaceWorm

NAMES = tuple(f"face-worm-{worm}-{side}" for worm in ("conical", "cylindrical") for side in ("convex", "concave"))

#: The misalignment that the report says the drive absorbs: mm, mm, 3 arcmin in degrees.
ERRORS = {"offset_mm": 0.1, "axial_mm": 0.1, "shaft_angle_deg": 0.05}

UNKNOWNS = ("u_worm", "theta_worm", "psi_worm", "u_gear", "theta_gear")


def driving(drive):
    """+1 where the worm drives towards growing angles (convex), −1 otherwise."""
    return drive.design.flank


def independent(drive):
    """The drive in matrices; hob and placement are found from the design keys alone, near our own values."""
    design = drive.design

    def number(key, table="design"):
        return mpmath.mpf(design.value(key, table))

    twin = FaceWorm(
        sigma=int(design.flank),
        threads=int(design.value("worm_threads")),
        teeth=int(design.value("gear_teeth")),
        module=number("axial_module_mm"),
        offset=number("offset_mm"),
        position=number("worm_axial_position_mm"),
        diameter=number("worm_pitch_diameter_mm"),
        cone=number("worm_cone_angle_deg"),
        inner=number("gear_inner_radius_mm"),
        outer=number("gear_outer_radius_mm"),
        profile=number("profile_angle_deg"),
        plunge=number("plunge_mm_per_rad2"),
        crown=number("blade_parabola_per_mm"),
        rule=design.as_solved()["design"]["pitch_point_rule"],
        d_offset=number("offset_mm", "misalignment"),
        d_axial=number("axial_mm", "misalignment"),
        d_angle=number("shaft_angle_deg", "misalignment"),
    )
    twin.place(
        {
            "phase": number("hob_phase_deg", "placement"),
            "hob_A1": [number(f"hob_{q}_A1_deg", "placement") for q in ("theta", "psi")],
            "hob_A2": [number(f"hob_{q}_A2_deg", "placement") for q in ("theta", "psi")],
        }
    )
    return twin


def changed(name, design=None, misalignment=None):
    """A packaged design with keys changed."""
    return Drive.load(name).with_(design=design or {}, misalignment=misalignment or {})
