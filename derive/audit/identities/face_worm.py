"""Face worm drives: hob-cut reference, tool cone with its fillet, worm enveloped with a plunge."""

from derive.audit.claims import Document, scope
from derive.audit.described import Described
from derive.audit.identities.conventions import identity
from derive.audit.ledger import Chapter

DOCUMENT = Document(
    key="face_worm",
    name="face worm drives",
    file="derive/drives/face_worm.py",
    sha256="",
    about="Fixed frame: z along the gear axis, x along the worm axis, y the common perpendicular. The worm's own z "
    "axis is x of the fixed frame.",
    symbols={
        "u": ("u", "mm", "profile parameter"),
        "theta": ("θ", "rad", "angle parameter"),
        "psi": ("ψ", "rad", "rotation of hob or worm"),
        "m": ("1/N", "-", "ratio of gear to worm"),
        "E_m": ("Em", "mm", "offset"),
        "L": ("L", "mm", "axial position"),
        "alpha": ("αg", "rad", "blade angle"),
        "Rg": ("Rg", "mm", "head-cutter radius"),
        "hd": ("hd", "mm", "blade depth"),
        "rf": ("ρf", "mm", "fillet radius"),
        "side": ("σ", "-", "+1 convex, -1 concave side of the gear tooth"),
        "ac": ("ac", "1/mm", "blade parabola"),
    },
)

DRIVE = Described(
    "face_worm",
    {
        "N_1*psi_hob/N_2": "phi2", "psi_hob": "psi", "R_g": "Rg", "alpha_g": "alpha", "u_gear": "u", "u_worm": "u",
        "theta_gear": "theta", "theta_worm": "theta", "lambda_gear": "lam", "rho_f": "rf", "h_d": "hd", "a_c": "ac",
        "s": "side",
    },
)  # fmt: skip
HOBBING = DRIVE.generation("reference_wheel/flank")

#: Any hob surface in the motion that cuts the reference wheel; the fixed frame is that before the wheel's own turn.
HOB = scope(
    "face_worm",
    """
hob = Rz(theta)@vec(x, y, z)
n = cross(d(hob, u), d(hob, theta))
seat = vec(L, E_m, 0)
f = dot(turned@n, cross(vec(1, 0, 0), at - seat) - m*cross(vec(0, 0, 1), at))
""",
    jets={"x": ("u", "theta"), "y": ("u", "theta"), "z": ("u", "theta")},
    described={
        "at": DRIVE.carried(HOBBING[1:], "hob"),
        "turned": DRIVE.matrix(HOBBING[1:]),
        "wheel": DRIVE.carried(HOBBING, "hob"),
        "n_wheel": DRIVE.turned(HOBBING, "n"),
    },
)

TOOL = scope(
    "face_worm.tool",
    """
cone = vec((Rg + u*sin(alpha))*cos(theta), (Rg + u*sin(alpha))*sin(theta), u*cos(alpha))
n_cone = side*vec(cos(alpha)*cos(theta), cos(alpha)*sin(theta), -sin(alpha))
ut = (-hd + rf*(1 + side*sin(alpha)))/cos(alpha)
Xt = Rg + ut*sin(alpha) + side*rf*cos(alpha)
Zt = -hd + rf
torus_x = Xt - side*rf*sin(lam)
torus_z = Zt - rf*cos(lam)
X = Rg + u*sin(alpha) + side*ac*u**2*cos(alpha)
Z = u*cos(alpha) - side*ac*u**2*sin(alpha)
blade = vec(X*cos(theta), X*sin(theta), Z)
n_blade = side*vec(d(Z, u)*cos(theta), d(Z, u)*sin(theta), -d(X, u))
torus = Rz(theta)@vec(torus_x, 0, torus_z)
""",
    signs=["side"],
    described={
        "gear_tool": DRIVE.carried(DRIVE.sweep("wheel"), DRIVE.edge("wheel")),
        "gear_normal": DRIVE.turned(DRIVE.sweep("wheel"), DRIVE.normal("wheel")),
        "fillet_tool": DRIVE.carried(DRIVE.sweep("wheel/fillet"), DRIVE.edge("wheel/fillet")),
        "worm_tool": DRIVE.carried(DRIVE.sweep("pinion"), DRIVE.edge("pinion")),
        "worm_normal": DRIVE.turned(DRIVE.sweep("pinion"), DRIVE.normal("pinion")),
    },
)

CLAIMS = (
    identity(
        "tools",
        "description",
        "Cone, torus and parabolic blade are the swept edges of the drive's description, seen from the tool's axis, "
        "and their normals its outward normals.",
        [
            "gear_tool = cone",
            "gear_normal = n_cone",
            "fillet_tool = torus",
            "worm_tool = blade",
            "worm_normal = -n_blade",
        ],
        TOOL,
        conditions=["cos αg ≠ 0"],
    ),
    identity(
        "hobbing",
        "description",
        "The equation of meshing in the fixed frame is the normal against the velocity in the motion of the "
        "description that cuts the reference wheel.",
        "f = dot(n_wheel, d(wheel, (psi, 1), (phi2, m)))",
        HOB,
    ),
    identity(
        "harmonic",
        "hob-cut reference",
        "At fixed surface parameters the equation of meshing is a cos ε + b sin ε + c in the hob's angle, so the "
        "reference surface is explicit.",
        "d(d(d(f, psi), psi), psi) = -d(f, psi)",
        HOB,
    ),
    identity(
        "cone-normal",
        "gear flank",
        "Unit normal of the tool cone, out of the gear tooth.",
        ["dot(n_cone, d(cone, u)) = 0", "dot(n_cone, d(cone, theta)) = 0", "dot(n_cone, n_cone) = 1"],
        TOOL,
    ),
    identity(
        "fillet-join",
        "fillet",
        "At λ = 90° + σ αg, where sin λ = cos αg and cos λ = -σ sin αg, the fillet torus meets the cone at u_t ...",
        ["Xt - side*rf*cos(alpha) = Rg + ut*sin(alpha)", "Zt - rf*(-side*sin(alpha)) = ut*cos(alpha)"],
        TOOL,
        conditions=["cos αg ≠ 0"],
    ),
    identity(
        "fillet-tangent",
        "fillet",
        "... with the same normal: the torus' normal (σ sin λ, cos λ) there is (σ cos αg, -σ sin αg), that of the "
        "cone.",
        [
            "d(torus_x, lam)*(side*sin(lam)) + d(torus_z, lam)*cos(lam) = 0",
            "side*cos(alpha)*sin(alpha) + (-side*sin(alpha))*cos(alpha) = 0",
        ],
        TOOL,
    ),
    identity(
        "blade-normal",
        "worm tool",
        "The parabolic blade's normal; at u = 0 it is the cone's, so both tools touch along the mid line.",
        [
            "dot(n_blade, d(blade, u)) = 0",
            "dot(n_blade, d(blade, theta)) = 0",
            "d(Z, u) = cos(alpha) - 2*side*ac*u*sin(alpha)",
            "d(X, u) = sin(alpha) + 2*side*ac*u*cos(alpha)",
        ],
        TOOL,
    ),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
