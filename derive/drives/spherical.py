"""Spherical gears: parallel axes, teeth cut by a rack section that sweeps an arc (convex, concave) or a line (spur).

Frames: ``f`` fixed, origin at the centre of the pinion, x to the centre of the wheel, z along the wheel axis. Body
frames ``pinion`` and ``wheel``: the tooth is centred on x, z along the gear's own axis, middle of the face at z = 0.
The pinion turns by +φ1 about z and the wheel by +φ2 about −z; at φ1 = 0 the ideal pair touches in the pitch point.
"""

from dataclasses import dataclass
from functools import partial

import sympy as sp

from derive.drives import outlines
from derive.drives import spherical_keys as k
from derive.drives.rack_generated import body, fillet_margins, rolled, solid_teeth, undercut
from derive.drives.spherical_keys import PINION, WHEEL, Gear
from derive.language import vectors as v
from derive.language.chain import Rx, Ry, Rz, translation
from derive.language.contact import contact
from derive.language.definitions import Definitions
from derive.language.drive import Drive, Loading, Margin, Region, Role, Source, System, ToolUse, body_point
from derive.language.functions import LeastTeeth
from derive.language.replace import replaced
from derive.language.surface import Surface
from derive.language.symbols import Guard, Unknown, rotation_angle
from derive.tools.rack_section import SPHERE_RADIUS, SWEEPS, RackBody, RackTool

SOURCES = (
    Source(
        "National Science Council of Taiwan",
        "Convex and concave spherical gears: tooth surfaces, undercutting, contact, stress (three-year project)",
        2009,
        "chapters 2 and 3",
    ),
)

s, m, alpha = k.flank.symbol, k.module.symbol, k.pressure_angle.symbol
dC, dh, dv = k.error_distance.symbol, k.error_horizontal.symbol, k.error_vertical.symbol
r_1, r_2 = PINION.pitch_radius, WHEEL.pitch_radius


@dataclass(frozen=True)
class Tooth:
    """A generated tooth: flank and fillet, explicit in the parameters of their cutter."""

    gear: Gear
    tool: RackTool
    surface: Surface
    fillet: Surface
    generating_angle: sp.Expr


def _tooth(gear, form, definitions):
    """The flank that the rolling rack envelops: the gear turns by −φ while the rack moves by −r φ along y."""
    tool = SWEEPS[form](
        RackBody(
            name=gear.name,
            pressure_angle=alpha,
            edge_offset=gear.edge_offset.symbol,
            half_space=gear.half_space.symbol,
            tip_radius=gear.cutter_tip_radius.symbol,
            flank=s,
            own={datum: p.symbol for datum, p in gear.own(SWEEPS[form]).items()},
        ),
        definitions,
    )
    surface, phi = _rolled(tool.cutter, gear, f"phi_gen_{gear.name}")
    fillet, _ = _rolled(tool.rounding, gear, f"phi_fillet_{gear.name}")
    return Tooth(gear, tool, surface, fillet, phi)


def _rolled(cutter, gear, angle):
    return rolled(cutter, gear.name, gear.pitch_radius, angle, "spherical_gears")


