"""Functions that a drive offers beside its contact: placements, limit points, axes, of arguments of their own.

A function's results are expressions in the design, the drive's definitions and the function's arguments; it is
scheduled on the drive's tape and printed like a flank.

The analyses find what a drive offers by the names of its functions, M standing for a member or another surface:

undercut_range_M     where undercut is sought: the profile parameter from ``first`` to ``last`` and at ``middle``; of an
                     explicit surface also the lines ``along_first`` to ``along_last``, else sections of its face;
                     ``start`` is where the tool's profile begins, for the least number of teeth
                     Without these undercut is sought between the limits of a flank, and along it beyond its face
undercut_place_M     of a surface's parameters: the place on the tool, a result in mm; ``inside`` > 0 on the flank where
                     the margins do not say it
profile_pinion, profile_tool, profile_range_…, generation, section, tool_point, second_type, meshing_axes, rack_sizes
                     generation of the wheel by a helicoid: see :mod:`derive.drives.rack_and_pinion`
solid_M              sizes of the solid teeth of a member: see :func:`solid`
outline_M            tip and root of a thread, where they are no cones: see :func:`outline`
tool_clearance       sizes of a tool of revolution that passes over finished teeth: see :class:`ToolClearance`
"""

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from derive.language import vectors as v
from derive.language.differentiate import partial
from derive.language.origin import cited
from derive.language.replace import replaced
from derive.language.symbols import Quantity
from derive.language.vectors import Number, Vector
from derive.language.written import remember


@dataclass(frozen=True)
class Result:
    """A named result: one number or several, with their unit and frame."""

    name: str
    values: tuple[sp.Expr, ...]
    unit: str = ""
    frame: str = ""


@dataclass(frozen=True)
class ToolClearance:
    """A tool of revolution whose blades pass over finished teeth beside the space that they cut.

    Results are called ``name``; ``tilt_key`` is the design key that changes the tilt of the tool's axis, ``tilt_size``
    the derived size that says it. The drive's function ``tool_clearance`` gives ``fillet_end`` (last parameter of the
    fillet), ``edge_root`` and ``edge_tip`` (first and last parameter of the flank), ``inner`` and ``outer`` radius of
    the face; flank and fillet of the wheel continued round the tool are the blades.
    """

    name: str
    tilt_key: str
    tilt_size: str


@dataclass(frozen=True)
class LeastTeeth:
    """How a member's number of teeth is varied in search of the least without undercut.

    ``teeth`` is its design key; sizes under the keys ``proportional`` keep their ratio to the pitch radius.
    """

    teeth: str
    proportional: tuple[str, ...] = ()


@dataclass(frozen=True)
class Function:
    """``results`` as a function of ``arguments`` (symbols) and the design.

    ``rests_on`` are statements of the audit record.
    """

    name: str
    meaning: str
    arguments: tuple[Quantity, ...]
    results: tuple[Result, ...]
    rests_on: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "rests_on", cited(self.rests_on))
        remember(self.name)


#: What the analyses read of a function, by its name or, where that ends in "_", by how its name begins.
READ: dict[str, tuple[str, ...]] = {
    "generation": ("point", "normal", "phi_hob", "psi_hob", "point_wheel", "first_type"),
    "profile_pinion": ("point", "normal", "growth", "axial"),
    "profile_tool": ("point", "normal", "growth", "axial"),
    "profile_range_": ("pitch_point", "scale"),
    "rack_sizes": (
        "axial_pitch_pinion", "cutting_angle", "cutting_distance", "end_radius_tool", "module", "oversize",
        "reference_radius_pinion", "reference_radius_tool", "root_radius_pinion", "same_profile",
        "throat_radius_wheel", "tip_radius_pinion", "tip_radius_wheel", "turns",
    ),
    "section": ("psi_fixed_hob",),
    "tool_point": ("psi_fixed_hob",),
    "second_type": ("psi_fixed_hob",),
    "meshing_axes": ("discriminant", "point_1", "direction_1", "point_2", "direction_2"),
    "undercut_range_": ("first", "last", "middle"),
    "tool_clearance": ("fillet_end", "edge_root", "edge_tip", "inner", "outer"),
}  # fmt: skip
#: Functions of which none is read without the others.
WITH_GENERATION = (
    "generation", "profile_pinion", "profile_tool", "profile_range_pinion", "profile_range_tool", "rack_sizes",
)  # fmt: skip


