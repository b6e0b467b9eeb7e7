"""Face worm gear drives: a conical or cylindrical worm above a face gear, both cut by a tilted head-cutter.

Frames: ``f`` fixed, z the gear axis, x along the worm axis, y the common perpendicular; the worm axis lies at
y = E_m, z = 0 and the gear body at z < 0. The worm turns by +φ1 about x, the gear by +φ2 about z. Right-hand thread.
A hob-cut reference design gives three points; the head-cutter whose blade passes
through them copies its cone into the gear and, with a parabolic blade and plunge, envelopes the worm. One drive is
one flank: both flanks have settings of their own.
"""

from dataclasses import dataclass

import sympy as sp

from derive.drives import face_worm_keys as k
from derive.drives import outlines
from derive.language import vectors as v
from derive.language.chain import Ry, Rz, placement, station, translation
from derive.language.contact import contact
from derive.language.definitions import Definitions
from derive.language.drive import (
    PATH,
    TOE_AND_HEEL,
    Body,
    DesignSystem,
    Drive,
    Loading,
    Margin,
    Region,
    Role,
    Source,
    System,
    ToolUse,
    body_point,
)
from derive.language.envelope import envelope, nearest_turn
from derive.language.functions import Function, Result, ToolClearance, solid
from derive.language.origin import Origin
from derive.language.replace import replaced
from derive.language.surface import Surface
from derive.language.symbols import Guard, Quantity, Rule, Unknown, rotation_angle
from derive.tools.conical_hob import HobBody, conical_hob
from derive.tools.head_cutter import HeadCutterBody, head_cutter

s, N_1, N_2, m_ax = (q.symbol for q in (k.flank, k.threads, k.teeth, k.axial_module))
E_m, L, cone, alpha = (q.symbol for q in (k.offset, k.worm_position, k.cone_angle, k.profile_angle))
R_in, R_out = k.inner_radius.symbol, k.outer_radius.symbol
R_g, alpha_g, tilt_change = k.cutter_radius.symbol, k.blade_angle.symbol, k.tilt_change.symbol

SOURCES = (
    Source(
        "F. L. Litvin, A. Nava, Q. Fan, A. Fuentes",
        "New geometry of worm face gear drives with conical and cylindrical worms: generation, simulation of meshing, "
        "and stress analysis",
        2002,
        "NASA/CR-2002-211895",
    ),
)

#: Derived sizes that every formula shares.
p_1 = m_ax * N_1 / 2
r_p = k.pitch_diameter.symbol / 2
ratio = N_1 / N_2
taper = sp.tan(cone)
crossing = Ry(sp.pi / 2)  # worm axes to fixed axes: the worm's z is the fixed x


# -- the reference design: what a hob shaped like the worm would cut ------------------------------------------------


@dataclass(frozen=True)
class HobCut:
    """The flank that the hob would cut, gear frame, in three parameters that its meshing equation relates."""

    surface: Surface
    u: Quantity
    theta: Quantity
    psi: Quantity

    def at(self, u, theta, psi):
        """Point and (unscaled) normal at these parameters."""
        place = {self.u: sp.sympify(u), self.theta: sp.sympify(theta), self.psi: sp.sympify(psi)}

        def put(vector):
            return tuple(replaced(c, place) for c in vector)

        return put(self.surface.body_point), put(self.surface.body_normal)

    @property
    def meshing(self):
        return self.surface.conditions[0]


def hob_cut(definitions):
    """The hob turns by ψ about its axis at (L, E_m, 0), the blank by ψ·N1/N2 about z."""
    u = Quantity("u_hob", "mm", "along the hob's profile from the pitch cone", "hob")
    theta = rotation_angle("theta_hob", "screw angle of the hob flank", "hob")
    psi = rotation_angle("psi_hob", "angle of the hob in cutting", "gen")
    body = HobBody(
        along=u, sweep=theta, phase=k.hob_phase.symbol, pitch_radius=r_p, screw_parameter=p_1, cone_angle=cone,
        profile_angle=alpha, flank=s,
    )  # fmt: skip
    hob = conical_hob(body, definitions)
    cutting = Rz(-ratio * psi) @ translation(L, E_m, 0) @ crossing @ Rz(psi)
    return HobCut(envelope(hob, cutting, psi).on("face_worm/harmonic"), u, theta, psi)


def _pitch_cones():
    """Radius and height of the point where the pitch cones of worm and gear touch."""
    sine = -taper * E_m / (L + r_p * taper)
    return v.radius(L, E_m + r_p * sine), -r_p * sp.sqrt(1 - sine**2)


