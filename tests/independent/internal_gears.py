"""An internal pair by hand in mpmath: the pinion of :mod:`tests.independent.cylindrical_gears` in a ring gear.

The space of the ring gear is the tooth of an external gear with the same base circle (ISO 21771:2007); its axis passes
through (−a, 0, 0) and both members turn about +z.
"""

from dataclasses import dataclass

from mpmath import cos, mpf, pi, sin, tan

from tests.independent.cylindrical_gears import Gear, involute, pair_of
from tests.independent.vectors import rotate


@dataclass(frozen=True)
class Pair:
    """Pinion, teeth and profile shift of the ring gear, distance of the axes and misalignments (mm, rad)."""

    pinion: Gear
    teeth: int
    shift: object
    distance: object
    da: object = 0
    dh: object = 0
    dv: object = 0
    axial: object = 0

    @property
    def r_b(self):
        return self.pinion.r_b * self.teeth / self.pinion.z

    def ring(self, rolling, z):
        """Point and unit normal out of the material, body frame."""
        p, s = self.pinion, self.pinion.s
        half = (pi / 2 - 2 * self.shift * tan(p.alpha)) / self.teeth + involute(p.alpha_t)
        turn = s * (half - rolling / self.r_b) + z * tan(p.beta) / (p.r * self.teeth / p.z)
        helix = p.beta_b
        normal = mpf(0), -s * cos(helix), s * sin(helix)
        return rotate("z", turn, (self.r_b, s * rolling, z)), rotate("z", turn, normal)

    def in_mesh(self, v, point):
        x, y, z = v[0], v[1], v[2] + (self.axial if point else 0)
        x, y, z = rotate("x", -self.dh, rotate("y", self.dv, (x, y, z)))
        return x - (self.distance + self.da if point else 0), y, z

    def placed(self, phi1, x):
        """Points and normals of both members in the fixed frame at the unknowns (l1, z1, ϱ2, z2, error)."""
        p, s = self.pinion, self.pinion.s
        phi2 = mpf(p.z) / self.teeth * phi1 + x[4]
        first = [rotate("z", phi1 - s * pi / (2 * p.z), v) for v in p.flank(x[0], x[1])]
        point, normal = (rotate("z", phi2 - s * pi / (2 * self.teeth), v) for v in self.ring(x[2], x[3]))
        return (*first, self.in_mesh(point, True), self.in_mesh(normal, False))

    def residual(self, phi1, x):
        """Three distances and the two smaller components of the sum of the normals."""
        r1, n1, r2, n2 = self.placed(phi1, x)
        kept = sorted(range(3), key=lambda k: abs(n1[k]))[:2]
        return [a - b for a, b in zip(r1, r2, strict=True)] + [n1[k] + n2[k] for k in kept]


def internal_pair(tables):
    """The :class:`Pair` of a design's tables; every number is taken exactly, the centre distance must be given."""
    design = tables["design"]
    outer = design | {"wheel_teeth": -design["wheel_teeth"], "shaft_angle_deg": 0.0}
    pair = pair_of(tables | {"design": outer})
    shift = mpf(design.get("wheel_profile_shift_coefficient", 0))
    shift += mpf(design.get("wheel_thickness_allowance_um", 0)) / 1000 / (2 * pair.pinion.m * tan(pair.pinion.alpha))
    return Pair(pair.pinion, -design["wheel_teeth"], shift, pair.distance, pair.da, pair.dh, pair.dv, pair.axial)
