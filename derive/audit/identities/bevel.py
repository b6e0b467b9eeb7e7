"""Bevel and hypoid gears: blade, machine frames, meshing as a screw, conjugate settings, assembly."""

from derive.audit.claims import Document, scope
from derive.audit.described import Described
from derive.audit.ledger import Chapter
from derive.audit.paragraphs import identities
from derive.prove.tree import Tree

DOCUMENT = Document(
    key="bevel",
    name="bevel and hypoid gears",
    file="derive/drives/bevel.py",
    sha256="",
    about="Machine frame: z along the cradle's axis to the blank, x to the tooth being cut. Body frame: z along the "
    "axis to the back. Edges, normals and motions are those of the drive's description, of the gear (right hand) and "
    "of the pinion (left hand); s is the side of the blade.",
    symbols={
        "u": ("u", "mm", "arc length along the blade from its tip"),
        "X": ("w", "mm", "place on the blade's line that its normal meets"),
        "t": ("t", "rad", "turn along the arc"),
        "theta": ("θ", "rad", "angle around the cutter's axis"),
        "phi": ("φc", "rad", "turn of the cradle"),
        "work": ("φw", "rad", "turn of the work, any function of φc"),
        "rate": ("φw′", "-", "its derivative"),
        "alpha": ("α", "rad", "blade angle"),
        "kappa": ("κb", "1/mm", "curvature of the blade"),
        "u0": ("u0", "mm", "where the arc touches its line"),
        "rp": ("rp", "mm", "point radius"),
        "index": ("φi", "rad", "turn of the blank with a cutter that hobs, N_b/N θ"),
        "nu": ("ν", "rad", "the same of the crown gear, N_b/N_c θ"),
        "delta": ("δb", "rad", "blade offset angle"),
        "q": ("q", "rad", "cradle angle"),
        "i": ("i", "rad", "tilt"),
        "j": ("j", "rad", "swivel"),
        "gamma": ("γm", "rad", "root angle"),
        "Sr": ("Sr", "mm", "radial setting"),
        "Em": ("Em", "mm", "blank offset"),
        "XB": ("XB", "mm", "sliding base"),
        "XD": ("XD", "mm", "centre to back"),
        "H": ("H", "mm/rad", "helical motion"),
        "R": ("R", "-", "ratio of roll"),
        "rho": ("ρf", "mm", "rounding of the blade's tip"),
        "tau": ("τ", "rad", "inclination of the normal on the rounding"),
        "E": ("E", "mm", "offset"),
        "Sigma": ("Σ", "rad", "shaft angle"),
        "phi1": ("φ1", "rad", "angle of the pinion"),
        "s": ("s", "-", "+1 outside blade"),
        "a": ("a", "-", "rate of u of the place of contact, over φc"),
        "b": ("b", "-", "rate of its θ"),
    },
)

#: Of any blade: its line leaves the tip plane along t0 and its normal n0 points out of the metal that it leaves.
LINE = """
e1 = vec(1, 0, 0)
k = vec(0, 0, 1)
t0 = vec(s*sin(alpha), 0, -cos(alpha))
n0 = vec(-s*cos(alpha), 0, -sin(alpha))
"""
SETTINGS = {"r_p_{}": "rp", "alpha_{}": "alpha", "u_0_{}": "u0", "rho_f_{}": "rho", "theta_{}": "theta"}
BENT, UNBENT = {"bend_{}": "kappa"}, {"bend_{}": "0", "cosine_joint_{}": "cos(alpha)"}


def letters(member: str, *tables: dict[str, str]) -> dict[str, str]:
    """The drive's letters of a member, which stands for braces, with the document's."""
    return {name.format(member): other.format(member) for table in tables for name, other in table.items()}


#: Pinion of either kind: its blade by the place that the normal meets on its line, straight, at the rounding of its tip
#: and there where that joins; a Formate gear, whose blade is of the other side, by the turn along its arc.
BY_NORMAL = Described("bevel_generated", letters("pinion", BENT, SETTINGS, {"w_{}": "X"}))
STRAIGHT = Described("bevel_generated", letters("pinion", UNBENT, SETTINGS, {"w_{}": "u - u_0_{}"}, SETTINGS))
WIDER = Described(STRAIGHT.drive, {**STRAIGHT.letters, "r_p_pinion": "rp + change"})
ROUNDED = Described("bevel_generated", letters("pinion", UNBENT, SETTINGS, {"tau_{}": "tau"}))
JOINED = Described("bevel_generated", letters("pinion", UNBENT, SETTINGS, {"tau_{}": "alpha"}))
BY_TURN = Described("bevel_formate", letters("gear", BENT, {"u_{}": "u_0_{} + t/kappa"}, SETTINGS, {"s": "-s"}))
TIP = "pinion/fillet"

