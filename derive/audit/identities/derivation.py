"""The steps by which every drive is derived, for generic curves, surfaces and motions: one statement a step.

The modules of ``derive`` name these statements where they carry the step out (see :mod:`derive.language.origin`).
"""

from derive.audit.claims import Document, scope
from derive.audit.identities.conventions import identity
from derive.audit.ledger import Chapter

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
        "f0": ("f₀", "-", "equation of meshing where the parameter is 0"),
        "slope": ("f′", "-", "its slope in the parameter"),
        "s": ("s", "-", "a sign"),
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
in_plane = a*R_u + b*R_v
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
root = -f0/slope
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

LINEAR = scope(
    "derivation.linear",
    """
p2 = a22 - a21*a12/a11
p2c = a23 - a21*a13/a11
p2r = b2 - a21*b1/a11
p3 = a32 - a31*a12/a11
p3c = a33 - a31*a13/a11
p3r = b3 - a31*b1/a11
det = p2*p3c - p2c*p3
x3 = (p2*p3r - p2r*p3)/det
x2 = (p2r*p3c - p2c*p3r)/det
x1 = (b1 - a12*x2 - a13*x3)/a11
turning = A_x*dx
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

CLAIMS = (
    identity(
        "rotation",
        "chain: velocity of a rotation",
        "Power of a normal on a turning point: the derivative by the angle is axis × r, formed in the body's own "
        "frame. Rotating both vectors does not change it.",
        [
            f"dot(R{axis}(a)@n, d(R{axis}(a)@r, a)) = dot(n, cross({unit}, r))"
            for axis, unit in zip("xyz", "ijk", strict=True)
        ],
        MOTION,
    ),
    identity(
        "translation",
        "chain: order of factors",
        "A translation along an axis commutes with the rotation about it, and adds only its own rate to the velocity.",
        [
            "Rz(a)@(r + c*k) = Rz(a)@r + c*k",
            "Rx(a)@(r + c*i) = Rx(a)@r + c*i",
            "Ry(a)@(r + c*j) = Ry(a)@r + c*j",
            "dot(n, d(r + c*k, c)) = dot(n, k)",
        ],
        MOTION,
    ),
    identity(
        "swing",
        "chain: rotation about a distant line",
        "The form with half angles, in which no large lengths cancel, is the rotation about the line through the "
        "centre.",
        "half_turned + Rz(a)@r = C + Rz(a)@(r - C)",
        MOTION,
    ),
    identity(
        "placement",
        "chain: constant frames",
        "An orthonormal frame with determinant +1 keeps scalar and vector products, whatever its three angles.",
        [
            "dot(frame@r, frame@n) = dot(r, n)",
            "cross(frame@r, frame@n) = frame@cross(r, n)",
        ],
        MOTION,
    ),
    identity(
        "swept",
        "surface: normal",
        "The product of the two tangents is perpendicular to both, so it is the normal of any swept surface.",
        ["dot(n, R_u) = 0", "dot(n, R_v) = 0"],
        SURFACE,
        conditions=["∂r/∂u × ∂r/∂v ≠ 0: zero is an edge of regression, where the singular function vanishes"],
    ),
    identity(
        "revolved",
        "surface: normal",
        "On a surface of revolution the circle's tangent is j, turned: the normal needs the meridian alone.",
        [
            "d(turned, v) = Mx*(Rz(v)@vec(0, 1, 0))",
            "dot(Rz(v)@cross(d(meridian, u), vec(0, 1, 0)), d(turned, u)) = 0",
            "dot(Rz(v)@cross(d(meridian, u), vec(0, 1, 0)), d(turned, v)) = 0",
        ],
        SURFACE,
    ),
    identity(
        "unit",
        "surface: unit normal",
        "A vector over its length has length one, and its derivative along the surface is that of the vector over the "
        "length.",
        [
            "dot(N/length, N/length) = 1",
            "dot(cross(N, tangent), d(N/length, u)) = dot(cross(N, tangent), d(N, u))/length",
        ],
        SURFACE,
        conditions=["n ≠ 0"],
    ),
    identity(
        "pole",
        "envelope: where meshing is formed",
        "n·(ω × r) is the same at every point of the normal's line, so the equation of meshing may be formed at an "
        "arc's centre.",
        "dot(n, cross(omega, R + a*n)) = dot(n, cross(omega, R))",
        SURFACE,
    ),
    identity(
        "invariance",
        "envelope: meshing along the chain",
        "Scalar products do not change under rotation: each term n·v of the equation of meshing may be formed in the "
        "frame of the motion that causes it, which leaves out every angle that does not matter.",
        [f"dot(R{axis}(a)@n, R{axis}(a)@w) = dot(n, w)" for axis in "xyz"],
        MOTION,
    ),
    identity(
        "envelope",
        "envelope: normal",
        "Where the equation of meshing holds the velocity lies in the tangent plane, and the generating surface's "
        "normal is perpendicular to every tangent of the envelope.",
        ["dot(n, R_u + a*in_plane) = 0", "dot(n, R_v + b*in_plane) = 0"],
        SURFACE,
    ),
    identity(
        "merge-sum",
        "reduction: one angle for a sum",
        "A sum of two angles is a parameter in the place of one of them.",
        ["kept + removed = total", "Rz(kept)@(Rz(removed)@vec(x, y, z)) = Rz(total)@vec(x, y, z)"],
        scope("derivation.merge", "removed = total - kept"),
    ),
    identity(
        "explicit",
        "reduction: linear parameter",
        "An equation that is linear in a parameter is solved by minus its value at 0 over its slope.",
        "f0 + slope*root = 0",
        SOLUTION,
        conditions=["slope ≠ 0"],
    ),
    identity(
        "explicit-angle",
        "reduction: angle",
        "a cos x + b sin x = 0 is solved by the two directions (cos, sin) = ±(b, -a)/√(a² + b²).",
        ["a*cos_x + b*sin_x = 0", "cos_x**2 + sin_x**2 = 1"],
        SOLUTION,
        conditions=["(a, b) ≠ 0"],
    ),
    identity(
        "both-turns",
        "reduction: both angles",
        "a cos y + b sin y + c = 0 has the two roots atan2(b, a) ± atan2(√(a² + b² - c²), -c).",
        ["a*cos_y + b*sin_y + c = 0", "cos_y**2 + sin_y**2 = 1"],
        SOLUTION,
        conditions=["(a, b) ≠ 0", "a² + b² ≥ c²"],
    ),
    identity(
        "elimination",
        "Newton step: pivots",
        "Elimination in a fixed order of pivots down to two equations, Cramer's rule for these, then substitution "
        "backwards solves the linear system.",
        [
            "a11*x1 + a12*x2 + a13*x3 = b1",
            "a21*x1 + a22*x2 + a23*x3 = b2",
            "a31*x1 + a32*x2 + a33*x3 = b3",
        ],
        LINEAR,
        conditions=["each pivot ≠ 0", "the determinant of the last two equations ≠ 0"],
    ),
    identity(
        "angles",
        "Newton step: angles as variables",
        "An angle on which several unknowns act may be a variable of the linear system: eliminating it gives the "
        "Jacobian.",
        "R_x*dx + R_a*turning = (R_x + R_a*A_x)*dx",
        LINEAR,
    ),
    identity(
        "step-size",
        "Newton step: size",
        "Steps are measured in natural sizes: times its size each gives the step.",
        "b*(a/b) = a",
        CALCULUS,
        conditions=["size ≠ 0"],
    ),
    identity(
        "relative",
        "limits of validity",
        "A function whose sign has no meaning of its own is divided by its value at a regular point: it is 1 there.",
        ["b/b = 1", "b*(a/b) = a"],
        CALCULUS,
        conditions=["the function does not vanish at the reference point"],
    ),
    identity(
        "quotient",
        "operations: division",
        "A quotient times its divisor is the dividend; its derivative has the same divisor.",
        ["b*quotient = a", "d(F, u) = (d(g, u) - F*d(h, u))/h"],
        CALCULUS,
        conditions=["divisor ≠ 0"],
    ),
    identity(
        "root",
        "operations: square root",
        "The square of a root is its radicand; its derivative divides by the root.",
        ["root**2 = a", "d(G, u) = d(g, u)/(2*G)"],
        CALCULUS,
        conditions=["radicand ≥ 0, above 0 where it is differentiated"],
    ),
    identity(
        "tangent",
        "operations: tangent",
        "The tangent is the sine over the cosine.",
        "tan(a)*cos(a) = sin(a)",
        CALCULUS,
        conditions=["cos ≠ 0"],
    ),
    identity(
        "arc",
        "operations: angle of a direction",
        "The derivative of the angle of the point (h, g) divides by h² + g².",
        "d(arc, u) = (h*d(g, u) - g*d(h, u))/(h**2 + g**2)",
        CALCULUS,
        conditions=["(h, g) ≠ 0"],
    ),
    identity(
        "arccosine",
        "operations: arc cosine and arc sine",
        "√((1 - a)(1 + a)) and a are sine and cosine of one angle: the arc cosine is the angle of that direction.",
        "complement**2 + a**2 = 1",
        CALCULUS,
        conditions=["|a| ≤ 1"],
    ),
    identity(
        "circle",
        "circle through three points",
        "Seen from the middle one of the three points, the centre is as far from the other two and in their plane.",
        [
            "dot(centre - A, centre - A) = dot(centre, centre)",
            "dot(centre - D, centre - D) = dot(centre, centre)",
            "dot(centre, plane) = 0",
        ],
        CALCULUS,
        conditions=["the points are not in line"],
    ),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
