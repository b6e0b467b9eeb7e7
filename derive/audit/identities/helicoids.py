"""Helicoids: one identity for every profile, then the flank forms of ISO 10828 as they are generated."""

from derive.audit.claims import Document, scope
from derive.audit.identities.conventions import identity
from derive.audit.ledger import Chapter

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

STRAIGHT = scope(
    "helicoids.straight-blade",
    """
k = vec(0, 0, 1)
rt = sqrt(r**2 - (S*sin(lam)/2)**2) - S/(2*tan(alpha))
P = vec(rt + t*cos(alpha), -s*t*sin(alpha)*sin(lam), s*t*sin(alpha)*cos(lam))
pitch = S/(2*sin(alpha))
in_section = Rx(-lam)@P
n = cross(d(P, t), vec(-P.y, P.x, p))
""",
    signs=["s"],
)

AXIAL = scope(
    "helicoids.axial-blade",
    """
P = vec(rho, 0, s*(S/(2*cos(lam)) + (rho - r)*tan(alpha)/cos(lam)))
slope = s*tan(alpha)/cos(lam)
n = vec(-slope*rho, -p, rho)
""",
    signs=["s"],
)

INVOLUTE = scope(
    "helicoids.involute",
    """
rho = rb/cos(at)
P = vec(rho, 0, z0 + s*p*(tan(at) - at))
n = vec(-s*p*tan(at), -p, rho)
""",
    signs=["s"],
)

GROUND = scope(
    "helicoids.grinding-wheel",
    """
k = vec(0, 0, 1)
p = r*tan(lam)
E = r + rc
b1 = rc*tan(alpha) + S/2
u = b1*sin(alpha) + cos(alpha)*(E - p*cos(lam)/sin(lam))/cos(theta) - s*sin(alpha)*tan(theta)*(p + E*cos(lam)/sin(lam))
tau = vec(0, cos(lam), sin(lam))
k_w = vec(0, -sin(lam), cos(lam))
radius = u*cos(alpha)
width = b1 - u*sin(alpha)
P = vec(E - radius*cos(theta), 0, 0) + radius*sin(theta)*tau + s*width*k_w
n = vec(sin(alpha)*cos(theta), 0, 0) - sin(alpha)*sin(theta)*tau - s*cos(alpha)*k_w
""",
    signs=["s"],
)

