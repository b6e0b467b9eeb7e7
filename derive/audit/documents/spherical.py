"""The spherical report (every even page is missing).

Barrel-shaped and waisted gears cut by a rack that sweeps an arc.
"""

from derive.audit.claims import Document, scope
from derive.audit.described import Described
from derive.audit.ledger import Chapter
from derive.audit.paragraphs import claims

DOCUMENT = Document(
    key="spherical",
    name="the spherical report",
    file="003_1b02f86c27c1e1b1.txt",
    sha256="f2b12c5d073754e0d43de4fffd0e0d33532f32843590b728be1dbb7218b6c555",
    about="Convex and concave spherical gears. Every even page is missing; vertical matrices are extracted with "
    "their signs out of place, so rows are read by their tokens.",
    symbols={
        "l": ("l", "mm", "distance along the cutting edge"),
        "theta": ("θs", "rad", "spherical angle"),
        "a": ("a", "mm", "edge offset"),
        "b": ("b", "mm", "half width of the rack space"),
        "alpha": ("αn", "rad", "pressure angle"),
        "R": ("R", "mm", "spherical radius"),
        "s": ("±", "-", "upper sign +1 (left edge), lower sign -1"),
        "r": ("r", "mm", "pitch radius of the gear"),
        "phi": ("φ", "rad", "rotation of the gear while being cut"),
        "omega": ("ω", "1/s", "speed of the gear while being cut"),
        "Xc": ("Xc", "mm", "rack point"),
        "Yc": ("Yc", "mm", "rack point"),
        "Zc": ("Zc", "mm", "rack point"),
        "Nx": ("Nx", "-", "component of the rack's normal"),
        "Ny": ("Ny", "-", "component of the rack's normal"),
        "Nz": ("Nz", "-", "component of the rack's normal"),
    },
)

CONVEX = Described(
    "spherical_convex_concave",
    {"l_pinion": "l", "theta_pinion": "theta", "a_pinion": "a", "b_pinion": "b", "R_pinion": "R",
     "T_1": "2*r/m", "phi_gen_pinion": "phi"},
)  # fmt: skip
CONCAVE = Described(
    "spherical_convex_concave",
    {"l_wheel": "l", "theta_wheel": "theta", "a_wheel": "a", "b_wheel": "b", "R_wheel": "R"},
)
#: The wheel in mesh turns by an angle of its own, phi2.
MESH = Described(
    "spherical_convex_concave",
    {"transmission_error": "pi - phi2 - T_1/T_2*phi_pinion - 2*s*b_wheel/(m*T_2)", "dC": "C - m*T_1/2 - m*T_2/2"},
)

EDGE = scope(
    "spherical.edge",
    "",
    signs=["s"],
    described=lambda: {
        "edge": CONVEX.edge("pinion"),
        "convex": CONVEX.carried(CONVEX.sweep("pinion"), "edge"),
        "concave": CONCAVE.carried(CONCAVE.sweep("wheel"), "edge"),
        "M_ca": CONVEX.matrix(CONVEX.sweep("pinion")),
        "middle": CONVEX.carried(CONVEX.sweep("pinion"), ("vec", 0, 0, 0)),
    },
)

#: The middle section.
MIDDLE = scope("spherical.middle", "theta = 0", extends=EDGE)

#: The rack in the fixed frame is what the generating motion carries before the gear's own turn. What a gear's observer
#: sees of the rack, turned back, is its velocity relative to the gear.
RACK = scope(
    "spherical.rack",
    """
N = vec(Nx, Ny, Nz)
V = omega*(T(turn)@d(R_g, phi))
V_rack = omega*d(shifted, phi)
V_gear = V_rack - V
N_g = turn@N
""",
    described=lambda: {
        "shifted": CONVEX.carried(CONVEX.generation("pinion")[1:], ("vec", "Xc", "Yc", "Zc")),
        "turn": CONVEX.matrix(CONVEX.generation("pinion")[:1]),
        "R_g": CONVEX.carried(CONVEX.generation("pinion"), ("vec", "Xc", "Yc", "Zc")),
        "placed": MESH.carried(MESH.motion("wheel"), ("vec", "Xg", "Yg", "Zg")),
    },
)


def reserve(teeth: int, degrees: str, width: int) -> str:
    """Left side of the undercut condition at the end of the edge (l = 0) and of the face, R = r = mT/2, m = a = 4,
    convex.
    """
    r, rho, z = 2 * teeth, 2 * teeth - 4, width // 2
    cosine = f"sqrt(1 - ({z}/{rho})**2)"
    bracket = f"(1 + cos(radians({degrees}))**2*{r}/{rho}*(({z}/{rho})/{cosine})**2/{cosine})"
    return f"{r}*sin(radians({degrees}))**2 + ({rho}*{cosine} - {r})*{bracket}"