def _pitch_point(reference):
    """The pitch point by either rule: u = θ = 0, or where the pitch cones touch."""
    x, y, z = reference.surface.body_point
    radius, height = _pitch_cones()
    cones = k.pitch_rule.symbol
    return DesignSystem(
        name="pitch_point",
        unknowns=(Unknown(reference.u, m_ax), Unknown(reference.theta), Unknown(reference.psi)),
        residual=(
            cones * (v.radius(x, y) - radius) + (1 - cones) * reference.u,
            cones * (z - height) + (1 - cones) * m_ax * reference.theta,
            reference.meshing,
        ),
        guess={reference.u: 0, reference.theta: 0, reference.psi: 0},
        fills=dict(zip(k.symbols(k.hob_at_pitch_point), (reference.u, reference.theta, reference.psi), strict=True)),
        message="no pitch point: the hob does not touch the gear there",
        keys=(k.worm_position.key, k.offset.key, k.pitch_diameter.key, k.profile_angle.key, k.pitch_rule.key),
    )


def _middle_line_point(reference, name, at, end, keys):
    """The point that the middle of the hob's profile cuts at the radius ``end``, followed from the section x = L."""
    x, y, _ = reference.surface.body_point
    (x_0, y_0, _), _ = reference.at(0, 0, 0)
    wanted = (1 - PATH) * v.radius(x_0, y_0) + PATH * end
    return DesignSystem(
        name=name,
        unknowns=(Unknown(reference.theta), Unknown(reference.psi)),
        residual=(v.radius(x, y) - wanted, reference.meshing),
        guess={reference.theta: 0, reference.psi: 0},
        fills=dict(zip(k.symbols(at), (reference.theta, reference.psi), strict=True)),
        message="the hob of the reference design undercuts the gear inside its face, or does not reach this radius",
        keys=keys,
        fixed={reference.u: sp.Integer(0)},
        regular=(reference.surface, -s),
    )


def _point_rules(reference):
    points = (
        (k.inner_point, (0, *k.symbols(k.hob_at_inner))),
        (k.pitch_point, k.symbols(k.hob_at_pitch_point)),
        (k.outer_point, (0, *k.symbols(k.hob_at_outer))),
    )
    return [
        Rule(target, value)
        for names, at in points
        for target, value in zip(k.symbols(names), reference.at(*at)[0], strict=True)
    ]


# -- the head-cutter: a circle through the three points, a blade along the cross-section at P -----------------------


@dataclass(frozen=True)
class Frame:
    """Axes of the head-cutter in the gear frame and the blade angle that makes it touch the reference flank at P."""

    x: tuple
    y: tuple
    z: tuple
    blade_angle: sp.Expr


def _frame(reference, x, y, z):
    """A section across the tooth holds the blade: its direction is normal to y and to the reference normal."""
    _, normal = reference.at(*k.symbols(k.hob_at_pitch_point))
    edge = v.cross(normal, y)
    return Frame(x, y, z, sp.atan(v.dot(edge, x) / v.dot(edge, z)))


def _cutter_rules(reference, definitions):
    """Axes, radius, blade angle and origin, in this order; each may be given instead.

    A change of the tilt turns the tool about the tooth's tangent at P. It keeps the tangent plane there, by the
    blade angle, and the lengthwise curvature cos(blade angle)/radius.
    """
    inner, pitch, outer = (k.symbols(p) for p in (k.inner_point, k.pitch_point, k.outer_point))
    centre, normal = v.circle_centre(inner, pitch, outer)
    centre = definitions.let_vector(
        "circle_centre", centre, "centre of the circle through A1, P, A2", "mm", "wheel", Origin("derivation/circle")
    )
    normal = definitions.let_vector("circle_plane", normal, "normal of its plane, any length", "", "wheel")
    upward = v.scale(normal[2] / sp.Abs(normal[2]), v.unit(normal))
    z_c = definitions.let_vector("circle_axis", upward, "axis of the circle", "", "wheel")
    spoke = v.sub(pitch, centre)
    radius = definitions.let("circle_radius", v.norm(spoke), "radius of the circle", "mm")
    x_c = definitions.let_vector("circle_spoke", v.scale(1 / radius, spoke), "from centre to P", "", "wheel")
    plain = _frame(reference, x_c, v.cross(z_c, x_c), z_c)
    turn = placement(plain.x, plain.y, plain.z, (0, 0, 0)) @ Ry(tilt_change)
    x_g, y_g, z_g = (k.symbols(a) for a in (k.axis_x, k.axis_y, k.axis_z))
    axes = (turn.direction(axis) for axis in v.AXES.values())
    frame = _frame(reference, x_g, y_g, z_g)
    rules = [
        Rule(target, value)
        for names, axis in zip((x_g, y_g, z_g), axes, strict=True)
        for target, value in zip(names, axis, strict=True)
    ]
    rules.append(Rule(alpha_g, frame.blade_angle))
    rules.append(Rule(R_g, radius * sp.cos(frame.blade_angle) / sp.cos(plain.blade_angle)))
    origin = v.sub(pitch, v.scale(R_g, x_g))
    rules += [Rule(target, value) for target, value in zip(k.symbols(k.origin), origin, strict=True)]
    return rules


