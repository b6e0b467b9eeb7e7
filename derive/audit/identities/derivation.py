"""The steps by which every drive is derived, for generic curves, surfaces and motions: one statement a step.

The modules of ``derive`` name these statements where they carry the step out (see :mod:`derive.language.origin`).
"""

from derive.audit.claims import Document, scope
from derive.audit.ledger import Chapter
from derive.audit.paragraphs import identities

DOCUMENT = Document(
    key="derivation",
    name="steps of the derivation",
    file="derive",
    sha256="",
    about="What the derivation of any drive relies on: each operation of the chain, the surfaces, the equation of "
    "meshing, its solution, and the linear system of the Newton step. Denominators and radicands of these statements "
    "are the side conditions that the generated code guards.",
    symbols={
        "a": ("a", "-", "a number, or an angle"),
        "b": ("b", "-", "a number"),
        "c": ("c", "-", "a number"),
        "u": ("u", "-", "surface parameter"),
        "v": ("v", "-", "surface parameter"),
        "k": ("k", "-", "share of the normal"),
        "s": ("s", "-", "a sign"),
        "phi": ("φ", "-", "parameter of the motion"),
        "c0": ("c0", "-", "equation of meshing where the parameter is 0"),
        "c1": ("c1", "-", "its slope in the parameter"),
        "r": ("r", "mm", "point"),
        "n": ("n", "-", "normal"),
    },
)

MOTION = scope(
    "derivation.motion",
    """
i = vec(1, 0, 0)
j = vec(0, 1, 0)
k = vec(0, 0, 1)
r = vec(x, y, z)
n = vec(nx, ny, nz)
w = vec(wx, wy, wz)
C = vec(cx, cy, 0)
half_turned = vec(2*sin(a/2)**2*cx + 2*sin(a/2)*cos(a/2)*cy, 2*sin(a/2)**2*cy - 2*sin(a/2)*cos(a/2)*cx, 0)
frame = Rz(e)@(Rx(f)@Rz(g))
""",
)

SURFACE = scope(
    "derivation.surface",
    """
R = vec(X, Y, Z)
R_u = d(R, u)
R_v = d(R, v)
n = cross(R_u, R_v)
N = vec(Nx, Ny, Nz)
length = sqrt(dot(N, N))
meridian = vec(Mx, 0, Mz)
turned = Rz(v)@meridian
tangent = vec(wx, wy, wz)
omega = vec(ox, oy, oz)
""",
    jets={
        "X": ("u", "v"), "Y": ("u", "v"), "Z": ("u", "v"), "Nx": ("u",), "Ny": ("u",), "Nz": ("u",),
        "Mx": ("u",), "Mz": ("u",),
    },
)  # fmt: skip

SOLUTION = scope(
    "derivation.solution",
    """
w = sqrt(a**2 + b**2)
cos_x = s*b/w
sin_x = -s*a/w
q = sqrt(a**2 + b**2 - c**2)
cos_y = (-a*c - s*b*q)/(a**2 + b**2)
sin_y = (-b*c + s*a*q)/(a**2 + b**2)
removed = total - kept
""",
    signs=["s"],
)

#: A surface S(u, v) that moves in the frame of a blank: any rotation (three angles), any shift, each at a rate of its
#: own; and any family of surfaces r(u, v, φ) at all.
FAMILY = scope(
    "derivation.family",
    """
S = vec(X, Y, Z)
frame = Rz(e)@(Rx(f)@Rz(g))
shift = vec(tx, ty, tz)
carried = frame@S + shift
own_normal = frame@cross(d(S, u), d(S, v))
velocity = d(carried, (e, e_rate), (f, f_rate), (g, g_rate), (tx, tx_rate), (ty, ty_rate), (tz, tz_rate))
r = vec(x, y, z)
n = cross(d(r, u), d(r, v))
meshing = dot(n, d(r, phi))
T_1 = d(r, (u, u_1), (v, v_1), (phi, phi_1))
T_2 = d(r, (u, u_2), (v, v_2), (phi, phi_2))
""",
    jets={
        "X": ("u", "v"), "Y": ("u", "v"), "Z": ("u", "v"),
        "x": ("u", "v", "phi"), "y": ("u", "v", "phi"), "z": ("u", "v", "phi"),
    },
)  # fmt: skip

