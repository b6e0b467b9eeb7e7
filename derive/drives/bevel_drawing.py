"""What drawings of bevel and hypoid gears state: ISO 23509:2016 (pitch cones of intersecting and offset axes, depth,
taper, virtual gears), and the machine settings that cut such blanks.

Where the axes cross and the depth is uniform, one crown gear generates both members. Otherwise the gear is copied from
its cutter (Formate), normal to its root cone, and the cradle of the pinion is the gear: the pinion is conjugate to it
for any taper, shaft angle and offset. The pinion's cutter touches the gear's flank along the generatrix of the mean
point, with a radius of its own and a curved blade: there the pair touches in a point.
"""

import sympy as sp

from derive.drives import bevel_keys as k
from derive.drives.bevel_keys import GEAR, HALF_TURN, PINION, POSITIVE
from derive.language.choice import is_zero, only_where_not_negative, only_where_zero
from derive.language.drawing import Assumed, Drawing, Relation, Root, relation
from derive.language.symbols import Guard, Quantity, parameter

s, Sigma, E = (q.symbol for q in (k.flank, k.shaft_angle, k.offset))
z_1, z_2, N_b = (q.symbol for q in (k.pinion_teeth, k.gear_teeth, k.blade_groups))

OUTER_MODULE = parameter("outer_transverse_module_mm", "m_et", "outer transverse module", domain=POSITIVE)
OUTER_PITCH = parameter(
    "outer_transverse_diametral_pitch_per_in", "P_et", "outer transverse diametral pitch", domain=POSITIVE
)
OUTER_DIAMETER = parameter("gear_outer_pitch_diameter_mm", "d_e2", "outer pitch diameter of the gear", domain=POSITIVE)
FACE_WIDTH = parameter("face_width_mm", "b", "face width of the gear", domain=POSITIVE)
SPIRAL_ANGLE = parameter("mean_spiral_angle_deg", "beta_m", "mean spiral angle where the axes cross", domain=HALF_TURN)
PINION_SPIRAL = parameter(
    "pinion_mean_spiral_angle_deg", "beta_m1", "mean spiral angle of the pinion", domain=HALF_TURN
)  # fmt: skip
GEAR_SPIRAL = parameter("gear_mean_spiral_angle_deg", "beta_m2", "mean spiral angle of the gear", domain=HALF_TURN)
OUTER_SPIRAL = parameter("outer_spiral_angle_deg", "beta_e2", "outer spiral angle of the gear", domain=HALF_TURN)
INNER_SPIRAL = parameter("inner_spiral_angle_deg", "beta_i2", "inner spiral angle of the gear", domain=HALF_TURN)
CUTTER = parameter("cutter_radius_mm", "r_c0", "radius of the gear's cutter on the pitch cone", domain=POSITIVE)
PINION_CUTTER = parameter(
    "pinion_cutter_radius_mm", "r_c1", "the same of the pinion's cutter: another than the gear's crowns lengthwise",
    domain=POSITIVE,
)  # fmt: skip
PRESSURE = parameter("pressure_angle_deg", "alpha", "normal pressure angle", domain=(0, sp.pi / 4))
LIMIT = parameter("limit_pressure_angle_deg", "alpha_lim", "limit pressure angle", domain=HALF_TURN)
ADDENDUM = parameter("crown_addendum_factor", "k_a", "mean addendum of a crown gear over module", domain=POSITIVE)
DEDENDUM = parameter("crown_dedendum_factor", "k_f", "mean dedendum of a crown gear over module", domain=POSITIVE)
SHIFT = parameter("pinion_profile_shift_coefficient", "x_h", "profile shift coefficient of the pinion")
THICKER = parameter("pinion_thickness_modification_coefficient", "x_s", "thickness modification of the pinion")
BACKLASH = parameter("normal_backlash_mm", "j_mn", "normal backlash at the mean point")
TAPER = parameter(
    "depth_taper", "taper", "how the depth of the teeth varies along the face",
    choices=(("uniform", 0), ("standard", 1), ("duplex", 2), ("tilted_root_line", 3)),
)  # fmt: skip
METHOD = parameter(
    "method", "method_gear", "whether the gear is rolled or copied", table="gear",
    choices=(("generated", 0), ("formate", 1)),
)  # fmt: skip
OFFSET_ANGLE = parameter("pinion_offset_angle_deg", "zeta", "offset angle in the common pitch plane", domain=HALF_TURN)
PINION_RADIUS = parameter("pinion_mean_radius_mm", "r_m1", "mean pitch radius of the pinion", domain=POSITIVE)
GEAR_RADIUS = parameter("gear_mean_radius_mm", "r_m2", "mean pitch radius of the gear", domain=POSITIVE)
CONE_DISTANCE = parameter("mean_cone_distance_mm", "R_m", "mean cone distance of the gear", domain=POSITIVE)
MODULE = parameter("mean_normal_module_mm", "m_mn", "mean normal module", domain=POSITIVE)
DEDENDUM_ANGLES = parameter("sum_of_dedendum_angles_deg", "theta_f_sum", "sum of the dedendum angles")
TRANSVERSE_RATIO = parameter("virtual_transverse_contact_ratio", "eps_v_alpha", "transverse contact ratio, virtual")
OVERLAP_RATIO = parameter("virtual_overlap_ratio", "eps_v_beta", "overlap ratio of the virtual gears")