def _collinear():
    inner, pitch, outer = (k.symbols(p) for p in (k.inner_point, k.pitch_point, k.outer_point))
    a, b = v.unit(v.sub(pitch, inner)), v.unit(v.sub(outer, pitch))
    bend = v.norm(v.cross(a, b))
    return Guard(
        bend - sp.Rational(1, 10**8),
        "A1, P and A2 lie in line: no head-cutter passes through them",
        (k.inner_radius.key, k.outer_radius.key, k.pitch_rule.key, k.profile_angle.key),
    )


# -- the drive ------------------------------------------------------------------------------------------------------


def face_worm():
    """The drive of one flank."""
    definitions = Definitions()
    reference = hob_cut(definitions)
    blades = HeadCutterBody(R_g, alpha_g, s, k.fillet_radius.symbol, k.blade_depth.symbol)
    cutter = head_cutter(blades, definitions)
    x_g, y_g, z_g = (k.symbols(a) for a in (k.axis_x, k.axis_y, k.axis_z))
    x_0, y_0, z_0 = k.symbols(k.origin)
    installed = placement(x_g, y_g, z_g, (x_0, y_0, z_0))

    phi_1 = rotation_angle("phi_worm", "angle of the worm in mesh", "f")
    error = rotation_angle("transmission_error", "gear angle less ratio times worm angle", "f")
    phi_2 = ratio * phi_1 + error

    # The gear is the copy of the head-cutter.
    u_g = Quantity("u_gear", "mm", "along the blade, to the tip of the gear tooth", "tool")
    theta_g = rotation_angle("theta_gear", "around the head-cutter's axis", "tool")
    gear = cutter.edge(u_g, theta_g).placed(installed)

    # The worm is enveloped by the same tool on a cradle, with a parabolic blade and a parabolic plunge.
    u_w = Quantity("u_worm", "mm", "along the worm's blade", "tool")
    theta_w = rotation_angle("theta_worm", "around the axis of the worm's head-cutter", "tool")
    psi = rotation_angle("psi_worm", "angle of the worm in cutting", "gen")
    blade = cutter.edge(u_w, theta_w, parabola=k.blade_parabola.symbol).placed(installed)
    worm = envelope(blade, _cradle(psi), psi).on("face-worm/eq-10")

    lam = Quantity("lambda_gear", "rad", "around the blade's rounding, from the bottom of the space", "tool")
    fillet = cutter.fillet(lam, theta_g).placed(installed)

    wheel_point = body_point("wheel")
    pinion = Body("pinion", worm, _mounting(phi_1), reference={u_w: 0, theta_w: 0, psi: 0})
    wheel = Body(
        "wheel",
        gear,
        Rz(phi_2),
        reference={u_g: 0, theta_g: 0},
        point=wheel_point,
        margins=_wheel_margins(wheel_point, u_g, cutter),
        lengthwise="radius",
    )
    return Drive(
        name="face_worm",
        family="face-worm",
        title="Face worm gear drive with a conical or cylindrical worm",
        parameters=k.PARAMETERS,
        rules=(*k.RULES, Rule(k.hob_phase.symbol, _hob_phase(reference)), *_point_rules(reference),
               *_cutter_rules(reference, definitions)),
        systems=(
            _pitch_point(reference),
            _middle_line_point(
                reference, "inner_point", k.hob_at_inner, R_in, (k.inner_radius.key, k.profile_angle.key)
            ),
            _middle_line_point(
                reference, "outer_point", k.hob_at_outer, R_out,
                (k.inner_radius.key, k.outer_radius.key, k.profile_angle.key),
            ),
        ),
        guards=(
            Guard(R_out - R_in, "the outer radius must exceed the inner", (k.outer_radius.key, k.inner_radius.key)),
            _collinear(),
            Guard(
                -cutter.junction,
                "the rounding of the blade reaches the middle of the profile",
                (k.fillet_radius.key, k.blade_depth.key),
            ),
        ),
        sizes=_sizes(cutter),
        instant=phi_1,
        error=error,
        pinion=pinion,
        wheel=wheel,
        regions=(
            Region("wheel", "fillet", fillet, -s, _fillet_margins(lam, cutter), "radius"),
            Region("reference_wheel", "flank", reference.surface, -s),
        ),
        unknowns=(
            Unknown(u_w, m_ax), Unknown(theta_w), Unknown(psi), Unknown(u_g, m_ax), Unknown(theta_g), Unknown(error),
        ),
        residual=contact(wheel.placed, pinion.placed),
        definitions=definitions,
        start=_start(worm, phi_1, u_g, theta_g, error, definitions),
        guess={theta_w: sp.Integer(0)},
        sample=k.SAMPLE,
        sample_angle=1.0,
        pinion_teeth=k.threads.key,
        together=tuple(tuple(f"{p.table}.{p.key}" for p in group) for group in k.TOGETHER),
        functions=(*_limit_functions(cutter, gear, worm, reference), *_solids(cutter)),
        tools=(ToolUse("hob", "", conical_hob), ToolUse("wheel", "", head_cutter)),
        tool_clearance=ToolClearance("head_cutter", k.tilt_change.key, "head_cutter_tilt_deg"),
        loading=Loading(pairs=5, torque_on="wheel"),
        outline=outlines.face_worm,
        sources=SOURCES,
        ascending_path=True,
        flanks_apart=True,
        absorbs_errors=True,
    )  # fmt: skip


