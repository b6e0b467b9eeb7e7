"""Parameters of the face worm gear drive: design keys, defaults, and what the placement of the head-cutter fills in."""

import sympy as sp

from derive.language.symbols import Rule, Table, parameter

POSITIVE = (0, sp.oo)
ACUTE = (0, sp.pi / 2)

flank = parameter(
    "flank", "s", "side of the gear tooth", table=Table.FLANK, choices=(("convex", 1), ("concave", -1)), default=1
)
threads = parameter("worm_threads", "N_1", "threads of the worm", domain=POSITIVE, integer=True, required=True)
teeth = parameter("gear_teeth", "N_2", "teeth of the gear", domain=POSITIVE, integer=True, required=True)
axial_module = parameter("axial_module_mm", "m_ax", "axial module", domain=POSITIVE, required=True)
offset = parameter("offset_mm", "E_m", "shortest distance of the axes", domain=POSITIVE, required=True)
worm_position = parameter(
    "worm_axial_position_mm", "L", "section of the worm's pitch diameter, along the worm axis from the common "
    "perpendicular", domain=POSITIVE, required=True,
)  # fmt: skip
pitch_diameter = parameter(
    "worm_pitch_diameter_mm", "D_p", "pitch diameter of the worm there", domain=POSITIVE, required=True
)
cone_angle = parameter(
    "worm_cone_angle_deg", "gamma_cone", "half cone angle of the worm, 0 for a cylinder; it grows outwards",
    domain=(-sp.pi / 2, sp.pi / 2), default=0,
)  # fmt: skip
inner_radius = parameter("gear_inner_radius_mm", "R_in", "inner radius of the gear", domain=POSITIVE, required=True)
outer_radius = parameter("gear_outer_radius_mm", "R_out", "outer radius of the gear", domain=POSITIVE, required=True)
profile_angle = parameter("profile_angle_deg", "alpha", "profile angle of the flank", domain=ACUTE, required=True)
plunge = parameter("plunge_mm_per_rad2", "a_pl", "parabola of the plunge, its sign included", default=0)
blade_parabola = parameter(
    "blade_parabola_per_mm", "a_c", "parabola by which the worm's blade stands off the gear's",
    required=True,
)  # fmt: skip
pitch_rule = parameter(
    "pitch_point_rule", "rule", "how the pitch point is found", choices=(("mid", 0), ("cones", 1)), default=0
)
cutter_radius = parameter("head_cutter_radius_mm", "R_g", "radius of the head-cutter at P", domain=POSITIVE)
tilt_change = parameter(
    "head_cutter_tilt_change_deg", "tilt_change", "further tilt of the head-cutter about the tooth's tangent at P",
    domain=(-sp.pi / 2, sp.pi / 2), default=0,
)  # fmt: skip
blade_angle = parameter(
    "blade_angle_deg", "alpha_g", "blade angle of the head-cutter", domain=(-sp.pi / 2, sp.pi / 2)
)
fillet_radius = parameter("fillet_radius_mm", "rho_f", "edge radius of the blade", domain=POSITIVE)
blade_depth = parameter("blade_depth_mm", "h_d", "depth of the blade below P", domain=POSITIVE)

addendum = parameter(
    "gear_addendum_mm", "h_a", "height of the gear tooth above P, along the head-cutter's axis", table=Table.BLANK,
    domain=POSITIVE,
)  # fmt: skip

hob_phase = parameter(
    "hob_phase_deg", "theta_0", "phase of the reference hob: it cuts at mid profile in the section of L at angle 0",
    table=Table.PLACEMENT,
)  # fmt: skip


def _hob_place(point, names):
    meanings = {
        "u": ("mm", "along the hob's profile"),
        "theta": ("deg", "screw angle of the hob"),
        "psi": ("deg", "angle of the hob in cutting"),
    }
    return tuple(
        parameter(f"hob_{n}_{point}_{unit}", f"{n}_{point}", f"{meaning}, at {point}", table=Table.PLACEMENT)
        for n in names
        for unit, meaning in [meanings[n]]
    )


def _vector(key, symbol, meaning, unit="_mm"):
    return tuple(
        parameter(f"{key}_{axis}{unit}", f"{symbol}_{axis}", f"{axis} of {meaning}, gear frame", table=Table.PLACEMENT)
        for axis in "xyz"
    )


hob_at_pitch_point = _hob_place("P", ("u", "theta", "psi"))
hob_at_inner = _hob_place("A1", ("theta", "psi"))
hob_at_outer = _hob_place("A2", ("theta", "psi"))
inner_point = _vector("A1", "A1", "the point at the inner radius")
pitch_point = _vector("P", "P", "the pitch point")
outer_point = _vector("A2", "A2", "the point at the outer radius")
axis_x = _vector("tool_axis_x", "xg", "the head-cutter's x axis, to P", "")
axis_y = _vector("tool_axis_y", "yg", "the head-cutter's y axis, along the tooth at P", "")
axis_z = _vector("tool_axis_z", "zg", "the head-cutter's axis of rotation", "")
origin = _vector("tool_origin", "Og", "the head-cutter's centre")

error_offset = parameter(
    "offset_mm", "dE", "error of the offset, worm away from the gear axis", table=Table.MISALIGNMENT, default=0
)
error_axial = parameter("axial_mm", "dL", "shift of the worm along its axis", table=Table.MISALIGNMENT, default=0)
error_angle = parameter(
    "shaft_angle_deg", "dgamma", "error of the shaft angle, about the common perpendicular",
    table=Table.MISALIGNMENT, default=0,
)  # fmt: skip
separation = parameter(
    "separation_mm", "delta", "separation for contact ellipses", table=Table.CONTACT, domain=POSITIVE,
    default=sp.Rational(635, 100000),
)  # fmt: skip

PARAMETERS = (
    flank, threads, teeth, axial_module, offset, worm_position, pitch_diameter, cone_angle, inner_radius, outer_radius,
    profile_angle, plunge, blade_parabola, pitch_rule, cutter_radius, tilt_change, blade_angle, fillet_radius,
    blade_depth, hob_phase, *hob_at_pitch_point, *hob_at_inner, *hob_at_outer, *inner_point, *pitch_point, *outer_point,
    *axis_x, *axis_y, *axis_z, *origin,
    error_offset, error_axial, error_angle, addendum, separation,
)  # fmt: skip

#: Keys of which a design gives all or none: the axes of the head-cutter are a frame only together.
TOGETHER = ((*axis_x, *axis_y, *axis_z),)

#: A standard design: 0.4 mm rounding at an axial module of 1.334 mm, depth 1.25 modules, addendum 1 module.
RULES = (
    Rule(addendum.symbol, axial_module.symbol),
    Rule(fillet_radius.symbol, sp.Rational(400, 1334) * axial_module.symbol),
    Rule(blade_depth.symbol, sp.Rational(5, 4) * axial_module.symbol),
)


def symbols(parameters):
    """The symbols of several parameters."""
    return tuple(p.symbol for p in parameters)


#: A regular design (the conical worm of the source, convex side) and angle: here pivots are chosen, self-tests made.
SAMPLE = {
    "flank": 1, "worm_threads": 2, "gear_teeth": 60, "axial_module_mm": "1.334", "offset_mm": 35,
    "worm_axial_position_mm": "29.907", "worm_pitch_diameter_mm": "11.48", "worm_cone_angle_deg": 5,
    "gear_inner_radius_mm": "38.53", "gear_outer_radius_mm": "52.5", "profile_angle_deg": 10,
    "plunge_mm_per_rad2": "0.003", "blade_parabola_per_mm": "0.01",
}  # fmt: skip
