"""A thread between two grooves: its generated flanks, its root and tip from the drive's function ``solid_<member>``.

Both flanks come from the designs of either flank: one design makes both sides of a groove, and the thread's second side
is that of the next groove; where flanks have designs of their own, the second one is turned to the thread's thickness.
Arcs join flanks and root.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import DesignError
from meshwright.design.description import table_and_key
from meshwright.drive import Drive
from meshwright.fe.generated import constant, on_sections, pierced, region_surface, turned
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import SectionCurves, Surface
from meshwright.fe.rim import bore_radius
from meshwright.fe.rounding import Span
from meshwright.fe.sizes import other_flank, solid_sizes
from meshwright.fe.thread import HalfPlanes, ThreadBlank, ThreadFlank, opposite, side_of, thread_teeth
from meshwright.fe.tooth import SideName, Teeth
from meshwright.flank.surface import Flank, FlankPoints

# A flank is followed so far beyond its tip, and stops so far before its deepest end, in parts of its half.
_BEYOND_TIP, _BEFORE_ROOT = 0.05, 0.02
# Factors of the first and of the last of three parameters, of x, y, z and the distance from the axis.
_FIRST_AND_LAST = np.eye(7)[[0, 2]]
_FIXED_POINT_STEPS = 20
_THICKNESS_TOLERANCE = 1e-9
# Step of the face parameter that shows which way it runs, rad.
_SENSE_STEP = 1e-3


@dataclass(frozen=True)
class ThreadSides:
    """Both flanks of a thread in hand, the pinion's own side, its blank and a point (3,) of it that faces the wheel."""

    flanks: dict[SideName, ThreadFlank]
    working: SideName
    blank: ThreadBlank
    facing: Floats


def threads(drive: Drive, member: str, rim_thickness: float) -> Teeth:
    """The thread of a drive with a whole blank; rim_thickness in mm from the root to the bore.

    Raises ValueError where the second flank finds no place.
    """
    sides = thread_sides(drive, member, rim_thickness)
    return thread_teeth(sides.flanks, sides.working, sides.blank, drive.pitch(), sides.facing)


def thread_sides(drive: Drive, member: str, rim_thickness: float, other: Drive | None = None) -> ThreadSides:
    """Flanks and blank of the thread of a drive with a whole blank, as for :func:`threads`; ``other``: the drive of the
    other flank, None for that of :func:`~meshwright.fe.sizes.other_flank`.
    """
    sizes = solid_sizes(drive, member)
    bore = bore_radius(sizes["root_radius"], rim_thickness)
    blank = ThreadBlank(sizes["tip_radius"], sizes["root_radius"], sizes["rounding"], bore, sizes["taper"])
    facing, normal = contact(drive, member)
    working = side_of(normal)
    other = other or other_flank(drive)
    surfaces = _surface(drive, member), _surface(other, member)
    spans = span(drive, member), span(other, member)
    if "thickness" in sizes:
        beyond = sizes["thickness"] * (1.0 if working == "left" else -1.0)
        turn = _turn_to_thickness(surfaces, spans, beyond, sizes["screw_parameter"])
    else:
        # The other flank belongs to the next groove along the axis.
        turn = -drive.pitch() if working == "left" else drive.pitch()
    flanks: dict[SideName, ThreadFlank] = {
        working: ThreadFlank(_facing(surfaces[0], spans[0], 0.0), spans[0]),
        opposite(working): ThreadFlank(_facing(surfaces[1], spans[1], turn), spans[1]),
    }
    return ThreadSides(flanks, working, blank, facing)


def contact(drive: Drive, member: str) -> tuple[Floats, Floats]:
    """Point and outward normal (3,) of a member, body frame, in contact at pinion angle 0."""
    here = drive.flank(member)(place_in_contact(drive, member)[None])
    return here.points[0], here.normals[0]


def place_in_contact(drive: Drive, member: str) -> Floats:
    """Parameters (k,) of a member's flank in contact at pinion angle 0.

    Raises DesignError where nothing touches, naming the flank that the blank leaves empty if that is why.
    """
    found = drive.tca([0.0])
    if found.solved[0]:
        return np.array([found.unknowns[name][0] for name in drive.flank(member).parameters])
    for of in ("pinion", "wheel"):
        flank = drive.region(of)
        if flank.empty:
            tip = drive.design.description["loading"]["keys"].get(f"{of}_tip") if "tip" in flank.conflict else None
            value = drive.design.value(*reversed(table_and_key(tip))) if tip else None
            raise DesignError(tip or "blank", value, flank.why_empty, f"change {tip}" if tip else "change the blank")
    name = drive.design.tables.get("name")
    reason = f"no contact at a pinion angle of 0 ({found.status[0]})"
    raise DesignError("design", name, reason, "change the blank or the design until `meshwright tca` finds one there")