SIZES = (
    OUTER_MODULE, OUTER_PITCH, OUTER_DIAMETER, FACE_WIDTH, SPIRAL_ANGLE, PINION_SPIRAL, CUTTER, PRESSURE, ADDENDUM,
    DEDENDUM, SHIFT, THICKER, BACKLASH, TAPER, PINION_CUTTER, METHOD, GEAR_SPIRAL, OUTER_SPIRAL, INNER_SPIRAL, LIMIT,
    OFFSET_ANGLE, PINION_RADIUS, GEAR_RADIUS, CONE_DISTANCE, MODULE, DEDENDUM_ANGLES, TRANSVERSE_RATIO, OVERLAP_RATIO,
)  # fmt: skip
(
    m_et, P_et, d_e2, b, beta, beta_1, r_c0, alpha, k_a, k_f, x_h, x_s, j, taper, r_c1, method, beta_2, beta_e, beta_i,
    alpha_lim, zeta, r_m1, r_m2, R_m, m_mn, theta, eps_alpha, eps_beta,
) = (size.symbol for size in SIZES)  # fmt: skip

delta_1, delta_2 = PINION.pitch_angle.symbol, GEAR.pitch_angle.symbol

#: Keys of the machine: a design that gives any of them is none of a drawing, of which nothing is assumed.
MACHINE = tuple(
    q.symbol for m in (PINION, GEAR)
    for q in (m.point_radius, m.blade_angle, m.radial, m.cradle_angle, m.root_angle, m.ratio_of_roll)
)  # fmt: skip

#: End of the search for offset angles, rad.
WIDEST_OFFSET = sp.Rational(7, 5)

#: To which part of the offset angle at which the cones no longer touch a common plane it is sought.
NEARLY = sp.Rational(999, 1000)

#: Ends of the search for the pitch angle of the gear of an offset pair, of the one where the axes cross, and rad.
LEAST_PITCH = sp.Rational(1, 2)
LARGEST_PITCH = sp.Rational(12, 10)
STEEPEST_PITCH = sp.Rational(155, 100)

#: By which part of the sum of dedendum angles of standard taper a tilted root line may exceed it.
TILTED = sp.Rational(13, 10)


