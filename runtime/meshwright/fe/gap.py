"""The gap between two flanks, measured along the contact normal on a grid in the tangent plane."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from meshwright.fe.hexahedra import Floats
from meshwright.fe.pair import GearPair, Member, PairTouch
from meshwright.fe.profile import Rail, SectionCurves, Smooth
from meshwright.fe.tooth import ToothForm

Bools = NDArray[np.bool_]

# A flank with an edge near the grid may leave some of the normals unmet.
_PIERCED = 1e-9
# So far beyond an edge, in parts of the flank, a place lies on it: what a corner of a mesh there is off by rounding.
_ON_EDGE = 1e-9


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


@dataclass(frozen=True)
class ContactPlane:
    """The tangent plane of a pair's contact with both members at given angles, and the flanks of both over it.

    axes: rows (3, 3) major axis, minor axis and normal, fixed frame.
    """

    contact: PairTouch
    axes: Floats
    flanks: dict[str, _Flank]

    @classmethod
    def of(cls, gear: GearPair, contact: PairTouch, angles: tuple[float, float]) -> ContactPlane:
        """angles: pinion and wheel angle in rad of the whole bodies."""
        touch = contact.touch
        axes = np.stack([touch.major_direction, np.cross(touch.normal, touch.major_direction), touch.normal])
        flanks = {
            name: _Flank.of(member, angle - contact.pairs_later * member.pitch, touch.point, axes,
                            gear.deviations.get(name))
            for name, member, angle in (("pinion", gear.pinion, angles[0]), ("wheel", gear.wheel, angles[1]))
        }  # fmt: skip
        return cls(contact, axes, flanks)

    def feet(self, centres: Floats) -> Floats:
        """Points (N, 3) of the plane, fixed frame, that are (N, 2) mm from the contact along its axes."""
        return self.contact.touch.point + centres @ self.axes[:2]

    def gaps(self, feet: Floats) -> tuple[Floats, Bools]:
        """Gap (N,) in mm of the flanks along the normals through points (N, 3), and where both flanks are (N,)."""
        return self.gap(self.footprints(feet))

    def footprints(self, feet: Floats) -> dict[str, _Footprint]:
        """Both flanks as the normals through points (N, 3) meet them."""
        return {name: flank.under(feet) for name, flank in self.flanks.items()}

    def gap(self, of: dict[str, _Footprint]) -> tuple[Floats, Bools]:
        """As :meth:`gaps`, of footprints."""
        pinion, wheel = of["pinion"], of["wheel"]
        gap = (wheel.points - pinion.points) @ self.axes[2] + wheel.excess - pinion.excess
        return gap, pinion.inside & wheel.inside


def cell_centres(reach: Floats, cells: int, centre: Floats) -> Floats:
    """Middles (cells^2, 2) of the equal cells of a rectangle of half sides ``reach`` (2,) about a centre (2,)."""
    ticks = (2.0 * np.arange(cells) + 1.0) / cells - 1.0
    along = (centre[k] + ticks * reach[k] for k in (0, 1))
    return np.stack([axis.ravel() for axis in np.meshgrid(*along, indexing="ij")], axis=1)


def contact_grid(plane: ContactPlane, reach: Floats, cells: int, centre: Floats | None = None) -> ContactGrid:
    """Grid of cells x cells around a contact point.

    reach: half lengths (2,) of the grid along the major and minor axis in mm; centre: of the grid (2,) along them, by
    default the contact point.
    """
    centres = cell_centres(reach, cells, np.zeros(2) if centre is None else centre)
    feet = plane.feet(centres)
    surfaces = plane.footprints(feet)
    gap, inside = plane.gap(surfaces)
    beyond = {f"{edge} of the {name}": cells for name, f in surfaces.items() for edge, cells in f.beyond.items()}
    place = {
        name: flank.place(surfaces[name], None if centre is None else feet.mean(axis=0))
        for name, flank in plane.flanks.items()
    }
    half = float(reach[0]) / cells, float(reach[1]) / cells
    return ContactGrid(centres, *half, gap, surfaces["pinion"].points, inside, beyond, place)


@dataclass(frozen=True)
class _Footprint:
    """Where the normals of the tangent plane through N feet pierce a flank: fixed frame.

    excess (N,): what a measured flank adds to its height along the normal, mm. fraction, section (N,): of the way from
    the first to the last profile parameter of its section, and the section itself; not a number where there is none.
    """

    points: Floats
    inside: Bools
    beyond: dict[str, Bools]
    excess: Floats
    fraction: Floats
    section: Floats


@dataclass(frozen=True)
class _Flank:
    """The flank of a member at ``pose`` (4, 4); ``axes`` (3, 3) of the tangent plane in the body frame; ``rail``: its
    section at the contact.
    """

    form: ToothForm
    surface: Smooth
    pose: Floats
    axes: Floats
    rail: Rail
    deviations: Callable[[Floats, Floats], tuple[Floats, Bools]] | None

    @classmethod
    def of(
        cls, member: Member, angle: float, point: Floats, axes: Floats,
        deviations: Callable[[Floats, Floats], tuple[Floats, Bools]] | None,
    ) -> _Flank:
        form, pose = member.tooth(angle), member.pose(angle)
        curves = form.side(member.working).flank
        if not isinstance(curves.surface, Smooth):
            raise TypeError("a flank that does not tell where lines meet it is met by no normals")
        rail = _rail_at(form, curves, _in_body(pose, point))
        return cls(form, curves.surface, pose, axes @ pose[:3, :3], rail, deviations)

    def under(self, feet: Floats) -> _Footprint:
        """Where normals through feet (N, 3) meet it."""
        curves, rotation, feet_body = self.rail.curves, self.pose[:3, :3], _in_body(self.pose, feet)
        profile, _, points = self.surface.pierced(feet_body, self.axes[:2], self._below(feet_body.mean(axis=0)))
        pierced = np.abs((points - feet_body) @ self.axes[:2].T).max(axis=1) < _PIERCED
        points = np.where(np.isfinite(points), points, feet_body)
        section = curves.section.at(points)
        low, high = self.form.faces
        held = np.clip(section, low, high)
        first, last = curves.first(held), curves.last(held)
        fraction, across = (profile - first) / (last - first), (section - low) / (high - low)
        beyond = {
            "fillet": pierced & (fraction < -_ON_EDGE),
            "tip": pierced & (fraction > 1.0 + _ON_EDGE),
            "end of the portion" if self.form.cut_ends else "face": pierced & (np.abs(across - 0.5) > 0.5 + _ON_EDGE),
        }
        excess = np.zeros(len(points))
        if self.deviations is not None:
            excess, measured = self.deviations(points, self.axes[2])
            beyond["measured grid"] = pierced & ~measured
        inside = pierced & ~np.any(list(beyond.values()), axis=0)
        return _Footprint(points @ rotation.T + self.pose[:3, 3], inside, beyond, excess, fraction, section)

    def _below(self, foot: Floats) -> tuple[float, float]:
        """Parameters where the normal through a foot (3,) meets it, or of a point of the section next to that."""
        near = _nearest(self.rail, foot)
        profile, face, _ = self.surface.pierced(foot[None], self.axes[:2], near)
        return (float(profile[0]), float(face[0])) if np.isfinite(profile[0]) else near

    def place(self, of: _Footprint, middle: Floats | None) -> Floats:
        """Fractions (N, 2) of flank arc length, in the section of the contact or at another ``middle`` (3,), fixed
        frame, and of face width.
        """
        rail = self.rail
        if middle is not None:
            rail = _rail_at(self.form, rail.curves, _in_body(self.pose, middle))
        low, high = self.form.faces
        # A cell off the flank has no pressure; its gap and its place only have to be finite.
        return np.stack([_arc_share(rail, np.nan_to_num(of.fraction)), (of.section - low) / (high - low)], axis=1)


def _in_body(pose: Floats, points: Floats) -> Floats:
    return (points - pose[:3, 3]) @ pose[:3, :3]


def _rail_at(form: ToothForm, curves: SectionCurves, point: Floats) -> Rail:
    """The section of a flank that is next to a point (3,), body frame."""
    return curves.rail(np.clip(np.atleast_1d(curves.section.at(point)), *form.faces))


def _nearest(rail: Rail, point: Floats) -> tuple[float, float]:
    """Parameters of the point of a single tabulated section next to ``point``, a start for Newton's method."""
    index = int(np.argmin(np.linalg.norm(rail.table[0] - point, axis=1)))
    profile = rail.profile[:, index : index + 1]
    return float(profile[0, 0]), float(rail.curves.solve(rail.values, profile)[0, 0])


def _arc_share(rail: Rail, fraction: Floats) -> Floats:
    """Fractions (N,) of the arc length at fractions (N,) of the profile parameter, in the section of the contact."""
    (profile,), (lengths,) = rail.profile, rail.lengths
    return np.interp(fraction, (profile - profile[0]) / (profile[-1] - profile[0]), lengths / lengths[-1])
