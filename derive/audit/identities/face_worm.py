"""Face worm drives: hob-cut reference, tool cone with its fillet, worm enveloped with a plunge."""

from derive.audit.claims import Document, scope
from derive.audit.described import Described
from derive.audit.ledger import Chapter
from derive.audit.paragraphs import identities

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
    described=lambda: {
        "at": DRIVE.carried(HOBBING[1:], "hob"),
        "turned": DRIVE.matrix(HOBBING[1:]),
        "wheel": DRIVE.carried(HOBBING, "hob"),
        "n_wheel": DRIVE.turned(HOBBING, "n"),
    },
)

#: The worm's blade at its mid line.
MIDDLE = Described(DRIVE.drive, {**DRIVE.letters, "u_worm": "0"})
#: Cone, torus and parabolic blade, seen from the tool's axis.
TOOL = scope(
    "face_worm.tool",
    "",
    signs=["side"],
    described=lambda: {
        "cone": DRIVE.carried(DRIVE.sweep("wheel"), DRIVE.edge("wheel")),
        "n_cone": DRIVE.turned(DRIVE.sweep("wheel"), DRIVE.normal("wheel")),
        "torus": DRIVE.carried(DRIVE.sweep("wheel/fillet"), DRIVE.edge("wheel/fillet")),
        "n_torus": DRIVE.turned(DRIVE.sweep("wheel/fillet"), DRIVE.normal("wheel/fillet")),
        "blade": DRIVE.carried(DRIVE.sweep("pinion"), DRIVE.edge("pinion")),
        "n_blade": DRIVE.turned(DRIVE.sweep("pinion"), DRIVE.normal("pinion")),
        "n_middle": MIDDLE.turned(MIDDLE.sweep("pinion"), MIDDLE.normal("pinion")),
    },
)


def _joined(side: str, sign: str, angle: str, place: str) -> dict:
    """Edges and their normals where the rounding joins, on one side of the gear tooth."""
    there = Described(
        DRIVE.drive, {"s": sign, "lambda_gear": angle, "u_gear": place, "alpha_g": "alpha", "rho_f": "rf", "h_d": "hd"}
    )
    return {
        f"cone_{side}": there.edge("wheel"),
        f"n_cone_{side}": there.normal("wheel"),
        f"join_{side}": there.edge("wheel/fillet"),
        f"n_join_{side}": there.normal("wheel/fillet"),
    }


JOINED = scope(
    "face_worm.joined",
    "",
    extends=TOOL,
    described=lambda: _joined("convex", "1", "pi/2 + alpha_g", "(rho_f*(1 + sin(alpha_g)) - h_d)/cos(alpha_g)")
    | _joined("concave", "-1", "pi/2 - alpha_g", "(rho_f*(1 - sin(alpha_g)) - h_d)/cos(alpha_g)"),
)

CLAIMS = identities(
    """
hobbing | description | HOB
The equation of meshing in the fixed frame is the normal against the velocity in the motion of the description that cuts
the reference wheel.
    f = dot(n_wheel, d(wheel, (psi, 1), (phi2, m)))

harmonic | hob-cut reference | HOB
At fixed surface parameters the equation of meshing is a cos ε + b sin ε + c in the hob's angle, so the reference
surface is explicit.
    d(d(d(f, psi), psi), psi) = -d(f, psi)

cone-normal | gear flank | TOOL
Outward unit normal of the gear's tool, a cone, out of the gear tooth.
    dot(n_cone, d(cone, u)) = 0
    dot(n_cone, d(cone, theta)) = 0
    dot(n_cone, n_cone) = 1
    cone.x**2 + cone.y**2 = (Rg + cone.z*tan(alpha))**2
where: cos αg ≠ 0

fillet-join | fillet | JOINED
At λ = 90° + σ αg the fillet's torus meets the cone at u_t, on either side of the gear tooth ...
    join_convex = cone_convex
    join_concave = cone_concave
where: cos αg ≠ 0

fillet-tangent | fillet | JOINED
... with the same normal, the torus' as everywhere along its arc.
    n_join_convex = rf*n_cone_convex
    n_join_concave = rf*n_cone_concave
    dot(n_torus, d(torus, lam)) = 0
    dot(n_torus, d(torus, theta)) = 0

blade-normal | worm tool | TOOL
The parabolic blade's outward normal; at u = 0 it is the cone's, turned over, so both tools touch along the mid line.
    dot(n_blade, d(blade, u)) = 0
    dot(n_blade, d(blade, theta)) = 0
    blade = cone + ac*u**2*n_cone
    n_middle = -n_cone
""",
    globals(),
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