class Member:
    """The sizes of one member, and their relations to the pair's; ``sign`` is +1 for the pinion."""

    def __init__(self, settings, sign):
        self.settings, self.sign, self.sizes = settings, sign, []
        self.delta, self.apex = settings.pitch_angle.symbol, settings.pitch_apex.symbol
        self.face_width, self.outer = settings.face_width.symbol, settings.outer_cone_distance.symbol
        self.h_a = self.size("mean_addendum_mm", "h_am", "mean addendum")
        self.h_f = self.size("mean_dedendum_mm", "h_fm", "mean dedendum")
        self.s_n = self.size("mean_normal_thickness_mm", "s_mn", "mean normal tooth thickness")
        self.theta_a = self.size("addendum_angle_deg", "theta_a", "addendum angle")
        self.theta_f = self.size("dedendum_angle_deg", "theta_f", "dedendum angle")
        self.root_cone = self.size("root_cone_angle_deg", "delta_f", "root cone angle")
        self.d_ae = self.size("outer_tip_diameter_mm", "d_ae", "outer tip diameter")
        self.crown = self.size("crown_to_crossing_mm", "t_x", "from the crown to the crossing point, along the axis")

    def size(self, key, symbol, meaning):
        body = self.settings.body
        self.sizes.append(parameter(key, f"{symbol}_{body}", f"{meaning} of the {body}", table=body))
        return self.sizes[-1].symbol

    def relations(self, mean):
        """Of depth, thickness and blank; ``mean`` is the member's mean cone distance."""
        sign, delta, h_a, face = self.sign, self.delta, self.h_a, self.settings.face_angle.symbol
        h_ae = h_a + self.face_width / 2 * sp.tan(self.theta_a)
        rho, z = mean * sp.sin(delta) + h_a * sp.cos(delta), mean * sp.cos(delta) - h_a * sp.sin(delta)
        thickness = sp.pi / 2 + sign * 2 * (x_s + x_h * sp.tan(alpha))
        return (
            relation(h_a, m_mn * (k_a + sign * x_h)),
            relation(self.h_f, m_mn * (k_f - sign * x_h)),
            relation(self.s_n, m_mn * thickness - j / (2 * sp.cos(alpha))),
            relation(face, delta + self.theta_a),
            relation(self.outer, mean + self.face_width / 2),
            relation(self.settings.face_apex.symbol, rho * sp.cos(face) / sp.sin(face) - z + self.apex),
            relation(self.d_ae, 2 * (self.outer * sp.sin(delta) + h_ae * sp.cos(delta))),
            relation(self.crown, self.outer * sp.cos(delta) - h_ae * sp.sin(delta) - self.apex),
        )


def _crossing(value):
    """The value where the axes cross."""
    return only_where_zero(E, value)


def _offset(value):
    """The value where they do not."""
    return only_where_not_negative(E**2 - sp.Rational(1, 10**300), value)


def _of_taper(number, value):
    return only_where_zero(taper - number, value)


# -- pitch cones ----------------------------------------------------------------------------------------------------


def _pinion_pitch(gear, offset_angle):
    """Pitch angle of the pinion: cos δ1 cos δ2 cos ζ − sin δ1 sin δ2 = cos Σ."""
    level, steep = sp.cos(gear) * sp.cos(offset_angle), sp.sin(gear)
    return sp.acos(sp.cos(Sigma) / sp.sqrt(level**2 + steep**2)) - sp.atan2(steep, level)


def _offset_angle(gear):
    """ζ at which the axes stand off by E, at a pitch angle of the gear: (r_m1 cos δ2 + r_m2 cos δ1) sin ζ = E sin Σ."""
    at, pitch = Quantity("zeta_at", "rad", "offset angle sought"), Quantity("delta_1_at", "rad")
    middle = (d_e2 - b * sp.sin(gear)) / 2
    radius = middle * z_1 / z_2 * (sp.cos(at) + sp.tan(beta_1) * sp.sin(at))  # cos β2/cos β1 with β2 = β1 − ζ
    residual = (radius * sp.cos(gear) + middle * sp.cos(pitch)) * sp.sin(at) - E * sp.sin(Sigma)
    meeting = sp.acos(sp.sqrt(sp.Max(sp.cos(Sigma) ** 2 - sp.sin(gear) ** 2, 0)) / sp.Abs(sp.cos(gear)))
    end = sp.Min(WIDEST_OFFSET, meeting * NEARLY) * sp.sign(E)
    return Root(at, residual, sp.Integer(0), end, ((pitch, _pinion_pitch(gear, at)),))


