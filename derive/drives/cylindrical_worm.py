"""Cylindrical worm drives: a worm of any ISO flank form and a wheel cut by a hob of any ISO flank form.

Frames: ``f`` fixed, z along the worm axis, x from worm to wheel; the wheel axis is (0, sin Σ, cos Σ) through
(A, 0, 0). The worm turns by +φ1 about z, the wheel by +φ2 about minus its axis. Right hand; the left-hand drive is
the mirror image y → −y.
"""

from dataclasses import replace
from functools import partial

import sympy as sp

from derive.drives import cylindrical_worm_keys as k
from derive.drives import outlines
from derive.drives.cylindrical_worm_drawing import drawing
from derive.drives.cylindrical_worm_functions import generation_functions
from derive.drives.cylindrical_worm_keys import (
    T_1,
    T_2,
    A,
    A_gen,
    Sigma,
    Sigma_gen,
    T_h,
    alpha,
    alpha_h,
    lam,
    lam_h,
    m_n,
    m_x,
    p_1,
    p_h,
    r_1,
    r_h,
    s,
)
from derive.drives.rack_and_pinion import Rack
from derive.language import vectors as v
from derive.language.chain import Rx, Ry, Rz, translation
from derive.language.contact import contact
from derive.language.definitions import Definitions
from derive.language.drive import Body, Drive, Loading, Margin, Region, Regrind, Source, System, ToolUse, body_point
from derive.language.envelope import envelope, explicit, merge_sum
from derive.language.functions import solid
from derive.language.symbols import Guard, Rule, Unknown, rotation_angle
from derive.tools.axial_blade import axial_blade
from derive.tools.grinding_arc import grinding_arc
from derive.tools.grinding_disc import grinding_disc
from derive.tools.involute import involute
from derive.tools.reground import reground, working_radius
from derive.tools.straight_blade import straight_blade
from derive.tools.tip_rounding import tip_rounding
from derive.tools.worm_body import WormBody

SOURCES = (
    Source(
        "K.-Y. Chen, C.-B. Tsay",
        "Contact characteristics of recess action worm gear drives with double-depth teeth",
        2011,
        "Journal of Mechanical Design 133: the whole drive, ZN worm and oversize ZN hob",
    ),
    Source(
        "K.-Y. Chen, C.-B. Tsay",
        "Contact characteristics of the ZK-type worm and ZN-type worm wheel meshing with a non-ninety-degree crossing "
        "angle",
        2009,
        "JSME International Conference on Motion and Power Transmissions, GUD-02: ZK worm, ZN hob, shaft angle",
    ),
    Source("ISO", "ISO 10828, Worm gears: worm profiles and gear mesh geometry", 2015, "flank forms A, I, N, K, C"),
    Source("author not named", "Right-angle cylindrical worm gear drives as rack and pinion", None, "limit points"),
)

#: ISO 10828 letters and the tools that make them.
TOOLS = {"ZA": axial_blade, "ZI": involute, "ZN": straight_blade, "ZK": grinding_disc, "ZC": grinding_arc}


def _own(worm_tool, hob_tool):
    """The keys of the tools' own data, by body and datum: the hob's begin with ``hob_``.

    The worm's keys are those of either tool, as the hob's data are the worm's unless a design says otherwise.
    """
    return {
        "worm": {d: d.parameter("worm") for d in dict.fromkeys((*worm_tool.data, *hob_tool.data))},
        "hob": {d: replace(d, default=None, required=False).parameter("hob", "hob_") for d in hob_tool.data},
    }


def _follow(own):
    """The hob's own data are the worm's."""
    return tuple(Rule(p.symbol, own["worm"][datum].symbol) for datum, p in own["hob"].items())


def _threaded_body(name, radius, lead, angle, own):
    return WormBody(
        name=name,
        turn=rotation_angle(f"psi_{name}", f"screw angle of the {name} flank", name),
        module=m_n,
        pitch_radius=radius,
        lead_angle=lead,
        screw_parameter=radius * sp.tan(lead),
        pressure_angle=angle,
        groove_width=k.groove_width,
        flank=s,
        tip_addendum=k.hob_tip.symbol,
        tip_rounding=k.hob_rounding.symbol,
        own={datum: p.symbol for datum, p in own[name].items()},
    )


def cutting(phi_h):
    """Hob body to wheel body: the hob turns by φ_h, the blank by T_h/T2·φ_h about minus its axis."""
    return Rz(T_h / T_2 * phi_h) @ Rx(Sigma_gen) @ translation(x=-A_gen) @ Rz(phi_h)


