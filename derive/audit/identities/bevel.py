"""Bevel and hypoid gears: blade, machine frames, meshing as a screw, conjugate settings, assembly."""

from derive.audit.claims import Document, scope, with_sign
from derive.audit.described import Described
from derive.audit.identities.conventions import identity, proper
from derive.audit.ledger import Chapter

DOCUMENT = Document(
    key="bevel",
    name="bevel and hypoid gears",
    file="derive/drives/bevel.py",
    sha256="",
    about="Machine frame: z along the cradle's axis to the blank, x to the tooth being cut. Body frame: z along the "
    "axis to the back. h is the hand of the member, s the side of the blade.",
    symbols={
        "u": ("u", "mm", "arc length along the blade from its tip"),
        "X": ("w", "mm", "place on the blade's line that its normal meets"),
        "t": ("t", "rad", "turn along the arc"),
        "theta": ("θ", "rad", "angle around the cutter's axis"),
        "phi": ("φc", "rad", "turn of the cradle"),
        "work": ("φw", "rad", "turn of the work, any function of φc"),
        "rate": ("φw′", "-", "its derivative"),
        "alpha": ("α", "rad", "blade angle"),
        "kappa": ("κb", "1/mm", "curvature of the blade"),
        "u0": ("u0", "mm", "where the arc touches its line"),
        "rp": ("rp", "mm", "point radius"),
        "q": ("q", "rad", "cradle angle"),
        "i": ("i", "rad", "tilt"),
        "j": ("j", "rad", "swivel"),
        "gamma": ("γm", "rad", "root angle"),
        "Sr": ("Sr", "mm", "radial setting"),
        "Em": ("Em", "mm", "blank offset"),
        "XB": ("XB", "mm", "sliding base"),
        "XD": ("XD", "mm", "centre to back"),
        "H": ("H", "mm/rad", "helical motion"),
        "R": ("R", "-", "ratio of roll"),
        "rho": ("ρf", "mm", "rounding of the blade's tip"),
        "lam": ("λ", "rad", "angle on the rounding"),
        "h": ("h", "-", "hand, +1 right"),
        "m": ("m", "-", "N1/N2"),
        "E": ("E", "mm", "offset"),
        "Sigma": ("Σ", "rad", "shaft angle"),
        "phi1": ("φ1", "rad", "angle of the pinion"),
        "s": ("s", "-", "+1 outside blade"),
        "a": ("a", "-", "rate of u of the place of contact, over φc"),
        "b": ("b", "-", "rate of its θ"),
    },
)

BLADE = scope(
    "bevel.blade",
    """
t0 = vec(s*sin(alpha), 0, -cos(alpha))
n0 = vec(-s*cos(alpha), 0, -sin(alpha))
arc = (u0 + sin(t)/kappa)*t0 - (2*sin(t/2)**2/kappa)*n0
n_arc = cos(t)*n0 + sin(t)*t0
secant = sqrt(1 + kappa**2*X**2)
swung = (u0 + X/secant)*t0 - (kappa*X**2/(secant*(secant + 1)))*n0
n_swung = n0 + kappa*X*t0
pole = (u0 + X)*t0
omega = vec(o1, o2, o3)
velocity = vec(v1, v2, v3) + cross(omega, pole)
f = dot(n_swung, velocity)
joint = rho*(1 - sin(alpha))/cos(alpha)
centre = joint*t0 + rho*n0
m_round = vec(-s*cos(alpha + lam), 0, -sin(alpha + lam))
rounding = centre - rho*m_round
at_rounding = vec(v1, v2, v3) + cross(omega, rounding)
at_centre = vec(v1, v2, v3) + cross(omega, centre)
turn_theta = mat([cos(theta), -h*sin(theta), 0], [h*sin(theta), cos(theta), 0], [0, 0, 1])
cone = turn_theta@(vec(rp, 0, 0) + u*t0)
n_cone = turn_theta@n0
radial = turn_theta@vec(1, 0, 0)
wider = vec(c1, c2, 0) - change*radial + turn_theta@(vec(rp + change, 0, 0) + u*t0)
""",
    signs=["h", "s"],
)

