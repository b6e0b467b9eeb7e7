"""Cylindrical gears: generation by a modified rack, the involute helicoid, undercut, pairs on crossed axes."""

from collections.abc import Mapping

from derive.audit.claims import Document, scope
from derive.audit.described import Described
from derive.audit.identities.helicoids import tool
from derive.audit.ledger import Chapter
from derive.audit.paragraphs import identities
from derive.prove.tree import Tree

DOCUMENT = Document(
    key="cylindrical_gears",
    name="cylindrical gears",
    file="derive/drives/cylindrical_gears.py",
    sha256="",
    about="A straight edge with any modification E(l, Z), a plunge δ(Z) and a feed ε(Z) traverses the face along the "
    "trace of a helical rack; the gear rolls on it. Rack, normal, rolling and sizes are those of the drive's "
    "description. Index 1 is the pinion, 2 the wheel.",
    symbols={
        "l": ("l", "mm", "along the edge from the rack's datum line"),
        "Z": ("Z", "mm", "position across the face"),
        "E": ("E", "mm", "depth of the modified edge in the tooth"),
        "delta": ("δ", "mm", "plunge of the rack"),
        "eps": ("ε", "mm", "feed along the rack"),
        "alpha": ("α", "rad", "normal pressure angle"),
        "beta": ("β", "rad", "helix angle, right hand positive"),
        "beta1": ("β1", "rad", "helix angle of the pinion"),
        "beta2": ("β2", "rad", "helix angle of the wheel"),
        "s": ("s", "-", "flank sign"),
        "m": ("m", "mm", "normal module"),
        "xm": ("x m", "mm", "profile shift"),
        "x": ("x1 + x2", "-", "sum of the profile shift coefficients"),
        "h": ("π m/4", "mm", "half width of the rack's space in the datum line"),
        "r": ("r", "mm", "reference radius"),
        "phi": ("φ", "rad", "rotation of the gear while being cut"),
        "z1": ("z1", "-", "teeth of the pinion"),
        "z2": ("z2", "-", "teeth of the wheel"),
        "c": ("c", "-", "slope of the profile modification"),
        "e": ("e", "mm", "profile modification at the datum line"),
        "a": ("a", "mm", "edge offset of the spherical family"),
        "kappa1": ("κ1", "1/mm", "curvature of the first cylinder"),
        "kappa2": ("κ2", "1/mm", "curvature of the second cylinder"),
        "chi": ("χ", "rad", "angle of the cylinders' generators"),
        "psi": ("ψ_b", "rad", "half angle of the tooth on the base circle"),
        "w": ("w", "mm", "half of the worm's axial space on its base cylinder"),
    },
)

#: A gear's size, shift at which it is cut and place on the edge and across the face, in the letters of one gear.
LETTERS = {
    "z_1": "2*r*cos(beta_pinion)/m", "shift_pinion": "(xm - A_sn_pinion*cos(alpha)/(2*sin(alpha)))/m",
    "l_pinion": "l", "z_pinion": "Z", "beta_pinion": "beta", "m": "4*h/pi",
}  # fmt: skip
#: The profile's modification and its derivatives.
PROFILE_LETTERS = {"E_pinion": "E_here", "E_pinion_l_pinion": "E_l", "E_pinion_z_pinion": "E_Z"}
#: A plunge δ and a feed ε for those of the drive, and a quadratic and a constant slope for its own functions.
PLUNGE = {"C_beta_pinion": "delta_here*b_pinion**2*sin(alpha)/(4*z_pinion**2)"}
FEED = {"C_Hbeta_pinion": "eps_here*b_pinion*cos(alpha)*cos(beta_pinion)/z_pinion"}
QUADRATIC = {"C_beta_pinion": "c*b_pinion**2*sin(alpha)/4"}
SLOPE = {"C_Hbeta_pinion": "g*b_pinion*cos(alpha)*cos(beta_pinion)"}


