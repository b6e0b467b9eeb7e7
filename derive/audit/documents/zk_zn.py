"""The ZK-ZN paper: a ground ZK worm and a wheel cut by a ZN hob at crossing angles other than 90 degrees.

Nearly every operator and Greek letter of its equations is lost in the extraction. What can be judged is whether some
way to put the signs back is true, and which index or number cannot be right whatever the signs.
"""

from itertools import product

from derive.audit.claims import Claim, Document, Figure, FigureClaim, scope
from derive.audit.described import HALF_TURN, HALF_TURN_Y, Described, written
from derive.audit.ledger import Chapter
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


def _table(value: Tree, crossing: int) -> str:
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
    described={
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
    described={
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
    described={"R_h": HOB.carried(HOB.sweep("wheel"), HOB.edge("wheel"))},
)

BLADE = scope("zk-zn.blade", "", described={"rt": GROOVE.name("r_t_hob")})

#: The hob's distance in the machine: A2 as the rules complete a design.
DISTANCE = scope(
    "zk-zn.distance",
    "r2 = A - r1",
    described={"A": SIZE.rule("A"), "A2": SIZE.rule("A_gen"), "pitch_radius": SIZE.size("wheel_pitch_radius_mm")},
)

MESH = Described(
    DRIVE,
    {"transmission_error": "phi2p - T_1/T_2*phi_worm", "Sigma": "pi - gamma", "dh": "-dgh", "dv": "0", "da": "0"},
)

#: The wheel's axis in the fixed frame.
ASSEMBLY = scope(
    "zk-zn.assembly",
    "axis = mounted@(turn@vec(0, 0, 1))",
    described={"turn": HALF_TURN, "mounted": MESH.matrix(MESH.motion("wheel"))},
)

SPUR = scope(
    "zk-zn.spur", "gamma = pi/3\nlam = pi/6", described={"helix": TABLE.size("wheel_helix_angle_deg")}
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
    described={name: HOBBING.definitions[name] for name in ("locus", "machine")},
)

LOST = "the signs are lost in the extraction"

CLAIMS = (
    Claim(
        "eq-1",
        "Eq (1)",
        "R1 = [ Xc cos φ1 � Yc sin φ1 cos λ � Zc sin φ1 sin λ � A1 cos φ1 ; Xc sin φ1 � Yc cos φ1 cos λ � Zc cos φ1 "
        "sin λ � A1 sin φ1 ; Yc sin λ � Zc cos λ � p1φ1 ]",
        "With the signs of the second reading this is the grinding wheel, its axis inclined by λ at distance rc + "
        "r1, in screw motion.",
        GRINDING,
        {
            "every lost sign +": [
                "R1.x = Xc*cos(phi1) + Yc*sin(phi1)*cos(lam) + Zc*sin(phi1)*sin(lam) + A1*cos(phi1)",
                "R1.y = Xc*sin(phi1) + Yc*cos(phi1)*cos(lam) + Zc*cos(phi1)*sin(lam) + A1*sin(phi1)",
                "R1.z = Yc*sin(lam) + Zc*cos(lam) + p1*phi1",
            ],
            "- - + +; - + - +; + + +": [
                "R1.x = -Xc*cos(phi1) - Yc*sin(phi1)*cos(lam) + Zc*sin(phi1)*sin(lam) + A1*cos(phi1)",
                "R1.y = -Xc*sin(phi1) + Yc*cos(phi1)*cos(lam) - Zc*cos(phi1)*sin(lam) + A1*sin(phi1)",
                "R1.z = Yc*sin(lam) + Zc*cos(lam) + p1*phi1",
            ],
        },
        damage=LOST,
    ),
    Claim(
        "eq-2",
        "Eq (2)",
        "n1 = [ nxc cos φ1 � nyc sin φ1 cos λ � nzc sin φ1 sin λ ; ... ]; nxc = sin α1 cos θ, nyc = sin α1 sin θ, "
        "nzc = cos α1",
        "The normal turned like the surface; (sin α1 cos θ, sin α1 sin θ, ±cos α1) is the unit normal of the cone.",
        GRINDING,
        {
            "every lost sign +": ["n1.x = nxc*cos(phi1) + nyc*sin(phi1)*cos(lam) + nzc*sin(phi1)*sin(lam)"],
            "- - +; - + -; + +": [
                "n1.x = -nxc*cos(phi1) - nyc*sin(phi1)*cos(lam) + nzc*sin(phi1)*sin(lam)",
                "n1.y = -nxc*sin(phi1) + nyc*cos(phi1)*cos(lam) - nzc*cos(phi1)*sin(lam)",
                "n1.z = nyc*sin(lam) + nzc*cos(lam)",
                "dot(n_c, d(vec(Xc, Yc, Zc), u1)) = 0",
                "dot(n_c, d(vec(Xc, Yc, Zc), theta)) = 0",
                "dot(n_c, n_c) = 1",
            ],
        },
        damage=LOST,
    ),
    Claim(
        "where-disc",
        "where, at Eq (2)",
        "Xc = u1 cos α1 cos θ; Yc = u1 cos α1 sin θ; Zc = ±(b1 � u1 sin α1)",
        "The cone of the grinding wheel: with minus in the bracket it is the disc of the description, seen from the "
        "wheel's own centre.",
        GRINDING,
        {
            "every lost sign +": "wheel = vec(A1 - Xc, Yc, s*(b1 + u1*sin(alpha1)))",
            "- in the bracket": "wheel = vec(A1 - Xc, Yc, s*(b1 - u1*sin(alpha1)))",
        },
        damage=LOST,
    ),
    Claim(
        "where-distance",
        "where, at Eq (2)",
        "A1 = rc � r1",
        "The distance of the two axes while grinding.",
        GRINDING,
        {"-": "wheel.x + Xc = rc - r1", "+": "wheel.x + Xc = rc + r1"},
        damage=LOST,
    ),
    Claim(
        "where-normal",
        "where, at Eq (2)",
        "nxc = sin α1 cos θ; nyc = sin α1 sin θ; nzc = ±cos α1",
        "The cone's unit normal, as the description gives it in the disc's frame.",
        GRINDING,
        "wheel_normal = vec(-sin(alpha1)*cos(theta), sin(alpha1)*sin(theta), s*cos(alpha1))",
    ),
    Claim(
        "where-width",
        "where, at Eq (2)",
        "b1 = ma cos λ π/4 � rc tan α1",
        "Half the groove's width on the pitch circle, and what the cone's slope adds down to its centre.",
        GRINDING,
        {
            "-": "b_at_centre = m_a*cos(lam)*pi/4 - rc*tan(alpha1)",
            "+": "b_at_centre = m_a*cos(lam)*pi/4 + rc*tan(alpha1)",
        },
        damage=LOST,
    ),
    Claim("eq-3", "Eq (3)", "n1 · V1(1c) = 0", "Definition of the equation of meshing.", kind="definition"),
    Claim(
        "eq-4",
        "Eq (4)",
        "u1 = b1 sin α1 � (r1 � rc � p1 cot λ) cos α1/cos θ � ((rc � r1) cot λ � p1) sin α1 tan θ",
        "With minus before p1 cot λ and minus-or-plus before the last bracket this is the u1 by which the drive's own "
        "equation of meshing between disc and worm is solved.",
        GRINDING,
        {
            "every lost sign +": "U1 = b1*sin(alpha1) + (r1 + rc + p1*cos(lam)/sin(lam))*cos(alpha1)/cos(theta)"
            " + ((rc + r1)*cos(lam)/sin(lam) + p1)*sin(alpha1)*tan(theta)",
            "- before p1 cot λ, ∓ before the last bracket": "U1 = b1*sin(alpha1) + (r1 + rc - p1*cos(lam)/sin(lam))"
            "*cos(alpha1)/cos(theta) - s*((rc + r1)*cos(lam)/sin(lam) + p1)*sin(alpha1)*tan(theta)",
        },
        damage=LOST,
        conditions=["cos θ ≠ 0", "sin λ ≠ 0"],
    ),
    Claim(
        "eq-5-row-1",
        "Eq (5), row 1",
        "a11 Xh � a12 Yh � sin γ sin φ2 Zh � A2 cos φ2",
        "True with + + + -, as in Eq (7) of the recess-action paper, whose γ is 180° less the shaft angle; and true "
        "with + + - + where γ is the shaft angle itself, as Table 1 has it.",
        HOBBING,
        {
            "every lost sign +": "R2.x = a11*Xh + a12*Yh + sin(gamma)*sin(phi2)*Zh + A2*cos(phi2)",
            "+ + -, γ = 180° - Σ": "R2.x = a11*Xh + a12*Yh + sin(gamma)*sin(phi2)*Zh - A2*cos(phi2)",
            "+ - +, γ = Σ": "R2_across.x = b11*Xh + b12*Yh - sin(gamma)*sin(phi2)*Zh + A2*cos(phi2)",
        },
        damage=LOST,
    ),
    Claim(
        "eq-5-row-2",
        "Eq (5), row 2",
        "a21 Xh � a11 Yh � sin γ cos φ2 Zh � A2 sin φ2",
        "The index of the second coefficient is printed 11; it must be 22, which the paper defines and uses nowhere "
        "else. With 11 all 16 choices of the four signs of this row are refuted, the other signs being those of row 1.",
        HOBBING,
        {
            "signs " + " ".join(signs): f"R2.y = {signs[0].strip('+')}a21*Xh {signs[1]} a11*Yh {signs[2]}"
            f" sin(gamma)*cos(phi2)*Zh {signs[3]} A2*sin(phi2)"
            for signs in product("+-", repeat=4)
        },
        confusable=[("a11", "a12", "a21", "a22")],
    ),
    Claim(
        "eq-5-row-2-index",
        "Eq (5), row 2",
        "a21 Xh � a11 Yh � sin γ cos φ2 Zh � A2 sin φ2",
        "No other choice of signs saves the index 11, in either sense of γ: where hob and wheel begin to turn the "
        "coefficient of Yh is cos γ or its negative, and a coefficient of the form of a11 is 1 or -1.",
        BEGINNING,
        contradiction=[
            "d(R2.y, Yh)**2 = cos(gamma)**2",
            "d(R2_across.y, Yh)**2 = cos(gamma)**2",
            "printed_11**2 = 1",
        ],
        conditions=["sin γ ≠ 0"],
    ),
    Claim(
        "eq-5-row-3",
        "Eq (5), row 3",
        "sin γ sin φh Xh � sin γ cos φh Yh � cos γ Zh",
        "True with - - +, or - - - where γ is the shaft angle itself.",
        HOBBING,
        {
            "every lost sign +": "R2.z = sin(gamma)*sin(phih)*Xh + sin(gamma)*cos(phih)*Yh + cos(gamma)*Zh",
            "- - +, γ = 180° - Σ": "R2.z = -sin(gamma)*sin(phih)*Xh - sin(gamma)*cos(phih)*Yh + cos(gamma)*Zh",
            "- - -, γ = Σ": "R2_across.z = -sin(gamma)*sin(phih)*Xh - sin(gamma)*cos(phih)*Yh - cos(gamma)*Zh",
        },
        damage=LOST,
    ),
    Claim(
        "where-hob",
        "where, at Eq (5)",
        "Xh = (rt � l cos α2) cos θ2 � l sin α2 sin λ sin θ2; Yh = �(rt � l cos α2) sin θ2 � l sin α2 sin λ cos θ2; "
        "Zh = �l sin α2 cos λ � p2 θ2",
        "The hob's surface, as in Eq (1) of the recess-action paper: the terms with l sin α2 follow the flank.",
        HOB_SURFACE,
        {
            "every lost sign +": [
                "R_h.x = (rt + l*cos(alpha2))*cos(theta2) + l*sin(alpha2)*sin(lam)*sin(theta2)",
                "R_h.y = (rt + l*cos(alpha2))*sin(theta2) + l*sin(alpha2)*sin(lam)*cos(theta2)",
                "R_h.z = l*sin(alpha2)*cos(lam) + p2*theta2",
            ],
            "+ ∓; - + ∓; ± -": [
                "R_h.x = (rt + l*cos(alpha2))*cos(theta2) - s*l*sin(alpha2)*sin(lam)*sin(theta2)",
                "R_h.y = -(rt + l*cos(alpha2))*sin(theta2) - s*l*sin(alpha2)*sin(lam)*cos(theta2)",
                "R_h.z = s*l*sin(alpha2)*cos(lam) - p2*theta2",
            ],
        },
        damage=LOST,
    ),
    Claim(
        "where-hob-distance",
        "where, at Eq (5)",
        "A2 = rh � r2",
        "The drive's rule for the cutting distance: the hob's radius and the wheel's.",
        DISTANCE,
        {"-": "A2 = rh - r2", "+": ["A2 = rh + r2", "r2 = pitch_radius"]},
        damage=LOST,
    ),
    Claim(
        "where-coefficients",
        "where, at Eq (5)",
        "a11 = sin φ2 cos γ sin φh � cos φ2 cos φh; a12 = sin φ2 cos γ cos φh � cos φ2 sin φh; a21 = cos φ2 cos γ "
        "sin φh � sin φ2 cos φh; a22 = cos φ2 cos γ cos φh � sin φ2 sin φh",
        "Entries of the rotation from hob to wheel: true with + - - +, or - + + - where γ is the shaft angle itself.",
        HOBBING,
        {
            "every lost sign +": [
                "entry(L2h, 1, 1) = a11",
                "entry(L2h, 1, 2) = sin(phi2)*cos(gamma)*cos(phih) + cos(phi2)*sin(phih)",
                "entry(L2h, 2, 1) = cos(phi2)*cos(gamma)*sin(phih) + sin(phi2)*cos(phih)",
                "entry(L2h, 2, 2) = a22",
            ],
            "+ - - +, γ = 180° - Σ": [
                "entry(L2h, 1, 1) = a11",
                "entry(L2h, 1, 2) = a12",
                "entry(L2h, 2, 1) = a21",
                "entry(L2h, 2, 2) = a22",
            ],
            "- + + -, γ = Σ": [
                "entry(L2h_across, 1, 1) = b11",
                "entry(L2h_across, 1, 2) = b12",
                "entry(L2h_across, 2, 1) = b21",
                "entry(L2h_across, 2, 2) = b22",
            ],
        },
        damage=LOST,
    ),
    Claim(
        "eq-6",
        "Eq (6)",
        "rt = √( rh² � Sn² sin² λ/4 ) � Sn/(2 tan α2)",
        "The edge crosses the pitch cylinder where the groove is Sn wide.",
        BLADE,
        [
            "rt = sqrt(rh**2 - Sn**2*sin(lam)**2/4) - Sn/(2*tan(alpha2))",
            "(rt + Sn/(2*sin(alpha2))*cos(alpha2))**2 + (Sn/2*sin(lam))**2 = rh**2",
        ],
        damage=LOST,
        conditions=["rh ≥ Sn sin λ / 2"],
    ),
    Claim(
        "eq-7",
        "Eqs (7)–(13)",
        "f = N · V(h2) = 0; R_f(1) = M_f1 R_1; R_f(2) = M M M R_2; R_f(1) = R_f(2); n_f(1) - n_f(2) = 0",
        "Definitions and conditions to be solved.",
        kind="definition",
    ),
    Claim(
        "assembly-angle",
        "§4",
        "axes Z_fw and Z_f form an angle of γ � Δγh during the meshing",
        "The wheel's axis as the drive mounts it, without the vertical error: γ + Δγh in the sense in which γ is "
        "counted.",
        ASSEMBLY,
        {
            "+": ["axis.z = cos(gamma + dgh)", "axis.y = -sin(gamma + dgh)"],
            "-": ["axis.z = cos(gamma - dgh)", "axis.y = -sin(gamma - dgh)"],
        },
        damage=LOST,
    ),
    Claim(
        "count",
        "§5",
        "three independent equations; two independent equations; two additional independent equations of meshing; "
        "totally seven independent equations with eight unknowns",
        "Three coordinates; of the three equations between unit normals one follows from the other two and no more, "
        "since any change of a normal at right angles to it can come about. Eq (4) is linear in u1, which the others "
        "leave open, and gives it wherever its slope is not 0. Eq (7) changes with φ2, which the others leave open as "
        "well: where the hob's normal is axial it is m sin γ (A2 - Xh cos φh + Yh sin φh). That the seven are "
        "independent at a contact of given surfaces each certified contact proves, its Jacobian being regular.",
        COUNT,
        [
            "dot(na - nb, na + nb) = dot(na, na) - dot(nb, nb)",
            "cross(cross(na, e), na) = dot(na, na)*e - dot(na, e)*na",
            "f_disc = d(f_disc, u1)*(u1 - U1)",
            "V_hob.z = m2h*sin(gamma)*(A2 - Xh*cos(phih) + Yh*sin(phih))",
        ],
        conditions=["near parallel normals (n1 + n2 ≠ 0)", "∂(n1·V)/∂u1 ≠ 0"],
    ),
    Claim(
        "eq-14",
        "Eq (14)",
        "Δφ2′(φ1′) = φ2′(φ1′) - (T1/T2) φ1′",
        "Definition of the transmission error.",
        kind="definition",
    ),
    FigureClaim(
        "table-1",
        "Table 1",
        "pitch radius 12.00 mm, 60.05 mm",
        "The drive's own sizes with γ as the shaft angle, mn T1/(2 sin λ) and mn T2/(2 sin(γ + λ)), the latter at γ = "
        "45° only: at every other crossing angle the wheel is another one. With γ as 180° less the shaft angle it "
        "would be 224.09 mm.",
        [
            Figure(_table(TABLE.rule("r_worm"), 45), "12.00", "mm"),
            Figure(_table(TABLE.size("wheel_pitch_radius_mm"), 45), "60.05", "mm"),
        ],
    ),
    FigureClaim(
        "wheel-lead-angle",
        "Table 1",
        "lead angle of the worm wheel 30.0°",
        "30° is the worm's and hob's lead angle. At γ = 45° the wheel's teeth are inclined by 15° to its axis: lead "
        "angle 75°.",
        [Figure(f"90 - 180/pi*({_table(TABLE.size('wheel_helix_angle_deg'), 45)})", "30.0", "deg")],
    ),
    FigureClaim(
        "contact-ratio",
        "Table 2",
        "CR 3.624, 3.865, 4.417, 3.688",
        "(end - begin)/120°. The first two are cut after the third digit, not rounded.",
        [
            Figure("(209.36 + 225.62)/120", "3.624"),
            Figure("(241.89 + 221.98)/120", "3.865"),
            Figure("(319.76 + 210.33)/120", "4.417"),
            Figure("(255.75 + 186.81)/120", "3.688"),
        ],
    ),
    FigureClaim(
        "average-contact-ratio",
        "Table 2",
        "ACR 3.739, 3.921, 4.526, 3.791",
        "The average of the teeth in contact over [begin, end], ((n+1)² f + n² (1-f))/(n+f) for CR = n + f, is lower "
        "in every row, the average over one pitch (CR "
        "itself) lower still. The paper counts teeth within 3 µm of each other; how is not said.",
        [
            Figure(f"(({n} + 1)**2*({window}/120 - {n}) + {n}**2*({n} + 1 - {window}/120))/({window}/120)", printed)
            for n, window, printed in (
                (3, "434.98", "3.739"),
                (3, "463.87", "3.921"),
                (4, "530.09", "4.526"),
                (3, "442.56", "3.791"),
            )
        ],
        final=True,
    ),
    FigureClaim(
        "hand",
        "Table 1",
        "Right/Left handed of teeth RH LH",
        "At γ = 45° the wheel's helix angle 90° - γ - λ is 15°, positive: of the hand opposite to the worm's. So it "
        "is at 30°.",
        [Figure(_table(TABLE.size("wheel_helix_angle_deg"), crossing), ">0") for crossing in (45, 30)],
    ),
    Claim(
        "hand-of-the-others",
        "§7",
        "the right-handed ZK-type worm and left-handed ZN-type worm wheel",
        "Of γ = 60°. There the wheel's helix angle 90° - γ - λ is 0: a spur wheel, of neither hand. At 90° it is -30°, "
        "right-handed like the worm.",
        SPUR,
        contradiction="helix = 0",
    ),
    Claim(
        "no-error",
        "Table 2, §§7, 8",
        "KE = 0.0 arc-second at γ = 30.0°, 45.0°, 60.0° and 90.0°",
        "Worm and hob have one screw motion and touch along a helix, on which contact stays: at 30°, 45° and 60° the "
        "error of Eq (14) is constant, the axial gap between the two profiles turned into an angle, and 0 only "
        "relative to its value at one position. At 90° it is so up to a pitchfork of the path of contact and not "
        "beyond.",
        missing="the grinding wheel's radius, the blanks and the origin of φ1′; Eq (14) gives a constant that is not 0",
    ),
    Claim(
        "regression",
        "§2",
        "the mathematical model of the ZK-type worm surface can be obtained by considering Eqs. (1) and (4)",
        "Nothing is said of where that surface ends. Below an edge of regression there is none; with a large grinding "
        "wheel it lies at r1 sin λ/√(sin²λ + tan²α) = 9.70 mm, above the root of a worm of usual depth (12 - 1.2·4 = "
        "7.2 mm).",
        missing="the grinding wheel's radius and the worm's root radius",
    ),
    Claim(
        "low-error",
        "§8",
        "it can mesh in a very low level of kinematical errors with a high contact ratio even under assembly errors",
        "No case with assembly errors is computed in the paper.",
        kind="not_mathematical",
    ),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
