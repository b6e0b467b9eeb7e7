"""Helicoids: one identity for every profile, then the flank forms of ISO 10828 as they are generated."""

from derive.audit.claims import Document, scope
from derive.audit.described import Described, Factors
from derive.audit.ledger import Chapter
from derive.audit.paragraphs import identities

DOCUMENT = Document(
    key="helicoids",
    name="worm and hob flanks",
    file="derive/tools",
    sha256="",
    about="A flank is a profile P(t) in screw motion about z. The profile is left generic where possible; the types "
    "A, I, N, K, C then only fill it in.",
    symbols={
        "t": ("t", "mm or rad", "profile parameter"),
        "psi": ("ψ", "rad", "screw angle"),
        "p": ("p", "mm/rad", "screw parameter"),
        "alpha": ("α", "rad", "pressure angle of the generating profile"),
        "lam": ("λ", "rad", "lead angle"),
        "S": ("S", "mm", "normal groove width"),
        "r": ("r", "mm", "reference radius"),
        "rc": ("rc", "mm", "grinding wheel radius"),
        "s": ("s", "-", "flank sign"),
        "theta": ("θ", "rad", "angle on the grinding wheel"),
        "rho": ("ρ", "mm", "radius"),
        "xi": ("ξ", "rad", "angle on the arc of the grinding wheel"),
        "rho_c": ("ρc", "mm", "radius of that arc"),
        "R": ("R", "mm", "distance of a ball's centre from the axis"),
        "a": ("a", "rad", "azimuth of that centre"),
        "h": ("h", "1/mm", "radius of the ball over the length of the flank's normal"),
    },
)

GENERIC = scope(
    "helicoids",
    """
k = vec(0, 0, 1)
P = vec(Px, Py, Pz)
R = Rz(psi)@P + vec(0, 0, p*psi)
normal = cross(d(R, t), d(R, psi))
section = cross(d(P, t), vec(-Py, Px, p))
""",
    jets={"Px": ("t",), "Py": ("t",), "Pz": ("t",)},
)

#: Letters of every tool: S the groove's width.
LETTERS = {
    "dx": "(pi*m_n/2 - S)/(2*tan(alpha))", "psi_worm": "psi", "t_worm": "t", "r_worm": "r", "r_c_worm": "rc",
    "lambda_worm": "lam",
}  # fmt: skip


def tool(form: str, first: dict[str, str], own: dict[str, str] | None = None) -> Described:
    """The worm of a drive whose worm and hob have this flank form; ``first`` stands for whole expressions."""
    return Described(f"cylindrical_worm_{form}_{form}", {**first, **LETTERS, **(own or {})})


ZN = tool("zn", {"tan(lambda_worm)": "p/r_worm"}, {"r_t_worm": "rt"})
ZA = tool("za", {"tan(lambda_worm)": "p/r_worm"}, {"t_worm": "rho"})
#: ρ = r_b/cos a_t, so that the roll angle a_t is the profile's parameter; its slope along ρ is that of this equation.
ZI = tool(
    "zi",
    {"tan(lambda_worm)": "p/r_worm", "a_t_worm_t_worm": "cos(a_t_worm)**2/(r_b_worm*sin(a_t_worm))"},
    {"r_b_worm": "rb", "a_t_worm": "at", "a_t_pitch_worm": "ap", "t_worm": "rb/cos(at)"},
)
ZK = tool("zk", {}, {"t_worm": "theta"})
#: The cone before the equation of meshing is solved for the place u on its generatrix.
CONE_OF_ZK = tool("zk", {}, {"t_worm": "theta", "u_worm": "u"})
ZC = tool("zc", {}, {"t_worm": "theta", "xi_worm": "xi", "rho_c_worm": "rho_c"})
CONE, DISC = ZK.sweep("pinion"), ZC.sweep("pinion")


def turned(drive: Described) -> dict:
    """A worm's edge, its outward normal, and the flank that the edge sweeps."""
    return {
        "P": drive.edge("pinion"),
        "outward": drive.normal("pinion"),
        "swept": drive.carried(drive.sweep("pinion"), "P"),
    }


def ground(drive: Described, motion: Factors) -> dict:
    """A point of a grinding wheel and its normal in the worm's frame, before the screw motion."""
    return {
        "P": drive.carried(motion, drive.edge("pinion")),
        "n": drive.turned(motion, drive.edge_normal("pinion")),
    }


STRAIGHT = scope(
    "helicoids.straight-blade",
    """
k = vec(0, 0, 1)
in_section = Rx(-lam)@P
n = outward
""",
    signs=["s"],
    described=lambda: turned(ZN),
)

#: The edge where it lies half the groove's width from the middle.
PITCH_POINT = scope(
    "helicoids.pitch-point",
    "t = S/(2*sin(alpha))",
    signs=["s"],
    described=lambda: {"P": tool("zn", {}).edge("pinion")},
)

AXIAL = scope("helicoids.axial-blade", "n = outward", signs=["s"], described=lambda: turned(ZA))
INVOLUTE = scope(
    "helicoids.involute", "n = outward", signs=["s"], described=lambda: {"rho": ZI.name("t_worm"), **turned(ZI)}
)
GROUND = scope(
    "helicoids.grinding-wheel", "k = vec(0, 0, 1)\np = r*tan(lam)", signs=["s"], described=lambda: ground(ZK, CONE)
)
ARC = scope("helicoids.arc", "k = vec(0, 0, 1)", signs=["s"], described=lambda: ground(ZC, DISC))