ARC = scope(
    "helicoids.arc",
    """
k = vec(0, 0, 1)
E = r + rc
tau = vec(0, cos(lam), sin(lam))
k_w = vec(0, -sin(lam), cos(lam))
radius = rc + rho_c*(sin(xi) - sin(alpha))
width = S/2 + rho_c*(cos(xi) - cos(alpha))
P = vec(E - radius*cos(theta), 0, 0) + radius*sin(theta)*tau + s*width*k_w
n = vec(sin(xi)*cos(theta), 0, 0) - sin(xi)*sin(theta)*tau - s*cos(xi)*k_w
""",
    signs=["s"],
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

CLAIMS = (
    identity(
        "helicoid",
        "any profile",
        "A helicoid moves along itself: n·(k × r + p k) = 0, for every profile.",
        "dot(normal, cross(k, R) + p*k) = 0",
        GENERIC,
    ),
    identity(
        "normal",
        "any profile",
        "The normal is that of the section, turned by ψ: it need be formed only once.",
        "normal = Rz(psi)@section",
        GENERIC,
    ),
    identity(
        "rounding-normal",
        "hob tip",
        "The tube around the helix of a ball's centre has the ball's radius as its normal, in both directions ...",
        ["dot(N, N) = 1", "dot(Rz(psi)@N, d(tube, xi)) = 0", "dot(Rz(psi)@N, d(tube, psi)) = 0"],
        ROUNDING,
    ),
    identity(
        "rounding-join",
        "hob tip",
        "... it touches any flank from which the centre lies along the normal, which is square to the helix: the "
        "tube's own normal there is the flank's.",
        ["dot(n, T) = 0", "Rz(-psi)@(d(C, psi)) = T"],
        ROUNDING,
    ),
    identity(
        "rounding-tip",
        "hob tip",
        "At ξ = 0 the tube's normal is radial and its point the ball's radius farther out than the centre: it touches "
        "the tip cylinder of that radius.",
        ["R*radial + rho*radial = (R + rho)*vec(cos(a), sin(a), 0)", "dot(radial, around) = 0"],
        ROUNDING,
    ),
    identity(
        "zn-width",
        "ZN",
        "The straight edge crosses the reference cylinder where the groove is S wide.",
        "(rt + pitch*cos(alpha))**2 + (pitch*sin(alpha)*sin(lam))**2 = r**2",
        STRAIGHT,
        conditions=["r ≥ S sin λ / 2"],
    ),
    identity(
        "zn-straight",
        "ZN",
        "Turned back by λ the edge lies in a plane and is straight.",
        ["in_section.y = 0", "d(d(P, t), t) = vec(0, 0, 0)", "dot(d(P, t), d(P, t)) = 1"],
        STRAIGHT,
    ),
    identity(
        "za-normal",
        "ZA",
        "(-z′ρ, -p, ρ) with z′ = s tan α / cos λ is normal to the helicoid of the straight axial edge.",
        ["dot(n, d(P, rho)) = 0", "dot(n, vec(-P.y, P.x, p)) = 0"],
        AXIAL,
    ),
    identity(
        "zi-normal",
        "ZI",
        "With ρ = r_b/cos a_t and z = s p inv a_t the same holds, and the slope dz/dρ is s p tan a_t/ρ.",
        ["dot(n, d(P, at)) = 0", "dot(n, vec(-P.y, P.x, p)) = 0", "d(P.z, at) = s*p*tan(at)/rho*d(rho, at)"],
        INVOLUTE,
        conditions=["ρ ≥ r_b"],
    ),
    identity(
        "zk-normal",
        "ZK",
        "The grinding wheel's unit normal is perpendicular to the profile and to the screw motion: it is the worm's "
        "normal, no derivative needed.",
        ["dot(n, d(P, theta)) = 0", "dot(n, cross(k, P) + p*k) = 0", "dot(n, n) = 1"],
        GROUND,
        conditions=["cos θ ≠ 0", "sin λ ≠ 0"],
    ),
    identity(
        "zk-radius",
        "ZK",
        "At θ = 0 the profile has the radius at which a ZI of equal size touches it, whatever the grinding wheel.",
        "(E - (b1*sin(alpha) + cos(alpha)*rc)*cos(alpha))**2 + ((b1 - (b1*sin(alpha) + "
        "cos(alpha)*rc)*sin(alpha))*sin(lam))**2"
        " = (r - S/2*sin(alpha)*cos(alpha))**2 + (S/2*cos(alpha)**2*sin(lam))**2",
        GROUND,
    ),
    identity(
        "zc-normal",
        "ZC",
        "The arc's unit normal is perpendicular to the grinding wheel in both directions.",
        ["dot(n, d(P, theta)) = 0", "dot(n, d(P, xi)) = 0", "dot(n, n) = 1"],
        ARC,
    ),
    identity(
        "zc-meshing",
        "ZC",
        "At fixed θ the equation of meshing of the grinding wheel is a cos ξ + b sin ξ with no constant, so the "
        "contact point is explicit: the two directions that solve it are opposite.",
        "d(d(dot(n, cross(k, P) + r*tan(lam)*k), xi), xi) = -dot(n, cross(k, P) + r*tan(lam)*k)",
        ARC,
        conditions=["(a, b) ≠ (0, 0)"],
    ),
    identity(
        "zn-normal",
        "ZN",
        "The straight edge's normal is perpendicular to the edge and to the screw motion.",
        ["dot(n, d(P, t)) = 0", "dot(n, cross(vec(0, 0, 1), P) + p*vec(0, 0, 1)) = 0"],
        STRAIGHT,
    ),
    identity(
        "zc-limit",
        "ZC",
        "At ξ = α arc and cone agree in radius, width and normal.",
        ["rc + rho_c*(sin(alpha) - sin(alpha)) = rc", "S/2 + rho_c*(cos(alpha) - cos(alpha)) = S/2"],
        ARC,
    ),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
