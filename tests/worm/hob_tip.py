"""The tip of a ZN hob written out by hand: balls between its straight edge and its tip cylinder, swept over a wheel."""

import numpy as np
from scipy.optimize import brentq, least_squares


class Balls:
    """The ball of one flank, at ``t`` of its edge, and the places of its centre in the frame of the wheel."""

    def __init__(self, drive, rounding):
        value, s = drive.design.value, drive.design.flank
        self.radius, self.lead = value("hob_pitch_radius_mm"), value("hob_lead_angle_deg")
        alpha = value("hob_pressure_angle_deg")
        self.screw = self.radius * np.tan(self.lead)
        width = drive.design.sizes["groove_width_mm"]
        apex = np.sqrt(self.radius**2 - (0.5 * width * np.sin(self.lead)) ** 2) - 0.5 * width / np.tan(alpha)
        along = np.array([np.cos(alpha), -s * np.sin(alpha) * np.sin(self.lead), s * np.sin(alpha) * np.cos(self.lead)])
        tip = self.radius + value("hob_tip_addendum_mm", "blank")

        def centre(t):
            point = np.array([apex, 0.0, 0.0]) + t * along
            normal = -s * np.cross(along, [-point[1], point[0], self.screw])
            return point - rounding * normal / np.linalg.norm(normal)

        t = brentq(lambda t: np.hypot(*centre(t)[:2]) - tip + rounding, 0.0, 3.0 * tip)
        self.centre, self.t = centre(t), t
        self.ratio = value("hob_threads") / value("wheel_teeth")
        self.distance, self.angle = value("cutting_center_distance_mm"), value("cutting_shaft_angle_deg")

    def at(self, rack, turn):
        """Centre with the hob's screw angle ``turn``, the hob having turned so far that both add up to ``rack``."""
        x, y, z = self.centre[0], self.centre[1], self.centre[2] + self.screw * turn
        c, s = np.cos(rack), np.sin(rack)
        x, y = c * x - s * y - self.distance, s * x + c * y
        y, z = np.cos(self.angle) * y - np.sin(self.angle) * z, np.sin(self.angle) * y + np.cos(self.angle) * z
        c, s = np.cos(self.ratio * (rack - turn)), np.sin(self.ratio * (rack - turn))
        return np.array([c * x - s * y, s * x + c * y, z])

    def nearest(self, point):
        """Distance of a point from the nearest place of a ball's centre, from the best of a dense grid."""
        grid = np.stack(np.meshgrid(np.linspace(-1.2, 1.2, 121), np.linspace(-20.0, 20.0, 801), indexing="ij"))
        away = np.linalg.norm(self.at(*grid) - point[:, None, None], axis=0)
        start = grid[:, *np.unravel_index(np.argmin(away), away.shape)]
        found = least_squares(lambda q: self.at(*q) - point, start, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        return np.linalg.norm(found.fun)