MACHINE = scope(
    "bevel",
    """
unit = mat([1, 0, 0], [0, 1, 0], [0, 0, 1])
turn_theta = mat([cos(theta), -h*sin(theta), 0], [h*sin(theta), cos(theta), 0], [0, 0, 1])
turn_swivel = mat([cos(j), -h*sin(j), 0], [h*sin(j), cos(j), 0], [0, 0, 1])
turn_cradle = mat([cos(q + phi), -h*sin(q + phi), 0], [h*sin(q + phi), cos(q + phi), 0], [0, 0, 1])
turn_work = mat([cos(work), h*sin(work), 0], [-h*sin(work), cos(work), 0], [0, 0, 1])
lay = mat([sin(gamma), 0, -cos(gamma)], [0, 1, 0], [cos(gamma), 0, sin(gamma)])
edge = vec(rp + ex, 0, ez)
normal = vec(nx, 0, nz)
r_gen = turn_cradle@(vec(Sr, 0, 0) + turn_swivel@(Ry(i)@(turn_theta@edge)))
n_gen = turn_cradle@(turn_swivel@(Ry(i)@(turn_theta@normal)))
base = vec(0, h*Em, XB + H*phi)
r_body = turn_work@(lay@(r_gen - base) - vec(0, 0, XD))
n_body = turn_work@(lay@n_gen)
axis = vec(cos(gamma), 0, sin(gamma))
k = vec(0, 0, 1)
origin = base + XD*axis
screw = dot(n_gen, h*cross(k, r_gen) - h*rate*cross(axis, r_gen - origin) - H*k)
f = dot(n_body, d(r_body, phi) + rate*d(r_body, work))
turn_sum = mat([cos(theta + j), -h*sin(theta + j), 0], [h*sin(theta + j), cos(theta + j), 0], [0, 0, 1])
theta_other = mat([cos(theta), h*sin(theta), 0], [-h*sin(theta), cos(theta), 0], [0, 0, 1])
swivel_other = mat([cos(j), h*sin(j), 0], [-h*sin(j), cos(j), 0], [0, 0, 1])
cradle_other = mat([cos(q + phi), h*sin(q + phi), 0], [-h*sin(q + phi), cos(q + phi), 0], [0, 0, 1])
work_other = mat([cos(work), -h*sin(work), 0], [h*sin(work), cos(work), 0], [0, 0, 1])
gen_other = cradle_other@(vec(Sr, 0, 0) + swivel_other@(Ry(i)@(theta_other@edge)))
r_other = work_other@(lay@(gen_other - vec(0, -h*Em, XB + H*phi)) - vec(0, 0, XD))
plain = lay@(turn_cradle@head - vec(0, h*Em, XB)) - vec(0, 0, XD)
r_rolled = mat([cos(w), h*sin(w), 0], [-h*sin(w), cos(w), 0], [0, 0, 1])@plain
r_shifted = mat([cos(w - e), h*sin(w - e), 0], [-h*sin(w - e), cos(w - e), 0], [0, 0, 1])@plain
turn_shift = mat([cos(e), -h*sin(e), 0], [h*sin(e), cos(e), 0], [0, 0, 1])
head = vec(p1, p2, p3)
gen_larger = turn_cradle@(vec(c*Sr, 0, 0) + turn_swivel@(Ry(i)@(turn_theta@(c*edge))))
base_larger = vec(0, h*c*Em, c*XB + c*H*phi)
r_larger = turn_work@(lay@(gen_larger - base_larger) - vec(0, 0, c*XD))
f_larger = dot(n_body, d(r_larger, phi) + rate*d(r_larger, work))
r_any = vec(x, y, z)
n_any = vec(n1, n2, n3)
""",
    jets={"ex": ("u",), "ez": ("u",), "nx": ("u",), "nz": ("u",)},
    signs=["h", "s"],
)

#: Any generating surface at one place and instant: its tangents A and B, its second derivatives, and its velocity where
#: f = 0: −a A − b B, for the rates a and b at which the place of contact runs over the tool.
REGULAR = scope(
    "bevel.regular",
    """
A = vec(a1, a2, a3)
B = vec(b1, b2, b3)
AA = vec(p1, p2, p3)
AB = vec(q1, q2, q3)
BB = vec(r1, r2, r3)
AV = vec(u1, u2, u3)
BV = vec(v1, v2, v3)
VV = vec(w1, w2, w3)
V = -a*A - b*B
N = cross(A, B)
f_u = dot(cross(AA, B) + cross(A, AB), V) + dot(N, AV)
f_v = dot(cross(AB, B) + cross(A, BB), V) + dot(N, BV)
f_t = dot(cross(AV, B) + cross(A, BV), V) + dot(N, VV)
g = a*f_u + b*f_v + f_t
twice = a**2*AA + 2*a*b*AB + b**2*BB + 2*a*AV + 2*b*BV + VV
""",
)

PAIR = scope(
    "bevel.pair",
    """
half = mat([-1, 0, 0], [0, -1, 0], [0, 0, 1])
flip = mat([1, 0, 0], [0, -1, 0], [0, 0, -1])
k = vec(0, 0, 1)
axis_of_work = vec(sin(Sigma), 0, -cos(Sigma))
hypoid = vec(0, E, 0) + Ry(Sigma)@(half@(Rz(-phi1)@r1 + vec(0, 0, dP)))
bevel = Ry(Sigma)@(half@(Rz(-phi1)@r1 + vec(0, 0, dP)))
r1 = vec(x, y, z)
""",
)



