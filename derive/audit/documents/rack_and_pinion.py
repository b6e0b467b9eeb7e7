"""The rack-and-pinion paper.

The worm as a sliding rack, limit points, meshing axes. All profiles generic (jets xi, eta, zeta).
"""

from derive.audit.claims import Claim, Document, scope
from derive.audit.described import Described
from derive.audit.ledger import Chapter

DOCUMENT = Document(
    key="rack-and-pinion",
    name="the rack-and-pinion paper",
    file="002_4ec8cac32e4cad0f.txt",
    sha256="e5b345bbea939e872007e053b0e5f46c128917df00f1527be6761ba140ba1fd8",
    about="Right-angle cylindrical worm drives as rack and pinion. Index 1 is the worm, 2 the wheel; lambda is the "
    "helicoid's parameter.",
    symbols={
        "u": ("u", "mm", "profile parameter of the worm"),
        "lam": ("λ", "rad", "angle parameter of the helicoid (not the lead angle)"),
        "phi1": ("φ1", "rad", "rotation of the worm"),
        "phi2": ("φ2", "rad", "rotation of the wheel"),
        "psi": ("ψ", "rad", "λ + φ1"),
        "xi": ("ξ", "mm", "profile component along e"),
        "eta": ("η", "mm", "profile component along e1"),
        "zeta": ("ζ", "mm", "profile component along the worm axis"),
        "p": ("p", "mm/rad", "helical constant (screw parameter)"),
        "A": ("A", "mm", "centre distance"),
        "I": ("I", "-", "angular velocity ratio, of the sign of p"),
        "R1j": ("R1j", "mm", "derived pitch radius of the worm, A - p/I"),
        "R2j": ("R2j", "mm", "derived pitch radius of the wheel, p/I"),
        "r1": ("r⁽¹⁾", "mm", "worm surface in mesh"),
        "r2": ("r⁽²⁾", "mm", "the same point seen from the wheel centre"),
        "R1": ("R⁽¹⁾", "mm", "worm surface in its own frame"),
        "R2": ("R⁽²⁾", "mm", "wheel surface in its own frame"),
        "R2_u": ("∂R⁽²⁾/∂u", "-", "its tangent along u"),
        "R2_lam": ("∂R⁽²⁾/∂λ", "mm", "its tangent along λ"),
        "R2_phi1": ("dR⁽²⁾/dφ1", "mm", "velocity of the worm point in the wheel's frame per radian of φ1"),
        "n": ("n", "mm²", "normal of the worm surface, not of unit length"),
        "f": ("f", "mm³", "meshing function in its velocity form"),
        "alpha": ("α", "rad", "inclination of the second meshing axis"),
        "shaft": ("Σ", "rad", "shaft angle"),
        "tau": ("τ", "-", "worm's share of the twist whose axis is a meshing axis"),
        "omega1": ("ω⁽¹⁾", "-", "angular velocity of the worm, of length 1"),
        "omega2": ("ω⁽²⁾", "-", "angular velocity of the wheel"),
        "S0": ("S0", "1/mm", "parameter of the normal at the pitch line"),
        "Q0": ("Q0", "mm", "place on the pitch line"),
    },
)

#: A drive at right angles, of any profile: its screw motion and its motions in mesh.
DRIVE = Described(
    "cylindrical_worm_zn_zn",
    {
        "tan(lambda_worm)": "p/r_worm", "psi_worm": "lam", "phi_worm": "phi1",
        "transmission_error": "phi2 - T_1/T_2*phi1", "Sigma": "pi/2", "dA": "0", "dh": "0", "dv": "0", "da": "0",
    },
)  # fmt: skip

#: The same drive, of any shaft angle.
CROSSED = Described(DRIVE.drive, dict(DRIVE.letters) | {"Sigma": "shaft"})


def _mounted(drive: Described) -> dict:
    """How the wheel is turned, and where its centre lies."""
    wheel = drive.motion("wheel")
    return {
        "mounted": drive.matrix(wheel),
        "seat": drive.carried(wheel, ("vec", 0, 0, 0)),
    }


