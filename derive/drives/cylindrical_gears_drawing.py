"""What drawings of cylindrical gears state: ISO 21771:2007 (thickness, backlash, inspection sizes, contact ratios) and
ISO 1328-1:2013, (5) to (12) (tolerances of the flanks).

The generating profile shift x_E holds the allowance of the tooth thickness: the tool cuts deeper by (x − x_E) m, the
tip follows the nominal x. What is measured of a tooth (thickness, span, size over balls) therefore sets the allowance.
"""

import sympy as sp

from derive.drives import cylindrical_gears_keys as k
from derive.drives.cylindrical_gears_keys import PINION, POSITIVE, RULES, WHEEL
from derive.language.choice import only_where_zero
from derive.language.drawing import Assumed, Check, Drawing, Elsewhere, Relation, Root, relation
from derive.language.replace import replaced
from derive.language.symbols import Guard, Quantity, Table, parameter

m, alpha, Sigma, a = (q.symbol for q in (k.module, k.pressure_angle, k.shaft_angle, k.center_distance))
z_1, z_2 = PINION.teeth.symbol, WHEEL.teeth.symbol

#: Ball that touches near the reference circle, in modules.
BALL = sp.Rational(17, 10)

#: Below a right angle, at which the involute function has no end; rad.
STEEPEST = sp.Rational(157, 100)

transverse_module = parameter("transverse_module_mm", "m_t", "transverse module", domain=POSITIVE)
pitch = parameter("normal_diametral_pitch_per_in", "P", "normal diametral pitch", domain=POSITIVE)
helix = parameter("helix_angle_deg", "beta", "helix angle without sign", domain=(0, sp.pi / 2), lower_included=True)
hand = parameter("pinion_hand", "hand_pinion", "hand of the pinion", choices=(("right", 1), ("left", -1)))
kind = parameter(
    "wheel_kind", "kind", "kind of the wheel", choices=(("external", 1), ("rack", 0), ("internal", -1))
)  # fmt: skip
working_angle = parameter("transverse_working_pressure_angle_deg", "alpha_w", "transverse working pressure angle")
tight_angle = parameter(
    "zero_backlash_pressure_angle_deg", "alpha_w0", "transverse pressure angle without backlash, nominal profile shifts"
)
shift_sum = parameter("generating_profile_shift_sum", "x_E_sum", "sum of the generating profile shift coefficients")
normal_backlash = parameter("normal_backlash_mm", "j_bn", "normal backlash, along the line of action")
circumferential_backlash = parameter("circumferential_backlash_mm", "j_wt", "backlash on the working circles")
radial_backlash = parameter("radial_backlash_mm", "j_r", "approach of the axes that takes the backlash up")
least_backlash = parameter("normal_backlash_min_mm", "j_bn_min", "normal backlash of the thickest teeth")
most_backlash = parameter("normal_backlash_max_mm", "j_bn_max", "normal backlash of the thinnest teeth")
wheel_backlash = parameter("wheel_backlash_deg", "j_phi", "angle by which the wheel turns, the pinion at rest")
transverse_ratio = parameter(
    "transverse_contact_ratio", "eps_alpha", "transverse contact ratio, between the members' own limits"
)
overlap_ratio = parameter("overlap_ratio", "eps_beta", "overlap ratio of the common face width")
total_ratio = parameter("total_contact_ratio", "eps_gamma", "total contact ratio")


def inv(angle):
    """The involute function."""
    return sp.tan(angle) - angle


def _parallel(value):
    """The value on parallel axes; on others it is not a number."""
    return only_where_zero(sp.sin(Sigma), value)


