"""Spiral bevel and hypoid gears in mpmath, written straight from the machine's kinematics: for tests only.

Matrices and the velocity of the machine as a screw, not the chain of the program: the equation of meshing is
f = n · [h z × r − h φ_w′ b × (r − O_b) − H z] at the machine, n the cutter's normal. A cutter that hobs turns about its
axis a_c through C while the blank turns by N_b/N of its angle: a point of its edge moves in the blank with
h a_c × (r − C) + h N_b/N b × (r − O_b), and n is square to that and to the edge. A design is a mapping of tables as in
a design file, angles in degrees; every length in mm.
"""

from mpmath import mp, mpf

from tests.independent.chords import chords
from tests.independent.vectors import dot

MEMBERS = ("pinion", "gear")
DEFAULTS = {
    "method": "generated", "blade_curvature_per_mm": 0, "blade_reference_mm": 0, "edge_radius_mm": 0,
    "blade_offset_angle_deg": 0, "tilt_deg": 0, "swivel_deg": 0, "blank_offset_mm": 0, "sliding_base_mm": 0,
    "center_to_back_mm": 0, "ratio_of_roll": 0, "roll_2c": 0, "roll_6d": 0, "roll_24e": 0, "roll_120f": 0,
    "roll_720g": 0, "helical_motion_mm_per_rad": 0, "pitch_apex_mm": 0, "face_apex_mm": 0,
}  # fmt: skip


def rotation(axis, angle):
    """Active right-handed rotation about a coordinate axis."""
    c, s = mp.cos(angle), mp.sin(angle)
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    m = mp.eye(3)
    m[i, i] = m[j, j] = c
    m[i, j], m[j, i] = -s, s
    return m


def vector(*components):
    return mp.matrix([mpf(c) for c in components])


