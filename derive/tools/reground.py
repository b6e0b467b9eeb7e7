"""A hob whose rake faces were ground back: its profile lies nearer to the axis, its lead is that of the new hob.

With radial relief and straight gashes every axial profile f(ϱ) becomes f(ϱ + Δ) at an unchanged screw parameter: a
point (x, y, z) of the new section goes to (x, y)(1 − Δ/ϱ) and z. The result is no new hob of smaller radius, whose lead
would be smaller too.
"""

from dataclasses import replace

import sympy as sp

from derive.language import vectors as v
from derive.language.drive import DesignSystem
from derive.language.replace import replaced
from derive.language.surface import Step, Surface
from derive.language.symbols import Unknown


def reground(tool, body, definitions, amount):
    """The tool (:class:`~derive.tools.worm_body.WormTool`) after ``amount`` (mm) went off along its radii.

    Its profile parameter is that of the new hob, and so are the limits that depend on it alone.
    """
    x, y, z = tool.flank.point
    name, sweep, t = body.name, tool.flank.motion, tool.parameter
    before = x if y == 0 else definitions.let(f"R_{name}", v.radius(x, y), "radius on the new hob", "mm", name)
    left = definitions.let(f"R_reground_{name}", before - amount, "radius that is left of it", "mm", name)
    section = (left, sp.Integer(0), z) if y == 0 else (x * left / before, y * left / before, z)
    point = definitions.let_vector(f"P_reground_{name}", section, "profile of the reground hob", "mm", name)
    normal = definitions.let_vector(f"n_reground_{name}", _normal(tool.flank, before, left), "normal", "", name)
    tangents = definitions.derivative_vector(point, t), sweep.local_velocity(body.turn, point)
    made = Step.of("given", point=point, normal=normal, motion=sweep, first=tangents[0], second=tangents[1])
    return replace(tool, flank=Surface(definitions, (t, body.turn), point, tangents, normal, sweep, made=(made,)))


def _normal(flank, before, left):
    """The normal, times what is left of the radius.

    Its radial and axial parts stay; the third follows from n·(k × r + p k) = 0 at the smaller radius.
    """
    (x, y, _), (n_x, n_y, n_z) = flank.point, flank.normal
    if y == 0:
        return left * n_x, before * n_y, left * n_z
    radial, round_ = (x * n_x + y * n_y) * left / before, x * n_y - y * n_x
    return (x * radial - y * round_) / before, (y * radial + x * round_) / before, left * n_z


def working_radius(tool, body, definitions, amount, radius, keys):
    """The design system for the ``radius`` of the cylinder on which the reground hob's groove is as wide, normal to the
    thread, as the new hob's on its reference cylinder: cut there, the wheel keeps the thickness of its teeth.

    ``tool`` is the new hob.
    """
    x, y, z = tool.flank.point
    t, p = tool.parameter, tool.screw_parameter
    axial = z if y == 0 else z - p * v.arc(y, x)
    new = replaced(definitions.resolve(axial), {t: tool.pitch_point})

    def normal_width(height, at):
        return height * at / v.radius(at, p)

    # positive of every hob, and infinite where the residual has no meaning
    finite = sp.tan(body.pressure_angle) / (sp.sin(body.lead_angle) * sp.cos(body.lead_angle))
    before = x if y == 0 else v.radius(x, y)
    return DesignSystem(
        name="reground",
        unknowns=(Unknown(t, tool.scale), Unknown(radius, body.module)),
        residual=(
            (normal_width(axial, radius) - normal_width(new, body.pitch_radius)) * finite,
            before - amount - radius,
        ),
        guess={t: tool.pitch_point, radius: body.pitch_radius - amount},
        fills={radius: radius},
        message="no cylinder of the reground hob has a groove as wide as the wheel's teeth: less must be ground off",
        keys=keys,
        homotopy=True,
        definitions=definitions,
    )