BLADE = scope(
    "bevel.blade",
    LINE
    + """
swung = edge - vec(rp, 0, 0)
pole = (u0 + X)*t0
omega = vec(o1, o2, o3)
f = dot(n_swung, vec(v1, v2, v3) + cross(omega, swung))
""",
    signs=["s"],
    described=lambda: {
        "secant": BY_NORMAL.name("secant_pinion"),
        "edge": BY_NORMAL.edge("pinion"),
        "n_swung": BY_NORMAL.normal("pinion"),
        "arc": BY_TURN.edge("wheel"),
        "n_arc": BY_TURN.normal("wheel"),
    },
)

CONE = scope(
    "bevel.cone",
    """
e1 = vec(1, 0, 0)
wider = vec(c1, c2, 0) - change*radial + widened
""",
    signs=["s"],
    described=lambda: {
        "cone": STRAIGHT.carried(STRAIGHT.sweep("pinion"), STRAIGHT.edge("pinion")),
        "n_cone": STRAIGHT.turned(STRAIGHT.sweep("pinion"), STRAIGHT.normal("pinion")),
        "widened": WIDER.carried(WIDER.sweep("pinion"), WIDER.edge("pinion")),
        "n_widened": WIDER.turned(WIDER.sweep("pinion"), WIDER.normal("pinion")),
        "radial": STRAIGHT.turned(STRAIGHT.sweep("pinion"), "e1"),
    },
)

ROUNDING = scope(
    "bevel.rounding",
    LINE
    + """
centre = rounding + rho*m_round
omega = vec(o1, o2, o3)
at_rounding = vec(v1, v2, v3) + cross(omega, rounding)
at_centre = vec(v1, v2, v3) + cross(omega, centre)
""",
    signs=["s"],
    described=lambda: {
        "rounding": ROUNDED.edge(TIP),
        "m_round": ROUNDED.normal(TIP),
        "joined": JOINED.edge(TIP),
        "m_joined": JOINED.normal(TIP),
    },
)

#: Member -> its place among the bodies, and hand, +1 right.
MEMBERS = {"gear": ("wheel", 1), "pinion": ("pinion", -1)}
#: What is said of each member, in the names of :func:`_machine`.
READ = ("cut", "n_cut", "gen", "n_gen", "lay", "base", "untilted", "plain", "crown", "larger", "shifted", "moved")
MACHINE_LETTERS = {
    "phi_cradle_{}": "phi", "theta_{}": "theta", "gamma_m_{}": "gamma", "E_m_{}": "Em", "X_B_{}": "XB", "X_D_{}": "XD",
    "H_{}": "H", "q_{}": "q", "S_r_{}": "Sr", "swivel_{}": "j", "tilt_{}": "i",
}  # fmt: skip
#: The work's turn, a polynomial of the cradle's, is one angle.
MODIFIED_ROLL = {f"c_{n}_{{}}": "0" for n in range(2, 7)} | {"R_{}": "work/phi_cradle_{}"}
LENGTHS = {"E_m_{}": "c*Em", "X_B_{}": "c*XB", "X_D_{}": "c*XD", "H_{}": "c*H", "S_r_{}": "c*Sr"}
APEX = {"X_B_{}": "XB + l*tan(gamma)", "X_D_{}": "XD - l/cos(gamma)"}
CROWN: dict[str, str] = dict.fromkeys(("E_m_{}", "X_B_{}", "X_D_{}", "H_{}"), "0")


def _machine(member: str) -> dict:
    """A tool's point and normal in the body of what it cuts and in the machine, as the drive's page says: whatever edge
    stands on the head.
    """
    place, _ = MEMBERS[member]

    def machine(*own: dict[str, str]) -> Described:
        return Described("bevel_generated", letters(member, MODIFIED_ROLL, MACHINE_LETTERS, *own))

    def cut(drive: Described, point: Tree) -> Tree:
        return drive.carried(drive.generation(place), drive.carried(drive.sweep(place), point))

    drive = machine()
    sweep, generation = drive.sweep(place), drive.generation(place)
    trees = (
        cut(drive, "on_head"),
        drive.turned(generation, drive.turned(sweep, "normal_on_head")),
        drive.carried(generation[4:], drive.carried(sweep, "on_head")),
        drive.turned(generation[4:], drive.turned(sweep, "normal_on_head")),
        drive.matrix(generation[2:3]),
        drive.carried(generation[3:4], ("vec", 0, 0, 0)),
        cut(machine({"tilt_{}": "0"}), "on_head"),
        cut(machine({"H_{}": "0"}), "on_head"),
        cut(machine(CROWN), "on_head"),
        cut(machine(LENGTHS), ("*", "c", "on_head")),
        cut(machine(APEX), "on_head"),
        drive.carried(generation[:4], ("+", f"gen_{member}", ("vec", "l", 0, 0))),
    )
    return {f"{name}_{member}": tree for name, tree in zip(READ, trees, strict=True)}