def cross(a, b):
    return vector(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


Z = (0, 0, 1)


class Member:
    """One member of a left-hand drive; ``hand`` +1 for the gear, −1 for the pinion."""

    def __init__(self, design, member):
        keys = {**DEFAULTS, **design[member]}
        self.k = {key: value if isinstance(value, str) else mpf(value) for key, value in keys.items()}
        self.h = 1 if member == "gear" else -1
        convex_gear = 1 if design.get("flank", "convex") == "convex" else -1
        self.s = -convex_gear if member == "gear" else convex_gear
        self.generated = self.k["method"] == "generated"
        self.teeth = mpf(design["design"][f"{member}_teeth"])
        self.blade_groups = mpf(design["design"].get("blade_groups", 0))

    def deg(self, key):
        return mp.radians(self.k[key])

    def edge(self, u):
        """Point and normal out of the metal of the cutting edge in its plane (x, z)."""
        alpha, kappa, u0 = self.deg("blade_angle_deg"), self.k["blade_curvature_per_mm"], self.k["blade_reference_mm"]
        t0 = (self.s * mp.sin(alpha), -mp.cos(alpha))
        n0 = (-self.s * mp.cos(alpha), -mp.sin(alpha))
        if kappa == 0:
            return [u * c for c in t0], n0
        t = kappa * (u - u0)
        along, across = u0 + mp.sin(t) / kappa, -(1 - mp.cos(t)) / kappa
        point = [along * a + across * b for a, b in zip(t0, n0, strict=True)]
        return point, [mp.cos(t) * b + mp.sin(t) * a for a, b in zip(t0, n0, strict=True)]

    def cutter(self, u, theta):
        """Point of the edge, its normal in the plane of the blade and its direction, the cutter's centre and axis, all
        in the machine at rest, before the cradle turns.
        """
        (x, z), (n_x, n_z) = self.edge(u)
        turn = rotation("z", self.h * theta)
        tilt = rotation("z", self.h * self.deg("swivel_deg")) * rotation("y", self.deg("tilt_deg"))
        x_0 = self.s * self.k["blade_reference_mm"] * mp.sin(self.deg("blade_angle_deg"))
        plane = rotation("z", self.h * self.deg("blade_offset_angle_deg"))
        r = turn * (vector(self.k["point_radius_mm"] + x_0, 0, 0) + plane * vector(x - x_0, 0, z))
        n = turn * plane * vector(n_x, 0, n_z)
        along = turn * plane * vector(-n_z, 0, n_x)
        centre = vector(self.k["radial_setting_mm"], 0, 0)
        return centre + tilt * r, tilt * n, tilt * along, centre, tilt * vector(*Z)

    def roll(self, phi):
        """Turn of the work and its rate at a turn of the cradle."""
        terms = [(2, "roll_2c"), (6, "roll_6d"), (24, "roll_24e"), (120, "roll_120f"), (720, "roll_720g")]
        powers = [(n, self.k[key] / factorial) for n, (factorial, key) in enumerate(terms, 2)]
        value = phi - sum(c * phi**n for n, c in powers)
        rate = 1 - sum(n * c * phi ** (n - 1) for n, c in powers)
        return self.k["ratio_of_roll"] * value, self.k["ratio_of_roll"] * rate

    def surface(self, u, theta, phi=0):
        """Point and unit normal out of the metal in the body frame, and the equation of meshing."""
        cradle = rotation("z", self.h * (self.deg("cradle_angle_deg") + phi))
        r, n, along, centre, cutter_axis = (cradle * a for a in self.cutter(u, theta))
        gamma, helical = self.deg("root_angle_deg"), self.k["helical_motion_mm_per_rad"]
        base = vector(0, self.h * self.k["blank_offset_mm"], self.k["sliding_base_mm"] + helical * phi)
        work, rate = self.roll(phi) if self.generated else (mpf(0), mpf(0))
        index = self.blade_groups / self.teeth
        to_body = rotation("z", -self.h * (work - index * theta))
        lay = rotation("y", gamma - mp.pi / 2)
        point = to_body * (lay * (r - base) - vector(0, 0, self.k["center_to_back_mm"]))
        axis = vector(mp.cos(gamma), 0, mp.sin(gamma))
        origin = base + self.k["center_to_back_mm"] * axis
        if self.blade_groups:
            cutting = self.h * (cross(cutter_axis, r - centre) + index * cross(axis, r - origin))
            swept = cross(along, cutting)
            n = swept * (mp.sign(dot(swept, n)) / mp.norm(swept))
        velocity = self.h * cross(Z, r) - self.h * rate * cross(axis, r - origin) - helical * vector(*Z)
        return point, to_body * (lay * n), dot(n, velocity)


class Pair:
    """A left-hand drive of a design; a right-hand one is its mirror image."""

    def __init__(self, design):
        self.design = design
        self.pinion, self.gear = Member(design, "pinion"), Member(design, "gear")
        d, e = design["design"], design.get("misalignment", {})
        self.ratio = mpf(d["pinion_teeth"]) / mpf(d["gear_teeth"])
        self.shaft = mp.radians(mpf(d.get("shaft_angle_deg", 90)) + mpf(e.get("shaft_angle_deg", 0)))
        self.offset = mpf(d.get("offset_mm", 0)) + mpf(e.get("offset_mm", 0))
        self.pinion_axial, self.gear_axial = mpf(e.get("pinion_axial_mm", 0)), mpf(e.get("gear_axial_mm", 0))

    def place_gear(self, r, n, phi_2):
        turn = rotation("z", phi_2)
        return turn * r + vector(0, 0, self.gear_axial), turn * n

    def place_pinion(self, r, n, phi_1):
        turn, lay = rotation("z", -phi_1), rotation("y", self.shaft) * rotation("z", mp.pi)
        return vector(0, self.offset, 0) + lay * (turn * r + vector(0, 0, self.pinion_axial)), lay * (turn * n)

    def residual(self, x, phi_1):
        """Positions, opposite normals and equations of meshing at (u1, θ1, φ_c1, u2, θ2[, φ_c2], φ2)."""
        generated = self.gear.generated
        phi_c2, phi_2 = (x[5], x[6]) if generated else (mpf(0), x[5])
        r1, n1, f1 = self.pinion.surface(*x[:3])
        r2, n2, f2 = self.gear.surface(x[3], x[4], phi_c2)
        r1, n1 = self.place_pinion(r1, n1, phi_1)
        r2, n2 = self.place_gear(r2, n2, phi_2)
        first = cross(n1, Z if abs(n1[2]) < 0.9 else (1, 0, 0))
        second = cross(n1, first)
        conditions = [f1, f2] if generated else [f1]
        return [*(r1 - r2), dot(n2, first), dot(n2, second), *conditions]

    def solve(self, x, phi_1):
        """The unknowns near start values x."""
        return chords(lambda x: self.residual(x, mpf(phi_1)), x)

    def error(self, x, phi_1):
        """Raw transmission error, rad."""
        return x[-1] - self.ratio * mpf(phi_1)
