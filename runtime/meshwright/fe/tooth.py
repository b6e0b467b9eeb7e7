r"""One tooth with its part of the rim as four structured blocks of hexahedra.

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

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

import numpy as np

from meshwright.fe.blocks import Block, geometric, transfinite
from meshwright.fe.grading import ContactZone, MeshDensity, across_divisions, face_divisions, least_rows, profile_rows
from meshwright.fe.hexahedra import FaceSet, Floats, HexMesh, Ints, merge
from meshwright.fe.profile import Rail, SectionCurves

_MERGE_TOLERANCE = 1e-8


SideName = Literal["left", "right"]


@dataclass(frozen=True)
class ToothSide:
    """Fillet (root land to junction) and flank (junction to tip) of one side, in the body frame."""

    fillet: SectionCurves
    flank: SectionCurves

    def root_end(self, values: Floats) -> Floats:
        """Points (K, 3) at section values (K,) where the fillet meets the root land."""
        return self.fillet.points(values, self.fillet.first(values)[:, None])[:, 0]


Cut = Callable[[Floats], Floats]
"""Section values (K,) to the points (K, 3), body frame, where the rim is cut from the neighbouring tooth."""


@dataclass(frozen=True)
class ToothForm:
    """What a drive says of its tooth, or of the portion of a thread that meets one tooth.

    side: the left or the right one, so named that (left to right, root to tip, growing section coordinate) is
    right-handed.
    faces: section coordinate of both end faces.  left_cut, right_cut: where the rim ends and the neighbour's begins.
    bore: points (..., 3) of the root to the points (..., 3) of the bore below them.  cut_ends: the end faces are cuts
    through a body that goes on, as a shaft does, and are held like its bore.
    """

    side: Callable[[SideName], ToothSide]
    faces: tuple[float, float]
    left_cut: Cut
    right_cut: Cut
    bore: Callable[[Floats], Floats]
    cut_ends: bool = False

    @classmethod
    def repeated(
        cls,
        left: ToothSide,
        right: ToothSide,
        faces: tuple[float, float],
        next_tooth: Floats,
        bore: Callable[[Floats], Floats],
    ) -> ToothForm:
        """A tooth whose right neighbour is the same one moved by the 4 x 4 motion ``next_tooth``."""

        def right_cut(values: Floats) -> Floats:
            return middle_of_land(right.root_end(values), moved(next_tooth, left.root_end(values)))

        def left_cut(values: Floats) -> Floats:
            return moved(np.linalg.inv(next_tooth), right_cut(values))

        sides: dict[SideName, ToothSide] = {"left": left, "right": right}
        return cls(sides.__getitem__, faces, left_cut, right_cut, bore)

    @property
    def left(self) -> ToothSide:
        """The left side."""
        return self.side("left")

    @property
    def right(self) -> ToothSide:
        """The right side."""
        return self.side("right")


@dataclass(frozen=True)
class Teeth:
    """The teeth of a member: the form at a member angle in rad of its own pair, and the side in contact."""

    at: Callable[[float], ToothForm]
    working: SideName


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
    return least_rows(form.side(zone.side).flank, form.faces, zone, density)


def section_values(form: ToothForm, zone: ContactZone | None, density: MeshDensity, rows: int) -> Floats:
    """Section coordinates (rows + 1,) from face to face, graded to the zone or coarse without one."""
    if zone is None and len(density.coarse_sections) == rows + 1:
        return form.faces[0] + (form.faces[1] - form.faces[0]) * np.array(density.coarse_sections)
    if zone is None:
        return np.linspace(*form.faces, rows + 1)
    return face_divisions(form.side(zone.side).flank, form.faces, zone, density, rows)


@dataclass(frozen=True)
class Stations:
    """Section coordinates (K,) of a tooth and of the cuts on either side, between which the rim leads over."""

    own: Floats
    left_cut: Floats
    right_cut: Floats

    def __iter__(self) -> Iterator[Floats]:
        return iter((self.own, self.left_cut, self.right_cut))

    @classmethod
    def between(cls, teeth: list[Floats]) -> list[Stations]:
        """Those of neighbours from left to right: a cut takes the mean of both, the outer ones their tooth's own."""
        cuts = [teeth[0], *(0.5 * (a + b) for a, b in pairwise(teeth)), teeth[-1]]
        return [cls(own, left, right) for own, left, right in zip(teeth, cuts[:-1], cuts[1:], strict=True)]