def mounting(phi_2):
    """Wheel body to the fixed frame in mesh, with the errors of assembly."""
    return (
        translation(x=A + k.error_distance.symbol)
        @ Rx(-(Sigma + k.error_horizontal.symbol))
        @ Ry(k.error_vertical.symbol)
        @ translation(z=k.error_axial.symbol)
        @ Rz(-phi_2)
    )


def helicoids(worm_profile, hob_profile, definitions):
    """The worm and the hob: flanks of the same kind, each with its own data."""
    own = _own(TOOLS[worm_profile], TOOLS[hob_profile])
    return TOOLS[worm_profile](_worm(own), definitions), TOOLS[hob_profile](_hob(own), definitions)


def _worm(own):
    return _threaded_body("worm", r_1, lam, alpha, own)


def _hob(own):
    return _threaded_body("hob", r_h, lam_h, alpha_h, own)


#: Statements of the audit record about the wheel of any hob.
HOBBED = tuple(
    f"cylindrical_worm/{key}" for key in ("meshing", "normal", "sum-angle", "explicit", "linear", "both-systems")
)


def cylindrical_worm(worm_profile, hob_profile, condition=k.NEW):
    """The drive whose worm and hob have these ISO 10828 flank forms ("ZA", "ZI", "ZN", "ZK", "ZC").

    The form of a reground hob is that which it had when it was new.
    """
    definitions = Definitions()
    phi_1 = rotation_angle("phi_worm", "angle of the worm in mesh", "f")
    error = rotation_angle("transmission_error", "wheel angle less ratio times worm angle", "f")
    ratio = definitions.let("ratio", T_1 / T_2, "T1/T2")
    phi_2 = ratio * phi_1 + error

    worm_tool, hob_tool = TOOLS[worm_profile], TOOLS[hob_profile]
    own = _own(worm_tool, hob_tool)
    worm, hob = worm_tool(_worm(own), definitions), hob_tool(_hob(own), definitions)
    worm = _of_its_thickness(worm)
    systems = _of_reground_hob(hob, own, definitions) if not condition.new else ()
    hob = hob if condition.new else reground(hob, _hob(own), definitions, condition.ground_off)
    phi_h = rotation_angle("phi_hob", "angle of the hob in cutting", "gen")
    wheel, psi = _hobbed(hob.flank, phi_h)
    psi_h = hob.flank.parameters[1]
    phi_h = definitions.let("phi_hob", psi - psi_h, "angle of the hob in cutting", "rad", "gen", parity=-1)
    rounding = tip_rounding(hob, _with_tip(_hob(own), condition), definitions)
    fillet, _ = _hobbed(rounding.surface, rotation_angle("phi_round_hob", "angle of the hob in cutting", "gen"))

    t_w, psi_w = worm.flank.parameters
    t_h = hob.parameter
    pinion = Body(
        "pinion",
        worm.flank,
        Rz(phi_1),
        reference={t_w: worm.pitch_point, psi_w: sp.Integer(0)},
        point=body_point("pinion"),
        margins=_worm_margins(body_point("pinion"), worm),
    )
    wheel_body = Body(
        "wheel",
        wheel,
        mounting(phi_2),
        reference={t_h: hob.pitch_point, psi: sp.Integer(0)},
        point=body_point("wheel"),
        margins=_wheel_margins(body_point("wheel"), hob, psi, definitions),
        recovered=(psi_h, phi_h),
        lengthwise="axial",
    )
    sizes = {t_w: worm.scale, t_h: hob.scale}
    unknowns = tuple(Unknown(symbol, sizes.get(symbol, sp.Integer(1))) for symbol in (t_w, psi_w, t_h, psi, error))
    return Drive(
        name=_name(worm_profile, hob_profile, condition),
        family="cylindrical-worm",
        title=f"{worm_profile} worm with a wheel cut by a {'' if condition.new else 'reground '}{hob_profile} hob",
        parameters=k.parameters(own, condition),
        rules=(*k.rules(condition), *_follow(own), *worm.rules, *hob.rules),
        systems=systems,
        guards=k.GUARDS + _profile_guards(worm, hob),
        sizes=k.SIZES,
        instant=phi_1,
        error=error,
        pinion=pinion,
        wheel=wheel_body,
        regions=(
            Region("wheel", "fillet", fillet, _fillet_regular(rounding), _fillet_margins(rounding), "axial"),
        ),
        unknowns=unknowns,
        residual=contact(pinion.placed, wheel_body.placed),
        definitions=definitions,
        start=_start(worm, hob, condition, psi, phi_1, phi_h, error, definitions),
        guess={t_w: worm.pitch_point, t_h: hob.pitch_point},
        sample=k.SAMPLE | worm_tool.sample | hob_tool.sample | ({} if condition.new else {k.ground_off.key: 0.5}),
        sample_angle=1.0,
        pinion_teeth=k.threads.key,
        variant={"worm_profile": worm_profile, "hob_profile": hob_profile, "hob_condition": condition.word},
        variant_defaults={"hob_profile": "worm_profile", "hob_condition": k.NEW.word},
        functions=(
            *generation_functions(
                worm, hob, Rack(hob.flank, p_h, T_h / T_2, A_gen, Sigma_gen), wheel, psi, wheel_body.recovered,
                _rack_sizes(worm_profile == hob_profile, condition),
            ),
            *_solids(condition),
        ),
        tools=(
            ToolUse("worm", worm_profile, worm_tool, tuple(own["worm"][d].key for d in worm_tool.data)),
            ToolUse("hob", hob_profile, hob_tool, tuple(own[b][d].key for d in hob_tool.data for b in ("worm", "hob"))),
        ),
        loading=Loading(
            pairs=5,
            torque_on="wheel",
            keys={
                "wheel_face": k.face_width.place, "wheel_tip": k.wheel_tip.place, "tool_rounding": k.hob_rounding.place,
            },
        ),
        proportions=k.proportions(condition),
        exchange=_exchange() if condition.new else None,
        regrind=REGRIND,
        outline=lambda: outlines.worm(TOOLS.values()),
        drawing=drawing(),
        sources=SOURCES,
        handed="right",
        exclusive=(
            (k.normal_module.key, k.axial_module.key),
            (k.lead_angle.key, k.pitch_radius.key),
        ),
    )


