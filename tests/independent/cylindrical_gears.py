"""Involute gears with modified flanks, written out by hand in mpmath: an independent formulation at any precision.

One gear: the rack's edge in the normal section, its trace, the rolling turn in closed form (ISO 21771 words). One
pair: assembly with misalignments, contact as common point and opposed normals. The unmodified pair: closed forms.
"""

from dataclasses import dataclass, field, replace

from mpmath import acos, asin, atan, atan2, cos, findroot, mpf, pi, sin, sqrt, tan

from tests.independent.vectors import rotate

AMOUNTS = (
    "profile_crowning", "profile_slope", "tip_relief", "root_relief", "lead_crowning", "lead_slope", "flank_twist"
)  # fmt: skip
NONE = {"profile_crowning": 0, "profile_slope": 0, "tip_relief": 0, "tip_relief_radius": None, "root_relief": 0,
        "root_relief_radius": None, "lead_crowning": 0, "lead_slope": 0, "flank_twist": 0}  # fmt: skip


def involute(angle):
    return tan(angle) - angle


@dataclass(frozen=True)
class Gear:
    """m, α, z, β (rad), x, b, flank sign, tip radius; modifications in mm by the names of :data:`NONE`."""

    m: object
    alpha: object
    z: int
    beta: object
    x: object
    b: object
    s: int
    tip: object = None
    modified: dict = field(default_factory=dict)
    exponent: int = 2
    dedendum: object = None
    rounding: object = None
    allowance: object = 0

    @property
    def cut(self):
        """Depth from the reference circle to which the rack's datum line is set: the allowance of the normal thickness
        is taken off both flanks of a tooth by a deeper cut, and does not move its tip.
        """
        return self.x * self.m + self.allowance / (2 * tan(self.alpha))

    @property
    def r(self):
        return self.m * self.z / (2 * cos(self.beta))

    @property
    def alpha_t(self):
        return atan(tan(self.alpha) / cos(self.beta))

    @property
    def r_b(self):
        return self.r * cos(self.alpha_t)

    @property
    def beta_b(self):
        return asin(sin(self.beta) * cos(self.alpha))

    @property
    def r_a(self):
        return self.r + (1 + self.x) * self.m if self.tip is None else self.tip

    @property
    def start(self):
        """Standard basic rack: dedendum 1.25, rounding 0.38 modules unless given."""
        dedendum = mpf("1.25") * self.m if self.dedendum is None else self.dedendum
        rounding = mpf("0.38") * self.m if self.rounding is None else self.rounding
        return (rounding * (1 - sin(self.alpha)) - dedendum) / cos(self.alpha)

    def edge_at(self, radius):
        rolled = sqrt(radius**2 - self.r_b**2) - self.r * sin(self.alpha_t)
        return (sin(self.alpha_t) * rolled - self.cut) / cos(self.alpha)

    def depth(self, l, z):
        """E, E_l, E_Z."""
        c = {**NONE, **self.modified}
        end, start, q = self.edge_at(self.r_a), self.start, self.exponent
        u, w = (2 * l - end - start) / (end - start), 2 * z / self.b
        u_l, w_z = 2 / (end - start), 2 / self.b
        value = c["profile_crowning"] * u**2 + c["profile_slope"] * u / 2 + c["flank_twist"] * u * w / 4
        along = (2 * c["profile_crowning"] * u + c["profile_slope"] / 2 + c["flank_twist"] * w / 4) * u_l
        for amount, radius, limit in (
            (c["tip_relief"], c["tip_relief_radius"], end), (c["root_relief"], c["root_relief_radius"], start)
        ):  # fmt: skip
            if amount:
                begin = (end + start) / 2 if radius is None else self.edge_at(radius)
                share = (l - begin) / (limit - begin)
                if share > 0:
                    value += amount * share**q
                    along += amount * q * share ** (q - 1) / (limit - begin)
        return value, along, c["flank_twist"] * u * w_z / 4

    def flank(self, l, z):
        """Point and unit normal, body frame."""
        s, alpha, beta, r, b = self.s, self.alpha, self.beta, self.r, self.b
        c = {**NONE, **self.modified}
        e, e_l, e_z = self.depth(l, z)
        plunge = c["lead_crowning"] * (2 * z / b) ** 2 / sin(alpha)
        feed = c["lead_slope"] * (2 * z / b) / (2 * cos(alpha) * cos(beta))
        d_plunge = 8 * c["lead_crowning"] * z / b**2 / sin(alpha)
        d_feed = c["lead_slope"] / (b * cos(alpha) * cos(beta))
        x = l * cos(alpha) - e * sin(alpha) + self.cut - plunge
        y = s * ((pi * self.m / 4 - l * sin(alpha) - e * cos(alpha)) / cos(beta) - feed) + z * tan(beta)
        x_l, y_l = cos(alpha) - e_l * sin(alpha), -s * (sin(alpha) + e_l * cos(alpha)) / cos(beta)
        x_z = -e_z * sin(alpha) - d_plunge
        y_z = -s * (e_z * cos(alpha) / cos(beta) + d_feed) + tan(beta)
        roll = y + x * x_l / y_l
        phi = roll / r
        n = -s * y_l, s * x_l, -s * (x_l * y_z - y_l * x_z)
        size = sqrt(sum(k**2 for k in n))
        turned = rotate("z", phi, (x + r, y - roll, z)), rotate("z", phi, n)
        return turned[0], tuple(k / size for k in turned[1])


