"""The teeth in contact as data for the embedded 3-D view: meshed flanks, placements, contacts."""

import base64
import math
from dataclasses import dataclass

import numpy as np

from meshwright.contact.results import ARCSEC
from meshwright.flank.tooth import drawn_mesh, tooth
from meshwright.report.style import MEMBERS

#: How much lighter surfaces are than lines of the same member, 0 … 1.
LIGHTER = 0.22

#: Cells of a drawn flank that go to the radius of the view.
CELLS_PER_RADIUS = 24.0


@dataclass(frozen=True)
class _Touch:
    """Where the flanks touch at N positions: a ``points`` (N, 3) and its ``normals`` (N, 3), NaN where they do not, and
    ``lines``: (M, 3) each or None; fixed frame, mm, with the design's hand. ``reach`` is the size of a mark, mm.
    """

    points: np.ndarray
    normals: np.ndarray
    lines: tuple
    reach: float

    @property
    def known(self):
        return np.isfinite(self.points).all(axis=1)

    @property
    def middle(self):
        known = np.flatnonzero(self.known)
        return known[known.size // 2]


def scene(analysis):
    """Plain data of the 3-D view (lengths mm, fixed frame), or None if the flanks touch nowhere."""
    tca = analysis.tca
    if not analysis.patches:
        return None
    touch = _along_lines(analysis) if analysis.lines else _at_points(tca, analysis.patches["pinion"])
    mirror = analysis.drive.design.mirror
    matrices = {name: mirror.placements(m) for name, m in analysis.matrices.items()}
    inward = _inward(touch, matrices["pinion"])
    points = touch.points[touch.known]
    centre = points.mean(axis=0)
    radius = float(np.linalg.norm(points - centre, axis=1).max() + touch.reach)
    cell = radius / CELLS_PER_RADIUS
    return {
        "angles_deg": np.degrees(tca.angles).tolist(),
        "wheel_deg": _numbers(np.degrees(tca.wheel_angles)),
        "error_arcsec": _numbers(tca.error / ARCSEC),
        "relative_error_arcsec": _numbers(tca.relative_error / ARCSEC),
        "steps_per_pitch": analysis.steps_per_pitch,
        "breaks": analysis.breaks.tolist(),
        "centre": centre.tolist(),
        "radius": radius,
        "view": _view(touch, inward).tolist(),
        "cut": _cut(points, inward),
        "bodies": [_body(analysis, name, matrices[name], cell) for name in matrices],
        "contacts": [_contact(tca, touch, k) if known else None for k, known in enumerate(touch.known)],
    }


def _at_points(tca, patch):
    """Points inside the flanks with their ellipses or, where all lie on edges, what is shown of the flank."""
    known = np.isfinite(tca.points).all(axis=1)[:, None]
    points, normals = (np.where(known, values, np.nan) for values in (tca.points, tca.normals))
    reach = np.nanmax(tca.semi_axes[:, 0], initial=0.0)
    if not tca.solved.any():
        shown = patch.points[np.isfinite(patch.points).all(axis=2)]
        reach = 0.5 * np.linalg.norm(np.ptp(shown, axis=0))
    return _Touch(points, normals, (None,) * len(points), float(reach))


def _along_lines(analysis):
    """Each line with its middle point and the normal there, or the point at positions without a line."""
    flip = analysis.drive.design.mirror.flip
    points, normals = analysis.tca.points.copy(), analysis.tca.normals.copy()
    flank = analysis.drive.flank("pinion")
    for k, line in enumerate(analysis.lines):
        if len(line.points):
            middle = len(line.points) // 2
            points[k] = flip * line.points[middle]
            normal = flank(line.parameters["pinion"][middle]).normals[0]
            normals[k] = flip * (analysis.matrices["pinion"][k, :3, :3] @ normal)
    lines = tuple(line.points * flip if len(line.points) else None for line in analysis.lines)
    lengths = [np.linalg.norm(np.ptp(line, axis=0)) for line in lines if line is not None]
    return _Touch(points, normals, lines, 0.5 * max(lengths, default=0.0))


def _numbers(values):
    return [float(v) if np.isfinite(v) else None for v in values]


def _packed(values, kind="<f4"):
    """Little-endian numbers, of single precision if not told otherwise, as base64."""
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode("ascii")


def _body(analysis, name, matrices, cell):
    colour = [int(MEMBERS[name][k : k + 2], 16) for k in (1, 3, 5)]
    return {
        "name": name,
        "colour": [round(c + LIGHTER * (255 - c)) for c in colour],
        "copies": _copies(analysis, name),
        "matrices": _packed(matrices[:, :3, :]),
        "tooth": tooth_data(analysis.drive, name, analysis.teeth[name], cell),
    }


def tooth_data(drive, member, teeth, cell):
    """A tooth, of which a turn has so many: the flank in contact with its border resolved, in cells of about ``cell``
    mm (points, normals, corners of triangles), and by point the angle about the axis to the far flank, with its normal.
    """
    flip, drawn = drive.design.mirror.flip, drawn_mesh(drive.region(member), cell)
    behind = tooth(drive, member, drawn, teeth)
    return {
        "points": _packed(drawn.points * flip),
        "normals": _packed(drawn.normals * flip),
        "triangles": _packed(drawn.triangles, "<u4"),
        "across": _packed(behind.across * drive.design.mirror.sign),
        "far": _packed(behind.normals * flip),
    }


def _copies(analysis, name):
    """Turns of the drawn flank about its body's axis, rad: every pinion tooth, and the wheel teeth near the contact."""
    teeth = analysis.teeth[name]
    if name == "pinion":
        return [2 * math.pi * k / teeth for k in range(teeth)]
    pairs = math.ceil(len(analysis.tca.angles) / analysis.steps_per_pitch)
    near = min(pairs, (teeth - 1) // 2)
    return [2 * math.pi * k / teeth for k in range(-near, near + 1)]


def _contact(tca, touch, k):
    """Contact point, semi-axes of the ellipse as vectors (none where there is no ellipse), line, flags in words."""
    major, minor = tca.semi_axes[k]
    axes = np.array([major * tca.major[k], minor * np.cross(tca.normals[k], tca.major[k])])
    return {
        "point": np.round(touch.points[k], 6).tolist(),
        "line": None if touch.lines[k] is None else np.round(touch.lines[k], 5).tolist(),
        "axes": np.round(axes, 6).tolist() if np.isfinite(axes).all() else None,
        "flagged": ", ".join(tca.flags[k]).replace("_", " "),
    }


def _inward(touch, pinion):
    """Unit direction from the middle of the contact straight to the pinion's axis; ``pinion`` (N, 4, 4)."""
    axis, arm = pinion[touch.middle, :3, 2], pinion[touch.middle, :3, 3] - touch.points[touch.middle]
    arm = arm - axis * (arm @ axis)
    return arm / np.linalg.norm(arm)


def _cut(points, inward):
    """The plane, normal·p = offset, beyond which the pinion may be cut away: a little past the contacts."""
    spread = np.linalg.norm(np.ptp(points, axis=0))
    return {"normal": inward.tolist(), "offset": float((points @ inward).max() + 0.08 * spread)}


def _view(touch, inward):
    """Rows right, up and towards the viewer: onto the pinion's flank, from the pinion's side, tilted."""
    normal = touch.normals[touch.middle]
    side = np.cross(normal, inward)
    near = 0.5 * normal + 0.35 * side / np.linalg.norm(side) + 0.8 * inward
    near /= np.linalg.norm(near)
    up = inward - near * (inward @ near)
    up /= np.linalg.norm(up)
    return np.array([np.cross(up, near), up, near])