#: The arc where it touches the cone, whose generatrix passes through the same point of the pitch circle.
ARC_END = scope(
    "helicoids.arc-end",
    "xi = 0\nu = 0",
    signs=["s"],
    described=lambda: {
        "arc": ground(ZC, DISC)["P"],
        "cone": ground(CONE_OF_ZK, CONE)["P"],
        "arc_normal": ground(ZC, DISC)["n"],
        "cone_normal": ground(CONE_OF_ZK, CONE)["n"],
    },
)

#: The ground profile at θ = 0.
MIDDLE = scope(
    "helicoids.grinding-wheel-middle",
    "theta = 0",
    signs=["s"],
    described=lambda: {"P": ground(ZK, CONE)["P"]},
)

ROUNDING = scope(
    "helicoids.rounding",
    """
k = vec(0, 0, 1)
P = vec(Px, Py, Pz)
n = cross(d(P, t), cross(k, P) + p*k)
centre = P - h*n
T = cross(k, centre) + p*k
C = Rz(psi)@centre + vec(0, 0, p*psi)
radial = vec(cos(a), sin(a), 0)
around = R*vec(-sin(a), cos(a), 0) + p*k
N = cos(xi)*radial + sin(xi)*cross(radial, around)/sqrt(dot(around, around))
tube = Rz(psi)@(R*radial + rho*N) + vec(0, 0, p*psi)
""",
    jets={"Px": ("t",), "Py": ("t",), "Pz": ("t",)},
)

CLAIMS = identities(
    """
helicoid | any profile | GENERIC
A helicoid moves along itself: n·(k × r + p k) = 0, for every profile.
    dot(normal, cross(k, R) + p*k) = 0

normal | any profile | GENERIC
The normal is that of the section, turned by ψ: it need be formed only once.
    normal = Rz(psi)@section

rounding-normal | hob tip | ROUNDING
The tube around the helix of a ball's centre has the ball's radius as its normal, in both directions ...
    dot(N, N) = 1
    dot(Rz(psi)@N, d(tube, xi)) = 0
    dot(Rz(psi)@N, d(tube, psi)) = 0

rounding-join | hob tip | ROUNDING
... it touches any flank from which the centre lies along the normal, which is square to the helix: the tube's own
normal there is the flank's.
    dot(n, T) = 0
    Rz(-psi)@(d(C, psi)) = T

rounding-tip | hob tip | ROUNDING
At ξ = 0 the tube's normal is radial and its point the ball's radius farther out than the centre: it touches the tip
cylinder of that radius.
    R*radial + rho*radial = (R + rho)*vec(cos(a), sin(a), 0)
    dot(radial, around) = 0

zn-width | ZN | PITCH_POINT
The straight edge crosses the reference cylinder where the groove is S wide.
    P.x**2 + P.y**2 = r**2
where: r ≥ S sin λ / 2

zn-straight | ZN | STRAIGHT
Turned back by λ the edge lies in a plane and is straight.
    in_section.y = 0
    d(d(P, t), t) = vec(0, 0, 0)
    dot(d(P, t), d(P, t)) = 1

za-normal | ZA | AXIAL
The description's outward normal (z′ρ, p, -ρ) with z′ = tan α / cos λ, times the flank's sign, is normal to the helicoid
of the straight axial edge.
    dot(n, d(P, rho)) = 0
    dot(n, vec(-P.y, P.x, p)) = 0
    dot(Rz(psi)@n, d(swept, psi)) = 0
    d(P.z, rho)*cos(lam) = s*tan(alpha)

zi-normal | ZI | INVOLUTE
With ρ = r_b/cos a_t and z = s p inv a_t the same holds, and the slope dz/dρ is s p tan a_t/ρ.
    dot(n, d(P, at)) = 0
    dot(n, vec(-P.y, P.x, p)) = 0
    dot(Rz(psi)@n, d(swept, psi)) = 0
    d(P.z, at) = s*p*tan(at)/rho*d(rho, at)
where: ρ ≥ r_b

zk-normal | ZK | GROUND
The grinding wheel's unit normal is perpendicular to the profile and to the screw motion: it is the worm's normal, no
derivative needed.
    dot(n, d(P, theta)) = 0
    dot(n, cross(k, P) + p*k) = 0
    dot(n, n) = 1
where: cos θ ≠ 0
where: sin λ ≠ 0

zk-radius | ZK | MIDDLE
At θ = 0 the profile has the radius at which a ZI of equal size touches it, whatever the grinding wheel.
    P.x**2 + P.y**2 = (r - S/2*sin(alpha)*cos(alpha))**2 + (S/2*cos(alpha)**2*sin(lam))**2

zc-normal | ZC | ARC
The arc's unit normal is perpendicular to the grinding wheel in both directions; the arc has the radius ρc.
    dot(n, d(P, theta)) = 0
    dot(n, d(P, xi)) = 0
    dot(n, n) = 1
    dot(d(P, xi), d(P, xi)) = rho_c**2

zc-meshing | ZC | ARC
At fixed θ the equation of meshing of the grinding wheel is a cos ξ + b sin ξ with no constant, so the contact point is
explicit: the two directions that solve it are opposite.
    d(d(dot(n, cross(k, P) + r*tan(lam)*k), xi), xi) = -dot(n, cross(k, P) + r*tan(lam)*k)
where: (a, b) ≠ (0, 0)

zn-normal | ZN | STRAIGHT
The straight edge's normal is perpendicular to the edge and to the screw motion.
    dot(n, d(P, t)) = 0
    dot(n, cross(vec(0, 0, 1), P) + p*vec(0, 0, 1)) = 0
    dot(Rz(psi)@n, d(swept, psi)) = 0

zc-limit | ZC | ARC_END
On the pitch circle of the grinding wheel the disc of form C has the point and the normal of the cone of form K, at
every θ: the arc touches the cone's generatrix there.
    arc = cone
    arc_normal = cone_normal
""",
    globals(),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