def _machine(member: str) -> dict:
    """A tool's point in the body of what it cuts, as the drive's page says; the work's turn, a polynomial of the
    cradle's, is one angle.
    """
    rolled = {f"c_{k}_{member}": "0" for k in range(2, 7)}
    letters = rolled | {
        f"R_{member}": f"work/phi_cradle_{member}", f"phi_cradle_{member}": "phi", f"theta_{member}": "theta",
        f"gamma_m_{member}": "gamma", f"E_m_{member}": "Em", f"X_B_{member}": "XB", f"X_D_{member}": "XD",
        f"H_{member}": "H", f"q_{member}": "q", f"S_r_{member}": "Sr", f"swivel_{member}": "j", f"tilt_{member}": "i",
    }  # fmt: skip
    drive, place = Described("bevel_generated", letters), "wheel" if member == "gear" else member
    return {
        "on_head": ("vec", ("+", "rp", ("jet", "ex", 0)), 0, ("jet", "ez", 0)),
        "normal_on_head": ("vec", ("jet", "nx", 0), 0, ("jet", "nz", 0)),
        "cut": drive.carried(drive.generation(place), drive.carried(drive.sweep(place), "on_head")),
        "cut_normal": drive.turned(drive.generation(place), drive.turned(drive.sweep(place), "normal_on_head")),
    }


GEAR = with_sign(MACHINE, "bevel.gear", "h", 1, _machine("gear"))
PINION = with_sign(MACHINE, "bevel.pinion", "h", -1, _machine("pinion"))