@dataclass(frozen=True)
class Pair:
    """A pinion and a wheel with shaft angle, centre distance and misalignments (mm, rad)."""

    pinion: Gear
    wheel: Gear
    sigma: object
    distance: object
    da: object = 0
    dh: object = 0
    dv: object = 0
    axial: object = 0

    def wheel_in_mesh(self, v, point):
        """Rx(−(Σ + Δh)) Ry(Δv), and the place of the wheel for a point."""
        v = v[0], v[1], v[2] + (self.axial if point else 0)
        x, y, z = rotate("x", -(self.sigma + self.dh), rotate("y", self.dv, v))
        return x + (self.distance + self.da if point else 0), y, z

    def placed(self, phi1, x):
        """Points and normals of both members in the fixed frame at the unknowns (l1, z1, l2, z2, error)."""
        p, w = self.pinion, self.wheel
        phi2 = mpf(p.z) / w.z * phi1 + x[4]
        first = [rotate("z", phi1 - p.s * pi / (2 * p.z), v) for v in p.flank(x[0], x[1])]
        point, normal = (rotate("z", pi - phi2 - p.s * pi / (2 * w.z), v) for v in w.flank(x[2], x[3]))
        return (*first, self.wheel_in_mesh(point, True), self.wheel_in_mesh(normal, False))

    def residual(self, phi1, x):
        """Three distances and the two smaller components of the sum of the normals."""
        r1, n1, r2, n2 = self.placed(phi1, x)
        kept = sorted(range(3), key=lambda k: abs(n1[k]))[:2]
        return [a - b for a, b in zip(r1, r2, strict=True)] + [n1[k] + n2[k] for k in kept]

    # -- closed forms of the unmodified pair ---------------------------------------------------------------------------

    def working_angle(self):
        """α_w of parallel axes at this centre distance."""
        return acos((self.pinion.r_b + self.wheel.r_b) / (self.distance + self.da))

    def zero_backlash_angle(self):
        """α_w of parallel axes without backlash."""
        p, w = self.pinion, self.wheel
        wanted = involute(p.alpha_t) + 2 * (p.x + w.x) * tan(p.alpha) / (p.z + w.z)
        return findroot(lambda a: involute(a) - wanted, float(p.alpha_t) + 0.05)

    def zero_backlash_distance(self):
        """On parallel axes."""
        return (self.pinion.r_b + self.wheel.r_b) / cos(self.zero_backlash_angle())

    def rolled_distance(self, parallel):
        """Without backlash: what both involutes roll off at φ1 = φ2 = 0, along the common normal of s = +1.

        On ``parallel`` axes the normal is that of the zero-backlash working pressure angle, whatever the shaft angle.
        """
        p, w = self.pinion, self.wheel
        if parallel:
            y = cos(self.zero_backlash_angle()) * cos(p.beta_b)
        else:
            y = (sin(w.beta_b) + sin(p.beta_b) * cos(self.sigma)) / sin(self.sigma)
        x = sqrt(1 - y**2 - sin(p.beta_b) ** 2)
        turns = atan2(y, x), atan2(y * cos(self.sigma) + sin(p.beta_b) * sin(self.sigma), x)
        rolled = [mpf(g.z) / 2 * (pi / 2 - nu + involute(g.alpha_t)) for g, nu in zip((p, w), turns, strict=True)]
        return p.m * (cos(p.alpha) * sum(rolled) + (p.x + w.x) * sin(p.alpha)) / x

    def parallel_error(self):
        """TE of the parallel pair at another centre distance."""
        p, w = self.pinion, self.wheel
        widened = involute(self.working_angle()) - involute(self.zero_backlash_angle())
        return -p.s * (1 + mpf(p.z) / w.z) * widened

    def parallel_contact(self):
        """Path of contact g_α, contact ratio ε_α, overlap ratio ε_β."""
        p, w, angle = self.pinion, self.wheel, self.working_angle()
        length = sqrt(p.r_a**2 - p.r_b**2) + sqrt(w.r_a**2 - w.r_b**2) - (self.distance + self.da) * sin(angle)
        transverse = length * cos(p.beta) / (pi * p.m * cos(p.alpha_t))
        return length, transverse, p.b * abs(sin(p.beta)) / (pi * p.m)

    def wheel_axis(self):
        """k2, misaligned."""
        return self.wheel_in_mesh((mpf(0), mpf(0), mpf(1)), False)

    def common_normal(self):
        """Of crossed axes: n·k = −s sin β_b1, n·k2 = s sin β_b2, n_x > 0."""
        s = self.pinion.s
        first, second = -s * sin(self.pinion.beta_b), s * sin(self.wheel.beta_b)
        k2 = self.wheel_axis()
        # n = (x, y, first) with x k2x + y k2y = second − first k2z
        rest, length = second - first * k2[2], k2[0] ** 2 + k2[1] ** 2
        foot = rest * k2[0] / length, rest * k2[1] / length
        reach = sqrt((1 - first**2 - foot[0] ** 2 - foot[1] ** 2) / length)
        sides = [(foot[0] + t * k2[1], foot[1] - t * k2[0], first) for t in (reach, -reach)]
        return max(sides)

    def crossed_error(self):
        """TE of the unmodified crossed pair: constant, from the sum of what both involutes roll off."""
        p, w, s = self.pinion, self.wheel, self.pinion.s
        n, k2 = self.common_normal(), self.wheel_axis()
        a = self.sigma + self.dh
        y, z = n[1] * cos(a) - n[2] * sin(a), n[1] * sin(a) + n[2] * cos(a)
        in_wheel = n[0] * cos(self.dv) - z * sin(self.dv), y
        nu1, nu2 = atan2(n[1], n[0]), atan2(in_wheel[1], in_wheel[0])
        origin = self.distance + self.da + self.axial * k2[0], self.axial * k2[1], self.axial * k2[2]
        reach = sum(i * j for i, j in zip(n, origin, strict=True)) / (p.m * cos(p.alpha))
        rest = reach - (p.cut + w.cut) / p.m * tan(p.alpha)
        rest -= mpf(p.z) / 2 * (-s * nu1 + pi / 2 + involute(p.alpha_t))
        return -s * (2 * rest / w.z - pi / 2 - involute(w.alpha_t)) - nu2