MERGE = scope("derivation.merge", "removed = total - kept")

#: c0 + c1 x, of coefficients that are functions of the other parameters.
AFFINE = scope(
    "derivation.affine",
    """
F = c0 + c1*x
root = -c0/c1
stepped = x - F/d(F, x)
solved = c0 + c1*root
""",
    jets={"c0": ("u",), "c1": ("u",)},
)

#: The linear system of the Newton step has at most so many unknowns in a packaged drive.
UNKNOWNS = 9


def _stage(n: int) -> str:
    """One step of elimination in n unknowns: the pivot's row, and any other row."""

    def row(k: int, begin: int) -> str:
        return " + ".join(f"a{k}{j}*x{j}" for j in range(begin, n + 1))

    first = f"(b1 - ({row(1, 2)}))/a11"
    reduced = " + ".join(f"(a2{j} - a21/a11*a1{j})*x{j}" for j in range(2, n + 1))
    return f"""a11*({first}) + {row(1, 2)} = b1
    a21*({first}) + {row(2, 2)} - b2 = {reduced} - (b2 - a21/a11*b1)"""


STAGES = "\n    ".join(_stage(n) for n in range(UNKNOWNS, 2, -1))

LINEAR = scope(
    "derivation.linear",
    """
det = a11*a22 - a12*a21
y1 = (b1*a22 - a12*b2)/det
y2 = (a11*b2 - b1*a21)/det
""",
)

#: Two residuals that two unknowns change directly and by way of an angle, which has a rate along each.
TURNING = scope(
    "derivation.turning",
    """
J11 = d(g, (p, 1), (a, A_1))
J12 = d(g, (q, 1), (a, A_2))
J21 = d(h, (p, 1), (a, A_1))
J22 = d(h, (q, 1), (a, A_2))
det = J11*J22 - J12*J21
dp = (b1*J22 - J12*b2)/det
dq = (J11*b2 - b1*J21)/det
da = A_1*dp + A_2*dq
""",
    jets={"g": ("p", "q", "a"), "h": ("p", "q", "a")},
)

SIZED = scope(
    "derivation.sized",
    """
J = mat([a11, a12, a13], [a21, a22, a23], [a31, a32, a33])
sized = mat([a11*s1, a12*s2, a13*s3], [a21*s1, a22*s2, a23*s3], [a31*s1, a32*s2, a33*s3])
change = vec(x1, x2, x3)
measured = vec(x1/s1, x2/s2, x3/s3)
j1 = vec(a11, a21, a31)
j2 = vec(a12, a22, a32)
j3 = vec(a13, a23, a33)
""",
)

SCALED = scope(
    "derivation.scaled",
    """
n = vec(nx, ny, nz)
g = triple(A, B, n)
g0 = triple(A0, B0, n0)
A = vec(ax, ay, az)
B = vec(bx, by, bz)
A0 = vec(ex, ey, ez)
B0 = vec(fx, fy, fz)
n0 = vec(mx, my, mz)
""",
)

CALCULUS = scope(
    "derivation.calculus",
    """
quotient = a/b
root = sqrt(a)
complement = sqrt((1 - a)*(1 + a))
F = g/h
G = sqrt(g)
arc = atan2(g, h)
A = vec(xa, ya, za)
D = vec(xd, yd, zd)
plane = cross(A, D)
centre = cross(dot(A, A)*D - dot(D, D)*A, plane)/(2*dot(plane, plane))
""",
    jets={"g": ("u",), "h": ("u",)},
)

