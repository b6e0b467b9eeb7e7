"""The teeth in contact as data for the embedded 3-D view: flank grids, placements, contacts."""

import base64
import math

import numpy as np

from meshwright.report.patch import trimmed
from meshwright.report.style import MEMBERS
from meshwright.results import ARCSEC

#: Points on the drawn outline of a contact ellipse.
OUTLINE = 49


def scene(analysis):
    """Plain data of the 3-D view (lengths mm, fixed frame), or None if no position has a contact point."""
    tca = analysis.tca
    if not tca.solved.any():
        return None
    flip = np.diag([1.0, analysis.mirror, 1.0, 1.0])
    matrices = {name: flip @ m @ flip for name, m in analysis.matrices.items()}
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
        "view": _view(tca, matrices).tolist(),
        "bodies": [_body(analysis, name, matrices[name]) for name in matrices],
        "contacts": [_contact(tca, k) if tca.solved[k] else None for k in range(len(tca.angles))],
    }


def _numbers(values):
    return [float(v) if np.isfinite(v) else None for v in values]


def _packed(values):
    """Single-precision little-endian numbers as base64."""
    return base64.b64encode(np.ascontiguousarray(values, dtype="<f4").tobytes()).decode("ascii")


def _body(analysis, name, matrices):
    red, green, blue = (int(MEMBERS[name][k : k + 2], 16) for k in (1, 3, 5))
    flip = np.array([1.0, analysis.mirror, 1.0])
    drawn = trimmed(analysis.drive.flank(name), analysis.patches[name])
    return {
        "name": name,
        "colour": [red, green, blue],
        "copies": _copies(analysis, name),
        "matrices": _packed(matrices[:, :3, :]),
        "patches": [
            {
                "rows": drawn.inside.shape[0],
                "columns": drawn.inside.shape[1],
                "points": _packed(drawn.points * flip),
                "normals": _packed(drawn.normals * flip),
            }
        ],
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
    outline = tca.ellipse(k, OUTLINE)
    return {
        "point": np.round(tca.points[k], 6).tolist(),
        "outline": np.round(outline, 5).tolist() if np.isfinite(outline).all() else [],
        "flagged": ", ".join(tca.flags[k]).replace("_", " "),
    }


def _view(tca, matrices):
    """Rows right, up and towards the viewer: looking onto the flank past the wheel's axis, wheel below."""
    middle = np.flatnonzero(tca.solved)[tca.solved.sum() // 2]
    normal, point = tca.normals[middle], tca.points[middle]
    axes = {name: m[middle, :3, 2] for name, m in matrices.items()}
    places = {name: m[middle, :3, 3] for name, m in matrices.items()}
    outward = point - places["wheel"]
    outward -= axes["wheel"] * (outward @ axes["wheel"])
    outward /= np.linalg.norm(outward)
    side = np.cross(normal, outward)
    near = 0.62 * normal + 0.62 * side / np.linalg.norm(side) + 0.48 * outward
    near /= np.linalg.norm(near)
    up = outward - near * (outward @ near)
    up /= np.linalg.norm(up)
    return np.array([np.cross(up, near), up, near])
