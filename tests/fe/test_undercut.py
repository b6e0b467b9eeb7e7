"""An undercut tooth: its fillet cuts its flank off, and what is exported of the flank ends there."""

import json

import numpy as np

from meshwright import Drive
from meshwright.cli import main

NAME, MEMBER = "spherical-table-2-3", "pinion"


def _too_thick(flank, fillet, normals):
    """How far flank points (N, 3) of a section stand out of the tooth that the fillet (P, 3) leaves at most, rad."""
    radius, azimuth = np.hypot(fillet[:, 0], fillet[:, 1]), np.arctan2(fillet[:, 1], fillet[:, 0])
    upper = np.argmin(radius)  # from its lowest point to its end at the flank
    radius, azimuth = (v[upper:] if upper < len(v) / 2 else v[upper::-1] for v in (radius, azimuth))
    at = np.hypot(flank[:, 0], flank[:, 1])
    outward = np.sign(flank[:, 0] * normals[:, 1] - flank[:, 1] * normals[:, 0])
    within = (at > radius[0]) & (at < radius[-1])
    off = outward * (np.arctan2(flank[:, 1], flank[:, 0]) - np.interp(at, radius, azimuth))
    return float(off[within].max(initial=-np.inf))


def test_an_undercut_flank_is_exported_up_to_where_its_fillet_cuts_it(tmp_path):
    path = tmp_path / "flank.json"
    assert main(["surface", NAME, "--member", MEMBER, "--grid", "41x3", "--json", str(path)]) == 0
    shown = json.loads(path.read_text(encoding="utf-8"))
    points, normals = (np.array(shown[key], dtype=float).reshape(41, 3, 3)[:, 1] for key in ("points_mm", "normals"))
    drive = Drive.load(NAME)
    fillet = drive.surface(MEMBER, (401, 3), "fillet").points.reshape(401, 3, 3)[:, 1]
    assert _too_thick(points, fillet, normals) < 1e-6
    lowest = [int(np.argmin(np.hypot(points[:, 0], points[:, 1])))]
    assert abs(_too_thick(points[lowest], fillet, normals[lowest])) < 3e-5  # it ends on the fillet
    whole = drive.surface(MEMBER, (41, 3))
    rows = whole.points.reshape(41, 3, 3)[:, 1], whole.normals.reshape(41, 3, 3)[:, 1]
    assert _too_thick(rows[0], fillet, rows[1]) > 1e-5  # the surface itself goes on below