def _limit_angle(pitches, distances, spirals, offset_angle):
    """Limit pressure angle: n·(ω1 × v2 − ω2 × v1) = 0 for a normal in the plane across the teeth."""
    (p_1, p_2), (r_1, r_2), (b_1, b_2) = pitches, distances, spirals
    steep = sp.tan(p_1) * sp.tan(p_2) / sp.cos(offset_angle)
    return -sp.atan(
        steep * (r_1 * sp.sin(b_1) - r_2 * sp.sin(b_2)) / (r_1 * sp.tan(p_1) + r_2 * sp.tan(p_2))
    )


def _curvature(pitches, distances, spirals, limit):
    """Of the teeth lengthwise at the mean point, for which the limit pressure angle stays one along them."""
    (p_1, p_2), (r_1, r_2), (b_1, b_2) = pitches, distances, spirals
    turned = sp.tan(b_1) / (r_1 * sp.tan(p_1)) + sp.tan(b_2) / (r_2 * sp.tan(p_2))
    along = 1 / (r_1 * sp.cos(b_1)) - 1 / (r_2 * sp.cos(b_2))
    return (along - sp.tan(limit) * turned) * sp.cos(limit) / (sp.tan(b_1) - sp.tan(b_2))


def _pitch_angle_offset():
    """The pitch angle of the gear of an offset pair whose teeth the cutter's radius curves."""
    gear = Quantity("delta_2_at", "rad", "pitch angle sought")
    angle, pitch, mate, limit, r_1, r_2 = (
        Quantity(name) for name in ("zeta_there", "delta_1_there", "beta_2_there", "alpha_there", "R_1_there",
                                    "R_2_there")
    )  # fmt: skip
    middle = (d_e2 - b * sp.sin(gear)) / 2
    where = (
        (angle, _offset_angle(gear)),
        (pitch, _pinion_pitch(gear, angle)),
        (mate, beta_1 - angle),
        (r_2, middle / sp.sin(gear)),
        (r_1, middle * z_1 * sp.cos(mate) / (z_2 * sp.cos(beta_1) * sp.sin(pitch))),
        (limit, _limit_angle((pitch, gear), (r_1, r_2), (beta_1, mate), angle)),
    )
    residual = _curvature((pitch, gear), (r_1, r_2), (beta_1, mate), limit) - 1 / r_c0
    crossing = sp.atan2(sp.sin(Sigma), sp.cos(Sigma) + z_1 / z_2)
    return Root(gear, residual, crossing * LEAST_PITCH, sp.Min(crossing * LARGEST_PITCH, STEEPEST_PITCH), where)


def _apexes():
    """How far the apex of either pitch cone lies beyond the common perpendicular of the axes; exactly 0 where these
    cross.

    In the common pitch plane, from the mean point, x along the pinion's generatrix and z normal to it.
    """
    r_1, r_2 = r_m1 / sp.sin(delta_1), r_m2 / sp.sin(delta_2)
    apart = r_1 - r_2 * sp.cos(zeta), -r_2 * sp.sin(zeta)  # from the pinion's apex to the gear's
    along_1 = apart[0] * sp.cos(delta_1)
    along_2 = (apart[0] * sp.cos(zeta) + apart[1] * sp.sin(zeta)) * sp.cos(delta_2)
    cosine, square, offset = sp.cos(Sigma), sp.sin(Sigma) ** 2, 1 - is_zero(E)
    return offset * (along_1 - cosine * along_2) / square, offset * (cosine * along_1 - along_2) / square