def gear(
    own: Mapping[str, str], profile: Mapping[str, Tree] | None = None, letters: Mapping[str, str] = LETTERS
) -> dict:
    """What the drive's page says of a gear: the rack at a place of its edge and face, its outward normal, what the
    equation of meshing is solved by; the same while the gear is being cut, and the flank in the rack's frame, in which
    the gear turns.

    ``own`` are letters of modifications of the lead, ``profile`` is that of the profile and its derivatives.
    """
    drive = Described("cylindrical_gears", {**own, **PROFILE_LETTERS, **letters})
    rolling = Described(drive.drive, {**drive.letters, "phi_gen_pinion": "phi"})
    rolled = Described(drive.drive, {**drive.letters, "phi_gen_pinion": "turn"})
    sweep, generation = drive.sweep("pinion"), drive.generation("pinion")
    return {
        **(profile or dict.fromkeys(PROFILE_LETTERS.values(), 0)),
        "rack": drive.carried(sweep, drive.edge("pinion")),
        "outward": drive.normal("pinion"),
        "turn": drive.solved("pinion"),
        "free": rolling.carried(generation, "rack"),
        "turned": rolling.matrix(generation),
        "body": rolled.carried(generation[1:], "rack"),
    }


ROLLED = """
k = vec(0, 0, 1)
X = rack.x
Y = rack.y
n = s*cross(d(rack, Z), d(rack, l))
n_free = turned@n
slope = d(X, l)/d(Y, l)
gear_l = d(body, l) + d(turn, l)*cross(k, body)
gear_Z = d(body, Z) + d(turn, Z)*cross(k, body)
undercut = r*d(Y, l) + X*(d(Y, l) + d(X, l)**2/d(Y, l)) + X**2*d(slope, l)
"""

#: Any modification of the profile, plunge and feed.
MODIFIED = scope(
    "cylindrical_gears",
    ROLLED,
    jets={"E": ("l", "Z"), "delta": ("Z",), "eps": ("Z",)},
    signs=["s"],
    described=lambda: {"delta_here": ("jet", "delta", 0), "eps_here": ("jet", "eps", 0)}
    | gear(
        PLUNGE | FEED,
        {"E_here": ("jet", "E", 0, 0), "E_l": ("jet", "E", 1, 0), "E_Z": ("jet", "E", 0, 1)},
    ),
)

#: The drive's own crowning and slope of the lead.
OWN_LEAD = scope(
    "cylindrical_gears.own-lead",
    ROLLED,
    jets={"E": ("l", "Z")},
    signs=["s"],
    described=lambda: gear(
        QUADRATIC | SLOPE, {"E_here": ("jet", "E", 0, 0), "E_l": ("jet", "E", 1, 0), "E_Z": ("jet", "E", 0, 1)}
    ),
)

UNMODIFIED = {"C_beta_pinion": "0", "C_Hbeta_pinion": "0"}
DRIVE = Described("cylindrical_gears", LETTERS)
NORMAL = "normal = vec(sin(alpha), s*cos(alpha)*cos(beta), -s*cos(alpha)*sin(beta))\n"

INVOLUTE = scope(
    "cylindrical_gears.involute",
    ROLLED
    + NORMAL
    + """
cos_b = sqrt(sin(alpha)**2 + cos(alpha)**2*cos(beta)**2)
cos_t = cos(alpha)*cos(beta)/cos_b
sin_t = sin(alpha)/cos_b
p = r*cos(beta)/sin(beta)
rho = r*sin_t + X/sin_t
tangent = mat([cos_t, s*sin_t, 0], [-s*sin_t, cos_t, 0], [0, 0, 1])
""",
    signs=["s"],
    described=lambda: gear(UNMODIFIED)
    | {
        "r_b": DRIVE.size("pinion_base_radius_mm"),
        "sine_of_base_helix": DRIVE.arc_of_size("pinion_base_helix_angle_deg")[0],
        "tangent_over": DRIVE.arc_of_size("pinion_transverse_pressure_angle_deg")[0],
        "tangent_under": DRIVE.arc_of_size("pinion_transverse_pressure_angle_deg")[1],
    },
)

#: The worm whose profile angle is a; the same base radius and screw parameter.
ZI = tool(
    "zi",
    {"tan(lambda_worm)": "p/r_worm"},
    {"r_b_worm": "r_b", "a_t_worm": "a", "a_t_pitch_worm": "ap", "t_worm": "r_b/cos(a)"},
)

#: The same flank in its two fundamental forms; ``linear`` is its turn in the radius of curvature and across the face.
CURVED = scope(
    "cylindrical_gears.curved",
    """
normal_l = d(turn, l)*cross(k, normal)
normal_Z = d(turn, Z)*cross(k, normal)
E1 = dot(gear_l, gear_l)
F1 = dot(gear_l, gear_Z)
G1 = dot(gear_Z, gear_Z)
L2 = -dot(gear_l, normal_l)
M2 = -dot(gear_l, normal_Z)
N2 = -dot(gear_Z, normal_Z)
turn_a = mat([cos(a), -s*sin(a), 0], [s*sin(a), cos(a), 0], [0, 0, 1])
linear = s*(psi - sin(a)/cos(a)) + Z/p
w = S/(2*cos(lam)) + p*(ap - sin(ap)/cos(ap))
""",
    extends=INVOLUTE,
    described=lambda: {"worm": ZI.edge("pinion")},
)

