"""The teeth in contact as data for the embedded 3-D view: flank grids, placements, contacts."""

import base64
import math

import numpy as np

from meshwright.report.patch import Patch, trimmed
from meshwright.report.style import MEMBERS
from meshwright.results import ARCSEC

#: How much lighter surfaces are than lines of the same member, 0 … 1.
LIGHTER = 0.22


def scene(analysis):
    """Plain data of the 3-D view (lengths mm, fixed frame), or None if no position has a contact point."""
    tca = analysis.tca
    if not tca.solved.any():
        return None
    flip = np.diag([1.0, analysis.mirror, 1.0, 1.0])
    matrices = {name: flip @ m @ flip for name, m in analysis.matrices.items()}
    inward = _inward(tca, matrices["pinion"])
    points = tca.points[tca.solved]
    centre = points.mean(axis=0)
    reach = np.nanmax(np.where(np.isfinite(tca.semi_axes[:, 0]), tca.semi_axes[:, 0], 0.0))
    radius = float(np.linalg.norm(points - centre, axis=1).max() + reach)
    return {
        "angles_deg": np.degrees(tca.angles).tolist(),
        "wheel_deg": _numbers(np.degrees(tca.wheel_angles)),
        "error_arcsec": _numbers(tca.error / ARCSEC),
        "steps_per_pitch": analysis.steps_per_pitch,
        "centre": centre.tolist(),
        "radius": radius,
        "view": _view(tca, inward).tolist(),
        "cut": _cut(tca, inward),
        "bodies": [_body(analysis, name, matrices[name]) for name in matrices],
        "contacts": [_contact(tca, k) if tca.solved[k] else None for k in range(len(tca.angles))],
    }


def _numbers(values):
    return [float(v) if np.isfinite(v) else None for v in values]


def _packed(values):
    """Single-precision little-endian numbers as base64."""
    return base64.b64encode(np.ascontiguousarray(values, dtype="<f4").tobytes()).decode("ascii")


def _body(analysis, name, matrices):
    colour = [int(MEMBERS[name][k : k + 2], 16) for k in (1, 3, 5)]
    flip = np.array([1.0, analysis.mirror, 1.0])
    return {
        "name": name,
        "colour": [round(c + LIGHTER * (255 - c)) for c in colour],
        "copies": _copies(analysis, name),
        "matrices": _packed(matrices[:, :3, :]),
        "patches": [_drawn(*side, flip) for side in _sides(analysis, name)],
    }


def _sides(analysis, name):
    """The flank in contact and, if it belongs to the same design, the other side of the tooth: flank, patch, active."""
    drive, patch = analysis.drive, analysis.patches[name]
    flank = drive.flank(name)
    sides = [(flank, patch, True)]
    if not drive.design.description["flanks_apart"]:
        words = next(p["choices"] for p in drive.design.description["parameters"] if p["table"] == "flank")
        other = drive.with_(flank=next(w for w in words if w != drive.design.tables["flank"])).flank(name)
        sides.append((other, Patch.of(other, patch.parameters), False))
    return sides


def _drawn(flank, patch, active, flip):
    """A flank inside its limits, single precision."""
    drawn = trimmed(flank, patch)
    return {
        "rows": drawn.inside.shape[0],
        "columns": drawn.inside.shape[1],
        "active": active,
        "points": _packed(drawn.points * flip),
        "normals": _packed(drawn.normals * flip),
    }


def _copies(analysis, name):
    """Turns of the drawn flank about its body's axis, rad: every pinion tooth, and the wheel teeth near the contact."""
    teeth = analysis.teeth[name]
    if name == "pinion":
        return [2 * math.pi * k / teeth for k in range(teeth)]
    pairs = math.ceil(len(analysis.tca.angles) / analysis.steps_per_pitch)
    near = min(pairs, (teeth - 1) // 2)
    return [2 * math.pi * k / teeth for k in range(-near, near + 1)]


def _contact(tca, k):
    """Contact point, semi-axes of the ellipse as vectors (none where there is no ellipse), flags in words."""
    major, minor = tca.semi_axes[k]
    axes = np.array([major * tca.major[k], minor * np.cross(tca.normals[k], tca.major[k])])
    return {
        "point": np.round(tca.points[k], 6).tolist(),
        "axes": np.round(axes, 6).tolist() if np.isfinite(axes).all() else None,
        "flagged": ", ".join(tca.flags[k]).replace("_", " "),
    }


def _inward(tca, pinion):
    """Unit direction from the middle of the contact straight to the pinion's axis; ``pinion`` (N, 4, 4)."""
    middle = _middle(tca)
    axis, arm = pinion[middle, :3, 2], pinion[middle, :3, 3] - tca.points[middle]
    arm = arm - axis * (arm @ axis)
    return arm / np.linalg.norm(arm)


def _middle(tca):
    solved = np.flatnonzero(tca.solved)
    return solved[solved.size // 2]


def _cut(tca, inward):
    """The plane, normal·p = offset, beyond which the pinion may be cut away: a little past the contacts."""
    along = tca.points[tca.solved] @ inward
    spread = np.linalg.norm(np.ptp(tca.points[tca.solved], axis=0))
    return {"normal": inward.tolist(), "offset": float(along.max() + 0.08 * spread)}


def _view(tca, inward):
    """Rows right, up and towards the viewer: onto the pinion's flank, from the pinion's side, tilted."""
    normal = tca.normals[_middle(tca)]
    side = np.cross(normal, inward)
    near = 0.5 * normal + 0.35 * side / np.linalg.norm(side) + 0.8 * inward
    near /= np.linalg.norm(near)
    up = inward - near * (inward @ near)
    up /= np.linalg.norm(up)
    return np.array([np.cross(up, near), up, near])
