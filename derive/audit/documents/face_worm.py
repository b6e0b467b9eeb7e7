"""The face worm report.

Gear cut by a tilted head-cutter as its copy, worm enveloped by the same tool. All figures are lost.
"""

from derive.audit.claims import Document, scope
from derive.audit.described import Described
from derive.audit.ledger import Chapter
from derive.audit.paragraphs import claims

DOCUMENT = Document(
    key="face-worm",
    name="the face worm report",
    file="001_d957fec2e26e51c5.txt",
    sha256="b4af8f190c4e011fae98afc907b726883541d61e757971f0dcd08ec2237000f0",
    about="Face worm drives with conical and cylindrical worms. Its equations are schemes without components and "
    "every figure is lost; the frames are ours.",
    symbols={
        "u": ("u", "mm", "surface parameter"),
        "theta": ("θ", "rad", "surface parameter"),
        "psi": ("ψ1", "rad", "rotation of the worm while being cut"),
        "phi2": ("ψ1 N1/N2", "rad", "rotation of the cradle"),
        "m": ("N1/N2", "-", "ratio of the cradle to the worm"),
        "E0": ("E0", "mm", "nominal shortest distance"),
        "apl": ("apl", "mm/rad²", "coefficient of the plunge"),
        "L": ("L", "mm", "axial position of the worm"),
        "x": ("x", "mm", "tool surface, any"),
        "y": ("y", "mm", "tool surface, any"),
        "z": ("z", "mm", "tool surface, any"),
        "s": ("s", "rad/mm", "slope of θ over u, any"),
    },
)

DRIVE = Described(
    "face_worm",
    {"N_1*psi_worm/N_2": "phi2", "N_1*psi_hob/N_2": "phi2", "psi_worm": "psi", "psi_hob": "psi", "E_m": "E0",
     "a_pl": "apl"},
)  # fmt: skip
#: Any tool surface, carried by the motion in which it cuts the worm; the worm's frame turned back into the fixed one.
CUTTING = DRIVE.generation("pinion")

WORM = scope(
    "face-worm.worm",
    """
tool = vec(x, y, z)
frame = mat([0, 0, 1], [0, 1, 0], [-1, 0, 0])
moved = Rz(phi2)@tool
r1_psi = d(r1, (psi, 1), (phi2, m))
E_m = E0 + apl*psi**2
velocity = m*cross(vec(0, 0, 1), moved) - cross(vec(1, 0, 0), moved - vec(L, E_m, 0)) - vec(0, 2*apl*psi, 0)
normal = cross(d(tool, u), d(tool, theta))
""",
    jets={"x": ("u", "theta"), "y": ("u", "theta"), "z": ("u", "theta")},
    described=lambda: {"r1": DRIVE.carried(CUTTING, "tool")},
)

HOB = scope(
    "face-worm.hob",
    """
f = triple(d(r2, u), d(r2, theta), d(r2, (psi, 1), (phi2, m)))
""",
    jets={"x": ("u", "theta"), "y": ("u", "theta"), "z": ("u", "theta")},
    described=lambda: {
        "hob": ("vec", *(("jet", name, 0, 0) for name in "xyz")),
        "r2": DRIVE.carried(DRIVE.generation("reference_wheel/flank"), "hob"),
    },
)

IMPLICIT = scope(
    "face-worm.implicit",
    """
slope = -(g[1, 0]/g[0, 1])
""",
    jets={"g": ("u", "theta")},
)

