"""What loaded contact needs to know of a gear pair: teeth, placements and the unloaded contact."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from meshwright.fe.hexahedra import Floats
from meshwright.fe.material import Material
from meshwright.fe.tooth import ToothForm


@dataclass(frozen=True)
class Member:
    """Pinion or wheel.

    tooth: the form of the reference tooth where a pair meets at a member angle in rad: a gear tooth is the same at
    every angle, of a thread it is the portion that then faces the wheel.  working: the side in contact.
    pose: member angle in rad to the 4 x 4 motion from the body frame to the fixed frame; the member's axis is the
    z axis of its body frame.  pitch: angle between successive teeth.  turning: +1 if a growing member angle turns
    the body about +z of its own frame, -1 if about -z.
    """

    tooth: Callable[[float], ToothForm]
    working: Literal["left", "right"]
    pose: Callable[[float], Floats]
    pitch: float
    turning: int
    material: Material

    @property
    def axis(self) -> tuple[Floats, Floats]:
        """Origin and unit direction of the axis in the fixed frame, along +z of the body."""
        pose = self.pose(0.0)
        return pose[:3, 3], pose[:3, 2]

    def tooth_motion(self, pairs_later: int) -> Floats:
        """4 x 4 motion in the body frame from the reference tooth to the tooth that meets so many pairs later."""
        return np.linalg.inv(self.pose(0.0)) @ self.pose(-pairs_later * self.pitch)


@dataclass(frozen=True)
class Touch:
    """The unloaded contact of one pair at a pinion angle: fixed frame, mm and rad.

    normal points out of the pinion; curvatures are those of the gap, 0 < curvature_min <= curvature_max.  edge: what
    touches where it is no tangency, such as "edge of the wheel (face)"; the normal is then that of the
    flank that it touches, and curvatures and their direction are not numbers.  Of a line of contact curvature_min is 0,
    curvature_max is not a number, point is in its middle and major_direction along it.
    """

    pinion_angle: float
    wheel_angle: float
    point: Floats
    normal: Floats
    curvature_min: float
    curvature_max: float
    major_direction: Floats
    edge: str = ""


@dataclass(frozen=True)
class GearPair:
    """Two members and their contact.

    ratio: wheel angle over pinion angle.  sense: +1 if this flank drives for growing pinion angle, else -1.
    touch: tangency of the reference pair at a pinion angle, or None where it has none.  edge: its first contact there,
    or None where that is a tangency or nothing.  leader: the pair (``pairs_later``) that touches first of all at a
    pinion angle, None if nothing tells.  middle_pair:
    pinion angle to the pair (``pairs_later``) about which pairs are counted.  assumed: sizes of the blank
    in mm that the design leaves open, as the solids have them.  contact_ratio: that of the whole blank, NaN if unknown.
    ends: where the contact of a pair begins and ends, such as "face of the wheel".
    deviations: by member, what a measured flank adds to its height: points (N, 3) of it and a direction (3,), body
    frame, to heights (N,) along the direction in mm, and where anything is measured (N,).
    """

    pinion: Member
    wheel: Member
    ratio: float
    sense: int
    touch: Callable[[float], Touch | None]
    edge: Callable[[float], Touch | None] = lambda angle: None
    leader: Callable[[float], int | None] = lambda angle: None
    middle_pair: Callable[[float], int] = lambda angle: 0
    assumed: dict[str, float] = field(default_factory=dict)
    contact_ratio: float = math.nan
    ends: tuple[str, ...] = ()
    deviations: dict[str, Callable[[Floats, Floats], tuple[Floats, NDArray[np.bool_]]]] = field(default_factory=dict)


@dataclass(frozen=True)
class PairTouch:
    """Contact of the pair that is ``pairs_later`` tooth pitches behind the reference pair."""

    pairs_later: int
    touch: Touch
    wheel_angle: float


def pair_numbers(gear: GearPair, pinion_angle: float, pairs: int) -> range:
    """So many neighbouring pairs (``pairs_later``) at a pinion angle, centred on the middle one."""
    first = gear.middle_pair(pinion_angle) - (pairs - 1) // 2
    return range(first, first + pairs)


def touches(gear: GearPair, pinion_angle: float, pairs: int) -> tuple[PairTouch, ...]:
    """The contacts of ``pairs`` neighbouring pairs at a pinion angle, centred on the middle pair.

    wheel_angle of each is that of the whole wheel at which this pair would touch.
    """
    found = []
    for pairs_later in pair_numbers(gear, pinion_angle, pairs):
        touch = gear.touch(pinion_angle - pairs_later * gear.pinion.pitch)
        if touch is not None:
            wheel_angle = touch.wheel_angle + pairs_later * gear.wheel.pitch
            found.append(PairTouch(pairs_later, touch, wheel_angle))
    return tuple(found)


def first_touches(gear: GearPair, pinion_angle: float, pairs: int) -> tuple[PairTouch, ...]:
    """As :func:`touches`, where an edge of a pair touches first that, and the edges of a further pair on either side.

    Ascending ``pairs_later``.  Where another pair than these is the first of all, edges would carry what it carries.
    """
    counted = pair_numbers(gear, pinion_angle, pairs)
    about = range(counted.start - 1, counted.stop + 1)
    leader = gear.leader(pinion_angle)
    if leader is not None and leader not in about:
        return touches(gear, pinion_angle, pairs)
    found = []
    for pairs_later in about:
        own = pinion_angle - pairs_later * gear.pinion.pitch
        touch = gear.edge(own) or (gear.touch(own) if pairs_later in counted else None)
        if touch is not None:
            found.append(PairTouch(pairs_later, touch, touch.wheel_angle + pairs_later * gear.wheel.pitch))
    return tuple(found)


def tangencies_only(gear: GearPair) -> GearPair:
    """The pair without its edges: what a mesh that is graded about tangencies, or a measured flank, can represent."""
    return replace(gear, edge=lambda angle: None)


def leading_edge(gear: GearPair, pinion_angle: float, pairs: int) -> tuple[PairTouch, float] | None:
    """The edge that touches first of all, and how far the tangencies of the pairs are then apart, mm; else None."""
    found = first_touches(gear, pinion_angle, pairs)
    lead = max(found, key=lambda contact: gear.sense * contact.wheel_angle, default=None)
    if lead is None or not lead.touch.edge:
        return None
    behind = [abs(lead.wheel_angle - contact.wheel_angle) for contact in touches(gear, pinion_angle, pairs)]
    lever = abs(lever_arm(gear.wheel, lead.touch.point, lead.touch.normal))
    return lead, lever * min(behind, default=math.inf)


def unloaded_wheel_angle(gear: GearPair, contacts: tuple[PairTouch, ...]) -> float:
    """Wheel angle at which the first of the pairs touches: the pair that leads in the driven sense."""
    angles = [contact.wheel_angle for contact in contacts]
    return max(angles) if gear.sense > 0 else min(angles)


def lever_arm(member: Member, point: Floats, direction: Floats) -> float:
    """Moment about the member's axis of a unit force along ``direction`` at ``point``, fixed frame, mm."""
    origin, axis = member.axis
    return float(np.dot(axis, np.cross(point - origin, direction)))