def _cones(pinion, gear):
    cones = (delta_1, delta_2), (r_m1 / sp.sin(delta_1), r_m2 / sp.sin(delta_2)), (beta_1, beta_2)
    crossing = sp.atan2(sp.sin(Sigma), sp.cos(Sigma) + z_1 / z_2)
    apexes = _apexes()
    return (
        Relation(m_et, 1 / P_et, {P_et: 1 / m_et}),
        relation(d_e2, m_et * z_2, m_et),
        relation(gear.face_width, b, b),
        Relation(beta, _crossing(beta_1), {beta_1: _crossing(beta)}),
        Relation(delta_2, _crossing(crossing)),
        Relation(delta_2, _pitch_angle_offset()),
        Relation(zeta, _offset_angle(delta_2)),
        Relation(delta_1, _pinion_pitch(delta_2, zeta)),
        relation(beta_2, beta_1 - zeta, beta_1),
        relation(r_m2, (d_e2 - b * sp.sin(delta_2)) / 2),
        relation(r_m1, r_m2 * z_1 * sp.cos(beta_2) / (z_2 * sp.cos(beta_1))),
        relation(R_m, r_m2 / sp.sin(delta_2)),
        relation(alpha_lim, _limit_angle(*cones, zeta)),
        relation(r_c0, _offset(1 / _curvature(*cones, alpha_lim))),
        relation(gear.outer, d_e2 / (2 * sp.sin(delta_2)), d_e2),
        relation(m_mn, 2 * r_m2 * sp.cos(beta_2) / z_2),
        *(relation(member.apex, apex) for member, apex in zip((pinion, gear), apexes, strict=True)),
        *(
            relation(angle, sp.asin((at**2 + 2 * R_m * r_c0 * sp.sin(beta_2) - R_m**2) / (2 * at * r_c0)))
            for angle, at in ((beta_e, R_m + b / 2), (beta_i, R_m - b / 2))
        ),
    )  # fmt: skip


# -- taper and virtual gears ----------------------------------------------------------------------------------------


def _taper(pinion, gear):
    """Dedendum angles, and face and root cones: those of the pinion lie along the gear's root and face at the mean
    point.
    """
    standard = sum(sp.atan(member.h_f / R_m) for member in (pinion, gear))
    outer = d_e2 / (2 * sp.sin(delta_2))
    width = 1 - R_m * sp.sin(beta_2) / r_c0
    duplex = sp.pi * d_e2 / z_2 * width / (2 * outer * sp.tan(alpha) * sp.cos(beta_2))
    share = gear.h_a / (2 * m_mn * k_a)

    def along(mate):
        """Pitch angle of a pinion's cone whose tangent plane leans as the gear's does at the mean point."""
        return sp.asin(sp.sin(delta_1) * sp.cos(mate) + sp.cos(delta_1) * sp.cos(zeta) * sp.sin(mate))

    return (
        *(
            relation(theta, _of_taper(number, total))
            for number, total in ((0, taper), (1, standard), (2, duplex), (3, sp.Min(duplex, TILTED * standard)))
        ),
        relation(pinion.theta_f, _of_taper(0, taper)),
        relation(pinion.theta_f, _of_taper(1, sp.atan(pinion.h_f / R_m))),
        relation(pinion.theta_f, only_where_not_negative(taper - sp.Rational(3, 2), theta * share)),
        relation(gear.theta_f, theta - pinion.theta_f),
        relation(pinion.theta_a, along(gear.theta_f) - delta_1),
        relation(gear.theta_a, pinion.theta_f),
        relation(pinion.root_cone, along(-gear.theta_a)),
        relation(gear.root_cone, delta_2 - gear.theta_f),
    )  # fmt: skip


def _virtual(pinion, gear):
    """Contact ratios of the virtual cylindrical gears where the axes cross, between their tips."""
    transverse = sp.atan2(sp.tan(alpha), sp.cos(beta_1))
    radii = [R_m * sp.tan(member.delta) for member in (pinion, gear)]
    rolled = sum(
        sp.sqrt((r + member.h_a) ** 2 - (r * sp.cos(transverse)) ** 2)
        for r, member in zip(radii, (pinion, gear), strict=True)
    )
    path = rolled - sum(radii) * sp.sin(transverse)
    return (
        relation(eps_alpha, _crossing(path * sp.cos(beta_1) / (sp.pi * m_mn * sp.cos(transverse)))),
        relation(eps_beta, _crossing(b * sp.sin(beta_1) / (sp.pi * m_mn))),
    )


# -- machine settings -----------------------------------------------------------------------------------------------


def _set(m, only, along, across):
    """Radial setting and cradle angle of a cutter's centre, ``only`` where these apply."""
    return (
        relation(m.radial.symbol, only(sp.sqrt(along**2 + across**2))),
        relation(m.cradle_angle.symbol, only(sp.atan2(across, along))),
    )


