"""The recess-action paper's own system, in its own symbols, over any arithmetic.

Chen and Tsay 2011: index 1 hob, 2 gear, 3 worm; six equations (position, normal, meshing) in the six unknowns
(l1, θ1, φ1, l3, θ3, φ2′) at given φ3′. ``m`` is the arithmetic (math or mpmath). Angles γ are the supplements of the
shaft angles; errors Δγh, Δγv have the signs of the paper.
"""

from dataclasses import dataclass

from tests.independent.vectors import cross, dot, rotate


@dataclass
class Helicoid:
    """Straight edge in the normal plane of the groove: eqs. (1)–(6) of the paper with the flank sign s."""

    r: object
    lam: object
    alpha: object
    b_x: object
    s: int
    m: object

    def __post_init__(self):
        m = self.m
        self.p = self.r * m.tan(self.lam)
        self.r_t = m.sqrt(self.r**2 - (self.b_x * m.sin(self.lam) / 2) ** 2) - self.b_x / (2 * m.tan(self.alpha))

    def point(self, l, theta):
        m, sa = self.m, self.m.sin(self.alpha)
        edge = [self.r_t + l * m.cos(self.alpha), -self.s * l * sa * m.sin(self.lam), self.s * l * sa * m.cos(self.lam)]
        x, y, z = rotate("z", -theta, edge, m)
        return [x, y, z - self.p * theta]

    def normal(self, l, theta):
        """R_l × R_θ, unit."""
        m, sa = self.m, self.m.sin(self.alpha)
        along = rotate(
            "z", -theta, [m.cos(self.alpha), -self.s * sa * m.sin(self.lam), self.s * sa * m.cos(self.lam)], m
        )
        x, y, _ = self.point(l, theta)
        normal = cross(along, [y, -x, -self.p])
        length = m.sqrt(dot(normal, normal))
        return [c / length for c in normal]


class Paper:
    """The paper's tooth contact analysis. ``q`` are the design numbers by the paper's names, in rad and mm."""

    def __init__(self, q, m):
        self.q, self.m = q, m
        b_x = m.pi * q["m_n"] / 2 - 2 * q["dx"] * m.tan(q["alpha"])
        p3 = q["m_n"] * q["T1"] / (2 * m.cos(q["lam3"]))
        r3 = p3 / m.tan(q["lam3"])
        sigma3 = q["sigma"]
        r2 = q["m_n"] * q["T2"] / (2 * m.sin(sigma3 + q["lam3"]))
        lam1 = m.asin(q["m_n"] * q["T1"] / (2 * q["r1"]))
        self.C3 = r3 + r2
        self.C1 = self.C3 + q["r1"] - r3
        self.gamma3 = m.pi - sigma3
        self.gamma1 = self.gamma3 + lam1 - q["lam3"]
        self.hob = Helicoid(q["r1"], lam1, q["alpha"], b_x, q["s"], m)
        self.worm = Helicoid(r3, q["lam3"], q["alpha"], b_x, q["s"], m)
        self.ratio = q["T1"] / q["T2"]

    def residual(self, unknowns, phi3):
        """Position (3), two components of n1 × n3, and the meshing equation of hob and gear."""
        m = self.m
        l1, theta1, phi1, l3, theta3, phi2 = unknowns
        point1, normal1 = self.hob.point(l1, theta1), self.hob.normal(l1, theta1)
        gear = self._to_gear(point1, phi1)
        gear_normal = self._turn_to_gear(normal1, phi1)
        r_gear = self._mesh(gear, phi2)
        n_gear = self._mesh_turn(gear_normal, phi2)
        r_worm = rotate("z", phi3, self.worm.point(l3, theta3), m)
        n_worm = rotate("z", phi3, self.worm.normal(l3, theta3), m)
        normals = cross(n_gear, n_worm)
        # n · (v of the hob point − v of the gear point), both axes in the cutting frame
        x, y, z = rotate("z", phi1, point1, m)
        n = rotate("z", phi1, normal1, m)
        wheel_axis = [0 * x, -m.sin(self.gamma1), m.cos(self.gamma1)]
        v_hob = [-y, x, 0 * x]
        v_gear = [self.ratio * c for c in cross(wheel_axis, [x - self.C1, y, z])]
        meshing = dot(n, [a - b for a, b in zip(v_hob, v_gear, strict=True)])
        return [a - b for a, b in zip(r_gear, r_worm, strict=True)] + [normals[1], normals[2], meshing]

    def _turn_to_gear(self, a, phi1):
        m = self.m
        return rotate("z", -self.ratio * phi1, rotate("x", -self.gamma1, rotate("z", phi1, a, m), m), m)

    def _to_gear(self, a, phi1):
        m = self.m
        x, y, z = rotate("z", phi1, a, m)
        return rotate("z", -self.ratio * phi1, rotate("x", -self.gamma1, [x - self.C1, y, z], m), m)

    def _mesh_turn(self, a, phi2):
        m, q = self.m, self.q
        a = rotate("y", q["dgv"], rotate("z", phi2, a, m), m)
        return rotate("x", self.gamma3 + q["dgh"], a, m)

    def _mesh(self, a, phi2):
        x, y, z = self._mesh_turn(a, phi2)
        return [x + self.C3 + self.q["dC"], y, z]
