"""Sides of a generated wheel tooth: the flank that the flank of a threaded tool cuts, and the fillet that the rounding
of its tip cuts.

Where the tool does not undercut the tooth, both touch along the line that the common edge of flank and rounding cuts.
Elsewhere the flank would end in a cusp, which the rounding has cut away: there they cross.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import DesignError
from meshwright.design.description import table_and_key
from meshwright.drive import Drive
from meshwright.fe.followed import Bools, Generated, Line, held, in_section, level
from meshwright.fe.generated import constant
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import SectionCurves
from meshwright.fe.rounding import Span
from meshwright.fe.sizes import key_of
from meshwright.fe.spine import Spine
from meshwright.fe.tooth import ToothSide
from meshwright.flank.surface import Flank, FlankPoints

_SAMPLES = 33
# Steps from the middle of the flank to either end, or along the fillet.
_STEPS = 64
_BISECTIONS, _NEWTON_STEPS = 50, 30
_ON_PLACE, _STILL = 1e-10, 1e-13


def generated_side(drive: Drive, member: str, span: Span, faces: tuple[float, float]) -> ToothSide:
    """Flank and fillet in sections z = constant of the wheel between two faces in mm.

    span: the flank's profile, its root end somewhere near the end of the tool's.  Raises ValueError where the tool does
    not leave a whole side.
    """
    values = np.linspace(*faces, _SAMPLES)
    wheel = Wheel.of(drive, member, span, faces)
    fillet, known = wheel.root(values), _Known.of(wheel, values)
    return ToothSide(
        SectionCurves(fillet.surface, _axial, constant(0.0), lambda sections: known.ends(sections)[1]),
        SectionCurves(known.line.surface, _axial, lambda sections: known.ends(sections)[0], known.tips),
    )


def _axial(points: Floats) -> Floats:
    return points[..., 2]


def _below_tip(found: FlankPoints) -> Floats:
    """Height (N,) left to the outside cylinder or, where the blank has one, to the throat if that is nearer."""
    tip = found.margins["tip"]
    return np.fmin(tip, found.margins.get("throat", tip))


@dataclass(frozen=True)
class Wheel:
    """What a tool cuts: flank over (t, rack angle), fillet over (turn of the tool's normal from the land, rack angle).

    spine: places of the flank from face to face.  joint: t of the edge between the tool's flank and its rounding.
    turn: that of the normal on this edge in rad.
    """

    surface: Flank
    flank: Generated
    fillet: Generated
    spine: Spine
    joint: float
    turn: float

    @classmethod
    def of(cls, drive: Drive, member: str, span: Span, faces: tuple[float, float]) -> Wheel:
        """Raises DesignError where the rounding of the tool's tip finds no place on its flank, ValueError where the
        flank does not go from face to face.
        """
        flank, rounding = (drive.flank(member, region) for region in ("flank", "fillet"))
        joint, turn = _edge(rounding, span.root)
        if not np.isfinite([joint, turn]).all():
            place = key_of(drive, "tool_rounding")
            size = drive.design.value(*reversed(table_and_key(place)))
            reason = "no ball of this radius touches the flank of the tool and its tip cylinder"
            raise DesignError(place, size, reason, "choose less")

        def on_flank(profile: Floats, face: Floats) -> FlankPoints:
            return flank(np.stack([profile, face], axis=1))

        def on_fillet(turned: Floats, face: Floats) -> FlankPoints:
            return rounding(np.stack([turned, np.full_like(turned, joint), face], axis=1))

        ends = joint, span.tip
        spine = Spine.along(on_flank, faces, span.middle, ends, lambda at: _below_tip(at) > 0.0, _STEPS)
        return cls(flank, on_flank, on_fillet, spine, joint, turn)

    def line(self, sections: Floats) -> Line:
        """The flank in the sections (K,), from its root to beyond its tip."""
        return Line.follow(self.flank, sections, self.spine.at(sections), self.spine.rows(sections, 2 * _STEPS + 1))

    def root(self, sections: Floats) -> Line:
        """The fillet in the sections (K,), from the land to the flank's edge."""
        land = np.zeros_like(sections)
        start = land, level(self.fillet, sections, land)
        rows = np.linspace(land, np.full_like(land, self.turn), _STEPS + 1)
        return Line.follow(self.fillet, sections, start, rows)

    def tips(self, sections: Floats) -> Floats:
        """t (K,) of the flank at the blank's tip in the sections (K,)."""
        return self.line(sections).up_to(_below_tip)

    def ends(self, sections: Floats) -> tuple[Floats, Floats]:
        """t of the flank and turn of the normal (K,), (K,) where flank and fillet meet in the sections (K,).

        Raises ValueError where they do not.
        """
        rows = self.spine.rows(sections, 2 * _STEPS + 1)[::-1]
        flank = Line.follow(self.flank, sections, self.spine.at(sections), rows)
        joint, turn = np.full_like(sections, self.joint), np.full_like(sections, self.turn)
        undercut = ~(flank.regular[-1] & (flank.profile[-1] == self.joint))
        if undercut.any():
            joint[undercut], turn[undercut] = self._crossing(flank.of(undercut))
        return joint, turn

    def _crossing(self, flank: Line) -> tuple[Floats, Floats]:
        """The same where the flank is undercut, by bisection between its tip and its cusp."""
        fillet = self.root(flank.sections)
        kept, cut = flank.start, flank.cusp()
        middle = flank.at(kept)
        outward = np.sign(_azimuthal(middle.points, middle.normals))

        def depth(place: Floats) -> tuple[Floats, Floats]:
            """Turn of the fillet at the radius of places of the flank, and how far it cuts them away, mm."""
            points = flank.at(place).points
            turn, beside = fillet.at_radius(np.hypot(points[:, 0], points[:, 1]))
            return turn, outward * _azimuthal(points, points - beside)

        removed = depth(kept)[1] > 0.0
        if removed.any():
            kept = np.where(removed, self.tips(flank.sections), kept)
        if not np.all(depth(cut)[1] > -_ON_PLACE):  # where undercut begins, they meet in the cusp itself
            raise ValueError("the flank ends in a cusp that the fillet does not reach")
        for _ in range(_BISECTIONS):
            here = 0.5 * (kept + cut)
            turn, deep = depth(here)
            removed = deep > 0.0
            kept, cut = np.where(removed, kept, here), np.where(removed, here, cut)
        return here, turn


@dataclass(frozen=True)
class _Known:
    """A side in the sections ``values`` (V,), from which its ends in any other section between them are found.

    line: its flank; tip, joint, turn (V,): as of :class:`Wheel`.
    """

    wheel: Wheel
    line: Line
    tip: Floats
    joint: Floats
    turn: Floats

    @classmethod
    def of(cls, wheel: Wheel, values: Floats) -> _Known:
        line = wheel.line(values)
        return cls(wheel, line, line.up_to(_below_tip), *wheel.ends(values))

    def tips(self, sections: Floats) -> Floats:
        """t (K,) of the flank at the blank's tip in the sections (K,)."""
        near = np.interp(sections, self.line.sections, self.tip)
        found, sure = self._to_tip(near, self.line.face_at(near, sections), sections)
        if not sure.all():
            found[~sure] = self.wheel.tips(sections[~sure])
        return found

    def ends(self, sections: Floats) -> tuple[Floats, Floats]:
        """t of the flank and turn of the normal (K,), (K,) where flank and fillet meet in the sections (K,).

        Where the sections known on either side have the edge of the tool's flank, one between them has it as well if
        the flank is regular there.
        """
        joint, turn = np.full_like(sections, self.wheel.joint), np.full_like(sections, self.wheel.turn)
        whole = self.joint == self.wheel.joint
        after = np.clip(np.searchsorted(self.line.sections, sections), 1, len(whole) - 1)
        face = in_section(self.wheel.flank, joint, self.line.face_at(joint, sections), sections)
        sure = whole[after - 1] & whole[after] & held(self.wheel.flank(joint, face), sections)
        if not sure.all():
            joint[~sure], turn[~sure] = self.wheel.ends(sections[~sure])
        return joint, turn

    def _to_tip(self, profile: Floats, face: Floats, sections: Floats) -> tuple[Floats, Bools]:
        """t (K,) at the tip in the sections by Newton's method from places near it, and where it leads there."""
        surface, begun = self.wheel.surface, profile
        names = [m["event"] for m in surface.body["margins"]]
        columns = [1 + names.index(name) for name in ("tip", "throat") if name in names]
        for _ in range(_NEWTON_STEPS):
            found = self.wheel.flank(profile, face)
            heights = np.stack([found.margins[names[c - 1]] for c in columns])
            nearest = np.argmin(np.where(np.isnan(heights), np.inf, heights), axis=0)
            slopes = surface.limit_slopes(found.parameters)[np.arange(len(face)), np.array(columns)[nearest]]
            matrix = np.stack([slopes, found.tangents[:, :, 2]], axis=1)
            off = np.stack([_below_tip(found), found.points[:, 2] - sections], axis=1)
            step = np.linalg.solve(matrix, off[:, :, None])[:, :, 0]
            profile, face = profile - step[:, 0], face - step[:, 1]
            if not np.abs(step).max() > _STILL:
                break
        found = self.wheel.flank(profile, face)
        rows = np.abs(self.line.profile[1] - self.line.profile[0]).max()
        sure = held(found, sections) & (np.abs(_below_tip(found)) < _ON_PLACE) & (np.abs(profile - begun) < rows)
        return profile, sure


def _edge(rounding: Flank, near: float) -> tuple[float, float]:
    """t where the rounding of the tool's tip touches its flank, and its turn in rad up to there; NaN if nowhere."""
    t = near
    for _ in range(_NEWTON_STEPS):
        off, _, slope, _ = rounding([[0.0, t, 0.0]]).conditions[0, 0]
        t -= off / slope
    if not abs(off) < _ON_PLACE:
        return np.nan, np.nan
    # The margin is the sine of the turn that is left to the flank's normal.
    sine, cosine = (rounding([[turn, t, 0.0]]).margins["junction"][0] for turn in (0.0, -0.5 * np.pi))
    return float(t), float(np.arctan2(sine, cosine))


def _azimuthal(points: Floats, vectors: Floats) -> Floats:
    """Components (K,) of vectors (K, 3) around the axis at points (K, 3)."""
    radius = np.hypot(points[:, 0], points[:, 1])
    return (points[:, 0] * vectors[:, 1] - points[:, 1] * vectors[:, 0]) / radius
