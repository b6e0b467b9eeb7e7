"""Interference of a tool of revolution with the teeth beside the space that it cuts, and the tilt that avoids it.

The blades turn about the tool axis and pass over the wheel twice: through the space being cut and, across the tool,
over finished teeth. There the blades must stay above the tips. The back of the blade is left out. Applies to drives
that say which tool must clear (``derive.language.functions.ToolClearance``).
"""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.plain import finite_or_none

#: Samples around the tool, along the profile, and around the tool again on each closer look at the worst place.
AROUND, ALONG, CLOSER, LOOKS = 720, 16, 41, 3

#: The tilt is sought in these steps up to this change, then bisected; degrees.
STEP, FARTHEST, RESOLUTION = 1.0, 60.0, 1e-4


@dataclass(frozen=True)
class Clearance:
    """Smallest height of the blades above the tooth tips across the tool, mm; negative where they cut into teeth.

    ``point`` (3,) is the point of the blades, wheel frame, at the tool's rotation ``angle`` (rad). If the blades do not
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
    """Whether the tool ``name`` at ``tilt`` (rad) clears the teeth across it, and the least tilt that does."""

    name: str
    tilt: float
    clearance: Clearance
    least: LeastTilt

    def plain(self):
        """Plain data: lengths in mm, angles in degrees, None for what does not exist."""
        point = self.clearance.point.tolist()
        return {
            "clears": self.clearance.height > 0,
            "clearance_mm": finite_or_none(self.clearance.height),
            "point_mm": point if all(map(math.isfinite, point)) else None,
            "tool_angle_deg": finite_or_none(math.degrees(self.clearance.angle)),
            "tilt_deg": math.degrees(self.tilt),
            "least_tilt_deg": finite_or_none(math.degrees(self.least.tilt)),
            "least_tilt_change_deg": finite_or_none(math.degrees(self.least.change)),
        }


def judged(drive):
    """The :class:`Judgement` of the drive's tool."""
    return Judgement(_tool(drive)["name"], _tilt(drive), clearance(drive), least_tilt(drive))


def _tool(drive):
    tool = drive.design.description["tool_clearance"]
    if tool is None:
        raise UsageError(f"a {drive.design.family} drive has no tool that passes over finished teeth")
    return tool


def _tilt(drive):
    """Tilt of the tool's axis, rad."""
    return math.radians(drive.design.sizes[_tool(drive)["tilt_size"]])


def clearance(drive):
    """:class:`Clearance` of the drive's tool."""
    _tool(drive)
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
    start = math.degrees(drive.design.value(_tool(drive)["tilt_key"]))
    clear = clearance(drive).height > 0
    sign = -1.0 if clear else 1.0
    for k in range(int(FARTHEST / STEP)):
        near, far = start + sign * k * STEP, start + sign * (k + 1) * STEP
        if (clearance(_tilted(drive, far)).height > 0) != clear:
            found = _bisected(drive, near, far, clear)
            return LeastTilt(_tilt(_tilted(drive, found)), math.radians(found))
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
    return drive.with_(design={_tool(drive)["tilt_key"]: change})


def _across(drive, angles):
    """Points (ALONG, N, 3) of the blades at angles (N,) around the tool, and their heights above the tips (ALONG, N).

    Infinite where a blade is not over the face, or is in the space being cut: the half of its way round on which its
    distance from the wheel axis changes in the same sense as at the pitch point.
    """
    sizes = _sizes(drive)
    rounding = np.linspace(0.0, sizes["fillet_end"], ALONG // 2, endpoint=False)
    edge = np.linspace(sizes["edge_root"], sizes["edge_tip"], ALONG - ALONG // 2)
    parts = [_swept(drive, "fillet", rounding, angles), _swept(drive, "flank", edge, angles)]
    points, own = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    radius = np.hypot(points[..., 0], points[..., 1])
    over_teeth = ~own & (radius > sizes["inner"]) & (radius < sizes["outer"])
    return points, np.where(over_teeth, points[..., 2] - np.interp(radius, *_tips(drive)), np.inf)


def _sizes(drive):
    return {name: float(value) for name, value in drive.function("tool_clearance")().items()}


def _tips(drive):
    """Radii, ascending, and heights of the tooth tips: the tip line of the tooth that is being cut."""
    angles = np.linspace(-math.pi, math.pi, AROUND, endpoint=False)
    points, own = _swept(drive, "flank", [_sizes(drive)["edge_tip"]], angles)
    points = points[own]
    radius = np.hypot(points[:, 0], points[:, 1])
    order = np.argsort(radius)
    return radius[order], points[order, 2]


def _swept(drive, region, profile, angles):
    """Points (M, N, 3) of a region of the wheel continued right round the tool, and which are in its own half."""
    grid = np.stack(np.meshgrid(profile, angles, indexing="ij"), axis=-1)
    found = drive.flank("wheel", region)(grid.reshape(-1, 2))
    at_pitch_point = drive.flank("wheel")([[0.0, 0.0]])
    own = _growth(found) * _growth(at_pitch_point) > 0
    return found.points.reshape(*grid.shape[:2], 3), own.reshape(grid.shape[:2])


def _growth(found):
    """Half the growth of the squared distance from the wheel axis with the tool's rotation."""
    return np.sum(found.points[:, :2] * found.tangents[:, 1, :2], axis=1)
