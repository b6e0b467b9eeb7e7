"""Every cylindrical worm drive written down a second time: profiles and normals typed by type, in mpmath arithmetic.

Nothing of the compiler is used. A flank is its profile P(t) and unit normal n(t) in screw motion; for the ground
forms the point on the grinding wheel comes from the wheel's own geometry (Chen and Tsay 2009
for ZK; Newton on the arc angle for ZC). The drive is the papers' larger system: six
unknowns (t_w, ψ_w, t_h, ψ_h, φ_h, φ2) with the hob's equation of meshing from angular velocities, at given φ1.
"""

from dataclasses import dataclass

import mpmath as mp

from tests.independent.vectors import cross, dot, rotate


def unit(a):
    length = mp.sqrt(dot(a, a))
    return [x / length for x in a]


@dataclass
class Helicoid:
    """A flank of form ``kind``; ``s`` = ±1 the groove flank, S its width, r_c and rho the wheel and arc radii."""

    kind: str
    s: int
    r: object
    lead: object
    alpha: object
    S: object
    r_c: object = None
    rho: object = None

    @property
    def p(self):
        return self.r * mp.tan(self.lead)

    def profile(self, t):
        """Profile point and unit normal out of the thread at parameter t."""
        return getattr(self, f"_{self.kind}")(t)

    def at(self, t, psi):
        """Point and normal of the flank."""
        point, normal = self.profile(t)
        x, y, z = rotate("z", psi, point)
        return [x, y, z + self.p * psi], rotate("z", psi, normal)

    def _axial(self, rho, z, slope):
        return [rho, mp.mpf(0), z], unit([self.s * slope * rho, self.s * self.p, -self.s * rho])

    def _ZA(self, rho):
        slope = self.s * mp.tan(self.alpha) / mp.cos(self.lead)
        return self._axial(rho, self.s * self.S / (2 * mp.cos(self.lead)) + slope * (rho - self.r), slope)

    def base_radius(self):
        return self.r / mp.sqrt(1 + (mp.tan(self.alpha) / mp.sin(self.lead)) ** 2)

    def _ZI(self, rho):
        r_b = self.base_radius()

        def angle(radius):
            return mp.acos(r_b / radius)

        def inv(a):
            return mp.tan(a) - a

        z = self.S / (2 * mp.cos(self.lead)) + self.p * (inv(angle(rho)) - inv(angle(self.r)))
        return self._axial(rho, self.s * z, self.s * self.p * mp.tan(angle(rho)) / rho)

    def _ZN(self, l):
        sa, ca = mp.sin(self.alpha), mp.cos(self.alpha)
        along = [ca, -self.s * sa * mp.sin(self.lead), self.s * sa * mp.cos(self.lead)]
        apex = mp.sqrt(self.r**2 - (self.S * mp.sin(self.lead) / 2) ** 2) - self.S / (2 * mp.tan(self.alpha))
        point = [apex + l * along[0], l * along[1], l * along[2]]
        return point, unit([-self.s * c for c in cross(along, [-point[1], point[0], self.p])])

    def _placed(self, a, b, c):
        """Components along i, the groove tangent and the wheel's axis, in the worm's frame."""
        return rotate("x", self.lead, [a, b, c])

    def _ground(self, radius, width, theta, xi):
        point = self._placed(self.r + self.r_c - radius * mp.cos(theta), radius * mp.sin(theta), self.s * width)
        normal = [mp.sin(xi) * mp.cos(theta), -mp.sin(xi) * mp.sin(theta), -self.s * mp.cos(xi)]
        return point, self._placed(*normal)

    def _ZK(self, theta):
        E, a, lead = self.r + self.r_c, self.alpha, self.lead
        b1 = self.r_c * mp.tan(a) + self.S / 2
        u = b1 * mp.sin(a) + mp.cos(a) * (E - self.p * mp.cot(lead)) / mp.cos(theta)
        u -= self.s * mp.sin(a) * mp.tan(theta) * (self.p + E * mp.cot(lead))
        return self._ground(u * mp.cos(a), b1 - u * mp.sin(a), theta, a)

    def _ZC(self, theta):
        def at(xi):
            radius = self.r_c + self.rho * (mp.sin(xi) - mp.sin(self.alpha))
            width = self.S / 2 + self.rho * (mp.cos(xi) - mp.cos(self.alpha))
            return self._ground(radius, width, theta, xi)

        def meshing(xi):
            point, normal = at(xi)
            return dot(normal, [-point[1], point[0], self.p])

        return at(mp.findroot(meshing, self.alpha))


def _hob_disc(design):
    """Data of the hob's grinding wheel where it has one of its own."""
    return {k.removeprefix("hob_"): mp.mpf(v) for k, v in design.items() if k.startswith(("hob_grind", "hob_profile_"))}


def _disc(ground):
    return ground.get("grinding_wheel_radius_mm"), ground.get("profile_arc_radius_mm")


