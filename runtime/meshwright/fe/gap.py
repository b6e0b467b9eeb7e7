"""The gap between two flanks, measured along the contact normal on a grid in the tangent plane."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from meshwright.fe.hexahedra import Floats, Ints
from meshwright.fe.pair import GearPair, Member, PairTouch
from meshwright.fe.profile import Rail, SectionCurves, Smooth
from meshwright.fe.tooth import ToothForm

Bools = NDArray[np.bool_]

# A flank with an edge near the grid may leave some of the normals unmet.
_PIERCED = 1e-9
# So far beyond an edge, in parts of the flank, a place lies on it: what a corner of a mesh there is off by rounding.
_ON_EDGE = 1e-9
# Places along either side of a flank that tell how far it extends.
_OUTLINE = 9
# Beyond their outlines there may be more of the flanks between those places, in parts of their extent.
_BEYOND = 0.05
# Differences of the gap about an edge are taken over this part of the extent of the flanks.
_DIFFERENCE = 0.01
# Places along either side of a square about it that tell how the gap bends.
_ABOUT = 7


@dataclass(frozen=True)
class ContactGrid:
    """Pressure cells of one pair, N = ``rows`` x ``columns`` of them that lie on both flanks, row by row.

    centres (N, 2) in mm along the axes of the contact plane from the contact point. half (N, 2): half lengths of a
    cell straight across its row and along that. Where edges are oblique to rows cells are sheared: rectangle (N, 2)
    has the half sides of those of the same area and second moments, ways (N, 2, 2) their directions in the contact
    plane, frame (N, 3, 3) those on the pinion's flank, and its normal out of the pinion; points (N, 3): on the
    pinion's flank, fixed frame. gap (N,) in mm along the normal, positive apart. row_gap (rows,): the smallest in
    each row; offset (N,): mm across from the place of that. free (2, N): cells at a border of the grid, along and
    across, where the flanks go on. beyond (4, N): by the name of an edge, such as "tip of the wheel", the cells
    that have it on their side at the begin or the end along, or on either side across; sharp (4, N): 1 for those of
    them where the mate goes on, 0 where it does not, between where it ends soon. place: for each member the
    fractions (N, 2) of flank arc length and face width; free_edges: where it has free edges, 0 and 1 for arc length
    and width, and the fraction there.
    """

    rows: int
    columns: int
    centres: Floats
    half: Floats
    rectangle: Floats
    ways: Floats
    frame: Floats
    points: Floats
    gap: Floats
    row_gap: Floats
    offset: Floats
    free: Bools
    beyond: dict[str, Bools]
    sharp: Floats
    place: dict[str, Floats]
    free_edges: dict[str, tuple[tuple[int, float], ...]]

    @property
    def area(self) -> Floats:
        """Areas (N,) of the cells in mm^2."""
        return 4.0 * self.half.prod(axis=1)


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
        """angles: pinion and wheel angle in rad of the whole bodies.

        The major axis is the direction of the contact: that in which the gap bends least.
        """
        touch = contact.touch
        if np.isfinite(touch.major_direction).all():
            return cls._along(gear, contact, angles, touch.major_direction)
        some = np.linalg.svd(touch.normal[None])[2][1]
        plane = cls._along(gear, contact, angles, some)
        return cls._along(gear, contact, angles, plane._least_bent())

    @classmethod
    def _along(
        cls, gear: GearPair, contact: PairTouch, angles: tuple[float, float], major: Floats
    ) -> ContactPlane:
        touch = contact.touch
        axes = np.stack([major, np.cross(touch.normal, major), touch.normal])
        flanks = {
            name: _Flank.of(member, angle - contact.pairs_later * member.pitch, touch.point, axes,
                            gear.deviations.get(name))
            for name, member, angle in (("pinion", gear.pinion, angles[0]), ("wheel", gear.wheel, angles[1]))
        }  # fmt: skip
        return cls(contact, axes, flanks)

    def _least_bent(self) -> Floats:
        """Unit direction (3,) in the plane in which the gap of the flanks bends least at the contact, by the places
        about it that are on both: beside an undercut normals meet another sheet of the surface.
        """
        step = _DIFFERENCE * float(np.min(np.diff(self.extents(), axis=0)))
        x, y = (at.ravel() for at in np.meshgrid(*(np.linspace(-1.0, 1.0, _ABOUT),) * 2, indexing="ij"))
        gap, inside = self.gaps(self.feet(step * np.stack([x, y], axis=-1)))
        terms = np.stack([0.5 * x * x, x * y, 0.5 * y * y, x, y, np.ones_like(x)], axis=1)
        first, both, second, *_ = np.linalg.lstsq(terms[inside], gap[inside], rcond=None)[0]
        bent = np.array([[first, both], [both, second]])
        _, axes = np.linalg.eigh(bent)
        return axes[:, 0] @ self.axes[:2]

    def feet(self, centres: Floats) -> Floats:
        """Points (N, 3) of the plane, fixed frame, that are (N, 2) mm from the contact along its axes."""
        return self.contact.touch.point + centres @ self.axes[:2]

    def gaps(self, feet: Floats) -> tuple[Floats, Bools]:
        """Gap (N,) in mm of the flanks along the normals through points (N, 3), and where both flanks are (N,)."""
        return self.gap(self.footprints(feet))

    def footprints(self, feet: Floats) -> dict[str, Footprint]:
        """Both flanks as the normals through points (N, 3) meet them."""
        return {name: flank.under(feet) for name, flank in self.flanks.items()}

    def gap(self, of: dict[str, Footprint]) -> tuple[Floats, Bools]:
        """As :meth:`gaps`, of footprints."""
        pinion, wheel = of["pinion"], of["wheel"]
        gap = (wheel.points - pinion.points) @ self.axes[2] + wheel.excess - pinion.excess
        return gap, pinion.inside & wheel.inside

    def extents(self) -> Floats:
        """Coordinates (2, 2) in mm along both axes between which both flanks are, somewhat beyond their edges."""
        each = np.array([flank.extents(self.contact.touch.point, self.axes[:2]) for flank in self.flanks.values()])
        low, high = each[:, 0].max(axis=0), each[:, 1].min(axis=0)
        return np.stack([low - _BEYOND * (high - low), high + _BEYOND * (high - low)])

    @property
    def shared(self) -> bool:
        """Whether any part of the plane has both flanks over it: at a fillet one of them has ended."""
        low, high = self.extents()
        return bool(np.all(low < high))


@dataclass(frozen=True)
class Footprint:
    """Where the normals of the tangent plane through N feet pierce a flank: fixed frame.

    normals (N, 3): out of the material. margins: by the name of an edge, how far (N,) within it, in parts of the flank,
    negative beyond. excess (N,): what a measured flank adds to its height along the normal, mm. fraction, section (N,):
    of the way from the first to the last profile parameter of its section, and the section itself; not a number where
    there is none.
    """

    points: Floats
    normals: Floats
    pierced: Bools
    margins: dict[str, Floats]
    excess: Floats
    fraction: Floats
    section: Floats

    @property
    def margin(self) -> Floats:
        """The least of the margins (N,), minus infinity where the normal meets no surface."""
        return np.where(self.pierced, np.min(list(self.margins.values()), axis=0), -np.inf)

    def at(self, rows: Ints) -> Footprint:
        """Those of some of the feet (M,)."""
        margins = {name: margin[rows] for name, margin in self.margins.items()}
        return Footprint(
            self.points[rows], self.normals[rows], self.pierced[rows], margins, self.excess[rows],
            self.fraction[rows], self.section[rows],
        )  # fmt: skip

    @property
    def inside(self) -> Bools:
        """Where the flank is (N,)."""
        return self.margin >= -_ON_EDGE


@dataclass(frozen=True)
class _Flank:
    """The flank of a member at ``pose`` (4, 4); ``axes`` (3, 3) of the tangent plane in the body frame; ``rail``: its
    section at the contact; ``start``: parameters near which the plane's normals meet it.
    """

    form: ToothForm
    surface: Smooth
    pose: Floats
    axes: Floats
    rail: Rail
    start: tuple[float, float]
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
        foot, turned = _in_body(pose, point), axes @ pose[:3, :3]
        rail = _rail_at(form, curves, foot)
        start = _below(curves.surface, rail, foot, turned[:2])
        return cls(form, curves.surface, pose, turned, rail, start, deviations)

    def under(self, feet: Floats) -> Footprint:
        """Where normals through feet (N, 3) meet it."""
        curves, rotation, feet_body = self.rail.curves, self.pose[:3, :3], _in_body(self.pose, feet)
        profile, _, points, normals = self.surface.pierced(feet_body, self.axes[:2], self.start)
        pierced = np.abs((points - feet_body) @ self.axes[:2].T).max(axis=1) < _PIERCED
        points = np.where(np.isfinite(points), points, feet_body)
        section = curves.section.at(points)
        low, high = self.form.faces
        pierced &= np.isfinite(section)
        held = np.clip(np.where(pierced, section, low), low, high)
        first, last = curves.first(held), curves.last(held)
        fraction, across = (profile - first) / (last - first), (section - low) / (high - low)
        within = np.minimum(across, 1.0 - across)
        face = "end of the portion" if self.form.cut_ends else "face"
        margins = {"fillet": fraction, "tip": 1.0 - fraction, face: within}
        excess = np.zeros(len(points))
        if self.deviations is not None:
            excess, measured = self.deviations(points, self.axes[2])
            margins["measured grid"] = np.where(measured, 1.0, -1.0)
        placed = points @ rotation.T + self.pose[:3, 3]
        return Footprint(placed, normals @ rotation.T, pierced, margins, excess, fraction, section)

    def extents(self, point: Floats, axes: Floats) -> Floats:
        """Smallest and largest coordinates (2, 2) of the flank along directions (2, 3) from a point (3,), mm."""
        share, curves = np.linspace(0.0, 1.0, _OUTLINE), self.rail.curves
        sections = self.form.faces[0] + share * (self.form.faces[1] - self.form.faces[0])
        first, last = curves.first(sections)[:, None], curves.last(sections)[:, None]
        points = curves.points(sections, first + share * (last - first)).reshape(-1, 3)
        at = (points @ self.pose[:3, :3].T + self.pose[:3, 3] - point) @ axes.T
        return np.stack([at.min(axis=0), at.max(axis=0)])

    @property
    def free_edges(self) -> tuple[tuple[int, float], ...]:
        """The edges beyond which there is no material: axis of the place, 0 or 1, and the fraction at the edge."""
        return ((0, 1.0),) if self.form.cut_ends else ((0, 1.0), (1, 0.0), (1, 1.0))

    def place(self, of: Footprint, middle: Floats) -> Floats:
        """Fractions (N, 2) of flank arc length, in the section next to a ``middle`` (3,), fixed frame, and of face
        width.
        """
        rail = _rail_at(self.form, self.rail.curves, _in_body(self.pose, middle))
        low, high = self.form.faces
        return np.stack([_arc_share(rail, of.fraction), (of.section - low) / (high - low)], axis=1)


def _in_body(pose: Floats, points: Floats) -> Floats:
    return (points - pose[:3, 3]) @ pose[:3, :3]


def _rail_at(form: ToothForm, curves: SectionCurves, point: Floats) -> Rail:
    """The section of a flank that is next to a point (3,), body frame."""
    return curves.rail(np.clip(np.atleast_1d(curves.section.at(point)), *form.faces))


def _below(surface: Smooth, rail: Rail, foot: Floats, plane: Floats) -> tuple[float, float]:
    """Parameters where the normal of a plane (2, 3) through a foot (3,) meets a surface, or of a point of the section
    next to that.
    """
    near = _nearest(rail, foot)
    profile, face, *_ = surface.pierced(foot[None], plane, near)
    return (float(profile[0]), float(face[0])) if np.isfinite(profile[0]) else near


def _nearest(rail: Rail, point: Floats) -> tuple[float, float]:
    """Parameters of the point of a single tabulated section next to ``point``, a start for Newton's method."""
    index = int(np.argmin(np.linalg.norm(rail.table[0] - point, axis=1)))
    profile = rail.profile[:, index : index + 1]
    return float(profile[0, 0]), float(rail.curves.solve(rail.values, profile)[0, 0])


def _arc_share(rail: Rail, fraction: Floats) -> Floats:
    """Fractions (N,) of the arc length at fractions (N,) of the profile parameter, in the section of the contact."""
    (profile,), (lengths,) = rail.profile, rail.lengths
    return np.interp(fraction, (profile - profile[0]) / (profile[-1] - profile[0]), lengths / lengths[-1])
