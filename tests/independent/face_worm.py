"""Face worm gear drive written down a second time, directly in matrices, in mpmath arithmetic of any precision.

Independent of the compiler: normals are typed by hand, the meshing equations come from angular velocities
(n·v = 0 with v = ω1 × r − ω2 × r − plunge), and every system is solved by mpmath's secant Newton on residuals alone.
Frames and signs: ``f`` has z along the gear axis and x along the worm axis; see the tests for what is checked.
"""

from dataclasses import dataclass, field

from mpmath import acos, atan2, cos, findroot, lu_solve, matrix, mp, mpf, norm, pi, sin, sqrt, tan

from tests.independent.vectors import dot

PERM = matrix([[0, 0, 1], [0, 1, 0], [-1, 0, 0]])
I = matrix([1, 0, 0])
K = matrix([0, 0, 1])


def rz(a):
    return matrix([[cos(a), -sin(a), 0], [sin(a), cos(a), 0], [0, 0, 1]])


def ry(a):
    return matrix([[cos(a), 0, sin(a)], [0, 1, 0], [-sin(a), 0, cos(a)]])


def cross(a, b):
    return matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def unit(a):
    return a / norm(a)


def _solve(equations, start):
    """Root of ``equations`` near ``start`` in the working precision; derivatives are differences."""
    root = findroot(equations, tuple(map(mpf, start)), tol=mpf(10) ** (8 - 2 * mp.dps), maxsteps=50)
    return list(root) if len(start) > 1 else [root]