class Member:
    """The sizes of one member, their relations, defaults and checks; ``side`` is −1 for a ring gear."""

    side = 1

    def __init__(self, gear):
        self.gear, self.name = gear, gear.name
        self.sizes = []
        side, x, z = self.side, gear.profile_shift.symbol, gear.number
        beta, b, r_a = gear.helix_angle.symbol, gear.face_width.symbol, gear.tip_radius.symbol
        allowance = gear.thickness_allowance.symbol
        self.alpha_t = alpha_t = self.size("transverse_pressure_angle_deg", "alpha_t", "transverse pressure angle")
        r = self.size("reference_radius_mm", "r", "reference radius")
        self.r_b = r_b = self.size("base_radius_mm", "r_b", "base radius")
        self.beta_b = beta_b = self.size("base_helix_angle_deg", "beta_b", "base helix angle")
        self.r_F = r_start = self.size("limit_radius_mm", "r_F", "start of the involute")
        self.x_E = x_cut = self.size(
            "generating_profile_shift_coefficient", "x_E", "generating profile shift coefficient"
        )
        self.upper = upper = self.size("thickness_upper_allowance_um", "A_sne", "upper allowance of the thickness")
        self.lower = lower = self.size("thickness_lower_allowance_um", "A_sni", "lower allowance of the thickness")
        s_n = self.size("normal_thickness_mm", "s_n", "normal tooth thickness on the reference circle", domain=POSITIVE)
        d_f = self.size("root_diameter_mm", "d_f", "root diameter", table=Table.BLANK, domain=POSITIVE)
        d_w = self.size("working_diameter_mm", "d_w", "working pitch diameter", domain=POSITIVE)
        d_form = self.size("form_diameter_mm", "d_Ff", "diameter at which the involute starts", domain=POSITIVE)
        span_teeth = self.size("span_teeth", "k", "teeth spanned", domain=POSITIVE, integer=True)
        span = self.size("span_mm", "W_k", "span over these teeth", domain=POSITIVE)
        ball = self.size("ball_diameter_mm", "D_M", "diameter of the measuring balls", domain=POSITIVE)
        alpha_ball = self.size("ball_pressure_angle_deg", "alpha_K", "pressure angle of the ball's centre")
        over = self.size("over_balls_mm", "M_dK", "size over the balls", domain=POSITIVE)
        chord = self.size("chordal_thickness_mm", "s_c", "chordal thickness on the reference circle")
        height = self.size("chordal_height_mm", "h_c", "height above that chord")
        s_an = self.size("tip_thickness_mm", "s_an", "normal thickness at the tip")
        thickness = sp.pi / 2 + 2 * x_cut * sp.tan(alpha)
        z_v = z / sp.cos(beta) ** 3
        psi = thickness / z_v
        odd = sp.sin(sp.pi * z / 2) ** 2  # 1 for an odd number of teeth, 0 for an even one
        across = 1 - odd * (1 - sp.cos(sp.pi / (2 * z)))
        ball_involute = inv(alpha_t) + side * (ball / (m * z * sp.cos(alpha)) - (sp.pi - thickness) / z)
        alpha_a = sp.acos(r_b / r_a)
        at = Quantity("at", "rad", "pressure angle sought")
        self.relations = (
            relation(allowance, 2 * m * sp.tan(alpha) * (x_cut - x), x_cut),
            relation(allowance, (upper + lower) / 2, upper, lower),
            relation(s_n, m * thickness, x_cut),
            self.root(d_f, r),
            relation(d_w, 2 * r_b / sp.cos(working_angle.symbol)),
            relation(d_form, 2 * r_start),
            relation(
                span, m * sp.cos(alpha) * (sp.pi * (span_teeth - sp.Rational(1, 2)) + z * inv(alpha_t)
                                           + side * 2 * x_cut * sp.tan(alpha)), x_cut,
            ),
            relation(over, 2 * r_b * across / sp.cos(alpha_ball) + side * ball,
                     **{alpha_ball.name: sp.acos(2 * r_b * across / (over - side * ball))}),
            Relation(
                alpha_ball, Root(at, inv(at) - ball_involute, sp.Integer(0), STEEPEST),
                {x_cut: side * (inv(alpha_ball) - replaced(ball_involute, {x_cut: sp.Integer(0)})) * z
                 / (2 * sp.tan(alpha))},
            ),
            relation(chord, z_v * m * sp.sin(psi)),
            relation(height, side * (z_v * m * (1 - sp.cos(psi)) / 2 + r_a - r)),
            relation(
                s_an, 2 * r_a * sp.cos(sp.atan(sp.tan(beta) * r_a / r))
                * (thickness / z + side * (inv(alpha_t) - inv(alpha_a))),
            ),
            *self._tolerances(2 * r, b),
        )  # fmt: skip
        touched = sp.sqrt((r + side * x * m) ** 2 - r_b**2) / sp.cos(beta_b)
        spanned = sp.Rational(1, 2) + 2 * touched / (sp.pi * m * sp.cos(alpha)) - (
            z * inv(alpha_t) + side * 2 * x * sp.tan(alpha)
        ) / sp.pi
        self.measured = (s_n, span, over, upper, lower)
        self.inspected = (
            Assumed(span_teeth, spanned, "touches near the middle of the teeth", unless=(span,)),
            Assumed(ball, BALL * m, "1.7 modules: touches near the reference circle", unless=(over,)),
        )
        at_ball = sp.sqrt(r_b**2 + (r_b * sp.tan(alpha_ball) - side * ball * sp.cos(beta_b) / 2) ** 2)
        at_span = sp.sqrt(r_b**2 + (span * sp.cos(beta_b) / 2) ** 2)
        self.checks = (
            *self.undercut(),
            *(
                Check(
                    f"{self.name}_{what}", sp.Min(side * (radius - r_start), side * (r_a - radius)),
                    f"{touching} of the {self.name} between start of involute and tip, else {remedy}; margin in mm",
                    occurs=False,
                )
                for what, radius, touching, remedy in (
                    ("span", at_span, "the span touches the flanks", "span other teeth"),
                    ("over_balls", at_ball, "the measuring balls touch the flanks", "take other balls"),
                )
            ),
        )

    def root(self, diameter, r):
        """The relation of the root ``diameter``: one rack cuts all, at the generating profile shift."""
        return relation(diameter, 2 * (r + self.x_E * m - k.dedendum.symbol), k.dedendum.symbol)

    def undercut(self):
        """The check against the least number of teeth."""
        least = self.size("least_teeth_without_undercut", "z_lim", "least teeth without undercut")
        meaning = (
            f"the rack cuts into the involute of the {self.name}; take more teeth, profile shift or pressure angle; "
            "margin in teeth"
        )
        return (Check(f"undercut_{self.name}", self.gear.teeth.symbol - least, meaning),)

    def size(self, key, symbol, meaning, **domain):
        """A size of this member, as a symbol."""
        name = self.name
        self.sizes.append(parameter(f"{name}_{key}", f"{symbol}_{name}", f"{meaning} of the {name}", **domain))
        return self.sizes[-1].symbol

    def _tolerances(self, d, b):
        """Of accuracy class A, mm: those of class 5 times √2^(A − 5). Diameter, width and module enter in mm."""
        grade = self.size("flank_tolerance_class", "A_ISO", "flank tolerance class, ISO 1328-1:2013",
                          domain=POSITIVE, integer=True)  # fmt: skip
        single, total, profile, lead = (
            self.size(f"{key}_tolerance_um", symbol, f"{meaning} tolerance")
            for key, symbol, meaning in (
                ("single_pitch", "f_pT", "single pitch"), ("total_pitch", "F_pT", "total cumulative pitch"),
                ("total_profile", "F_alphaT", "total profile"), ("total_helix", "F_betaT", "total helix"),
            )
        )  # fmt: skip

        def decimal(text):
            return sp.Rational(text)

        def hypot(p, q):
            return sp.sqrt(p**2 + q**2)

        per_class = sp.sqrt(2) ** (grade - 5) / 1000
        return (
            relation(single, per_class * (d * decimal("0.001") + m * decimal("0.4") + 5)),
            relation(
                total, per_class * (d * decimal("0.002") + decimal("0.55") * sp.sqrt(d) + m * decimal("0.7") + 12)
            ),
            relation(profile, per_class * hypot(
                m * decimal("0.4") + d * decimal("0.001") + 4, m * decimal("0.55") + 5)),
            relation(lead, per_class * hypot(
                decimal("0.05") * sp.sqrt(d) + decimal("0.35") * sp.sqrt(b) + 4,
                decimal("0.07") * sp.sqrt(d) + decimal("0.45") * sp.sqrt(b) + 4)),
        )  # fmt: skip


