"""A drive outside the tree: an hourglass worm that a plane generates, with a wheel of crowned plane teeth.

The flank of the tool that grinds the worm is a plane tooth of the wheel; the wheel's own flank falls back from that
plane by a parabola, which makes contact a point. Neither tool has a rounded tip, so that no fillet is generated on worm
or wheel. The worm is turned to tori at tip and root; in solids an arc, of a radius that the blank gives, joins root and
flank. Frames: ``f`` fixed, z along the worm's axis, x to the wheel; the wheel's axis is (0, sin Σ, cos Σ) through
(a, 0, 0). The worm turns by +φ1 about z, the wheel by +φ2 about minus its axis. A wheel tooth points along −x of the
wheel at rest. Right hand.
"""

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import Rx, Rz, translation
from derive.language.contact import contact
from derive.language.definitions import Definitions
from derive.language.drive import Body, Drive, Loading, Margin, Source, System, body_point
from derive.language.envelope import envelope, explicit
from derive.language.functions import outline, solid
from derive.language.surface import swept
from derive.language.symbols import Guard, Quantity, Rule, Table, Unknown, parameter, rotation_angle

POSITIVE, ACUTE = (0, sp.oo), (0, sp.pi / 2)

flank = parameter("flank", "s", "flank", table=Table.FLANK, choices=(("left", 1), ("right", -1)), default=1)
threads = parameter("worm_threads", "T_1", "threads of the worm", domain=POSITIVE, integer=True, required=True)
teeth = parameter("wheel_teeth", "T_2", "teeth of the wheel", domain=POSITIVE, integer=True, required=True)
distance = parameter("center_distance_mm", "a", "centre distance", domain=POSITIVE, required=True)
wheel_radius = parameter("wheel_pitch_radius_mm", "r_2", "pitch radius of the wheel", domain=POSITIVE, required=True)
pressure_angle = parameter("pressure_angle_deg", "alpha", "pressure angle at the pitch point", domain=ACUTE,
                           required=True)  # fmt: skip
inclination = parameter("tooth_inclination_deg", "beta", "angle between tooth and wheel axis", domain=ACUTE,
                        required=True)  # fmt: skip
crown = parameter("wheel_crowning_per_mm", "c", "crowning of the wheel's flank", domain=POSITIVE, lower_included=True,
                  default=sp.Rational(1, 1000))  # fmt: skip
thread_length = parameter("worm_length_mm", "L", "length of the threaded part", table=Table.BLANK, domain=POSITIVE)
face_width = parameter("wheel_face_width_mm", "F", "face width of the wheel", table=Table.BLANK, domain=POSITIVE)
height = parameter("addendum_mm", "h", "addendum of both members", table=Table.BLANK, domain=POSITIVE)
rounding = parameter("worm_root_rounding_mm", "rho", "radius between flank and root of the worm", table=Table.BLANK,
                     domain=POSITIVE)  # fmt: skip
error_distance = parameter("center_distance_mm", "da", "centre distance error", table=Table.MISALIGNMENT, default=0)
error_angle = parameter("shaft_angle_deg", "dSigma", "shaft angle error", table=Table.MISALIGNMENT, default=0)
error_axial = parameter("axial_mm", "db", "shift of the wheel along its axis", table=Table.MISALIGNMENT, default=0)
separation = parameter("separation_mm", "delta", "separation for contact ellipses", table=Table.CONTACT,
                       domain=POSITIVE, default=sp.Rational(632, 100000))  # fmt: skip

s, T_1, T_2, a, r_2 = (q.symbol for q in (flank, threads, teeth, distance, wheel_radius))
alpha, beta, h = pressure_angle.symbol, inclination.symbol, height.symbol
half_tooth, module = sp.pi / (2 * T_2), 2 * r_2 / T_2


def tooth_flank(name, crowning, definitions):
    """A flank through the pitch point; parameters (w, u) along the tooth and up to its tip, normal out of the tooth."""
    u, w = (Quantity(f"{q}_{name}", "mm", f"{way} the tooth, {name}", name) for q, way in (("u", "up"), ("w", "along")))
    fall = crowning * (u**2 + w**2)
    tilt = s * sp.cos(alpha) * sp.cos(beta)
    size = v.radius(sp.sin(alpha), tilt)
    normal = (-sp.sin(alpha), tilt, s * sp.cos(alpha) * sp.sin(beta))
    section = (
        -r_2 * sp.cos(half_tooth) - u * s * tilt / size - fall * normal[0],
        r_2 * s * sp.sin(half_tooth) - u * s * sp.sin(alpha) / size - fall * normal[1],
        -fall * normal[2],
    )
    along = translation(y=-w * sp.sin(beta), z=w * sp.cos(beta))
    return swept(definitions, section, along, along=u, sweep=w, outward=s).in_order(w, u)


