"""A thread between two grooves: its generated flanks, its root and tip from the drive's function ``solid_<member>``.

Both flanks come from the designs of either flank: one design makes both sides of a groove, and the thread's second side
is that of the next groove; where flanks have designs of their own, the second one is turned to the thread's thickness.
Arcs join flanks and root.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from meshwright.base.errors import DesignError
from meshwright.contact.contact_line import contact_line
from meshwright.contact.functions import has
from meshwright.design.description import table_and_key
from meshwright.drive import Drive
from meshwright.fe.generated import constant, on_sections, pierced, region_surface, turned
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import SectionCurves, Surface
from meshwright.fe.rim import bore_radius
from meshwright.fe.rounding import Span
from meshwright.fe.sizes import other_flank, solid_sizes
from meshwright.fe.thread import (
    HALF_PORTION,
    HalfPlanes,
    Revolved,
    Root,
    ThreadBlank,
    ThreadFlank,
    opposite,
    side_of,
    thread_teeth,
)
from meshwright.fe.tooth import SideName, Teeth
from meshwright.flank.surface import Flank, FlankPoints

# A flank is followed so far beyond its tip, and stops so far before its deepest end, in parts of its half.
_BEYOND_TIP, _BEFORE_ROOT = 0.05, 0.02
# Factors of the first and of the last of three parameters, of x, y, z and the distance from the axis.
_FIRST_AND_LAST = np.eye(7)[[0, 2]]
# Lines on which the profile of a flank is followed; how far beyond the neighbours of a portion, rad.
_LINES_PER_RADIAN, _BEYOND_PORTION = 12, 0.2
# Steps of Newton's method to the ends of a line across a flank, and its precision, in natural sizes of the profile.
_NEWTON_STEPS, _PROFILE_STEP = 20, 1e-4
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

    Raises ValueError where the second flank finds no place, DesignError where the thread that faces the wheel at the
    angle 0 is not whole.
    """
    sides = thread_sides(drive, member, rim_thickness)
    teeth = thread_teeth(sides.flanks, sides.working, sides.blank, drive.pitch(), sides.facing)
    form = teeth.at(0.0)
    for cut in (form.left_cut, form.right_cut):
        cut(np.array(form.faces))
    return teeth


def thread_sides(drive: Drive, member: str, rim_thickness: float, other: Drive | None = None) -> ThreadSides:
    """Flanks and blank of the thread of a drive with a whole blank, as for :func:`threads`; ``other``: the drive of the
    other flank, None for that of :func:`~meshwright.fe.sizes.other_flank`.
    """
    sizes = solid_sizes(drive, member)
    bore = bore_radius(sizes["root_radius"], rim_thickness)
    blank = ThreadBlank(revolved(drive, member, sizes), sizes["root_radius"], sizes["rounding"], bore)
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
        working: _facing(surfaces[0], spans[0], 0.0),
        opposite(working): _facing(surfaces[1], spans[1], turn),
    }
    return ThreadSides(flanks, working, blank, facing)


def revolved(drive: Drive, member: str, sizes: dict[str, float]) -> Revolved:
    """Tip and root as the drive's function ``outline_<member>`` says, or else the cones of its sizes."""
    name = f"outline_{member}"
    if not has(drive, name):
        return Revolved.cones(sizes["tip_radius"], sizes["root_radius"], sizes["taper"])
    outline = drive.function(name)

    def root(radius: Floats, z: Floats) -> Root:
        found = outline(radius, z)
        return Root(found["root"], (found["root_slopes"][..., 0], found["root_slopes"][..., 1]))

    return Revolved(lambda radius, z: outline(radius, z)["tip"], root)


def contact(drive: Drive, member: str) -> tuple[Floats, Floats]:
    """Point and outward normal (3,) of a member, body frame, in contact at pinion angle 0."""
    here = drive.flank(member)(place_in_contact(drive, member)[None])
    return here.points[0], here.normals[0]