CLAIMS = (
    *(
        identity(
            f"machine-{member}",
            "description",
            f"The machine that cuts the {member}, of hand h = {hand}, is the motion of the drive's description, "
            f"whatever edge stands on the head.",
            ["r_body = cut", "n_body = cut_normal"],
            context,
        )
        for member, hand, context in (("gear", "+1", GEAR), ("pinion", "-1", PINION))
    ),
    identity(
        "meshing",
        "equation of meshing",
        "Machine and blank move against one another in a screw about cradle and work axis, for any roll: f is its "
        "moment about the cutter's normal.",
        "f = screw",
        MACHINE,
    ),
    identity(
        "regular",
        "regular part",
        "g = f_u a + f_θ b + f_φ is the second derivative, along the normal, of the tool's place over a fixed point of "
        "the blank: there r_u a + r_θ b = −r_φ, and whatever the second derivatives of the rates add lies in the "
        "tangent plane. Positive where the tool cuts deepest at this instant.",
        [
            "dot(N, V) = 0",
            "g = dot(N, twice)",
            "dot(N, twice + k1*A + k2*B) = dot(N, twice)",
        ],
        REGULAR,
    ),
    identity(
        "edge-normal",
        "blade",
        "The arc's normal has unit length and is normal to the arc.",
        ["dot(n_arc, n_arc) = 1", "dot(n_arc, d(arc, t)) = 0"],
        BLADE,
        conditions=["κb ≠ 0"],
    ),
    identity(
        "swung-edge",
        "blade",
        "Measured by where its normal meets the line, the arc has a derivative along t0 - κb w n0, and no singularity "
        "at κb = 0.",
        ["secant**3*d(swung, X) = t0 - kappa*X*n0", "dot(n_swung, t0 - kappa*X*n0) = 0"],
        BLADE,
        conditions=["1 + √(1 + κb²w²) ≠ 0"],
    ),
    identity(
        "pole",
        "blade",
        "The normal of the arc meets its line at the distance w from the point of contact.",
        "cross(pole - swung, n_swung) = vec(0, 0, 0)",
        BLADE,
    ),
    identity(
        "linear",
        "explicit flank",
        "In any motion the equation of meshing is linear in w, for a straight blade and for an arc.",
        "d(d(f, X), X) = 0",
        BLADE,
    ),
    identity(
        "fillet-join",
        "fillet",
        "The rounding joins the edge in place and normal, and touches the tip plane.",
        [
            "centre.z = -rho",
            "joint*t0 + rho*n0 - rho*vec(-s*cos(alpha), 0, -sin(alpha)) = joint*t0",
            "dot(m_round, d(rounding, lam)) = 0",
        ],
        BLADE,
        conditions=["cos α ≠ 0"],
    ),
    identity(
        "cone-normal",
        "blade",
        "The turning straight blade sweeps a cone: its normal is a unit vector, normal to blade and circle, and the "
        "same along the whole blade.",
        [
            "dot(n_cone, n_cone) = 1",
            "dot(n_cone, d(cone, u)) = 0",
            "dot(n_cone, d(cone, theta)) = 0",
            "d(n_cone, u) = vec(0, 0, 0)",
        ],
        BLADE,
    ),
    identity(
        "stand-off",
        "blade",
        "The arc leaves its line along its own normal, from the pole on; the straight blade, κb = 0, not at all.",
        "secant*(secant + 1)*(swung - pole) = -kappa*X**2*n_swung",
        BLADE,
    ),
    identity(
        "rounding",
        "fillet",
        "Normals of the rounding pass through its centre: in any motion the equation of meshing is a cosine and a sine "
        "of their inclination α + λ, with the velocity of the centre.",
        "dot(m_round, at_rounding) = -s*at_centre.x*cos(alpha + lam) - at_centre.z*sin(alpha + lam)",
        BLADE,
    ),
    identity(
        "tangent-cones",
        "conjugate pairs",
        "A wider cone whose axis is moved back by the change of radius shares point and normal along one whole "
        "generatrix: crowning along the tooth.",
        "wider = vec(c1, c2, 0) + cone",
        BLADE,
    ),
    identity(
        "frames",
        "machine",
        "Every frame of the machine is orthogonal with determinant +1, for either hand.",
        [text for name in ("turn_theta", "turn_swivel", "turn_cradle", "turn_work", "lay") for text in proper(name)],
        MACHINE,
    ),
    identity(
        "hand",
        "machine",
        "The other hand is the mirror image y → -y at equal blade and cradle angles: only the senses of turns change.",
        [
            "r_body.x = r_other.x",
            "r_body.y = -r_other.y",
            "r_body.z = r_other.z",
        ],
        MACHINE,
    ),
    identity(
        "rotation-of-blade",
        "machine",
        "Without tilt, blade angle and swivel enter as their sum.",
        "turn_swivel@turn_theta = turn_sum",
        MACHINE,
    ),
    identity(
        "plain-roll",
        "machine",
        "With plain roll a change of the cradle angle only turns the member: the flank depends on q + φc.",
        "r_shifted = turn_shift@r_rolled",
        MACHINE,
    ),
    identity(
        "scale",
        "machine",
        "All lengths times c, helical motion among them: the flank times c at equal angles, f times c.",
        ["r_larger = c*r_body", "f_larger = c*f"],
        MACHINE,
    ),
    identity(
        "apex",
        "machine",
        "Centre to back and sliding base together shift the cutter along the machine plane.",
        "lay@(r_gen - base - vec(0, 0, l*tan(gamma))) - vec(0, 0, XD - l/cos(gamma))"
        " = lay@(r_gen + vec(l, 0, 0) - base) - vec(0, 0, XD)",
        MACHINE,
        conditions=["cos γm ≠ 0"],
    ),
    identity(
        "crown",
        "conjugate pairs",
        "A member with R = 1/sin δ, γm = δ rolls on the machine plane: its velocity is that of a turn about the pitch "
        "line, the same line for both members.",
        [
            "h*k - h*axis/sin(gamma) = -h*cos(gamma)/sin(gamma)*vec(1, 0, 0)",
            "dot(n_any, cross(h*k - h*axis/sin(gamma), r_any))"
            " = -h*cos(gamma)/sin(gamma)*dot(n_any, cross(vec(1, 0, 0), r_any))",
        ],
        MACHINE,
        conditions=["sin δ ≠ 0"],
    ),
    identity(
        "formate-cradle",
        "conjugate pairs",
        "Where the pinion's cradle is the gear itself, γm = Σ - 90°, Em = E, XD = 0 and R = N2/N1, the machine moves "
        "as the pair in mesh does: what it cuts is conjugate to the gear, for any offset.",
        "flip@(cross(axis_of_work, flip@r1 - vec(0, -E, 0))/m - cross(k, flip@r1))"
        " = (m*cross(k, r1) + cross(vec(sin(Sigma), 0, cos(Sigma)), r1 - vec(0, E, 0)))/m",
        PAIR,
    ),
    identity(
        "offset",
        "assembly",
        "The offset shifts the pinion along the common perpendicular and does nothing else: without it the hypoid pair "
        "is a bevel pair.",
        "hypoid - vec(0, E, 0) = bevel",
        PAIR,
    ),
    identity(
        "assembly-axis",
        "assembly",
        "The pinion's axis is (sin Σ, 0, cos Σ); it turns by φ1 about minus that axis.",
        [
            "Ry(Sigma)@(half@vec(0, 0, 1)) = vec(sin(Sigma), 0, cos(Sigma))",
            "d(Ry(Sigma)@(half@(Rz(-phi1)@r1)), phi1) = -cross(vec(sin(Sigma), 0, cos(Sigma)), "
            "Ry(Sigma)@(half@(Rz(-phi1)@r1)))",
        ],
        PAIR,
    ),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
