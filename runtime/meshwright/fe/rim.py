"""The rim below the root of a tooth, down to a bore about the axis."""

from collections.abc import Callable

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.fe.hexahedra import Floats

# Depth of the rim below the root in modules: twice a standard whole depth acts as a solid body.
RIM_MODULES = 4.5
# The rim reaches at most so many root radii below the root.
DEEPEST_RIM = 0.8


def check_rim(rim_thickness: float, root_radii: dict[str, float]) -> None:
    """Refuse a rim in mm deeper than members with these root radii in mm allow."""
    for member, root in root_radii.items():
        if rim_thickness > DEEPEST_RIM * root:
            raise UsageError(
                f"--rim-mm {rim_thickness:g}: no bore is left in the {member}, whose root radius is {root:.4g} mm; "
                f"give at most {DEEPEST_RIM * root:.4g}"
            )


def bore_radius(root: float, rim_thickness: float) -> float:
    """Radius in mm of a bore so far below the root, not deeper than the rim may reach."""
    return root - min(rim_thickness, DEEPEST_RIM * root)


def bored(radius: float) -> Callable[[Floats], Floats]:
    """Moves points radially to a bore of the given radius about z."""

    def bore(points: Floats) -> Floats:
        scale = radius / np.hypot(points[..., 0], points[..., 1])
        return points * np.stack([scale, scale, np.ones_like(scale)], axis=-1)

    return bore