def span(drive: Drive, member: str) -> Span:
    """The profile: as the drive says, else as far as blank, tool and singular lines let it exist."""
    sizes = solid_sizes(drive, member)
    if "span_root" in sizes:
        return Span(sizes["span_root"], sizes["span_middle"], sizes["span_tip"])
    rows = drive.surface(member, (2, 9))
    profile = rows.values[:, 0].reshape(rows.shape)
    radii = np.hypot(rows.points[:, 0], rows.points[:, 1]).reshape(rows.shape)
    root, tip = profile if radii[0].mean() < radii[1].mean() else profile[::-1]
    middle = 0.5 * (root.mean() + tip.mean())
    outward = np.sign(tip.mean() - middle)
    highest, deepest = outward * (outward * tip).max(), outward * (outward * root).max()
    ends = deepest + _BEFORE_ROOT * (middle - deepest), highest + _BEYOND_TIP * (highest - middle)
    return Span(float(ends[0]), float(middle), float(ends[1]))


def _facing(surface: Surface, of: Span, turn: float) -> Callable[[float], Surface]:
    """The flank turned about z, its face parameter counted from what faces the wheel at each angle of the thread."""
    sense = _sense(surface, of)

    def at(angle: float) -> Surface:
        return turned(surface, turn, sense * (angle + turn))

    return at


def _sense(surface: Surface, of: Span) -> float:
    """1 where the azimuth grows with the face parameter, else −1."""
    points, _ = surface(np.full(2, of.middle), np.array([-_SENSE_STEP, _SENSE_STEP]))
    return float(np.sign(points[0, 0] * points[1, 1] - points[0, 1] * points[1, 0]))


def _turn_to_thickness(
    surfaces: tuple[Surface, Surface], spans: tuple[Span, Span], thickness: float, screw_parameter: float
) -> float:
    """Angle in rad by which the other flank turns about the axis to stand ``thickness`` mm beyond the own along z.

    Both are taken at the middle of their profiles.
    """
    (own_point,), _ = surfaces[0](np.full(1, spans[0].middle), np.zeros(1))
    azimuth = np.arctan2(own_point[1], own_point[0])
    wanted = own_point[2] + thickness
    middle = spans[1].middle
    turn = 0.0
    for _ in range(_FIXED_POINT_STEPS):
        flank = _facing(surfaces[1], spans[1], turn)(0.0)
        curves = SectionCurves(flank, HalfPlanes(1.0, azimuth), constant(middle), constant(middle))
        found = float(curves.points(np.zeros(1), np.full((1, 1), middle))[0, 0, 2])
        # A right-hand thread turned forwards stands back by its screw parameter.
        turn += (found - wanted) / screw_parameter
        if abs(found - wanted) < _THICKNESS_TOLERANCE:
            return turn
    raise ValueError(f"the second flank of the thread finds no place ({found - wanted:.3g} mm off)")


def _surface(drive: Drive, member: str) -> Surface:
    """A member's flank over its first and last parameter; of three, the one between follows from the equation of
    meshing.
    """
    generated = drive.flank(member)
    if len(generated.parameters) == 2:
        return region_surface(drive, member, "flank")
    return _Enveloped(generated)


@dataclass(frozen=True)
class _Enveloped:
    """A flank over the first and the last of its three parameters: :class:`~meshwright.fe.profile.Cut`."""

    generated: Flank

    def __call__(self, profile: Floats, face: Floats) -> tuple[Floats, Floats]:
        profile, face = np.broadcast_arrays(profile, face)
        found = self._at(profile.ravel(), face.ravel())
        return found.points.reshape(*profile.shape, 3), found.normals.reshape(*profile.shape, 3)

    def pierced(self, feet: Floats, plane: Floats, start: tuple[float, float]) -> tuple[Floats, Floats, Floats]:
        q = pierced(self.generated, feet, plane, self._places(*np.array(start)[:, None])[0])
        return q[:, 0], q[:, 2], self.generated(q).points

    def on_sections(self, profile: Floats, factors: Floats, values: Floats, start: float) -> tuple[Floats, ...]:
        found = self.generated(on_sections(self.generated, profile, factors, values, np.array([0.0, 0.0, start])))
        return found.parameters[:, 2], found.points, found.normals

    def _at(self, profile: Floats, face: Floats) -> FlankPoints:
        return self.generated(self._places(profile, face))

    def _places(self, profile: Floats, face: Floats) -> Floats:
        start = np.stack([profile, np.zeros_like(profile), face], axis=1)
        return self.generated.places(_FIRST_AND_LAST, self.generated.sizes, start[:, ::2], start)