def mesh_tooth(form: ToothForm, zone: ContactZone | None, density: MeshDensity, stations: Stations) -> ToothMesh:
    """Mesh a tooth at given sections, its rows graded to ``zone`` or coarse without one."""
    if zone is None:
        density = replace(density, fillet_rows=density.coarse_fillet_rows)
    rails = {name: _SideRails(form.side(name), stations.own) for name in ("left", "right")}
    flank = _flank_rows(zone, rails, density)
    upper = np.linspace(density.fillet_split, 1.0, density.fillet_rows // 2 + 1)
    profile = {name: rails[name].upper(upper, flank[name]) for name in rails}
    across = across_divisions(zone, profile, density)
    sections = _Sections(form, profile, across, stations, density)
    return _assemble(sections, density)


def _flank_rows(zone: ContactZone | None, rails: dict[str, _SideRails], density: MeshDensity) -> dict[str, Floats]:
    """Fractions (K, J) of each flank's arc length: graded on the loaded side, as many even ones on the other."""
    sections = len(rails["left"].flank.values)
    if zone is None:
        count, graded_rows = density.coarse_rows[1], {}
    else:
        graded_rows = {zone.side: profile_rows(rails[zone.side].flank, zone, density)}
        count = graded_rows[zone.side].shape[1] - 1
    even = np.broadcast_to(np.linspace(0.0, 1.0, count + 1), (sections, count + 1))
    return {name: graded_rows.get(name, even) for name in rails}


class _SideRails:
    """Rails of one side at given section values."""

    def __init__(self, side: ToothSide, values: Floats) -> None:
        self.fillet: Rail = side.fillet.rail(values)
        self.flank: Rail = side.flank.rail(values)

    def upper(self, fillet: Floats, flank: Floats) -> Floats:
        """Points (K, J, 3) from the middle of the fillet to the tip; flank (K, J2) starts at the junction."""
        below = self.fillet.at(np.broadcast_to(fillet, (len(flank), len(fillet))))
        return np.concatenate([below, self.flank.at(flank)[:, 1:]], axis=1)


def _root_edge(side: ToothSide, cut: Floats, cut_values: Floats, own: Floats, density: MeshDensity) -> Floats:
    """Points (K, J, 3) from a cut over the land and up to the middle of the fillet.

    The sections of the cut pass evenly into those of the tooth.
    """
    fillet = np.linspace(0.0, density.fillet_split, density.fillet_rows - density.fillet_rows // 2 + 1)
    land = density.land_rows
    shares = np.arange(land, land + len(fillet)) / (land + len(fillet) - 1.0)
    columns = [
        side.fillet.rail(cut_values + share * (own - cut_values)).at(np.full((len(own), 1), fraction))
        for share, fraction in zip(shares, fillet, strict=True)
    ]
    on_fillet = np.concatenate(columns, axis=1)
    on_land = _around(cut, on_fillet[:, 0], np.linspace(0.0, 1.0, land + 1))
    return np.concatenate([on_land[:, :-1], on_fillet], axis=1)


class _Sections:
    """All edge curves (K, …, 3) of the four blocks."""

    def __init__(
        self,
        form: ToothForm,
        profile: dict[str, Floats],
        across: Floats,
        stations: Stations,
        density: MeshDensity,
    ) -> None:
        left, right = profile["left"], profile["right"]
        self.left, self.right = left, right
        self.tip = _around(left[:, -1], right[:, -1], across)
        self.bottom = _straight(left[:, 0], right[:, 0], across)
        depth = geometric(density.rim_growth, density.rim_rows)
        self.left_line = _straight(form.bore(left[:, 0]), left[:, 0], depth)
        self.right_line = _straight(form.bore(right[:, 0]), right[:, 0], depth)
        self.bore = _around(self.left_line[:, 0], self.right_line[:, 0], across)
        left_cut, right_cut = form.left_cut(stations.left_cut), form.right_cut(stations.right_cut)
        self.left_top = _root_edge(form.left, left_cut, stations.left_cut, stations.own, density)
        self.right_top = _root_edge(form.right, right_cut, stations.right_cut, stations.own, density)[:, ::-1]
        self.left_cut = _straight(form.bore(left_cut), left_cut, depth)
        self.right_cut = _straight(form.bore(right_cut), right_cut, depth)
        share = np.linspace(0.0, 1.0, self.left_top.shape[1])
        self.left_bore = _around(self.left_cut[:, 0], self.left_line[:, 0], share)
        self.right_bore = _around(self.right_line[:, 0], self.right_cut[:, 0], share)


def middle_of_land(right: Floats, left: Floats) -> Floats:
    """Middle (K, 3) of the root land between a tooth's right side and its right neighbour's left one."""
    return _around(right, left, np.array([0.5]))[:, 0]


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
        "ends": _joined(*(side(rim, end) for rim in ("centre", "left_rim", "right_rim") for end in ("k0", "k1"))),
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


def moved(motion: Floats, points: Floats) -> Floats:
    """Points (..., 3) under a 4 x 4 motion."""
    return points @ motion[:3, :3].T + motion[:3, 3]
