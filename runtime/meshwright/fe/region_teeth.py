"""Teeth whose sizes nothing but the regions of their flanks and fillets says: gears of any kind, on any sections.

Sections are the planes, cylinders or cones about the axis that the drive declares across its teeth; within one the
curves of fillet and flank run from the root land to the tip, by the generated surface's own profile parameter.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.contact.placement import about_z
from meshwright.drive import Drive
from meshwright.fe.closed_body import gear_tooth
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import Section, SectionCurves
from meshwright.fe.tooth import SideName, Teeth, ToothForm, ToothSide
from meshwright.flank.lines import Lines, solve
from meshwright.flank.sides import RegionSide, Side

# Sections and places across them from which Newton's method starts; ends of more sections than these are interpolated.
_SECTIONS, _ACROSS = 129, 17
# A flank down to the root land is cut in two so far up, in parts of its height: the mesh wants a fillet below it.
_LOWEST = 0.06


def region_teeth(drive: Drive, member: str, rim_thickness: float | None) -> Teeth:
    """The teeth of a member; rim_thickness in mm below the root, None for twice the height of the teeth.

    Raises UsageError and DesignError as :func:`~meshwright.fe.closed_body.solid_body`.
    """
    tooth, own = gear_tooth(drive, member, rim_thickness)
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


def _side(side: Side, turn: float, faces: tuple[float, float], member: str) -> ToothSide:
    if not isinstance(side, RegionSide) or side.has_step:
        raise UsageError(
            f"the fillet of the {member} does not meet its flank: there is no mesh of such teeth; leave out the "
            "modification of the flank that takes it off at the root"
        )
    motion = about_z(turn)[:3, :3].T
    flank = _Curves(side.flank_lines, side.tip, faces, motion)
    if side.fillet is None:
        return ToothSide(flank.curves(side, 0.0, _LOWEST), flank.curves(side, _LOWEST, 1.0))
    fillet = _Curves(side.fillet_lines, not side.land, faces, motion)
    return ToothSide(fillet.curves(side, 0.0, 1.0), flank.curves(side, 0.0, 1.0))


@dataclass(frozen=True)
class _Curves:
    """Lines across a region at section values; ``upward``: whether they run to the tip from their lower ends;
    ``motion`` (3, 3) puts them in their place, rows to rows.
    """

    lines: Callable[[Floats], Lines]
    upward: bool
    faces: tuple[float, float]
    motion: Floats
    known: dict[bytes, Lines] = field(default_factory=dict, repr=False)
    tables: dict[int, Floats] = field(default_factory=dict, repr=False)

    def curves(self, side: RegionSide, low: float, high: float) -> SectionCurves:
        """Their part between two shares of the way up."""
        section: Section = side.sections.at
        first, last = (lambda values, share=share: self._ends(values, share) for share in (low, high))
        return _OfSections(self.surface, section, first, last)

    def at(self, values: Floats) -> Lines:
        """The lines in sections, kept."""
        key = values.tobytes()
        if key not in self.known:
            self.known[key] = self.lines(values)
        return self.known[key]

    def _ends(self, values: Floats, share: float) -> Floats:
        """Profile parameters (K,) at a share of the way from the root end to the tip end."""
        if len(values) <= _SECTIONS:
            low, high = self._profile(self.at(values))
        else:
            sections = self._sections
            low, high = (np.interp(values, sections, end) for end in self._profile(self.at(sections)))
        return low + share * (high - low)

    @property
    def _sections(self) -> Floats:
        return np.linspace(*self.faces, _SECTIONS)

    def _profile(self, found: Lines) -> tuple[Floats, Floats]:
        lower, upper = found.lower[:, found.region.profile], found.upper[:, found.region.profile]
        return (lower, upper) if self.upward else (upper, lower)

    def surface(self, profile: Floats, section: Floats) -> tuple[Floats, Floats]:
        """Points and normals (..., 3) at profile parameters in sections; not a number where the surface is not."""
        profile, section = np.broadcast_arrays(profile, section)
        flat, values = profile.ravel().astype(float), section.ravel().astype(float)
        lines = self.at(self._sections)
        q = solve(lines.region, flat, values, self._near(lines, flat, values))
        found = lines.region.flank(q)
        points, normals = ((a @ self.motion).reshape(*profile.shape, 3) for a in (found.points, found.normals))
        return points, normals

    def _near(self, lines: Lines, profile: Floats, values: Floats) -> Floats:
        """Parameters (N, k) near places, between those of known sections."""
        if _ACROSS not in self.tables:
            self.tables[_ACROSS] = lines.places(np.linspace(0.0, 1.0, _ACROSS))
        table, of = self.tables[_ACROSS], lines.region.profile
        at = np.clip((values - self.faces[0]) / (self.faces[1] - self.faces[0]), 0.0, 1.0) * (_SECTIONS - 1)
        column = np.minimum(at.astype(int), _SECTIONS - 2)
        rest = (at - column)[:, None]
        rows = [(1.0 - rest) * table[k, column] + rest * table[k, column + 1] for k in (0, -1)]
        low, high = rows[0][:, of], rows[1][:, of]
        share = np.clip((profile - low) / (high - low), 0.0, 1.0) * (_ACROSS - 1)
        row = np.minimum(share.astype(int), _ACROSS - 2)
        part = (share - row)[:, None]
        pairs = [(1.0 - part) * table[row, c] + part * table[row + 1, c] for c in (column, column + 1)]
        return (1.0 - rest) * pairs[0] + rest * pairs[1]


class _OfSections(SectionCurves):
    """Curves of a surface whose second parameter is the section itself."""

    def solve(self, values: Floats, profile: Floats) -> Floats:
        return np.broadcast_to(values[:, None], profile.shape).copy()

