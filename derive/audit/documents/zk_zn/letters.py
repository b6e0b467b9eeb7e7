"""Letters of the ZK-ZN paper, and what stands for them in the description of a ZK-ZN drive."""

from derive.audit.claims import Document, scope
from derive.audit.described import HALF_TURN, HALF_TURN_Y, Described, written
from derive.prove.tree import Tree

DOCUMENT = Document(
    key="zk-zn",
    name="the ZK-ZN paper",
    file="003_1b02f86c27c1e1b1.txt",
    sha256="f2b12c5d073754e0d43de4fffd0e0d33532f32843590b728be1dbb7218b6c555",
    about="Conference paper at the end of the spherical report's file. Index 1 is the worm, h the hob, 2 the wheel.",
    symbols={
        "u1": ("u1", "mm", "distance along the grinding wheel's cone"),
        "theta": ("θ", "rad", "angle of the contact point on the grinding wheel"),
        "phi1": ("φ1", "rad", "rotation of the worm while being ground"),
        "alpha1": ("α1", "rad", "pressure angle of the grinding wheel"),
        "lam": ("λ", "rad", "lead angle"),
        "b1": ("b1", "mm", "half width of the grinding wheel at its centre"),
        "rc": ("rc", "mm", "pitch radius of the grinding wheel"),
        "r1": ("r1", "mm", "pitch radius of the worm"),
        "rh": ("rh", "mm", "pitch radius of the hob"),
        "p1": ("p1", "mm/rad", "screw parameter of the worm"),
        "Sn": ("Sn", "mm", "width of the blade"),
        "gamma": ("γ", "rad", "crossing angle"),
        "phih": ("φh", "rad", "rotation of the hob while cutting"),
        "phi2": ("φ2", "rad", "rotation of the wheel while being cut"),
        "A2": ("A2", "mm", "cutting centre distance"),
        "s": ("±", "-", "upper sign +1, lower sign -1"),
    },
)

DRIVE = "cylindrical_worm_zk_zn"
#: The worm: the paper measures u1 from the grinding wheel's axis and its half width there, the description from the
#: pitch circle.
WORM = Described(
    DRIVE,
    {
        "tan(lambda_worm)": "p1/r_worm", "dx": "(pi*m_n/4 - b1 + rc*tan(alpha))/tan(alpha)",
        "u_worm": "u1 - rc/cos(alpha)", "t_worm": "theta", "psi_worm": "phi1", "r_c_worm": "rc", "r_worm": "r1",
        "alpha": "alpha1", "lambda_worm": "lam",
    },
)  # fmt: skip
HOB = Described(
    DRIVE,
    {
        "tan(lambda_hob)": "p2/r_hob", "T_hob*phi_hob/T_2": "phi2", "t_hob": "l", "psi_hob": "-theta2",
        "r_t_hob": "rt", "alpha_hob": "alpha2", "lambda_hob": "lam", "Sigma_gen": "pi - gamma", "A_gen": "A2",
        "phi_hob": "phih", "r_hob": "rh",
    },
)  # fmt: skip
#: The hob, where the crossing angle is the shaft angle itself.
HOB_ACROSS = Described(DRIVE, {**HOB.letters, "Sigma_gen": "gamma"})
GROOVE = Described(
    DRIVE,
    {"dx": "(pi*m_n/2 - Sn)/(2*tan(alpha))", "alpha_hob": "alpha2", "alpha": "alpha2", "lambda_hob": "lam",
     "r_hob": "rh"},
)  # fmt: skip
#: Sizes of a design without a shift, from the axial module.
SIZE = Described(
    DRIVE,
    {
        "dx": "0", "m_n": "m_a*cos(lambda_worm)", "lambda_worm": "lam", "r_worm": "r1", "r_hob": "rh",
        "Sigma": "pi - gamma", "T_2": "T2", "alpha": "alpha1", "u_worm": "0",
    },
)  # fmt: skip
#: Sizes of the tables, by their own letters.
TABLE = Described(DRIVE, {"Sigma": "gamma", "lambda_worm": "lam"})


def size_in_table(value: Tree, crossing: int) -> str:
    """A size of Table 1 at a crossing angle in degrees."""
    numbers = {"m_n": "4", "T_1": "3", "T_2": "29", "lam": "radians(30)", "gamma": f"radians({crossing})"}
    return written(value, numbers)


DISC = WORM.sweep("pinion")
SCREW = WORM.generation("pinion")