MACHINE = scope(
    "bevel",
    """
e1 = vec(1, 0, 0)
k = vec(0, 0, 1)
axis_gear = T(lay_gear)@k
axis_pinion = T(lay_pinion)@k
reflect = mat([1, 0, 0], [0, -1, 0], [0, 0, 1])
""",
    jets={"ex": ("u",), "ez": ("u",), "nx": ("u",), "nz": ("u",)},
    described=lambda: {
        "on_head": ("vec", ("+", "rp", ("jet", "ex", 0)), 0, ("jet", "ez", 0)),
        "normal_on_head": ("vec", ("jet", "nx", 0), 0, ("jet", "nz", 0)),
    }
    | _machine("gear")
    | _machine("pinion"),
)


HOBBING = {"r_p_{}": "rp", "u_0_{}": "u0", "alpha_{}": "alpha", "delta_b_{}": "delta"}
MILLING = {"index_{}": "0", "delta_b_{}": "0"}


def _hobbed(member: str) -> dict:
    """A tool's point in the body of what a face hob cuts, in the machine, and the turn of the blank."""
    place, _ = MEMBERS[member]
    rolling = {"index_{}": "index/theta_{}", **MODIFIED_ROLL}
    drive = Described("bevel_face_hobbed", letters(member, rolling, MACHINE_LETTERS, HOBBING))
    still = Described("bevel_face_hobbed", letters(member, MODIFIED_ROLL, MACHINE_LETTERS, HOBBING, MILLING))
    flat = Described("bevel_face_hobbed", letters(member, rolling, MACHINE_LETTERS, HOBBING, FLAT))
    sweep, generation = drive.sweep(place), drive.generation(place)
    return {
        f"work_{member}": drive.matrix(generation),
        f"index_{member}": drive.matrix(sweep[1:2]),
        f"hobbing_{member}": drive.carried(sweep[4:], "on_blade"),
        f"drawn_{member}": flat.carried(flat.sweep(place)[4:], "at_reference"),
        f"milling_{member}": still.carried(still.generation(place), still.carried(still.sweep(place), f"on_{member}")),
    }


#: A cutter whose axis stands upright on the machine plane; without it the swivel is nothing but another zero of θ.
FLAT = {"tilt_{}": "0", "swivel_{}": "0"}

HOBBED = scope(
    "bevel.hobbed",
    """
e1 = vec(1, 0, 0)
reference_gear = vec(-s*u0*sin(alpha), 0, 0)
reference_pinion = vec(s*u0*sin(alpha), 0, 0)
on_gear = on_blade - reference_gear
on_pinion = on_blade - reference_pinion
at_reference = vec(0, 0, z)
arm_gear = rp*e1 + reference_gear
arm_pinion = rp*e1 + reference_pinion
""",
    jets={"ex": ("u",), "ez": ("u",)},
    signs=["s"],
    described=lambda: {
        "on_blade": ("vec", ("jet", "ex", 0), 0, ("jet", "ez", 0)),
        "on_head": ("vec", ("+", "rp", ("jet", "ex", 0)), 0, ("jet", "ez", 0)),
    }
    | {name: tree for member in MEMBERS for name, tree in _machine(member).items() if name.startswith("cut_")}
    | _hobbed("gear")
    | _hobbed("pinion"),
)


def both(*texts: str) -> list[str]:
    """Equations of gear and pinion; names in braces are that member's, {h} the sign of its hand, {opposite} not."""
    return [
        text.format(
            h="" if hand > 0 else "-", opposite="-" if hand > 0 else "", opposite_sign="-" if hand > 0 else "+",
            axis=f"axis_{member}",
            **{name: f"{name}_{member}" for name in (*READ, "work", "index", "hobbing", "drawn", "milling", "arm")},
        )
        for text in texts
        for member, (_, hand) in MEMBERS.items()
    ]  # fmt: skip


