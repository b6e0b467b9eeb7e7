"""Contact of two placed surfaces: common point, common normal, and the meshing equations that stayed implicit."""

from dataclasses import replace

from derive.language import vectors as v
from derive.language.chain import Factor, Motion
from derive.language.surface import Surface


def contact(first: Surface, second: Surface) -> v.Vector:
    """Residual of tangent contact, zero where the surfaces touch.

    Three components of the position difference; the normal of ``second`` against the two tangents of ``first``;
    the remaining conditions of either surface. Unit: mm for positions, the rest scaled with the surfaces' own
    normals. Positions are compared in the frame that carries ``second``: its mounting is undone on both sides, so
    that no constant rotation has to be applied to the many derivatives of a generated surface.
    """
    first, second = common_frame(first, second)
    normal = second.body_normal
    position = v.sub(first.body_point, second.body_point)
    tangency = tuple(v.dot(normal, tangent) for tangent in first.body_tangents)
    return (*position, *tangency, *first.conditions, *second.conditions)


def common_frame(first: Surface, second: Surface) -> tuple[Surface, Surface]:
    """Both surfaces in the frame that carries ``second``."""
    mounting, second = _unmounted(second)
    return first.placed(mounting.inverse()), second


def _unmounted(surface: Surface) -> tuple[Motion, Surface]:
    """The leading factors of the surface's motion in which none of its parameters occurs, and the surface without."""
    factors = surface.motion.factors
    count = 0
    while count < len(factors) and not _moves(surface, factors[count]):
        count += 1
    return Motion(factors[:count]), replace(surface, motion=Motion(factors[count:]))


def _moves(surface: Surface, factor: Factor) -> bool:
    return any(surface.definitions.depends(e, p) for e in factor.expressions() for p in surface.parameters)
