"""Beveloid (conical involute) gears on skew or intersecting axes: a plane rack tilted by the cone angle cuts each.

Body frame of a gear: z along its axis, the tooth is centred on x at rest. The rack's pitch plane touches the pitch
cylinder of generation, radius m N/2 at z = 0, and is tilted: along the rack tooth the plane goes out by tan(delta) z,
that is, the profile shift grows with z. Frames: ``f`` fixed, z along the pinion's axis, x from pinion to wheel; the
wheel's axis is (0, sin S, cos S) tilted by K about y through (a, 0, 0): axes skew (S) and inclined (K).
"""

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import Rx, Ry, Rz, translation
from derive.language.contact import contact
from derive.language.definitions import Definitions
from derive.language.drive import Body, Drive, Loading, Margin, Source, System, body_point
from derive.language.envelope import envelope, explicit
from derive.language.surface import swept
from derive.language.symbols import Quantity, Rule, Table, Unknown, parameter, rotation_angle

POS, ACUTE, ANGLE = (0, sp.oo), (0, sp.pi / 2), (-sp.pi / 2, sp.pi / 2)
flank = parameter("flank", "s", "flank", table=Table.FLANK, choices=(("left", 1), ("right", -1)), default=1)
module = parameter("normal_module_mm", "m", "normal module", domain=POS, required=True)
pressure = parameter("pressure_angle_deg", "alpha", "normal pressure angle", domain=ACUTE, required=True)
N = {b: parameter(f"{b}_teeth", f"N_{b}", f"teeth of the {b}", domain=POS, integer=True, required=True)
     for b in ("pinion", "wheel")}  # fmt: skip
CONE = {b: parameter(f"{b}_cone_angle_deg", f"cone_{b}", f"cone angle of the {b}", domain=ANGLE, required=True)
        for b in ("pinion", "wheel")}  # fmt: skip
HELIX = {b: parameter(f"{b}_helix_angle_deg", f"beta_{b}", f"helix angle of the {b}'s rack", domain=ANGLE, default=0)
         for b in ("pinion", "wheel")}  # fmt: skip
distance = parameter("center_distance_mm", "a", "distance of the axes at z = 0", domain=POS)
skew = parameter("shaft_angle_deg", "S", "crossing angle of the axes", domain=ANGLE, default=0)
tilt = parameter("tilt_deg", "K", "inclination of the axes to each other", domain=ANGLE)
face = parameter("face_width_mm", "b", "face width of both", domain=POS, required=True)
e_a = parameter("center_distance_mm", "da", "centre distance error", table=Table.MISALIGNMENT, default=0)
e_S = parameter("shaft_angle_deg", "dS", "error of the crossing angle", table=Table.MISALIGNMENT, default=0)
e_K = parameter("tilt_deg", "dK", "error of the inclination", table=Table.MISALIGNMENT, default=0)
e_z = parameter("axial_mm", "dz", "shift of the wheel along its axis", table=Table.MISALIGNMENT, default=0)
separation = parameter("separation_mm", "delta", "separation for contact ellipses", table=Table.CONTACT,
                       domain=POS, default=sp.Rational(632, 100000))  # fmt: skip
s, m, alpha, a, b = (q.symbol for q in (flank, module, pressure, distance, face))


def tooth(name, defs):
    """A flank of the conical gear, explicit in the place along the rack's edge and along the rack's tooth."""
    n, cone, beta = N[name].symbol, CONE[name].symbol, HELIX[name].symbol
    radius = m * n / (2 * sp.cos(beta))
    l, w = (Quantity(f"{q}_{name}", "mm", f"{t} the rack, {name}", name) for q, t in (("l", "up"), ("w", "along")))
    # space of the rack, in its own frame: x out of the gear, y along the rack, z along its tooth
    section = (l * sp.cos(alpha), s * (sp.pi * m / 4 - l * sp.sin(alpha)), sp.Integer(0))
    along = Ry(cone) @ Rx(-beta) @ translation(z=w)
    rack = swept(defs, section, along, along=l, sweep=w, outward=s)
    phi = rotation_angle(f"phi_gen_{name}", f"turn of the {name} in generation", "gen")
    rolling = Rz(phi) @ translation(x=radius, y=-radius * phi)
    surface, solved = explicit(envelope(rack, rolling, phi))
    return surface, solved, radius, l, w


def beveloid():
    """The pair."""
    defs = Definitions()
    phi_1 = rotation_angle("phi_pinion", "angle of the pinion in mesh", "f")
    error = rotation_angle("transmission_error", "wheel angle less ratio times pinion angle", "f")
    ratio = defs.let("ratio", N["pinion"].symbol / N["wheel"].symbol, "N1/N2")
    phi_2 = ratio * phi_1 + error
    surface_1, solved_1, r_1, l_1, w_1 = tooth("pinion", defs)
    surface_2, solved_2, r_2, l_2, w_2 = tooth("wheel", defs)
    half = {q: s * sp.pi / (2 * N[q].symbol) for q in N}
    mounting = translation(x=r_1) @ Rx(-(skew.symbol + e_S.symbol)) @ Ry(tilt.symbol + e_K.symbol)
    mounting = mounting @ translation(x=a - r_1 + e_a.symbol, z=e_z.symbol) @ Rz(sp.pi - phi_2 - half["wheel"])

    def body(name, surface, motion, radius, l, w, solved):
        x, y, z = body_point(name)
        reach = radius + z * sp.tan(CONE[name].symbol)
        return Body(
            name, surface, motion, {l: sp.Integer(0), w: sp.Integer(0)}, point=(x, y, z), lengthwise="axial",
            recovered=(solved.symbol,),
            margins=(Margin("off_tip", "tip", reach + m - v.radius(x, y)),
                     Margin("off_root", "root", v.radius(x, y) - reach + m),
                     Margin("off_face", "face", b / 2 - sp.Abs(z))))  # fmt: skip

    pinion = body("pinion", surface_1, Rz(phi_1 - half["pinion"]), r_1, l_1, w_1, solved_1)
    wheel = body("wheel", surface_2, mounting, r_2, l_2, w_2, solved_2)
    zero = sp.Integer(0)
    return Drive(
        name="beveloid", family="beveloid", title="Conical involute gears",
        parameters=(flank, module, pressure, *N.values(), *CONE.values(), *HELIX.values(), distance, skew, tilt, face,
                    e_a, e_S, e_K, e_z, separation),
        rules=(Rule(a, r_1 + r_2), Rule(tilt.symbol, CONE["pinion"].symbol + CONE["wheel"].symbol)),
        guards=(),
        instant=phi_1, error=error, pinion=pinion, wheel=wheel,
        unknowns=tuple(Unknown(q, m) for q in (l_1, w_1, l_2, w_2)) + (Unknown(error),),
        residual=contact(pinion.placed, wheel.placed), definitions=defs,
        start=System("start", defs, (), (), dict.fromkeys((l_1, w_1, l_2, w_2, error), zero)), guess={},
        sample={"flank": 1, "normal_module_mm": 3, "pressure_angle_deg": 20, "pinion_teeth": 24, "wheel_teeth": 36,
                "pinion_cone_angle_deg": 10, "wheel_cone_angle_deg": 12, "face_width_mm": 20},
        sample_angle=0.02, pinion_teeth=N["pinion"].key, handed="right",
        loading=Loading(pairs=3, torque_on="pinion"),
        sources=(Source("F. L. Litvin, A. Fuentes", "Gear Geometry and Applied Theory", 2004, "chapter 16"),),
    )  # fmt: skip


def catalogue():
    return {"beveloid": beveloid}