def place_in_contact(drive: Drive, member: str) -> Floats:
    """Parameters (k,) of a member's flank in contact at pinion angle 0, of a line in its middle.

    Raises DesignError where nothing touches, naming the flank that the blank leaves empty if that is why.
    """
    found = drive.tca([0.0])
    if found.solved[0]:
        return np.array([found.unknowns[name][0] for name in drive.flank(member).parameters])
    check_flanks(drive)
    if found.status[0] == "line_contact":
        on_line = contact_line(drive, 0.0, found.solutions[0]).parameters[member]
        if len(on_line):
            return on_line[len(on_line) // 2]
    name = drive.design.tables.get("name")
    reason = f"no contact at a pinion angle of 0 ({found.status[0]})"
    raise DesignError("design", name, reason, "change the blank or the design until `meshwright tca` finds one there")


def check_flanks(drive: Drive) -> None:
    """Raise DesignError where the blank leaves a flank empty."""
    for of in ("pinion", "wheel"):
        flank = drive.region(of)
        if flank.empty:
            tip = drive.design.description["loading"]["keys"].get(f"{of}_tip") if "tip" in flank.conflict else None
            value = drive.design.value(*reversed(table_and_key(tip))) if tip else None
            raise DesignError(tip or "blank", value, flank.why_empty, f"change {tip}" if tip else "change the blank")


def span(drive: Drive, member: str) -> Span:
    """The profile: as the drive says, else as far as blank, tool and singular lines let it exist.

    Where it is not the same all along, as that of a screw is, its ends are followed along the flank, and on beyond the
    ends of its face.
    """
    sizes = solid_sizes(drive, member)
    if "span_root" in sizes:
        return Span.constant(sizes["span_root"], sizes["span_middle"], sizes["span_tip"])
    if "taper" not in sizes:
        return _followed(drive, member, revolved(drive, member, sizes))
    rows = drive.surface(member, (2, 9))
    profile = rows.values[:, 0].reshape(rows.shape)
    radii = np.hypot(rows.points[:, 0], rows.points[:, 1]).reshape(rows.shape)
    root, tip = profile if radii[0].mean() < radii[1].mean() else profile[::-1]
    middle = 0.5 * (root.mean() + tip.mean())
    outward = np.sign(tip.mean() - middle)
    highest, deepest = outward * (outward * tip).max(), outward * (outward * root).max()
    return Span.constant(*map(float, _ends(deepest, middle, highest)))


def _ends(root: Floats, middle: Floats, tip: Floats) -> tuple[Floats, Floats, Floats]:
    """Profile parameters just before the deepest place of a flank, at its middle and a little beyond its tip."""
    return root + _BEFORE_ROOT * (middle - root), middle, tip + _BEYOND_TIP * (tip - middle)


def _followed(drive: Drive, member: str, revolved: Revolved) -> Span:
    """The profile of a thread that is none of a screw, from contact at pinion angle 0 along root and tip: as far as the
    flank is used, and on as far as a portion there and its neighbours reach, or the flank does.
    """
    surface, start = _surface(drive, member), place_in_contact(drive, member)
    used = drive.region(member).triangles.parameters[:, -1]
    beyond = drive.pitch() + HALF_PORTION + _BEYOND_PORTION

    def heights(profile: Floats, face: float) -> Floats:
        """Height (2,) above the root at the first of two profile parameters, below the tip at the other."""
        points, _ = surface(profile, np.full(2, face))
        radius, z = np.hypot(points[:, 0], points[:, 1]), points[:, 2]
        return np.array([revolved.root(radius, z).above[0], revolved.below_tip(radius, z)[1]])

    step = float(drive.flank(member).sizes[0]) * _PROFILE_STEP
    places = [_ends_at(heights, np.full(2, start[0]), float(start[-1]), step)]
    if places[0] is None:
        raise ValueError("the flank does not reach its tip and root where it touches")
    rows = [(float(start[-1]), places[0])]
    for way, last in ((-1.0, used.min() - beyond), (1.0, used.max() + beyond)):
        rows = _lines(heights, rows[::-1], way / _LINES_PER_RADIAN, last, step)
    face, ends = np.array([at for at, _ in rows]), np.array([found for _, found in rows])
    root, tip = (CubicSpline(face, end) for end in ends.T)

    def end(number: int) -> Callable[[Floats], Floats]:
        def profile(at: Floats) -> Floats:
            at = np.clip(at, face[0], face[-1])
            return _ends(root(at), 0.5 * (root(at) + tip(at)), tip(at))[number]

        return profile

    return Span(end(0), end(1), end(2))


_Heights = Callable[[Floats, float], Floats]


def _lines(
    heights: _Heights, rows: list[tuple[float, Floats]], step: float, last: float, profile_step: float
) -> list[tuple[float, Floats]]:
    """Face parameters and ends (2,) of profiles, followed from the last of them on to a last face parameter."""
    rows = list(rows)
    while (last - rows[-1][0]) * step > 0.0:
        at, ends = rows[-1]
        near = ends if len(rows) < 2 else 2.0 * ends - rows[-2][1]
        found = _ends_at(heights, near, at + step, profile_step)
        if found is None or (found[1] - found[0]) * (ends[1] - ends[0]) <= 0.0:
            break
        rows.append((at + step, found))
    return rows


def _ends_at(heights: _Heights, near: Floats, face: float, step: float) -> Floats | None:
    """Profile parameters (2,) of root and tip on one line across a flank, from nearby ones; None for none."""
    found = near.copy()
    for _ in range(_NEWTON_STEPS):
        slope = (heights(found + step, face) - heights(found - step, face)) / (2.0 * step)
        with np.errstate(divide="ignore", invalid="ignore"):
            change = heights(found, face) / slope
        found = found - change
        if not np.isfinite(found).all():
            return None
        if np.abs(change).max() < step:
            return found
    return None


def _facing(surface: Surface, of: Span, turn: float) -> ThreadFlank:
    """The flank turned about z, its face parameter counted from what faces the wheel at each angle of the thread."""
    sense = _sense(surface, of)
    return ThreadFlank(
        lambda angle: turned(surface, turn, sense * (angle + turn)),
        lambda angle: of.counted_from(sense * (angle + turn)),
    )


def _sense(surface: Surface, of: Span) -> float:
    """1 where the azimuth grows with the face parameter, else −1."""
    here = np.array([-_SENSE_STEP, _SENSE_STEP])
    points, _ = surface(of.middle(here), here)
    return float(np.sign(points[0, 0] * points[1, 1] - points[0, 1] * points[1, 0]))


def _turn_to_thickness(
    surfaces: tuple[Surface, Surface], spans: tuple[Span, Span], thickness: float, screw_parameter: float
) -> float:
    """Angle in rad by which the other flank turns about the axis to stand ``thickness`` mm beyond the own along z.

    Both are taken at the middle of their profiles.
    """
    here = np.zeros(1)
    (own_point,), _ = surfaces[0](spans[0].middle(here), here)
    azimuth = np.arctan2(own_point[1], own_point[0])
    wanted = own_point[2] + thickness
    middle = float(spans[1].middle(here)[0])
    turn = 0.0
    for _ in range(_FIXED_POINT_STEPS):
        flank = _facing(surfaces[1], spans[1], turn).at(0.0)
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

    def pierced(self, feet: Floats, plane: Floats, start: tuple[float, float]) -> tuple[Floats, ...]:
        q = pierced(self.generated, feet, plane, self._places(*np.array(start)[:, None])[0])
        found = self.generated(q)
        return q[:, 0], q[:, 2], found.points, found.normals

    def on_sections(self, profile: Floats, factors: Floats, values: Floats, start: Floats) -> tuple[Floats, ...]:
        near = np.stack([profile, np.zeros_like(profile), start], axis=1)
        found = self.generated(on_sections(self.generated, profile, factors, values, near))
        return found.parameters[:, 2], found.points, found.normals

    def _at(self, profile: Floats, face: Floats) -> FlankPoints:
        return self.generated(self._places(profile, face))

    def _places(self, profile: Floats, face: Floats) -> Floats:
        start = np.stack([profile, np.zeros_like(profile), face], axis=1)
        return self.generated.places(_FIRST_AND_LAST, self.generated.sizes, start[:, ::2], start)
