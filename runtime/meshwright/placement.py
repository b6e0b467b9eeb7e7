"""Where the members stand: body frames in the fixed frame, read off a solved contact.

A flank's point, normal and first tangent are known in its body frame (from the flank itself) and in the fixed frame
(from the observation of the contact); the rigid motion between the two is the placement. No drive's motion is
written down a second time.
"""

from dataclasses import dataclass

import numpy as np

from meshwright._library import ffi


@dataclass(frozen=True)
class Placements:
    """Body to fixed frame at N input angles: 4×4 matrices by member, (N, 4, 4), mm; NaN where nothing is solved.

    Right-hand drive, whatever the design's hand, like the flanks.
    """

    angles: np.ndarray
    matrices: dict[str, np.ndarray]


def placements(drive, angles):
    """:class:`Placements` of both members at ascending input angles (rad); line contact is placed as well."""
    angles = np.asarray(angles, dtype=float)
    unknowns, _ = drive.trace(angles)
    matrices = {}
    for number, body in enumerate(drive.design.description["bodies"]):
        at_contact = drive.flank(body["name"])(unknowns[:, body["unknowns"]])
        in_body = _frames(at_contact.points, at_contact.normals, at_contact.tangents[:, 0])
        in_fixed = _frames(*_observed(drive, angles, unknowns, number, body))
        matrices[body["name"]] = in_fixed @ _inverse(in_body)
    return Placements(angles, matrices)


def _observed(drive, angles, unknowns, number, body):
    """Point, outward normal and first tangent of one member in the fixed frame, each (N, 3)."""
    observed = np.full((len(angles), drive.model.no), np.nan)
    for k, (angle, x) in enumerate(zip(angles, unknowns, strict=True)):
        if np.all(np.isfinite(x)):
            state, solution = drive.state(angle), np.ascontiguousarray(x)
            drive.model.observe(*(ffi.from_buffer("double[]", a) for a in (state, solution, observed[k])))
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


def _inverse(frames):
    """Inverse rigid motions."""
    rotation = np.swapaxes(frames[:, :3, :3], 1, 2)
    inverse = np.zeros_like(frames)
    inverse[:, :3, :3] = rotation
    inverse[:, :3, 3] = -np.einsum("nij,nj->ni", rotation, frames[:, :3, 3])
    inverse[:, 3, 3] = 1.0
    return inverse
