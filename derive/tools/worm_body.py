"""The data of a worm or hob body from which every generating tool makes a flank, and what a tool gives back."""

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from derive.language.drive import Margin, Role
from derive.language.surface import Surface
from derive.language.symbols import Quantity, Rule
from derive.language.tool import Datum

#: Part used of the angle about the hob over which it cuts the wheel.
SHEET_USED = sp.Rational(6, 10)


@dataclass(frozen=True)
class WormBody:
    """A threaded body, right hand. Angles in rad, lengths in mm; see the drive for the meaning of each.

    ``body[datum]`` is the symbol of a tool's own datum.
    """

    name: str
    turn: Quantity
    module: sp.Expr
    pitch_radius: sp.Expr
    lead_angle: sp.Expr
    screw_parameter: sp.Expr
    pressure_angle: sp.Expr
    groove_width: sp.Expr
    flank: sp.Expr
    tip_addendum: sp.Expr
    tip_rounding: sp.Expr
    own: Mapping[Datum, sp.Expr]

    def __getitem__(self, datum):
        return self.own[datum]


@dataclass(frozen=True)
class WormTool:
    """A flank with the profile parameter at (or near) its pitch point, its limits, and what it needs to exist.

    ``tip_margin`` > 0 on the part of the profile that the tool's blade reaches; ``scale`` is the natural size of the
    profile parameter, ``lower_end`` its least value where the profile has an end of its own; ``margins`` are limits of
    the flank that this tool alone has, such as the edge of regression beyond which there is none; ``rules`` complete
    its data; ``radicands`` are (reason, expression > 0).
    """

    flank: Surface
    pitch_point: sp.Expr
    tip_margin: sp.Expr
    scale: sp.Expr
    screw_parameter: sp.Expr
    lower_end: sp.Expr | None = None
    margins: tuple[Margin, ...] = ()
    rules: tuple[Rule, ...] = ()
    radicands: tuple = ()

    @property
    def parameter(self):
        """The profile parameter."""
        return self.flank.parameters[0]


def reach(body, radius):
    """Positive where the tool reaches: up to the tip addendum above the pitch cylinder."""
    return body.pitch_radius + body.tip_addendum - radius


def regression(positive, along=None):
    """The margin of an edge of regression: ``positive`` > 0, or growing along a parameter, where the flank exists."""
    return Margin("beyond_regression", "regression", positive, Role.REGRESSION, along=along)
