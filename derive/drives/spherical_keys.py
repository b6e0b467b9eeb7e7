"""Parameters of spherical gears: design keys, defaults, and what the two gears share unless one says otherwise."""

from dataclasses import dataclass

import sympy as sp

from derive.language.symbols import Parameter, Rule, Table, parameter

POSITIVE = (0, sp.oo)

#: Rounding of the standard basic rack's tip (ISO 53, profile A) over the module.
STANDARD_ROUNDING = sp.Rational(38, 100)

flank = parameter("flank", "s", "cutting edge", table=Table.FLANK, choices=(("left", 1), ("right", -1)), default=1)
module = parameter("module_mm", "m", "module", domain=POSITIVE, required=True)
pressure_angle = parameter(
    "pressure_angle_deg", "alpha", "pressure angle of the cutter", domain=(0, sp.pi / 2), required=True
)
face_width = parameter("face_width_mm", "F", "face width", domain=POSITIVE, required=True)
edge_offset = parameter(
    "edge_offset_mm", "a", "the straight edge reaches this far to both sides of the pitch line", domain=POSITIVE
)
half_space = parameter("half_space_mm", "b", "half width of the rack's space at the pitch line", domain=POSITIVE)

error_distance = parameter(
    "center_distance_mm", "dC", "centre distance error", table=Table.MISALIGNMENT, default=0
)
error_horizontal = parameter(
    "horizontal_deg", "dh", "turn of the pinion axis about x", table=Table.MISALIGNMENT, default=0
)
error_vertical = parameter("vertical_deg", "dv", "turn of the pinion axis about y", table=Table.MISALIGNMENT, default=0)

separation = parameter(
    "separation_mm",
    "delta",
    "separation for contact ellipses",
    table=Table.CONTACT,
    domain=POSITIVE,
    default=sp.Rational(632, 100000),
)
limit = parameter(
    "limit",
    "limit",
    "what ends contact at the tips: the blanks of the gears, or the straight part of the cutter alone",
    table=Table.CONTACT,
    choices=(("tip", 1), ("cutter", -1)),
    default=1,
)


@dataclass(frozen=True)
class Gear:
    """The design keys of one member."""

    name: str
    teeth: Parameter
    face_width: Parameter
    edge_offset: Parameter
    half_space: Parameter
    cutter_tip_radius: Parameter
    tip_addendum: Parameter

    @classmethod
    def of(cls, name, number):
        def length(key, symbol, meaning, table=Table.DESIGN, **kind):
            return parameter(f"{name}_{key}", f"{symbol}_{name}", f"{meaning} of the {name}", table=table,
                             domain=POSITIVE, **kind)  # fmt: skip

        return cls(
            name,
            parameter(f"{name}_teeth", f"T_{number}", f"teeth of the {name}", domain=POSITIVE, integer=True,
                      required=True),
            length("face_width_mm", "F", "face width"),
            length("edge_offset_mm", "a", "edge offset"),
            length("half_space_mm", "b", "half width of the rack's space"),
            length("cutter_tip_radius_mm", "rho", "rounding of the cutter's tip, which makes the fillet"),
            length("tip_addendum_mm", "h", "tip of the blank beyond the pitch circle at mid face", Table.BLANK),
        )  # fmt: skip

    def own(self, tool):
        """The keys of the data that the gear's tool has of its own, by datum."""
        return {datum: datum.parameter(self.name, f"{self.name}_") for datum in tool.data}

    def parameters(self, tool):
        """The gear's share of the parameter vector, cut by this tool."""
        return (self.teeth, *self.own(tool).values(), self.face_width, self.edge_offset, self.half_space,
                self.cutter_tip_radius, self.tip_addendum)  # fmt: skip

    @property
    def pitch_radius(self):
        return module.symbol * self.teeth.symbol / 2

    @property
    def full_rounding(self):
        """The radius of a cutter's tip that is round all over."""
        alpha, a, b = pressure_angle.symbol, self.edge_offset.symbol, self.half_space.symbol
        return (sp.pi * module.symbol / 2 - b - a * sp.tan(alpha)) / sp.cos(alpha)

    def rules(self):
        """What the pair shares unless a gear says otherwise; no tip where the cutter alone limits contact.

        The cutter's rounding is that of the standard basic rack (ISO 53, profile A) where that finds room.
        """
        standard, full = STANDARD_ROUNDING * module.symbol, self.full_rounding
        return (
            Rule(self.face_width.symbol, face_width.symbol),
            Rule(self.edge_offset.symbol, edge_offset.symbol),
            Rule(self.half_space.symbol, half_space.symbol),
            Rule(self.cutter_tip_radius.symbol, (standard + full - sp.Abs(standard - full)) / 2),
            Rule(self.tip_addendum.symbol, self.edge_offset.symbol * sp.sqrt(limit.symbol)),
        )


PINION, WHEEL = Gear.of("pinion", 1), Gear.of("wheel", 2)


def parameters(pinion_tool, wheel_tool):
    """The parameter vector of a pair cut by these tools."""
    return (
        flank, module, pressure_angle, face_width, edge_offset, half_space,
        *PINION.parameters(pinion_tool), *WHEEL.parameters(wheel_tool),
        error_distance, error_horizontal, error_vertical, separation, limit,
    )  # fmt: skip


RULES = (
    Rule(edge_offset.symbol, module.symbol),
    Rule(half_space.symbol, sp.pi * module.symbol / 4),
    *PINION.rules(),
    *WHEEL.rules(),
)
