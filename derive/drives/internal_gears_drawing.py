"""What drawings of internal gear pairs state: as those of cylindrical gears (ISO 21771:2007), with the cutter of the
ring gear and the interferences of internal pairs.

The number of teeth of the ring gear is negative; its diameters, and the distances of the axes, are positive.
"""

import sympy as sp

from derive.drives import cylindrical_gears_drawing as external
from derive.drives.cylindrical_gears_drawing import Member, inv, kind, rolled, working_angle
from derive.drives.cylindrical_gears_keys import PINION
from derive.drives.internal_gears_keys import CUTTER, CUTTER_RULES, RING, RULES, shaping_distance
from derive.language.drawing import Assumed, Check, Drawing, Elsewhere, Relation, Root, relation
from derive.language.symbols import Quantity, Rule, parameter

m, alpha, a, a_02 = external.m, external.alpha, external.a, shaping_distance.symbol

shaping_angle = parameter(
    "shaping_pressure_angle_deg", "alpha_w02", "transverse working pressure angle of ring gear and cutter"
)
wheel_helix = parameter("wheel_helix_angle_deg", "beta_wheel", "helix angle of the ring gear, right hand positive")


class RingMember(Member):
    """The ring gear; its root and the end of its involute are the cutter's."""

    side = -1

    def root(self, diameter, r):
        r_a0 = CUTTER.tip_radius.symbol
        return relation(diameter, 2 * (a_02 + r_a0), r_a0)

    def undercut(self):
        return ()


def _shaping(ring):
    """How the cutter stands at full depth."""
    at = Quantity("at", "rad", "pressure angle sought")
    shifts, teeth = CUTTER.profile_shift.symbol + ring.x_E, CUTTER.teeth.symbol + RING.teeth.symbol
    residual = inv(at) - inv(PINION.transverse_pressure_angle) - 2 * shifts * sp.tan(alpha) / teeth
    bases = ring.r_b - CUTTER.base_radius
    return (
        Relation(shaping_angle.symbol, Root(at, residual, sp.Integer(0), external.STEEPEST)),
        relation(a_02, bases / sp.cos(shaping_angle.symbol)),
        relation(wheel_helix.symbol, PINION.helix_angle.symbol),
    )


class _Mesh:
    """A pinion in the ring gear at a distance of their axes: tip angles and what decides over interference."""

    def __init__(self, ring, base, tip, distance, angle, teeth):
        self.u, self.distance, self.tips = teeth / RING.number, distance, (tip, RING.tip_radius.symbol)
        self.bases, self.angle = (base, ring.r_b), angle

    def _opened(self, k):
        """inv α_a − inv α_w of a member."""
        return inv(sp.acos(self.bases[k] / self.tips[k])) - inv(self.angle)

    def trochoid(self):
        """Angle of the ring gear left between both tips where their circles cross."""
        r_1, r_2 = self.tips
        theta_1 = sp.acos((r_2**2 - r_1**2 - self.distance**2) / (2 * self.distance * r_1))
        theta_2 = sp.acos((self.distance**2 + r_2**2 - r_1**2) / (2 * self.distance * r_2))
        return self.u * (theta_1 + self._opened(0)) - self._opened(1) - theta_2

    def radial(self):
        """Angle of the pinion left between both tips as the pinion passes them on the line of centres."""
        share = (self.bases[0] * self.tips[1] / (self.tips[0] * self.bases[1])) ** 2
        tau_1 = sp.asin(sp.sqrt((1 - share) / (1 - self.u**2)))
        tau_2 = sp.asin(sp.sqrt((1 / share - 1) / (1 / self.u**2 - 1)))
        return tau_1 + self._opened(0) - (tau_2 + self._opened(1)) / self.u


def _checks(pinion, ring, first, last):
    """Of the pair and of the cutter in the ring gear; lengths in mm, angles in rad."""
    whole, generated = a * sp.sin(working_angle.symbol), a_02 * sp.sin(shaping_angle.symbol)
    tips = rolled(pinion, PINION.tip_radius.symbol), rolled(ring, RING.tip_radius.symbol)
    pair = _Mesh(ring, pinion.r_b, PINION.tip_radius.symbol, a, working_angle.symbol, PINION.teeth.symbol)
    cut = _Mesh(ring, CUTTER.base_radius, CUTTER.tip_radius.symbol, a_02, shaping_angle.symbol, CUTTER.teeth.symbol)
    return (
        Check("involute_interference", tips[1] - whole - first,
              "the tip of the ring gear meets the fillet of the pinion; take a larger tip circle of the ring gear or "
              "more profile shift of the pinion; margin in mm along the line of action"),
        Check("wheel_fillet_interference", last - whole - tips[0],
              "the tip of the pinion meets the fillet of the ring gear; take a smaller tip circle of the pinion, a "
              "larger one of the cutter or less rounding of its tip; margin in mm along the line of action"),
        Check("trochoid_interference", pair.trochoid(),
              "tips meet outside the path of contact; take a larger difference of the numbers of teeth, shorter tips "
              "or a larger pressure angle; margin in rad of the ring gear"),
        Check("radial_assembly", pair.radial(),
              "the pinion can be put in place from the middle of the ring gear; margin in rad of the pinion",
              occurs=False),
        Check("wheel_base_circle_of_cutter", tips[1] - generated,
              "the tip of the ring gear is cut from within the base circle of the cutter; take a larger tip circle of "
              "the ring gear or more teeth of the cutter; margin in mm along the line of action"),
        Check("wheel_trimming", cut.radial(),
              "the cutter, fed in from the middle, trims the tips of the ring gear; take fewer teeth of the cutter "
              "or shorter tips; margin in rad of the cutter"),
    )


def drawing():
    """The drawing of the family."""
    pinion, ring = Member(PINION), RingMember(RING)
    first, last = rolled(pinion, pinion.r_F), rolled(ring, ring.r_F)
    whole = a * sp.sin(working_angle.symbol)
    tips = rolled(pinion, PINION.tip_radius.symbol), rolled(ring, RING.tip_radius.symbol)
    path = sp.Min(tips[0], last - whole) - sp.Max(tips[1] - whole, first)
    inner = Assumed(kind.symbol, sp.Integer(-1), "the number of teeth is negative")
    racks = [rule for rule in RULES if rule.target in (external.k.dedendum.symbol, external.k.rounding.symbol)]
    return Drawing(
        sizes=(*external.PAIR, shaping_angle, wheel_helix, *pinion.sizes, *ring.sizes),
        relations=(*external.pair(pinion, ring, path), *_shaping(ring), *pinion.relations, *ring.relations),
        defaults=external.defaults(
            pinion, ring, (Rule(PINION.helix_angle.symbol, sp.Integer(0), "spur gears"),), inner,
            RING.base_radius - PINION.base_radius, (*racks, *PINION.rules()[1:2], *CUTTER_RULES),
        ),
        checks=(*pinion.checks, *ring.checks, *_checks(pinion, ring, first, last)),
        guards=(external.NO_RACK,),
        elsewhere=(
            Elsewhere(kind.symbol - sp.Rational(1, 2), "cylindrical-gears", "a wheel with outer teeth"),
            Elsewhere(RING.teeth.symbol, "cylindrical-gears", "a number of outer teeth"),
        ),
    )  # fmt: skip
