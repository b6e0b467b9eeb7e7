"""Cycloidal drive: a disc whose lobes are enveloped by the pins of a ring, internal contact; the pins are barrels.

Frames: ``f`` fixed, z along the disc's axis; the ring's axis passes through (-e, 0, 0). Both turn about +z. Pin 0 lies
on x of the ring at rest. Each pin is in contact all the way round; the word ``flank`` chooses on which side of the line
of centres it is.
"""

import sympy as sp

from derive.language.chain import Rx, Ry, Rz, translation
from derive.language.contact import contact
from derive.language.definitions import Definitions
from derive.language.drive import Body, Drive, Loading, Margin, Source, System, body_point
from derive.language.envelope import envelope, explicit_angle
from derive.language.surface import swept
from derive.language.symbols import Guard, Quantity, Table, Unknown, parameter, rotation_angle

POS = (0, sp.oo)
flank = parameter("flank", "s", "side", table=Table.FLANK, choices=(("left", 1), ("right", -1)), default=1)
lobes = parameter("disc_lobes", "N_1", "lobes of the disc", domain=POS, integer=True, required=True)
pins = parameter("ring_pins", "N_2", "pins of the ring", domain=POS, integer=True, required=True)
circle = parameter("pin_circle_radius_mm", "R_p", "radius on which the pins lie", domain=POS, required=True)
radius = parameter("pin_radius_mm", "r_p", "radius of a pin", domain=POS, required=True)
eccentric = parameter("eccentricity_mm", "e", "distance of the axes", domain=POS, required=True)
face = parameter("face_width_mm", "b", "face width", domain=POS, required=True)
barrel = parameter("pin_barrel_um", "C", "by how much a pin is thinner at the ends", default=sp.Rational(1, 100))
e_e = parameter("eccentricity_mm", "de", "error of the distance of the axes", table=Table.MISALIGNMENT, default=0)
e_x = parameter("tilt_x_deg", "dx", "tilt of the ring about x", table=Table.MISALIGNMENT, default=0)
e_y = parameter("tilt_y_deg", "dy", "tilt of the ring about y", table=Table.MISALIGNMENT, default=0)
separation = parameter("separation_mm", "delta", "separation for contact ellipses", table=Table.CONTACT,
                       domain=POS, default=sp.Rational(632, 100000))  # fmt: skip
s, N_1, N_2, R_p, r_p, e, b, C = (q.symbol for q in (flank, lobes, pins, circle, radius, eccentric, face, barrel))


def pin(name, fall, defs):
    """The surface of a pin; parameters tau around it and z along it."""
    tau = Quantity(f"tau_{name}", "rad", f"angle around the {name}", name, parity=-1)
    z = Quantity(f"z_{name}", "mm", f"place along the {name}", name)
    r = r_p - fall(z)
    section = (R_p + r * sp.cos(tau), r * sp.sin(tau), sp.Integer(0))
    return swept(defs, section, translation(z=z), along=tau, sweep=z, outward=1), tau, z


def pin_wheel():
    """The pair."""
    defs = Definitions()
    phi_1 = rotation_angle("phi_disc", "angle of the disc in mesh", "f")
    error = rotation_angle("transmission_error", "ring angle less ratio times disc angle", "f")
    ratio = defs.let("ratio", N_1 / N_2, "N1/N2")
    phi_2 = ratio * phi_1 + error
    tool, tau_t, z_1 = pin("tool", lambda z: 0, defs)
    phi_g = rotation_angle("phi_gen", "angle of the disc in generation", "gen")
    cutting = Rz(-phi_g) @ translation(x=-e) @ Rz(N_1 / N_2 * phi_g)
    disc = envelope(tool.with_pole((R_p, sp.Integer(0), sp.Integer(0))), cutting, phi_g)
    disc = explicit_angle(disc, tau_t, sign=1).in_order(phi_g, z_1)
    tau_d = next(symbol for symbol, _ in defs.items() if symbol.name == tau_t.name)
    surface, tau, z_2 = pin("pin", lambda z: C * (2 * z / b) ** 2, defs)
    side = s * sp.pi / 3  # of the pin from the line of centres at phi_1 = 0
    x, y, z = body_point("pinion")
    body_1 = Body("pinion", disc, Rz(phi_1 + side * N_2 / N_1), {phi_g: side * N_2 / N_1, z_1: sp.Integer(0)},
                  point=(x, y, z), lengthwise="axial", recovered=(tau_d,),
                  margins=(Margin("off_tip", "tip", s * sp.sin(N_1 / N_2 * phi_g)),
                           Margin("off_face", "face", b / 2 - sp.Abs(z))))  # fmt: skip
    x, y, z = body_point("wheel")
    mounting = translation(x=-e - e_e.symbol) @ Rx(e_x.symbol) @ Ry(e_y.symbol) @ Rz(phi_2 + side)
    body_2 = Body("wheel", surface, mounting, {tau: sp.pi, z_2: sp.Integer(0)}, point=(x, y, z), lengthwise="axial",
                  margins=(Margin("off_face", "face", b / 2 - sp.Abs(z)),))  # fmt: skip
    fixed = {phi_g: phi_1 + side * N_2 / N_1}
    return Drive(
        name="pin_wheel", family="pin-wheel", title="Cycloidal disc in a ring of barrel-shaped pins",
        parameters=(flank, lobes, pins, circle, radius, eccentric, face, barrel, e_e, e_x, e_y, separation),
        rules=(), guards=(Guard(R_p - e * N_2, "the pins lie inside the pitch circle: shortening above 1",
                                (circle.key, eccentric.key, pins.key)),),
        instant=phi_1, error=error, pinion=body_1, wheel=body_2,
        unknowns=tuple(Unknown(q) for q in (phi_g, z_1, tau, z_2, error)),
        residual=contact(body_1.placed, body_2.placed), definitions=defs,
        start=System("start", defs, (), (), {**fixed, z_1: sp.Integer(0), tau: tau_d, z_2: sp.Integer(0),
                                             error: sp.Integer(0)}, fixed=fixed), guess={},
        sample={"flank": 1, "disc_lobes": 11, "ring_pins": 12, "pin_circle_radius_mm": 60, "pin_radius_mm": 6,
                "eccentricity_mm": 3, "face_width_mm": 12},
        sample_angle=0.03, pinion_teeth=lobes.key, handed="right", loading=Loading(pairs=5, torque_on="pinion"),
        sources=(Source("F. L. Litvin, A. Fuentes", "Gear Geometry and Applied Theory", 2004, "chapter 13"),),
    )  # fmt: skip


def catalogue():
    return {"pin_wheel": pin_wheel}
