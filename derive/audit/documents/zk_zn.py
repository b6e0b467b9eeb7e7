"""The ZK-ZN paper: a ground ZK worm and a wheel cut by a ZN hob at crossing angles other than 90 degrees.

Nearly every operator and Greek letter of its equations is lost in the extraction. What can be judged is whether some
way to put the signs back is true, and which index or number cannot be right whatever the signs.
"""

from derive.audit.claims import Claim, Document, Figure, FigureClaim, scope
from derive.audit.ledger import Chapter

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

GRINDING = scope(
    "zk-zn.grinding",
    """
A1 = rc + r1
Xc = u1*cos(alpha1)*cos(theta)
Yc = u1*cos(alpha1)*sin(theta)
Zc = s*(b1 - u1*sin(alpha1))
tau = vec(0, cos(lam), sin(lam))
k_w = vec(0, -sin(lam), cos(lam))
P = vec(A1 - Xc, 0, 0) + Yc*tau + Zc*k_w
R1 = Rz(phi1)@P + vec(0, 0, p1*phi1)
nxc = sin(alpha1)*cos(theta)
nyc = sin(alpha1)*sin(theta)
nzc = s*cos(alpha1)
n_c = vec(nxc, nyc, nzc)
n1 = Rz(phi1)@(vec(-nxc, 0, 0) + nyc*tau + nzc*k_w)
""",
    signs=["s"],
)

MESHING = scope(
    "zk-zn.meshing",
    """
u_minus = b1*sin(alpha1) + cos(alpha1)/cos(theta)*(r1 + rc - p1*cos(lam)/sin(lam))
 - s*((rc + r1)*cos(lam)/sin(lam) + p1)*sin(alpha1)*tan(theta)
u_plus = b1*sin(alpha1) + cos(alpha1)/cos(theta)*(r1 + rc + p1*cos(lam)/sin(lam))
 + s*((rc + r1)*cos(lam)/sin(lam) + p1)*sin(alpha1)*tan(theta)
meshing_minus = dot(n1, cross(vec(0, 0, 1), Rz(phi1)@(vec(A1 - u_minus*cos(alpha1)*cos(theta), 0, 0)
 + u_minus*cos(alpha1)*sin(theta)*tau + s*(b1 - u_minus*sin(alpha1))*k_w)) + vec(0, 0, p1))
meshing_plus = dot(n1, cross(vec(0, 0, 1), Rz(phi1)@(vec(A1 - u_plus*cos(alpha1)*cos(theta), 0, 0)
 + u_plus*cos(alpha1)*sin(theta)*tau + s*(b1 - u_plus*sin(alpha1))*k_w)) + vec(0, 0, p1))
""",
    extends=GRINDING,
)

HOBBING = scope(
    "zk-zn.hobbing",
    """
a11 = sin(phi2)*cos(gamma)*sin(phih) + cos(phi2)*cos(phih)
a12 = sin(phi2)*cos(gamma)*cos(phih) - cos(phi2)*sin(phih)
a21 = cos(phi2)*cos(gamma)*sin(phih) - sin(phi2)*cos(phih)
a22 = cos(phi2)*cos(gamma)*cos(phih) + sin(phi2)*sin(phih)
R2 = Rz(-phi2)@(Rx(-gamma)@(Rz(phih)@vec(Xh, Yh, Zh) - vec(A2, 0, 0)))
rt = sqrt(rh**2 - Sn**2*sin(lam)**2/4) - Sn/(2*tan(alpha2))
""",
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
    Claim("eq-3", "Eq (3)", "n1 · V1(1c) = 0", "Definition of the equation of meshing.", kind="definition"),
    Claim(
        "eq-4",
        "Eq (4)",
        "u1 = b1 sin α1 � (r1 � rc � p1 cot λ) cos α1/cos θ � ((rc � r1) cot λ � p1) sin α1 tan θ",
        "With minus before p1 cot λ and minus-or-plus before the last bracket, the grinding wheel's normal is a "
        "normal of the worm's helicoid.",
        MESHING,
        {"every lost sign +": "meshing_plus = 0", "- before p1 cot λ, ∓ before the last bracket": "meshing_minus = 0"},
        damage=LOST,
        conditions=["cos θ ≠ 0", "sin λ ≠ 0"],
    ),
    Claim(
        "eq-5-row-1",
        "Eq (5), row 1",
        "a11 Xh � a12 Yh � sin γ sin φ2 Zh � A2 cos φ2",
        "True with + + + -, as in Eq (7) of the recess-action paper.",
        HOBBING,
        {
            "every lost sign +": "R2.x = a11*Xh + a12*Yh + sin(gamma)*sin(phi2)*Zh + A2*cos(phi2)",
            "+ + -": "R2.x = a11*Xh + a12*Yh + sin(gamma)*sin(phi2)*Zh - A2*cos(phi2)",
        },
        damage=LOST,
    ),
    Claim(
        "eq-5-row-2",
        "Eq (5), row 2",
        "a21 Xh � a11 Yh � sin γ cos φ2 Zh � A2 sin φ2",
        "The index of the second coefficient is printed 11; it must be 22, which the paper defines and uses nowhere "
        "else. No choice of the lost signs makes 11 true.",
        HOBBING,
        "R2.y = a21*Xh + a11*Yh + sin(gamma)*cos(phi2)*Zh + A2*sin(phi2)",
        confusable=[("a11", "a12", "a21", "a22")],
    ),
    Claim(
        "eq-5-row-3",
        "Eq (5), row 3",
        "sin γ sin φh Xh � sin γ cos φh Yh � cos γ Zh",
        "True with - - +.",
        HOBBING,
        {
            "every lost sign +": "R2.z = sin(gamma)*sin(phih)*Xh + sin(gamma)*cos(phih)*Yh + cos(gamma)*Zh",
            "- - +": "R2.z = -sin(gamma)*sin(phih)*Xh - sin(gamma)*cos(phih)*Yh + cos(gamma)*Zh",
        },
        damage=LOST,
    ),
    Claim(
        "eq-6",
        "Eq (6)",
        "rt = √( rh² � Sn² sin² λ/4 ) � Sn/(2 tan α2)",
        "The edge crosses the pitch cylinder where the groove is Sn wide.",
        HOBBING,
        "(rt + Sn/(2*sin(alpha2))*cos(alpha2))**2 + (Sn/2*sin(lam))**2 = rh**2",
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
        "mn T1/(2 sin λ), and mn T2/(2 sin(γ + λ)) at γ = 45° only: at every other crossing angle the wheel is "
        "another one.",
        [Figure("4*3/(2*sin(radians(30)))", "12.00", "mm"), Figure("4*29/(2*sin(radians(75)))", "60.05", "mm")],
    ),
    FigureClaim(
        "wheel-lead-angle",
        "Table 1",
        "lead angle of the worm wheel 30.0°",
        "30° is the worm's and hob's lead angle. At γ = 45° the wheel's teeth are inclined by 15° to its axis: lead "
        "angle 75°.",
        [Figure("90 - (90 - 30 - 45)", "30.0", "deg")],
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
    Claim(
        "low-error",
        "§8",
        "it can mesh in a very low level of kinematical errors with a high contact ratio even under assembly errors",
        "No case with assembly errors is computed in the paper.",
        kind="not_mathematical",
    ),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
