"""Interference of a head-cutter with the teeth beside the space that it cuts, and the tilt that avoids it.

The blades turn about the tool axis and pass over the gear twice: through the space being cut and, across the tool,
over finished teeth. There the blades must stay above the tips. Source: NASA/CR-2002-211895, sections 2 and 3,
Fig. 9, where this is judged by eye. The back of the blade, whose width the source does not give, is left out.
"""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError

TILT_KEY = "head_cutter_tilt_change_deg"

#: Samples around the tool, along the profile, and around the tool again on each closer look at the worst place.
AROUND, ALONG, CLOSER, LOOKS = 720, 16, 41, 3

#: The tilt is sought in these steps up to this change, then bisected; degrees.
STEP, FARTHEST, RESOLUTION = 1.0, 60.0, 1e-4


@dataclass(frozen=True)
class Clearance:
    """Smallest height of the blades above the tooth tips across the tool, mm; negative where they cut into teeth.

    ``point`` (3,) is the point of the blades, gear frame, at the tool's rotation ``angle`` (rad). If the blades do not
    pass over the face there, the height is infinite.
    """

    height: float
    point: np.ndarray
    angle: float


@dataclass(frozen=True)
class LeastTilt:
    """The smallest tilt that clears: ``tilt`` of the tool axis and its ``change`` from the placement, rad.

    NaN if no tilt within 60° of the placement clears, or none fails to.
    """

    tilt: float
    change: float


@dataclass(frozen=True)
class Judgement:
    """Whether a head-cutter at ``tilt`` (rad) clears the teeth across the tool, and the least tilt that does."""

    tilt: float
    clearance: Clearance
    least: LeastTilt

    def plain(self):
        """Plain data: lengths in mm, angles in degrees, None for what does not exist."""
        point = self.clearance.point.tolist()
        return {
            "clears": self.clearance.height > 0,
            "clearance_mm": _number(self.clearance.height),
            "point_mm": point if all(map(math.isfinite, point)) else None,
            "tool_angle_deg": _number(math.degrees(self.clearance.angle)),
            "tilt_deg": math.degrees(self.tilt),
            "least_tilt_deg": _number(math.degrees(self.least.tilt)),
            "least_tilt_change_deg": _number(math.degrees(self.least.change)),
        }


def _number(value):
    return value if math.isfinite(value) else None


def judged(drive):
    """The :class:`Judgement` of the head-cutter of a face worm drive."""
    tilt = math.radians(drive.design.sizes["head_cutter_tilt_deg"])
    return Judgement(tilt, clearance(drive), least_tilt(drive))


def clearance(drive):
    """:class:`Clearance` of the head-cutter of a face worm drive."""
    if drive.design.family != "face-worm":
        raise UsageError(f"a {drive.design.family} drive has no head-cutter")
    angles = np.linspace(-math.pi, math.pi, AROUND, endpoint=False)
    for _ in range(LOOKS):
        points, heights = _across(drive, angles)
        worst = np.unravel_index(np.argmin(heights), heights.shape)
        if not np.isfinite(heights[worst]):
            return Clearance(math.inf, np.full(3, np.nan), math.nan)
        angle, width = angles[worst[1]], angles[1] - angles[0]
        angles = np.linspace(angle - width, angle + width, CLOSER)
    return Clearance(float(heights[worst]), points[worst], float(angle))


def least_tilt(drive):
    """:class:`LeastTilt`: from the placement towards less tilt while the blades clear, else towards more."""
    start = math.degrees(drive.design.value(TILT_KEY))
    clear = clearance(drive).height > 0
    sign = -1.0 if clear else 1.0
    for k in range(int(FARTHEST / STEP)):
        near, far = start + sign * k * STEP, start + sign * (k + 1) * STEP
        if (clearance(_tilted(drive, far)).height > 0) != clear:
            found = _bisected(drive, near, far, clear)
            tilt = _tilted(drive, found).design.sizes["head_cutter_tilt_deg"]
            return LeastTilt(math.radians(tilt), math.radians(found))
    return LeastTilt(math.nan, math.nan)


def _bisected(drive, near, far, clear):
    """The change of tilt between ``near`` and ``far``, degrees, rounded to the side that clears."""
    while abs(far - near) > RESOLUTION:
        middle = 0.5 * (near + far)
        if (clearance(_tilted(drive, middle)).height > 0) == clear:
            near = middle
        else:
            far = middle
    return near if clear else far


def _tilted(drive, change):
    return drive.with_(design={TILT_KEY: change})


def _across(drive, angles):
    """Points (ALONG, N, 3) of the blades at angles (N,) around the tool, and their heights above the tips (ALONG, N).

    Infinite where a blade is not over the face, or is in the space being cut: the half of its way round on which its
    distance from the gear axis changes in the same sense as at the pitch point.
    """
    sizes = drive.design.sizes
    rounding = np.linspace(0.0, math.radians(sizes["fillet_angle_deg"]), ALONG // 2, endpoint=False)
    edge = np.linspace(sizes["flank_root_mm"], tip_place(drive), ALONG - ALONG // 2)
    parts = [_swept(drive, "fillet", rounding, angles), _swept(drive, "flank", edge, angles)]
    points, own = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    radius = np.hypot(points[..., 0], points[..., 1])
    inner, outer = (drive.design.value(f"gear_{end}_radius_mm") for end in ("inner", "outer"))
    over_teeth = ~own & (radius > inner) & (radius < outer)
    return points, np.where(over_teeth, points[..., 2] - np.interp(radius, *_tips(drive)), np.inf)


def tip_place(drive):
    """u of the gear's flank at the tip."""
    return drive.design.value("gear_addendum_mm", "blank") / math.cos(drive.design.value("blade_angle_deg"))


def _tips(drive):
    """Radii, ascending, and heights of the tooth tips: the tip line of the tooth that is being cut."""
    angles = np.linspace(-math.pi, math.pi, AROUND, endpoint=False)
    points, own = _swept(drive, "flank", [tip_place(drive)], angles)
    points = points[own]
    radius = np.hypot(points[:, 0], points[:, 1])
    order = np.argsort(radius)
    return radius[order], points[order, 2]


def _swept(drive, region, profile, angles):
    """Points (M, N, 3) of a region of the gear continued right round the tool, and which are in its own half."""
    grid = np.stack(np.meshgrid(profile, angles, indexing="ij"), axis=-1)
    found = drive.flank("wheel", region)(grid.reshape(-1, 2))
    at_pitch_point = drive.flank("wheel")([[0.0, 0.0]])
    own = _growth(found) * _growth(at_pitch_point) > 0
    return found.points.reshape(*grid.shape[:2], 3), own.reshape(grid.shape[:2])


def _growth(found):
    """Half the growth of the squared distance from the gear axis with the tool's rotation."""
    return np.sum(found.points[:, :2] * found.tangents[:, 1, :2], axis=1)
