"""How the loaded flank of a tooth is divided: finely within its contact ellipse, coarsely far from it.

Sections of the tooth are lines of the mesh. An ellipse oblique to them is met by rows that follow the diameter
conjugate to the sections: it halves every chord that a section cuts from the ellipse, so that rows and sections
divide the ellipse as they would divide one whose axes they are.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from meshwright.fe.blocks import FineZone, graded, graded_count
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import Rail, SectionCurves

# Rows follow the ellipse so many semi-axes beyond its end, and keep their place further out.
_FOLLOWED = 1.5
# The ellipse's diameter is held so far, in parts of the arc length, from either end of the flank.
_END_MARGIN = 0.02
_BISECTIONS = 60


@dataclass(frozen=True)
class ContactZone:
    """Where a flank is loaded, body frame: centre, unit direction of the major axis, semi-axes in mm."""

    side: Literal["left", "right"]
    centre: Floats
    major_direction: Floats
    normal: Floats
    semi_major: float
    semi_minor: float

    @property
    def minor_direction(self) -> Floats:
        """Unit direction (3,) of the minor axis."""
        return np.cross(self.normal, self.major_direction)


@dataclass(frozen=True)
class MeshDensity:
    """How finely a tooth is divided; sizes in the contact zone are fractions of the Hertz ellipse's semi-axes.

    depth_reach: depth to which the layers below the contact are as thin as the first, in semi-minor axes; growth,
    depth_growth: factor between neighbouring elements beyond the zone, on the flank and below it.  largest_section:
    longest element along the face, in parts of the face width; largest_layer: thickest one below the contact, in parts
    of the tooth's thickness.  rim_growth: factor from a row of the rim to the one below it.  Without a zone a tooth has
    coarse_rows across, up its flank and along its face, the last between sections at coarse_sections, shares of the
    face width, if there are any, else evenly; coarse_crowding: by what part rows across are thinner at the flanks than
    on average.

    Too few rows in the rim and too fast a growth below the contact are what makes a tooth too stiff; the rows of the
    fillets and the upper ones of the rim make its root stress.
    """

    per_semi_minor: float = 3.5
    per_semi_major: float = 4.0
    first_layer: float = 0.33
    profile_reach: float = 1.2
    face_reach: float = 1.15
    depth_reach: float = 0.5
    growth: float = 3.0
    depth_growth: float = 2.0
    largest_section: float = 1.0 / 6.0
    largest_layer: float = 0.3
    fillet_rows: int = 8
    land_rows: int = 1
    rim_rows: int = 4
    rim_growth: float = 2.0
    coarse_rows: tuple[int, int, int] = (1, 4, 6)
    coarse_fillet_rows: int = 4
    coarse_sections: tuple[float, ...] = ()
    coarse_crowding: float = 0.0
    fillet_split: float = 0.5

    def refined(self, factor: float) -> MeshDensity:
        """The same with elements in the contact zone, along both semi-axes and in depth, so many times smaller."""
        return replace(
            self,
            per_semi_minor=self.per_semi_minor * factor,
            per_semi_major=self.per_semi_major * factor,
            first_layer=self.first_layer / factor,
        )


def least_rows(flank: SectionCurves, faces: tuple[float, float], zone: ContactZone, density: MeshDensity) -> int:
    """Least number of elements over the face width that the zone needs."""
    return graded_count(faces[1] - faces[0], _face_zone(flank, faces, zone, density), density.growth)


def face_divisions(
    flank: SectionCurves, faces: tuple[float, float], zone: ContactZone, density: MeshDensity, rows: int
) -> Floats:
    """Section values (rows + 1,) from face to face."""
    fine = _face_zone(flank, faces, zone, density)
    return faces[0] + graded(faces[1] - faces[0], fine, density.growth, rows)


def _face_zone(flank: SectionCurves, faces: tuple[float, float], zone: ContactZone, density: MeshDensity) -> FineZone:
    """Extent of the ellipse across the sections: that of its two semi-axes together."""
    semi_axes = [zone.semi_major * zone.major_direction, zone.semi_minor * zone.minor_direction]
    halves = [0.5 * float(flank.section.at(zone.centre + d) - flank.section.at(zone.centre - d)) for d in semi_axes]
    reach = float(np.hypot(halves[0], halves[1]))
    centre = float(flank.section.at(zone.centre)) - faces[0]
    largest = density.largest_section * (faces[1] - faces[0])
    return FineZone(centre, density.face_reach * reach, reach / density.per_semi_major, largest)


def profile_rows(rail: Rail, zone: ContactZone, density: MeshDensity) -> Floats:
    """Fractions (K, J) of the flank's arc length in each section."""
    centres = _diameter(rail, zone)
    middle = int(np.argmin(np.abs(rail.values - float(rail.curves.section.at(zone.centre)))))
    length, centre = float(rail.total[middle]), float(centres[middle])
    chord = _half_chord(rail.table[middle], zone)
    fine = FineZone(centre * length, density.profile_reach * chord, chord / density.per_semi_minor)
    base = graded(length, fine, density.growth)
    at = int(np.argmin(np.abs(base - centre * length)))
    at_centre = (centres * rail.total)[:, None]
    below = _led(base[at] - base[at::-1], chord, centres * rail.total, density.growth)
    above = _led(base[at:] - base[at], chord, (1.0 - centres) * rail.total, density.growth)
    rows = np.concatenate([at_centre - below[:, :0:-1], at_centre + above], axis=1)
    return rows / rail.total[:, None]


