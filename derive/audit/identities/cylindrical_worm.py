"""Cylindrical worm drives.

Explicit wheel, contact, limit points and meshing axes at any shaft angle, for every profile.
"""

from derive.audit.claims import Document, scope
from derive.audit.identities.conventions import identity
from derive.audit.ledger import Chapter

DOCUMENT = Document(
    key="cylindrical_worm",
    name="cylindrical worm drives",
    file="derive/drives/cylindrical_worm.py",
    sha256="",
    about="Worm and wheel cut by a hob of any flank form. The fixed cutting frame has the hob's axis as z and the "
    "wheel's axis (0, sin Σ, cos Σ) through (A, 0, 0).",
    symbols={
        "t": ("t", "mm or rad", "profile parameter of the hob"),
        "psi": ("ψ", "rad", "screw angle of the hob"),
        "phi": ("φh", "rad", "rotation of the hob"),
        "phi2": ("φ2", "rad", "rotation of the blank"),
        "m": ("m", "-", "ratio of blank to hob"),
        "p": ("p", "mm/rad", "screw parameter"),
        "A": ("A", "mm", "cutting centre distance"),
        "Sigma": ("Σ", "rad", "cutting shaft angle"),
        "x": ("x", "mm", "point in the cutting frame"),
        "y": ("y", "mm", "point in the cutting frame"),
        "z": ("z", "mm", "point in the cutting frame"),
        "nx": ("nx", "-", "normal in the cutting frame"),
        "ny": ("ny", "-", "normal in the cutting frame"),
        "nz": ("nz", "-", "normal in the cutting frame"),
        "tau": ("τ", "-", "worm's share of the twist"),
    },
)

HOBBING = scope(
    "cylindrical_worm",
    """
i = vec(1, 0, 0)
k = vec(0, 0, 1)
k2 = vec(0, sin(Sigma), cos(Sigma))
P = vec(Px, Py, Pz)
hob = Rz(psi)@P + vec(0, 0, p*psi)
n_hob = cross(d(hob, t), d(hob, psi))
r = Rz(phi)@hob
n = Rz(phi)@n_hob
wheel = Rz(phi2)@(Rx(Sigma)@(r - A*i))
n_wheel = Rz(phi2)@(Rx(Sigma)@n)
f = dot(n, cross(k, r) + m*cross(k2, r - A*i))
D = -m*k2 - k + tau*k
W = cross(-m*k2, -A*i) + tau*p*k
""",
    jets={"Px": ("t",), "Py": ("t",), "Pz": ("t",)},
)

EXPLICIT = scope(
    "cylindrical_worm.explicit",
    """
p = -(x*ny - y*nx)/nz
z = ((p*nz/m - ny*cos(Sigma)*(x - A) + nz*sin(Sigma)*(x - A))/nx + cos(Sigma)*y)/sin(Sigma)
r = vec(x, y, z)
n = vec(nx, ny, nz)
k = vec(0, 0, 1)
k2 = vec(0, sin(Sigma), cos(Sigma))
f = dot(n, cross(k, r) + m*cross(k2, r - vec(A, 0, 0)))
""",
)

ANY = scope(
    "cylindrical_worm.contact",
    """
t1 = vec(a1, a2, a3)
t2 = vec(b1, b2, b3)
n2 = vec(c1, c2, c3)
R_l = vec(a1, a2, a3)
R_psi = vec(b1, b2, b3)
R_phi = vec(c1, c2, c3)
n = vec(e1, e2, e3)
phi_l = -f_l/f_phi
phi_psi = -f_psi/f_phi
D = vec(0, Dy, Dz)
W = vec(0, Wy, Wz)
q = vec((Dy*Wz - Dz*Wy)/(Dy**2 + Dz**2), 0, 0)
""",
)

CLAIMS = (
    identity(
        "meshing",
        "equation of meshing",
        "Velocity form and derivative form are the same function, at any shaft angle and for every profile.",
        "f = dot(n_wheel, d(wheel, (phi, 1), (phi2, m)))",
        HOBBING,
    ),
    identity(
        "normal",
        "wheel normal",
        "The hob's normal stays perpendicular to the hob's tangents in the wheel's frame.",
        ["dot(n_wheel, d(wheel, t)) = 0", "dot(n_wheel, d(wheel, psi)) = 0"],
        HOBBING,
    ),
    identity(
        "sum-angle",
        "reduction",
        "Meshing does not change when ψ and φh change by opposite amounts, but for the height z = P_z + pψ: only "
        "their sum and z matter.",
        "d(f, (psi, 1), (phi, -1)) = m*p*dot(n, cross(k2, k))",
        HOBBING,
    ),
    identity(
        "explicit",
        "reduction",
        "The equation of meshing is linear in z; with this z it vanishes. The relation n·(k × r) = -p n_z of every "
        "helicoid defines p here.",
        "f = 0",
        EXPLICIT,
        conditions=["n_x ≠ 0 (beyond it lies the spurious sheet)", "sin Σ ≠ 0"],
    ),
    identity(
        "linear",
        "reduction",
        "The slope in z is -m n_x sin Σ, so the solution is unique where it is not 0.",
        "d(dot(vec(nx, ny, nz), cross(k, vec(x, y, zz)) + m*cross(k2, vec(x, y, zz) - vec(A, 0, 0))), zz) = "
        "m*nx*sin(Sigma)",
        EXPLICIT,
    ),
    identity(
        "contact",
        "contact",
        "n2 perpendicular to both tangents of the other surface is the same as n2 parallel to its normal: two scalar "
        "equations for the papers' three.",
        "cross(n2, cross(t1, t2)) = t1*dot(n2, t2) - t2*dot(n2, t1)",
        ANY,
        conditions=["t1 × t2 ≠ 0"],
    ),
    identity(
        "undercut",
        "limit of the wheel flank",
        "The singular function of the explicit surface is the division-free one of the three-parameter surface over "
        "f_φ.",
        "dot(cross(R_l + phi_l*R_phi, R_psi + phi_psi*R_phi), n)*f_phi = dot(n, f_phi*cross(R_l, R_psi) + "
        "f_l*cross(R_psi, R_phi) + f_psi*cross(R_phi, R_l))",
        ANY,
        conditions=["f_φ ≠ 0"],
    ),
    identity(
        "twist",
        "meshing axes",
        "Adding any share τ of the worm's screw motion to the relative motion does not change meshing.",
        "dot(n, cross(D, r) + W) = -f",
        HOBBING,
    ),
    identity(
        "axis",
        "meshing axes",
        "Where D·W = 0 that motion is a rotation about the line through q of direction D: every contact normal meets "
        "it.",
        "W - cross(q, D) = dot(D, W)/(Dy**2 + Dz**2)*D",
        ANY,
        conditions=["D ≠ 0", "D·W = 0"],
    ),
    identity(
        "axis-quadratic",
        "meshing axes",
        "D·W is the quadratic in τ whose real roots give the meshing axes.",
        "dot(D, W) = p*tau**2 - (p + p*m*cos(Sigma) + A*m*sin(Sigma))*tau + A*m*sin(Sigma)",
        HOBBING,
    ),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
