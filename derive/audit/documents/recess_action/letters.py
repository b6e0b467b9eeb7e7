"""Letters of the recess-action paper: what it names, and what stands for that in the description of a ZN-ZN drive."""

from derive.audit.claims import Document, scope
from derive.audit.described import HALF_TURN, Described

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


def hob_surface():
    """The hob's flank in its own frame."""
    return CUTTING.carried(CUTTING.sweep("wheel"), CUTTING.edge("wheel"))


BLADE = scope(
    "recess-action.hob",
    """
R1_l = d(R1, l1)
R1_th = d(R1, th1)
N1 = cross(R1_l, R1_th)
""",
    signs=["s"],
    described=lambda: {"R1": hob_surface(), "worm": WORM.carried(WORM.sweep("pinion"), WORM.edge("pinion"))},
)

WIDTH = scope(
    "recess-action.width",
    "",
    described=lambda: {
        "rt": GROOVE.name("r_t_hob"),
        "width": DIMENSIONS.size("groove_width_mm"),
    },
)


def cutting():
    """The cutting of the wheel; the wheel's frame of the paper is the description's, turned half about x."""
    return {
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
    described=lambda: {"hob": ("vec", "X1", "Y1", "Z1"), **cutting()},
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
    described=lambda: {"hob": hob_surface(), **cutting()},
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
    described=lambda: {
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
    described=lambda: {
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
    described=lambda: {
        "r3": DIMENSIONS.rule("r_worm"),
        "C3_rule": DIMENSIONS.rule("A"),
        "C1_rule": DIMENSIONS.rule("A_gen"),
        "Sigma_gen": DIMENSIONS.rule("Sigma_gen"),
        "turn": HALF_TURN,
        "machine": cutting()["machine"],
        "seen": cutting()["seen"],
    },
)


def _throat(shift: str):
    """The drive's rule for the wheel's tip at 90 degrees, with the paper's limits and the pitch line shifted."""
    letters = {"dx": shift, "limits": "1", "Sigma": "pi/2", "m_n": "mn", "T_2": "T2", "lambda_worm": "lam3"}
    return Described(DRIVE, letters).rule("R_tip")


THROAT = scope(
    "recess-action.throat",
    "",
    described=lambda: {"semi": _throat("m_n"), "full": _throat("2*m_n"), "standard": _throat("0")},
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
    described=lambda: {"machine": cutting()["machine"], "seen": cutting()["seen"]},
    extends=MESH,
)

#: As it is extracted; ``\n`` is the end of a line.
TABLE_2 = (
    r"Std �800.0 6.3120 �797.4533 �2.8880 6.3148 �803.5230 0.3102 6.91\n"
    r"�400.0 7.5492 �398.8153 �1.4440 7.5498 �401.4447 0.0701\n\n"
    r"0 8.7733 0 0 8.7732 �0.0002 0\n400.0 9.9884 398.9577 1.4441 9.9888 401.0173 0.0589\n"
    r"800.0 11.1973 798.0322 2.8881 11.1988 801.7385 0.2181\n\n"
    r"Semi 0 6.8036 0 0 6.8036 �0.0001 0 7.39\n400.0 8.0187 398.9608 1.4441 8.0191 401.0128 0.0587\n"
    r"800.0 9.2277 798.0377 2.8882 9.2291 801.7315 0.2173\n\n"
    r"1200.0 10.4324 1197.2115 4.3324 10.4353 1202.2409 0.4552\n"
    r"1600.0 11.6341 1596.4673 5.7766 11.6387 1602.5987 0.7569\n\n"
    r"Full 400.0 6.0490 398.9639 1.4441 6.0494 400.0083 0.0585 7.58\n"
    r"800.0 7.2580 798.0433 2.8882 7.2595 801.7246 0.2165\n\n"
    r"1200.0 8.4628 1197.2190 4.3323 8.4657 1202.2329 0.4537\n"
    r"1600.0 9.6646 1596.4762 5.7764 9.6691 1602.5904 0.7545\n"
    r"2000.0 10.8644 1995.8032 7.2205 10.8706 2002.8372 1.1073"
)
