"""Cylindrical worm drives: the thread between two grooves of the worm, and the wheel tooth that fills a groove.

Both flanks of either are generated, and of the wheel the fillets, cut by the rounding of the hob's tip; sections of its
tooth are planes z = constant, its root land is what the hob's tip cylinder leaves. The worm's flanks join its root by
arcs. What the blank leaves open takes the proportions of ISO/TR 10828: addendum one axial module, clearance 0.2,
rounding 0.3 or as much as clearance and hob allow, the outside cylinder of a throated wheel half a module beyond its
throat, and the wheel as wide as the chord that the worm's tip circle cuts from its pitch line, or less where the hob's
flank does not reach so far.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from meshwright.base.errors import DesignError
from meshwright.drive import Drive
from meshwright.fe.generated import about_z, region_surface
from meshwright.fe.hexahedra import Floats
from meshwright.fe.hobbed import hobbed_side
from meshwright.fe.profile import Surface
from meshwright.fe.rim import bore_radius, bored
from meshwright.fe.rounding import Span
from meshwright.fe.thread import SideName, ThreadBlank, ThreadFlank, opposite, side_of, thread_teeth
from meshwright.fe.tooth import Teeth, ToothForm, ToothSide

_ADDENDUM, _CLEARANCE, _ROUNDING, _BEYOND_THROAT = 1.0, 0.2, 0.3, 0.5
# Part used of the angle about the hob over which it cuts the wheel.
_SHEET_USED = 0.6
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
    size("hob_tip_rounding_mm", _standard_rounding(drive, hob_tip))
    root = value("cutting_center_distance_mm") - hob - hob_tip
    size("worm_tip_radius_mm", distance - root - _CLEARANCE * module)
    size("worm_root_radius_mm", distance - tip - _CLEARANCE * module)
    chord = 2.0 * module * np.sqrt(2.0 * worm / module + 1.0)
    # The flank ends where the hob's normal has no part along the centre line: at tan = tan(pressure)/sin(lead).
    sheet = np.arctan2(np.tan(value("pressure_angle_deg")), np.sin(value("worm_lead_angle_deg")))
    size("wheel_face_width_mm", min(chord, 2.0 * worm * np.sin(_SHEET_USED * sheet)))
    return drive.with_(blank=assumed), assumed


def _standard_rounding(drive: Drive, hob_tip: float) -> float:
    """Rounding of the hob's tip in mm: the standard one, or what clearance and hob allow if that is less.

    On a straight-sided profile a rounding rho takes rho (1 - sin alpha) from the height, where the clearance is
    (ISO 53), and rho (1 - sin alpha)/cos alpha from the land on either side.
    """
    value = drive.design.value
    angle, module = value("hob_pressure_angle_deg"), value("axial_module_mm")
    groove = drive.design.sizes["groove_width_mm"]
    land = max(0.0, np.pi * value("normal_module_mm") - groove - 2.0 * hob_tip * np.tan(angle))
    allowed = min(_CLEARANCE * module, 0.5 * land * np.cos(angle)) / (1.0 - np.sin(angle))
    return min(_ROUNDING * module, allowed)


def root_radii(drive: Drive) -> dict[str, float]:
    """Root radius in mm of each member of a drive with a whole blank, the wheel's in its middle plane."""
    value = drive.design.value
    hob_tip = value("hob_pitch_radius_mm") + value("hob_tip_addendum_mm", "blank")
    return {
        "pinion": value("worm_root_radius_mm", "blank"),
        "wheel": value("cutting_center_distance_mm") - hob_tip,
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
    """The wheel tooth of a drive with a whole blank; the rim ends at a bore below the root of the middle plane.

    Raises DesignError where the hob leaves no whole tooth in the face, with the widest face in which it is found to do.
    """
    value = drive.design.value
    half = 0.5 * value("wheel_face_width_mm", "blank")
    working, sides = _wheel_sides(drive)
    bore = bored(bore_radius(root_radii(drive)["wheel"], rim_thickness))
    next_tooth = about_z(-2.0 * np.pi / value("wheel_teeth"))
    form = ToothForm.repeated(sides["left"], sides["right"], (-half, half), next_tooth, bore)
    _check_land(form, drive)
    return Teeth(lambda angle: form, working)


def _wheel_sides(drive: Drive) -> tuple[SideName, dict[SideName, ToothSide]]:
    """The working side of the wheel and both sides by name."""
    point, normal = _contact(drive, "wheel")
    working: SideName = "left" if point[0] * normal[1] > point[1] * normal[0] else "right"
    width = drive.design.value("wheel_face_width_mm", "blank")
    try:
        return working, {working: _hobbed(drive, width), opposite(working): _hobbed(_other(drive), width)}
    except DesignError:
        raise
    except ValueError as error:
        widest = _widest_face(drive, width)
        remedy = f"choose at most {widest:g}, the widest face found whole" if widest else (
            "no narrower face is found whole either: change blank.wheel_tip_radius_mm"
        )
        reason = f"the hob leaves no whole tooth there: {error}"
        raise DesignError("blank.wheel_face_width_mm", width, reason, remedy) from error


def _hobbed(drive: Drive, width: float) -> ToothSide:
    """A side of the wheel between faces of a width in mm; raises ValueError where the hob leaves no whole one."""
    drive = drive.with_(blank={"wheel_face_width_mm": width})
    return hobbed_side(drive, _span(drive, "wheel"), (-0.5 * width, 0.5 * width), _below_tip(drive))


def _widest_face(drive: Drive, width: float) -> float | None:
    """Largest face width in mm, of three digits and less than a given one, that has whole sides; None: no width has."""
    decimals = 2 - int(np.floor(np.log10(width)))

    def whole(steps: int) -> bool:
        try:
            for side in (drive, _other(drive)):
                _hobbed(side, round(steps * 10.0**-decimals, decimals))
        except ValueError:
            return False
        return True

    narrow, wide = 0, int(np.ceil(width * 10.0**decimals))
    while wide - narrow > 1:
        middle = (narrow + wide) // 2
        narrow, wide = (middle, wide) if whole(middle) else (narrow, middle)
    return round(narrow * 10.0**-decimals, decimals) if narrow else None


def _check_land(form: ToothForm, drive: Drive) -> None:
    """Refuse a hob without land between its two roundings: then none is left at the root of the wheel either."""
    middle = np.array([0.5 * sum(form.faces)])
    right, cut = form.right.root_end(middle)[0], form.right_cut(middle)[0]
    if right[0] * cut[1] - right[1] * cut[0] >= 0.0:
        rounding = drive.design.value("hob_tip_rounding_mm", "blank")
        raise DesignError(
            "blank.hob_tip_rounding_mm", rounding, "the hob's tip has no land between its roundings", "choose less"
        )


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