@dataclass
class WormDrive:
    """Worm, hob and mounting; angles in rad, lengths in mm. Errors: dA, dh, dv, da."""

    worm: Helicoid
    hob: Helicoid
    threads: int
    hob_threads: int
    teeth: int
    A: object
    sigma: object
    A_gen: object
    sigma_gen: object
    dA: object = mp.mpf(0)
    dh: object = mp.mpf(0)
    dv: object = mp.mpf(0)
    da: object = mp.mpf(0)
    allowance: object = mp.mpf(0)

    def thread(self, t, psi):
        """Point and normal of the worm's flank, moved along the axis out of the thread by its allowance, measured
        across the thread, half for each flank.
        """
        point, normal = self.worm.at(t, psi)
        point[2] += mp.sign(normal[2]) * self.allowance / (2 * mp.cos(self.worm.lead))
        return point, normal

    @classmethod
    def of(cls, tables):
        """The drive of a design's tables, derived sizes worked out here; every input the exact double given."""
        d, degree = tables["design"], mp.pi / 180
        errors = {k: mp.mpf(x) for k, x in tables.get("misalignment", {}).items()}
        s = 1 if tables.get("flank", "right") == "right" else -1
        m_n = mp.mpf(d["normal_module_mm"])
        lead, alpha = (d[key] * degree for key in ("worm_lead_angle_deg", "pressure_angle_deg"))
        threads, teeth = d["worm_threads"], d["wheel_teeth"]
        sigma = d.get("shaft_angle_deg", 90) * degree
        r_1 = m_n * threads / (2 * mp.sin(lead))
        r_h = mp.mpf(d["hob_pitch_radius_mm"]) if "hob_pitch_radius_mm" in d else r_1
        lead_h = mp.asin(m_n * threads / (2 * r_h)) if r_h != r_1 else lead
        lead_h = d["hob_lead_angle_deg"] * degree if "hob_lead_angle_deg" in d else lead_h
        alpha_h = d["hob_pressure_angle_deg"] * degree if "hob_pressure_angle_deg" in d else alpha
        S = mp.pi * m_n / 2 - 2 * mp.mpf(d.get("pitch_line_shift_mm", 0)) * mp.tan(alpha)
        ground = {k: mp.mpf(d[k]) for k in ("grinding_wheel_radius_mm", "profile_arc_radius_mm") if k in d}
        kind = d["worm_profile"]
        A = mp.mpf(d.get("center_distance_mm", r_1 + m_n * teeth / (2 * mp.sin(sigma + lead))))
        return cls(
            Helicoid(kind, s, r_1, lead, alpha, S, *_disc(ground)),
            Helicoid(d.get("hob_profile", kind), s, r_h, lead_h, alpha_h, S, *_disc(ground | _hob_disc(d))),
            threads, threads, teeth, A, sigma,
            mp.mpf(d.get("cutting_center_distance_mm", A + r_h - r_1)),
            d["cutting_shaft_angle_deg"] * degree if "cutting_shaft_angle_deg" in d else sigma + lead - lead_h,
            errors.get("center_distance_mm", mp.mpf(0)),
            errors.get("horizontal_deg", mp.mpf(0)) * degree,
            errors.get("vertical_deg", mp.mpf(0)) * degree,
            errors.get("axial_mm", mp.mpf(0)),
            mp.mpf(d.get("worm_thickness_allowance_um", 0)) / 1000,
        )  # fmt: skip

    def meshing(self, t, psi, phi):
        """n·(v of hob − v of blank) in the fixed frame of cutting."""
        point, normal = (rotate("z", phi, a) for a in self.hob.at(t, psi))
        axis = [mp.mpf(0), mp.sin(self.sigma_gen), mp.cos(self.sigma_gen)]
        x, y, z = point
        ratio = mp.mpf(self.hob_threads) / self.teeth
        blank = [-ratio * c for c in cross(axis, [x - self.A_gen, y, z])]
        return dot(normal, [a - b for a, b in zip([-y, x, mp.mpf(0)], blank, strict=True)])

    def wheel(self, t, psi, phi):
        """Point and normal (out of the hob) of the hob's flank in the wheel's frame."""
        point, normal = (rotate("z", phi, a) for a in self.hob.at(t, psi))
        point[0] -= self.A_gen
        turn = mp.mpf(self.hob_threads) / self.teeth * phi
        return tuple(rotate("z", turn, rotate("x", self.sigma_gen, a)) for a in (point, normal))

    def residual(self, unknowns, phi_1):
        """Position (3), two components of the normals' cross product, meshing."""
        t_w, psi_w, t_h, psi_h, phi_h, phi_2 = unknowns
        worm, n_worm = (rotate("z", phi_1, a) for a in self.thread(t_w, psi_w))
        wheel, n_wheel = (rotate("z", -phi_2, a) for a in self.wheel(t_h, psi_h, phi_h))
        wheel[2] += self.da
        wheel, n_wheel = (rotate("x", -(self.sigma + self.dh), rotate("y", self.dv, a)) for a in (wheel, n_wheel))
        wheel[0] += self.A + self.dA
        parallel = cross(n_worm, n_wheel)
        apart = [a - b for a, b in zip(worm, wheel, strict=True)]
        return [*apart, parallel[0], parallel[1], self.meshing(t_h, psi_h, phi_h)]