PAIR = Described(
    "cylindrical_gears",
    {"z_1": "z1", "z_2": "z2", "beta_pinion": "beta1", "beta_wheel": "beta2", "Sigma": "beta1 + beta2", "dh": "0",
     "dv": "0"},
)  # fmt: skip
PARALLEL = Described("cylindrical_gears", {"z_1": "z1", "z_2": "z2", "beta_pinion": "beta", "beta_wheel": "-beta"})

PROFILE = scope(
    "cylindrical_gears.profile",
    ROLLED,
    jets={"E": ("l",)},
    signs=["s"],
    described=lambda: gear(UNMODIFIED, {"E_here": ("jet", "E", 0), "E_l": ("jet", "E", 1), "E_Z": 0})
    | {
        "r1": PARALLEL.size("pinion_reference_radius_mm"),
        "r2": PARALLEL.size("wheel_reference_radius_mm"),
    },
)

CROWNED = scope(
    "cylindrical_gears.crowned",
    ROLLED
    + NORMAL
    + """
straight = l*cos(alpha) + xm
ratio = -s*cos(alpha)*cos(beta)/sin(alpha)
cos_b = sqrt(1 - (sin(beta)*cos(alpha))**2)
""",
    signs=["s"],
    described=lambda: gear(QUADRATIC | {"C_Hbeta_pinion": "0"}),
)

SLOPED = scope(
    "cylindrical_gears.sloped",
    "E_here = c*l + e\nE_l = c\n" + ROLLED,
    signs=["s"],
    described=lambda: gear({"C_beta_pinion": "0"} | SLOPE, {"E_Z": 0}),
)

#: The other flank of the other hand; the edge farther on, plunged; the edge fed instead; a spur gear's edge.
OTHER = {**LETTERS, "beta_pinion": "-beta", "s": "-s"}
FARTHER = {**LETTERS, "l_pinion": "l + delta/cos(alpha)"}
SPUR = Described("spherical_convex_spur", {"l_wheel": "l + a_wheel/cos(alpha)", "b_wheel": "h", "a_wheel": "a"})
EDGES = scope(
    "cylindrical_gears.edges",
    """
delta_here = delta
eps_here = delta*sin(alpha)/cos(alpha)/cos(beta)
reflect = mat([1, 0, 0], [0, -1, 0], [0, 0, 1])
""",
    signs=["s"],
    described=lambda: {
        **dict.fromkeys(PROFILE_LETTERS.values(), 0),
        "rack": gear(UNMODIFIED)["rack"],
        "mirrored": gear(UNMODIFIED, letters=OTHER)["rack"],
        "plunged": gear(PLUNGE | {"C_Hbeta_pinion": "0"}, letters=FARTHER)["rack"],
        "fed": gear(FEED | {"C_beta_pinion": "0"})["rack"],
        "edge": Described("cylindrical_gears", {**UNMODIFIED, **PROFILE_LETTERS, **LETTERS, "shift_pinion": "0",
                                                "A_sn_pinion": "0", "beta_pinion": "0"}).edge("pinion"),
        "spur": SPUR.edge("wheel"),
    },
)  # fmt: skip

CROSSED = scope(
    "cylindrical_gears.crossed",
    """
k = vec(0, 0, 1)
n = cos(beta1)*outward_1
n_wheel = cos(beta2)*outward_2
tan_1 = sin(alpha)/(cos(alpha)*cos(beta1))
tan_2 = sin(alpha)/(cos(alpha)*cos(beta2))
A = r1 + r2 + x*m
length = cos(alpha)*(r1*cos(beta1)*tan_1 + r2*cos(beta2)*tan_2 + x*m*sin(alpha)/cos(alpha))
""",
    signs=["s"],
    described=lambda: {
        **dict.fromkeys(("E_l", "E_Z"), 0),
        "outward_1": Described(PAIR.drive, {**UNMODIFIED, **PROFILE_LETTERS, **PAIR.letters}).normal("pinion"),
        "outward_2": Described(
            PAIR.drive,
            {
                "C_beta_wheel": "0",
                "C_Hbeta_wheel": "0",
                "E_wheel_l_wheel": "E_l",
                "E_wheel_z_wheel": "E_Z",
                **PAIR.letters,
            },
        ).normal("wheel"),
        "k2": PAIR.turned(PAIR.motion("wheel")[:-2], "k"),
        "r1": PAIR.size("pinion_reference_radius_mm"),
        "r2": PAIR.size("wheel_reference_radius_mm"),
    },
)

