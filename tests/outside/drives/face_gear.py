"""Face gear: an involute shaper cuts the gear on an intersecting axis, an involute pinion with fewer teeth meets it.

Frames: ``f`` fixed, z along the shaper's axis, x through the pitch point to the gear; the gear's axis passes through
the origin along (-sin S, 0, cos S). The pinion turns by +phi1 about z, the gear by +phi2 about its axis. A tooth of
shaper and pinion is centred on x at rest. (F. L. Litvin, A. Fuentes, chapter 18)
"""

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import Ry, Rz, translation
from derive.language.contact import contact
from derive.language.definitions import Definitions
from derive.language.drive import Body, Drive, Loading, Margin, Region, Role, Source, System, body_point
from derive.language.envelope import envelope, explicit
from derive.language.functions import Function, Result
from derive.language.surface import swept
from derive.language.symbols import Guard, Quantity, Rule, Table, Unknown, parameter, rotation_angle

POS, ACUTE = (0, sp.oo), (0, sp.pi / 2)
flank = parameter("flank", "s", "flank", table=Table.FLANK, choices=(("left", 1), ("right", -1)), default=1)
module = parameter("module_mm", "m", "module", domain=POS, required=True)
pressure = parameter("pressure_angle_deg", "alpha", "pressure angle", domain=ACUTE, required=True)
teeth_1 = parameter("pinion_teeth", "N_1", "teeth of the pinion", domain=POS, integer=True, required=True)
teeth_s = parameter("shaper_teeth", "N_s", "teeth of the shaper", domain=POS, integer=True, required=True)
teeth_2 = parameter("wheel_teeth", "N_2", "teeth of the face gear", domain=POS, integer=True, required=True)
shaft = parameter("shaft_angle_deg", "Sigma", "shaft angle", domain=(0, sp.pi), default=sp.pi / 2)
crown = parameter("pinion_lead_crowning_um", "C", "lead crowning of the pinion", default=0)
inner = parameter("inner_radius_mm", "L_1", "inner radius of the face gear", table=Table.BLANK, domain=POS)
outer = parameter("outer_radius_mm", "L_2", "outer radius of the face gear", table=Table.BLANK, domain=POS)
rounding = parameter("shaper_tip_rounding_mm", "rho", "rounding of the shaper's tip", table=Table.BLANK, domain=POS)
d_E = parameter("offset_mm", "dE", "offset of the gear's axis", table=Table.MISALIGNMENT, default=0)
d_S = parameter("shaft_angle_deg", "dS", "shaft angle error", table=Table.MISALIGNMENT, default=0)
d_q = parameter("axial_mm", "dq", "shift of the gear along its axis", table=Table.MISALIGNMENT, default=0)
separation = parameter("separation_mm", "delta", "separation for contact ellipses", table=Table.CONTACT,
                       domain=POS, default=sp.Rational(632, 100000))  # fmt: skip
s, m, alpha, N_1, N_s, N_2, Sigma, C, L_1, L_2, rho = (
    q.symbol for q in (flank, module, pressure, teeth_1, teeth_s, teeth_2, shaft, crown, inner, outer, rounding))
tangent = sp.tan(alpha)


class Involute:
    """A spur involute tooth centred on x; the parameters are roll angle and z."""

    def __init__(self, name, teeth, definitions, crowning):
        self.name, self.radius, self.defs = name, m * teeth / 2, definitions
        self.base = definitions.let(f"r_b_{name}", self.radius * sp.cos(alpha), "base radius", "mm")
        self.half = definitions.let(f"half_{name}", sp.pi / (2 * teeth) + tangent - alpha, "half tooth, base", "rad")
        self.roll = Quantity(f"roll_{name}", "rad", "roll angle", name)
        self.z = Quantity(f"z_{name}", "mm", "place across the face", name)
        r, t = self.base, self.roll
        section = Rz(s * self.half).direction(
            (r * (sp.cos(t) + t * sp.sin(t)), -s * r * (sp.sin(t) - t * sp.cos(t)), sp.Integer(0)))
        # crowned about the pitch point of the gear, z = m N_2/2
        middle = m * N_2 / 2
        fall = C / r * (2 * (self.z - middle) / (L_2 - L_1)) ** 2 if crowning else 0
        motion = Rz(-s * fall) @ translation(z=self.z)
        self.surface = swept(definitions, section, motion, along=t, sweep=self.z, outward=-s)

    def roll_at(self, radius):
        return v.root((radius / self.base) ** 2 - 1)