def _of_its_thickness(worm):
    """The worm with the allowance of its thread thickness: each flank, moved along the axis, is the helicoid it was, so
    that an equal hob still cuts its mate.
    """
    return replace(worm, flank=worm.flank.placed(translation(z=-s * k.thickened)))


def _of_reground_hob(hob, own, definitions):
    """The design system of a reground hob; ``hob`` is the new one."""
    keys = (k.ground_off.key, k.hob_radius.key)
    return (working_radius(hob, _hob(own), definitions, k.REGROUND.ground_off, k.working.symbol, keys),)


def _with_tip(body, condition):
    """The data of a hob with the tip that is left of it."""
    return body if condition.new else replace(body, tip_addendum=body.tip_addendum - condition.ground_off)


def _solids(hob):
    """Thread and wheel of a whole blank; the root of the wheel is that of its middle plane."""
    worm = {
        "module": (m_x, "mm"),
        "root_radius": (k.worm_root.symbol, "mm"),
        "tip_radius": (k.worm_tip.symbol, "mm"),
        "rounding": (k.STANDARD_ROUNDING * m_x, "mm"),
        "taper": (0, ""),
    }
    wheel = {
        "module": (m_x, "mm"),
        "teeth": (T_2, ""),
        "root_radius": (k.hob_end(hob), "mm"),
        "face_first": (-k.face_width.symbol / 2, "mm"),
        "face_last": (k.face_width.symbol / 2, "mm"),
    }
    return solid("pinion", worm), solid("wheel", wheel)


def _exchange():
    """The family in REXS; that page reads this one's keys."""
    from derive.drives.cylindrical_worm_rexs import EXCHANGE

    return EXCHANGE


def _rack_sizes(same_profile, hob):
    """Sizes (value, unit) by name, for limits, sections and the search for contacts."""
    return {
        "module": (m_n, "mm"),
        "reference_radius_tool": (hob.radius, "mm"),
        "end_radius_tool": (r_h + k.hob_tip.symbol - hob.ground_off, "mm"),
        "reference_radius_pinion": (r_1, "mm"),
        "tip_radius_pinion": (k.worm_tip.symbol, "mm"),
        "root_radius_pinion": (k.worm_root.symbol, "mm"),
        "axial_pitch_pinion": (2 * sp.pi * p_1 / T_1, "mm"),
        "tip_radius_wheel": (k.wheel_tip.symbol, "mm"),
        "throat_radius_wheel": (k.wheel_throat.symbol, "mm"),
        "cutting_distance": (A_gen, "mm"),
        "cutting_angle": (Sigma_gen, "rad"),
        "turns": (T_1 / T_h, ""),
        "oversize": (hob.radius - r_1, "mm"),
        "same_profile": (sp.Integer(int(same_profile and hob.new)), ""),
    }