GRINDING = scope(
    "zk-zn.grinding",
    """
A1 = rc + r1
Xc = u1*cos(alpha1)*cos(theta)
Yc = u1*cos(alpha1)*sin(theta)
Zc = s*(b1 - u1*sin(alpha1))
nxc = sin(alpha1)*cos(theta)
nyc = sin(alpha1)*sin(theta)
nzc = s*cos(alpha1)
n_c = vec(nxc, nyc, nzc)
U1 = u_solved + rc/cos(alpha1)
b_at_centre = s*half_width.z + rc*tan(alpha1)
""",
    signs=["s"],
    described=lambda: {
        "R1": WORM.carried(SCREW, WORM.carried(DISC, WORM.edge("pinion"))),
        "n1": WORM.turned(SCREW, WORM.turned(DISC, WORM.edge_normal("pinion"))),
        "u_solved": WORM.solved("pinion"),
        "wheel": WORM.carried(DISC[1:], WORM.edge("pinion")),
        "wheel_normal": WORM.turned(DISC[1:], WORM.edge_normal("pinion")),
        "half_width": SIZE.edge("pinion"),
    },
)

HOBBING = scope(
    "zk-zn.hobbing",
    """
a11 = sin(phi2)*cos(gamma)*sin(phih) + cos(phi2)*cos(phih)
a12 = sin(phi2)*cos(gamma)*cos(phih) - cos(phi2)*sin(phih)
a21 = cos(phi2)*cos(gamma)*sin(phih) - sin(phi2)*cos(phih)
a22 = cos(phi2)*cos(gamma)*cos(phih) + sin(phi2)*sin(phih)
R2 = turn@locus
L2h = turn@machine
b11 = sin(phi2)*cos(gamma)*sin(phih) - cos(phi2)*cos(phih)
b12 = sin(phi2)*cos(gamma)*cos(phih) + cos(phi2)*sin(phih)
b21 = cos(phi2)*cos(gamma)*sin(phih) + sin(phi2)*cos(phih)
b22 = cos(phi2)*cos(gamma)*cos(phih) - sin(phi2)*sin(phih)
R2_across = turn_y@locus_across
L2h_across = turn_y@machine_across
""",
    described=lambda: {
        "turn": HALF_TURN,
        "locus": HOB.carried(HOB.generation("wheel"), ("vec", "Xh", "Yh", "Zh")),
        "machine": HOB.matrix(HOB.generation("wheel")),
        "turn_y": HALF_TURN_Y,
        "locus_across": HOB_ACROSS.carried(HOB_ACROSS.generation("wheel"), ("vec", "Xh", "Yh", "Zh")),
        "machine_across": HOB_ACROSS.matrix(HOB_ACROSS.generation("wheel")),
    },
)

#: Hob and wheel at the beginning of the cut, the lost signs of a coefficient printed with the index 11 left open.
BEGINNING = scope(
    "zk-zn.beginning",
    """
phi2 = 0
phih = 0
printed_11 = s1*sin(phi2)*cos(gamma)*sin(phih) + s2*cos(phi2)*cos(phih)
""",
    signs=["s1", "s2"],
    extends=HOBBING,
)

HOB_SURFACE = scope(
    "zk-zn.hob",
    "",
    signs=["s"],
    described=lambda: {"R_h": HOB.carried(HOB.sweep("wheel"), HOB.edge("wheel"))},
)

BLADE = scope("zk-zn.blade", "", described=lambda: {"rt": GROOVE.name("r_t_hob")})

#: The hob's distance in the machine: A2 as the rules complete a design.
DISTANCE = scope(
    "zk-zn.distance",
    "r2 = A - r1",
    described=lambda: {
        "A": SIZE.rule("A"), "A2": SIZE.rule("A_gen"), "pitch_radius": SIZE.size("wheel_pitch_radius_mm"),
    },
)

MESH = Described(
    DRIVE,
    {"transmission_error": "phi2p - T_1/T_2*phi_worm", "Sigma": "pi - gamma", "dh": "-dgh", "dv": "0", "da": "0"},
)

#: The wheel's axis in the fixed frame.
ASSEMBLY = scope(
    "zk-zn.assembly",
    "axis = mounted@(turn@vec(0, 0, 1))",
    described=lambda: {"turn": HALF_TURN, "mounted": MESH.matrix(MESH.motion("wheel"))},
)

SPUR = scope(
    "zk-zn.spur", "gamma = pi/3\nlam = pi/6", described=lambda: {"helix": TABLE.size("wheel_helix_angle_deg")}
)

#: Any two normals; the equation of meshing of disc and worm; the velocity of a hob point seen from the wheel.
COUNT = scope(
    "zk-zn.count",
    """
na = vec(ax, ay, az)
nb = vec(bx, by, bz)
e = vec(ex, ey, ez)
f_disc = dot(n1, d(R1, phi1))
V_hob = T(machine)@d(locus, (phih, 1), (phi2, m2h))
""",
    extends=GRINDING,
    described=lambda: {name: HOBBING.definitions[name] for name in ("locus", "machine")},
)
