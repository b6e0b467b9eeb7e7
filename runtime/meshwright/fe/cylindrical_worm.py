"""Cylindrical worm drives: the thread between two grooves of the worm, and the wheel tooth that fills a groove.

Both flanks of either are generated. Sections of a wheel tooth are planes z = constant; its root is what the hob's tip
cylinder leaves. What the blank leaves open takes the proportions of ISO/TR 10828: addendum one axial module, clearance
0.2, rounding 0.3, the outside cylinder of a throated wheel half a module beyond its throat, and the wheel as wide as
the chord that the worm's tip circle cuts from its pitch line, or less where the hob's flank does not reach so far.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from meshwright.drive import Drive
from meshwright.errors import DesignError
from meshwright.fe.generated import about_z, region_surface
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import Surface
from meshwright.fe.rim import bore_radius, bored
from meshwright.fe.rounding import Outline, Span, rounded_side
from meshwright.fe.thread import SideName, ThreadBlank, ThreadFlank, opposite, side_of, thread_teeth
from meshwright.fe.tooth import Teeth, ToothForm

_ADDENDUM, _CLEARANCE, _ROUNDING, _BEYOND_THROAT = 1.0, 0.2, 0.3, 0.5
# Part used of the angle about the hob over which it cuts the wheel.
_SHEET_USED = 0.6
_NEWTON_STEPS = 30
# A flank is followed so far beyond its tip, and stops so far before its deepest end, in parts of its half.
_BEYOND_TIP, _BEFORE_ROOT = 0.05, 0.02


def completed(drive: Drive) -> tuple[Drive, dict[str, float]]:
    """The drive with a whole blank, and what of it the design leaves open, in mm by key."""
    value = drive.design.value
    module, worm, hob = value("axial_module_mm"), value("worm_pitch_radius_mm"), value("hob_pitch_radius_mm")
    shift, distance = value("pitch_line_shift_mm"), value("center_distance_mm")
    assumed: dict[str, float] = {}

    def size(key: str, standard: float) -> float:
        given = value(key, "blank")
        if np.isfinite(given):
            return given
        assumed[key] = float(standard)
        return float(standard)

    hob_tip = size("hob_tip_addendum_mm", (_ADDENDUM + _CLEARANCE) * module + shift)
    throat = value("wheel_throat_radius_mm", "blank")
    if np.isfinite(throat):
        tip = throat
        size("wheel_tip_radius_mm", throat + _BEYOND_THROAT * module)
    else:
        tip = size("wheel_tip_radius_mm", drive.design.sizes["wheel_pitch_radius_mm"] + _ADDENDUM * module - shift)
    root = value("cutting_center_distance_mm") - hob - hob_tip
    size("worm_tip_radius_mm", distance - root - _CLEARANCE * module)
    size("worm_root_radius_mm", distance - tip - _CLEARANCE * module)
    chord = 2.0 * module * np.sqrt(2.0 * worm / module + 1.0)
    # The flank ends where the hob's normal has no part along the centre line: at tan = tan(pressure)/sin(lead).
    sheet = np.arctan2(np.tan(value("pressure_angle_deg")), np.sin(value("worm_lead_angle_deg")))
    size("wheel_face_width_mm", min(chord, 2.0 * worm * np.sin(_SHEET_USED * sheet)))
    return drive.with_(blank=assumed), assumed


def root_radii(drive: Drive) -> dict[str, float]:
    """Root radius in mm of each member of a drive with a whole blank, the wheel's in its middle plane."""
    return {
        "pinion": drive.design.value("worm_root_radius_mm", "blank"),
        "wheel": float(_wheel_root(drive)(np.zeros(1))[0]),
    }


def worm_teeth(drive: Drive, rim_thickness: float) -> Teeth:
    """The thread of a drive with a whole blank."""
    value = drive.design.value
    root = root_radii(drive)["pinion"]
    rounding = _ROUNDING * value("axial_module_mm")
    blank = ThreadBlank(value("worm_tip_radius_mm", "blank"), root, rounding, bore_radius(root, rim_thickness))
    facing, normal = _contact(drive, "pinion")
    working = side_of(normal)
    # The other flank belongs to the next groove along the axis.
    turn = -drive.pitch() if working == "left" else drive.pitch()
    flanks: dict[SideName, ThreadFlank] = {
        working: _thread_flank(drive, 0.0),
        opposite(working): _thread_flank(_other(drive), turn),
    }
    return thread_teeth(flanks, working, blank, drive.pitch(), facing)


def _other(drive: Drive) -> Drive:
    return drive.with_(flank="left" if drive.design.flank > 0 else "right")


def _contact(drive: Drive, member: str) -> tuple[Floats, Floats]:
    """Point and outward normal (3,) of a member, body frame, in contact at worm angle 0."""
    found = drive.tca([0.0])
    flank = drive.flank(member)
    here = flank([[found.unknowns[name][0] for name in flank.parameters]])
    return here.points[0], here.normals[0]