def read_of(name: str) -> tuple[str, ...]:
    """The results that analyses read of a function of this name."""
    return next((READ[key] for key in READ if name == key or (key.endswith("_") and name.startswith(key))), ())


#: How names of functions begin that say sizes of solid teeth.
SOLID = "solid_"

#: What :func:`solid` may say of a member: the unit of each size, "flank" or "fillet" for that of the profile parameter
#: of this surface.
SOLID_UNITS = {
    "module": "mm", "root_radius": "mm", "teeth": "", "face_first": "mm", "face_last": "mm",
    "flank_root": "flank", "tip_first": "flank", "tip_last": "flank", "middle": "flank",
    "fillet_junction": "fillet", "fillet_land": "fillet",
    "tip_radius": "mm", "rounding": "mm", "taper": "", "thickness": "mm", "screw_parameter": "mm/rad",
    "span_root": "flank", "span_middle": "flank", "span_tip": "flank",
}  # fmt: skip


def solid(member: str, sizes: Mapping[str, tuple[Number, str]]) -> Function:
    """The function ``solid_<member>`` that makes a solid of the member; ``sizes`` are values and units by name.

    Every member: ``module`` (the depth of the rim is counted in it) and, where a bore bounds the rim, ``root_radius``.

    A gear (its flank lies lengthwise "axial" or along the "radius"): ``teeth``; ``face_first``, ``face_last`` along the
    face; the profile parameters ``flank_root`` of the flank where its fillet begins, ``tip_first`` and ``tip_last``
    between which it meets the tip, ``fillet_junction`` and ``fillet_land`` of the fillet at the flank and at the root
    land. Where flanks have designs of their own, ``middle`` is where tooth and space are equally wide.

    A wheel whose fillet is an envelope of three parameters: ``teeth``, ``face_first``, ``face_last``.

    A thread (``tip_radius`` says that it is one): ``tip_radius``, ``root_radius`` at z = 0, ``rounding`` between flank
    and root, ``taper`` (growth of both radii along z) unless :func:`outline` says how they go on. ``span_root``,
    ``span_middle`` and ``span_tip`` are profile parameters below the root, in the middle and beyond the tip; without
    them the margins of the flank say it, or the outline. Where flanks have designs of their own: ``thickness`` along
    the axis at the middle, ``screw_parameter``.
    """
    return Function(
        f"{SOLID}{member}",
        f"sizes of the solid teeth of the {member}",
        (),
        tuple(Result(name, (sp.sympify(value),), unit) for name, (value, unit) in sizes.items()),
    )


#: How names of functions begin that say where a thread ends.
OUTLINE = "outline_"


def outline(member: str, point: Vector, tip: sp.Expr, root: sp.Expr) -> Function:
    """The function ``outline_<member>``: tip and root of a thread that are surfaces of revolution about its axis.

    ``tip`` and ``root`` are margins, positive on the thread, of the coordinates ``point`` of its body. The results are
    both at a distance from the axis and a position along it, and the slopes of the root's by these two.
    """
    radius = Quantity(f"radius_on_{member}", "mm", f"distance from the axis of the {member}", member)
    along = Quantity(f"position_on_{member}", "mm", f"position along the axis of the {member}", member)
    here = dict(zip(point, (radius, sp.Integer(0), along), strict=True))
    above, below = replaced(root, here), replaced(tip, here)
    return Function(
        f"{OUTLINE}{member}",
        f"how far a place is below the tip and above the root of the {member}",
        (radius, along),
        (
            Result("tip", (below,)), Result("root", (above,)),
            Result("root_slopes", (partial(above, radius), partial(above, along))),
        ),
    )  # fmt: skip


def both_turns(a: sp.Expr, b: sp.Expr, c: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """Both angles with a·cos + b·sin + c = 0; not a number where there is none (a² + b² < c²)."""
    middle, half = v.arc(b, a), v.arc(v.root(a**2 + b**2 - c**2), -c)
    return middle + half, middle - half
