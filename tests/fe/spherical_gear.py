"""Spherical gear flanks and fillets written out by hand: an independent reference for the mesh tests.

One rack section (straight edge with a tip arc) swept along a circular arc; see the spherical report, (2.1)-(2.13).
"""

from dataclasses import dataclass, replace

import numpy as np

from meshwright.fe.profile import SectionCurves
from meshwright.fe.tooth import ToothForm, ToothSide
from meshwright.flank.sections import Sections


@dataclass(frozen=True)
class SphericalGear:
    teeth: int
    sigma: int
    radius: float
    module: float = 4.0
    alpha: float = float(np.radians(20.0))
    face_width: float = 30.0
    bore: float = 12.5
    flank: int = 1
    tool_tip: float = 0.38
    dedendum: float = 1.25

    @property
    def r(self):
        return 0.5 * self.module * self.teeth

    @property
    def junction_x(self):
        """Rack section height at which the edge meets the tip arc."""
        return -self.dedendum * self.module + self.tool_tip * self.module * (1.0 - np.sin(self.alpha))

    def _section_profile(self, x, y, nx, ny, theta):
        s, sigma, radius = self.flank, self.sigma, self.radius
        sweep = (x * np.cos(theta) - 2 * sigma * radius * np.sin(theta / 2) ** 2) if sigma else x
        z = (radius + sigma * x) * np.sin(theta) if sigma else theta
        turn = np.cos(theta) if sigma else 1.0
        y, ny = s * y, s * ny
        r_phi = y - sweep * ny / (nx * turn)
        phi = r_phi / self.r
        c, d = np.cos(phi), np.sin(phi)
        a, b = sweep + self.r, y - r_phi
        points = np.stack([a * c - b * d, a * d + b * c, z + 0 * a], axis=-1)
        n = (nx * turn, ny, sigma * nx * np.sin(theta) if sigma else 0.0 * nx)
        normals = np.stack([n[0] * c - n[1] * d, n[0] * d + n[1] * c, n[2] + 0 * a], axis=-1)
        return points, normals

    def flank_surface(self, x, theta):
        """x is the rack section height X, -a <= X <= a."""
        one = np.ones_like(x * theta)
        y = np.pi * self.module / 4 - x * np.tan(self.alpha)
        return self._section_profile(x * one, y * one, np.sin(self.alpha) * one, np.cos(self.alpha) * one, theta * one)

    def fillet_surface(self, beta, theta):
        """beta is the angle of the tip arc's normal, from pi/2 at the root land to alpha at the junction."""
        rho = self.tool_tip * self.module
        x_junction = self.junction_x
        y_junction = np.pi * self.module / 4 - x_junction * np.tan(self.alpha)
        nx, ny = np.sin(beta), np.cos(beta)
        x = x_junction + rho * (np.sin(self.alpha) - nx)
        y = y_junction + rho * (np.cos(self.alpha) - ny)
        one = np.ones_like(beta * theta)
        return self._section_profile(x * one, y * one, nx * one, ny * one, theta * one)

    def tip_radius(self, z):
        r, a, big = self.r, self.module, self.radius
        if self.sigma == 0:
            return r + a + 0 * z
        if self.sigma > 0:
            return r - big + np.sqrt((big + a) ** 2 - z**2)
        return r + big - np.sqrt((big - a) ** 2 - z**2)

    def side(self):
        flank = SectionCurves(
            self.flank_surface, Sections(0.0), lambda z: np.full_like(z, self.junction_x), self._tip
        )
        fillet = SectionCurves(
            self.fillet_surface,
            Sections(0.0),
            lambda z: np.full_like(z, np.pi / 2),
            lambda z: np.full_like(z, self.alpha),
        )
        return ToothSide(fillet, flank)

    def _tip(self, z):
        curves = SectionCurves(self.flank_surface, Sections(0.0), None, None)

        def miss(x):
            p = curves.points(z, x[:, None])[:, 0]
            return np.hypot(p[:, 0], p[:, 1]) - self.tip_radius(z)

        x0, x1 = np.full_like(z, 0.8 * self.module), np.full_like(z, 0.9 * self.module)
        f0 = miss(x0)
        for _ in range(20):
            f1 = miss(x1)
            if np.all(np.abs(f1) < 1e-12):
                break
            x0, x1, f0 = x1, x1 - f1 * (x1 - x0) / (f1 - f0), f1
        return x1

    @property
    def next_tooth(self):
        turn = -2 * np.pi / self.teeth
        motion = np.eye(4)
        motion[:2, :2] = [[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]
        return motion

    def form(self):
        def bore(points):
            scale = self.bore / np.hypot(points[..., 0], points[..., 1])
            return points * np.stack([scale, scale, np.ones_like(scale)], axis=-1)

        half = 0.5 * self.face_width
        return ToothForm.repeated(
            replace(self, flank=1).side(), replace(self, flank=-1).side(), (-half, half), self.next_tooth, bore
        )