WORM = scope(
    "rack-and-pinion",
    """
i1 = vec(1, 0, 0)
j1 = vec(0, 1, 0)
k1 = vec(0, 0, 1)
i2 = -i1
j2 = -k1
k2 = -j1
spin_1 = d(turned, phi1)@T(turned)
spin_2 = d(mounted, (phi2, I))@T(mounted)
omega1 = vec(entry(spin_1, 3, 2), entry(spin_1, 1, 3), entry(spin_1, 2, 1))
omega2 = vec(entry(spin_2, 3, 2), entry(spin_2, 1, 3), entry(spin_2, 2, 1))
psi = lam + phi1
e = vec(cos(psi), sin(psi), 0)
e1 = vec(-sin(psi), cos(psi), 0)
r2 = r1 - seat
n = cross(d(r1, u), d(r1, lam))
f = dot(cross(omega2, r2) - cross(omega1, r1), n)
Z = zeta + p*lam
n_e = p*eta' - xi*zeta'
n_1 = -(p*xi' + eta*zeta')
n_k = xi*xi' + eta*eta'
R2j = p/I
R1j = A - R2j
rj = R1j*i1 - Q*j1
S0 = -dot(r1, k1)/dot(n, k1)
Q0 = -dot(r1 + S0*n, j1)
B2 = Ry(-phi2)
R2 = Rx(-pi/2)@(T(mounted)@(r1 - seat))
R2_u = d(R2, u)
R2_lam = d(R2, lam)
R2_phi1 = d(R2, (phi1, 1), (phi2, I))
""",
    jets={"xi": ("u",), "eta": ("u",), "zeta": ("u",)},
    described={
        "P": ("vec", ("jet", "xi", 0), ("jet", "eta", 0), ("jet", "zeta", 0)),
        "R1": DRIVE.carried(DRIVE.sweep("pinion"), "P"),
        "r1": DRIVE.carried(DRIVE.motion("pinion"), "R1"),
        "turned": DRIVE.matrix(DRIVE.motion("pinion")),
        **_mounted(DRIVE),
    },
)

#: The family in the place of its points along the helix, which stays.
RACK = scope("rack-and-pinion.rack", "lam = Psi - phi1", extends=WORM)

LIMIT = scope(
    "rack-and-pinion.limit",
    """
D_u = d(r2, (u, 1), (phi1, phi_u))
D_lam = d(r2, (lam, 1), (phi1, phi_lam))
n_p = cross(D_u, D_lam)
w = cross(omega2, r2)
T_u = D_u - phi_u*w
T_lam = D_lam - phi_lam*w
""",
    extends=WORM,
)

#: Along the surface of contact the worm turns by what keeps f = 0.
CONTACT_SURFACE = scope(
    "rack-and-pinion.contact-surface",
    """
keep_u = -(d(f, u)/d(f, phi1))
keep_lam = -(d(f, lam)/d(f, phi1))
""",
    extends=LIMIT,
)

SECTION = scope(
    "rack-and-pinion.section",
    """
m = vec(x, C, z)
arm = m - A*i1
sweep = cross(omega2, arm)
""",
    jets={"x": ("t",), "z": ("t",)},
    extends=WORM,
)

AXES = scope(
    "rack-and-pinion.axes",
    """
p = A*I*tan(alpha)/(I + tan(alpha))
R2f = 0
omega_a = (-A*I/R1j)*j1
omega_b = 1/cos(alpha)*(-cos(alpha)*k1 + sin(alpha)*j1)
""",
    extends=WORM,
)

#: The meshing function of one revolution before.
EARLIER = scope(
    "rack-and-pinion.earlier",
    """
a = xi*n_k - Z*n_e
b = Z*n_1 - eta*n_k
before = psi - 2*pi
""",
    extends=WORM,
)

PITCH_HELIX = scope(
    "rack-and-pinion.pitch-helix",
    """
at_pitch = d(on_pitch, lam)
at_reference = d(on_reference, lam)
inclined = Rz(lam)@vec(0, cos(alpha), sin(alpha))
""",
    extends=AXES,
    described={
        "on_pitch": DRIVE.carried(DRIVE.sweep("pinion"), ("vec", "R1j", 0, 0)),
        "on_reference": DRIVE.carried(DRIVE.sweep("pinion"), ("vec", "r_ref", 0, 0)),
    },
)