CLAIMS = claims(
    """
eq-1 | Eq (1), Table 1
> ω(w)/ω(d) = N2/N1; gear ratio 30
The first equation is the definition of the gearing; checked is the arithmetic of Table 1 alone, 60/2 = 30.
    60/2 -> 30

eq-2 | Eqs (2), (3)
> r2* = r2*(u, θ, ψ); (∂r2*/∂u × ∂r2*/∂θ)·∂r2*/∂ψ = f = 0
Definition of the hob-cut surface and its equation of meshing.
kind: definition

eq-3-velocity | Eq (3) | HOB
> equation (3) is the equation of meshing
For every hob surface the triple product is the hob's normal against the relative velocity, turned into the gear's
frame.
    f = dot(mat([0, 0, 1], [0, 1, 0], [-1, 0, 0])@(Rz(psi)@cross(d(vec(x, y, z), u), d(vec(x, y, z), theta))),
        cross(vec(1, 0, 0), Rz(phi2)@r2 - vec(L, E0, 0)) - m*cross(vec(0, 0, 1), Rz(phi2)@r2))

eq-4 | inequality (4) | IMPLICIT
> ∂f*/∂u_h + ∂f*/∂θ_h ≠ 0
The sum of the derivatives may vanish although f = 0 can be solved, as for f = u - θ. What is needed is |∂f/∂u| +
|∂f/∂θ| ≠ 0; the bars may have been lost in the extraction.
contradiction:
    d(u - theta, u) + d(u - theta, theta) = 0
    d(u - theta, theta) = -1
damage: vertical bars may be lost

eq-5 | Eqs (5), (6) | IMPLICIT
> θ_h = θ_h(u_h, ψ_h); r2*(u, θ(u,ψ), ψ) = R2*(u, ψ)
That there is a function θ(u, ψ) near a solution is the implicit function theorem, a hypothesis here and not proved.
Proved is which slope it has: along a curve θ(u) of any slope s the equation of meshing changes by f_θ (s + f_u/f_θ),
and so keeps its value with the slope -f_u/f_θ and with no other.
    d(g, (u, 1), (theta, s)) = g[0, 1]*(s - slope)
where: ∂f/∂θ ≠ 0

step-v | §3, step (v)
> surface of head-cutter applied for generation of surface Σ2* of new design
Σ2* is the hob-cut surface of the existing design; the new one is Σ2, as in step (vii).
kind: not_mathematical

eq-7 | Eq (7)
> r2(u_g, θ_g) = M_2g r_g(u_g, θ_g)
Definition: the gear flank is the copy of the tool.
kind: definition

eq-8 | Eq (8) | WORM
> E_m(ψ1) = E0 + apl ψ1²
The worm's axis passes the head-cutter at this distance, as the motion that cuts it says. The unit of apl is mm/rad²;
Tables 1 and 2 print mm.
    r1 = Rz(-psi)@(T(frame)@(moved - vec(L, E0 + apl*psi**2, 0)))

eq-9 | Eq (9)
> r1 = M_1d M_dw r_w(u_w, θ_w), r_w ... in coordinate system S_d of the cradle d
If r_w stood in S_d it would not have to be multiplied by M_dw: S_w is meant.
missing: the frame of r_w, which must be S_w

eq-10 | Eq (10) | WORM
> (∂r1/∂u_w × ∂r1/∂θ_w)·∂r1/∂ψ1 = f = 0; Vector ∂r1/∂ψ1 is equivalent to the vector of relative velocity
Turned into the fixed frame, ∂r1/∂ψ1 is the relative velocity, the plunge's 2 apl ψ1 included.
    frame@(Rz(psi)@r1_psi) = velocity
    triple(d(r1, u), d(r1, theta), r1_psi) = dot(Rz(phi2)@normal, velocity)

eq-11 | Eqs (11), (12)
> r_f(1) - r_f(2) = 0; n_f(1) - n_f(2) = 0; the solution of equations (11) and (12)
(11) gives three equations, (12) two independent ones, for six unknowns (u1, θ1, ψ1, u2, θ2, φ2) at given φ1.
missing: the equation of meshing (10), to be solved together with (11) and (12)

eq-13 | Eqs (13), (14)
> σm1 = σ1/σmax1; σm2 = σ2/σmax2
Definitions of unitless stresses.
kind: definition

modulus | §6
> Young's Modulus E = 2.068 x 10^8 mN/mm
206.8 GPa is 2.068 x 10^8 mN/mm²; mN/mm is no unit of a modulus.
missing: the square of the unit, in the print or lost in the extraction

captions | Figs. 23, 27
> a) Bending stress ... b) Bending stress
One of the two must be the contact stress, as the text says.
kind: not_mathematical

stresses | §§6, 7
> bending 168 and 195, contact 1090 and 960 N/mm²; load shared by three pairs
Results of finite elements that cannot be repeated from the text.
kind: not_mathematical

radii | Tables 1, 2
> mean radius of the head-cutter 24.398 and 23.105 mm
The rule by which one mean radius follows for two flanks is not given.
missing: the rule for the pitch point and for the mean radius
""",
    globals(),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
