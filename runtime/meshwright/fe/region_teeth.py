"""Teeth whose sizes nothing but the regions of their flanks and fillets says: gears of any kind, on any sections.

Sections are the planes, cylinders or cones about the axis that the drive declares across its teeth; within one the
curves of fillet and flank run from the root land to the tip, by the generated surface's own profile parameter.
"""

from dataclasses import dataclass, field

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.contact.placement import about_z
from meshwright.drive import Drive
from meshwright.fe.closed_body import gear_tooth
from meshwright.fe.generated import pierced
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import OfSections, SectionCurves
from meshwright.fe.tooth import SideName, Teeth, ToothForm, ToothSide
from meshwright.fe.tooth_patches import Tooth
from meshwright.flank.known_side import KnownSide
from meshwright.flank.lines import solve
from meshwright.flank.sections import lengthwise
from meshwright.flank.sides import RegionSide, Side
from meshwright.flank.surface import FlankPoints

# Sections in which the turn of a tooth about the axis is followed.
_SECTIONS = 65
# Places across the known sections from which Newton's method starts.
_ACROSS = 17
# A flank down to the root land is cut in two so far up, in parts of its height: the mesh wants a fillet below it.
_LOWEST = 0.06
# What winds further about the axis from face to face, rad, is a thread and no tooth between two neighbours.
_MOST_WOUND = np.pi


def region_teeth(drive: Drive, member: str, rim_thickness: float | None) -> Teeth:
    """The teeth of a member; rim_thickness in mm below the root, None for twice the height of the teeth.

    Raises UsageError and DesignError as :func:`~meshwright.fe.closed_body.solid_body`, and UsageError for threads.
    """
    tooth, own = gear_tooth(drive, member, rim_thickness)
    _check_wound(tooth, drive, member)
    names: tuple[SideName, SideName] = ("right", "left") if tooth.outward > 0.0 else ("left", "right")
    sides = {
        name: _side(side, turn, tooth.faces, member)
        for name, side, turn in zip(names, tooth.sides, tooth.turns, strict=True)
    }
    sections = tooth.sections

    def bore(points: Floats) -> Floats:
        section = sections.at(points)
        return sections.points(section, tooth.bore(section), np.arctan2(points[..., 1], points[..., 0]))

    to_the_right = about_z(-tooth.outward * tooth.pitch)
    form = ToothForm.repeated(sides["left"], sides["right"], tooth.faces, to_the_right, bore)
    return Teeth(lambda angle: form, names[own])


def _check_wound(tooth: Tooth, drive: Drive, member: str) -> None:
    middle = np.array([0.0, 0.5, 1.0])
    _, points, _ = tooth.sides[0].grids(np.linspace(*tooth.faces, _SECTIONS), middle[::2], middle)
    azimuth = np.unwrap(np.arctan2(points[:, 1, 1], points[:, 1, 0]))
    if abs(azimuth[-1] - azimuth[0]) > _MOST_WOUND:
        raise UsageError(
            f"{drive.design.family}: the {member} is a thread, of which loaded contact and stress need the sizes, but "
            f"its description has no sizes of solid teeth; it needs the function solid_{member}"
        )


def _side(side: Side, turn: float, faces: tuple[float, float], member: str) -> ToothSide:
    if not isinstance(side, RegionSide) or side.has_step:
        raise UsageError(
            f"the fillet of the {member} does not meet its flank: there is no mesh of such teeth; leave out the "
            "modification of the flank that takes it off at the root"
        )
    motion, known = about_z(turn)[:3, :3].T, KnownSide.of(side, faces)
    flank = _Curves(known, "flank", side.tip, motion)
    if known.fillet is None:
        return ToothSide(flank.curves(0.0, _LOWEST), flank.curves(_LOWEST, 1.0))
    return ToothSide(_Curves(known, "fillet", not side.land, motion).curves(0.0, 1.0), flank.curves(0.0, 1.0))


@dataclass(frozen=True)
class _Curves:
    """Lines across the ``region``, flank or fillet, of a side; ``upward``: whether they run to the tip from their lower
    ends; ``motion`` (3, 3) puts them in their place, rows to rows.
    """

    known: KnownSide
    region: str
    upward: bool
    motion: Floats
    table: list[Floats] = field(default_factory=list, repr=False)

    def curves(self, low: float, high: float) -> SectionCurves:
        """Their part between two shares of the way up."""
        first, last = (lambda values, share=share: self._ends(values, share) for share in (low, high))
        return OfSections(self, self.known.side.sections, first, last)

    def _ends(self, values: Floats, share: float) -> Floats:
        """Profile parameters (K,) at a share of the way from the root end to the tip end."""
        ends = self.known.profiles(self.region, values)
        low, high = ends if self.upward else ends[::-1]
        return low + share * (high - low)

    def __call__(self, profile: Floats, section: Floats) -> tuple[Floats, Floats]:
        """Points and normals (..., 3) at profile parameters in sections; not a number where the surface is not."""
        profile, section = np.broadcast_arrays(profile, section)
        found = self._at(profile.ravel().astype(float), section.ravel().astype(float))
        points, normals = ((a @ self.motion).reshape(*profile.shape, 3) for a in (found.points, found.normals))
        return points, normals

    def pierced(self, feet: Floats, plane: Floats, start: tuple[float, float]) -> tuple[Floats, ...]:
        """Profile parameters, sections (N,), points and normals (N, 3) where normals of a plane meet the surface."""
        region, back = self.known.lines(self.region).region, self.motion.T
        near = self._near(*np.array(start)[:, None])[0]
        found = region.flank(pierced(region.flank, feet @ back, plane @ back, near))
        placed = found.points @ self.motion, found.normals @ self.motion
        return found.parameters[:, region.profile], lengthwise(region.flank, found), *placed

    def _at(self, profile: Floats, section: Floats) -> FlankPoints:
        region = self.known.lines(self.region).region
        return region.flank(solve(region, profile, section, self._near(profile, section)))

    def _near(self, profile: Floats, values: Floats) -> Floats:
        """Parameters (N, k) near places, between those of known sections."""
        if not self.table:
            self.table.append(self.known.lines(self.region).places(np.linspace(0.0, 1.0, _ACROSS)))
        (table,), of = self.table, self.known.lines(self.region).region.profile
        column, rest = self.known.beside(values)
        rows = [(1.0 - rest) * table[k, column] + rest * table[k, column + 1] for k in (0, -1)]
        low, high = rows[0][:, of], rows[1][:, of]
        share = np.clip((profile - low) / (high - low), 0.0, 1.0) * (_ACROSS - 1)
        row = np.minimum(share.astype(int), _ACROSS - 2)
        part = (share - row)[:, None]
        pairs = [(1.0 - part) * table[row, c] + part * table[row + 1, c] for c in (column, column + 1)]
        return (1.0 - rest) * pairs[0] + rest * pairs[1]
