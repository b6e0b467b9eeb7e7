"""Where measured points lie on the flanks of a design: parameters of the flank, and distances along given normals."""

from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.contact.placement import about_z
from meshwright.flank.inside import NEWTON_STEPS
from meshwright.flank.mesh import mesh
from meshwright.flank.sections import solved
from meshwright.shop.nominal import flank_words, of_flank

#: Nominal points of a file lie on the flanks of its design this well, mm.
ON_FLANK = 1e-3

#: Points that a file gives to 1e-6 mm are on their flank this well, mm.
ROUNDED = 1e-6

#: Cells across and along a flank, whose nodes start the search.
CELLS = (24, 48)


@dataclass(frozen=True)
class Rays:
    """Points (N, 3) and directions (N, 3) that belong to one flank of the first tooth, right-hand drive."""

    points: np.ndarray
    directions: np.ndarray


def rays(drive, member, points, tooth):
    """:class:`Rays` of points and normals (N, 3) of teeth ``tooth`` (N,), turned back to the first, unmirrored."""
    places, directions = points
    turns = np.stack([about_z(-2.0 * np.pi * (k - 1) / drive.teeth(member))[:3, :3] for k in tooth])
    flip = drive.design.mirror.flip
    return Rays(*(flip * np.einsum("nij,nj->ni", turns, vectors) for vectors in (places, directions)))


def along(flank, start, found):
    """Parameters (N, k) and distances (N,) at which :class:`Rays` meet a flank, from parameters nearby.

    NaN where they do not meet it.
    """
    q, distance = start.copy(), np.zeros(len(start))
    k = q.shape[1]
    for _ in range(NEWTON_STEPS):
        at = flank(q)
        gap = at.points - found.points - distance[:, None] * found.directions
        residual = np.concatenate([gap, at.conditions[:, :, 0]], axis=1)
        matrix = np.zeros((len(q), residual.shape[1], k + 1))
        matrix[:, :3, :k], matrix[:, :3, k] = np.swapaxes(at.tangents, 1, 2), -found.directions
        matrix[:, 3:, :k] = at.conditions[:, :, 1:]
        step = solved(matrix, residual)
        moved = np.linalg.norm(np.einsum("nki,nk->ni", at.tangents, step[:, :k]), axis=1) + np.abs(step[:, k])
        q, distance = q - step[:, :k], distance - step[:, k]
        if not (moved > 1e-11).any():
            break
    lost = ~(moved < 1e-9)
    q[lost], distance[lost] = np.nan, np.nan
    return q, distance


@dataclass(frozen=True)
class Flanks:
    """Measured points sorted by flank: for each word the drive, the rows (n,) of the points, their rays and parameters
    (n, k). ``off`` is how far a nominal point is from its flank at the most, mm.
    """

    words: tuple[str, ...]
    drives: tuple
    rows: tuple[np.ndarray, ...]
    rays: tuple[Rays, ...]
    parameters: tuple[np.ndarray, ...]
    off: float


def located(drive, member, points):
    """The :class:`Flanks` of :class:`~meshwright.shop.tables.Points`.

    Raises :class:`~meshwright.base.errors.UsageError` naming the first point that is not on its flank or is given
    twice, and for points that their file says to be another member's.
    """
    if (named := points.remarks.get("member", member)) != member:
        raise UsageError(f"--member {member}: the file says that its points are of the {named}; name that member")
    _refuse_repeated(points)
    words = tuple(dict.fromkeys(points.flank))
    drives, rows, sorted_rays, parameters, off = [], [], [], [], 0.0
    count = drive.teeth(member)
    for wrong in np.flatnonzero((points.tooth < 1) | (points.tooth > count)):
        raise UsageError(f"tooth = {points.tooth[wrong]}: the {member} has teeth 1 to {count}; correct the file")
    for word in words:
        side = of_flank(drive, word)
        own = np.flatnonzero([w == word for w in points.flank])
        ray = rays(drive, member, (points.points[own], points.normals[own]), points.tooth[own])
        whole = side.region(member)
        nodes = mesh(whole, CELLS)
        near = np.array([np.argmin(((nodes.points - p) ** 2).sum(axis=1)) for p in ray.points])
        q, distance = along(whole.flank, nodes.parameters[near], ray)
        facing = np.einsum("ni,ni->n", whole.flank(q).normals, ray.directions)
        for k in np.flatnonzero(~(np.abs(distance) < ON_FLANK) | ~(facing > 1.0 - 1e-6)):
            _refuse(points, own[k], distance[k], member)
        off = max(off, float(np.abs(distance).max()))
        drives.append(side)
        rows.append(own)
        sorted_rays.append(ray)
        parameters.append(q)
    return Flanks(words, tuple(drives), tuple(rows), tuple(sorted_rays), tuple(parameters), off)


def _refuse_repeated(points):
    """A place that is given twice would count twice, as if it were measured twice."""
    flanks = np.unique(points.flank, return_inverse=True)[1]
    for columns in ((points.i, points.j), points.points.T):
        places = np.stack([points.tooth, flanks, *columns], axis=1)
        _, first, which = np.unique(places, axis=0, return_index=True, return_inverse=True)
        for k in np.flatnonzero(first[which.ravel()] != np.arange(len(places))):
            again = _place(points, first[which.ravel()[k]])
            raise UsageError(f"{_place(points, k)}: the same place as {again}; keep one of them, or their mean")


def other_design(drive, points, off=0.0):
    """A sentence about points whose file was not written for this design as it is, empty if it was.

    ``off``: how far they are from the design's flanks at the most, mm.
    """
    said, label = points.remarks.get("design", ""), drive.design.label
    words = (drive.design.tables["flank"],) if drive.design.description["flanks_apart"] else flank_words(drive)
    known = {_digest(of_flank(drive, word).design.label) for word in words}
    if off <= ROUNDED and (not said or _digest(said) in known):
        return ""
    file = f"says that its points are of {said}" if said else "does not say of which design its points are"
    away = f", from which they are up to {1e3 * off:.2g} µm off" if off > ROUNDED else ""
    return f"the file {file}; here they count from the flanks of {label}{away}: name the design of the part as made"


def _digest(label):
    """What distinguishes designs in a label of :attr:`~meshwright.design.design.Design.label`: its last word."""
    return label.rpartition(" ")[2]


def _place(points, k):
    return f"tooth {points.tooth[k]}, {points.flank[k]} flank, i = {points.i[k]}, j = {points.j[k]}"


def _refuse(points, k, distance, member):
    place = _place(points, k)
    off = f"{abs(distance):.3g} mm off" if np.isfinite(distance) and abs(distance) >= ON_FLANK else "not on"
    raise UsageError(
        f"{place}: the nominal point is {off} the flank of the {member} of this design, or its normal is not; measure "
        "and identify with the same design, of which `meshwright grid` writes the points"
    )
