"""A straight-edged rack section that sweeps an arc (convex, concave) or a straight line (spur).

Frame of the section, origin at the pitch point: x radially outwards from the gear axis, y along the rack, z along
the gear axis. The edge bounds a space of the rack and envelops a tooth of the gear, which is centred on x at rest.
Source: National Science Council of Taiwan, report on spherical gears, 2009, (2.1) to (2.5).
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

import sympy as sp

from derive.language.chain import swing, translation
from derive.language.surface import Surface, swept
from derive.language.symbols import Quantity
from derive.language.tool import Datum, Tool

SPHERE_RADIUS = Datum(
    "sphere_radius_mm", "R", "radius of the cutter's arc (convex or concave)", domain=(0, sp.oo), required=True
)


@dataclass(frozen=True)
class RackBody:
    """What a rack section needs to know of one gear. Angles in rad, lengths in mm.

    ``edge_offset`` is half the depth of the straight edge, ``half_space`` half the width of the rack's space at the
    pitch line, ``tip_radius`` the rounding between the edge and the tip of the cutter. ``body[datum]`` is the symbol of
    a tool's own datum.
    """

    name: str
    pressure_angle: sp.Expr
    edge_offset: sp.Expr
    half_space: sp.Expr
    tip_radius: sp.Expr
    flank: sp.Expr
    own: Mapping[Datum, sp.Expr]

    def __getitem__(self, datum):
        return self.own[datum]


@dataclass(frozen=True)
class RackTool:
    """The cutting surfaces and what a gear wants to know of them: the edge cuts the flank, the rounding the fillet.

    ``tip_drop(height, axial)`` is by how much the tip circle of a blank that ends ``height`` above the pitch point
    at mid face is smaller at an axial position. ``arc_radius`` is None for a straight sweep.
    """

    cutter: Surface
    rounding: Surface
    edge_length: sp.Expr
    pitch_point: sp.Expr
    tip_drop: Callable[[sp.Expr, sp.Expr], sp.Expr]
    arc_radius: sp.Expr | None = None

    @property
    def along(self):
        """The parameter along the edge, mm from its end at the root of the gear."""
        return self.cutter.parameters[0]

    @property
    def sweep(self):
        """The parameter across the face: angle of the arc in rad, or z in mm."""
        return self.cutter.parameters[1]


def _edge_point(body, along):
    """Point of the straight edge, (2.1): from the gear's root (0) to its tip."""
    alpha, a = body.pressure_angle, body.edge_offset
    half_width = body.half_space + a * sp.tan(alpha) - along * sp.sin(alpha)
    return along * sp.cos(alpha) - a, body.flank * half_width, sp.Integer(0)


def _rounding_point(body, turn):
    """Point of the rounding, which touches the edge where that ends; ``turn`` is that of its normal, 0 there."""
    x, y, z = _edge_point(body, sp.Integer(0))
    alpha, radius = body.pressure_angle, body.tip_radius
    x -= radius * (sp.sin(alpha + turn) - sp.sin(alpha))
    y -= body.flank * radius * (sp.cos(alpha + turn) - sp.cos(alpha))
    return x, y, z


def _tool(body, definitions, sweep, motion, arm, tip_drop, arc_radius=None):
    name = body.name
    along = Quantity(f"l_{name}", "mm", f"along the cutter's edge from the root of the {name}", name)
    turn = Quantity(f"xi_{name}", "rad", f"turn of the normal along the rounding of the {name}'s cutter", name)

    def surface(section, parameter, outward):
        return swept(
            definitions, section, motion, along=parameter, sweep=sweep, outward=outward, arm=arm(section[0])
        )

    half_length = body.edge_offset / sp.cos(body.pressure_angle)
    return RackTool(
        cutter=surface(_edge_point(body, along), along, body.flank).on("spherical_gears/normal"),
        rounding=surface(_rounding_point(body, turn), turn, -body.flank),
        edge_length=2 * half_length,
        pitch_point=half_length,
        tip_drop=tip_drop,
        arc_radius=arc_radius,
    )


def on_arc(sense, body, definitions):
    """The section turns about a far axis parallel to y: on the gear's side (``sense`` +1, convex) or beyond (−1)."""
    radius = body[SPHERE_RADIUS]
    theta = Quantity(
        f"theta_{body.name}", "rad", f"angle of the arc across the face of the {body.name}", body.name,
        (-sp.pi / 2, sp.pi / 2),
    )  # fmt: skip

    def tip_drop(height, axial):
        outer = radius + sense * height
        return sense * axial**2 / (outer + sp.sqrt(outer**2 - axial**2))

    return _tool(
        body,
        definitions,
        sweep=theta,
        motion=swing("y", -sense * theta, (-sense * radius, 0, 0)),
        arm=lambda x: radius + sense * x,
        tip_drop=tip_drop,
        arc_radius=radius,
    )


def on_line(body, definitions):
    """The section moves along the gear axis: the limit of both arcs for an infinite radius."""
    z = Quantity(f"z_{body.name}", "mm", f"position across the face of the {body.name}", body.name)
    return _tool(
        body,
        definitions,
        sweep=z,
        motion=translation(z=z),
        arm=lambda x: sp.Integer(1),
        tip_drop=lambda height, axial: sp.Integer(0),
    )


#: Forms of a gear and the sweep of the rack section that cuts them.
SWEEPS = {
    "convex": Tool(partial(on_arc, 1), (SPHERE_RADIUS,)),
    "concave": Tool(partial(on_arc, -1), (SPHERE_RADIUS,)),
    "spur": Tool(on_line),
}
