"""Cylindrical worm drives.

Explicit wheel, contact, limit points and meshing axes at any shaft angle, for every profile.
"""

from derive.audit.claims import Document, scope
from derive.audit.described import Described
from derive.audit.ledger import Chapter
from derive.audit.paragraphs import identities

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

#: Of any drive: its screw motions, the cutting of its wheel, its worm in mesh. Profiles stay unspecified functions.
DRIVE = Described(
    "cylindrical_worm_zn_zn",
    {
        "tan(lambda_hob)": "p/r_hob", "T_hob*phi_hob/T_2": "phi2", "A_gen": "A", "Sigma_gen": "Sigma",
        "phi_hob": "phi", "psi_hob": "psi",
    },
)  # fmt: skip
MESHED = Described(DRIVE.drive, {"tan(lambda_worm)": "p/r_worm", "psi_worm": "psi", "phi_worm": "phi1"})
CUTTING = DRIVE.generation("wheel")
PROFILE = ("vec", ("jet", "Px", 0), ("jet", "Py", 0), ("jet", "Pz", 0))

#: The fixed cutting frame is the hob's turned by its own rotation, the last factor of the motion.
HOBBING = scope(
    "cylindrical_worm",
    """
i = vec(1, 0, 0)
k = vec(0, 0, 1)
k2 = vec(0, sin(Sigma), cos(Sigma))
n_hob = cross(d(hob, t), d(hob, psi))
r = turn@hob
n = turn@n_hob
n_wheel = machine@n_hob
f = dot(n, cross(k, r) + m*cross(k2, r - A*i))
D = -m*k2 - k + tau*k
W = cross(-m*k2, -A*i) + tau*p*k
section = cross(d(P, t), vec(-Py, Px, p))
height = ((p*n.z/m - n.y*cos(Sigma)*(r.x - A) + n.z*sin(Sigma)*(r.x - A))/n.x + cos(Sigma)*r.y)/sin(Sigma)
""",
    jets={"Px": ("t",), "Py": ("t",), "Pz": ("t",)},
    described=lambda: {
        "P": PROFILE,
        "hob": DRIVE.carried(DRIVE.sweep("wheel"), "P"),
        "turn": DRIVE.matrix(CUTTING[-1:]),
        "machine": DRIVE.matrix(CUTTING),
        "wheel": DRIVE.carried(CUTTING, "hob"),
    },
)

WORM = scope(
    "cylindrical_worm.columns",
    """
k = vec(0, 0, 1)
n = mounted@cross(d(flank, t), d(flank, psi))
""",
    jets={"Px": ("t",), "Py": ("t",), "Pz": ("t",)},
    described=lambda: {
        "P": PROFILE,
        "flank": MESHED.carried(MESHED.sweep("pinion"), "P"),
        "mounted": MESHED.matrix(MESHED.motion("pinion")),
        "placed": MESHED.carried(MESHED.motion("pinion"), "flank"),
    },
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

CLAIMS = identities(
    """
meshing | equation of meshing | HOBBING
Velocity form and derivative form are the same function, at any shaft angle and for every profile.
    f = dot(n_wheel, d(wheel, (phi, 1), (phi2, m)))

normal | wheel normal | HOBBING
The hob's normal stays perpendicular to the hob's tangents in the wheel's frame.
    dot(n_wheel, d(wheel, t)) = 0
    dot(n_wheel, d(wheel, psi)) = 0

sum-angle | reduction | HOBBING
Meshing does not change when ψ and φh change by opposite amounts, but for the height z = P_z + pψ: only their sum and z
matter.
    d(f, (psi, 1), (phi, -1)) = m*p*dot(n, cross(k2, k))

explicit | reduction | EXPLICIT
The equation of meshing is linear in z; with this z it vanishes. The relation n·(k × r) = -p n_z of every helicoid
defines p here.
    f = 0
where: n_x ≠ 0 (beyond it lies the spurious sheet)
where: sin Σ ≠ 0

linear | reduction | EXPLICIT
The slope in z is -m n_x sin Σ, so the solution is unique where it is not 0.
    d(dot(vec(nx, ny, nz), cross(k, vec(x, y, zz)) + m*cross(k2, vec(x, y, zz) - vec(A, 0, 0))), zz) = m*nx*sin(Sigma)

contact | contact | ANY
n2 perpendicular to both tangents of the other surface is the same as n2 parallel to its normal: two scalar equations
for the papers' three.
    cross(n2, cross(t1, t2)) = t1*dot(n2, t2) - t2*dot(n2, t1)
where: t1 × t2 ≠ 0

both-systems | the papers' system and ours | HOBBING
The papers solve six equations with meshing f = 0 among them; we put the height of the hob point into the other five. f
is its slope times (height - explicit height), and the wheel's point and normal in (t, ψ, φ) are ours in (t, Ψ = ψ + φ,
height): each system has the other's solutions, for every profile.
    f = m*n.x*sin(Sigma)*(r.z - height)
    wheel = Rz(phi2)@(Rx(Sigma)@(Rz(psi + phi)@P + vec(0, 0, p*psi) - A*i))
    n_wheel = Rz(phi2)@(Rx(Sigma)@(Rz(psi + phi)@section))
where: n_x ≠ 0
where: sin Σ ≠ 0
where: m ≠ 0

both-normals | the papers' system and ours | ANY
The papers' common normal, n2 a multiple of t1 × t2, gives our two equations; and of three equations between components
of unit normals the first two give the third but for its sign.
    dot(share*cross(t1, t2), t1) = 0
    dot(share*cross(t1, t2), t2) = 0
    dot(t1, t1) - dot(n2, n2) = (a1 - c1)*(a1 + c1) + (a2 - c2)*(a2 + c2) + (a3 - c3)*(a3 + c3)
where: share ≠ 0; which side of the surfaces is told by the flank, not by the equations

columns | Jacobian | WORM
Columns of the Jacobian of a helicoid in mesh, for every profile: along the profile, along the screw, and with the
worm's own turn, of its point and of its normal.
    d(placed, t) = Rz(phi1 + psi)@d(P, t)
    d(placed, psi) = cross(k, placed) + p*k
    d(placed, phi1) = cross(k, placed)
    d(n, psi) = cross(k, n)
    d(n, phi1) = cross(k, n)

undercut | limit of the wheel flank | ANY
The singular function of the explicit surface is the division-free one of the three-parameter surface over f_φ.
    dot(cross(R_l + phi_l*R_phi, R_psi + phi_psi*R_phi), n)*f_phi
        = dot(n, f_phi*cross(R_l, R_psi) + f_l*cross(R_psi, R_phi) + f_psi*cross(R_phi, R_l))
where: f_φ ≠ 0

twist | meshing axes | HOBBING
Adding any share τ of the worm's screw motion to the relative motion does not change meshing.
    dot(n, cross(D, r) + W) = -f

axis | meshing axes | ANY
Where D·W = 0 that motion is a rotation about the line through q of direction D: every contact normal meets it.
    W - cross(q, D) = dot(D, W)/(Dy**2 + Dz**2)*D
where: D ≠ 0
where: D·W = 0

axis-quadratic | meshing axes | HOBBING
D·W is the quadratic in τ whose real roots give the meshing axes.
    dot(D, W) = p*tau**2 - (p + p*m*cos(Sigma) + A*m*sin(Sigma))*tau + A*m*sin(Sigma)
""",
    globals(),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