def hourglass_worm():
    """The drive."""
    definitions = Definitions()
    phi_1 = rotation_angle("phi_worm", "angle of the worm in mesh", "f")
    error = rotation_angle("transmission_error", "wheel angle less ratio times worm angle", "f")
    ratio = definitions.let("ratio", T_1 / T_2, "T1/T2")
    phi_2 = ratio * phi_1 + error

    theta = rotation_angle("theta_worm", "angle of the worm in grinding", "gen")
    grinding = Rz(-theta) @ translation(x=a) @ Rx(-sp.pi / 2) @ Rz(-ratio * theta)
    tool = tooth_flank("tool", sp.Integer(0), definitions)
    thread, solved = explicit(envelope(tool, grinding, theta))
    tooth = tooth_flank("wheel", crown.symbol, definitions)
    w_1, (w_2, u_2) = thread.parameters[0], tooth.parameters

    mounting = translation(x=a + error_distance.symbol) @ Rx(-(sp.pi / 2 + error_angle.symbol))
    mounting = mounting @ translation(z=error_axial.symbol) @ Rz(-phi_2)
    x, y, z = body_point("pinion")
    point, rho = (x, y, z), a - v.radius(x, y)
    tip, root = v.radius(rho, z) - r_2 + h, r_2 + sp.Rational(6, 5) * h - v.radius(rho, z)
    worm = Body(
        "pinion", thread, Rz(phi_1), {w_1: sp.Integer(0), theta: sp.Integer(0)}, point=point,
        margins=(
            Margin("off_tip", "tip", tip),
            Margin("off_root", "root", root),
            Margin("off_face", "face", thread_length.symbol / 2 - sp.Abs(z)),
        ),
        recovered=(solved.symbol,),
        lengthwise="",
    )  # fmt: skip
    x, y, z = body_point("wheel")
    wheel = Body(
        "wheel", tooth, mounting, {w_2: sp.Integer(0), u_2: sp.Integer(0)}, point=(x, y, z),
        margins=(
            Margin("off_tip", "tip", r_2 + h - v.radius(x, y)),
            Margin("off_root", "root", v.radius(x, y) - r_2 + sp.Rational(6, 5) * h),
            Margin("off_face", "face", face_width.symbol / 2 - sp.Abs(z)),
        ),
        lengthwise="axial",
    )  # fmt: skip
    thread_sizes = {
        "module": (module, "mm"), "tip_radius": (a - r_2 + h, "mm"),
        "root_radius": (a - r_2 - sp.Rational(6, 5) * h, "mm"), "rounding": (rounding.symbol, "mm"),
    }  # fmt: skip
    start = System(
        "start", definitions, (), (),
        {w_1: sp.Integer(0), theta: phi_1, w_2: sp.Integer(0), u_2: solved.symbol, error: sp.Integer(0)},
        fixed={w_1: sp.Integer(0), theta: phi_1},
    )  # fmt: skip
    return Drive(
        name="hourglass_worm",
        family="hourglass-worm",
        title="Hourglass worm ground by a plane, with a crowned wheel of plane teeth",
        parameters=(
            flank, threads, teeth, distance, wheel_radius, pressure_angle, inclination, crown, thread_length,
            face_width, height, rounding, error_distance, error_angle, error_axial, separation,
        ),
        rules=(
            Rule(height.symbol, sp.Rational(7, 10) * module),
            Rule(rounding.symbol, module / 5),
            Rule(thread_length.symbol, r_2),
            Rule(face_width.symbol, (a - r_2)),
        ),
        guards=(Guard(a - r_2, "the wheel is as large as the centre distance: no worm is left",
                      (distance.key, wheel_radius.key)),),
        sizes=(("ratio", T_1 / T_2, "wheel turns per worm turn"),),
        instant=phi_1,
        error=error,
        pinion=worm,
        wheel=wheel,
        unknowns=tuple(Unknown(q) for q in (w_1, theta, w_2, u_2, error)),
        residual=contact(worm.placed, wheel.placed),
        definitions=definitions,
        start=start,
        guess={},
        sample={
            "flank": 1, "worm_threads": 1, "wheel_teeth": 40, "center_distance_mm": 125, "wheel_pitch_radius_mm": 100,
            "pressure_angle_deg": 22, "tooth_inclination_deg": 8,
        },
        sample_angle=0.5,
        pinion_teeth=threads.key,
        handed="right",
        loading=Loading(pairs=5, torque_on="wheel"),
        functions=(solid("pinion", thread_sizes), outline("pinion", point, tip, root)),
        sources=(Source("F. L. Litvin, A. Fuentes", "Gear Geometry and Applied Theory", 2004, "chapter 20"),),
    )  # fmt: skip


def catalogue():
    """The one drive of this file."""
    return {"hourglass_worm": hourglass_worm}