def _limit_functions(cutter, gear, worm, reference):
    """Where undercut is sought on gear, worm and hob-cut reference gear, and the sizes of the passing blades."""
    root, tip = cutter.junction, k.addendum.symbol / sp.cos(alpha_g)
    slant = sp.cos(alpha)
    far = 4 * R_g / sp.Abs(sp.sin(alpha_g))  # the tool's cone ends in its apex, on the axis
    u_g, _ = gear.parameters
    u_w, theta_w, _ = worm.parameters
    on_gear = [replaced(c, dict(zip(gear.parameters, (u_w, theta_w), strict=True))) for c in gear.body_point]
    return (
        _undercut_range("wheel", -far, 0, far, along_first=sp.Integer(0), along_last=sp.Integer(0)),
        _undercut_place("wheel", gear.parameters, u_g),
        _undercut_range("pinion", root, 0, tip),
        # the worm's generating point lies on the head-cutter's cone, at the same u and θ to the blade's small parabola
        _undercut_place("pinion", worm.parameters, u_w, on_gear),
        _undercut_range("reference_wheel", -k.addendum.symbol / slant, 0, k.blade_depth.symbol / slant),
        _undercut_place(
            "reference_wheel", reference.surface.parameters, reference.u, reference.surface.body_point
        ),
        Function(
            "tool_clearance",
            "sizes of the head-cutter that passes over finished teeth",
            (),
            (
                Result("fillet_end", (cutter.fillet_end,), "rad", "tool"),
                Result("edge_root", (root,), "mm", "tool"),
                Result("edge_tip", (tip,), "mm", "tool"),
                Result("inner", (R_in,), "mm", "wheel"),
                Result("outer", (R_out,), "mm", "wheel"),
            ),
        ),
    )


def _solids(cutter):
    """Gear and thread. The source gives the thread no height: it is as high as the gear's space is deep but for the
    clearance, and rounded at its root like the blade's edge. Tooth and space are equally wide at the middle.
    """
    slant = sp.cos(alpha_g)
    gear = {
        "module": (m_ax, "mm"),
        "teeth": (N_2, ""),
        "face_first": (R_in, "mm"),
        "face_last": (R_out, "mm"),
        "flank_root": (cutter.junction, "mm"),
        "tip_first": (0, "mm"),
        "tip_last": (2 * m_ax, "mm"),
        "fillet_junction": (cutter.fillet_end, "rad"),
        "fillet_land": (0, "rad"),
        "middle": (0, "mm"),
    }
    worm = {
        "module": (m_ax, "mm"),
        "root_radius": (r_p - k.blade_depth.symbol, "mm"),
        "tip_radius": (r_p + k.addendum.symbol, "mm"),
        "rounding": (k.fillet_radius.symbol, "mm"),
        "taper": (taper, ""),
        "thickness": (sp.pi * m_ax / 2, "mm"),
        "screw_parameter": (p_1, "mm/rad"),
        "span_root": (k.blade_depth.symbol / slant, "mm"),
        "span_middle": (0, "mm"),
        "span_tip": (-sp.Rational(8, 5) * m_ax, "mm"),
    }
    return solid("wheel", gear), solid("pinion", worm)