def _led(base: Floats, kept: float, room: Floats, growth: float) -> Floats:
    """Distances (K, J) of rows from the diameter that fill the ``room`` (K,) as ``base`` (J,) fills its own, mm.

    Rows up to ``kept`` mm keep their spacing; each further one gives way, or stretches, by the same factor more than
    the one before it. Where even rows as fine as the first have no room all of them give way alike.
    """
    spacing = np.diff(base)
    beyond = np.maximum(np.arange(1, len(base)) - np.count_nonzero(base[1:] <= kept), 0)
    low, high = np.full((len(room), 1), 1.0 / growth), np.full((len(room), 1), growth)
    for _ in range(_BISECTIONS):
        factor = np.sqrt(low * high)
        short = (spacing * factor**beyond).sum(axis=1, keepdims=True) < room[:, None]
        low, high = np.where(short, factor, low), np.where(short, high, factor)
    led = np.cumsum(spacing * low**beyond, axis=1)
    return np.concatenate([np.zeros((len(room), 1)), led * (room / led[:, -1])[:, None]], axis=1)


def _scaled(points: Floats, zone: ContactZone) -> Floats:
    """Distance (...,) from the centre in semi-axes: 1 on the ellipse."""
    offset = points - zone.centre
    along, across = offset @ zone.major_direction, offset @ zone.minor_direction
    return np.hypot(along / zone.semi_major, across / zone.semi_minor)


def _half_chord(section: Floats, zone: ContactZone) -> float:
    """Half the length that the ellipse has along a section (P, 3) through its centre."""
    nearest = int(np.clip(np.argmin(np.linalg.norm(section - zone.centre, axis=1)), 1, len(section) - 2))
    step = section[nearest + 1] - section[nearest - 1]
    return float(np.linalg.norm(step) / _scaled(zone.centre + step, zone))


def _diameter(rail: Rail, zone: ContactZone) -> Floats:
    """Fraction (K,) of the arc length at which each section meets the diameter, held beyond its ends."""
    rows = np.arange(len(rail.values))
    square = _scaled(rail.table, zone) ** 2
    nearest = np.clip(np.argmin(square, axis=1), 1, square.shape[1] - 2)
    before, here, after = (square[rows, nearest + step] for step in (-1, 0, 1))
    bend = before - 2.0 * here + after
    offset = np.clip(0.5 * (before - after) / bend, -1.0, 1.0)
    spacing = 0.5 * (rail.lengths[rows, nearest + 1] - rail.lengths[rows, nearest - 1])
    fraction = (rail.lengths[rows, nearest] + offset * spacing) / rail.total
    inside = np.flatnonzero(square.min(axis=1) <= _FOLLOWED**2)
    held = np.clip(rows, inside.min(), inside.max())
    return np.clip(fraction[held], _END_MARGIN, 1.0 - _END_MARGIN)


def across_divisions(zone: ContactZone | None, profile: dict[str, Floats], density: MeshDensity) -> Floats:
    """Fractions from the left to the right side of the tooth, fine below the loaded flank.

    profile: points (K, J, 3) of both sides.
    """
    if zone is None:
        even = np.linspace(0.0, 1.0, density.coarse_rows[0] + 1)
        return even - density.coarse_crowding * np.sin(2.0 * np.pi * even) / (2.0 * np.pi)
    gap = np.linalg.norm(profile["right"] - profile["left"], axis=-1)
    thickness = float(np.median(gap))
    reach = density.depth_reach * zone.semi_minor
    fine = FineZone(0.0, reach, density.first_layer * zone.semi_minor, density.largest_layer * thickness)
    inward = graded(thickness, fine, density.depth_growth) / thickness
    return inward if zone.side == "left" else 1.0 - inward[::-1]
