"""An aligned spherical pair with its contact in closed form, for the tests of loaded contact."""

import numpy as np
from spherical_gear import SphericalGear

from meshwright.fe.material import Material
from meshwright.fe.pair import GearPair, Member, Touch

STEEL = Material(205000.0, 0.29)  # AISI 1045 of the spherical report, table 4.1


def _rz(angle):
    c, s = np.cos(angle), np.sin(angle)
    motion = np.eye(4)
    motion[:2, :2] = [[c, -s], [s, c]]
    return motion


def spherical_pair(pinion: SphericalGear, wheel: SphericalGear, material: Material = STEEL) -> GearPair:
    """Left flanks (s = +1).  Contact stays in the middle section and moves along the line of action."""
    half_space = np.pi * pinion.module / 4
    centre_distance = pinion.r + wheel.r
    alpha = pinion.alpha
    normal = np.array([np.sin(alpha), np.cos(alpha), 0.0])

    def pinion_pose(angle):
        return _rz(angle - half_space / pinion.r)

    def wheel_pose(angle):
        motion = _rz(np.pi - angle - half_space / wheel.r)
        motion[0, 3] = centre_distance
        return motion

    def touch(angle):
        """Distance along the line of action from the pitch point: r_b times the pinion angle."""
        along = pinion.r * np.cos(alpha) * angle
        radius_pinion = pinion.r * np.sin(alpha) + along
        radius_wheel = wheel.r * np.sin(alpha) - along
        point = np.array([pinion.r, 0.0, 0.0]) + along * normal
        face = [g.sigma * np.sin(alpha) / g.radius if g.sigma else 0.0 for g in (pinion, wheel)]
        if along * np.sin(alpha) > 0.98 * pinion.module or -along * np.sin(alpha) > 0.98 * pinion.module:
            return None
        bends = [
            f / (1.0 + g.sigma * h / g.radius)
            for f, g, h in zip(face, (pinion, wheel), (along * np.sin(alpha), -along * np.sin(alpha)), strict=True)
        ]
        return Touch(
            angle,
            angle * pinion.teeth / wheel.teeth,
            point,
            normal,
            sum(bends),
            1 / radius_pinion + 1 / radius_wheel,
            np.array([0.0, 0.0, 1.0]),
        )

    forms = pinion.form(), wheel.form()
    return GearPair(
        Member(lambda angle: forms[0], "left", pinion_pose, 2 * np.pi / pinion.teeth, 1, material),
        Member(lambda angle: forms[1], "left", wheel_pose, 2 * np.pi / wheel.teeth, -1, material),
        pinion.teeth / wheel.teeth,
        1,
        touch,
    )
