"""The data of a worm or hob body from which every generating tool makes a flank, and what a tool gives back."""

from dataclasses import dataclass

import sympy as sp

from derive.surface import Surface
from derive.symbols import Quantity


@dataclass(frozen=True)
class WormBody:
    """A threaded body, right hand. Angles in rad, lengths in mm; see the drive for the meaning of each."""

    name: str
    turn: Quantity
    pitch_radius: sp.Expr
    lead_angle: sp.Expr
    screw_parameter: sp.Expr
    pressure_angle: sp.Expr
    groove_width: sp.Expr
    flank: sp.Expr
    grinding_wheel_radius: sp.Expr
    profile_arc_radius: sp.Expr
    tip_addendum: sp.Expr


@dataclass(frozen=True)
class WormTool:
    """A flank with the profile parameter of its pitch point, its end of blade, and the roots that must exist.

    ``tip_margin`` > 0 on the part of the profile that the tool's blade reaches; ``regular`` > 0 where the flank
    exists (beyond it lies an edge of regression); ``radicands`` are (reason, expression > 0).
    """

    flank: Surface
    pitch_point: sp.Expr
    tip_margin: sp.Expr
    regular: sp.Expr | None = None
    radicands: tuple = ()

    @property
    def parameter(self):
        """The profile parameter."""
        return self.flank.parameters[0]