CLAIMS = claims(
    rf"""
eq-2.1 | (2.1) | EDGE
> R_a = [ -a + l cos αn ; ±(b + a tan αn) ∓ l sin αn ; 0 ]
A straight edge through (0, ±b), inclined by αn, from X = -a on.
    edge.x = -a + l*cos(alpha)
    edge.y = s*(b + a*tan(alpha)) - s*l*sin(alpha)
    edge.z = 0
damage: signs stand apart from their rows

eq-2.2 | (2.2) | EDGE
> R_c(convex) = M_ca R_a, M_ca = [cos θs, 0, -sin θs, -R(1-cos θs); 0 1 0 0; sin θs, 0, cos θs, R sin θs; 0 0 0 1]
Rotation about a line at distance R below the edge: a proper rigid motion.
    M_ca = mat([cos(theta), 0, -sin(theta)], [0, 1, 0], [sin(theta), 0, cos(theta)])
    convex = M_ca@edge + vec(-R*(1 - cos(theta)), 0, R*sin(theta))
damage: signs stand apart from their rows

eq-2.5 | (2.5) | EDGE
> R_c(concave) = [ (l cos αn - a - R) cos θs2 + R ; ±(b + a tan αn) ∓ l sin αn ; (a - l cos αn + R) sin θs2 ; 1 ]
Row 3 holds one + and one -, whose places are lost. It must be (R + a - l cos αn) sin θs.
reading row 3 = (l cos αn - a + R) sin θs:
    concave.x = (l*cos(alpha) - a - R)*cos(theta) + R
    concave.y = s*(b + a*tan(alpha)) - s*l*sin(alpha)
    concave.z = (l*cos(alpha) - a + R)*sin(theta)
reading row 3 = (a - l cos αn + R) sin θs:
    concave.x = (l*cos(alpha) - a - R)*cos(theta) + R
    concave.y = s*(b + a*tan(alpha)) - s*l*sin(alpha)
    concave.z = (a - l*cos(alpha) + R)*sin(theta)
damage: signs stand apart from their rows

eq-2.6 | (2.6), (2.7)
> N·V(12) = 0; N_c = ∂R_c/∂l × ∂R_c/∂θs
Definitions of meshing and of the rack's normal.
kind: definition

shape | §1, §2.6 | EDGE
> 連續二次方程式變化之轉位 (a profile shift that varies continuously by a quadratic equation)
The shift at height Z lies on the circle (R - shift)² + Z² = R²: a quadratic equation, close to the parabola Z²/2R but
not equal to it.
    (R + middle.x)**2 + middle.z**2 = R**2
    middle.y = 0

eq-2.10 | (2.10) | RACK
> V_f(Σ) = [ 0 ; -rω ; 0 ]
The rack moves by -r per radian.
    V_rack = vec(0, -r*omega, 0)
damage: signs stand apart from their rows

eq-2.11 | (2.11) | RACK
> V_f(g) = [ (Yc - rφ)ω ; -(Xc + r)ω ; 0 ]
The gear turns by -ω about its axis at X = -r.
    V_gear = vec((Yc - r*phi)*omega, -(Xc + r)*omega, 0)
damage: signs stand apart from their rows

eq-2.12 | (2.12) | RACK
> V_f(Σg) = [ (rφ - Yc)ω ; Xc ω ; 0 ]
(2.10) minus (2.11).
    V = vec((r*phi - Yc)*omega, Xc*omega, 0)
damage: signs stand apart from their rows

eq-2.13 | (2.13) | RACK
> f(l, θs, φ) = (rφ - Yc)Nx + Xc Ny = 0
N·V divided by ω. The same function, with the sign kept, is N_g·∂R_g/∂φ.
    dot(N, V) = omega*((r*phi - Yc)*Nx + Xc*Ny)
    dot(N_g, d(R_g, phi)) = (r*phi - Yc)*Nx + Xc*Ny
where: ω ≠ 0
drops: omega

eq-2.19 | (2.19)–(2.22)
> V_r(Σ) + V(Σg) = 0; df/dt = 0; and their expansion in dl/dt, dθs/dt
Condition of a singular point and the chain rule.
kind: definition

eq-2.23 | (2.23)
> the rank of the augmented matrix is two
A condition to be solved. That its minors vanish together on one curve, in closed form, is proved in the chapter on
spherical drives.
kind: definition

edge-end | §2.6
> lS = 0 mm, lE = 8.263 mm ... lE = 8.513 mm
lE = 2a/cos αn with a = 4 mm.
    2*4/cos(radians(14.5)) -> 8.263 mm
    2*4/cos(radians(20)) -> 8.513 mm

table-2.3 | Table 2.3
> l = 1.811, 1.807, 1.804, 1.802, 1.801, 1.801 at Z = 10, 8, 6, 4, 2, 0 (T = 18, 14.5°, R = 5000 mm)
l = (a - r sin² αn)/cos αn + Z²/(2R cos αn), exact to 1e-5 at this radius. The values are those of the convex form,
which the table does not say.
    (4 - 36*sin(radians(14.5))**2)/cos(radians(14.5)) + 10**2/(2*5000*cos(radians(14.5))) -> 1.811 mm
    (4 - 36*sin(radians(14.5))**2)/cos(radians(14.5)) + 8**2/(2*5000*cos(radians(14.5))) -> 1.807 mm
    (4 - 36*sin(radians(14.5))**2)/cos(radians(14.5)) + 6**2/(2*5000*cos(radians(14.5))) -> 1.804 mm
    (4 - 36*sin(radians(14.5))**2)/cos(radians(14.5)) + 4**2/(2*5000*cos(radians(14.5))) -> 1.802 mm
    (4 - 36*sin(radians(14.5))**2)/cos(radians(14.5)) + 2**2/(2*5000*cos(radians(14.5))) -> 1.801 mm
    (4 - 36*sin(radians(14.5))**2)/cos(radians(14.5)) + 0**2/(2*5000*cos(radians(14.5))) -> 1.801 mm

free-32 | §2.6
> 凹狀 14.5°: no undercut at the middle section from 32 teeth on
At Z = 0 the condition is r sin² αn ≥ a: it fails for 31 teeth and holds for 32.
    62*sin(radians(14.5))**2 - 4 -> <0
    64*sin(radians(14.5))**2 - 4 -> >0

middle-section | §2.6 | MIDDLE
> 球形齒輪在中央截面處(Z=0 mm)的過切情形 \n與正齒輪相同，此乃由於在中央截面處之轉位量為零。
At the middle section the edge of the convex and of the concave rack is that of a spur gear's, not shifted.
    convex = edge
    concave = edge
    middle = vec(0, 0, 0)

free-24 | §2.6
> 凸狀 20°, face width 20 mm: no undercut at the ends at 24 teeth
With R = mT/2 the condition holds at 24 teeth and fails at 23.
    {reserve(24, "20", 20)} -> >0
    {reserve(23, "20", 20)} -> <0

free-36 | §2.6
> 凸狀 14.5°, face width 20 mm: no undercut at the ends from 36 teeth on
With R = mT/2 36 teeth are undercut at the ends of the face; with R = 150 mm they are free of undercut, as the 24 teeth
at 20° are then. The text can be meant either way.
missing: the spherical radius R that was used

eq-3.3 | (3.3)–(3.6)
> R_f(1) = M_fh M_hv M_vg R_g(k); R_f(2) = M_fg R_g(k); n likewise
Definition of the assembly; the figure that fixes order and sign of the two tilts is lost.
kind: definition

linear | §3.2 | RACK
> 由五個獨立之線性方程式求得五個未知的齒面參數 (five independent linear equations)
One of the five unknowns is the wheel's angle φ2. Of a wheel point in mesh, as the drive mounts it, the first coordinate
less the centre distance is its own second derivative by φ2 but for the sign: in a linear equation that derivative would
be 0. The sentence before says nonlinear.
contradiction:
    d(d(placed.x, phi2), phi2) = C - placed.x
    d(d(placed.y, phi2), phi2) = -placed.y

eq-3.7 | (3.7)
> Δφ2′(φ1′) = φ2′(φ1′) - (T1/T2) φ1′
Definition of the transmission error.
kind: definition

eq-3.12 | (3.12)–(3.14)
> X_t(1) = X_t(2) = r cos θt; Y_t(1) = Y_t(2) = r sin θt; Z_t(1) - Z_t(2) = 0.00632 mm
Definition of the contact pattern's edge.
kind: definition

three-teeth | §4.1
> 建立三齒接觸分析模型 (a contact model of three teeth)
Every other place, and the figures, have four pairs of teeth. A slip of the pen.
kind: not_mathematical

node-pinion | §4.4
> X1 = 62.771 mm, Y1 = 4.962 mm
The start of the edge (l = 0, Z = 0) of the 33-tooth gear lies √((r-a)² + (a cot αn)²) from its axis; with the printed
Y1 this is the printed X1.
    sqrt((33*4/2 - 4)**2 + (4/tan(radians(20)))**2 - 4.962**2) -> 62.771 mm

node-wheel | §4.4
> 凹狀球形小齒輪 ... X2 = 69.485 mm, Y2 = -5.272 mm
From the wheel's own axis these coordinates are 21 mm too small. Centred on the pinion, C = 160 mm away, they are the
start of the edge of the 47-tooth gear. The text also calls the concave 47-tooth wheel the small gear.
    sqrt((47*4/2 - 4)**2 + (4/tan(radians(20)))**2 - 5.272**2) -> 69.485 mm
corrected:
    160 - sqrt((47*4/2 - 4)**2 + (4/tan(radians(20)))**2 - 5.272**2) -> 69.485 mm

table-4.3 | Table 4.3
> 表 4. 3 不同軸孔半徑下球形齒輪組之接觸應力、彎曲應力及應力變化率 \n
> 凸狀小齒輪 \n
> 軸孔半徑 rshaft,1 (mm) 12.5 15 17.5 20 22.5 25 \n
> 接觸應力(MPa) 930.2 930.2 930.1 930.1 930.1 930 \n
> 接觸應力變化率(%) - 0.00 -0.01 -0.01 -0.01 -0.02 \n
> 彎曲應力(MPa) 58.12 58.18 58.24 58.31 58.39 58.47 \n
> 彎曲應力變化率(%) - 0.1 0.21 0.33 0.46 0.6 \n
> 凹狀大齒輪 \n
> 軸孔半徑 rshaft,2 (mm) 15 17.5 20 22.5 25 27.5 \n
> 接觸應力(MPa) 631.8 631.8 631.8 631.7 631.7 631.7 \n
> 接觸應力變化率(%) - 0.00 0.00 -0.02 -0.02 -0.02 \n
> 彎曲應力(MPa) 62.74 62.91 63.08 63.24 63.4 63.56 \n
> 彎曲應力變化率(%) - 0.27 0.54 0.8 1.05 1.31
All percentages follow from the printed stresses.
    100*(930.2 - 930.2)/930.2 -> 0.00 %
    100*(930.1 - 930.2)/930.2 -> -0.01 %
    100*(930 - 930.2)/930.2 -> -0.02 %
    100*(58.18 - 58.12)/58.12 -> 0.1 %
    100*(58.24 - 58.12)/58.12 -> 0.21 %
    100*(58.31 - 58.12)/58.12 -> 0.33 %
    100*(58.39 - 58.12)/58.12 -> 0.46 %
    100*(58.47 - 58.12)/58.12 -> 0.6 %
    100*(631.8 - 631.8)/631.8 -> 0.00 %
    100*(631.7 - 631.8)/631.8 -> -0.02 %
    100*(62.91 - 62.74)/62.74 -> 0.27 %
    100*(63.08 - 62.74)/62.74 -> 0.54 %
    100*(63.24 - 62.74)/62.74 -> 0.8 %
    100*(63.4 - 62.74)/62.74 -> 1.05 %
    100*(63.56 - 62.74)/62.74 -> 1.31 %

one-pressure | Table 4.3
> contact stress 930.2 MPa on the pinion and 631.8 MPa on the wheel
Two bodies press on each other with one and the same pressure: the two numbers cannot both be the contact pressure of
one contact. They may be other stresses, von Mises say, which differ between the bodies.
missing: which stress is meant, and where

table-4.4 | Table 4.4
> 球形角 Rj (mm) (spherical angle)
In millimetres and 66, 94 = mT/2: the spherical radius is meant.
kind: not_mathematical

eq-5.1 | (5.1), (5.2)
> nmax = fmax/z × 1000 × 60 rpm; A = 1296000/(z × IP) arc-sec
Definitions of the encoder's limits.
kind: definition

encoder | (5.3), (5.4), Table 5.2
> A = 0.01758 arc-sec; nmax = 110 rpm; centre distance 124 mm
Arithmetic.
    1296000/(18000*4096) -> 0.01758 arcsec
    33/18000*1000*60 -> 110 rpm
    4*(29 + 33)/2 -> 124 mm

measured | §5.4
> total transmission error 285, 286, 332 µm
Measurements on manufactured gears.
kind: not_mathematical
""",
    globals(),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