SECOND_AXIS = scope(
    "rack-and-pinion.second-axis",
    """
along = -cos(alpha)*k1 + sin(alpha)*j1
r_2f = R2f*i1 + v*along
""",
    extends=WORM,
)

#: The relative motion and tau times the worm's screw motion: a twist D at the origin, with the velocity W there.
ANY_SHAFT_ANGLE = scope(
    "rack-and-pinion.any-shaft-angle",
    """
seen = T(mounted)@(r1 - seat)
f = -triple(d(seen, u), d(seen, lam), d(seen, (phi1, 1), (phi2, I)))
D = omega2 - omega1 + tau*k1
W = cross(omega2, -seat) + tau*p*k1
""",
    extends=WORM,
    described=_mounted(CROSSED),
)

RIGHT_ANGLE = scope("rack-and-pinion.right-angle", "shaft = pi/2", extends=ANY_SHAFT_ANGLE)

#: Crossed helical gears with helix angles of 45 degrees, the gear of twice as many teeth.
HELICAL = scope("rack-and-pinion.crossed-helical", "p = 1\nI = 1/2\nA = 3", extends=RIGHT_ANGLE)

#: Sizes of 1, at any shaft angle.
ONES = scope(
    "rack-and-pinion.ones",
    """
p = 1
I = 1
A = 1
middle = 1 + cos(shaft) + sin(shaft)
""",
    extends=ANY_SHAFT_ANGLE,
)