def _hobbed(cutter, phi_h):
    """What a screw surface of the hob envelops on the wheel, explicit in its turn, and the rack angle Ψ."""
    turn = cutter.parameters[-1]
    wheel = envelope(cutter, cutting(phi_h), phi_h)
    wheel, psi = merge_sum(wheel, turn, phi_h, "psi_fixed_hob", "angle of the hob profile in the fixed cutting frame")
    return explicit(wheel)[0].on("conventions/wheel-axis", *HOBBED), psi


def _fillet_regular(rounding):
    """The condition on the ball grows or falls along the flank's parameter; its slope gives the sign."""
    (condition,), t = rounding.surface.conditions, rounding.surface.parameters[1]
    return s * rounding.surface.definitions.derivative(condition, t)


def _fillet_margins(rounding):
    return Margin("", "bottom", rounding.turn), Margin("", "junction", rounding.before_flank, joins="flank")


def _start(worm, hob, condition, psi, phi_1, phi_h, error, definitions):
    """A point close to contact: on the hob's mid plane Ψ = 0 at the right cutting angle, and below it on the worm."""
    t_w, psi_w = worm.flank.parameters
    t_h = hob.parameter
    at_middle = {psi: sp.Integer(0)}
    worm_x, worm_y, _ = worm.flank.point
    hob_x, hob_y, _ = hob.flank.point
    worm_radius = v.radius(worm_x, worm_y)
    hob_radius_here = v.radius(hob_x, hob_y)
    return System(
        name="start",
        definitions=definitions,
        unknowns=(Unknown(t_w, worm.scale), Unknown(t_h, hob.scale)),
        residual=(worm_radius - r_1 - (hob_radius_here - condition.radius), phi_h - phi_1 * T_1 / T_h),
        outputs={
            t_w: t_w,
            psi_w: v.arc(hob_y, hob_x) - phi_1 - v.arc(worm_y, worm_x),
            t_h: t_h,
            psi: sp.Integer(0),
            error: sp.Integer(0),
        },
        fixed=at_middle,
    )


def _worm_margins(point, worm):
    x, y, _ = point
    radius = v.radius(x, y)
    return (
        Margin("off_tip", "tip", k.worm_tip.symbol - radius),
        Margin("off_root", "root", radius - k.worm_root.symbol),
        *worm.margins,
    )


def _wheel_margins(point, hob, psi, definitions):
    x, y, z = point
    radius = v.radius(x, y)
    height, throat = A - radius, A - k.wheel_throat.symbol
    n_x = Rz(psi).direction(hob.flank.normal)[0]
    return (
        Margin("off_tip", "tip", k.wheel_tip.symbol - radius),
        Margin("off_tip", "throat", v.radius(height, z) - throat),
        Margin("off_face", "face", k.face_width.symbol / 2 - sp.Abs(z)),
        Margin("off_tool", "tool_end", hob.tip_margin, joins="fillet"),
        Margin("spurious_sheet", "spurious_sheet", n_x, relative=True),
        *hob.margins,
    )


def _profile_guards(worm, hob):
    return tuple(
        Guard(value, f"{body}: {reason}", (k.normal_module.key, k.lead_angle.key, k.pressure_angle.key, radius.key))
        for body, tool, radius in (("worm", worm, k.pitch_radius), ("hob", hob, k.hob_radius))
        for reason, value in tool.radicands
    )


def catalogue():
    """Every combination of a worm and a hob, new and reground: name → builder.

    One program a combination, not flanks composed at run time: fused, residual and Jacobian take 330 (ZN, ZN) to 768
    (ZC, ZC) operations; composed from point, normal and their derivatives on either flank, 537 to 940, that is 1.6 to
    1.2 times as many, and the pivot order of the Newton step could not be chosen in advance. A reground hob takes more
    operations than a new one.
    """
    combinations = [(worm, hob, condition) for condition in (k.NEW, k.REGROUND) for worm in TOOLS for hob in TOOLS]
    return {_name(*words): partial(cylindrical_worm, *words) for words in combinations}


def _name(worm_profile, hob_profile, condition):
    ending = "" if condition.new else f"_{condition.word}"
    return f"cylindrical_worm_{worm_profile}_{hob_profile}{ending}".lower()


#: What resharpening the hob changes.
REGRIND = Regrind(
    command="hob-life",
    summary="The life of a hob: what its wheels do in contact from the first to the last resharpening.",
    words={"hob_condition": k.REGROUND.word},
    amount=k.ground_off.place,
    radius=k.hob_radius.place,
    mate=k.pitch_radius.place,
    working=k.working.place,
    settings=(k.cutting_distance.place, k.cutting_angle.place),
)


