"""Internal gears: what a pinion cutter leaves in a ring gear."""

from derive.audit.claims import Document, scope
from derive.audit.described import Described
from derive.audit.ledger import Chapter
from derive.audit.paragraphs import identities

DOCUMENT = Document(
    key="internal_gears",
    name="internal gears",
    file="derive/drives/internal_gears.py",
    sha256="",
    about="A pinion cutter and a ring gear turn in one direction about parallel axes. Index 0 is the cutter, 2 the "
    "ring gear, whose space is that of the drive's description.",
    symbols={
        "rho0": ("ρ0", "mm", "rolling length of the cutter's involute"),
        "rb0": ("r_b0", "mm", "base radius of the cutter"),
        "psi0": ("ψ0", "rad", "half angle of the cutter's tooth on its base circle"),
        "a": ("a", "mm", "distance of the axes"),
        "w": ("α_w", "rad", "transverse working pressure angle of generation"),
        "t": ("θ", "rad", "turn of the tangent to the base circle"),
        "rb2": ("r_b2", "mm", "base radius of the ring gear"),
        "rho2": ("ρ2", "mm", "rolling length of the ring gear's involute"),
        "s": ("s", "-", "flank sign"),
    },
)

LETTERS = {"r_b_wheel": "rb2", "psi_wheel": "psi2", "rho_wheel": "rho2"}
DRIVE = Described("internal_gears", LETTERS)
TURNED = Described("internal_gears", {**LETTERS, "theta_wheel": "t"})

ROLL = scope(
    "internal_gears.roll",
    """
k = vec(0, 0, 1)
rb2 = rb0 + a*cos(w)
rho2 = rho0 + a*sin(w)
u = rb0/rb2
psi2 = u*psi0 + (1 - u)*(sin(w)/cos(w) - w)
axis = vec(a, 0, 0)
lined = mat([cos(w), s*sin(w), 0], [-s*sin(w), cos(w), 0], [0, 0, 1])
cut = lined@vec(rb0, s*rho0, 0)
normal = lined@vec(0, s, 0)
phi0 = s*(rho0/rb0 - psi0 - w)
""",
    signs=["s"],
    described=lambda: {"turn": DRIVE.name("theta_wheel")},
)

SECTION = scope(
    "internal_gears.section",
    "",
    signs=["s"],
    described=lambda: {"space": TURNED.edge("wheel")},
)

CLAIMS = identities(
    """
section | involute | SECTION
The section of a space is the involute of the ring gear's base circle.
    space = Rz(t)@vec(rb2, s*rho2, 0)

roll | generation | ROLL
Where the cutter's involute cuts, its normal is the line of action of generation: the relative velocity lies in the
flank. There the point is on the involute of the ring gear, whose rolling length is longer by a sin α_w, at the angle of
the description: the cutter's half tooth, in the ratio of the turns, and the involute function of α_w make the space.
    dot(normal, rb2*cross(k, cut) - rb0*cross(k, axis + cut)) = 0
    axis + cut = lined@vec(rb2, s*rho2, 0)
    -s*w - u*phi0 = turn
where: cos α_w ≠ 0
""",
    globals(),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