CYLINDERS = scope(
    "cylindrical_gears.cylinders",
    """
root = sqrt(kappa1**2 + kappa2**2 + 2*kappa1*kappa2*cos(2*chi))
least = (kappa1 + kappa2 - root)/2
most = (kappa1 + kappa2 + root)/2
K = mat([kappa1 + kappa2*cos(chi)**2, kappa2*cos(chi)*sin(chi)], [kappa2*cos(chi)*sin(chi), kappa2*sin(chi)**2])
""",
)

#: Conditions of every modified rack.
REGULAR = """where: ∂Y/∂l ≠ 0: sin α + E′ cos α ≠ 0
where: r ≠ 0
where: cos β ≠ 0"""

CLAIMS = identities(
    f"""
outward | description | OWN_LEAD
The description's outward normal of the rack, with any modification of the profile and the drive's crowning and slope of
the lead, is its normal.
    outward = n
where: cos β ≠ 0

meshing | equation of meshing | MODIFIED
The velocity in the description's rolling is (rφ − Y, X, 0) in the rack: the equation of meshing for every modification,
plunge and feed.
    dot(n_free, d(free, phi)) = (r*phi - Y)*n.x + X*n.y
where: r ≠ 0
where: cos β ≠ 0

explicit | generation | MODIFIED
The turn by which the description solves it. It needs the profile's slope in the same section alone.
    (r*turn - Y)*n.x + X*n.y = 0
    n.x*d(X, l) + n.y*d(Y, l) = 0
{REGULAR}

tangent | gear normal | MODIFIED
The rack's normal, turned with the gear, is the normal of the modified gear flank; written in the rack's frame, in which
the gear turns.
    dot(n, gear_l) = 0
    dot(n, gear_Z) = 0
{REGULAR}

undercut | undercut | MODIFIED
For every modification the flank is singular exactly where r Y′ + X(Y′ + X′²/Y′) + X²(X′/Y′)′ = 0, primes at a fixed
section.
    triple(gear_l, gear_Z, n) = -s*dot(n, n)*undercut/(r*d(Y, l))
{REGULAR}

limit | undercut | INVOLUTE
Without modifications that is X = −r sin² α_t.
    undercut = -s*(X + r*sin_t**2)/(sin_t**2*cos(beta))*sin(alpha)
where: sin α ≠ 0
where: cos β ≠ 0

involute | involute helicoid | INVOLUTE
Rolling a straight edge gives R = Rz(θ)(r_b, sϱ, Z): the involute of the base circle in every section. The turn is
linear in ϱ and Z, θ = turn − s α_t.
    tangent@vec(r_b, s*rho, Z) = body
    r*turn = s*(h/cos(beta) + xm*sin(alpha)/(cos(alpha)*cos(beta)) + r*sin_t/cos_t - rho*r/r_b) + Z*sin(beta)/cos(beta)
where: sin α ≠ 0
where: cos α ≠ 0
where: cos β ≠ 0

base-helix | involute helicoid | INVOLUTE
sin β_b = sin β cos α, tan β_b = tan β cos α_t and cos α_t cos β_b = cos α cos β agree.
    sine_of_base_helix = sin(beta)*cos(alpha)
    sin(beta)*cos(alpha)/cos_b = sin(beta)/cos(beta)*cos_t
    tangent_over*cos_t = tangent_under*sin_t
    r_b = r*cos_t
    sine_of_base_helix**2 + cos_b**2 = 1
    cos_t*cos_b = cos(alpha)*cos(beta)
    cos_t**2 + sin_t**2 = 1
where: cos β_b ≠ 0

normal | involute helicoid | INVOLUTE
The unmodified rack has one normal, a unit vector.
    n = normal/cos(beta)
    outward = normal/cos(beta)
    dot(normal, normal) = 1
where: cos β ≠ 0

moment | no transmission error | INVOLUTE
Every flank normal has the moment s (m z/2) cos α about the gear's axis, r cos β = m z/2: it touches the base cylinder.
Hence z1 ω1 = z2 ω2 at any contact, for any position of the axes, with a fixed common normal.
    dot(normal, cross(k, body)) = s*r*cos(beta)*cos(alpha)
    r*cos(beta)*cos(alpha) = r_b*cos_b
where: sin α ≠ 0
where: cos β ≠ 0

screw | involute helicoid | INVOLUTE
The flank moves along itself: n·(k × R + p k) = 0 with p = r/tan β.
    dot(normal, cross(k, body) + p*k) = 0
where: sin α ≠ 0
where: sin β ≠ 0

curvature | relative curvature | CURVED
The flank is developable: Gauss's curvature is 0, and its mean curvature H half of the other principal one, -cos β_b/ϱ
along the outward normal.
    L2*N2 - M2**2 = 0
    (E1*N2 - 2*F1*M2 + G1*L2)*rho = -cos_b*(E1*G1 - F1**2)
where: sin α ≠ 0
where: cos β ≠ 0
where: ϱ ≠ 0

zi-worm | involute helicoid | CURVED
It is the ZI worm of the lead angle 90° − β, turned about its axis: ϱ = r_b tan a at the profile angle a, the same base
radius, and in screw motion the same height.
    turn_a@worm - worm.z*k = vec(r_b, s*r_b*sin(a)/cos(a), 0)
    worm.z + p*(linear + s*a) = Z + s*(w + p*psi)
    r_b**2*(1 + (sin(alpha)/(cos(alpha)*cos(beta)))**2) = r**2
where: cos a ≠ 0
where: cos α ≠ 0
where: sin β ≠ 0

screw-symmetry | profile modifications | PROFILE
With modifications of the profile alone every transverse section is the same, turned by Z tan β/r: on parallel axes
contact runs along the face at constant l and the transmission error is constant.
    d(body, Z) = k
    r*d(turn, Z) = sin(beta)/cos(beta)
    d(n, Z) = vec(0, 0, 0)
    z1/r1 = z2/r2
{REGULAR}

parallel-crowned | lead crowning | CROWNED
A plunge c Z² leaves point, turn and normal in the middle of the face as they are to first order, for every l: parallel
gears touch there, without transmission error. Along the generator, which crosses the face by cos β_b in unit length, it
falls back from the normal by 2 c sin α cos² β_b.
    body - vec(straight + r, -ratio*straight, Z) = -c*Z**2*vec(1, -ratio, 0)
    r*turn = Y + straight*ratio - c*Z**2*ratio
    n = normal/cos(beta) + 2*c*Z*sin(alpha)/cos(beta)*k
    dot(normal, vec(1, -ratio, 0))*sin(alpha) = cos_b**2
where: sin α ≠ 0
where: cos β ≠ 0

slopes | slope corrections | SLOPED
A constant slope of profile or lead leaves one rack normal and with it an exact involute helicoid.
    d(n, l) = vec(0, 0, 0)
    d(n, Z) = vec(0, 0, 0)
    dot(n, cross(k, body)) = r*n.y
{REGULAR}

plunge | lead crowning | EDGES
A plunge δ and a feed δ tan α/cos β move a straight edge into the same line: they cut the same flank.
    plunged = fed
where: cos α ≠ 0
where: cos β ≠ 0

mirror | mirror image | EDGES
The other flank of the gear of the other hand is the mirror image y → −y.
    mirrored = reflect@rack
where: cos β ≠ 0

spur-limit | spherical family | EDGES
With β = 0 and x = 0 the edge is that of a spur gear of the spherical family, counted from its datum line.
    spur = edge
where: cos α ≠ 0

common-normal | crossed axes | CROSSED
At Σ = β1 + β2 the common normal has the rack's pressure angle, whatever the centre distance.
    dot(n, n) = 1
    dot(n, k) = -s*sin(beta1)*cos(alpha)
    dot(n_wheel, n_wheel) = 1
    dot(n, k2) = -dot(n_wheel, k)
    dot(n, k2) = s*sin(beta2)*cos(alpha)

zero-backlash | crossed axes | CROSSED
There the lengths that both involutes roll off add up to A sin α for A = r1 + r2 + (x1 + x2) m.
    length = A*sin(alpha)
where: cos α ≠ 0
where: cos β1 ≠ 0
where: cos β2 ≠ 0

cylinders | relative curvature | CYLINDERS
Of any two crossed cylinders, not read from the drive: these are the principal relative curvatures, by their sum and
their product.
    least + most = entry(K, 1, 1) + entry(K, 2, 2)
    least*most = entry(K, 1, 1)*entry(K, 2, 2) - entry(K, 1, 2)**2
    least*most = kappa1*kappa2*sin(chi)**2
""",
    globals(),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
