"""The rounding between a hob's flank and its tip cylinder: a ball that touches both, in screw motion.

It is the same for every flank form: the ball's centre describes a helix, the ball a tube around it. A radius of zero
leaves the helix itself, the sharp edge of the tip.
"""

from dataclasses import dataclass

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import placement, screw, translation
from derive.language.surface import Surface
from derive.language.symbols import Quantity, rotation_angle


@dataclass(frozen=True)
class Rounding:
    """The rounding of a hob, its normals out of the hob; parameters (ξ, t, ψ).

    ξ is the turn of the normal from the radius, 0 on the tip cylinder. t is the profile parameter of the flank where
    the ball touches it: the surface's one condition, which contains nothing else, says that the ball touches the tip
    cylinder too. ``before_flank`` is the sine of the turn that is left to the flank's normal.
    """

    surface: Surface
    before_flank: sp.Expr

    @property
    def turn(self):
        """ξ."""
        return self.surface.parameters[0]


def tip_rounding(tool, body, definitions):
    """The :class:`Rounding` of a hob whose flank is ``tool`` and whose data is ``body``."""
    name, radius, t = body.name, body.tip_rounding, tool.parameter
    tip = body.pitch_radius + body.tip_addendum
    normal = definitions.let_vector(
        f"n_round_{name}", v.unit(tool.flank.normal), "unit normal where the ball touches the flank", "", name
    )
    centre = definitions.let_vector(
        f"C_round_{name}", v.sub(tool.flank.point, v.scale(radius, normal)), "centre of the ball", "mm", name
    )
    distance = definitions.let(
        f"R_round_{name}", v.radius(centre[0], centre[1]), "distance of the centre from the axis", "mm"
    )
    turn = rotation_angle(f"psi_round_{name}", f"screw angle of the rounding of the {name}", name)
    advance = screw(turn, body.screw_parameter)
    radial = (centre[0] / distance, centre[1] / distance, sp.Integer(0))
    along = v.unit(advance.local_velocity(turn, centre))
    axes = {"x": (radial, "radius"), "y": (along, "tangent"), "z": (v.cross(radial, along), "binormal")}
    frame = tuple(
        definitions.let_vector(f"e_{axis}_round_{name}", e, f"{meaning} of the helix of centres", "", name)
        for axis, (e, meaning) in axes.items()
    )
    motion = advance @ translation(*centre) @ placement(frame[0], frame[1], frame[2], (0, 0, 0))
    xi = Quantity(f"xi_round_{name}", "rad", f"turn of the rounding's normal from the radius of the {name}", name)
    outward = (sp.cos(xi), sp.Integer(0), -body.flank * sp.sin(xi))
    turning = definitions.derivative_vector(outward, xi)
    at_centre = (sp.Integer(0),) * 3
    surface = Surface(
        definitions,
        (xi, t, turn),
        v.scale(radius, outward),
        (turning, motion.local_velocity(turn, at_centre)),
        outward,
        motion,
        conditions=(tip - radius - distance,),
        pole=at_centre,
        steps=(*tool.flank.steps, "helicoids/rounding-normal", "helicoids/rounding-join", "helicoids/rounding-tip"),
    )
    before_flank = sp.Add(*(a * v.dot(normal, axis) for a, axis in zip(turning, frame, strict=True)))
    return Rounding(surface, before_flank)
