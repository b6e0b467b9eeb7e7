"""Bevel and hypoid gears: blade, machine frames, meshing as a screw, conjugate settings, assembly."""

from derive.audit.claims import Document, scope
from derive.audit.identities.conventions import identity
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
        "s": ("s", "-", "+1 outside blade"),
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
""",
    signs=["s"],
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
""",
    jets={"ex": ("u",), "ez": ("u",), "nx": ("u",), "nz": ("u",)},
    signs=["h", "s"],
)

CLAIMS = (
    identity(
        "meshing",
        "equation of meshing",
        "Machine and blank move against one another in a screw about cradle and work axis, for any roll: f is its "
        "moment about the cutter's normal.",
        "f = screw",
        MACHINE,
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
        "The rounding joins the edge in place and normal.",
        ["joint*t0 + rho*n0 - rho*vec(-s*cos(alpha), 0, -sin(alpha)) = joint*t0", "dot(m_round, d(rounding, lam)) = 0"],
        BLADE,
        conditions=["cos α ≠ 0"],
    ),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
