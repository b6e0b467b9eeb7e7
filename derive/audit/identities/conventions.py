"""Frames, rotations, and how each source's conventions map to ours."""

from derive.audit.claims import Document, scope
from derive.audit.ledger import Chapter
from derive.audit.paragraphs import identities

DOCUMENT = Document(
    key="conventions",
    name="conventions",
    file="derive/language/chain.py",
    sha256="",
    about="Active right-handed rotations, column vectors, products acting right to left. Fixed frame f: z along the "
    "worm axis, x from worm to wheel.",
    symbols={
        "a": ("a", "rad", "an angle"),
        "b": ("b", "rad", "an angle"),
        "Sigma": ("Σ", "rad", "shaft angle"),
        "phi": ("φ", "rad", "rotation of the hob"),
        "phi2": ("φ2", "rad", "rotation of the wheel"),
        "dh": ("Δh", "rad", "horizontal error"),
        "dv": ("Δv", "rad", "vertical error"),
        "psi": ("ψ", "rad", "screw angle"),
    },
)

FRAMES = scope(
    "conventions",
    """
unit = mat([1, 0, 0], [0, 1, 0], [0, 0, 1])
half_turn = mat([1, 0, 0], [0, -1, 0], [0, 0, -1])
permutation = mat([0, 0, 1], [0, 1, 0], [-1, 0, 0])
wheel_rows = mat([-1, 0, 0], [0, 0, -1], [0, -1, 0])
mirror_y = mat([1, 0, 0], [0, -1, 0], [0, 0, 1])
point = vec(x, y, z)
arm = vec(x - A, y, z)
blade = vec(rt + l*cos(alpha), -s*l*sin(alpha)*sin(lam), s*l*sin(alpha)*cos(lam))
ours_in_mesh = Rx(-(Sigma + dh))@(Ry(dv)@(Rz(-phi2)@point))
""",
    signs=["s"],
)

REVERSED = scope("conventions.reversed", "theta = -psi", extends=FRAMES)


def proper(matrix: str) -> str:
    """Orthogonal with determinant +1."""
    columns = [f"vec(entry({matrix}, 1, {k}), entry({matrix}, 2, {k}), entry({matrix}, 3, {k}))" for k in (1, 2, 3)]
    return f"T({matrix})@{matrix} = unit\n    triple({', '.join(columns)}) = 1"


CLAIMS = identities(
    f"""
rotations | rotations | FRAMES
Rotations about the axes are orthogonal with determinant +1.
    {proper("Rx(a)")}
    {proper("Ry(a)")}
    {proper("Rz(a)")}

frames | frames | FRAMES
Every constant frame matrix in use is orthogonal with determinant +1.
    {proper("permutation")}
    {proper("wheel_rows")}
    {proper("half_turn")}

sums | rotations | FRAMES
Successive rotations about one axis add their angles.
    Rx(a)@Rx(b) = Rx(a + b)
    Ry(a)@Ry(b) = Ry(a + b)
    Rz(a)@Rz(b) = Rz(a + b)

half-turn | rotations | FRAMES
A half turn about x reverses rotations about y and z.
    Rx(pi) = half_turn
    Rx(pi)@Rz(a) = Rz(-a)@Rx(pi)
    Rx(pi)@Ry(a) = Ry(-a)@Rx(pi)

mirror | hand | FRAMES
The mirror image y → -y of a drive reverses rotations about x and z and leaves those about y.
    mirror_y@(Rz(a)@point) = Rz(-a)@(mirror_y@point)
    mirror_y@(Rx(a)@point) = Rx(-a)@(mirror_y@point)
    mirror_y@(Ry(a)@point) = Ry(a)@(mirror_y@point)

wheel-axis | shaft angle | FRAMES
The wheel's axis in the fixed frame is (0, sin Σ, cos Σ).
    Rx(-Sigma)@vec(0, 0, 1) = vec(0, sin(Sigma), cos(Sigma))

recess-action-blade | mapping of the recess-action paper | REVERSED
Its hob surface with θ1 = -ψ is our helicoid of the blade profile.
    Rz(-theta)@blade + vec(0, 0, -p*theta) = Rz(psi)@blade + vec(0, 0, p*psi)

recess-action-wheel | mapping of the recess-action paper | FRAMES
Its wheel surface with γ1 = 180° - Σ is ours turned half about x: R2 = diag(1, -1, -1) r_wheel.
    Rz(-phi2)@(Rx(-(pi - Sigma))@(Rz(phi)@point - vec(A, 0, 0)))
        = half_turn@(Rz(phi2)@(Rx(Sigma)@(Rz(phi)@point - vec(A, 0, 0))))

recess-action-mesh | mapping of the recess-action paper | FRAMES
With γ3 = 180° - Σ, Δγh = -Δh and Δγv = -Δv its assembly is ours.
    Rx((pi - Sigma) + (-dh))@(Ry(-dv)@(Rz(phi2)@(half_turn@point))) = ours_in_mesh

rack-and-pinion-wheel | mapping of the rack-and-pinion paper | FRAMES
Its wheel coordinates (i2, j2, k2) are diag(-1, 1, -1) times ours at Σ = 90°.
    wheel_rows@(Ry(phi2)@arm) = mat([-1, 0, 0], [0, 1, 0], [0, 0, -1])@(Rz(phi2)@(Rx(pi/2)@arm))
""",
    globals(),
)
CHAPTER = Chapter(DOCUMENT, CLAIMS)
