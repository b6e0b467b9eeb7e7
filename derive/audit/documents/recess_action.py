"""The recess-action paper: ZN worm, wheel cut by an oversize ZN hob. Index 1 is the hob, 2 the wheel, 3 the worm.

In the extracted text the glyph "\ufffd" stands for minus, for minus-or-plus and for less-or-equal alike, "6" for
plus-or-minus; where it matters both readings are judged.
"""

from derive.audit.claims import Claim, Document, Figure, FigureClaim, scope
from derive.audit.described import HALF_TURN, Described, written
from derive.audit.ledger import Chapter

DOCUMENT = Document(
    key="recess-action",
    name="the recess-action paper",
    file="000_e4dc51872e8570c2.txt",
    sha256="485337d8a4f9abeb64073640d68f01f0b85ee9cc6d0f479d3f566ead211bb0d2",
    about="Recess-action worm drive with an oversize hob. Index 1 is the hob, 2 the wheel, 3 the worm; unprimed "
    "angles belong to the cutting, primed ones to the mesh.",
    symbols={
        "l1": ("l1", "mm", "distance along the blade edge from the apex of both edges"),
        "th1": ("θ1", "rad", "rotation parameter of the hob's surface"),
        "a1": ("α1", "rad", "half-apex angle of the blade"),
        "lam1": ("λ1", "rad", "lead angle of the hob"),
        "lam3": ("λ3", "rad", "lead angle of the worm"),
        "rt": ("rt", "mm", "radius at which the two edges meet"),
        "r1": ("r1", "mm", "pitch radius of the hob"),
        "r2": ("r2", "mm", "pitch radius of the wheel"),
        "r3": ("r3", "mm", "pitch radius of the worm"),
        "bx": ("bx", "mm", "normal groove width on the pitch cylinder"),
        "bn": ("bn", "mm", "normal groove width at the middle of the blade"),
        "dx": ("dx", "mm", "pitch line below the middle of the blade"),
        "mn": ("mn", "mm", "normal module"),
        "p1": ("p1", "mm/rad", "lead per radian of the hob"),
        "s": ("±", "-", "upper sign +1, lower sign -1"),
        "C1": ("C1", "mm", "cutting centre distance"),
        "C3": ("C3", "mm", "meshing centre distance"),
        "dC": ("ΔC", "mm", "centre distance error"),
        "gamma1": ("γ1", "rad", "cutting crossing angle"),
        "gamma3": ("γ3", "rad", "meshing crossing angle"),
        "dgh": ("Δγh", "rad", "horizontal assembly angle"),
        "dgv": ("Δγv", "rad", "vertical assembly angle"),
        "phi1": ("φ1", "rad", "rotation of the hob while cutting"),
        "phi2": ("φ2", "rad", "rotation of the wheel while being cut"),
        "phi2p": ("φ2′", "rad", "rotation of the wheel in mesh"),
        "phi3p": ("φ3′", "rad", "rotation of the worm in mesh"),
        "m21": ("m21", "-", "φ2/φ1 = T1/T2"),
        "w1": ("ω1", "1/s", "speed of the hob"),
        "X1": ("X1", "mm", "component of R1"),
        "Y1": ("Y1", "mm", "component of R1"),
        "Z1": ("Z1", "mm", "component of R1"),
        "Nx": ("Nx1", "-", "component of N1"),
        "Ny": ("Ny1", "-", "component of N1"),
        "Nz": ("Nz1", "-", "component of N1"),
        "R1": ("R1", "mm", "hob surface, in S1"),
        "R1_l": ("∂R1/∂l1", "-", "tangent along the edge"),
        "R1_th": ("∂R1/∂θ1", "mm", "tangent along the turn"),
        "R2": ("R2", "mm", "locus of the hob, in S2"),
        "V12": ("V12", "mm/s", "velocity of the hob relative to the wheel, in S1"),
        "omega1": ("ω1⁽¹⁾", "1/s", "angular velocity of the hob, in S1"),
        "omega2": ("ω2⁽¹⁾", "1/s", "angular velocity of the wheel, in S1"),
        "T1": ("T1", "-", "threads of the hob"),
        "T2": ("T2", "-", "teeth of the wheel"),
        "T3": ("T3", "-", "threads of the worm"),
    },
)

DRIVE = "cylindrical_worm_zn_zn"
#: Letters of the cutting: the description's psi runs against theta1, its shaft angle is 180 degrees less gamma.
CUTTING_LETTERS = {
    "tan(lambda_hob)": "p1/r_hob", "T_hob*phi_hob/T_2": "phi2", "t_hob": "l1", "psi_hob": "-th1", "r_t_hob": "rt",
    "alpha_hob": "a1", "lambda_hob": "lam1", "Sigma_gen": "pi - gamma1", "A_gen": "C1", "phi_hob": "phi1",
    "r_hob": "r1",
}  # fmt: skip
CUTTING = Described(DRIVE, CUTTING_LETTERS)
#: The worm in the letters of the hob.
WORM = Described(
    DRIVE,
    {
        "tan(lambda_worm)": "p1/r_worm", "t_worm": "l1", "psi_worm": "-th1", "r_t_worm": "rt", "alpha": "a1",
        "lambda_worm": "lam1", "r_worm": "r1",
    },
)  # fmt: skip
#: Letters of the mesh: errors in the sense of gamma.
MESHING = Described(
    DRIVE,
    {
        "transmission_error": "phi2p - T_1/T_2*phi_worm", "Sigma": "pi - gamma3", "dh": "-dgh", "dv": "-dgv",
        "dA": "dC", "A": "C3", "da": "0", "phi_worm": "phi3p",
    },
)  # fmt: skip
DIMENSIONS = Described(
    DRIVE,
    {
        "alpha_hob": "a1", "alpha": "a1", "lambda_hob": "lam1", "lambda_worm": "lam3", "r_hob": "r1", "r_worm": "r3",
        "T_hob": "T1", "T_1": "T3", "T_2": "T2", "m_n": "mn", "Sigma": "pi - gamma3", "A": "C3",
    },
)  # fmt: skip
#: The sizes of Table 1, of axes at 90 degrees, and its numbers.
SIZES_OF_TABLE = Described(DRIVE, {"r_worm": "r3", "lambda_worm": "lam3"})
EXAMPLE = {
    "m_n": "2", "T_1": "1", "T_2": "277", "lam3": "radians(3)", "Sigma": "radians(90)", "dx": "0",
    "alpha": "radians(10)", "r3": "2*1/(2*sin(radians(3)))",
}  # fmt: skip
#: The groove's width as its own letter.
GROOVE = Described(
    DRIVE, {"dx": "(pi*m_n/2 - bx)/(2*tan(alpha))", "alpha_hob": "a1", "alpha": "a1", "lambda_hob": "lam1",
            "r_hob": "r1"}
)  # fmt: skip
GENERATION = CUTTING.generation("wheel")
HOB_SURFACE = CUTTING.carried(CUTTING.sweep("wheel"), CUTTING.edge("wheel"))