def common():
    """Relations of module and helix angle, whatever the mate."""
    beta = helix.symbol
    return (
        relation(m, transverse_module.symbol * sp.cos(beta), transverse_module.symbol,
                 **{beta.name: sp.acos(m / transverse_module.symbol)}),
        Relation(m, 1 / pitch.symbol, {pitch.symbol: 1 / m}),
        relation(beta, sp.Abs(PINION.helix_angle.symbol)),
        relation(PINION.helix_angle.symbol, hand.symbol * beta),
    )  # fmt: skip


def pair(p, w, path, on_axes=lambda value: value):
    """Relations of a pair; ``path`` is the length of its path of contact, ``on_axes`` keeps what its axes have."""
    x_1, x_2 = (member.gear.profile_shift.symbol for member in (p, w))
    alpha_w, j_bn, j_wt, total = (
        q.symbol for q in (working_angle, normal_backlash, circumferential_backlash, shift_sum)
    )
    upper = p.upper + w.upper
    lower = p.lower + w.lower
    alpha_t = p.alpha_t
    opened = m * sp.cos(alpha) * (z_1 + w.gear.teeth.symbol) * (inv(alpha_w) - inv(alpha_t))
    nominal = opened - 2 * m * sp.sin(alpha) * (x_1 + x_2)
    beta = helix.symbol
    width = sp.Min(p.gear.face_width.symbol, w.gear.face_width.symbol)
    return (
        *common(),
        relation(total, p.x_E + w.x_E, p.x_E, w.x_E),
        relation(j_bn, opened - 2 * m * sp.sin(alpha) * total, total),
        relation(j_bn, (least_backlash.symbol + most_backlash.symbol) / 2, least_backlash.symbol, most_backlash.symbol),
        relation(j_wt, j_bn / (sp.cos(p.beta_b) * sp.cos(alpha_w)), j_bn),
        relation(radial_backlash.symbol, j_wt / (2 * sp.tan(alpha_w)), j_wt),
        relation(wheel_backlash.symbol, j_wt * sp.cos(alpha_w) / w.r_b, j_wt),
        relation(least_backlash.symbol, nominal - sp.cos(alpha) * upper),
        relation(most_backlash.symbol, nominal - sp.cos(alpha) * lower),
        relation(transverse_ratio.symbol, path * sp.cos(beta) / (sp.pi * m * sp.cos(alpha_t))),
        relation(overlap_ratio.symbol, on_axes(width * sp.sin(beta) / (sp.pi * m))),
        relation(total_ratio.symbol, transverse_ratio.symbol + overlap_ratio.symbol),
        _without_backlash(x_1 + x_2, z_1 + w.gear.teeth.symbol),
    )  # fmt: skip


