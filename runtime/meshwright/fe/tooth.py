"""One tooth with its part of the rim as four structured blocks of hexahedra.

Seen along a section, with the profile parameter running from the root land to the tip::

            tip
         +-------+
        /  tooth  \\
       /           \\            the tooth block ends in the middle of the fillets, where three
    --+-------------+--         blocks meet at about 60 degrees each
      | centre rim  |
    side rim      side rim
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from meshwright.fe.blocks import Block, FineZone, graded, graded_count, transfinite
from meshwright.fe.hexahedra import FaceSet, Floats, HexMesh, Ints, merge
from meshwright.fe.profile import Rail, SectionCurves

_MERGE_TOLERANCE = 1e-8


@dataclass(frozen=True)
class ToothSide:
    """Fillet (root land to junction) and flank (junction to tip) of one side, in the body frame."""

    fillet: SectionCurves
    flank: SectionCurves


@dataclass(frozen=True)
class ToothForm:
    """What a family says of its tooth.

    left and right are so named that (left to right, root to tip, growing section coordinate) is right-handed.
    faces: section coordinate of both end faces.  next_tooth: 4 x 4 motion of this tooth onto its right neighbour.
    bore: points (..., 3) of the root to the points (..., 3) of the bore below them; None: a flank without a solid.
    """

    left: ToothSide
    right: ToothSide
    faces: tuple[float, float]
    next_tooth: Floats
    bore: Callable[[Floats], Floats] | None

    def side(self, name: Literal["left", "right"]) -> ToothSide:
        """The named side."""
        return self.left if name == "left" else self.right


@dataclass(frozen=True)
class ContactZone:
    """Where a flank is loaded, body frame: centre, unit direction of the major axis, semi-axes in mm."""

    side: Literal["left", "right"]
    centre: Floats
    major_direction: Floats
    normal: Floats
    semi_major: float
    semi_minor: float


@dataclass(frozen=True)
class MeshDensity:
    """How finely a tooth is divided; sizes in the contact zone are fractions of the Hertz ellipse's semi-axes."""

    per_semi_minor: float = 3.5
    per_semi_major: float = 5.0
    first_layer: float = 0.33
    profile_reach: float = 1.2
    face_reach: float = 1.15
    depth_reach: float = 1.0
    growth: float = 2.2
    fillet_rows: int = 6
    land_rows: int = 1
    rim_rows: int = 4
    coarse_rows: tuple[int, int, int] = (2, 4, 6)
    coarse_fillet_rows: int = 4
    fillet_split: float = 0.5


@dataclass(frozen=True)
class ToothMesh:
    """The mesh of one tooth; face sets by name and the nodes on bore and cut sides."""

    mesh: HexMesh
    faces: dict[str, FaceSet]

    def nodes(self, name: str) -> Ints:
        """Distinct nodes of a face set."""
        return np.unique(self.mesh.face_nodes(self.faces[name]))


def face_rows(form: ToothForm, zone: ContactZone | None, density: MeshDensity) -> int:
    """Least number of elements over the face width that the zone needs."""
    if zone is None:
        return density.coarse_rows[2]
    return graded_count(form.faces[1] - form.faces[0], _face_zone(form, zone, density), density.growth)


