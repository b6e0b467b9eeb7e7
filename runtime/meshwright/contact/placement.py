"""Where the members stand: body frames in the fixed frame, read off any point of their flanks.

A flank's point, normal and first tangent are known in its body frame (from the flank itself) and in the fixed frame
(from the observation); the rigid motion between the two is the placement. No drive's motion is written down a
second time.
"""

from dataclasses import dataclass

import numpy as np

from meshwright.base.library import pointer


@dataclass(frozen=True)
class Placements:
    """Body to fixed frame at N input angles: 4×4 matrices by member, (N, 4, 4), mm; NaN where nothing is solved.

    Right-hand drive, whatever the design's hand, like the flanks.
    """

    angles: np.ndarray
    matrices: dict[str, np.ndarray]


def placements(drive, angles):
    """:class:`Placements` of both members in contact at ascending input angles (rad), line contact included."""
    angles = np.asarray(angles, dtype=float)
    unknowns, _ = drive.trace(angles)
    return placements_at(drive, angles, unknowns)


def placements_at(drive, angles, unknowns):
    """:class:`Placements` of both members at input angles (N,) with the wheel angle, whether in contact or not, of
    ``unknowns`` (N, nx).
    """
    matrices = {}
    for number, body in enumerate(drive.design.description["bodies"]):
        at_contact = drive.flank(body["name"])(unknowns[:, body["unknowns"]])
        in_body = _frames(at_contact.points, at_contact.normals, at_contact.tangents[:, 0])
        in_fixed = _frames(*_observed(drive, angles, unknowns, number, body))
        matrices[body["name"]] = in_fixed @ inverse(in_body)
    return Placements(np.asarray(angles), matrices)


def _observed(drive, angles, unknowns, number, body):
    """Point, outward normal and first tangent of one member in the fixed frame, each (N, 3)."""
    observed = np.full((len(angles), drive.model.no), np.nan)
    for k, (angle, x) in enumerate(zip(angles, unknowns, strict=True)):
        if np.all(np.isfinite(x)):
            state, solution = drive.state(angle), np.ascontiguousarray(x)
            drive.model.observe(*(pointer(a) for a in (state, solution, observed[k])))
    place, tangent = 6 * number, body["at"]
    return observed[:, place : place + 3], observed[:, place + 3 : place + 6], observed[:, tangent : tangent + 3]


def _frames(points, normals, tangents):
    """Right-handed orthonormal frames (N, 4, 4) with origin at the points and first axis along the normals."""
    along = tangents - normals * np.sum(tangents * normals, axis=1, keepdims=True)
    along = along / np.linalg.norm(along, axis=1, keepdims=True)
    frames = np.zeros((len(points), 4, 4))
    frames[:, :3, 0], frames[:, :3, 1], frames[:, :3, 2] = normals, along, np.cross(normals, along)
    frames[:, :3, 3], frames[:, 3, 3] = points, 1.0
    return frames


def inverse(motions):
    """Inverse rigid motions (…, 4, 4)."""
    rotation = np.swapaxes(motions[..., :3, :3], -1, -2)
    result = np.zeros_like(motions)
    result[..., :3, :3] = rotation
    result[..., :3, 3] = -np.einsum("...ij,...j->...i", rotation, motions[..., :3, 3])
    result[..., 3, 3] = 1.0
    return result
