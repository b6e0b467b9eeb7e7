"""What loaded contact needs to know of a gear pair: teeth, placements and the unloaded contact."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
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

    normal points out of the pinion; curvatures are those of the gap, 0 < curvature_min <= curvature_max.
    """

    pinion_angle: float
    wheel_angle: float
    point: Floats
    normal: Floats
    curvature_min: float
    curvature_max: float
    major_direction: Floats


@dataclass(frozen=True)
class GearPair:
    """Two members and their contact.

    ratio: wheel angle over pinion angle.  sense: +1 if this flank drives for growing pinion angle, else -1.
    touch: contact of the reference pair at a pinion angle, or None where it has none.  middle_pair:
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


def unloaded_wheel_angle(gear: GearPair, contacts: tuple[PairTouch, ...]) -> float:
    """Wheel angle at which the first of the pairs touches: the pair that leads in the driven sense."""
    angles = [contact.wheel_angle for contact in contacts]
    return max(angles) if gear.sense > 0 else min(angles)


def lever_arm(member: Member, point: Floats, direction: Floats) -> float:
    """Moment about the member's axis of a unit force along ``direction`` at ``point``, fixed frame, mm."""
    origin, axis = member.axis
    return float(np.dot(axis, np.cross(point - origin, direction)))