def _thread_flank(drive: Drive, turn: float) -> ThreadFlank:
    """A groove's flank turned about the axis; its face parameter is counted from what faces the wheel."""
    surface, rotation = region_surface(drive, "pinion", "flank"), about_z(turn)[:3, :3].T

    def at(angle: float) -> Surface:
        def evaluate(profile: Floats, face: Floats) -> tuple[Floats, Floats]:
            points, normals = surface(profile, face - angle - turn)
            return points @ rotation, normals @ rotation

        return evaluate

    return ThreadFlank(at, _span(drive, "pinion"))


def _span(drive: Drive, member: str) -> Span:
    """The profile as far as blank, tool and singular lines let it exist."""
    rows = drive.surface(member, (2, 9))
    profile = rows.values[:, 0].reshape(rows.shape)
    radii = np.hypot(rows.points[:, 0], rows.points[:, 1]).reshape(rows.shape)
    root, tip = profile if radii[0].mean() < radii[1].mean() else profile[::-1]
    middle = 0.5 * (root.mean() + tip.mean())
    outward = np.sign(tip.mean() - middle)
    highest, deepest = outward * (outward * tip).max(), outward * (outward * root).max()
    ends = deepest + _BEFORE_ROOT * (middle - deepest), highest + _BEYOND_TIP * (highest - middle)
    return Span(float(ends[0]), float(middle), float(ends[1]))


def wheel_teeth(drive: Drive, rim_thickness: float) -> Teeth:
    """The wheel tooth of a drive with a whole blank; the rim ends at a bore below the root of the middle plane."""
    value = drive.design.value
    half = 0.5 * value("wheel_face_width_mm", "blank")
    outline = Outline(_along_axis, _above(_wheel_root(drive)), _below_tip(drive), _ROUNDING * value("axial_module_mm"))
    point, normal = _contact(drive, "wheel")
    working: SideName = "left" if point[0] * normal[1] > point[1] * normal[0] else "right"
    try:
        sides = {
            name: rounded_side(region_surface(d, "wheel", "flank"), _axial, _span(d, "wheel"), (-half, half), outline)
            for name, d in ((working, drive), (opposite(working), _other(drive)))
        }
    except ValueError as error:
        raise DesignError(
            "blank.wheel_face_width_mm",
            2.0 * half,
            f"the hob leaves no whole flank there: {error}",
            "choose a smaller one",
        ) from error
    bore = bored(bore_radius(root_radii(drive)["wheel"], rim_thickness))
    next_tooth = about_z(-2.0 * np.pi / value("wheel_teeth"))
    form = ToothForm.repeated(sides["left"], sides["right"], (-half, half), next_tooth, bore)
    return Teeth(lambda angle: form, working)


def _wheel_root(drive: Drive) -> Callable[[Floats], Floats]:
    """Radius (...,) of the wheel's root at axial positions (...,): the hob's tip cylinder, nearest to the wheel's axis.

    With y across both axes and w along the common normal of z and the perpendicular, z sin S + w cos S = y.
    """
    value = drive.design.value
    tip = value("hob_pitch_radius_mm") + value("hob_tip_addendum_mm", "blank")
    distance, angle = value("cutting_center_distance_mm"), value("cutting_shaft_angle_deg")
    sine, cosine = np.sin(angle), np.cos(angle)

    def root(axial: Floats) -> Floats:
        if np.any(np.abs(axial) * sine >= tip):
            raise DesignError(
                "blank.wheel_face_width_mm",
                value("wheel_face_width_mm", "blank"),
                f"the face reaches past the hob, whose tip radius is {tip:.4g} mm",
                "choose a smaller face width",
            )
        w = np.zeros_like(axial)
        for _ in range(_NEWTON_STEPS):
            y = axial * sine + w * cosine
            x = np.sqrt(tip**2 - y**2)
            slope = (distance - x) * y * cosine / x + w
            bend = cosine**2 * ((distance - x) * (1.0 / x + y**2 / x**3) + y**2 / x**2) + 1.0
            w = w - slope / bend
        y = axial * sine + w * cosine
        return np.hypot(distance - np.sqrt(tip**2 - y**2), w)

    return root


def _above(root: Callable[[Floats], Floats]) -> Callable[[Floats], tuple[Floats, Floats]]:
    def above_root(points: Floats) -> tuple[Floats, Floats]:
        radius = np.hypot(points[..., 0], points[..., 1])
        radial = np.stack([points[..., 0] / radius, points[..., 1] / radius, np.zeros_like(radius)], axis=-1)
        return radius - root(points[..., 2]), radial

    return above_root


def _below_tip(drive: Drive) -> Callable[[Floats], Floats]:
    """Height (...,) left to the outside cylinder and to the throat, whichever is nearer."""
    value = drive.design.value
    outside, throat = value("wheel_tip_radius_mm", "blank"), value("wheel_throat_radius_mm", "blank")
    distance = value("center_distance_mm")

    def below(points: Floats) -> Floats:
        radius = np.hypot(points[..., 0], points[..., 1])
        to_throat = np.hypot(distance - radius, points[..., 2]) - (distance - throat)
        return np.fmin(outside - radius, to_throat)

    return below


def _axial(points: Floats) -> Floats:
    return points[..., 2]


def _along_axis(points: Floats) -> Floats:
    return np.broadcast_to([0.0, 0.0, 1.0], points.shape)