def mesh_tooth(form: ToothForm, zone: ContactZone | None, density: MeshDensity, rows: int) -> ToothMesh:
    """Mesh a tooth with ``rows`` elements over the face width, graded to ``zone`` or coarse without one."""
    if zone is None:
        density = replace(density, fillet_rows=density.coarse_fillet_rows)
    low, high = form.faces
    even = np.linspace(low, high, rows + 1)
    values = even if zone is None else low + graded(high - low, _face_zone(form, zone, density), density.growth, rows)
    rails = {name: _SideRails(form.side(name), values) for name in ("left", "right")}
    flank = {name: _even_rows(zone, form, rails, density) for name in ("left", "right")}
    if zone is not None:
        flank[zone.side] = _zone_rows(zone, rails[zone.side].flank, density)
    upper = np.linspace(density.fillet_split, 1.0, density.fillet_rows // 2 + 1)
    profile = {name: rails[name].upper(upper, flank[name]) for name in rails}
    across = _across(zone, profile, density)
    sections = _Sections(form, rails, profile, across, even, density)
    return _assemble(sections, density)


class _SideRails:
    """Rails of one side at given section values."""

    def __init__(self, side: ToothSide, values: Floats) -> None:
        self.fillet: Rail = side.fillet.rail(values)
        self.flank: Rail = side.flank.rail(values)

    def upper(self, fillet: Floats, flank: Floats) -> Floats:
        """Points (K, J, 3) from the middle of the fillet to the tip; flank (K, J2) starts at the junction."""
        below = self.fillet.at(np.broadcast_to(fillet, (len(flank), len(fillet))))
        return np.concatenate([below, self.flank.at(flank)[:, 1:]], axis=1)

    def lower(self, fillet: Floats) -> Floats:
        """Points (K, J, 3) from the root land up to the middle of the fillet."""
        return self.fillet.at(np.broadcast_to(fillet, (len(self.fillet.values), len(fillet))))


def _face_zone(form: ToothForm, zone: ContactZone, density: MeshDensity) -> FineZone:
    section = form.side(zone.side).flank.section
    ends = [section(zone.centre + sign * zone.semi_major * zone.major_direction) for sign in (-1.0, 1.0)]
    reach = max(0.5 * abs(float(ends[1] - ends[0])), zone.semi_minor)
    centre = float(section(zone.centre)) - form.faces[0]
    return FineZone(centre, density.face_reach * reach, reach / density.per_semi_major)


def _zone_rows(zone: ContactZone, rail: Rail, density: MeshDensity) -> Floats:
    """Fractions (K, J) of the flank's arc length that follow the major axis of the contact ellipse."""
    centres = _zone_centres(zone, rail)
    middle = int(np.argmin(np.abs(rail.values - float(rail.curves.section(zone.centre)))))
    length, centre = float(rail.total[middle]), float(centres[middle])
    size = zone.semi_minor / density.per_semi_minor
    fine = FineZone(centre * length, density.profile_reach * zone.semi_minor, size)
    base = graded(length, fine, density.growth) / length
    shift = np.where(base < centre, base / centre, (1.0 - base) / (1.0 - centre))
    return base + (centres[:, None] - centre) * shift


def _zone_centres(zone: ContactZone, rail: Rail) -> Floats:
    """Fraction (K,) of the arc length at which each section meets the major axis, held beyond its ends."""
    minor = np.cross(zone.normal, zone.major_direction)
    offset = (rail.table - zone.centre) @ minor
    along = (rail.table - zone.centre) @ zone.major_direction
    rows = np.arange(len(offset))
    nearest = np.argmin(np.abs(offset), axis=1)
    other = np.clip(nearest + np.where(offset[rows, nearest] * (offset[:, 0] - offset[:, -1]) > 0, 1, -1), 0, 128)
    d0, d1 = offset[rows, nearest], offset[rows, other]
    weight = np.where(d0 == d1, 0.0, np.clip(d0 / np.where(d0 == d1, 1.0, d0 - d1), 0.0, 1.0))
    lengths = (1 - weight) * rail.lengths[rows, nearest] + weight * rail.lengths[rows, other]
    fraction = lengths / rail.total
    inside = np.flatnonzero(np.abs(along[rows, nearest]) <= 1.5 * zone.semi_major)
    held = np.clip(rows, inside.min(), inside.max())
    return fraction[held]


def _even_rows(zone: ContactZone | None, form: ToothForm, rails: dict[str, _SideRails], density: MeshDensity) -> Floats:
    """Fractions (K, J) of even rows, as many as the loaded side has."""
    count = density.coarse_rows[1] if zone is None else _zone_rows(zone, rails[zone.side].flank, density).shape[1] - 1
    sections = len(rails["left"].flank.values)
    return np.broadcast_to(np.linspace(0.0, 1.0, count + 1), (sections, count + 1))


def _across(zone: ContactZone | None, profile: dict[str, Floats], density: MeshDensity) -> Floats:
    """Fractions from the left to the right side of the tooth."""
    if zone is None:
        return np.linspace(0.0, 1.0, density.coarse_rows[0] + 1)
    gap = np.linalg.norm(profile["right"] - profile["left"], axis=-1)
    thickness = float(np.median(gap))
    reach = density.depth_reach * zone.semi_minor
    fine = FineZone(0.0, reach, density.first_layer * zone.semi_minor)
    inward = graded(thickness, fine, density.growth) / thickness
    return inward if zone.side == "left" else 1.0 - inward[::-1]


class _Sections:
    """All edge curves (K, …, 3) of the four blocks."""

    def __init__(
        self,
        form: ToothForm,
        rails: dict[str, _SideRails],
        profile: dict[str, Floats],
        across: Floats,
        even: Floats,
        density: MeshDensity,
    ) -> None:
        left, right = profile["left"], profile["right"]
        self.left, self.right = left, right
        self.tip = _around(left[:, -1], right[:, -1], across)
        self.bottom = _straight(left[:, 0], right[:, 0], across)
        depth = graded(1.0, FineZone(1.0, 0.0, 0.5 / density.rim_rows), 2.0, density.rim_rows)
        self.left_line = _straight(form.bore(left[:, 0]), left[:, 0], depth)
        self.right_line = _straight(form.bore(right[:, 0]), right[:, 0], depth)
        self.bore = _around(self.left_line[:, 0], self.right_line[:, 0], across)
        lower = np.linspace(0.0, density.fillet_split, density.fillet_rows - density.fillet_rows // 2 + 1)
        right_cut = _cut(form, even)
        left_cut = _moved(np.linalg.inv(form.next_tooth), right_cut)
        land = np.linspace(0.0, 1.0, density.land_rows + 1)
        left_fillet, right_fillet = rails["left"].lower(lower), rails["right"].lower(lower)
        self.left_top = np.concatenate([_around(left_cut, left_fillet[:, 0], land)[:, :-1], left_fillet], axis=1)
        back = right_fillet[:, ::-1]
        self.right_top = np.concatenate([back, _around(back[:, -1], right_cut, land)[:, 1:]], axis=1)
        self.left_cut = _straight(form.bore(left_cut), left_cut, depth)
        self.right_cut = _straight(form.bore(right_cut), right_cut, depth)
        share = np.linspace(0.0, 1.0, self.left_top.shape[1])
        self.left_bore = _around(self.left_cut[:, 0], self.left_line[:, 0], share)
        self.right_bore = _around(self.right_line[:, 0], self.right_cut[:, 0], share)


def _cut(form: ToothForm, values: Floats) -> Floats:
    """Middle (K, 3) of the root land beyond the right side, where the rim is cut between two teeth."""
    right = form.right.fillet.points(values, form.right.fillet.first(values)[:, None])[:, 0]
    left = form.left.fillet.points(values, form.left.fillet.first(values)[:, None])[:, 0]
    return _around(right, _moved(form.next_tooth, left), np.array([0.5]))[:, 0]


def _assemble(s: _Sections, density: MeshDensity) -> ToothMesh:
    edges = {
        "tooth": (s.left, s.right, s.bottom, s.tip),
        "centre": (s.left_line, s.right_line, s.bore, s.bottom),
        "left_rim": (s.left_cut, s.left_line, s.left_bore, s.left_top),
        "right_rim": (s.right_line, s.right_cut, s.right_bore, s.right_top),
    }
    blocks = {name: Block(np.moveaxis(transfinite(*curves), 0, 2)) for name, curves in edges.items()}
    offsets = dict(zip(blocks, np.cumsum([0] + [int(np.prod(b.shape)) for b in blocks.values()]), strict=False))
    mesh, _ = merge([block.mesh() for block in blocks.values()], _MERGE_TOLERANCE)

    def side(block: str, name: str) -> FaceSet:
        faces = blocks[block].side(name)
        return FaceSet(faces.elements + offsets[block], faces.faces)

    rows = density.fillet_rows // 2
    land = density.land_rows
    faces = {
        "flank_left": _rows(side("tooth", "i0"), blocks["tooth"], rows, None),
        "flank_right": _rows(side("tooth", "i1"), blocks["tooth"], rows, None),
        "fillet_left": _joined(
            _rows(side("tooth", "i0"), blocks["tooth"], 0, rows),
            _rows(side("left_rim", "j1"), blocks["left_rim"], land, None),
        ),
        "fillet_right": _joined(
            _rows(side("tooth", "i1"), blocks["tooth"], 0, rows),
            _rows(side("right_rim", "j1"), blocks["right_rim"], 0, -land),
        ),
        "bore": _joined(side("centre", "j0"), side("left_rim", "j0"), side("right_rim", "j0")),
        "left_cut": side("left_rim", "i0"),
        "right_cut": side("right_rim", "i1"),
    }
    return ToothMesh(mesh, faces)


def _rows(faces: FaceSet, block: Block, start: int, stop: int | None) -> FaceSet:
    """The part of a block side (profile rows, sections) between two profile rows."""
    keep = np.arange(len(faces.elements)).reshape(-1, block.shape[2])[start:stop].ravel()
    return FaceSet(faces.elements[keep], faces.faces[keep])


def _joined(*sets: FaceSet) -> FaceSet:
    return FaceSet(np.concatenate([s.elements for s in sets]), np.concatenate([s.faces for s in sets]))


def _straight(start: Floats, end: Floats, fractions: Floats) -> Floats:
    return start[:, None] + (end - start)[:, None] * fractions[:, None]


def _around(start: Floats, end: Floats, fractions: Floats) -> Floats:
    """Points (K, F, 3) between two points (K, 3), evenly in radius, angle and height about the body's axis."""
    turn = np.arctan2(
        start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0], start[:, 0] * end[:, 0] + start[:, 1] * end[:, 1]
    )
    angle = np.arctan2(start[:, 1], start[:, 0])[:, None] + turn[:, None] * fractions
    radii = [np.hypot(point[:, 0], point[:, 1])[:, None] for point in (start, end)]
    radius = radii[0] * (1.0 - fractions) + radii[1] * fractions
    height = start[:, 2:] * (1.0 - fractions) + end[:, 2:] * fractions
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=-1)
    points[:, fractions == 0.0] = start[:, None]
    points[:, fractions == 1.0] = end[:, None]
    return points


def _moved(motion: Floats, points: Floats) -> Floats:
    return points @ motion[:3, :3].T + motion[:3, 3]