BLADE = scope(
    "recess-action.hob",
    """
R1_l = d(R1, l1)
R1_th = d(R1, th1)
N1 = cross(R1_l, R1_th)
""",
    signs=["s"],
    described={"R1": HOB_SURFACE, "worm": WORM.carried(WORM.sweep("pinion"), WORM.edge("pinion"))},
)

WIDTH = scope(
    "recess-action.width",
    "",
    described={
        "rt": GROOVE.name("r_t_hob"),
        "width": DIMENSIONS.size("groove_width_mm"),
    },
)

#: The wheel's frame of the paper is the description's, turned half about x.
CUT_DESCRIBED = {
    "turn": HALF_TURN,
    "machine": CUTTING.matrix(GENERATION),
    "locus": CUTTING.carried(GENERATION, "hob"),
    "seen": CUTTING.carried(GENERATION, ("vec", 0, 0, 0)),
    "turned": CUTTING.turned(GENERATION[-1:], "hob"),
}

CUT = scope(
    "recess-action.cut",
    """
a11 = cos(phi1)*cos(phi2) + cos(gamma1)*sin(phi1)*sin(phi2)
a12 = -sin(phi1)*cos(phi2) + cos(gamma1)*cos(phi1)*sin(phi2)
a21 = -cos(phi1)*sin(phi2) + cos(gamma1)*sin(phi1)*cos(phi2)
a22 = sin(phi1)*sin(phi2) + cos(gamma1)*cos(phi1)*cos(phi2)
L21 = turn@machine
N1 = vec(Nx, Ny, Nz)
R2 = turn@locus
n2 = L21@vec(nx, ny, nz)
V1 = w1*(Rz(-phi1)@d(turned, phi1))
omega1 = w1*vec(0, 0, 1)
omega2 = m21*w1*(T(L21)@vec(0, 0, 1))
O1O2 = -(T(machine)@seen)
V12 = w1*(T(L21)@d(R2, (phi1, 1), (phi2, m21)))
""",
    described={"hob": ("vec", "X1", "Y1", "Z1"), **CUT_DESCRIBED},
)

ENVELOPE = scope(
    "recess-action.envelope",
    """
N1 = cross(d(hob, l1), d(hob, th1))
L21 = turn@machine
R2 = turn@locus
omega1 = w1*vec(0, 0, 1)
omega2 = m21*w1*(T(L21)@vec(0, 0, 1))
O1O2 = -(T(machine)@seen)
V12 = cross(omega1 - omega2, hob) - cross(O1O2, omega2)
""",
    signs=["s"],
    described={"hob": HOB_SURFACE, **CUT_DESCRIBED},
)

#: What a design's table of misalignments holds, but for the shift along the wheel's axis, which the paper has not.
ERRORS = [key["symbol"]["name"] for key in MESHING.data["keys"] if key["table"] == "misalignment"][:3]
MESH = scope(
    "recess-action.mesh",
    """
L_w2 = ours@turn
b21 = sin(gamma3 + dgh)*sin(dgv)*cos(phi2p) + cos(gamma3 + dgh)*sin(phi2p)
b22 = -sin(gamma3 + dgh)*sin(dgv)*sin(phi2p) + cos(gamma3 + dgh)*cos(phi2p)
b31 = -cos(gamma3 + dgh)*sin(dgv)*cos(phi2p) + sin(gamma3 + dgh)*sin(phi2p)
b32 = cos(gamma3 + dgh)*sin(dgv)*sin(phi2p) + sin(gamma3 + dgh)*cos(phi2p)
n_w3 = L_w3@vec(nx3, ny3, nz3)
n_w2 = L_w2@vec(nx2, ny2, nz2)
e = vec(ex, ey, ez)
errors = vec(error_1, -error_2, -error_3)
""",
    described={
        "turn": HALF_TURN,
        "point": ("vec", "X2", ("-", "Y2"), ("-", "Z2")),
        "L_w3": MESHING.matrix(MESHING.motion("pinion")),
        "ours": MESHING.matrix(MESHING.motion("wheel")),
        "R_w3": MESHING.carried(MESHING.motion("pinion"), ("vec", "X3", "Y3", "Z3")),
        "R_w2": MESHING.carried(MESHING.motion("wheel"), "point"),
        **{f"error_{k}": MESHING.name(name) for k, name in enumerate(ERRORS, 1)},
    },
)