def _undercut_range(surface, first, middle, last, **along):
    ends = {"first": first, "middle": middle, "last": last} | along
    return Function(
        f"undercut_range_{surface}",
        "positions on the blade between which undercut is sought",
        (),
        tuple(Result(name, (sp.sympify(end),), "mm", "tool") for name, end in ends.items()),
    )


def _undercut_place(surface, parameters, position, point=None):
    """Position on the blade; with a ``point`` of the gear, whether it lies between the ends of the face."""
    results = [Result("edge_position", (position,), "mm", "tool")]
    if point is not None:
        radius = v.radius(*point[:2])
        results.append(Result("inside", ((R_out - radius) * (radius - R_in),), "", "wheel"))
    return Function(f"undercut_place_{surface}", "position on the blade", tuple(parameters), tuple(results))


def _hob_phase(reference):
    """The hob's phase at which its mid profile cuts in the section x = L at ψ = 0."""
    here = {reference.u: sp.Integer(0), reference.theta: sp.Integer(0), reference.psi: sp.Integer(0)}
    return nearest_turn(replaced(reference.meshing, here), k.hob_phase.symbol)


def _cradle(psi):
    """From the cradle to the worm: the cradle turns N1/N2 times as fast, the worm plunges by a parabola."""
    plunge = k.plunge.symbol * psi**2
    return Rz(-psi) @ crossing.inverse() @ station(-L, -E_m) @ translation(y=-plunge) @ Rz(ratio * psi)


def _mounting(phi_1):
    """The worm in mesh: the shaft angle error turns about the common perpendicular, the axial one follows it."""
    return (
        station(y=E_m + k.error_offset.symbol)
        @ Ry(k.error_angle.symbol)
        @ station(x=L + k.error_axial.symbol)
        @ crossing
        @ Rz(phi_1)
    )


def _wheel_margins(point, u_g, cutter):
    x, y, _ = point
    radius = v.radius(x, y)
    return (
        Margin("off_face", "face", (R_out - radius) * (radius - R_in) / (R_out - R_in), ends=TOE_AND_HEEL),
        Margin("off_tip", "tip", k.addendum.symbol - u_g * sp.cos(alpha_g)),
        Margin("off_root", "root", u_g - cutter.junction, Role.JUNCTION, joins="fillet"),
    )


def _fillet_margins(lam, cutter):
    return Margin("", "bottom", lam), Margin("", "junction", cutter.fillet_end - lam, joins="flank")


def _start(worm, phi_1, u_g, theta_g, error, definitions):
    """Without plunge and errors worm and gear touch at u = 0, ψ = φ1, θ_worm = θ_gear: one meshing equation is left."""
    u_w, theta_w, psi = worm.parameters
    (meshing,) = worm.conditions
    return System(
        name="start",
        definitions=definitions,
        unknowns=(Unknown(theta_w),),
        residual=(meshing,),
        outputs={u_w: 0, theta_w: theta_w, psi: phi_1, u_g: 0, theta_g: theta_w, error: 0},
        fixed={u_w: 0, psi: phi_1},
    )


def _sizes(cutter):
    tilt = sp.acos(k.symbols(k.axis_z)[2])
    return (
        ("screw_parameter_worm_mm_per_rad", p_1, "screw parameter of the worm"),
        ("lead_worm_mm", 2 * sp.pi * p_1, "lead of the worm"),
        ("head_cutter_tilt_deg", tilt, "angle between the head-cutter's and the gear's axis"),
        ("flank_root_mm", cutter.junction, "u of the gear where the flank joins the rounding at its root"),
        ("fillet_angle_deg", cutter.fillet_end, "angle of the rounding, from the bottom of the space to the flank"),
        ("ratio", ratio, "wheel turns per pinion turn N1/N2, the inverse of the gear ratio"),
    )


def catalogue():
    """One drive: name → builder."""
    return {"face_worm": face_worm}
