"""Letters of the rack-and-pinion paper, and what stands for them in the description of a cylindrical worm drive."""

from derive.audit.claims import Document, scope
from derive.audit.described import Described

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
    described=lambda: {
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
    described=lambda: {
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
    described=lambda: _mounted(CROSSED),
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
