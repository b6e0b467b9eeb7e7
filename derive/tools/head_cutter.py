"""Head-cutter: a blade that turns about the tool's axis; straight or parabolic edge, circular end.

Frame: z along the axis, x outwards from it to the blade point u = 0 on the edge, from which profiles are measured,
blade at θ = 0.

The surfaces are those of the gear tooth that the tool leaves as its copy: normals point out of the gear.
Source: F. L. Litvin, A. Nava, Q. Fan and A. Fuentes, NASA/CR-2002-211895, sections 2 to 4, Figs. 5 and 11.
"""

from dataclasses import dataclass

import sympy as sp

from derive.language.definitions import Definitions
from derive.language.surface import revolved
from derive.language.tool import tool


@dataclass(frozen=True)
class HeadCutterBody:
    """A blade set. Angles in rad, lengths in mm.

    ``radius`` is that of the blade point u = 0 on the edge; ``blade_angle`` is measured from the tool axis, positive
    where the radius grows with u (to the tip of the gear tooth); ``flank`` is +1 where the gear tooth is convex;
    ``depth`` is the distance of the blade's end below u = 0 along the axis.
    """

    radius: sp.Expr
    blade_angle: sp.Expr
    flank: sp.Expr
    fillet_radius: sp.Expr
    depth: sp.Expr


@tool()
def head_cutter(body, definitions):
    """Blades on a circle about the axis of a head-cutter."""
    return HeadCutter(body, definitions)


@dataclass(frozen=True)
class HeadCutter:
    """The working surfaces of a blade set."""

    body: HeadCutterBody
    definitions: Definitions

    @property
    def _across(self):
        """Direction in the axial section, normal to the edge and out of the gear tooth: (x, z)."""
        return self.body.flank * sp.cos(self.body.blade_angle), -self.body.flank * sp.sin(self.body.blade_angle)

    def edge(self, u, theta, parabola=0):
        """The working surface: a cone, or with ``parabola`` a blade that stands off it by parabola·u²."""
        x, z = self._across
        bulge = parabola * u**2
        profile = (
            u * sp.sin(self.body.blade_angle) + bulge * x,
            sp.Integer(0),
            u * sp.cos(self.body.blade_angle) + bulge * z,
        )
        proved = "face_worm/blade-normal" if parabola else "face_worm/cone-normal"
        return self._revolved(profile, u, theta).on(proved)

    @property
    def junction(self):
        """u where the edge ends and the rounding begins."""
        rise = 1 + self.body.flank * sp.sin(self.body.blade_angle)
        return (self.body.fillet_radius * rise - self.body.depth) / sp.cos(self.body.blade_angle)

    @property
    def fillet_end(self):
        """λ where the rounding joins the edge; λ = 0 is the end of the blade."""
        return sp.pi / 2 + self.body.flank * self.body.blade_angle

    def fillet(self, lam, theta):
        """The torus of the blade's rounding, λ from 0 (bottom of the tooth space) to ``fillet_end``."""
        x, _ = self._across
        centre = self.junction * sp.sin(self.body.blade_angle) + self.body.fillet_radius * x
        profile = (
            centre - self.body.flank * self.body.fillet_radius * sp.sin(lam),
            sp.Integer(0),
            self.body.fillet_radius * (1 - sp.cos(lam)) - self.body.depth,
        )
        return self._revolved(profile, lam, theta).on("face_worm/fillet-join", "face_worm/fillet-tangent")

    def _revolved(self, profile, along, theta):
        return revolved(
            self.definitions, profile, along=along, turn=theta, outward=-self.body.flank, radius=self.body.radius
        )
