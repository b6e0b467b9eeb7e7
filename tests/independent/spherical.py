"""The spherical report's formulas written out by hand in mpmath: an independent formulation at any precision.

One gear: rack (2.1), (2.3), (2.5), meshing (2.13) solved for the turn in generation, gear surface and normal. One
pair: assembly with misalignments, contact as common point and opposed normals.
"""

from dataclasses import dataclass

from mpmath import asin, cos, cot, findroot, mp, mpf, pi, sin, sqrt, tan

from tests.independent.vectors import rotate

SENSE = {"convex": 1, "concave": -1}


@dataclass(frozen=True)
class Gear:
    """m, T, α (rad), form, sphere radius (None: spur), flank sign; a = m and b = π m/4 unless given."""

    module: object
    teeth: int
    alpha: object
    form: str
    sphere_radius: object
    s: int
    edge_offset: object = None
    half_space: object = None

    @property
    def r(self):
        return mpf(self.module) * self.teeth / 2

    @property
    def a(self):
        return mpf(self.module) if self.edge_offset is None else self.edge_offset

    @property
    def b(self):
        return pi * mpf(self.module) / 4 if self.half_space is None else self.half_space

    @property
    def pitch_point(self):
        return self.a / cos(self.alpha)

    def rack(self, l, q):
        """Point and normal (out of the tooth) of the cutter, q = θ, or z for a spur gear."""
        u = l * cos(self.alpha) - self.a
        y = self.s * (self.b + self.a * tan(self.alpha) - l * sin(self.alpha))
        if self.form == "spur":
            return (u, y, q), (sin(self.alpha), self.s * cos(self.alpha), mpf(0)), mpf(1)
        sense = SENSE[self.form]
        rho = self.sphere_radius + sense * u
        point = u * cos(q) - 2 * sense * self.sphere_radius * sin(q / 2) ** 2, y, rho * sin(q)
        normal = sin(self.alpha) * cos(q), self.s * cos(self.alpha), sense * sin(self.alpha) * sin(q)
        return point, normal, cos(q)

    def flank(self, l, q):
        """Point and normal of the gear, body frame."""
        (x, y, z), normal, c = self.rack(l, q)
        alpha, r = self.alpha, self.r
        roll = self.s * (self.b + self.a * tan(alpha) - l * sin(alpha) - x / c * cot(alpha))
        phi = roll / r
        return rotate("z", phi, (x + r, y - roll, z)), rotate("z", phi, normal)

    def undercut(self, axial):
        """Edge position l of the singular point of a section, from the closed condition."""
        r, alpha, a = self.r, self.alpha, self.a
        if self.form == "spur":
            return (a - r * sin(alpha) ** 2) / cos(alpha)
        sense, radius = SENSE[self.form], self.sphere_radius

        def condition(l):
            rho = radius + sense * (l * cos(alpha) - a)
            theta = asin(axial / rho)
            x = self.rack(l, theta)[0][0]
            return r * sin(alpha) ** 2 + x * (1 + cos(alpha) ** 2 * radius / rho * tan(theta) ** 2 / cos(theta))

        guess = (a - r * sin(alpha) ** 2) / cos(alpha) + sense * axial**2 / (2 * radius * cos(alpha))
        return findroot(condition, guess)


@dataclass(frozen=True)
class Pair:
    """A pinion and a wheel with misalignments (mm, rad)."""

    pinion: Gear
    wheel: Gear
    dc: object = 0
    dh: object = 0
    dv: object = 0

    def pinion_in_mesh(self, phi1, l1, q1):
        """Point and normal of the pinion in the fixed frame."""
        p = self.pinion
        turn1 = phi1 - p.s * p.b / p.r
        return tuple(rotate("x", self.dh, rotate("y", self.dv, rotate("z", turn1, v))) for v in p.flank(l1, q1))

    def residual(self, phi1, l1, q1, l2, q2, error):
        p, w = self.pinion, self.wheel
        phi2 = mpf(p.teeth) / w.teeth * phi1 + error
        turn2 = pi - phi2 - w.s * w.b / w.r
        (r1, n1), (r2, n2) = self.pinion_in_mesh(phi1, l1, q1), w.flank(l2, q2)
        r2, n2 = rotate("z", turn2, r2), rotate("z", turn2, n2)
        centre = p.r + w.r + self.dc
        return [r1[0] - r2[0] - centre, r1[1] - r2[1], r1[2] - r2[2], n1[0] + n2[0], n1[2] + n2[2]]

    def solve(self, phi1):
        """(l1, q1, l2, q2, transmission error) at the pinion angle, from the aligned contact."""
        p, w = self.pinion, self.wheel
        reach = p.s * p.r * phi1 * sin(p.alpha)
        return self.refined(phi1, [p.pitch_point + reach, 0, w.pitch_point - reach, 0, 0])

    def refined(self, phi1, near):
        """The same, from values near it."""
        start = [mpf(x) for x in near]
        return list(findroot(lambda *x: self.residual(phi1, *x), start, tol=mpf(10) ** (-2 * mp.dps + 20)))


def involute(angle):
    """inv x = tan x − x."""
    return tan(angle) - angle


def spur_contact_ratio(module, pinion_teeth, wheel_teeth, alpha, addendum):
    """The textbook formula for a spur pair with these addenda."""
    r1, r2 = mpf(module) * pinion_teeth / 2, mpf(module) * wheel_teeth / 2
    path = sum(sqrt((r + addendum) ** 2 - (r * cos(alpha)) ** 2) for r in (r1, r2)) - (r1 + r2) * sin(alpha)
    return path / (pi * module * cos(alpha))