def pair_of(tables, parallel=None):
    """The :class:`Pair` of a design's tables, in the units of the keys; every number is taken exactly.

    ``parallel`` tells by which formula the centre distance follows where it is not given: that of the shaft angle.
    """
    named = (tables.get(name, {}) for name in ("design", "misalignment", "blank"))
    keys, errors, blank = ({k: v for k, v in table.items() if v is not None} for table in named)
    degree, s = pi / 180, 1 if tables["flank"] == "left" else -1
    if "shaft_angle_deg" not in keys:
        helix = [mpf(keys[k]) for k in ("pinion_helix_angle_deg", "wheel_helix_angle_deg") if k in keys]
        keys["shaft_angle_deg"] = sum(helix) if len(helix) == 2 else 0
    keys.setdefault("pinion_helix_angle_deg", 0)
    keys.setdefault("wheel_helix_angle_deg", mpf(keys["shaft_angle_deg"]) - mpf(keys["pinion_helix_angle_deg"]))

    def length(key, source=keys):
        return None if key not in source else mpf(source[key])

    def gear(name):
        modified = {key: mpf(keys.get(f"{name}_{key}_um", 0)) / 1000 for key in AMOUNTS}
        for key in ("tip_relief_radius", "root_relief_radius"):
            modified[key] = length(f"{name}_{key}_mm")
        return Gear(
            mpf(keys["normal_module_mm"]),
            mpf(keys["pressure_angle_deg"]) * degree,
            keys[f"{name}_teeth"],
            mpf(keys[f"{name}_helix_angle_deg"]) * degree,
            mpf(keys.get(f"{name}_profile_shift_coefficient", 0)),
            mpf(keys.get(f"{name}_face_width_mm", keys["face_width_mm"])),
            s,
            length(f"{name}_tip_radius_mm", blank),
            modified,
            keys.get("relief_exponent", 2),
            length("basic_rack_dedendum_mm"),
            length("basic_rack_rounding_mm"),
            mpf(keys.get(f"{name}_thickness_allowance_um", 0)) / 1000,
        )

    sigma = mpf(keys["shaft_angle_deg"]) * degree
    moved = [mpf(errors.get(f"{key}_deg", 0)) * degree for key in ("horizontal", "vertical")]
    lengths = [mpf(errors.get(f"{key}_mm", 0)) for key in ("center_distance", "axial")]
    pair = Pair(gear("pinion"), gear("wheel"), sigma, length("center_distance_mm"), lengths[0], *moved, lengths[1])
    if pair.distance is None:
        pair = replace(pair, distance=pair.rolled_distance(sigma == 0 if parallel is None else parallel))
    return pair

