"""A basic rack whose edge carries profile modifications and whose sweep across the face carries those of the lead.

Frame of the rack, origin in its datum line at the middle of the face: x out of the gear, y along the rack, z along
the gear axis. The edge bounds a space of the rack and envelops a tooth of the gear, which is centred on x at rest.
Modifications as in ISO 21771: positive amounts take material off the tooth.
"""

from dataclasses import dataclass

import sympy as sp

from derive.language.chain import translation
from derive.language.choice import excess
from derive.language.surface import Surface, swept
from derive.language.symbols import Quantity


@dataclass(frozen=True)
class Relief:
    """``amount`` mm at the end of the edge; the relief begins at the place ``begin`` on it."""

    amount: sp.Expr
    begin: sp.Expr


@dataclass(frozen=True)
class RackBody:
    """What the rack needs to know of one gear. Angles in rad, lengths in mm.

    ``start`` and ``end`` are the places on the edge, from the datum line, that cut the start of the involute and the
    tip of the gear. ``shift`` is the distance of the datum line from the generating pitch line.
    """

    name: str
    module: sp.Expr
    pressure_angle: sp.Expr
    helix_angle: sp.Expr
    shift: sp.Expr
    dedendum: sp.Expr
    rounding: sp.Expr
    flank: sp.Expr
    face_width: sp.Expr
    start: sp.Expr
    end: sp.Expr
    crowning: sp.Expr
    slope: sp.Expr
    twist: sp.Expr
    tip_relief: Relief
    root_relief: Relief
    relief_exponent: sp.Expr
    lead_crowning: sp.Expr
    lead_slope: sp.Expr


@dataclass(frozen=True)
class BasicRack:
    """The cutting surfaces: the edge cuts the flank, the rounding the fillet.

    Parameters: ``along`` the edge, mm from the datum line towards the tip of the gear, and ``axial``, mm from the
    middle of the face; of the rounding the turn of its normal, from 0 at the edge to 90° − α at the root circle.
    """

    cutter: Surface
    rounding: Surface
    along: Quantity
    axial: Quantity


def basic_rack(body, definitions):
    """The :class:`BasicRack` for one flank of one gear."""
    name, alpha = body.name, body.pressure_angle
    along = Quantity(f"l_{name}", "mm", f"along the rack's edge from its datum line, to the tip of the {name}", name)
    axial = Quantity(f"z_{name}", "mm", f"position across the face of the {name}", name)
    turn = Quantity(f"xi_{name}", "rad", f"turn of the normal along the rounding of the {name}'s rack", name)
    traverse = _traverse(body, axial)

    def surface(height, half_width, parameter, outward):
        section = height, body.flank * half_width / sp.cos(body.helix_angle), sp.Integer(0)
        return swept(definitions, section, traverse, along=parameter, sweep=axial, outward=outward * body.flank)

    depth = definitions.let(f"E_{name}", _depth(body, along, axial), f"modification of the profile, {name}", "mm", name)
    edge = (
        along * sp.cos(alpha) - depth * sp.sin(alpha) + body.shift,
        sp.pi * body.module / 4 - along * sp.sin(alpha) - depth * sp.cos(alpha),
    )
    centre = sp.pi * body.module / 4 - body.start * sp.sin(alpha) + body.rounding * sp.cos(alpha)
    rounding = (
        body.rounding * (1 - sp.sin(alpha + turn)) - body.dedendum + body.shift,
        centre - body.rounding * sp.cos(alpha + turn),
    )
    return BasicRack(surface(*edge, along, 1), surface(*rounding, turn, -1), along, axial)


def _depth(body, along, axial):
    """By how much the edge lies deeper in the tooth, along its normal."""
    u = (2 * along - body.end - body.start) / (body.end - body.start)
    w = 2 * axial / body.face_width
    tip, root = body.tip_relief, body.root_relief
    q = body.relief_exponent
    at_tip, at_root = excess(along - tip.begin) / (body.end - tip.begin), excess(root.begin - along) / (
        root.begin - body.start
    )
    return (
        body.crowning * u**2
        + body.slope * u / 2
        + body.twist * u * w / 4
        + tip.amount * _power(at_tip, q)
        + root.amount * _power(at_root, q)
    )


def _power(a, exponent):
    """a² or a³."""
    return a**2 * (3 - exponent + (exponent - 2) * a)


def _traverse(body, axial):
    """Along the trace; crowning is a plunge by a parabola, a slope of the lead a feed along the rack."""
    w = 2 * axial / body.face_width
    plunge = body.lead_crowning * w**2 / sp.sin(body.pressure_angle)
    feed = body.lead_slope * w / (2 * sp.cos(body.pressure_angle) * sp.cos(body.helix_angle))
    return translation(x=-plunge, y=axial * sp.tan(body.helix_angle) - body.flank * feed, z=axial)
