"""Parameters of cylindrical gears: design keys, defaults, and what the two gears share unless one says otherwise."""

from dataclasses import dataclass

import sympy as sp

from derive.language.choice import only_where_zero
from derive.language.symbols import Parameter, Rule, Table, parameter
from derive.language.vectors import arc, root

POSITIVE = (0, sp.oo)

#: The standard basic rack (ISO 53, profile A) over the module: dedendum, rounding of the tip.
STANDARD_DEDENDUM, STANDARD_ROUNDING = sp.Rational(5, 4), sp.Rational(38, 100)

flank = parameter(
    "flank", "s", "flank of both gears' teeth, left on the +y side", table=Table.FLANK,
    choices=(("left", 1), ("right", -1)), default=1,
)  # fmt: skip
module = parameter("normal_module_mm", "m", "normal module", domain=POSITIVE, required=True)
pressure_angle = parameter(
    "pressure_angle_deg", "alpha", "normal pressure angle of the rack", domain=(0, sp.pi / 2), required=True
)
shaft_angle = parameter("shaft_angle_deg", "Sigma", "shaft angle, with its sign", domain=(-sp.pi, sp.pi))
center_distance = parameter("center_distance_mm", "A", "centre distance", domain=POSITIVE)
face_width = parameter("face_width_mm", "b", "face width", domain=POSITIVE, required=True)
dedendum = parameter("basic_rack_dedendum_mm", "h_f", "dedendum of the basic rack", domain=POSITIVE)
rounding = parameter(
    "basic_rack_rounding_mm", "rho", "root fillet radius of the basic rack", domain=POSITIVE, lower_included=True
)
relief_exponent = parameter(
    "relief_exponent", "q", "exponent of tip and root relief: 2 joins with the tangent, 3 with the curvature too",
    domain=(1, 4), integer=True, default=2,
)  # fmt: skip

error_distance = parameter(
    "center_distance_mm", "dA", "centre distance error, wheel away from the pinion", table=Table.MISALIGNMENT, default=0
)
error_horizontal = parameter("horizontal_deg", "dh", "shaft angle error, about x", table=Table.MISALIGNMENT, default=0)
error_vertical = parameter(
    "vertical_deg", "dv", "tilt about y of the already tilted wheel frame", table=Table.MISALIGNMENT, default=0
)
error_axial = parameter("axial_mm", "da", "shift of the wheel along its own axis", table=Table.MISALIGNMENT, default=0)
separation = parameter(
    "separation_mm", "delta", "separation for contact ellipses", table=Table.CONTACT, domain=POSITIVE,
    default=sp.Rational(632, 100000),
)  # fmt: skip

_sine, _cosine = sp.sin(pressure_angle.symbol), sp.cos(pressure_angle.symbol)

#: Place on the edge, from the datum line, where the rounding of the rack's tip begins.
EDGE_START = (rounding.symbol * (1 - _sine) - dedendum.symbol) / _cosine


@dataclass(frozen=True)
class Relief:
    """A relief of the profile: its amount at the end of the edge and the radius at which it begins."""

    amount: Parameter
    radius: Parameter


