"""The tooth behind a flank: how far round its axis the far flank of the same tooth lies, at the same place of a blank.

A blank is a body of revolution, so that the far flank of a tooth bounds it at the radius and axial position of the near
one: the tooth is filled by circles about the axis, from one flank to the other.
"""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.flank.mesh import mesh
from meshwright.flank.region import region
from meshwright.flank.sections import solved

#: Cells of the mesh of the far flank from which each place is sought; Newton steps at most, the longest of them as part
#: of the distance from the axis, and what is left where a place is found, as such a part.
CELLS, STEPS, LONGEST, FOUND = (12, 24), 30, 0.2, 1e-9

#: So many places are compared with all seeds at once: their distances stay in the processor's cache.
TOGETHER = 256

#: Cells of a drawn flank's first mesh across and along the tooth, and at most.
FIRST, MOST = (12, 24), (32, 192)

#: Angle over which a tooth is drawn whose far flank the design does not determine, in pitches.
ASSUMED = 0.5

#: A tooth may be thinner than nothing by this part of the pitch, where its flanks have met below the tip.
POINTED = 0.05


@dataclass(frozen=True)
class Tooth:
    """The far flank for N places of the near one, body frame, right hand: ``across`` (N,) is the angle about z, rad,
    from near to far through the material, ``normals`` (N, 3) are out of it; NaN where there is none. ``parameters``
    (N, k) of the far flank, or None where the design does not determine it and a width is assumed.
    """

    across: np.ndarray
    normals: np.ndarray
    parameters: np.ndarray | None


def drawn_mesh(region, cell):
    """The mesh of a region with its border resolved, in cells of about ``cell`` mm: one that is fit to be drawn."""
    drawn = mesh(region, FIRST)
    if len(drawn.triangles):
        drawn = mesh(region, tuple(_finer(region, drawn, cell, axis) for axis in (0, 1)))
    return drawn


def _finer(region, drawn, cell, axis):
    """How many cells of about ``cell`` mm go along one coordinate of a region, by such edges of a first mesh."""
    corners = drawn.triangles
    here, there = corners.ravel(), np.roll(corners, 1, axis=1).ravel()
    across = np.abs(drawn.parameters[here] - drawn.parameters[there])[:, region.chart.free[1 - axis]]
    along = across < 1e-6 * np.ptp(region.box[:, 1 - axis])
    lengths = np.linalg.norm(drawn.points[here] - drawn.points[there], axis=1)[along]
    return int(np.clip(round(FIRST[axis] * np.quantile(lengths, 0.9) / cell), FIRST[axis], MOST[axis]))


def tooth(drive, member, near, teeth):
    """The :class:`Tooth` behind the mesh ``near`` (:class:`~meshwright.flank.mesh.Triangulation`) of a member's flank,
    of which a turn has so many ``teeth``.
    """
    pitch = 2 * math.pi / teeth
    x, y = near.points[:, 0], near.points[:, 1]
    inwards = -np.sign(np.median(x * near.normals[:, 1] - y * near.normals[:, 0])) if len(x) else 1.0  # an empty flank
    far = drive.other_side
    if far is None:
        across = np.full(len(x), inwards * ASSUMED * pitch)
        return Tooth(across, _turned(-near.normals, across), None)
    flank = far.flank(member)
    # as generated: a fillet that cuts the far flank off cuts the near one off at the same places
    parameters = _at_the_same_place(flank, mesh(region(far, member, "flank", far.uses), CELLS), near.points)
    found = flank(parameters)
    ahead = inwards * (np.arctan2(found.points[:, 1], found.points[:, 0]) - np.arctan2(y, x))
    across = inwards * ((ahead + POINTED * pitch) % pitch - POINTED * pitch)
    turn = np.arctan2(y, x) + across - np.arctan2(found.points[:, 1], found.points[:, 0])
    return Tooth(across, _turned(found.normals, turn), parameters)


def _at_the_same_place(flank, start, points):
    """Parameters (N, k) of a flank at the distance from the axis and the axial position of ``points`` (N, 3)."""
    wanted = np.stack([np.hypot(points[:, 0], points[:, 1]), points[:, 2]], axis=-1)
    seeds = np.stack([np.hypot(start.points[:, 0], start.points[:, 1]), start.points[:, 2]], axis=-1)
    if not len(seeds) or not len(points):
        return np.full((len(points), len(flank.parameters)), np.nan)
    q = start.parameters[_nearest(seeds, wanted)]
    limit, off, going = LONGEST * wanted[:, 0].max(), np.full(len(q), np.inf), np.arange(len(q))
    for _ in range(STEPS):
        found = flank(q[going])
        x, y, z = found.points.T
        radius = np.hypot(x, y)
        left = np.stack([radius, z], axis=-1) - wanted[going]
        slopes = np.stack([(x * found.tangents[..., 0].T + y * found.tangents[..., 1].T).T / radius[:, None],
                           found.tangents[..., 2]], axis=1)  # fmt: skip
        off[going] = np.abs(left).max(axis=1)
        shorter = (limit / np.maximum(off[going], limit))[:, None]
        residual = np.concatenate([left * shorter, found.conditions[:, :, 0]], axis=1)
        with np.errstate(invalid="ignore", divide="ignore"):
            q[going] -= solved(np.concatenate([slopes, found.conditions[:, :, 1:]], axis=1), residual)
        going = going[np.abs(residual).max(axis=1) > 1e-3 * FOUND * limit]
        if not going.size:
            break
    q[~(off < FOUND * limit)] = np.nan
    return q


def _nearest(seeds, wanted):
    """Number (N,) of the seed (M, 2) nearest to each wanted place (N, 2)."""
    squares, parts = (seeds**2).sum(axis=1), (wanted[k : k + TOGETHER] for k in range(0, len(wanted), TOGETHER))
    return np.concatenate([np.argmin(squares - 2.0 * part @ seeds.T, axis=1) for part in parts])


def _turned(vectors, angle):
    """Vectors (N, 3) turned about z by angles (N,)."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = vectors.T
    return np.stack([c * x - s * y, s * x + c * y, z], axis=-1)