#: Sizes as the rules of the description complete a design: the normal pitch is lead times cosine over threads.
SIZES = scope(
    "recess-action.sizes",
    """
C3 = C3_rule
r2 = C3 - r3
gamma1 = pi - Sigma_gen
pitch_1 = 2*pi*p_hob*cos(lam1)/T1
pitch_3 = 2*pi*p_worm*cos(lam3)/T3
""",
    described={
        "r3": DIMENSIONS.rule("r_worm"),
        "C3_rule": DIMENSIONS.rule("A"),
        "C1_rule": DIMENSIONS.rule("A_gen"),
        "Sigma_gen": DIMENSIONS.rule("Sigma_gen"),
        "p_hob": DIMENSIONS.size("screw_parameter_hob_mm_per_rad"),
        "p_worm": DIMENSIONS.size("screw_parameter_worm_mm_per_rad"),
        "sin_hob": DIMENSIONS.arc_of_rule("lambda_hob")[0],
    },
)

#: The pitch point in the cutting: both axes turned to 0, a hob point on the common perpendicular.
ROLLING = scope(
    "recess-action.rolling",
    """
C3 = C3_rule
gamma1 = pi - Sigma_gen
phi1 = 0
phi2 = 0
r1 = mn*T1/(2*sin(lam1))
O1O2 = -(T(machine)@seen)
omega2 = T1/T2*(T(turn@machine)@vec(0, 0, 1))
V = cross(vec(0, 0, 1) - omega2, vec(r1, 0, 0)) - cross(O1O2, omega2)
across = Rx(lam1)@vec(0, 0, 1)
""",
    described={
        "r3": DIMENSIONS.rule("r_worm"),
        "C3_rule": DIMENSIONS.rule("A"),
        "C1_rule": DIMENSIONS.rule("A_gen"),
        "Sigma_gen": DIMENSIONS.rule("Sigma_gen"),
        "turn": HALF_TURN,
        "machine": CUT_DESCRIBED["machine"],
        "seen": CUT_DESCRIBED["seen"],
    },
)


def _throat(shift: str):
    """The drive's rule for the wheel's tip at 90 degrees, with the paper's limits and the pitch line shifted."""
    letters = {"dx": shift, "limits": "1", "Sigma": "pi/2", "m_n": "mn", "T_2": "T2", "lambda_worm": "lam3"}
    return Described(DRIVE, letters).rule("R_tip")


THROAT = scope(
    "recess-action.throat",
    "",
    described={"semi": _throat("m_n"), "full": _throat("2*m_n"), "standard": _throat("0")},
)

#: Eq (15) at one place of the locus: φ1 = 0 and Y1 = 0.
COUNT = scope(
    "recess-action.count",
    """
e = vec(ex, ey, ez)
phi1 = 0
Y1 = 0
hob = vec(X1, Y1, Z1)
machine_seen = turn@machine
omega2 = m21*w1*(T(machine_seen)@vec(0, 0, 1))
V_somewhere = cross(w1*vec(0, 0, 1) - omega2, hob) + cross(T(machine)@seen, omega2)
""",
    described={"machine": CUT_DESCRIBED["machine"], "seen": CUT_DESCRIBED["seen"]},
    extends=MESH,
)

TABLE_2 = (
    "Std �800.0 6.3120 �797.4533 �2.8880 6.3148 �803.5230 0.3102 6.91\n"
    "�400.0 7.5492 �398.8153 �1.4440 7.5498 �401.4447 0.0701\n\n"
    "0 8.7733 0 0 8.7732 �0.0002 0\n400.0 9.9884 398.9577 1.4441 9.9888 401.0173 0.0589\n"
    "800.0 11.1973 798.0322 2.8881 11.1988 801.7385 0.2181\n\n"
    "Semi 0 6.8036 0 0 6.8036 �0.0001 0 7.39\n400.0 8.0187 398.9608 1.4441 8.0191 401.0128 0.0587\n"
    "800.0 9.2277 798.0377 2.8882 9.2291 801.7315 0.2173\n\n"
    "1200.0 10.4324 1197.2115 4.3324 10.4353 1202.2409 0.4552\n"
    "1600.0 11.6341 1596.4673 5.7766 11.6387 1602.5987 0.7569\n\n"
    "Full 400.0 6.0490 398.9639 1.4441 6.0494 400.0083 0.0585 7.58\n"
    "800.0 7.2580 798.0433 2.8882 7.2595 801.7246 0.2165\n\n"
    "1200.0 8.4628 1197.2190 4.3323 8.4657 1202.2329 0.4537\n"
    "1600.0 9.6646 1596.4762 5.7764 9.6691 1602.5904 0.7545\n"
    "2000.0 10.8644 1995.8032 7.2205 10.8706 2002.8372 1.1073"
)
ANGLES = (("phi2p", "phi3p"), ("dgh", "dgv"))
DAMAGE = "the sign of this term is the glyph '\ufffd', which stands for minus and for minus-or-plus"


def rows(name: str, *expressions: str) -> list[str]:
    """One equation a row of a printed vector."""
    return [f"{name}.{axis} = {expression}" for axis, expression in zip("xyz", expressions, strict=True)]


