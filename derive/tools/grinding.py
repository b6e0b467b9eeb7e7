"""A grinding wheel in the groove of a worm in screw motion: set at the lead angle, its axis above the worm's."""

from dataclasses import replace

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import Rx, screw, swing
from derive.language.envelope import envelope
from derive.language.origin import joined
from derive.language.surface import Surface
from derive.language.symbols import Quantity
from derive.language.tool import Datum
from derive.tools.worm_body import WormTool, reach, regression

WHEEL_RADIUS = Datum(
    "grinding_wheel_radius_mm", "r_c", "grinding wheel radius", domain=(0, sp.oo), required=True, sample=60,
    suggested=250, why="a wheel of 500 mm",
)  # fmt: skip


def grinding_wheel(body, definitions, point, tangent, profile, parameter, outward, pole=None):
    """The wheel's flank in the worm frame: ``profile`` · ``point`` in the plane y = 0, turned about the wheel's axis.

    The circles of the wheel cross that plane along y, whatever their radius; ``outward`` turns tangent × y out of
    the wheel.
    """
    theta = Quantity(f"t_{body.name}", "rad", "angle of the contact point on the grinding wheel", body.name)
    centre = (body.pitch_radius + body[WHEEL_RADIUS], 0, 0)
    motion = Rx(body.lead_angle) @ swing("z", -theta, centre) @ profile
    normal = v.scale(outward, v.cross(tangent, v.J))
    return Surface(
        definitions, (parameter, theta), point, (tangent, v.J), normal, motion, pole=pole,
        steps=("derivation/revolved",),
    )  # fmt: skip


def ground_flank(wheel, body, solve):
    """The flank that the wheel leaves on the worm: its envelope in screw motion, made explicit by ``solve``.

    The section frame of the result is the worm's, as it is for a blade.
    """
    sweep = screw(body.turn, body.screw_parameter)
    flank = solve(envelope(wheel, sweep, body.turn))
    inner, let = wheel.motion, wheel.definitions.let_vector
    return replace(
        flank,
        point=let(f"P_{body.name}", inner.point(flank.point), "contact point on the wheel", "mm", body.name),
        tangents=tuple(inner.direction(t) for t in flank.tangents),
        normal=let(f"n_{body.name}", inner.direction(flank.normal), "normal", "", body.name),
        motion=sweep,
        pole=None,
        steps=joined(flank.steps, inner.rests_on, ("helicoids/helicoid",)),
    )


def ground_tool(body, flank, radicands=()):
    """A ground flank with its limits: the rim of the wheel, and the edge where the profile turns back.

    Along the profile the radius grows towards +t on the flank s = +1; where it no longer does, the flank ends.
    """
    x, y, _ = flank.point
    return WormTool(
        flank,
        pitch_point=sp.Integer(0),
        tip_margin=reach(body, v.radius(x, y)),
        scale=body.module / body[WHEEL_RADIUS],
        screw_parameter=body.screw_parameter,
        margins=(regression(body.flank * (x**2 + y**2), along=flank.parameters[0]),),
        radicands=radicands,
    )