#: Any generating surface at one place and instant: its tangents A and B, its second derivatives, and its velocity where
#: f = 0: −a A − b B, for the rates a and b at which the place of contact runs over the tool.
REGULAR = scope(
    "bevel.regular",
    """
A = vec(a1, a2, a3)
B = vec(b1, b2, b3)
AA = vec(p1, p2, p3)
AB = vec(q1, q2, q3)
BB = vec(r1, r2, r3)
AV = vec(u1, u2, u3)
BV = vec(v1, v2, v3)
VV = vec(w1, w2, w3)
V = -a*A - b*B
N = cross(A, B)
f_u = dot(cross(AA, B) + cross(A, AB), V) + dot(N, AV)
f_v = dot(cross(AB, B) + cross(A, BB), V) + dot(N, BV)
f_t = dot(cross(AV, B) + cross(A, BV), V) + dot(N, VV)
g = a*f_u + b*f_v + f_t
twice = a**2*AA + 2*a*b*AB + b**2*BB + 2*a*AV + 2*b*BV + VV
""",
)

#: Perfectly assembled; and the machine of the pinion whose cradle is the gear.
ASSEMBLED = {"dE": "0", "dSigma": "0", "dP": "0", "dG": "0", "transmission_error": "0"}
MESH = Described("bevel_generated", {**ASSEMBLED, "phi_pinion": "phi1"})
INTERSECTING = Described("bevel_generated", {**MESH.letters, "E": "0"})
ROLLING = Described("bevel_generated", {**ASSEMBLED, "ratio": "phi/phi_pinion", "phi_pinion": "work"})
AS_GEAR = Described(
    "bevel_generated",
    letters("pinion", MODIFIED_ROLL, {
        **MACHINE_LETTERS, "gamma_m_{}": "Sigma - pi/2", "E_m_{}": "E", "X_B_{}": "0", "X_D_{}": "0", "H_{}": "0",
        "q_{}": "0",
    }),
)  # fmt: skip

PAIR = scope(
    "bevel.pair",
    """
flip = mat([1, 0, 0], [0, -1, 0], [0, 0, -1])
k = vec(0, 0, 1)
r = vec(x, y, z)
""",
    described=lambda: {
        "hypoid": MESH.carried(MESH.motion("pinion"), "r"),
        "bevel": INTERSECTING.carried(INTERSECTING.motion("pinion"), "r"),
        "pinion_axis": MESH.turned(MESH.motion("pinion")[:-1], "k"),
        "in_pinion": AS_GEAR.carried(AS_GEAR.generation("pinion")[:5], ("@", "flip", "r")),
        "rolled": ROLLING.carried(ROLLING.motion("pinion"), "in_pinion"),
        "meshed": ROLLING.carried(ROLLING.motion("wheel"), "r"),
    },
)