def spherical(pinion_form, wheel_form):
    """The pair of gears of these forms ("convex", "concave", "spur")."""
    definitions = Definitions()
    phi_1 = rotation_angle("phi_pinion", "angle of the pinion in mesh", "f")
    error = rotation_angle("transmission_error", "wheel angle less ratio times pinion angle", "f")
    ratio = definitions.let("ratio", PINION.teeth.symbol / WHEEL.teeth.symbol, "T1/T2")
    phi_2 = ratio * phi_1 + error

    teeth = pinion_tooth, wheel_tooth = (
        _tooth(PINION, pinion_form, definitions),
        _tooth(WHEEL, wheel_form, definitions),
    )

    # A tooth of the pinion meets a space of the wheel: each is turned by half its tooth to the pitch point.
    to_pitch_point = [s * gear.half_space.symbol / gear.pitch_radius for gear in (PINION, WHEEL)]
    pinion = _body(pinion_tooth, Rx(dh) @ Ry(dv) @ Rz(phi_1 - to_pitch_point[0]))
    wheel = _body(wheel_tooth, translation(x=r_1 + r_2 + dC) @ Rz(sp.pi - phi_2 - to_pitch_point[1]))
    return Drive(
        name=_name(pinion_form, wheel_form),
        family="spherical",
        title=f"{pinion_form} pinion with a {wheel_form} wheel",
        parameters=k.parameters(SWEEPS[pinion_form], SWEEPS[wheel_form]),
        rules=k.RULES,
        guards=_guards(pinion_tooth) + _guards(wheel_tooth),
        sizes=_sizes(definitions, pinion_tooth, wheel_tooth),
        instant=phi_1,
        error=error,
        pinion=pinion,
        wheel=wheel,
        regions=tuple(Region(t.gear.name, "fillet", t.fillet, s, fillet_margins(t, alpha), "axial") for t in teeth),
        unknowns=(*_unknowns(pinion_tooth, wheel_tooth), *_unknowns(wheel_tooth, pinion_tooth), Unknown(error)),
        residual=contact(pinion.placed, wheel.placed),
        definitions=definitions,
        start=_start(pinion_tooth, wheel_tooth, phi_1, error, definitions),
        guess={},
        sample=_sample(pinion_form, wheel_form),
        sample_angle=0.03,
        pinion_teeth=PINION.teeth.key,
        variant={"pinion_form": pinion_form, "wheel_form": wheel_form},
        tools=tuple(
            ToolUse(gear.name, form, SWEEPS[form], tuple(p.key for p in gear.own(SWEEPS[form]).values()))
            for gear, form in ((PINION, pinion_form), (WHEEL, wheel_form))
        ),
        loading=Loading(pairs=3, torque_on="pinion"),
        outline=outlines.spherical,
        sources=SOURCES,
        functions=tuple(function for tooth in teeth for function in (*_undercut(tooth), _solid(tooth))),
        least_teeth={
            tooth.gear.name: LeastTeeth(
                tooth.gear.teeth.key, tuple(p.key for p in tooth.gear.own(SWEEPS[form]).values())
            )
            for tooth, form in zip(teeth, (pinion_form, wheel_form), strict=True)
        },
    )


def _undercut(tooth):
    """Undercut is sought in sections of the face, from far beyond the root to the end of the edge.

    Beyond the centre of its arc a cutter has a second sheet, which cuts nothing.
    """
    gear, tool = tooth.gear, tooth.tool
    far = 2 * gear.pitch_radius
    if tool.arc_radius is not None:
        to_centre = (tool.arc_radius - gear.edge_offset.symbol - gear.face_width.symbol / 2) / sp.cos(alpha)
        far = (far + to_centre - sp.Abs(far - to_centre)) / 2
    ends = {"first": -far, "start": 0, "middle": tool.pitch_point, "last": tool.edge_length}
    return undercut(tooth, tool.along, "cutter", ", 0 at the root of the gear", ends)


def _solid(tooth):
    return solid_teeth(tooth.gear, m, alpha, _root_radius(tooth), (0, tooth.tool.edge_length))


def _body(tooth, motion):
    tool = tooth.tool
    return body(tooth, motion, {tool.along: tool.pitch_point, tool.sweep: sp.Integer(0)}, _margins(tooth))


def _unknowns(tooth, mate):
    """Along the edge a module is a natural step, along an arc the chord on which it falls away by half a module."""
    radius = tooth.tool.arc_radius
    chord = sp.sqrt(m * (radius or mate.tool.arc_radius or m))
    return Unknown(tooth.tool.along, m), Unknown(tooth.tool.sweep, chord / radius if radius else chord)


def _start(pinion, wheel, phi_1, error, definitions):
    """The contact of the aligned pair: it runs along the line of action at mid face."""
    def reached(tooth, sense):
        return tooth.tool.pitch_point + sense * s * r_1 * phi_1 * sp.sin(alpha)

    return System(
        name="start",
        definitions=definitions,
        unknowns=(),
        residual=(),
        outputs={
            pinion.tool.along: reached(pinion, 1),
            pinion.tool.sweep: sp.Integer(0),
            wheel.tool.along: reached(wheel, -1),
            wheel.tool.sweep: sp.Integer(0),
            error: sp.Integer(0),
        },
    )


def _margins(tooth):
    gear, tool = tooth.gear, tooth.tool
    x, y, z = body_point(gear.name)
    height = gear.tip_addendum.symbol
    tip_radius = gear.pitch_radius + height - tool.tip_drop(height, z)
    return (
        Margin("off_tip", "tip", tip_radius - v.radius(x, y)),
        Margin("off_face", "face", gear.face_width.symbol / 2 - sp.Abs(z)),
        Margin("off_tool", "tool_end", tool.edge_length - tool.along),
        Margin("off_tool", "root", tool.along, Role.JUNCTION, joins="fillet"),
    )


