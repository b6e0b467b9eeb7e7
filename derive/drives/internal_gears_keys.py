"""Parameters of internal gear pairs: the pinion's are those of cylindrical gears; the ring gear and its pinion cutter.

The number of teeth of the ring gear is negative (ISO 21771:2007); its radii and the centre distance are positive here.
A positive profile shift thickens the teeth of either member.
"""

from dataclasses import dataclass

import sympy as sp

from derive.drives import cylindrical_gears_keys as k
from derive.drives.cylindrical_gears_keys import PINION, POSITIVE
from derive.language import vectors as v
from derive.language.choice import excess
from derive.language.symbols import Parameter, Rule, Table, parameter

m, alpha = k.module.symbol, k.pressure_angle.symbol

#: Clearance at the root of the ring gear, over the module (ISO 53).
CLEARANCE = sp.Rational(1, 4)

#: By how much the tip of the ring gear clears the start of the pinion's involute along the line of action, over the
#: module.
CLEAR_OF_FILLET = sp.Rational(1, 10)

#: Rounding of the cutter's tip, over the module.
TIP_ROUNDING = sp.Rational(1, 5)

#: The same of a narrow tip, over a rounding all over it.
ROOM = sp.Rational(4, 5)

shaping_distance = parameter(
    "shaping_center_distance_mm", "a_02", "distance of the axes of ring gear and cutter at full depth", domain=POSITIVE
)


@dataclass(frozen=True)
class Cutter:
    """The pinion cutter: an involute gear whose teeth end in a rounding, in the transverse section."""

    teeth: Parameter
    profile_shift: Parameter
    tip_radius: Parameter
    rounding: Parameter

    @property
    def parameters(self):
        return self.teeth, self.profile_shift, self.tip_radius, self.rounding

    @property
    def ratio(self):
        """Turn of the ring gear over that of the cutter."""
        return self.teeth.symbol / RING.number

    @property
    def reference_radius(self):
        return m * self.teeth.symbol / (2 * sp.cos(PINION.helix_angle.symbol))

    @property
    def base_radius(self):
        return PINION.base_radius * self.teeth.symbol / PINION.teeth.symbol

    @property
    def half_thickness(self):
        """Half the tooth's angle on the base circle."""
        shifted = sp.pi / 2 + 2 * self.profile_shift.symbol * sp.tan(alpha)
        return shifted / self.teeth.symbol + PINION.involute

    @property
    def within(self):
        """Distance along the normal from the base circle to the centre of the rounding."""
        return v.root((self.tip_radius.symbol - self.rounding.symbol) ** 2 - self.base_radius**2)

    @property
    def edge_end(self):
        """Rolling length at which the involute passes into the rounding."""
        return self.within + self.rounding.symbol

    @property
    def centre_angle(self):
        """Angle from the middle of the tooth to the centre of the rounding."""
        return self.half_thickness - self.edge_end / self.base_radius + v.arc(self.within, self.base_radius)

    @property
    def pointed(self):
        """Half the angle of the tooth where the unrounded involute meets the tip circle."""
        tan_tip = v.root(self.tip_radius.symbol**2 - self.base_radius**2) / self.base_radius
        return self.half_thickness - (tan_tip - sp.atan(tan_tip))

    @property
    def rolled(self):
        """Distance along the line of action of generation between the base circles of ring gear and cutter."""
        return v.root(shaping_distance.symbol**2 - (RING.base_radius - self.base_radius) ** 2)


@dataclass(frozen=True)
class Ring:
    """The design keys of the ring gear and the sizes that follow from them."""

    name: str
    teeth: Parameter
    profile_shift: Parameter
    thickness_allowance: Parameter
    face_width: Parameter
    tip_radius: Parameter

    @property
    def parameters(self):
        return self.teeth, self.profile_shift, self.thickness_allowance, self.face_width

    @property
    def number(self):
        """|z2|."""
        return -self.teeth.symbol

    @property
    def helix_angle(self):
        """The pinion's: both have one hand."""
        return PINION.helix_angle

    @property
    def reference_radius(self):
        return m * self.number / (2 * sp.cos(PINION.helix_angle.symbol))

    @property
    def base_radius(self):
        return m * self.number * sp.cos(alpha) / (2 * PINION.cos_base_helix)

    @property
    def shift(self):
        """Generating profile shift coefficient, which holds the thickness allowance."""
        return self.profile_shift.symbol + self.thickness_allowance.symbol / (2 * m * sp.tan(alpha))

    @property
    def half_space(self):
        """Half the angle of a space on the base circle, that of the tooth of an external gear."""
        return (sp.pi / 2 - 2 * self.shift * sp.tan(alpha)) / self.number + PINION.involute

    def rolling(self, radius):
        """Rolling length of the involute at a radius."""
        return v.root(radius**2 - self.base_radius**2)

    @property
    def tip_rolling(self):
        return self.rolling(self.tip_radius.symbol)

    @property
    def root_rolling(self):
        """Rolling length at which the involute ends at the fillet."""
        return CUTTER.rolled + CUTTER.edge_end

    @property
    def root_radius(self):
        return shaping_distance.symbol + CUTTER.tip_radius.symbol

    @property
    def pointed(self):
        """Tooth thickness over the diameter, as an angle, at the tip."""
        tan_tip = self.tip_rolling / self.base_radius
        return sp.pi / self.number - self.half_space + tan_tip - sp.atan(tan_tip)

    def rules(self):
        """Full addendum, as far as the pinion's fillet and the cutter's involute let it; the width of the pair."""
        full = self.reference_radius - (1 + self.profile_shift.symbol) * m
        fillet = lined() + PINION.rolling_radius(k.EDGE_START) + CLEAR_OF_FILLET * m
        rolling = fillet + excess(CUTTER.rolled - fillet)
        clear = v.root(self.base_radius**2 + rolling**2)
        return (
            Rule(self.face_width.symbol, k.face_width.symbol, "the width of the pair"),
            Rule(self.tip_radius.symbol, full + excess(clear - full),
                 "addendum of one module, shortened where the fillet of the pinion or the base circle of the cutter "
                 "would be reached"),
        )  # fmt: skip