CLAIMS = identities(
    """
meshing | equation of meshing | MACHINE
Machine and blank of the description move against one another in a screw about cradle and work axis, for any roll: f is
its moment about the cutter's normal. rate is dφw/dφc.
    dot({n_cut}, d({cut}, phi) + rate*d({cut}, work))
        = dot({n_gen}, {h}cross(k, {gen}) {opposite_sign} rate*cross({axis}, {gen} + {base}) - H*k)

regular | regular part | REGULAR
Of any generating surface: g = f_u a + f_θ b + f_φ is the second derivative, along the normal, of the tool's place over
a fixed point of the blank: there r_u a + r_θ b = −r_φ, and whatever the second derivatives of the rates add lies in the
tangent plane. Positive where the tool cuts deepest at this instant.
    dot(N, V) = 0
    g = dot(N, twice)
    dot(N, twice + k1*A + k2*B) = dot(N, twice)

edge-normal | blade | BLADE
The arc's normal has unit length and is normal to the arc; it begins along the line.
    dot(n_arc, n_arc) = 1
    dot(n_arc, d(arc, t)) = 0
    cos(t)*n_arc - sin(t)*d(arc, t)*kappa = n0
where: κb ≠ 0

swung-edge | blade | BLADE
Measured by where its normal meets the line, the arc has a derivative along t0 - κb w n0, and no singularity at κb = 0.
    secant**3*d(swung, X) = t0 - kappa*X*n0
    dot(n_swung, t0 - kappa*X*n0) = 0
where: 1 + √(1 + κb²w²) ≠ 0

pole | blade | BLADE
The normal of the arc meets its line at the distance w from the point of contact.
    cross(pole - swung, n_swung) = vec(0, 0, 0)

linear | explicit flank | BLADE
In any motion the equation of meshing is linear in w, for a straight blade and for an arc.
    d(d(f, X), X) = 0

fillet-join | fillet | ROUNDING
The rounding joins the straight edge in place and normal, turns about one centre and touches the tip plane.
    joined = vec(rp, 0, 0) + rho*(1 - sin(alpha))/cos(alpha)*t0
    m_joined = n0
    centre.z = -rho
    d(centre, tau) = vec(0, 0, 0)
    dot(m_round, d(rounding, tau)) = 0
where: cos α > 0

cone-normal | blade | CONE
The turning straight blade sweeps a cone: its normal is a unit vector, normal to blade and circle, and the same along
the whole blade.
    dot(n_cone, n_cone) = 1
    dot(n_cone, d(cone, u)) = 0
    dot(n_cone, d(cone, theta)) = 0
    d(n_cone, u) = vec(0, 0, 0)

stand-off | blade | BLADE
The arc leaves its line along its own normal, from the pole on; the straight blade, κb = 0, not at all.
    secant*(secant + 1)*(swung - pole) = -kappa*X**2*n_swung

rounding | fillet | ROUNDING
Normals of the rounding pass through its centre: in any motion the equation of meshing is a cosine and a sine of their
inclination τ, with the velocity of the centre.
    dot(m_round, at_rounding) = -s*at_centre.x*cos(tau) - at_centre.z*sin(tau)

tangent-cones | conjugate pairs | CONE
A wider cone whose axis is moved back by the change of radius shares point and normal along one whole generatrix:
crowning along the tooth.
    wider = vec(c1, c2, 0) + cone
    n_cone = n_widened

hand | machine | MACHINE
The other hand is the mirror image y → -y at equal blade and cradle angles: only the senses of turns change.
    cut_pinion = reflect@cut_gear

rotation-of-blade | machine | MACHINE
Without tilt, blade angle and swivel enter as their sum.
    d({untilted}, theta) = d({untilted}, j)

plain-roll | machine | MACHINE
With plain roll, in the ratio R, a change of the cradle angle only turns the member: the flank depends on q + φc.
    d({plain}, (phi, 1), (work, R)) = d({plain}, q) {opposite_sign} R*cross(k, {plain})

scale | machine | MACHINE
All lengths times c, helical motion among them: the flank times c at equal angles.
    {larger} = c*{cut}

apex | machine | MACHINE
Centre to back and sliding base together shift the cutter along the machine plane.
    {shifted} = {moved}
where: cos γm ≠ 0

crown | conjugate pairs | MACHINE
A member with R = 1/sin δ, γm = δ rolls on the machine plane: its velocity is that of a turn about the pitch line, the
same line for both members.
    dot({n_cut}, d({crown}, phi) + d({crown}, work)/sin(gamma))
        = {opposite}cos(gamma)/sin(gamma)*dot({n_gen}, cross(e1, {gen}))
where: sin δ ≠ 0

hobbed-crown | face-hobbed | HOBBED
The blank turns by φw - N_b/N θ, with R = N_c/N by N_c/N times the turn φc - ν of a crown gear; in that crown gear the
place of the blade is free of φc: all positions of the cradle cut one crown tooth, and members with one crown tooth are
conjugate.
    {work}@({index}@vec(x, y, z)) = Rz({opposite}(work - index))@vec(x, y, z)
    d(Rz({opposite}(phi - nu))@{hobbing}, phi) = vec(0, 0, 0)

epicycloid | face-hobbed | HOBBED
With an upright axis the reference point of the blade describes in the crown gear an extended epicycloid: a circle that
turns by θ + ν while its centre, at the radial setting, turns by ν.
    Rz({opposite}(phi - nu))@{drawn} = Rz({h}(q + nu))@vec(Sr, 0, z) + Rz({h}(q + nu + theta))@{arm}

hobbed-milled | face-hobbed | HOBBED
A cutter of no blade groups with its blade in the plane of the axis mills: any edge is where the machine of face-milled
members has it.
    {milling} = {cut}

formate-cradle | conjugate pairs | PAIR
Where the pinion's cradle is the gear itself, γm = Σ - 90°, Em = E, XD = 0 and R = N2/N1, the machine moves as the pair
of the description does in mesh, turned over: what it cuts is conjugate to the gear, for any offset.
    rolled = meshed

offset | assembly | PAIR
The offset shifts the pinion along the common perpendicular and does nothing else: without it the hypoid pair is a bevel
pair.
    hypoid - vec(0, E, 0) = bevel

assembly-axis | assembly | PAIR
The pinion's axis is (sin Σ, 0, cos Σ); it turns by φ1 about minus that axis.
    pinion_axis = vec(sin(Sigma), 0, cos(Sigma))
    d(hypoid, phi1) = -cross(vec(sin(Sigma), 0, cos(Sigma)), hypoid - vec(0, E, 0))
""",
    globals(),
    both,
)

CHAPTER = Chapter(DOCUMENT, CLAIMS)
