"""An as-measured flank under load: its unloaded contact, and what its deviations take from the gap."""

from dataclasses import replace
from functools import cache

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.drive import Drive
from meshwright.fe.hexahedra import Floats
from meshwright.fe.pair import GearPair, Touch, tangencies_only
from meshwright.shop.as_measured import AsMeasured
from meshwright.shop.located import Rays, along
from meshwright.shop.tables import Points

# A point of the solid tooth lies on the flank this well, mm.
_ON_FLANK = 1e-3
# Where deviations leave no convex gap, Hertz's ellipse, from which the grid of cells is laid out, is this slender.
_SLENDER = 1e-5


def as_measured(gear: GearPair, drive: Drive, member: str, points: Points, tooth: int | None = None) -> GearPair:
    """The gear pair with the as-measured flank of a member: bicubic deviations along its normals, no extrapolation.

    Every tooth is taken to have the deviations of the one that is measured.
    """
    if drive.design.mirrored:
        raise UsageError("--measured: under load only of the hand in which the drive's equations are written")
    found = AsMeasured.of(drive, member, points, tooth)
    flank = found.field.flank
    nodes = found.field.nodes.reshape(-1, found.field.nodes.shape[2])
    places = flank(nodes).points

    def heights(body: Floats, direction: Floats) -> tuple[Floats, np.ndarray]:
        near = np.argmin(((body[:, None] - places[None]) ** 2).sum(axis=2), axis=1)
        start = nodes[near]
        q, distance = along(flank, start, Rays(body, flank(start).normals))
        at = flank(q)
        shift, place = found.field.at(at)
        value = np.einsum("px,px->p", shift, at.normals)
        with np.errstate(invalid="ignore"):
            known = (np.abs(distance) < _ON_FLANK) & found.field.inside(place)
        return np.where(known, value / (at.normals @ direction), 0.0), known

    @cache
    def touch(angle: float) -> Touch | None:
        contact = found.tca([angle])
        if contact.status[0] != "converged":
            return None
        (smaller, larger), major = found.curvatures(angle, contact.solutions[0])
        wheel_angle = drive.ratio * angle + float(contact.errors[0])
        smaller = max(float(smaller), _SLENDER * float(larger))
        return Touch(angle, wheel_angle, contact.points[0], contact.normals[0], smaller, float(larger), major)

    return replace(tangencies_only(gear), touch=touch, deviations={member: heights})