def lined():
    """a sin α_w: distance along the line of action between the base circles of the pair."""
    return v.root(k.center_distance.symbol**2 - (RING.base_radius - PINION.base_radius) ** 2)


def _ring():
    def own(key, symbol, meaning, **kind):
        return parameter(f"wheel_{key}", f"{symbol}_wheel", f"{meaning} of the ring gear", **kind)

    return Ring(
        "wheel",
        parameter("wheel_teeth", "z_2", "teeth of the ring gear, a negative number", domain=(-sp.oo, 0), integer=True,
                  required=True),
        own("profile_shift_coefficient", "shift", "profile shift coefficient", default=0),
        own("thickness_allowance_um", "A_sn", "allowance of the normal tooth thickness", default=0),
        own("face_width_mm", "b", "face width", domain=POSITIVE),
        own("tip_radius_mm", "r_a", "tip radius", table=Table.BLANK, domain=POSITIVE),
    )  # fmt: skip


RING = _ring()
CUTTER = Cutter(
    parameter("shaper_teeth", "z_0", "teeth of the pinion cutter", domain=POSITIVE, integer=True),
    parameter("shaper_profile_shift_coefficient", "x_0", "profile shift coefficient of the pinion cutter"),
    parameter("shaper_tip_radius_mm", "r_a0", "tip radius of the pinion cutter", domain=POSITIVE),
    parameter(
        "shaper_tip_rounding_mm", "rho_a0", "rounding of the cutter's tip, transverse section", domain=POSITIVE,
        lower_included=True,
    ),
)  # fmt: skip

PARAMETERS = (
    k.flank, k.module, k.pressure_angle, k.center_distance, k.face_width, k.dedendum, k.rounding, k.relief_exponent,
    *PINION.parameters, *RING.parameters, *CUTTER.parameters, shaping_distance,
    k.error_distance, k.error_horizontal, k.error_vertical, k.error_axial,
    PINION.tip_radius, RING.tip_radius, k.separation,
)  # fmt: skip

def _rounding():
    """What finds room on a tip between flanks as steep as at its edges, and a little less."""
    radius, base = CUTTER.tip_radius.symbol, CUTTER.base_radius
    room = ROOM * CUTTER.pointed * radius * base / (radius - v.root(radius**2 - base**2))
    return TIP_ROUNDING * m - excess(TIP_ROUNDING * m - excess(room))


#: The cutter: as the pinion, longer by the clearance at the root of the ring gear.
CUTTER_RULES = (
    Rule(CUTTER.teeth.symbol, PINION.teeth.symbol, "as many teeth as the pinion"),
    Rule(CUTTER.profile_shift.symbol, PINION.profile_shift.symbol, "that of the pinion"),
    Rule(CUTTER.tip_radius.symbol,
         PINION.tip_radius.symbol + CUTTER.reference_radius - PINION.reference_radius
         + (CUTTER.profile_shift.symbol - PINION.profile_shift.symbol + CLEARANCE) * m,
         "the addendum of the pinion and the clearance at the root"),
    Rule(CUTTER.rounding.symbol, _rounding(), "a fifth of the module, as far as the tip has room"),
)  # fmt: skip

RULES = (
    Rule(PINION.helix_angle.symbol, sp.Integer(0), "spur gears"),
    *(rule for rule in k.RULES if rule.target in (k.dedendum.symbol, k.rounding.symbol)),
    *PINION.rules(),
    *CUTTER_RULES,
    *RING.rules(),
)