CLAIMS = (
    Claim(
        "eq-1",
        "Eq (1)",
        "R1 = [ (rt + l1 cos α1) cos θ1 � l1 sin λ1 sin α1 sin θ1 ; �(rt + l1 cos α1) sin θ1 � l1 sin λ1 sin α1 cos "
        "θ1 ; ± l1 cos λ1 sin α1 � p1 θ1 ; 1 ]",
        "Both terms with l1 sin λ1 sin α1 follow the flank: minus for the right side, plus for the left. Read as a "
        "plain minus, the left flank is wrong; "
        "the ± in Eq (6) shows what was meant.",
        BLADE,
        {
            "� is minus": rows(
                "R1",
                "(rt + l1*cos(a1))*cos(th1) - l1*sin(lam1)*sin(a1)*sin(th1)",
                "-(rt + l1*cos(a1))*sin(th1) - l1*sin(lam1)*sin(a1)*cos(th1)",
                "s*l1*cos(lam1)*sin(a1) - p1*th1",
            ),
            "� in the second terms is minus-or-plus": rows(
                "R1",
                "(rt + l1*cos(a1))*cos(th1) - s*l1*sin(lam1)*sin(a1)*sin(th1)",
                "-(rt + l1*cos(a1))*sin(th1) - s*l1*sin(lam1)*sin(a1)*cos(th1)",
                "s*l1*cos(lam1)*sin(a1) - p1*th1",
            ),
        },
        damage=DAMAGE,
    ),
    Claim(
        "eq-2",
        "Eq (2)",
        "rt = √( r1² � (bx/2 sin λ1)² ) � bx / (2 tan α1)",
        "With this rt the edge crosses the pitch cylinder exactly where the groove is bx wide.",
        WIDTH,
        [
            "rt = sqrt(r1**2 - (bx/2*sin(lam1))**2) - bx/(2*tan(a1))",
            "(rt + bx/(2*sin(a1))*cos(a1))**2 + (bx/2*sin(lam1))**2 = r1**2",
        ],
        conditions=["r1 ≥ bx sin λ1 / 2", "0 < α1 < 90°"],
    ),
    Claim(
        "eq-3",
        "Eq (3)",
        "bx = bn � 2 dx tan α1, bn = π mn/2",
        "Groove width at the shifted pitch line, as the drive's own sizes give it.",
        WIDTH,
        "width = pi*mn/2 - 2*dx*tan(a1)",
    ),
    Claim("eq-4", "Eq (4)", "N1 = ∂R1/∂l1 × ∂R1/∂θ1, n1 = N1/|N1|", "Definition of the normal.", kind="definition"),
    Claim(
        "eq-5",
        "Eq (5)",
        "∂R1/∂l1 = [ cos α1 cos θ1 � sin α1 sin λ1 sin θ1 ; � cos α1 sin θ1 � sin α1 sin λ1 cos θ1 ; ± sin α1 cos λ1 ]",
        "The derivative of Eq (1); the same two signs follow the flank.",
        BLADE,
        {
            "� is minus": rows(
                "R1_l",
                "cos(a1)*cos(th1) - sin(a1)*sin(lam1)*sin(th1)",
                "-cos(a1)*sin(th1) - sin(a1)*sin(lam1)*cos(th1)",
                "s*sin(a1)*cos(lam1)",
            ),
            "� in the second terms is minus-or-plus": rows(
                "R1_l",
                "cos(a1)*cos(th1) - s*sin(a1)*sin(lam1)*sin(th1)",
                "-cos(a1)*sin(th1) - s*sin(a1)*sin(lam1)*cos(th1)",
                "s*sin(a1)*cos(lam1)",
            ),
        },
        damage=DAMAGE,
    ),
    Claim(
        "eq-6",
        "Eq (6)",
        "∂R1/∂θ1 = [ �(rt + l1 cos α1) sin θ1 � l1 sin λ1 sin α1 cos θ1 ; �(rt + l1 cos α1) cos θ1 ± l1 sin λ1 sin "
        "α1 sin θ1 ; �p1 ]",
        "The ± of the second row is legible and right; the first row needs minus-or-plus.",
        BLADE,
        {
            "� is minus": rows(
                "R1_th",
                "-(rt + l1*cos(a1))*sin(th1) - l1*sin(lam1)*sin(a1)*cos(th1)",
                "-(rt + l1*cos(a1))*cos(th1) + s*l1*sin(lam1)*sin(a1)*sin(th1)",
                "-p1",
            ),
            "� in the second term of row 1 is minus-or-plus": rows(
                "R1_th",
                "-(rt + l1*cos(a1))*sin(th1) - s*l1*sin(lam1)*sin(a1)*cos(th1)",
                "-(rt + l1*cos(a1))*cos(th1) + s*l1*sin(lam1)*sin(a1)*sin(th1)",
                "-p1",
            ),
        },
        damage=DAMAGE,
    ),
    Claim(
        "eq-7",
        "Eq (7)",
        "R2 = [ a11X1 + a12Y1 + sin γ1 sin φ2 Z1 � cos φ2 C1 ; a21X1 + a22Y1 + sin γ1 cos φ2 Z1 � sin φ2 C1 ; � sin "
        "γ1 sin φ1 X1 � sin γ1 cos φ1 Y1 + cos γ1 Z1 ; 1 ]",
        "Row 2 must end in + sin φ2 C1: the centre offset (-C1, 0, 0) turned by -φ2.",
        CUT,
        rows(
            "R2",
            "a11*X1 + a12*Y1 + sin(gamma1)*sin(phi2)*Z1 - cos(phi2)*C1",
            "a21*X1 + a22*Y1 + sin(gamma1)*cos(phi2)*Z1 - sin(phi2)*C1",
            "-sin(gamma1)*sin(phi1)*X1 - sin(gamma1)*cos(phi1)*Y1 + cos(gamma1)*Z1",
        ),
        damage="the sign before sin φ2 C1 is the glyph '\ufffd'",
    ),
    Claim(
        "eq-8",
        "Eq (8)",
        "a11 = cos φ1 cos φ2 + cos γ1 sin φ1 sin φ2; a12 = � sin φ1 cos φ2 + cos γ1 cos φ1 sin φ2; a21 = � cos φ1 "
        "sin φ2 + cos γ1 sin φ1 cos φ2; a22 = sin φ1 sin φ2 + cos γ1 cos φ1 cos φ2",
        "Entries of the rotation from hob to wheel.",
        CUT,
        ["entry(L21, 1, 1) = a11", "entry(L21, 1, 2) = a12", "entry(L21, 2, 1) = a21", "entry(L21, 2, 2) = a22"],
    ),
    Claim("ratio", "§6", "φ2 = (T1/T2) φ1", "The gearing of the hobbing machine: a definition.", kind="definition"),
    Claim(
        "eq-9",
        "Eq (9)",
        "n2 = [ a11nx1 + a12ny1 + sin γ1 sin φ2 nz1 ; a21nx1 + a22ny1 + sin γ1 cos φ2 nz1 ; � sin γ1 sin φ1 nx1 � "
        "sin γ1 cos φ1 ny1 + cos γ1 nz1 ]",
        "The normal turned like the surface.",
        CUT,
        rows(
            "n2",
            "a11*nx + a12*ny + sin(gamma1)*sin(phi2)*nz",
            "a21*nx + a22*ny + sin(gamma1)*cos(phi2)*nz",
            "-sin(gamma1)*sin(phi1)*nx - sin(gamma1)*cos(phi1)*ny + cos(gamma1)*nz",
        ),
    ),
    Claim(
        "eq-10",
        "Eq (10)",
        "N1 · V12 = N1 · (V1 � V2) = 0   (10)",
        "ω1 times the envelope condition (R2_l × R2_θ)·∂R2/∂φ1, so both vanish together.",
        ENVELOPE,
        "dot(N1, V12) = w1*triple(d(R2, l1), d(R2, th1), d(R2, (phi1, 1), (phi2, m21)))",
        conditions=["ω1 ≠ 0"],
        drops="w1",
    ),
    Claim(
        "eq-11",
        "Eq (11)",
        "V12 = (ω1 � ω2) × R1 � O1O2 × ω2   (11)",
        "The velocity of a hob point seen from the wheel.",
        CUT,
        "V12 = cross(omega1 - omega2, hob) - cross(O1O2, omega2)",
    ),
    Claim(
        "eq-12",
        "Eq (12)",
        "ω1 = ω1 [0 0 1]ᵀ",
        "The velocity of any hob point by the hob's own turn in the machine, in S1, is this vector × R1.",
        CUT,
        "V1 = cross(w1*vec(0, 0, 1), hob)",
    ),
    Claim(
        "eq-13",
        "Eq (13)",
        "x1(1) = ω1 [ �m21 sin γ1 sin φ1 ; �m21 sin γ1 cos φ1 ; m21 cos γ1 ]",
        "The left side is ω2, the wheel's angular velocity; ω1 is Eq (12).",
        CUT,
        "omega1 = w1*vec(-m21*sin(gamma1)*sin(phi1), -m21*sin(gamma1)*cos(phi1), m21*cos(gamma1))",
        confusable=[("omega1", "omega2")],
    ),
    Claim(
        "eq-14",
        "Eq (14)",
        "O1O2 = [ cos φ1 C1 ; � sin φ1 C1 ; 0 ]",
        "The wheel's centre seen from the hob.",
        CUT,
        ["O1O2 = vec(cos(phi1)*C1, -sin(phi1)*C1, 0)"],
    ),
    Claim(
        "eq-15",
        "Eq (15)",
        "V12 = ω1 [ (m21 cos γ1 � 1)Y1 + m21(sin γ1 cos φ1 Z1 + cos γ1 sin φ1 C1) ; �(m21 cos γ1 � 1)X1 + m21(� sin "
        "γ1 sin φ1 Z1 + cos γ1 cos φ1 C1) ; m21 sin γ1(� cos φ1X1 + sin φ1Y1 + C1) ]",
        "Eqs (12) to (14) in Eq (11).",
        CUT,
        rows(
            "V12",
            "w1*((m21*cos(gamma1) - 1)*Y1 + m21*(sin(gamma1)*cos(phi1)*Z1 + cos(gamma1)*sin(phi1)*C1))",
            "w1*(-(m21*cos(gamma1) - 1)*X1 + m21*(-sin(gamma1)*sin(phi1)*Z1 + cos(gamma1)*cos(phi1)*C1))",
            "w1*(m21*sin(gamma1)*(-cos(phi1)*X1 + sin(phi1)*Y1 + C1))",
        ),
    ),
    Claim(
        "eq-16",
        "Eq (16)",
        "f = ω1{[(m21 cos γ1 � 1)Y1 + m21(cos φ1 sin γ1Z1 + sin φ1 cos γ1C1)]Nx1 + [�(m21 sin γ1 � 1)X1 + m21(� sin "
        "φ1 sin γ1Z1 + cos φ1 cos γ1C1)]Ny1 + [m21 sin γ1(� cos φ1X1 + sin φ1Y1 + C1)]Nz1} = 0",
        "In the second bracket it must be m21 cos γ1 - 1, as in Eq (15).",
        CUT,
        "dot(N1, V12) = w1*(((m21*cos(gamma1) - 1)*Y1 + m21*(cos(phi1)*sin(gamma1)*Z1 + sin(phi1)*cos(gamma1)*C1))*Nx"
        " + (-(m21*sin(gamma1) - 1)*X1 + m21*(-sin(phi1)*sin(gamma1)*Z1 + cos(phi1)*cos(gamma1)*C1))*Ny"
        " + (m21*sin(gamma1)*(-cos(phi1)*X1 + sin(phi1)*Y1 + C1))*Nz)",
    ),
    Claim(
        "eq-17",
        "Eq (17)",
        "R_w(3) = R_w(2)",
        "Contact: equal positions. A condition to be solved, not an identity.",
        kind="definition",
    ),
    Claim(
        "eq-18",
        "Eq (18)",
        "n_w(3) � n_w(2) = 0",
        "Contact: equal unit normals. A condition to be solved, not an identity.",
        kind="definition",
    ),
    Claim(
        "eq-19",
        "Eqs (19), (20)",
        "R_w(3) = M_w3 R_3(3); R_w(2) = M_wu M_u2 R_2(2) = M_w2 R_2(2)",
        "Definition of the positions in the fixed frame.",
        kind="definition",
    ),
    Claim(
        "eq-21",
        "Eq (21)",
        "M_w3 = [cos φ3′ � sin φ3′ 0 0; sin φ3′ cos φ3′ 0 0; 0 0 1 0; 0 0 0 1]",
        "Rotation of the worm by φ3′.",
        MESH,
        "L_w3 = mat([cos(phi3p), -sin(phi3p), 0], [sin(phi3p), cos(phi3p), 0], [0, 0, 1])",
    ),
    Claim(
        "eq-22",
        "Eq (22)",
        "M_w2 = [cos Δγv cos φ3′, � cos Δγv sin φ2′, sin Δγv, C3 + ΔC; b21, b22, � sin(γ3 + Δγh) cos Δγv, 0; b31, "
        "b32, cos(γ3 + Δγh) cos Δγv, 0; 0 0 0 1]",
        "The first entry turns with the wheel: φ2′ for φ3′.",
        MESH,
        [
            "L_w2 = mat([cos(dgv)*cos(phi3p), -cos(dgv)*sin(phi2p), sin(dgv)], [b21, b22, -sin(gamma3 + "
            "dgh)*cos(dgv)], [b31, b32, cos(gamma3 + dgh)*cos(dgv)])"
        ],
        confusable=ANGLES,
    ),
    Claim(
        "eq-23",
        "Eq (23)",
        "b21 = sin(γ3 + Δγh) sin Δγv cos φ2′ + cos(γ3 + Δγh) sin φ2′; b22 = � sin(γ3 + Δγh) sin Δγv sin φ2′ + cos(γ3 "
        "+ Δγh) cos φ2′; "
        "b31 = � cos(γ3 + Δγh) sin Δγv cos φ2′ + sin(γ3 + Δγh) sin φ2′; b32 = cos(γ3 + Δγh) sin Δγv sin φ2′ + sin(γ3 "
        "+ Δγh) cos φ2′",
        "Rows 2 and 3 of Rx(γ3 + Δγh) Ry(Δγv) Rz(φ2′).",
        MESH,
        ["entry(L_w2, 2, 1) = b21", "entry(L_w2, 2, 2) = b22", "entry(L_w2, 3, 1) = b31", "entry(L_w2, 3, 2) = b32"],
    ),
    Claim(
        "eq-24",
        "Eq (24)",
        "R_w(3) = [cos φ3′X3 � sin φ3′Y3; sin φ3′X3 + cos φ3′Y3; Z3; 1]",
        "Worm point in the fixed frame.",
        MESH,
        rows("R_w3", "cos(phi3p)*X3 - sin(phi3p)*Y3", "sin(phi3p)*X3 + cos(phi3p)*Y3", "Z3"),
    ),
    Claim(
        "eq-25",
        "Eq (25)",
        "R_w(2) = [cos Δγv cos φ2′X2 � cos Δγv sin φ2′Y2 + sin Δγv Z2 + (C3 + ΔC); b21X2 + b22Y2 � sin(γ3 + Δγh) cos "
        "Δγv Z2; b31X2 + b32Y2 + cos(γ3 + Δγh) cos Δγv Z2; 1]",
        "Wheel point in the fixed frame; here φ2′ is printed correctly.",
        MESH,
        rows(
            "R_w2",
            "cos(dgv)*cos(phi2p)*X2 - cos(dgv)*sin(phi2p)*Y2 + sin(dgv)*Z2 + (C3 + dC)",
            "b21*X2 + b22*Y2 - sin(gamma3 + dgh)*cos(dgv)*Z2",
            "b31*X2 + b32*Y2 + cos(gamma3 + dgh)*cos(dgv)*Z2",
        ),
    ),
    Claim(
        "eq-26",
        "Eqs (26), (27)",
        "n_w(3) = L_w3 n_3(3); n_w(2) = L_wu L_u2 n_2(2) = L_w2 n_2(2)",
        "Definition of the normals in the fixed frame.",
        kind="definition",
    ),
    Claim(
        "worm-normal",
        "text at Eq (27)",
        "the unit normal vector of RA worm expressed\n\nin coordinate system S3, which is identical to the unit normal "
        "vector\nn1 of oversize ZN worm-type hob cutter as expressed in Eq. (4).",
        "Identical in form: the worm of the drive has the hob's surface and normal with sizes of its own in the place "
        "of r1, λ1, p1 and rt.",
        BLADE,
        ["worm = R1", "cross(d(worm, l1), d(worm, th1)) = N1"],
    ),
    Claim(
        "eq-28",
        "Eq (28)",
        "n_w(3) = [cos φ3′nx3 � sin φ3′ny3; sin φ3′nx3 + cos φ3′ny3; nz3]",
        "Worm normal in the fixed frame.",
        MESH,
        rows("n_w3", "cos(phi3p)*nx3 - sin(phi3p)*ny3", "sin(phi3p)*nx3 + cos(phi3p)*ny3", "nz3"),
    ),
    Claim(
        "eq-29",
        "Eq (29)",
        "n_w(2) = [cos Δγv cos φ3′nx2 � cos Δγv sin φ3′ny2 + sin Δγv nz2; b21nx2 + b22ny2 � sin(γ3 + Δγv) cos Δγv "
        "nz2; b31nx2 + b32ny2 + cos(γ3 + Δγh) cos Δγv nz2]",
        "Row 1 turns with φ2′, row 2 has sin(γ3 + Δγh), as in Eq (25).",
        MESH,
        rows(
            "n_w2",
            "cos(dgv)*cos(phi3p)*nx2 - cos(dgv)*sin(phi3p)*ny2 + sin(dgv)*nz2",
            "b21*nx2 + b22*ny2 - sin(gamma3 + dgv)*cos(dgv)*nz2",
            "b31*nx2 + b32*ny2 + cos(gamma3 + dgh)*cos(dgv)*nz2",
        ),
        confusable=ANGLES,
    ),
    Claim(
        "count",
        "§8.1",
        "Since |n_w(3)| = 1 and |n_w(2)| = 1, Eqs. (16)–(18) yield a system of six independent nonlinear equations "
        "with seven independent parameters",
        "One of the three equations (18) follows from the other two: the difference of two unit vectors is "
        "perpendicular to their sum. None of the others follows from the rest whatever the two surfaces are: a small "
        "turn w moves a normal by w × n, which can be any change e - n(n·e) at right angles to it, a shift moves the "
        "three coordinates of (17) and leaves the normals, and f/ω1 need not be 0 on the locus of the hob: it is "
        "m21 sin γ1 Z1 where φ1 = 0, N1 lies along X1 and Y1 = 0. That the six are independent at a contact of given "
        "surfaces is not to be had in letters; each certified contact proves it there, its Jacobian being regular.",
        COUNT,
        [
            "dot(n_w3 - n_w2, n_w3 + n_w2) = dot(n_w3, n_w3) - dot(n_w2, n_w2)",
            "cross(cross(n_w3, e), n_w3) = dot(n_w3, n_w3)*e - dot(n_w3, e)*n_w3",
            "dot(vec(1, 0, 0), V_somewhere) = w1*m21*sin(gamma1)*Z1",
        ],
        conditions=["near parallel normals (n_w3 + n_w2 ≠ 0)"],
    ),
    Claim(
        "eq-30",
        "Eq (30)",
        "KE = Δφ2′(φ3′) = φ2′(φ3′) � (T3/T2) φ3′",
        "Definition of the kinematic (transmission) error.",
        kind="definition",
    ),
    Claim(
        "errors",
        "text at Eq (30)",
        "three given assembly errors, i.e., ΔC, Δγh, and Δγh",
        "The third is Δγv: the mesh has no other error.",
        MESH,
        "errors = vec(dC, dgh, dgh)",
        confusable=ANGLES,
    ),
    FigureClaim(
        "eq-31",
        "Eq (31), Example 1 and 2",
        "CR = (φ3e′ � φ3b′)/(360 deg/T3): 7.58, 7.39, 6.91; cases 2–4: 7.48, 7.16, 7.34",
        "All six printed contact ratios follow from the printed angles.",
        [
            Figure("(2745.81 - 15.64)/(360/1)", "7.58"),
            Figure("(2089.77 - (-569.03))/(360/1)", "7.39"),
            Figure("(1433.26 - (-1053.29))/(360/1)", "6.91"),
            Figure("(2740.47 - 48.03)/(360/1)", "7.48"),
            Figure("(2619.39 - 41.01)/(360/1)", "7.16"),
            Figure("(2706.40 - 63.66)/(360/1)", "7.34"),
        ],
    ),
    FigureClaim(
        "acr",
        "Example 2",
        "ACRs are 7.51, 7.18, and 7.37",
        "Averaged over [begin, end] as the text says, ACR = ((n+1)² f + n² (1-f))/(n+f) for CR = n + f. Averaged "
        "over one pitch it would be CR itself.",
        [
            Figure(
                "(8**2*((2740.47 - 48.03)/360 - 7) + 7**2*(8 - (2740.47 - 48.03)/360))/((2740.47 - 48.03)/360)", "7.51"
            ),
            Figure(
                "(8**2*((2619.39 - 41.01)/360 - 7) + 7**2*(8 - (2619.39 - 41.01)/360))/((2619.39 - 41.01)/360)", "7.18"
            ),
            Figure(
                "(8**2*((2706.40 - 63.66)/360 - 7) + 7**2*(8 - (2706.40 - 63.66)/360))/((2706.40 - 63.66)/360)", "7.37"
            ),
        ],
    ),
    Claim(
        "eq-35",
        "Eqs (32), (33), (35)",
        "X_T = r_T cos θ_T; Y_T = r_T sin θ_T; tan(θ_T) = Y_T/X_T",
        "Eq (35) follows from (32) and (33), it adds no condition.",
        MESH,
        "tan(thT) = rT*sin(thT)/(rT*cos(thT))",
        conditions=["r_T ≠ 0"],
    ),
    Claim(
        "eq-34",
        "Eq (34)",
        "|Z_T(2) � Z_T(3)| = 6.32 µm",
        "Definition of the contact pattern's edge: the separation chosen for marking paint.",
        kind="definition",
    ),
    Claim(
        "eq-36",
        "Eq (36)",
        "λ1 = sin⁻¹( mn cos λ3 / (2 r1) )",
        "Hob and worm cut and fill the same wheel, so their normal pitches, lead times cosine over threads, are equal. "
        "Their difference is 2π r1/T1 times sin λ1 - mn T1/(2 r1): equal pitch is this equation and no other, and "
        "it is the drive's own rule for λ1. The printed form holds for one thread if mn were the worm's axial module.",
        SIZES,
        [
            "sin(lam1) - mn*cos(lam3)/(2*r1) = T1/(2*pi*r1)*(pitch_1 - pitch_3)",
            "sin_hob = mn*cos(lam3)/(2*r1)",
        ],
        corrected=[
            "sin(lam1) - mn*T1/(2*r1) = T1/(2*pi*r1)*(pitch_1 - pitch_3)",
            "sin_hob = mn*T1/(2*r1)",
        ],
        conditions=["r1 ≠ 0"],
    ),
    Claim(
        "eq-37",
        "Eq (37)",
        "C1 = C3 + r1 � r3",
        "The hob rolls on the wheel's pitch cylinder where the relative velocity at the pitch point lies along its "
        "thread. Across the thread that velocity is a factor times C1 - (C3 + r1 - r3): it vanishes, and the wheel "
        "gets the hob's normal pitch, for this centre distance alone. The factor is not 0 for crossed axes.",
        ROLLING,
        [
            "dot(V, across) = T1/T2*sin(gamma1 - lam1)*(C1 - (C3 + r1 - r3))",
            "dot(V, vec(1, 0, 0)) = 0",
            "C1_rule = C3 + r1 - r3",
        ],
        conditions=["γ1 ≠ λ1"],
    ),
    Claim(
        "eq-38",
        "Eq (38)",
        "γ1 = γ3 + λ1 � λ3",
        "With this angle hob and worm have the same groove direction at the pitch point.",
        SIZES,
        [
            "Rx(-gamma1)@vec(0, cos(lam1), sin(lam1)) = Rx(-gamma3)@vec(0, cos(lam3), sin(lam3))",
            "gamma1 = gamma3 + lam1 - lam3",
        ],
    ),
    FigureClaim(
        "table-1",
        "Table 1",
        "pitch radius 19.11, 277.38 mm; meshing center distance 296.49 mm",
        "The sizes of worm and wheel follow from mn = 2 mm, 1 and 277 teeth and λ3 = 3 deg.",
        [
            Figure(written(value, EXAMPLE), printed, "mm")
            for value, printed in (
                (SIZES_OF_TABLE.rule("r_worm"), "19.11"),
                (SIZES_OF_TABLE.size("wheel_pitch_radius_mm"), "277.38"),
                (SIZES_OF_TABLE.rule("A"), "296.49"),
            )
        ],
    ),
    Claim(
        "hob-radius",
        "Table 1",
        "pitch radius 20.00 mm; 4.7% oversize; cutting center distance 297.38 mm",
        "4.7% and 297.38 = 296.49 + 20 - 19.11 agree with r1 = 20 mm. Table 2 does not: its rows come out to the "
        "last digit with r1 = 20.0638 mm (5.0%, 297.45 mm), and with 20 mm the kinematic error is 6% too small and "
        "θ1 0.4 deg off. Which radius was meant cannot be told from the text.",
        missing="the pitch radius of the hob with which Table 2 was computed",
    ),
    Claim(
        "lead-angle",
        "Table 1, §9",
        "lead angle 2.86 deg; cutting crossing angle 89.86 deg",
        "2.86 deg follows from Eq (36) as printed with r1 = 20 mm, and from the corrected equation with the r1 = "
        "20.0638 mm of Table 2; the corrected equation with 20 mm gives 2.87 deg, and 89.87 deg for γ1.",
        missing="the pitch radius of the hob with which it was computed",
    ),
    FigureClaim(
        "thickness",
        "§3",
        "tooth thicknesses ... become 1.22 and 0.86 mn ... tooth thickness of the generated worm gear at its normal "
        "pitch circle is 1.51 mn",
        "The drive's own width for dx/mn = 1, 2, 0 and mn = 1: π/2 - 2 (dx/mn) tan 10°. The standard value must be "
        "1.57; 0.86 is cut, not rounded.",
        [
            Figure(written(SIZES_OF_TABLE.size("groove_width_mm"), EXAMPLE | {"m_n": "1", "dx": dx}), printed)
            for dx, printed in (("1", "1.22"), ("2", "0.86"), ("0", "1.51"))
        ],
    ),
    Claim(
        "throat",
        "§3",
        "their normal throat radii are (T2 + 2)mn/2 mm and T2mn/2 mm, individually ... normal throat radius is (T2 + "
        "4)mn/2 mm",
        "With a normal module the wheel's pitch radius is mn T2/(2 cos λ3); the throat lies 2 mn - dx above it. The "
        "printed radii lack 1/cos λ3 (0.38 mm in "
        "the example), and the limits of the tables only come out with it.",
        THROAT,
        ["semi = (T2 + 2)*mn/2", "full = T2*mn/2", "standard = (T2 + 4)*mn/2"],
        corrected=[
            "semi = (T2/cos(lam3) + 2)*mn/2",
            "full = T2/cos(lam3)*mn/2",
            "standard = (T2/cos(lam3) + 4)*mn/2",
        ],
    ),
    FigureClaim(
        "table-2-heading",
        "Table 2, column 5",
        "/03 (deg) l3 (mm) h3 (deg) /03 (deg) l1 (mm) h1 (deg) KE (arc-sec) CR\n\n"
        "Std �800.0 6.3120 �797.4533 �2.8880 6.3148 �803.5230 0.3102 6.91\n"
        "�400.0 7.5492 �398.8153 �1.4440 7.5498 �401.4447 0.0701\n\n"
        "0 8.7733 0 0 8.7732 �0.0002 0\n400.0 9.9884 398.9577 1.4441 9.9888 401.0173 0.0589",
        "The heading φ3′ appears twice. At φ3′ = 400 the fifth column holds 1.4441, which is φ2′.",
        [Figure("400", "1.4441", "deg")],
        corrected=[Figure("400/277 + 0.0589/3600", "1.4441", "deg")],
    ),
    FigureClaim(
        "table-2-hob-angle",
        "Table 2, column 7",
        TABLE_2,
        "Standard, semi and full differ by equal steps of dx, and θ1 with them: 401.0173, 401.0128, 401.0083 deg at "
        "400 deg as 801.7385, 801.7315, 801.7246 deg at 800 deg. One digit is wrong.",
        [Figure("2*401.0128 - 401.0173", "400.0083", "deg")],
    ),
    FigureClaim(
        "table-2-wheel-angle",
        "Table 2, column 5",
        TABLE_2,
        "φ2′ = φ3′/277 + KE/3600. Four entries differ: semi 800, 1200 and 1600 deg, full 800 deg.",
        [
            Figure(f"{angle}/277 + {error}/3600", printed, "deg")
            for angle, error, printed in (
                ("(-800)", "0.3102", "-2.8880"),
                ("(-400)", "0.0701", "-1.4440"),
                ("0", "0", "0"),
                ("400", "0.0589", "1.4441"),
                ("800", "0.2181", "2.8881"),
                ("0", "0", "0"),
                ("400", "0.0587", "1.4441"),
                ("800", "0.2173", "2.8882"),
                ("1200", "0.4552", "4.3324"),
                ("1600", "0.7569", "5.7766"),
                ("400", "0.0585", "1.4441"),
                ("800", "0.2165", "2.8882"),
                ("1200", "0.4537", "4.3323"),
                ("1600", "0.7545", "5.7764"),
                ("2000", "1.1073", "7.2205"),
            )
        ],
    ),
    Claim(
        "advantages",
        "§§1, 2, 10",
        "friction of recess action is lower than that of approach action; KEs are dramatically lower",
        "Statements about friction and comparisons, no equations.",
        kind="not_mathematical",
    ),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
