"""Velocities at the contact point: of both bodies, of the point itself, sliding and entraining.

With axes d_i of growing angle through o_i: v_i = ω_i d_i × (r − o_i), ω1 = 1, ω2 = dφ2/dφ1, and ċ = dr/dφ1 of the
contact point by the implicit function theorem. Sliding v1 − v2; the flanks pass under the contact with u_i = v_i − ċ,
and entraining is (u1 + u2)/2. Both are tangential. Source: F. L. Litvin and A. Fuentes, Gear Geometry and Applied
Theory, 2nd ed. (2004), chapter 2.
"""

from dataclasses import dataclass

import numpy as np

from meshwright.base.library import library, pointer
from meshwright.base.plain import finite_or_nones
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
        specific = {name: finite_or_nones(values) for name, values in self.specific_sliding.items()}
        return [
            {
                "sliding_velocity_mm_per_rad": sliding,
                "entraining_velocity_mm_per_rad": entraining,
                "specific_sliding": dict(zip(specific, each, strict=True)),
            }
            for sliding, entraining, *each in zip(
                finite_or_nones(self.sliding), finite_or_nones(self.entraining), *specific.values(), strict=True
            )
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
    found, s, work = np.full((len(angles), 3), np.nan), np.empty(m.ns), np.empty(m.np + m.nx)
    phi, x = np.ascontiguousarray(angles[rows]), np.ascontiguousarray(solutions[rows])
    moving = np.empty((len(phi), 3))
    library().mw_contact_motion(m, pointer(p), pointer(phi), len(phi), pointer(x), *map(pointer, (s, work, moving)))
    found[rows] = moving
    return found
