"""A flank laid flat: seen along its body's axis, in the meridian plane, or unrolled along its thread."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Projection:
    """How points (…, 3) of a body frame, whose z axis is the body's axis, come to lie in a picture, mm or deg.

    ``screw`` is the screw parameter (mm/rad) along which a thread of more than one turn is unrolled, else None; at the
    axial position ``start`` (mm) the unrolled angle is that of the body frame.
    """

    end_on: bool
    screw: float | None = None
    start: float = 0.0

    @classmethod
    def of(cls, points, normals):
        """The better view of a flank with these points and unit normals (N, 3): less foreshortened on average.

        Seen along the axis, the turns of a thread would hide each other. Its screw parameter is that of the screw
        motion which moves the flank in itself: n·(k × r + p k) = 0.
        """
        if not (np.isfinite(points) & np.isfinite(normals)).all(axis=1).any():
            return cls(end_on=True)
        turning = points[:, 0] * normals[:, 1] - points[:, 1] * normals[:, 0]
        meridian = np.abs(turning) / np.hypot(points[:, 0], points[:, 1])
        if not np.nanmean(np.abs(normals[:, 2])) > np.nanmean(meridian):
            return cls(end_on=False)
        screw = float(np.nanmedian(-turning / normals[:, 2]))
        if np.ptp(points[:, 2]) > 2.0 * np.pi * abs(screw) > 0.0:
            return cls(end_on=False, screw=screw, start=_start(points, screw))
        return cls(end_on=True)

    def __call__(self, points):
        """Horizontal and vertical place, each (…,)."""
        if self.end_on:
            return points[..., 0], points[..., 1]
        radius = np.hypot(points[..., 0], points[..., 1])
        return (points[..., 2], radius) if self.screw is None else (self._unrolled(points), radius)

    def _unrolled(self, points):
        """Angle about the axis, deg, on the turn of the thread that the axial position tells."""
        angle = np.arctan2(points[..., 1], points[..., 0])
        turns = (points[..., 2] - self.start) / self.screw - angle
        return np.degrees(angle + 2.0 * np.pi * np.round(turns / (2.0 * np.pi)))

    def labels(self, member):
        """Names of the two directions."""
        if self.end_on:
            return f"x on the {member}, mm", f"y on the {member}, mm"
        across = "axial position on" if self.screw is None else "angle along the thread of"
        return f"{across} the {member}, {'mm' if self.screw is None else 'deg'}", f"radius on the {member}, mm"


def _start(points, screw):
    """Axial position at which the middle of a thread with this screw parameter has the angle 0."""
    off = np.exp(1j * (np.arctan2(points[:, 1], points[:, 0]) - points[:, 2] / screw))
    return float(-screw * np.angle(off.mean()))