@dataclass
class FaceWorm:
    """Lengths in mm, angles in rad; ``sigma`` is +1 on the convex side of the gear tooth."""

    sigma: int
    threads: int = 2
    teeth: int = 60
    module: object = mpf("1.334")
    offset: object = mpf(35)
    position: object = mpf("29.907")
    diameter: object = mpf("11.480")
    cone: object = mpf(0)
    inner: object = mpf("38.53")
    outer: object = mpf("52.5")
    profile: object = mpf(0)
    plunge: object = mpf(0)
    crown: object = mpf("0.01")
    rule: str = "mid"
    d_offset: object = mpf(0)
    d_axial: object = mpf(0)
    d_angle: object = mpf(0)
    tilt_change: object = mpf(0)
    cutter_radius: object = None
    blade_angle: object = None
    placed: dict = field(default_factory=dict)

    @property
    def ratio(self):
        return mpf(self.threads) / self.teeth

    @property
    def screw(self):
        return self.module * self.threads / 2

    # -- the hob and the surface it cuts ----------------------------------------------------------------------

    def hob(self, u, theta, phase):
        """Point and normal (r_u × r_θ) of the hob in its own frame."""
        radius = self.diameter / 2 + self.screw * theta * tan(self.cone) + u * cos(self.profile)
        c, s = cos(theta + phase), sin(theta + phase)
        r = matrix([radius * c, radius * s, self.screw * theta + self.sigma * u * sin(self.profile)])
        r_u = matrix([cos(self.profile) * c, cos(self.profile) * s, self.sigma * sin(self.profile)])
        grow = self.screw * tan(self.cone)
        r_theta = matrix([grow * c - radius * s, grow * s + radius * c, self.screw])
        return r, unit(cross(r_u, r_theta))

    def hob_meshing(self, u, theta, psi, phase):
        """n·v of hob against blank, in the fixed frame."""
        r, n = self.hob(u, theta, phase)
        r = matrix([self.position, self.offset, 0]) + PERM * (rz(psi) * r)
        n = PERM * (rz(psi) * n)
        velocity = cross(I, r - matrix([self.position, self.offset, 0])) - self.ratio * cross(K, r)
        return dot(n, velocity)

    def hob_cut(self, u, theta, psi, phase):
        """Point and normal of the hob-cut gear flank, gear frame."""
        r, n = self.hob(u, theta, phase)
        turn = rz(-psi * self.ratio)
        return turn * (matrix([self.position, self.offset, 0]) + PERM * (rz(psi) * r)), turn * (PERM * (rz(psi) * n))

    # -- placement of the head-cutter -------------------------------------------------------------------------

    def place(self, near=None):
        """Hob phase, A1, P, A2, head-cutter radius, axes, origin, tilt and blade angle, as a dictionary.

        ``near`` may give approximate values of phase and hob parameters, to save the search.
        """
        near = near or {}
        phase = self._phase(near.get("phase"))
        places = zip((self.inner, self.outer), (near.get("hob_A1"), near.get("hob_A2")), strict=True)
        on_circle = [self._at_radius(radius, phase, start) for radius, start in places]
        return self.install(phase, *on_circle, self._pitch(phase))

    def install(self, phase, inner, outer, pitch):
        """The head-cutter through the points of the hob-cut flank at these hob parameters."""
        a1, a2 = (self.hob_cut(0, *at, phase)[0] for at in (inner, outer))
        p, n = self.hob_cut(*pitch, phase)
        centre = self._centre(a1, p, a2)
        z_g = unit(cross(p - a1, a2 - p))
        z_g = z_g if z_g[2] > 0 else -z_g
        x_g = unit(p - centre)
        y_g = cross(z_g, x_g)
        radius, plain = norm(p - centre), self._blade(n, x_g, y_g, z_g)
        c, s = cos(self.tilt_change), sin(self.tilt_change)
        x_g, z_g = x_g * c - z_g * s, x_g * s + z_g * c
        tilted = self._blade(n, x_g, y_g, z_g)
        radius = radius * cos(tilted) / cos(plain) if self.cutter_radius is None else self.cutter_radius
        self.placed = {
            "phase": phase, "A1": a1, "P": p, "A2": a2, "hob_A1": inner, "hob_A2": outer, "hob_P": pitch,
            "radius": radius, "x": x_g, "y": y_g, "z": z_g, "O": p - x_g * radius, "tilt": acos(z_g[2]),
            "blade": tilted if self.blade_angle is None else self.blade_angle,
        }  # fmt: skip
        return self.placed

    @staticmethod
    def _blade(n, x_g, y_g, z_g):
        """Angle of the blade that lies in the section x, z and touches the flank of normal n."""
        edge = cross(n, y_g)
        edge = edge if dot(edge, z_g) > 0 else -edge
        return atan2(dot(edge, x_g), dot(edge, z_g))

    def placement(self, phase, inner, outer, pitch):
        """Residuals of the hob parameters: meshing and radius at A1 and A2, the rule at P, meshing at the phase."""
        residual = [self.hob_meshing(0, 0, 0, phase)]
        for at, radius in ((inner, self.inner), (outer, self.outer)):
            residual += [self.hob_meshing(0, *at, phase), norm(self.hob_cut(0, *at, phase)[0][:2]) - radius]
        return residual + (list(pitch) if self.rule == "mid" else self._on_pitch_cones(*pitch, phase))

    def _phase(self, near=None):
        """All roots over a turn by sign changes; the one nearest zero."""
        if near is not None:
            return _solve(lambda a: self.hob_meshing(0, 0, 0, a), [near])[0]
        steps = 360
        angles = [-pi + 2 * pi * k / steps for k in range(steps + 1)]
        values = [self.hob_meshing(0, 0, 0, a) for a in angles]
        starts = [a for a, v, w in zip(angles[1:], values[1:], values[:-1], strict=True) if v * w <= 0]
        roots = [_solve(lambda a: self.hob_meshing(0, 0, 0, a), [a])[0] for a in starts]
        return min(roots, key=abs)

    def _at_radius(self, radius, phase, near=None):
        """Hob parameters (θ, ψ) of the mid-profile point at this gear radius, in small steps from the section L."""
        middle = norm(self.hob_cut(0, 0, 0, phase)[0][:2])
        at, steps = ([0, 0], 24) if near is None else (near, 1)
        for k in range(1, steps + 1):
            wanted = middle + (radius - middle) * k / steps

            def equations(theta, psi, wanted=wanted):
                reached = norm(self.hob_cut(0, theta, psi, phase)[0][:2])
                return [self.hob_meshing(0, theta, psi, phase), reached - wanted]

            at = _solve(equations, at)
        return at

    def _pitch(self, phase):
        if self.rule == "mid":
            return [mpf(0)] * 3
        return _solve(lambda *at: self._on_pitch_cones(*at, phase), [0, 0, 0])

    def _on_pitch_cones(self, u, theta, psi, phase):
        t, r_p = tan(self.cone), self.diameter / 2
        eta_sine = -t * self.offset / (self.position + r_p * t)
        height = -r_p * sqrt(1 - eta_sine**2)
        radius = sqrt(self.position**2 + (self.offset + r_p * eta_sine) ** 2)
        r = self.hob_cut(u, theta, psi, phase)[0]
        return [self.hob_meshing(u, theta, psi, phase), norm(r[:2]) - radius, r[2] - height]

    @staticmethod
    def _centre(a, b, c):
        """Equal distances from a, b, c in their plane: three linear equations."""
        normal = cross(b - a, c - b)
        rows = [b - a, c - a, normal]
        right = [(dot(b, b) - dot(a, a)) / 2, (dot(c, c) - dot(a, a)) / 2, dot(normal, a)]
        return lu_solve(matrix([list(row) for row in rows]), matrix(right))

    # -- gear and worm ----------------------------------------------------------------------------------------

    def _in_gear(self, a):
        g = self.placed
        return g["x"] * a[0] + g["y"] * a[1] + g["z"] * a[2]

    def gear(self, u, theta):
        """Point and outward normal of the gear flank, gear frame."""
        g, a = self.placed, self.placed["blade"]
        radius = g["radius"] + u * sin(a)
        r = g["O"] + self._in_gear([radius * cos(theta), radius * sin(theta), u * cos(a)])
        n = self._in_gear([cos(a) * cos(theta), cos(a) * sin(theta), -sin(a)]) * self.sigma
        return r, n

    def worm_tool(self, u, theta):
        """Point and normal (out of the imagined gear) of the crowned head-cutter, cradle frame."""
        g, a = self.placed, self.placed["blade"]
        k = self.sigma * self.crown
        x, z = g["radius"] + u * sin(a) + k * u**2 * cos(a), u * cos(a) - k * u**2 * sin(a)
        x_u, z_u = sin(a) + 2 * k * u * cos(a), cos(a) - 2 * k * u * sin(a)
        r = g["O"] + self._in_gear([x * cos(theta), x * sin(theta), z])
        n = self._in_gear([z_u * cos(theta), z_u * sin(theta), -x_u]) * self.sigma
        return r, unit(n)

    def worm_centre(self, psi):
        return matrix([self.position, self.offset + self.plunge * psi**2, 0])

    def worm_meshing(self, u, theta, psi):
        """Kinematic meshing equation n·v12 = 0 in the fixed frame of the generating machine."""
        r, n = self.worm_tool(u, theta)
        r, n = rz(psi * self.ratio) * r, rz(psi * self.ratio) * n
        plunging = matrix([0, 2 * self.plunge * psi, 0])
        velocity = self.ratio * cross(K, r) - cross(I, r - self.worm_centre(psi)) - plunging
        return dot(n, velocity)

    def worm(self, u, theta, psi):
        """Point and normal of the worm flank, worm frame; the normal points out of the gear tooth."""
        r, n = self.worm_tool(u, theta)
        back = rz(-psi) * PERM.T
        return back * (rz(psi * self.ratio) * r - self.worm_centre(psi)), back * (rz(psi * self.ratio) * n)

    # -- mesh -------------------------------------------------------------------------------------------------

    def in_mesh(self, u, theta, psi, phi):
        """Worm point and normal in the fixed frame of the misaligned drive."""
        r, n = self.worm(u, theta, psi)
        tilt = ry(self.d_angle)
        r = matrix([0, self.offset + self.d_offset, 0]) + tilt * (
            matrix([self.position + self.d_axial, 0, 0]) + PERM * (rz(phi) * r)
        )
        return r, tilt * (PERM * (rz(phi) * n))

    def residual(self, u_w, t_w, psi, u_g, t_g, phi_2, phi):
        """Positions, equal normals (two products), meshing."""
        r1, n1 = self.in_mesh(u_w, t_w, psi, phi)
        r2, n2 = self.gear(u_g, t_g)
        r2, n2 = rz(phi_2) * r2, rz(phi_2) * n2
        across = cross(n2, rz(phi_2) * self.placed["z"])
        return [*(r1 - r2), dot(n1, across), dot(n1, cross(n2, across)), self.worm_meshing(u_w, t_w, psi)]

    def contact(self, phi, start):
        """(u_w, θ_w, ψ, u_g, θ_g, φ2) at worm angle φ."""
        return _solve(lambda *unknowns: self.residual(*unknowns, phi), start)