@dataclass(frozen=True)
class Gear:
    """The design keys of one member and the sizes that follow from them."""

    name: str
    teeth: Parameter
    helix_angle: Parameter
    profile_shift: Parameter
    thickness_allowance: Parameter
    face_width: Parameter
    profile_crowning: Parameter
    profile_slope: Parameter
    tip_relief: Relief
    root_relief: Relief
    lead_crowning: Parameter
    lead_slope: Parameter
    flank_twist: Parameter
    tip_radius: Parameter

    @classmethod
    def of(cls, name, number):
        def key(key, symbol, meaning, **kind):
            return parameter(f"{name}_{key}", f"{symbol}_{name}", f"{meaning} of the {name}", **kind)

        def amount(word, symbol, meaning):
            return key(f"{word}_um", symbol, meaning, default=0)

        def relief(word, symbol, meaning):
            return Relief(
                amount(f"{word}_relief", f"C_{symbol}", f"{meaning} relief"),
                key(f"{word}_relief_radius_mm", f"R_{symbol}", f"radius at which the {meaning} relief begins",
                    domain=POSITIVE),
            )  # fmt: skip

        return cls(
            name,
            parameter(f"{name}_teeth", f"z_{number}", f"teeth of the {name}", domain=POSITIVE, integer=True,
                      required=True),
            key("helix_angle_deg", "beta", "helix angle, right hand positive,", domain=(-sp.pi / 2, sp.pi / 2)),
            key("profile_shift_coefficient", "shift", "profile shift coefficient", default=0),
            amount("thickness_allowance", "A_sn", "allowance of the normal tooth thickness"),
            key("face_width_mm", "b", "face width", domain=POSITIVE),
            amount("profile_crowning", "C_alpha", "profile crowning"),
            amount("profile_slope", "C_Halpha", "profile slope"),
            relief("tip", "a", "tip"),
            relief("root", "f", "root"),
            amount("lead_crowning", "C_beta", "lead crowning"),
            amount("lead_slope", "C_Hbeta", "lead slope"),
            amount("flank_twist", "S", "flank twist"),
            key("tip_radius_mm", "r_a", "tip radius", table=Table.BLANK, domain=POSITIVE),
        )  # fmt: skip

    @property
    def parameters(self):
        return (
            self.teeth, self.helix_angle, self.profile_shift, self.thickness_allowance, self.face_width,
            self.profile_crowning, self.profile_slope, self.tip_relief.amount, self.tip_relief.radius,
            self.root_relief.amount, self.root_relief.radius, self.lead_crowning, self.lead_slope, self.flank_twist,
        )  # fmt: skip

    @property
    def number(self):
        """Teeth all around."""
        return self.teeth.symbol

    @property
    def tan_transverse(self):
        """tan α_t."""
        return sp.tan(pressure_angle.symbol) / sp.cos(self.helix_angle.symbol)

    @property
    def transverse_pressure_angle(self):
        return arc(_sine, _cosine * sp.cos(self.helix_angle.symbol))

    @property
    def reference_radius(self):
        return module.symbol * self.teeth.symbol / (2 * sp.cos(self.helix_angle.symbol))

    @property
    def base_radius(self):
        return module.symbol * self.teeth.symbol * _cosine / (2 * self.cos_base_helix)

    @property
    def sin_base_helix(self):
        return sp.sin(self.helix_angle.symbol) * _cosine

    @property
    def cos_base_helix(self):
        return root(_sine**2 + (_cosine * sp.cos(self.helix_angle.symbol)) ** 2)

    @property
    def involute(self):
        """inv α_t."""
        return self.tan_transverse - self.transverse_pressure_angle

    @property
    def sin_transverse(self):
        """sin α_t."""
        return _sine / self.cos_base_helix

    @property
    def shift(self):
        """Profile shift at which the rack cuts, x_E·m: deeper than the nominal x·m by what the allowance needs."""
        return self.profile_shift.symbol * module.symbol + self.thickness_allowance.symbol * _cosine / (2 * _sine)

    @property
    def pointed(self):
        """Transverse tooth thickness over the diameter, as an angle, at the tip of the unmodified involute."""
        x, z, r_b, r_a = self.shift / module.symbol, self.teeth.symbol, self.base_radius, self.tip_radius.symbol
        tan_tip = root(r_a**2 - r_b**2) / r_b
        return (sp.pi / 2 + 2 * x * sp.tan(pressure_angle.symbol)) / z + self.involute - (tan_tip - sp.atan(tan_tip))

    def rolling_radius(self, edge):
        """Distance ϱ along the transverse normal from the base circle to the point that the unmodified edge cuts."""
        at = edge * sp.cos(pressure_angle.symbol) + self.shift
        return self.reference_radius * self.sin_transverse + at / self.sin_transverse

    def edge_at(self, radius):
        """Place on the unmodified edge that cuts this radius."""
        rolling = root(radius**2 - self.base_radius**2) - self.reference_radius * self.sin_transverse
        return (self.sin_transverse * rolling - self.shift) / sp.cos(pressure_angle.symbol)

    @property
    def edge_end(self):
        """Place on the edge that cuts the tip."""
        return self.edge_at(self.tip_radius.symbol)

    def rules(self):
        """Standard addendum; the width of the pair. A relief that takes nothing off may begin in the middle."""
        tip = self.reference_radius + self.profile_shift.symbol * module.symbol + module.symbol
        middle = root(self.base_radius**2 + self.rolling_radius((EDGE_START + self.edge_end) / 2) ** 2)
        return (
            Rule(self.face_width.symbol, face_width.symbol, "the width of the pair"),
            Rule(self.tip_radius.symbol, tip, "addendum of one module, no tip shortening"),
            *(
                Rule(relief.radius.symbol, only_where_zero(relief.amount.symbol, middle), "nothing is taken off")
                for relief in (self.tip_relief, self.root_relief)
            ),
        )


PINION, WHEEL = Gear.of("pinion", 1), Gear.of("wheel", 2)

PARAMETERS = (
    flank, module, pressure_angle, shaft_angle, center_distance, face_width, dedendum, rounding, relief_exponent,
    *PINION.parameters, *WHEEL.parameters, error_distance, error_horizontal, error_vertical, error_axial,
    PINION.tip_radius, WHEEL.tip_radius, separation,
)  # fmt: skip


def full_rounding():
    """The radius of a rack's tip that is round all over."""
    return (sp.pi * module.symbol / 4 * _cosine - dedendum.symbol * _sine) / (1 - _sine)


def _rounding():
    """That of the standard basic rack where it finds room."""
    standard, full = STANDARD_ROUNDING * module.symbol, full_rounding()
    return (standard + full - sp.Abs(standard - full)) / 2


RULES = (
    Rule(shaft_angle.symbol, PINION.helix_angle.symbol + WHEEL.helix_angle.symbol, "the sum of the helix angles"),
    Rule(shaft_angle.symbol, sp.Integer(0), "parallel axes"),
    Rule(PINION.helix_angle.symbol, sp.Integer(0), "spur gears"),
    Rule(WHEEL.helix_angle.symbol, shaft_angle.symbol - PINION.helix_angle.symbol, "what the shaft angle asks for"),
    Rule(dedendum.symbol, STANDARD_DEDENDUM * module.symbol, "ISO 53, profile A"),
    Rule(rounding.symbol, _rounding(), "ISO 53, profile A, as far as the tip has room"),
    *PINION.rules(),
    *WHEEL.rules(),
)