def rolled(member, radius):
    """Distance along the line of action from the base circle of a member to a radius."""
    return sp.sqrt(radius**2 - member.r_b**2)


def _path(p, w):
    """Length of the path of contact between the members' own limits."""
    first, last = ([rolled(member, radius) for member, radius in zip((p, w), radii, strict=True)]
                   for radii in ((p.r_F, w.r_F), (p.gear.tip_radius.symbol, w.gear.tip_radius.symbol)))  # fmt: skip
    whole = a * sp.sin(working_angle.symbol)
    return sp.Min(last[0], whole - first[1]) - sp.Max(first[0], whole - last[1])


def _without_backlash(shifts, teeth):
    """The pressure angle at which the sum of the nominal profile ``shifts`` leaves no backlash."""
    at = Quantity("at", "rad", "pressure angle sought")
    residual = inv(at) - inv(PINION.transverse_pressure_angle) - 2 * shifts * sp.tan(alpha) / teeth
    return Relation(tight_angle.symbol, Root(at, residual, sp.Integer(0), STEEPEST))


def defaults(p, w, axes, wheel_kind, bases, rack, on_axes=lambda value: value):
    """What is assumed: axes and helix; the shift that meets a distance with the backlash given, else none; the distance
    without backlash; what backlash is left, half on each member; then none, and the tools (``rack``).

    ``bases`` is the distance of the axes times the cosine of the working pressure angle.
    """
    x_1, x_2 = (member.gear.profile_shift.symbol for member in (p, w))
    teeth = z_1 + w.gear.teeth.symbol
    shifts = teeth * (inv(sp.acos(bases / a)) - inv(PINION.transverse_pressure_angle)) / (2 * sp.tan(alpha))
    met = "meets the centre distance: the thickness allowances make the backlash"
    halves = m * sp.tan(alpha) * (shift_sum.symbol - x_1 - x_2)
    allowances = [member.gear.thickness_allowance.symbol for member in (p, w)]
    return (
        Assumed(hand.symbol, sp.sign(PINION.helix_angle.symbol), "the sign of the helix angle"),
        Assumed(hand.symbol, sp.Integer(1), "right hand, where nothing says another", needs=(helix.symbol,)),
        *axes,
        wheel_kind,
        *(Assumed(q, shifts - other, met, needs=(normal_backlash.symbol,)) for q, other in ((x_2, x_1), (x_1, x_2))),
        *(Assumed(q, sp.Integer(0), "no profile shift") for q in (x_1, x_2)),
        Assumed(a, on_axes(bases / sp.cos(tight_angle.symbol)), "no backlash at the nominal profile shifts"),
        *(Assumed(q, halves, "half of the backlash") for q in allowances),
        *(
            Assumed(q, sp.Integer(0), "no allowance", unless=member.measured)
            for q, member in zip(allowances, (p, w), strict=True)
        ),
        *rack,
        *p.inspected,
        *w.inspected,
        Assumed(k.face_width.symbol, sp.Min(p.gear.face_width.symbol, w.gear.face_width.symbol), "the narrower gear's"),
    )


