"""Contact of two placed surfaces: common point, common normal, and the meshing equations that stayed implicit."""

from derive import vectors as v


def contact(first, second):
    """Residual of tangent contact, zero where the surfaces touch.

    Three components of the position difference in the fixed frame; the normal of ``second`` against the two
    tangents of ``first``; the remaining conditions of either surface. Unit: mm for positions, the rest scaled
    with the surfaces' own normals.
    """
    normal = second.body_normal()
    position = v.sub(first.body_point(), second.body_point())
    tangency = tuple(v.dot(normal, tangent) for tangent in first.body_tangents())
    return (*position, *tangency, *first.conditions, *second.conditions)