CLAIMS = identities(
    f"""
rotation | chain: velocity of a rotation | MOTION
Power of a normal on a turning point: the derivative by the angle is axis × r, formed in the body's own frame. Rotating
both vectors does not change it.
    dot(Rx(a)@n, d(Rx(a)@r, a)) = dot(n, cross(i, r))
    dot(Ry(a)@n, d(Ry(a)@r, a)) = dot(n, cross(j, r))
    dot(Rz(a)@n, d(Rz(a)@r, a)) = dot(n, cross(k, r))

translation | chain: order of factors | MOTION
A translation along an axis commutes with the rotation about it, and adds only its own rate to the velocity.
    Rz(a)@(r + c*k) = Rz(a)@r + c*k
    Rx(a)@(r + c*i) = Rx(a)@r + c*i
    Ry(a)@(r + c*j) = Ry(a)@r + c*j
    dot(n, d(r + c*k, c)) = dot(n, k)

swing | chain: rotation about a distant line | MOTION
The form with half angles, in which no large lengths cancel, is the rotation about the line through the centre.
    half_turned + Rz(a)@r = C + Rz(a)@(r - C)

placement | chain: constant frames | MOTION
An orthonormal frame with determinant +1 keeps scalar and vector products, whatever its three angles.
    dot(frame@r, frame@n) = dot(r, n)
    cross(frame@r, frame@n) = frame@cross(r, n)

swept | surface: normal | SURFACE
The product of the two tangents is perpendicular to both, so it is the normal of any swept surface.
    dot(n, R_u) = 0
    dot(n, R_v) = 0
where: ∂r/∂u × ∂r/∂v ≠ 0: zero is an edge of regression, where the singular function vanishes

revolved | surface: normal | SURFACE
On a surface of revolution the circle's tangent is j, turned: the normal needs the meridian alone.
    d(turned, v) = Mx*(Rz(v)@vec(0, 1, 0))
    dot(Rz(v)@cross(d(meridian, u), vec(0, 1, 0)), d(turned, u)) = 0
    dot(Rz(v)@cross(d(meridian, u), vec(0, 1, 0)), d(turned, v)) = 0

unit | surface: unit normal | SURFACE
A vector over its length has length one, and its derivative along the surface is that of the vector over the length.
    dot(N/length, N/length) = 1
    dot(cross(N, tangent), d(N/length, u)) = dot(cross(N, tangent), d(N, u))/length
where: n ≠ 0

pole | envelope: where meshing is formed | SURFACE
n·(ω × r) is the same at every point of the normal's line, so the equation of meshing may be formed at an arc's centre.
    dot(n, cross(omega, R + a*n)) = dot(n, cross(omega, R))

invariance | envelope: meshing along the chain | MOTION
Scalar products do not change under rotation: each term n·v of the equation of meshing may be formed in the frame of the
motion that causes it, which leaves out every angle that does not matter.
    dot(Rx(a)@n, Rx(a)@w) = dot(n, w)
    dot(Ry(a)@n, Ry(a)@w) = dot(n, w)
    dot(Rz(a)@n, Rz(a)@w) = dot(n, w)

screw | chain: turn and advance | MOTION
A factor that turns about an axis and carries a section at a place and in a posture of any kind moves its points, seen
from the section, as a turn about the axis so seen and the advance of the section's origin.
    T(frame)@cross(w, frame@r + n) = T(frame)@cross(w, n) + cross(T(frame)@w, r)

envelope | envelope: normal | FAMILY
Any tangent of the envelope moves u, v and φ at rates of its own. The generating surface's normal against it is the rate
of φ times the equation of meshing n·∂r/∂φ: where that holds the normal is square to every tangent, and the vector
product of two tangents is a multiple of it. For a rigid motion, of any axis and pitch, the equation is the turned
normal of the tool against the velocity.
    dot(n, T_1) = phi_1*meshing
    cross(cross(T_1, T_2), n) = meshing*(phi_1*T_2 - phi_2*T_1)
    triple(d(r, u), d(r, v), d(r, phi)) = meshing
    triple(d(carried, u), d(carried, v), velocity) = dot(own_normal, velocity)

merge-sum | reduction: one angle for a sum | MERGE
A sum of two angles is a parameter in the place of one of them.
    kept + removed = total
    Rz(kept)@(Rz(removed)@vec(x, y, z)) = Rz(total)@vec(x, y, z)

explicit | reduction: linear parameter | AFFINE
An equation that is linear in a parameter is solved by minus its value at 0 over its slope, from wherever one starts, by
nothing else, and along the surface that this gives it stays solved.
    c0 + c1*stepped = 0
    F = d(F, x)*(x - root)
    d(solved, u) = 0
    stepped = root
where: slope ≠ 0

explicit-angle | reduction: angle | SOLUTION
a cos x + b sin x = 0 is solved by the two directions (cos, sin) = ±(b, -a)/√(a² + b²).
    a*cos_x + b*sin_x = 0
    cos_x**2 + sin_x**2 = 1
where: (a, b) ≠ 0

both-turns | reduction: both angles | SOLUTION
a cos y + b sin y + c = 0 has the two roots atan2(b, a) ± atan2(√(a² + b² - c²), -c).
    a*cos_y + b*sin_y + c = 0
    cos_y**2 + sin_y**2 = 1
where: (a, b) ≠ 0
where: a² + b² ≥ c²

elimination | Newton step: pivots | LINEAR
Elimination in a fixed order of pivots down to two equations, Cramer's rule for these, then substitution backwards
solves the linear system: with the pivot's unknown from its own row, any other row holds exactly where the reduced row
does. Shown with every entry free for {UNKNOWNS} unknowns down to 3, the sizes that the packaged drives pass through,
and for the last two.
    {STAGES}
    a11*y1 + a12*y2 = b1
    a21*y1 + a22*y2 = b2
where: each pivot ≠ 0
where: the determinant of the last two equations ≠ 0

angles | Newton step: angles as variables | TURNING
An angle on which several unknowns act may be a variable of the linear system. The Jacobian is the chain rule's, and the
changes that it gives, with the angle's own beside them, solve the equations in which the angle is a variable.
    J11 = g[1, 0, 0] + g[0, 0, 1]*A_1
    g[1, 0, 0]*dp + g[0, 1, 0]*dq + g[0, 0, 1]*da = b1
    h[1, 0, 0]*dp + h[0, 1, 0]*dq + h[0, 0, 1]*da = b2
where: the determinant of the Jacobian ≠ 0

step-size | Newton step: size | SIZED
Steps are measured in natural sizes. With each column times its size and each unknown over it the system is the same,
and its determinant that of the Jacobian times the sizes: which steps solve it does not depend on them.
    sized@measured = J@change
    triple(s1*j1, s2*j2, s3*j3) = s1*s2*s3*triple(j1, j2, j3)
where: size ≠ 0

relative | limits of validity | SCALED
A function whose sign has no meaning of its own, such as the singular function of a surface, is divided by its value at
a regular point. The quotient has the sign of the product of both values, positive where there is no zero between; with
the lengths k and k0 of the normals it was made with it changes by their quotient, and not at all with their side.
    triple(A, B, k*n)/triple(A0, B0, k0*n0) = k/k0*(g/g0)
    g/g0*g0**2 = g*g0
where: the function does not vanish at the reference point
where: k, k0 ≠ 0

quotient | operations: division | CALCULUS
A quotient times its divisor is the dividend; its derivative has the same divisor.
    b*quotient = a
    d(F, u) = (d(g, u) - F*d(h, u))/h
where: divisor ≠ 0

root | operations: square root | CALCULUS
The square of a root is its radicand; its derivative divides by the root.
    root**2 = a
    d(G, u) = d(g, u)/(2*G)
where: radicand ≥ 0, above 0 where it is differentiated

tangent | operations: tangent | CALCULUS
The tangent is the sine over the cosine.
    tan(a)*cos(a) = sin(a)
where: cos ≠ 0

arc | operations: angle of a direction | CALCULUS
The derivative of the angle of the point (h, g) divides by h² + g².
    d(arc, u) = (h*d(g, u) - g*d(h, u))/(h**2 + g**2)
where: (h, g) ≠ 0

arccosine | operations: arc cosine and arc sine | CALCULUS
√((1 - a)(1 + a)) and a are sine and cosine of one angle: the arc cosine is the angle of that direction.
    complement**2 + a**2 = 1
where: |a| ≤ 1

circle | circle through three points | CALCULUS
Seen from the middle one of the three points, the centre is as far from the other two and in their plane.
    dot(centre - A, centre - A) = dot(centre, centre)
    dot(centre - D, centre - D) = dot(centre, centre)
    dot(centre, plane) = 0
where: the points are not in line
""",
    globals(),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