PAIR = (
    transverse_module, pitch, helix, hand, kind, working_angle, tight_angle, shift_sum, normal_backlash,
    circumferential_backlash, radial_backlash, least_backlash, most_backlash, wheel_backlash, transverse_ratio,
    overlap_ratio, total_ratio,
)  # fmt: skip


#: A rack is the limit of wheels of ever more teeth: over a profile 2 modules high the involute of z2 teeth bends from a
#: straight edge by less than 4/z2 modules.
NO_RACK = Guard(
    sp.Abs(kind.symbol) - sp.Rational(1, 2),
    "no family has a rack, as members turn and none travels; its limit is a wheel of very many teeth: of 10000 it is "
    "as straight as a rack to 0.0004 modules",
    (kind.key,),
)


def drawing():
    """The drawing of the family."""
    members = Member(PINION), Member(WHEEL)
    bases = PINION.base_radius + WHEEL.base_radius
    outer = Assumed(kind.symbol, sp.Integer(1), "both gears have outer teeth")
    return Drawing(
        sizes=(*PAIR, *(size for member in members for size in member.sizes)),
        relations=(
            *pair(*members, _path(*members), _parallel), *(found for member in members for found in member.relations),
        ),
        defaults=defaults(*members, RULES[:4], outer, bases, RULES[4:6], _parallel),
        checks=tuple(check for member in members for check in member.checks),
        guards=(NO_RACK,),
        elsewhere=(
            Elsewhere(-z_2, "internal-gears", "a number of teeth of ring gears"),
            Elsewhere(-sp.Rational(1, 2) - kind.symbol, "internal-gears", "a ring gear"),
        ),
    )  # fmt: skip
