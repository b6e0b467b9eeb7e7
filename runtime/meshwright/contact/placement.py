"""Where the members stand: their body frames and axes of rotation in the fixed frame, from the drive's own motions."""

from dataclasses import dataclass

import numpy as np

from meshwright.contact.functions import Function


@dataclass(frozen=True)
class Placements:
    """Body to fixed frame at N input angles: 4×4 matrices by member, (N, 4, 4), mm; NaN where nothing is solved.

    ``axes`` are unit directions and points, (N, 3) each, of the axis about which a growing angle of its own turns each
    member, misalignments included. Right-hand drive, whatever the design's hand, like the flanks.
    """

    angles: np.ndarray
    matrices: dict[str, np.ndarray]
    axes: dict[str, tuple[np.ndarray, np.ndarray]]


def about_z(angle):
    """The motion (4, 4) that turns by an angle about +z."""
    motion = np.eye(4)
    c, s = np.cos(angle), np.sin(angle)
    motion[:2, :2] = [[c, -s], [s, c]]
    return motion


def placements(drive, angles):
    """:class:`Placements` of both members in contact at ascending input angles (rad), line contact included."""
    angles = np.asarray(angles, dtype=float)
    unknowns, _ = drive.trace(angles)
    return placements_at(drive, angles, unknowns)


def placements_at(drive, angles, unknowns):
    """:class:`Placements` of both members at input angles (N,) with the wheel angle, whether in contact or not, of
    ``unknowns`` (N, nx).
    """
    errors = np.asarray(unknowns)[:, drive.design.description["error"]]
    return placed(drive, angles, drive.ratio * np.asarray(angles) + errors)


def placed(drive, pinion_angles, wheel_angles):
    """:class:`Placements` of both members turned to these angles (N,), rad."""
    pinion_angles, wheel_angles = np.broadcast_arrays(pinion_angles, wheel_angles)
    found = Function.of(drive, "placement")(pinion_angles, wheel_angles)
    lost = ~np.isfinite(pinion_angles + wheel_angles)
    matrices, axes = {}, {}
    for body in drive.design.description["bodies"]:
        name = body["name"]
        matrix = np.zeros((len(lost), 4, 4))
        matrix[:, :3], matrix[:, 3, 3] = found[f"placement_{name}"].reshape(-1, 3, 4), 1.0
        matrices[name] = np.where(lost[:, None, None], np.nan, matrix)
        axes[name] = found[f"axis_{name}"], found[f"axis_point_{name}"]
    return Placements(pinion_angles, matrices, axes)


def inverse(motions):
    """Inverse rigid motions (…, 4, 4)."""
    rotation = np.swapaxes(motions[..., :3, :3], -1, -2)
    result = np.zeros_like(motions)
    result[..., :3, :3] = rotation
    result[..., :3, 3] = -np.einsum("...ij,...j->...i", rotation, motions[..., :3, 3])
    result[..., 3, 3] = 1.0
    return result
