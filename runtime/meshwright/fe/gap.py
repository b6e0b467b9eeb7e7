"""The gap between two flanks, measured along the contact normal on a grid in the tangent plane."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from meshwright.fe.hexahedra import Floats
from meshwright.fe.pair import GearPair, Member, PairTouch
from meshwright.fe.profile import Rail, SectionCurves, Smooth
from meshwright.flank.sections import solved

Bools = NDArray[np.bool_]

_NEWTON_STEPS = 20
# After so many steps a normal that comes no closer than to this part of its miss before meets no flank.
_EARLY_STEPS, _CLOSER = 8, 0.5
_STEP_TOLERANCE = 1e-13
# A flank with an edge near the grid may leave some of the normals unmet.
_PIERCED = 1e-9


@dataclass(frozen=True)
class ContactGrid:
    """Cells of the tangent plane of one pair, N of them.

    centres (N, 2) in mm along (major, minor) axis from the contact point; half_major, half_minor: half lengths of a
    cell.  gap (N,) in mm, positive apart.  points (N, 3): pinion surface points in the fixed frame.  inside (N,): both
    flanks are there.  beyond: by the name of an edge, such as "tip of the wheel", the cells (N,) that lie beyond it.
    place: for each member the fractions (N, 2) of flank arc length and face width.
    """

    centres: Floats
    half_major: float
    half_minor: float
    gap: Floats
    points: Floats
    inside: Bools
    beyond: dict[str, Bools]
    place: dict[str, Floats]

    @property
    def area(self) -> float:
        """Area of a cell in mm^2."""
        return 4.0 * self.half_major * self.half_minor


def contact_grid(
    gear: GearPair, contact: PairTouch, angles: tuple[float, float], reach: tuple[float, float], cells: int,
    centre: Floats | None = None,
) -> ContactGrid:
    """Grid of cells x cells around a contact point with both members at given angles.

    angles: pinion and wheel angle in rad of the whole bodies; reach: half lengths of the grid along the major and
    minor axis in mm; centre: of the grid (2,) along them, by default the contact point.
    """
    touch = contact.touch
    ticks = (2.0 * np.arange(cells) + 1.0) / cells - 1.0
    middle = np.zeros(2) if centre is None else centre
    along = (middle[k] + ticks * reach[k] for k in (0, 1))
    x, y = (axis.ravel() for axis in np.meshgrid(*along, indexing="ij"))
    plane = contact_axes(contact)
    feet = touch.point + np.stack([x, y], axis=1) @ plane[:2]
    surfaces = _footprints(gear, contact, angles, feet, plane)
    gap = _gap(surfaces, touch.normal)
    inside = surfaces["pinion"].inside & surfaces["wheel"].inside
    beyond = {f"{edge} of the {name}": cells for name, f in surfaces.items() for edge, cells in f.beyond.items()}
    place = {name: footprint.place for name, footprint in surfaces.items()}
    half = (reach[0] / cells, reach[1] / cells)
    return ContactGrid(np.stack([x, y], axis=1), *half, gap, surfaces["pinion"].points, inside, beyond, place)


def gap_at(gear: GearPair, contact: PairTouch, angles: tuple[float, float], feet: Floats) -> tuple[Floats, Bools]:
    """Gap (N,) in mm of the flanks along the contact normal through points (N, 3), and where both flanks are (N,)."""
    surfaces = _footprints(gear, contact, angles, feet, contact_axes(contact))
    return _gap(surfaces, contact.touch.normal), surfaces["pinion"].inside & surfaces["wheel"].inside


def contact_axes(contact: PairTouch) -> Floats:
    """Rows (3, 3) major axis, minor axis and normal of a contact, fixed frame."""
    touch = contact.touch
    return np.stack([touch.major_direction, np.cross(touch.normal, touch.major_direction), touch.normal])


def _footprints(
    gear: GearPair, contact: PairTouch, angles: tuple[float, float], feet: Floats, plane: Floats
) -> dict[str, _Footprint]:
    """Both flanks of a pair as the normals through the feet (N, 3) meet them, with the members at their angles."""
    return {
        name: _Footprint.of(
            member, angle - contact.pairs_later * member.pitch, feet, plane, gear.deviations.get(name)
        )
        for name, member, angle in (("pinion", gear.pinion, angles[0]), ("wheel", gear.wheel, angles[1]))
    }


def _gap(surfaces: dict[str, _Footprint], normal: Floats) -> Floats:
    gap = (surfaces["wheel"].points - surfaces["pinion"].points) @ normal
    return gap + surfaces["wheel"].excess - surfaces["pinion"].excess


@dataclass(frozen=True)
class _Footprint:
    """Where the normals of the tangent plane through N feet pierce a flank: fixed frame.

    excess (N,): what a measured flank adds to its height along the normal, mm.
    """

    points: Floats
    inside: Bools
    beyond: dict[str, Bools]
    place: Floats
    excess: Floats

    @staticmethod
    def of(
        member: Member,
        angle: float,
        feet: Floats,
        plane: Floats,
        deviations: Callable[[Floats, Floats], tuple[Floats, Bools]] | None = None,
    ) -> _Footprint:
        form, pose = member.tooth(angle), member.pose(angle)
        curves = form.side(member.working).flank
        rotation = pose[:3, :3]
        feet_body = (feet - pose[:3, 3]) @ rotation
        plane_body = plane @ rotation
        rail = curves.rail(np.clip(np.atleast_1d(curves.section.at(feet_body.mean(axis=0))), *form.faces))
        profile, face = _pierce(curves, rail, feet_body, plane_body)
        points = curves.surface(profile, face)[0]
        pierced = np.abs((points - feet_body) @ plane_body[:2].T).max(axis=1) < _PIERCED
        points = np.where(np.isfinite(points), points, feet_body)
        section = curves.section.at(points)
        low, high = form.faces
        held = np.clip(section, low, high)
        first, last = curves.first(held), curves.last(held)
        fraction = (profile - first) / (last - first)
        beyond = {
            "fillet": pierced & (fraction < 0.0),
            "tip": pierced & (fraction > 1.0),
            "end of the portion" if form.cut_ends else "face": pierced & ((section < low) | (section > high)),
        }
        excess = np.zeros(len(points))
        if deviations is not None:
            excess, measured = deviations(points, plane_body[2])
            beyond["measured grid"] = pierced & ~measured
        inside = pierced & ~np.any(list(beyond.values()), axis=0)
        # A cell off the flank has no pressure; its gap and its place only have to be finite.
        fraction = np.nan_to_num(fraction)
        place = np.stack([_arc_share(rail, fraction), (section - low) / (high - low)], axis=1)
        return _Footprint(points @ rotation.T + pose[:3, 3], inside, beyond, place, excess)


def _pierce(curves: SectionCurves, rail: Rail, feet: Floats, plane: Floats) -> tuple[Floats, Floats]:
    """Surface parameters (N,), (N,) with tangent-plane coordinates equal to those of ``feet`` (N, 3)."""
    profile, face = (np.full(len(feet), value) for value in _nearest(rail, feet.mean(axis=0)))
    surface = curves.surface
    if not isinstance(surface, Smooth):
        raise TypeError("a flank whose tangents nobody knows is met by no normals")
    going, before = np.arange(len(feet)), np.full(len(feet), np.inf)
    for step in range(_NEWTON_STEPS):
        at = profile[going], face[going]
        points, tangents = surface.tangents(*at)
        miss = (points - feet[going]) @ plane[:2].T
        change = solved(np.swapaxes(tangents @ plane[:2].T, 1, 2), miss)
        found = np.isfinite(change).all(axis=1)
        change[~found] = 0.0
        profile[going], face[going] = at[0] - change[:, 0], at[1] - change[:, 1]
        largest = np.abs(miss).max(axis=1)
        closer = (largest < _CLOSER * before) | (step < _EARLY_STEPS)
        more = found & closer & (largest >= _STEP_TOLERANCE * 1e2)
        going, before = going[more], largest[more]
        if not len(going):
            break
    return profile, face


def _nearest(rail: Rail, point: Floats) -> tuple[float, float]:
    """Parameters of the point of a single tabulated section next to ``point``, a start for Newton's method."""
    index = int(np.argmin(np.linalg.norm(rail.table[0] - point, axis=1)))
    profile = rail.profile[:, index : index + 1]
    return float(profile[0, 0]), float(rail.curves.solve(rail.values, profile)[0, 0])


def _arc_share(rail: Rail, fraction: Floats) -> Floats:
    """Fractions (N,) of the arc length at fractions (N,) of the profile parameter, in the section of the contact."""
    (profile,), (lengths,) = rail.profile, rail.lengths
    return np.interp(fraction, (profile - profile[0]) / (profile[-1] - profile[0]), lengths / lengths[-1])
