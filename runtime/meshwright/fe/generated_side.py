"""Sides of a generated wheel tooth: the flank that the flank of a threaded tool cuts, and the fillet that the rounding
of its tip cuts.

Where the tool does not undercut the tooth, both touch along the line that the common edge of flank and rounding cuts.
Elsewhere the flank would end in a cusp, which the rounding has cut away: there they cross.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from meshwright.base.errors import DesignError
from meshwright.design.description import table_and_key
from meshwright.drive import Drive
from meshwright.fe.followed import Generated, Line
from meshwright.fe.generated import constant
from meshwright.fe.hexahedra import Floats
from meshwright.fe.profile import SectionCurves
from meshwright.fe.rounding import Span
from meshwright.fe.sizes import key_of
from meshwright.fe.tooth import ToothSide
from meshwright.flank.surface import Flank, FlankPoints

_SAMPLES = 17
# Steps from the middle of the flank to either end, or along the fillet.
_STEPS = 64
_BISECTIONS, _NEWTON_STEPS = 50, 30
_ON_PLACE = 1e-10


def generated_side(drive: Drive, member: str, span: Span, faces: tuple[float, float]) -> ToothSide:
    """Flank and fillet in sections z = constant of the wheel between two faces in mm.

    span: the flank's profile, its root end somewhere near the end of the tool's.  Raises ValueError where the tool does
    not leave a whole side.
    """
    values = np.linspace(*faces, _SAMPLES)
    wheel = _Wheel.of(drive, member, span)
    inner, outer = (Line.follow(wheel.flank, values, span.middle, end, _STEPS) for end in (wheel.joint, span.tip))
    flank, fillet = inner.joined(outer), Line.follow(wheel.fillet, values, 0.0, wheel.turn, _STEPS)
    tip = CubicSpline(values, flank.up_to(_below_tip))
    wheel.ends(values)  # now, rather than when a mesh asks for it
    return ToothSide(
        SectionCurves(fillet.surface, _axial, constant(0.0), lambda sections: wheel.ends(sections)[1]),
        SectionCurves(flank.surface, _axial, lambda sections: wheel.ends(sections)[0], tip),
    )


def _axial(points: Floats) -> Floats:
    return points[..., 2]


def _below_tip(found: FlankPoints) -> Floats:
    """Height (N,) left to the outside cylinder or, where the blank has one, to the throat if that is nearer."""
    tip = found.margins["tip"]
    return np.fmin(tip, found.margins.get("throat", tip))


@dataclass(frozen=True)
class _Wheel:
    """What a tool cuts: flank over (t, rack angle), fillet over (turn of the tool's normal from the land, rack angle).

    middle: t in the middle of the flank.  joint: t of the edge between the tool's flank and its rounding.  turn: that
    of the normal on this edge in rad.
    """

    flank: Generated
    fillet: Generated
    middle: float
    joint: float
    turn: float

    @classmethod
    def of(cls, drive: Drive, member: str, span: Span) -> _Wheel:
        """Raises DesignError where the rounding of the tool's tip finds no place on its flank."""
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

        return cls(on_flank, on_fillet, span.middle, joint, turn)

    def ends(self, sections: Floats) -> tuple[Floats, Floats]:
        """t of the flank and turn of the normal (K,), (K,) where flank and fillet meet in the sections (K,).

        Raises ValueError where they do not.
        """
        flank = Line.follow(self.flank, sections, self.middle, self.joint, _STEPS)
        joint, turn = np.full_like(sections, self.joint), np.full_like(sections, self.turn)
        undercut = ~np.all(flank.regular, axis=0)
        if undercut.any():
            joint[undercut], turn[undercut] = self._crossing(flank.of(undercut))
        return joint, turn

    def _crossing(self, flank: Line) -> tuple[Floats, Floats]:
        """The same where the flank is undercut, by bisection between its middle and its cusp."""
        fillet = Line.follow(self.fillet, flank.sections, 0.0, self.turn, _STEPS)
        kept, cut = np.full_like(flank.sections, self.middle), flank.cusp()
        middle = flank.at(kept)
        outward = np.sign(_azimuthal(middle.points, middle.normals))
        here = cut
        for _ in range(_BISECTIONS):
            points = flank.at(here).points
            turn, beside = fillet.at_radius(np.hypot(points[:, 0], points[:, 1]))
            removed = outward * _azimuthal(points, points - beside) > 0.0
            if here is cut and not removed.all():
                raise ValueError("the flank ends in a cusp that the fillet does not reach")
            kept, cut = np.where(removed, kept, here), np.where(removed, here, cut)
            here = 0.5 * (kept + cut)
        return here, turn


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
