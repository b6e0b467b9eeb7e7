"""What contact uses of the flanks: where regions are looked for, and how far they go if nothing ends them."""

from functools import cache

import numpy as np

from meshwright.cycle.pairs import Mesh
from meshwright.cycle.searched_flank import start_values
from meshwright.flank.uses import Uses
from meshwright.pattern.pattern import contours

#: Angles of the window at which contact patches are looked at, and directions of each.
PATCHES, DIRECTIONS = 5, 8


def uses(drive):
    """The :class:`~meshwright.flank.uses.Uses` of a drive over the window of a pair, contact patches included."""
    mesh = Mesh.of(drive)
    patches = cache(lambda: _patches(mesh))
    return Uses.of(drive, _solutions(mesh), lambda member: patches()[member])


def _solutions(mesh):
    """Solutions that contact visits (P, nx), right hand: the window of a pair, or what there is about its middle."""
    window, pitch = mesh.window, mesh.drive.pitch()
    if window.path is None:
        return _about_the_middle(mesh.drive)
    middle = mesh.drive.design.reference_angle
    low, high = window.bounds if window.complete else (middle - pitch, middle + pitch)
    return window.path.unknowns[(window.path.angles >= low) & (window.path.angles <= high)]


def _about_the_middle(drive):
    """Contacts about the middle, or the places from which they are sought where there is none."""
    angles = drive.about_the_middle([-0.25, 0.0, 0.25])
    unknowns, _ = drive.trace(angles)
    solved = np.isfinite(unknowns).all(axis=1)
    return unknowns[solved] if solved.any() else start_values(drive, drive.design.mirror.sign * angles)


def _patches(mesh):
    """Points (P, 3) of each member's flank on the edges of contact patches over the window, right hand; none without a
    window.
    """
    window, names = mesh.window, [b["name"] for b in mesh.drive.design.description["bodies"]]
    if window.path is None or not window.complete:
        return dict.fromkeys(names, np.empty((0, 3)))
    angles = np.linspace(window.begin.angle, window.end.angle, PATCHES)
    found = contours(mesh.drive, mesh.drive.tca(angles), DIRECTIONS)
    known = [patch for patch in found if patch is not None]
    points = {name: [np.empty((0, 3)), *(patch.body_points[name] for patch in known)] for name in names}
    return {name: np.concatenate(parts) * mesh.drive.design.mirror.flip for name, parts in points.items()}