def _crown_gear(member, radius, side, curved):
    """Settings of a member that a crown gear generates, with the teeth of a cutter of this radius on the pitch cone.

    Face-hobbed, cutter and crown gear turn against one another.
    """
    m = member.settings

    def crown(value):
        return only_where_zero(method**2 + E**2 + taper**2, value)

    turned = sp.asin(N_b * sp.sin(delta_1) / z_1 * R_m * sp.cos(beta_1) / radius)
    centre = R_m - radius * sp.sin(beta_1 - turned), radius * sp.cos(beta_1 - turned)
    return (
        relation(m.point_radius.symbol, crown(radius - side * member.h_f * sp.tan(alpha))),
        relation(m.blade_angle.symbol, crown(alpha)),
        *_set(m, crown, *centre),
        relation(m.root_angle.symbol, crown(member.delta)),
        relation(m.sliding_base.symbol, crown(-member.h_f)),
        relation(m.ratio_of_roll.symbol, crown(1 / sp.sin(member.delta))),
        relation(m.blade_offset.symbol, crown(turned)),
        relation(m.blade_reference.symbol, curved(crown(member.h_f / sp.cos(alpha)))),
    )


def _copied(pinion, gear):
    """Settings of a gear that is copied from its cutter, and of the pinion whose cradle is that gear.

    In the plane of the gear's blade tips, x along the root line from below the apex, z off the gear, the mean point M
    lies in depth; n is the normal there, o its direction in the plane away from the cutter's centre.
    """
    g, p = GEAR, PINION

    def copied(value):
        return only_where_zero(method - 1, value)

    side, lean, root = -s, gear.theta_f, gear.root_cone
    steep = alpha + s * alpha_lim
    blade = g.blade_angle.symbol
    deep = gear.h_f * sp.cos(lean)
    inclined = sp.sin(steep) * sp.cos(lean) - side * sp.cos(steep) * sp.sin(beta_2) * sp.sin(lean)
    outward = (
        (sp.cos(steep) * sp.sin(beta_2) * sp.cos(lean) + side * sp.sin(steep) * sp.sin(lean)) / sp.cos(blade),
        -sp.cos(steep) * sp.cos(beta_2) / sp.cos(blade),
    )
    middle = R_m * sp.cos(lean)
    apex = deep - R_m * sp.sin(lean)
    reach = deep + pinion.h_f * sp.cos(lean) + b / 2 * sp.tan(theta)
    x, y, z = middle - r_c1 * outward[0], -r_c1 * outward[1], apex - reach
    laid = x * sp.sin(root) - z * sp.cos(root), y, x * sp.cos(root) + z * sp.sin(root)
    return (
        relation(blade, copied(sp.asin(inclined))),
        relation(g.point_radius.symbol, copied(r_c0 - side * deep * sp.tan(blade))),
        *_set(g, copied, middle - r_c0 * outward[0], -r_c0 * outward[1]),
        relation(g.root_angle.symbol, copied(root)),
        relation(g.sliding_base.symbol, copied(-apex)),
        relation(g.center_to_back.symbol, copied(gear.apex)),
        relation(p.blade_angle.symbol, copied(blade)),
        relation(p.point_radius.symbol, copied(r_c1 + side * (reach - deep) * sp.tan(blade))),
        *_set(p, copied, *laid[:2]),
        relation(p.tilt.symbol, copied(sp.pi / 2 - root)),
        relation(p.swivel.symbol, copied(-p.cradle_angle.symbol)),
        relation(p.root_angle.symbol, copied(Sigma - sp.pi / 2)),
        relation(p.blank_offset.symbol, copied(E)),
        relation(p.sliding_base.symbol, copied(laid[2] - gear.apex)),
        relation(p.ratio_of_roll.symbol, copied(z_2 / z_1)),
        relation(p.blade_reference.symbol, copied((reach - deep) / sp.cos(blade))),
    )


# -- what is assumed ------------------------------------------------------------------------------------------------

