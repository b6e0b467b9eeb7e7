"""Cylindrical gears: generation by a modified rack, the involute helicoid, undercut, pairs on crossed axes."""

from derive.audit.claims import Document, scope
from derive.audit.described import Described
from derive.audit.identities.conventions import identity
from derive.audit.ledger import Chapter

DOCUMENT = Document(
    key="cylindrical_gears",
    name="cylindrical gears",
    file="derive/drives/cylindrical_gears.py",
    sha256="",
    about="A straight edge with any modification E(l, Z), a plunge δ(Z) and a feed ε(Z) traverses the face along the "
    "trace of a helical rack; the gear rolls on it. Index 1 is the pinion, 2 the wheel.",
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

ROLLED = """
n = s*cross(d(rack, Z), d(rack, l))
slope = d(X, l)/d(Y, l)
turn = (Y + X*slope)/r
body = vec(X + r, Y - r*turn, Z)
gear_l = d(body, l) + d(turn, l)*cross(k, body)
gear_Z = d(body, Z) + d(turn, Z)*cross(k, body)
free = Rz(phi)@vec(X + r, Y - r*phi, Z)
n_free = Rz(phi)@n
undercut = r*d(Y, l) + X*(d(Y, l) + d(X, l)**2/d(Y, l)) + X**2*d(slope, l)
"""

MODIFIED = scope(
    "cylindrical_gears",
    """
k = vec(0, 0, 1)
X = l*cos(alpha) - E*sin(alpha) + xm - delta
Y = s*((h - l*sin(alpha) - E*cos(alpha))/cos(beta) - eps) + Z*sin(beta)/cos(beta)
rack = vec(X, Y, Z)
"""
    + ROLLED,
    jets={"E": ("l", "Z"), "delta": ("Z",), "eps": ("Z",)},
    signs=["s"],
)

#: A gear's own modifications, plunge and feed as the letters of their functions.
DRIVE = Described(
    "cylindrical_gears",
    {
        "z_1": "2*r*cos(beta_pinion)/m", "E_pinion": "E_here", "shift_pinion": "xm/m", "l_pinion": "l",
        "C_beta_pinion": "delta_here*b_pinion**2*sin(alpha)/(4*z_pinion**2)",
        "C_Hbeta_pinion": "eps_here*b_pinion*cos(alpha)*cos(beta_pinion)/z_pinion", "z_pinion": "Z",
        "beta_pinion": "beta", "phi_gen_pinion": "phi", "m": "4*h/pi",
    },
)  # fmt: skip

DESCRIBED = scope(
    "cylindrical_gears.described",
    "",
    described={
        "E_here": ("jet", "E", 0, 0),
        "delta_here": ("jet", "delta", 0),
        "eps_here": ("jet", "eps", 0),
        "edge": DRIVE.edge("pinion"),
        "traced": DRIVE.carried(DRIVE.sweep("pinion"), "edge"),
        "cut": DRIVE.carried(DRIVE.generation("pinion"), "traced"),
    },
    extends=MODIFIED,
)

INVOLUTE = scope(
    "cylindrical_gears.involute",
    """
k = vec(0, 0, 1)
X = l*cos(alpha) + xm
Y = s*(h - l*sin(alpha))/cos(beta) + Z*sin(beta)/cos(beta)
rack = vec(X, Y, Z)
normal = vec(sin(alpha), s*cos(alpha)*cos(beta), -s*cos(alpha)*sin(beta))
cos_b = sqrt(1 - (sin(beta)*cos(alpha))**2)
cos_t = cos(alpha)*cos(beta)/cos_b
sin_t = sin(alpha)/cos_b
r_b = r*cos_t
p = r*cos(beta)/sin(beta)
rho = r*sin_t + X/sin_t
tangent = mat([cos_t, s*sin_t, 0], [-s*sin_t, cos_t, 0], [0, 0, 1])
"""
    + ROLLED,
    signs=["s"],
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
worm_height = s*(w + p*(sin(a)/cos(a) - a))
""",
    extends=INVOLUTE,
)

PROFILE = scope(
    "cylindrical_gears.profile",
    """
k = vec(0, 0, 1)
X = l*cos(alpha) - E*sin(alpha) + xm
Y = s*(h - l*sin(alpha) - E*cos(alpha))/cos(beta) + Z*sin(beta)/cos(beta)
rack = vec(X, Y, Z)
r1 = m*z1/(2*cos(beta))
r2 = m*z2/(2*cos(beta))
"""
    + ROLLED,
    jets={"E": ("l",)},
    signs=["s"],
)

CROWNED = scope(
    "cylindrical_gears.crowned",
    """
k = vec(0, 0, 1)
X = l*cos(alpha) + xm - c*Z**2
Y = s*(h - l*sin(alpha))/cos(beta) + Z*sin(beta)/cos(beta)
rack = vec(X, Y, Z)
normal = vec(sin(alpha), s*cos(alpha)*cos(beta), -s*cos(alpha)*sin(beta))
straight = l*cos(alpha) + xm
ratio = -s*cos(alpha)*cos(beta)/sin(alpha)
cos_b = sqrt(1 - (sin(beta)*cos(alpha))**2)
"""
    + ROLLED,
    signs=["s"],
)

SLOPED = scope(
    "cylindrical_gears.sloped",
    """
k = vec(0, 0, 1)
E = c*l + e
X = l*cos(alpha) - E*sin(alpha) + xm
Y = s*(h - l*sin(alpha) - E*cos(alpha))/cos(beta) + Z*(sin(beta)/cos(beta) - s*g)
rack = vec(X, Y, Z)
"""
    + ROLLED,
    signs=["s"],
)

EDGES = scope(
    "cylindrical_gears.edges",
    """
X = l*cos(alpha) + xm
Y = s*(h - l*sin(alpha))/cos(beta) + Z*sin(beta)/cos(beta)
mirrored = -s*(h - l*sin(alpha))/cos(-beta) + Z*sin(-beta)/cos(-beta)
moved = l + delta/cos(alpha)
X_moved = moved*cos(alpha) + xm - delta
Y_moved = s*(h - moved*sin(alpha))/cos(beta) + Z*sin(beta)/cos(beta)
Y_fed = s*((h - l*sin(alpha))/cos(beta) - delta*sin(alpha)/cos(alpha)/cos(beta)) + Z*sin(beta)/cos(beta)
along = l + a/cos(alpha)
""",
    signs=["s"],
)

CROSSED = scope(
    "cylindrical_gears.crossed",
    """
k = vec(0, 0, 1)
k2 = vec(0, sin(beta1 + beta2), cos(beta1 + beta2))
n = vec(sin(alpha), s*cos(alpha)*cos(beta1), -s*cos(alpha)*sin(beta1))
tan_1 = sin(alpha)/(cos(alpha)*cos(beta1))
tan_2 = sin(alpha)/(cos(alpha)*cos(beta2))
r1 = m*z1/(2*cos(beta1))
r2 = m*z2/(2*cos(beta2))
A = r1 + r2 + x*m
length = m*cos(alpha)*(z1*tan_1/2 + z2*tan_2/2 + x*sin(alpha)/cos(alpha))
""",
    signs=["s"],
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

REGULAR = ["∂Y/∂l ≠ 0: sin α + E′ cos α ≠ 0", "r ≠ 0", "cos β ≠ 0"]

CLAIMS = (
    identity(
        "described",
        "description",
        "The rack's edge, with any modification, plunge and feed, and its rolling on the reference circle are those "
        "of the drive's description.",
        ["traced = rack", "cut = free"],
        DESCRIBED,
        conditions=["cos β ≠ 0"],
    ),
    identity(
        "meshing",
        "equation of meshing",
        "The velocity in rolling is (rφ − Y, X, 0) in the rack: the equation of meshing for every modification.",
        "dot(n_free, d(free, phi)) = (r*phi - Y)*n.x + X*n.y",
        MODIFIED,
        conditions=REGULAR[1:],
    ),
    identity(
        "explicit",
        "generation",
        "The turn that solves it is explicit. It needs the profile's slope in the same section alone.",
        ["(r*turn - Y)*n.x + X*n.y = 0", "n.x*d(X, l) + n.y*d(Y, l) = 0"],
        MODIFIED,
        conditions=REGULAR,
    ),
    identity(
        "tangent",
        "gear normal",
        "The rack's normal, turned with the gear, is the normal of the modified gear flank; written in the rack's "
        "frame, in which the gear turns.",
        ["dot(n, gear_l) = 0", "dot(n, gear_Z) = 0"],
        MODIFIED,
        conditions=REGULAR,
    ),
    identity(
        "undercut",
        "undercut",
        "For every modification the flank is singular exactly where r Y′ + X(Y′ + X′²/Y′) + X²(X′/Y′)′ = 0, primes at "
        "a fixed section.",
        "triple(gear_l, gear_Z, n) = -s*dot(n, n)*undercut/(r*d(Y, l))",
        MODIFIED,
        conditions=REGULAR,
    ),
    identity(
        "limit",
        "undercut",
        "Without modifications that is X = −r sin² α_t.",
        "undercut = -s*(X + r*sin_t**2)/(sin_t**2*cos(beta))*sin(alpha)",
        INVOLUTE,
        conditions=["sin α ≠ 0", "cos β ≠ 0"],
    ),
    identity(
        "involute",
        "involute helicoid",
        "Rolling a straight edge gives R = Rz(θ)(r_b, sϱ, Z): the involute of the base circle in every section. The "
        "turn is linear in ϱ and Z, θ = turn − s α_t.",
        [
            "tangent@vec(r_b, s*rho, Z) = body",
            "r*turn = s*(h/cos(beta) + xm*sin(alpha)/(cos(alpha)*cos(beta)) + r*sin_t/cos_t - rho*r/r_b)"
            " + Z*sin(beta)/cos(beta)",
        ],
        INVOLUTE,
        conditions=["sin α ≠ 0", "cos α ≠ 0", "cos β ≠ 0"],
    ),
    identity(
        "base-helix",
        "involute helicoid",
        "sin β_b = sin β cos α, tan β_b = tan β cos α_t and cos α_t cos β_b = cos α cos β agree.",
        [
            "sin(beta)*cos(alpha)/cos_b = sin(beta)/cos(beta)*cos_t",
            "cos_t*cos_b = cos(alpha)*cos(beta)",
            "cos_t**2 + sin_t**2 = 1",
        ],
        INVOLUTE,
        conditions=["cos β_b ≠ 0"],
    ),
    identity(
        "normal",
        "involute helicoid",
        "The unmodified rack has one normal, a unit vector.",
        ["n = normal/cos(beta)", "dot(normal, normal) = 1"],
        INVOLUTE,
        conditions=["cos β ≠ 0"],
    ),
    identity(
        "moment",
        "no transmission error",
        "Every flank normal has the moment s (m z/2) cos α about the gear's axis, r cos β = m z/2: it touches the base "
        "cylinder. Hence z1 ω1 = z2 ω2 at any contact, for any position of the axes, with a fixed common normal.",
        ["dot(normal, cross(k, body)) = s*r*cos(beta)*cos(alpha)", "r*cos(beta)*cos(alpha) = r_b*cos_b"],
        INVOLUTE,
        conditions=["sin α ≠ 0", "cos β ≠ 0"],
    ),
    identity(
        "screw",
        "involute helicoid",
        "The flank moves along itself: n·(k × R + p k) = 0 with p = r/tan β.",
        "dot(normal, cross(k, body) + p*k) = 0",
        INVOLUTE,
        conditions=["sin α ≠ 0", "sin β ≠ 0"],
    ),
    identity(
        "curvature",
        "relative curvature",
        "The flank is developable: Gauss's curvature is 0, and its mean curvature H half of the other principal one, "
        "-cos β_b/ϱ along the outward normal.",
        [
            "L2*N2 - M2**2 = 0",
            "(E1*N2 - 2*F1*M2 + G1*L2)*rho = -cos_b*(E1*G1 - F1**2)",
        ],
        CURVED,
        conditions=["sin α ≠ 0", "cos β ≠ 0", "ϱ ≠ 0"],
    ),
    identity(
        "zi-worm",
        "involute helicoid",
        "It is the ZI worm of the lead angle 90° − β, turned about its axis: ϱ = r_b tan a at the profile angle a, the "
        "same base radius, and in screw motion the same height.",
        [
            "turn_a@vec(r_b/cos(a), 0, 0) = vec(r_b, s*r_b*sin(a)/cos(a), 0)",
            "worm_height + p*(linear + s*a) = Z + s*(w + p*psi)",
            "r_b**2*(1 + (sin(alpha)/(cos(alpha)*cos(beta)))**2) = r**2",
        ],
        CURVED,
        conditions=["cos a ≠ 0", "cos α ≠ 0", "sin β ≠ 0"],
    ),
    identity(
        "screw-symmetry",
        "profile modifications",
        "With modifications of the profile alone every transverse section is the same, turned by Z tan β/r: on "
        "parallel axes contact runs along the face at constant l and the transmission error is constant.",
        [
            "d(body, Z) = k",
            "r*d(turn, Z) = sin(beta)/cos(beta)",
            "d(n, Z) = vec(0, 0, 0)",
            "z1/r1 = z2/r2",
        ],
        PROFILE,
        conditions=REGULAR,
    ),
    identity(
        "parallel-crowned",
        "lead crowning",
        "A plunge c Z² leaves point, turn and normal in the middle of the face as they are to first order, for every "
        "l: parallel gears touch there, without transmission error. Along the generator, which crosses the face by "
        "cos β_b in unit length, it falls back from the normal by 2 c sin α cos² β_b.",
        [
            "body - vec(straight + r, -ratio*straight, Z) = -c*Z**2*vec(1, -ratio, 0)",
            "r*turn = Y + straight*ratio - c*Z**2*ratio",
            "n = normal/cos(beta) + 2*c*Z*sin(alpha)/cos(beta)*k",
            "dot(normal, vec(1, -ratio, 0))*sin(alpha) = cos_b**2",
        ],
        CROWNED,
        conditions=["sin α ≠ 0", "cos β ≠ 0"],
    ),
    identity(
        "slopes",
        "slope corrections",
        "A constant slope of profile or lead leaves one rack normal and with it an exact involute helicoid.",
        ["d(n, l) = vec(0, 0, 0)", "d(n, Z) = vec(0, 0, 0)", "dot(n, cross(k, body)) = r*n.y"],
        SLOPED,
        conditions=REGULAR,
    ),
    identity(
        "plunge",
        "lead crowning",
        "A plunge δ and a feed δ tan α/cos β move a straight edge into the same line: they cut the same flank.",
        ["X_moved = X", "Y_moved = Y_fed"],
        EDGES,
        conditions=["cos α ≠ 0", "cos β ≠ 0"],
    ),
    identity(
        "mirror",
        "mirror image",
        "The other flank of the gear of the other hand is the mirror image y → −y.",
        "mirrored = -Y",
        EDGES,
        conditions=["cos β ≠ 0"],
    ),
    identity(
        "spur-limit",
        "spherical family",
        "With β = 0 and x = 0 the edge is that of a spur gear of the spherical family, counted from its datum line.",
        [
            "along*cos(alpha) - a = l*cos(alpha)",
            "h + a*sin(alpha)/cos(alpha) - along*sin(alpha) = h - l*sin(alpha)",
        ],
        EDGES,
        conditions=["cos α ≠ 0"],
    ),
    identity(
        "common-normal",
        "crossed axes",
        "At Σ = β1 + β2 the common normal has the rack's pressure angle, whatever the centre distance.",
        [
            "dot(n, n) = 1",
            "dot(n, k) = -s*sin(beta1)*cos(alpha)",
            "dot(n, k2) = s*sin(beta2)*cos(alpha)",
        ],
        CROSSED,
    ),
    identity(
        "zero-backlash",
        "crossed axes",
        "There the lengths that both involutes roll off add up to A sin α for A = r1 + r2 + (x1 + x2) m.",
        "length = A*sin(alpha)",
        CROSSED,
        conditions=["cos α ≠ 0", "cos β1 ≠ 0", "cos β2 ≠ 0"],
    ),
    identity(
        "cylinders",
        "relative curvature",
        "Two crossed cylinders have these principal relative curvatures: their sum and their product.",
        [
            "least + most = entry(K, 1, 1) + entry(K, 2, 2)",
            "least*most = entry(K, 1, 1)*entry(K, 2, 2) - entry(K, 1, 2)**2",
            "least*most = kappa1*kappa2*sin(chi)**2",
        ],
        CYLINDERS,
    ),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
