"""What gears that a rolling rack generates have in common: envelope, body, root fillet, solid teeth, undercut."""

import sympy as sp

from derive.language.chain import Rz, translation
from derive.language.drive import Body, Margin, body_point
from derive.language.envelope import envelope, explicit
from derive.language.functions import Function, Result, solid
from derive.language.symbols import rotation_angle


def rolled(cutter, name, radius, angle, document):
    """The envelope of a cutter's surface on the gear that rolls on it, and the turn of the gear in generation: it turns
    by −φ while the rack moves by −r φ along y. ``document``: the audit's chapter that proves it.
    """
    phi = rotation_angle(angle, f"turn of the {name} in generation", "gen")
    rolling = Rz(phi) @ translation(x=radius, y=-radius * phi)
    surface, solved = explicit(envelope(cutter, rolling, phi))
    return surface.on(*(f"{document}/{key}" for key in ("meshing", "explicit", "tangent", "undercut"))), solved.symbol


def body(tooth, motion, reference, margins):
    """The gear of a tooth in its motion."""
    name = tooth.gear.name
    return Body(
        name,
        tooth.surface,
        motion,
        reference=reference,
        point=body_point(name),
        margins=margins,
        recovered=(tooth.generating_angle,),
        lengthwise="axial",
    )


def fillet_margins(tooth, pressure_angle):
    """The fillet runs from the flank to where its normal is radial."""
    turn = tooth.fillet.parameters[0]
    return Margin("", "junction", turn, joins="flank"), Margin("", "bottom", sp.pi / 2 - pressure_angle - turn)


def solid_teeth(gear, module, pressure_angle, root_radius, edge):
    """The solid of a gear; ``edge``: where its flank begins on the cutter's edge, and beyond where it meets the tip."""
    half_face = gear.face_width.symbol / 2
    sizes = {
        "module": (module, "mm"),
        "teeth": (gear.teeth.symbol, ""),
        "root_radius": (root_radius, "mm"),
        "face_first": (-half_face, "mm"),
        "face_last": (half_face, "mm"),
        "flank_root": (edge[0], "mm"),
        "tip_first": (edge[0], "mm"),
        "tip_last": (edge[1], "mm"),
        "fillet_junction": (0, "rad"),
        "fillet_land": (sp.pi / 2 - pressure_angle, "rad"),
    }
    return solid(gear.name, sizes)


def undercut(tooth, along, tool, origin, ends):
    """The positions ``ends`` on the edge of the ``tool`` between which undercut is sought, by name, and the position
    ``along`` it of a point of the flank, from ``origin``.
    """
    name = tooth.gear.name
    return (
        Function(
            f"undercut_range_{name}",
            f"positions on the edge of the {tool} between which undercut is sought",
            (),
            tuple(Result(end, (sp.sympify(value),), "mm", name) for end, value in ends.items()),
        ),
        Function(
            f"undercut_place_{name}",
            f"position on the edge of the {tool}{origin}",
            tooth.surface.parameters,
            (Result("edge_position", (along,), "mm", name),),
        ),
    )