#: Mean spiral angle where the axes cross, deg, and of offset pinions (AGMA 2005): constant, by the root of the gear
#: ratio, by the offset over the gear's diameter.
SPIRAL_CROSSING = 35
SPIRAL_OFFSET = (25, 5, 90)

#: Face width over outer cone distance, and radius of the cutter over mean cone distance, of the axes that cross.
FACE_OVER_CONE = sp.Rational(29, 100)
CUTTER_OVER_CONE = sp.Rational(96, 100)

#: By which part the pinion's cutter is larger where it cuts concave flanks, and the curvature of its blade in 1/module.
LENGTHWISE = sp.Rational(3, 100)
PROFILE = sp.Rational(6, 1000)


def _defaults():
    crossing = sp.atan2(sp.sin(Sigma), sp.cos(Sigma) + z_1 / z_2)
    cone = d_e2 / (2 * sp.sin(crossing))
    base, by_ratio, by_offset = SPIRAL_OFFSET
    steep = sp.rad(base + by_ratio * sp.sqrt(z_2 / z_1) + by_offset * E / d_e2)

    virtual = z_1 / (sp.cos(delta_1) * sp.cos(beta_1) ** 3)
    unshifted = k_f - virtual * sp.sin(alpha + s * alpha_lim) ** 2 / 2

    def assumed(target, value, why):
        return Assumed(target, sp.sympify(value), why, unless=MACHINE)

    return (
        Assumed(s, sp.Integer(1), "the convex flank of the gear, which usually drives"),
        Assumed(Sigma, sp.pi / 2, "a right angle"),
        Assumed(E, sp.Integer(0), "the axes cross"),
        Assumed(N_b, sp.Integer(0), "face-milled"),
        assumed(taper, 0, "uniform depth"),
        assumed(
            method, 1 - is_zero(E) * is_zero(taper),
            "generated by a crown gear where the axes cross and the depth is uniform, else Formate",
        ),
        assumed(alpha, sp.rad(20), "usual"),
        assumed(k_a, 1, "ISO 23509"),
        assumed(k_f, sp.Rational(5, 4), "ISO 23509"),
        assumed(x_h, sp.Max(0, unshifted), "as little as leaves the pinion without undercut"),
        assumed(x_s, 0, "no change of the thickness"),
        assumed(j, 0, "each flank is cut by itself"),
        assumed(b, FACE_OVER_CONE * cone, "0.29 outer cone distances"),
        assumed(beta, _crossing(sp.rad(SPIRAL_CROSSING)), "usual"),
        assumed(beta_1, _offset(steep), "25° + 5° √(z2/z1) + 90° offset/diameter of the gear (AGMA 2005)"),
        assumed(r_c0, CUTTER_OVER_CONE * (cone - b / 2), "0.96 mean cone distances"),
        assumed(r_c1, r_c0 * (1 + s * LENGTHWISE), "3 % from the gear's: crowns the teeth lengthwise"),
        assumed(PINION.blade_curvature.symbol, PROFILE / m_et, "crowns the profile, and lays the path along the face"),
        assumed(PINION.face_width.symbol, b / sp.cos(zeta), "covers the gear's"),
    )  # fmt: skip


def drawing():
    """The drawing of the family."""
    pinion, gear = Member(PINION, 1), Member(GEAR, -1)
    means = r_m1 / sp.sin(delta_1), R_m
    return Drawing(
        sizes=(*SIZES, *pinion.sizes, *gear.sizes),
        relations=(
            *_cones(pinion, gear),
            *_taper(pinion, gear),
            *(found for member, mean in zip((pinion, gear), means, strict=True) for found in member.relations(mean)),
            *_virtual(pinion, gear),
            *_crown_gear(pinion, r_c1, s, lambda value: value),
            *_crown_gear(gear, r_c0, -s, lambda value: only_where_not_negative(N_b - 1, value)),
            *_copied(pinion, gear),
        ),
        defaults=_defaults(),
        guards=(
            Guard(
                sp.pi / 2 - delta_2,
                "the teeth of the gear would lie inside its pitch cone, which opens to 90° or more",
                (k.shaft_angle.key, k.pinion_teeth.key, k.gear_teeth.key),
            ),
        ),
    )