def face_gear():
    """The pair."""
    defs = Definitions()
    phi_1 = rotation_angle("phi_pinion", "angle of the pinion in mesh", "f")
    error = rotation_angle("transmission_error", "gear angle less ratio times pinion angle", "f")
    ratio = defs.let("ratio", N_1 / N_2, "N1/N2")
    phi_2 = ratio * phi_1 + error
    pinion, shaper = Involute("pinion", N_1, defs, True), Involute("shaper", N_s, defs, False)
    phi_s = rotation_angle("phi_shaper", "angle of the shaper in cutting", "gen")
    cutting = Rz(-N_s / N_2 * phi_s) @ Ry(Sigma) @ Rz(phi_s)
    gear, solved = explicit(envelope(shaper.surface, cutting, phi_s))
    # fillet: the shaper's rounded tip, an arc that touches the involute where its centre is rho below the tip circle
    tip = shaper.radius + sp.Rational(5, 4) * m
    centre_roll = v.root(((tip - rho) / shaper.base) ** 2 - 1) + rho / shaper.base
    start = defs.let("roll_tip", centre_roll, "roll angle where the rounding of the shaper begins", "rad")
    xi = Quantity("xi_shaper", "rad", "turn of the normal along the rounding", "shaper")
    z_f = Quantity("z_fillet", "mm", "place along the rounding", "shaper")
    r, c, d = shaper.base, sp.cos(start), sp.sin(start)
    along, normal = (c, d), (d, -c)  # tangent of the involute outwards, normal out of the tooth (before mirroring)
    cx, cy = r * (c + start * d) - rho * d, r * (d - start * c) + rho * c
    arc = [q + rho * (sp.cos(xi) * n + sp.sin(xi) * a) for q, n, a in zip((cx, cy), normal, along, strict=True)]
    arc = Rz(s * shaper.half).direction((arc[0], -s * arc[1], sp.Integer(0)))
    tip_surface = swept(defs, arc, translation(z=z_f), along=xi, sweep=z_f, outward=-s)
    phi_f = rotation_angle("phi_fillet", "angle of the shaper where it cuts the fillet", "gen")
    cutting_f = Rz(-N_s / N_2 * phi_f) @ Ry(Sigma) @ Rz(phi_f)
    fillet, _ = explicit(envelope(tip_surface, cutting_f, phi_f))
    last = v.arc(cx * c + cy * d, cx * d - cy * c)  # where the normal is radial
    x, y, z = body_point("pinion")
    body_1 = Body(
        "pinion", pinion.surface, translation(x=m * (N_s - N_1) / 2) @ Rz(phi_1),
        {pinion.roll: tangent, pinion.z: m * N_2 / 2}, point=(x, y, z), lengthwise="axial",
        margins=(Margin("off_tip", "tip", m * N_1 / 2 + m - v.radius(x, y)),
                 Margin("off_face", "face", (z - L_1) * (L_2 - z) / (L_2 - L_1)),
                 Margin("off_root", "root", pinion.roll)),
    )  # fmt: skip
    x, y, z = body_point("wheel")
    R = v.radius(x, y)
    body_2 = Body(
        "wheel", gear, translation(y=d_E.symbol) @ Ry(-(Sigma + d_S.symbol)) @ translation(z=d_q.symbol) @ Rz(phi_2),
        {shaper.roll: tangent, phi_s: -s * sp.pi / (2 * N_s)}, point=(x, y, z), lengthwise="radius",
        margins=(Margin("off_tip", "tip", (m - m * N_s / 2 - z)),
                 Margin("off_face", "face", (R - L_1) * (L_2 - R) / (L_2 - L_1)),
                 Margin("off_root", "root", start - shaper.roll, Role.JUNCTION, joins="fillet")),
    )  # fmt: skip
    begin = phi_1 * N_1 / N_s
    turned = phi_1 + s * sp.pi / (2 * N_1)
    fixed = {shaper.roll: tangent + s * turned * N_1 / N_s, phi_s: begin}
    start_system = System("start", defs, (), (), {
        pinion.roll: tangent + s * turned, pinion.z: solved.symbol, **fixed, error: sp.Integer(0)}, fixed=fixed)
    first = shaper.roll_at(m * N_s / 2 - m)
    return Drive(
        name="face_gear", family="face-gear", title="Face gear cut by a shaper, with an involute pinion",
        parameters=(flank, module, pressure, teeth_1, teeth_s, teeth_2, shaft, crown, inner, outer, rounding, d_E, d_S,
                    d_q, separation),
        rules=(Rule(L_1, m * N_2 / 2 - 3 * m), Rule(L_2, m * N_2 / 2 + 5 * m), Rule(rho, m / 5)),
        guards=(Guard(N_s - N_1 + sp.Rational(1, 2), "the shaper has fewer teeth than the pinion",
                      (teeth_s.key, teeth_1.key)),
                Guard(L_2 - L_1, "the outer radius must exceed the inner", (inner.place, outer.place))),
        instant=phi_1, error=error, pinion=body_1, wheel=body_2,
        regions=(Region("wheel", "fillet", fillet, sp.Integer(-1), (Margin("", "junction", xi, joins="flank"),
                                                       Margin("", "bottom", last - xi)), "radius"),),
        unknowns=tuple(Unknown(q) for q in (pinion.roll, pinion.z, shaper.roll, phi_s, error)),
        residual=contact(body_1.placed, body_2.placed), definitions=defs, start=start_system, guess={},
        sample={"flank": 1, "module_mm": 3, "pressure_angle_deg": 25, "pinion_teeth": 25, "shaper_teeth": 28,
                "wheel_teeth": 160},
        sample_angle=-0.03, pinion_teeth=teeth_1.key, handed="right", loading=Loading(pairs=3, torque_on="pinion"),
        functions=(
            Function("undercut_range_wheel", "roll angles between which undercut is sought", (), tuple(
                Result(n, (e,), "rad", "wheel") for n, e in
                (("first", first), ("start", start), ("middle", tangent), ("last", start)))),
            Function("undercut_place_wheel", "radius on the shaper", gear.parameters,
                     (Result("radius", (shaper.base * v.root(1 + shaper.roll**2),), "mm", "wheel"),)),
        ),
        sources=(Source("F. L. Litvin, A. Fuentes", "Gear Geometry and Applied Theory", 2004, "chapter 18"),),
    )  # fmt: skip


def catalogue():
    return {"face_gear": face_gear}