def _guards(tooth):
    gear, radius = tooth.gear, tooth.tool.arc_radius
    a, b, face = gear.edge_offset.symbol, gear.half_space.symbol, gear.face_width.symbol
    common = (
        Guard(
            gear.pitch_radius - a,
            f"the root of the {gear.name} lies beyond its axis: the edge offset must be below the pitch radius",
            (gear.edge_offset.key, k.module.key, gear.teeth.key),
        ),
        Guard(
            sp.pi * m / 2 - b,
            f"no cutter is left between two teeth of the {gear.name}: the half space must be below π·m/2",
            (gear.half_space.key, k.module.key),
        ),
        Guard(
            gear.full_rounding - gear.cutter_tip_radius.symbol + m / 10**9,
            f"the cutter of the {gear.name} is not wide enough for its rounding: at most that of a fully round tip",
            (gear.cutter_tip_radius.key, gear.edge_offset.key, gear.half_space.key),
        ),
    )
    if radius is None:
        return common
    return (
        *common,
        Guard(
            radius - a - face / 2,
            f"the arc of the {gear.name} does not reach the face: half the face width plus the edge offset must be "
            "below the sphere radius",
            (f"{gear.name}_{SPHERE_RADIUS.key}", gear.face_width.key, gear.edge_offset.key),
        ),
    )


def _sizes(definitions, pinion, wheel):
    sizes = [("center_distance_mm", r_1 + r_2, "sum of the pitch radii")]
    for tooth in (pinion, wheel):
        gear, name = tooth.gear, tooth.gear.name
        sizes += [
            (f"{name}_pitch_radius_mm", gear.pitch_radius, f"pitch radius of the {name}"),
            (f"{name}_base_radius_mm", gear.pitch_radius * sp.cos(alpha), f"base radius of the {name} at mid face"),
            (f"{name}_tip_radius_mm", gear.pitch_radius + gear.tip_addendum.symbol,
             f"tip radius of the {name} at mid face"),
            (f"{name}_limit_radius_mm", _limit_radius(tooth, definitions), f"flank of the {name} ends at mid face"),
            (f"{name}_root_radius_mm", _root_radius(tooth), f"root radius of the {name} at mid face"),
            (f"{name}_edge_start_mm", sp.Integer(0), f"edge of the {name}'s cutter at the root of the gear"),
            (f"{name}_edge_end_mm", tooth.tool.edge_length, f"edge of the {name}'s cutter at the tip of the gear"),
        ]  # fmt: skip
    meaning = "wheel turns per pinion turn T1/T2, the inverse of the gear ratio"
    return (*sizes, ("ratio", PINION.teeth.symbol / WHEEL.teeth.symbol, meaning))


def _root_radius(tooth):
    """The cutter's rounding ends where its normal is radial."""
    (turn, _), (x, _, _) = tooth.tool.rounding.parameters, tooth.tool.rounding.point
    return tooth.gear.pitch_radius + replaced(x, {turn: sp.pi / 2 - alpha})


def _limit_radius(tooth, definitions):
    """Distance from the gear axis of the flank point that the root end of the edge cuts at mid face."""
    x, y, _ = tooth.surface.body_point
    at_root = {tooth.tool.along: sp.Integer(0), tooth.tool.sweep: sp.Integer(0)}
    return v.radius(*(replaced(definitions.resolve(c), at_root) for c in (x, y)))


def catalogue():
    """Every combination of two forms: name → builder."""
    return {_name(pinion, wheel): partial(spherical, pinion, wheel) for pinion in SWEEPS for wheel in SWEEPS}


def _name(pinion_form, wheel_form):
    return f"spherical_{pinion_form}_{wheel_form}"


def _sample(pinion_form, wheel_form):
    """A regular design (point contact wherever the forms allow it): pivots are chosen and self-tests made here."""
    inner, outer = 72, 150
    pinion_radius, wheel_radius = (outer, inner) if pinion_form == "concave" else (inner, outer)
    radii = {
        f"{gear.name}_sphere_radius_mm": radius
        for gear, form, radius in ((PINION, pinion_form, pinion_radius), (WHEEL, wheel_form, wheel_radius))
        if form != "spur"
    }
    return {"flank": 1, "module_mm": 4, "pinion_teeth": 36, "wheel_teeth": 72, "pressure_angle_deg": 20,
            "face_width_mm": 15, **radii}  # fmt: skip
