"""A flank laid flat: seen along its body's axis or in the meridian plane, whichever shows more of it."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Projection:
    """How points (…, 3) of a body frame, whose z axis is the body's axis, come to lie in a picture, mm."""

    end_on: bool

    @classmethod
    def of(cls, points, normals):
        """The better one for a flank with these points and unit normals (N, 3): less foreshortened on average."""
        around = np.stack([-points[:, 1], points[:, 0]], axis=1)
        around /= np.linalg.norm(around, axis=1, keepdims=True)
        meridian = np.abs(np.sum(around * normals[:, :2], axis=1))
        return cls(bool(np.nanmean(np.abs(normals[:, 2])) > np.nanmean(meridian)))

    def __call__(self, points):
        """Horizontal and vertical place, each (…,)."""
        if self.end_on:
            return points[..., 0], points[..., 1]
        return points[..., 2], np.hypot(points[..., 0], points[..., 1])

    def labels(self, member):
        """Names of the two directions."""
        if self.end_on:
            return f"x on the {member}, mm", f"y on the {member}, mm"
        return f"axial position on the {member}, mm", f"radius on the {member}, mm"
