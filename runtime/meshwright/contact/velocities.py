"""Velocities at the contact point: of both bodies, of the point itself, sliding and entraining.

With axes d_i of growing angle through o_i: v_i = ω_i d_i × (r − o_i), ω1 = 1, ω2 = dφ2/dφ1, and ċ = dr/dφ1 of the
contact point by the implicit function theorem. Sliding v1 − v2; the flanks pass under the contact with u_i = v_i − ċ,
and entraining is (u1 + u2)/2. Both are tangential. Source: F. L. Litvin and A. Fuentes, Gear Geometry and Applied
Theory, 2nd ed. (2004), chapter 2.
"""

from dataclasses import dataclass

import numpy as np

from meshwright.base.library import library, pointer
from meshwright.contact.placement import placed


@dataclass(frozen=True)
class Velocities:
    """At N contact points for a pinion that turns by 1 rad/s in its positive sense, fixed frame, mm/rad: (N, 3) each.

    ``bodies[name]`` of the bodies' material, ``point`` of the contact point. NaN where there is no contact point.
    """

    bodies: dict[str, np.ndarray]
    point: np.ndarray

    @property
    def sliding(self):
        """Of the pinion's material relative to the wheel's."""
        return self.bodies["pinion"] - self.bodies["wheel"]

    @property
    def entraining(self):
        """Mean velocity of both flanks through the contact."""
        return 0.5 * (self.bodies["pinion"] + self.bodies["wheel"]) - self.point

    @property
    def specific_sliding(self):
        """Of each body by name (N,): sliding over the speed at which its flank passes the contact in that direction.

        Infinite where that speed is 0, not a number where the flanks roll.
        """
        sliding = self.sliding
        squared = np.sum(sliding**2, axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            passing = {name: np.sum((v - self.point) * sliding, axis=1) for name, v in self.bodies.items()}
            return {name: (1.0 if name == "pinion" else -1.0) * squared / p for name, p in passing.items()}

    def plain(self):
        """The points' part of the ``meshwright.tca/1`` document; None for what is not a finite number."""
        sliding, entraining, specific = self.sliding, self.entraining, self.specific_sliding
        return [
            {
                "sliding_velocity_mm_per_rad": _row(sliding[k]),
                "entraining_velocity_mm_per_rad": _row(entraining[k]),
                "specific_sliding": {name: _row(values[k]) for name, values in specific.items()},
            }
            for k in range(len(sliding))
        ]


def velocities(drive, result):
    """:class:`Velocities` of a :class:`~meshwright.contact.results.TCA` of the drive."""
    mirror, solutions = drive.design.mirror, result.solutions
    pinion_angles = mirror.sign * result.angles
    wheel_angles = drive.ratio * pinion_angles + solutions[:, drive.design.description["error"]]
    axes = placed(drive, pinion_angles, wheel_angles).axes
    points = mirror.flip * result.points
    speeds = {"pinion": np.ones(len(points)), "wheel": result.instantaneous_ratio}
    # a mirrored pinion's positive sense is the negative one of the drive that is solved
    turned = mirror.sign * mirror.flip
    bodies = {
        name: turned * speeds[name][:, None] * np.cross(direction, points - origin)
        for name, (direction, origin) in axes.items()
    }
    return Velocities(bodies, turned * _of_point(drive, pinion_angles, solutions, np.isfinite(points).all(axis=1)))


def _of_point(drive, angles, solutions, rows):
    """dr/dφ1 (N, 3) of the right-hand drive's contact points in these rows (N,) of bool, NaN elsewhere."""
    m, p = drive.design.model, drive.design.parameters
    moving, s, unchanged, dx = np.full((len(angles), 3), np.nan), np.empty(m.ns), np.zeros(m.np), np.empty(m.nx)
    m.setup(pointer(p), pointer(s))
    dr = np.empty(3)
    for i in np.flatnonzero(rows):
        m.set_phi(pointer(s), angles[i])
        x = np.ascontiguousarray(solutions[i])
        arguments = map(pointer, (s, x, dx, dr))
        if library().mw_contact_tangent(m, pointer(p), pointer(unchanged), angles[i], 1.0, *arguments) >= 0:
            moving[i] = dr
    return moving


def _row(values):
    return values.tolist() if np.isfinite(values).all() else None