CLAIMS = (
    Claim(
        "frames",
        "§1",
        "I set i_2 = -i_1, j_2 = -k_1, k_2 = -j_1.",
        "The wheel frame is right-handed, its axis perpendicular to the worm's. Worm and wheel of the drive turn about "
        "k1 and k2 with the angular velocities 1 and I, the wheel's centre at A i1.",
        WORM,
        [
            "cross(i2, j2) = k2",
            "dot(k1, k2) = 0",
            "omega1 = k1",
            "omega2 = I*k2",
            "seat = -A*i2",
        ],
    ),
    Claim(
        "ratio-sign",
        "§1",
        "Assume |ω(1)| = 1 and |ω(2)| = I.",
        "As a length, I is positive. That is right for a right-hand worm (p > 0). A left-hand worm turns the wheel "
        "about +j1 with p < 0: the rack's "
        "velocity -p k1 is then met only if I carries the sign of p.",
        WORM,
        {
            "right-hand worm, ω(2) = I k2": "cross(omega2, (R1j - A)*i1) = -p*omega1",
            "left-hand worm, ω(2) = I j1 with I = |ω(2)|": "cross(I*j1, (R1j - A)*i1) = -p*omega1",
        },
    ),
    Claim(
        "worm-surface",
        "§1",
        "R(1) = ξ(u) e(λ) + η(u) e_1(λ) + (ζ(u) + pλ) k_1; e(λ) = cos λ i_1 + sin λ j_1, e_1(λ) = -sin λ i_1 + cos λ "
        "j_1",
        "The drive's own screw motion, of any profile.",
        WORM,
        "R1 = xi*vec(cos(lam), sin(lam), 0) + eta*vec(-sin(lam), cos(lam), 0) + (zeta + p*lam)*k1",
    ),
    Claim(
        "family",
        "§1",
        "r(1) = B_1(φ_1) R(1) = ξ e(λ+φ_1) + η e_1(λ+φ_1) + (ζ+pλ) k_1",
        "Turning the helicoid about its axis only adds φ1 to λ in the circular vectors.",
        WORM,
        "r1 = xi*e + eta*e1 + (zeta + p*lam)*k1",
    ),
    Claim(
        "wheel-family",
        "§1",
        "r(2) = B_2(φ_2) R(2)",
        "With B2 = Ry(-φ2) this is the contact point seen from the wheel's centre, as the drive mounts its wheel.",
        WORM,
        "B2@R2 = r1 - A*i1",
    ),
    Claim(
        "inverse-rotation",
        "§1",
        "B_2^{-1}(φ_2) = B_2(-φ_2)",
        "The inverse of a rotation turns back.",
        WORM,
        ["T(B2)@B2 = mat([1, 0, 0], [0, 1, 0], [0, 0, 1])", "T(B2) = Ry(phi2)"],
    ),
    Claim(
        "meshing",
        "§1",
        "f(u,λ,φ_1) = (ω(2)×r(2) - ω(1)×r(1))·n = 0",
        "The velocity form is minus the envelope condition (R2_u × R2_λ)·∂R2/∂φ1, for every profile.",
        WORM,
        "f = -triple(R2_u, R2_lam, R2_phi1)",
    ),
    Claim(
        "helicoid",
        "§1",
        "the identity (pω(1) + ω(1)×r(1))·n = 0 always holds",
        "A screw motion moves a helicoid along itself.",
        WORM,
        "dot(p*omega1 + cross(omega1, r1), n) = 0",
    ),
    Claim(
        "both-terms",
        "§1",
        "f(u,λ,φ_1) = (ω(2)×r(2) - ω(1)×r(1) - pω(1) + pω(1))·n = 0",
        "p ω(1) taken away and added; with the identity of the helicoid the two middle terms go together.",
        WORM,
        [
            "f = dot(cross(omega2, r2) - cross(omega1, r1) - p*omega1 + p*omega1, n)",
            "dot(-cross(omega1, r1) - p*omega1, n) = 0",
        ],
    ),
    Claim(
        "rack-form",
        "§1",
        "⇒ (ω(2)×r(2) - (-pω(1)))·n = 0",
        "The turning worm may be replaced by one that slides by -p k1 per radian.",
        WORM,
        "f = dot(cross(omega2, r2) - (-p*omega1), n)",
        conditions=["worm of unlimited length"],
    ),
    Claim(
        "pitch-radius-wheel",
        "§1",
        "The derived pitch circle radius of the worm gear is R_2j = p/I.",
        "At that distance from its axis the wheel moves as fast as the rack.",
        WORM,
        "cross(omega2, -R2j*i1) = -p*omega1",
        conditions=["I ≠ 0", "I has the sign of p"],
    ),
    Claim(
        "psi",
        "§1",
        "r(1) = ξ e(ψ) + η e_1(ψ) + (ζ+pψ) k_1 - pφ_1 k_1",
        "With ψ = λ + φ1 the family is one surface that slides along -k1.",
        WORM,
        "r1 = xi*e + eta*e1 + (zeta + p*psi)*k1 - p*phi1*k1",
    ),
    Claim(
        "sliding",
        "§1",
        "a family of surfaces translating along -k_1 at constant speed p",
        "At fixed ψ the point moves by -p k1 per radian of φ1.",
        RACK,
        "d(r1, phi1) = -p*k1",
    ),
    Claim(
        "pitch-line",
        "§2",
        "The instantaneous axis (pitch line) is given by r_j = R_1j i_1 - Q j_1",
        "Wheel and sliding worm have the same velocity on this line.",
        WORM,
        "cross(omega2, rj - A*i1) = -p*omega1",
    ),
    Claim(
        "normal-meets-axis",
        "§2",
        "r(1) + S_0 n = R_1j i_1 - Q_0 j_1 with S_0 = -r(1)·k_1 / n·k_1 and Q_0 = -(r(1)+S_0 n)·j_1",
        "The normal ends beside the pitch line by f/(I n·k1): it meets the line exactly where f = 0.",
        WORM,
        "r1 + S0*n - (R1j*i1 - Q0*j1) = f/(I*dot(n, k1))*i1",
        conditions=["n·k1 ≠ 0"],
    ),
    Claim(
        "elimination",
        "§2",
        "By taking the dot product with (j_1 × n), I eliminate S_0 and Q_0",
        "Neither S nor Q survives the product, whatever their values.",
        WORM,
        "dot(r1 + S*n - (R1j*i1 - Q*j1), cross(j1, n)) = dot(cross(r1, j1) - R1j*k1, n)",
    ),
    Claim(
        "eq-1",
        "Eq (1)",
        "(r(1)×j_1 - R_1j k_1)·n = 0   (1)",
        "The spatial condition is I times this one; the two agree wherever I ≠ 0.",
        WORM,
        "f = I*dot(cross(r1, j1) - R1j*k1, n)",
        conditions=["I ≠ 0"],
        drops="I",
    ),
    Claim(
        "lemma",
        "§2",
        "for any non-singular point on a surface, the profile normal, surface normal, and plane normal are coplanar",
        "The profile's tangent is n × j1, its normal in the plane (n × j1) × j1: a combination of n and j1.",
        WORM,
        "triple(cross(cross(n, j1), j1), n, j1) = 0",
        conditions=["n not parallel to j1"],
    ),
    Claim(
        "eq-2",
        "Eq (2)",
        "{ (r(1)×j_1 - R_1j k_1)·n = 0 ; r(1)·j_1 = C   (2)",
        "In the plane y = C this says that the planar normal (n_x, n_z) passes the pitch point (R1j, 0).",
        WORM,
        "f = I*((r1.x - R1j)*n.z - r1.z*n.x)",
        conditions=["n not parallel to j1", "C within the worm"],
        drops="I",
    ),
    Claim(
        "wheel-profile",
        "§2",
        "R(2) = B_2^{-1}(φ_2)(r(1) - A i_1)",
        "With this surface the envelope condition is -f.",
        WORM,
        "triple(R2_u, R2_lam, R2_phi1) = -f",
    ),
    Claim(
        "section-points",
        "§2",
        "The intersection of the cutting plane with the instantaneous axis is the pitch point; with the worm gear "
        "axis, the gear center",
        "In the section y = C wheel and sliding worm have one velocity at R1j i1 + C j1, and the wheel stands still "
        "p/I from there along i1.",
        WORM,
        [
            "cross(omega2, R1j*i1 + C*j1 - seat) = -p*omega1",
            "cross(omega2, (R1j + p/I)*i1 + C*j1 - seat) = vec(0, 0, 0)",
        ],
    ),
    Claim(
        "meshing-surface",
        "§3",
        "n_p = ∂r(2)/∂u × ∂r(2)/∂λ",
        "The normal of the surface of contact: the derivatives are total ones, along which φ1 follows u and λ and "
        "keeps f = 0: a step (a, b, c) of u, λ and φ1 does so where c = a φ_u + b φ_λ, φ_u = -f_u/f_φ1 and φ_λ = "
        "-f_λ/f_φ1, and such a step of the contact point is at right angles to n_p.",
        CONTACT_SURFACE,
        [
            "d(f, (u, a), (lam, b), (phi1, c)) = (c - a*keep_u - b*keep_lam)*d(f, phi1)",
            "dot(n_p, d(r2, (u, a), (lam, b), (phi1, c))) = "
            "(c - a*phi_u - b*phi_lam)*triple(D_u, D_lam, d(r2, phi1))",
        ],
        conditions=["∂f/∂φ1 ≠ 0"],
    ),
    Claim(
        "eq-3",
        "Eq (3)",
        "(r(2), n_p, k_2) = 0   (3)",
        "I times the triple product is (T_u × T_λ)·(ω2 × r2), T the tangents of the wheel surface: it vanishes where "
        "the wheel surface is singular, so the "
        "condition is necessary. It is sufficient only where n·k1 ≠ 0, because on f = 0 the normal meets ω2 × r2 "
        "with -p n·k1.",
        LIMIT,
        ["I*triple(r2, n_p, k2) = dot(cross(T_u, T_lam), w)", "dot(n, w) = f - p*dot(n, k1)"],
        conditions=["necessary; sufficient where n·k1 ≠ 0", "n_p from total derivatives: φ1 = φ1(u, λ)", "∂f/∂φ1 ≠ 0"],
    ),
    Claim(
        "planar-limit",
        "§3",
        "for a planar curve, at the first-type limit point of its conjugate curve, the normal to the meshing line "
        "passes through the center of rotation",
        "Where the conjugate curve stands still, the meshing line's tangent is perpendicular to the arm from the "
        "centre.",
        SECTION,
        "dot(d(m, t) - phi_t*sweep, arm) = dot(d(m, t), arm)",
        conditions=["the meshing line is regular"],
    ),
    Claim(
        "eq-4",
        "Eq (4)",
        "{ (r(2), n_p, k_2) = 0 ; r(2)·k_2 = C   (4)",
        "k2 = -j1, so the section r(1)·j1 = C of Eq (2) is r(2)·k2 = -C.",
        WORM,
        "dot(r2, k2) = dot(r1, j1)",
    ),
    Claim(
        "ruled-surface",
        "§4",
        "r_h(λ,u,φ_1,s) = r(1) + s n",
        "Definition of the surface of the contact normals.",
        kind="definition",
    ),
    Claim(
        "eq-5",
        "Eq (5)",
        "{ (∂r_h/∂φ_1, ∂r_h/∂s, j_1) = 0 ; s = S_0   (5)",
        "The triple product is -(1/I) ∂f/∂φ1: the two contacts of one revolution coincide. The normal has to turn "
        "with φ1 as well.",
        WORM,
        [
            "triple(d(r1, phi1) + S0*d(n, phi1), n, j1) = -d(f, phi1)/I",
            "triple(d(r1, phi1) + S0*d(n, phi1), n, j1) = -Q0*dot(n, k1)",
        ],
        conditions=["n·k1 ≠ 0", "I ≠ 0"],
    ),
    Claim(
        "twice",
        "§4",
        "the instantaneous axis (pitch line) intersects this ruled surface twice for |φ_1| < 2π",
        "f is a cos ψ + b sin ψ less a constant: two contacts a revolution where a² + b² exceeds its square. At φ1 - "
        "2π f is what it is at φ1, so each of the two contacts between 0 and 2π has a third and a fourth between -2π "
        "and 0: |φ1| < 2π holds four. The text means a half-open interval of length 2π.",
        EARLIER,
        contradiction=[
            "f/I = a*cos(psi) + b*sin(psi) - R1j*n_k",
            "a*cos(before) + b*sin(before) - R1j*n_k = f/I",
            "n = n_e*e + n_1*e1 + n_k*k1",
        ],
    ),
    Claim(
        "axis-1",
        "§5",
        "the derived instantaneous axis itself is one meshing axis",
        "Every contact normal has no moment about the pitch line.",
        WORM,
        "I*dot(cross(r1 - R1j*i1, j1), n) = f",
        drops="I",
    ),
    Claim(
        "second-line",
        "§5",
        "r_2f = R_2f i_1 + v(-cos α k_1 + sin α j_1)",
        "The moment of a contact normal about this line, whatever v, is sin α f/I and two terms more, which vanish for "
        "every normal where R2f = 0 and tan α = p/R1j.",
        SECOND_AXIS,
        "dot(cross(r1 - r_2f, along), n) = sin(alpha)*f/I + (R1j*sin(alpha) - p*cos(alpha))*dot(n, k1)"
        " - R2f*dot(cross(i1, along), n)",
        conditions=["R1j ≠ 0"],
    ),
    Claim(
        "decomposition",
        "§5",
        "ω_1 + ω_2 = ω(2) - ω(1);  R_1j i_1×ω_1 + R_2f i_1×ω_2 - A i_1×ω(2) = 0;  R_2f = 0, tan α = p/R_1j",
        "With R2f = 0 and tan α = p/R1j both equations hold.",
        AXES,
        [
            "omega_a + omega_b = omega2 - omega1",
            "R1j*cross(i1, omega_a) + R2f*cross(i1, omega_b) - cross(seat, omega2) = vec(0, 0, 0)",
            "tan(alpha) = p/R1j",
        ],
        conditions=["R1j ≠ 0"],
    ),
    Claim(
        "axis-2",
        "§5",
        "the second meshing axis passes through the origin (R_2f = 0) and is inclined at an angle α",
        "The moment of a normal about the line of direction p j1 - R1j k1 through o1 is p f/I.",
        WORM,
        "dot(cross(r1, p*j1 - R1j*k1), n) = p*f/I",
        conditions=["R1j ≠ 0"],
    ),
    Claim(
        "lead-angle",
        "§5",
        "an angle α, which is exactly the lead angle of the worm at the pitch circle",
        "A helix of the worm at the derived pitch radius R1j is inclined by the α of tan α = p/R1j. At the nominal "
        "reference radius it is so only when A = r1 + p/I (no profile shift).",
        PITCH_HELIX,
        {
            "pitch circle of radius R1j": "cross(at_pitch, inclined) = vec(0, 0, 0)",
            "reference circle of radius r_ref": "cross(at_reference, inclined) = vec(0, 0, 0)",
        },
    ),
    Claim(
        "worm-axis",
        "§5",
        "the other is the worm axis itself (after projection)",
        "The moment of a contact normal about the worm axis is p n·k1, not 0: the second axis passes the worm axis "
        "at o1 but is inclined to it.",
        WORM,
        "dot(cross(r1, k1), n) = 0",
        corrected="dot(cross(r1, k1), n) = p*dot(n, k1)",
    ),
    Claim(
        "existence",
        "§5",
        "It is known that in crossed-axis gear drives where one member has a helical surface (as in worm gear "
        "pairs), meshing axes exist.",
        "A line that every contact normal of every helicoid meets belongs to a twist -(relative motion) + τ times "
        "the screw motion, which is a rotation only where its axis is square to its velocity, D·W = 0. For p = I = A = "
        "1, 4 D·W is a square and 4 sin Σ - 2 (1 + cos Σ)(1 + sin Σ), which is 2√2 - 1 at Σ = 135°: no real τ, no "
        "meshing axis.",
        ONES,
        contradiction=[
            "dot(n, cross(D, r1) + W) = f",
            "4*dot(D, W) = (2*tau - middle)**2 + 4*sin(shaft) - 2*(1 + cos(shaft))*(1 + sin(shaft))",
        ],
    ),
    Claim(
        "right-angle-roots",
        "§5",
        "the worm gear pair possesses two distinct meshing axes",
        "At 90° the roots are τ = 1 (pitch line) and τ = AI/p (second axis); they are distinct unless R1j = 0.",
        RIGHT_ANGLE,
        ["dot(D, W) = p*(tau - 1)*(tau - A*I/p)", "A*I/p - 1 = I/p*R1j"],
        conditions=["R1j ≠ 0"],
    ),
    Claim(
        "uniqueness",
        "§5",
        "This property is unique to cylindrical worm gear drives",
        "What is needed is one helicoid, of any profile, not a worm: the pinion of crossed helical gears is one as "
        "well (cylindrical gears, involute helicoid: screw). Helix angles of 45° on both, twice as many teeth on the "
        "gear (Σ = 90°, p = 1, I = 1/2, A = 3) give two distinct meshing axes, at τ = 1 and τ = 3/2.",
        HELICAL,
        contradiction=[
            "dot(n, cross(D, r1) + W) = f",
            "dot(D, W) = (tau - 1)*(tau - 3/2)",
        ],
    ),
    Claim(
        "face-width",
        "§4",
        "important for determining the effective face width of the worm gear",
        "A recommendation, not an equation.",
        kind="not_mathematical",
    ),
    Claim(
        "scope",
        "§6",
        "applicable to any straight-line or non-straight-line cylindrical worm gear drive that satisfies the "
        "orthogonal-axis and constant lead conditions",
        "The proofs above hold for every profile (ξ, η, ζ) of constant lead at 90°; the sentence itself is a summary.",
        kind="not_mathematical",
    ),
    Claim(
        "table-r1j",
        "§6 table",
        "Derived pitch radius of worm (rack): R_1j = A - p/I",
        "Wheel and sliding worm have one velocity at this distance from the worm's axis and at no other.",
        WORM,
        "cross(omega2, (x - A)*i1) + p*omega1 = I*(x - (A - p/I))*k1",
        conditions=["I ≠ 0"],
    ),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
