"""What the live page needs to draw teeth as solids: places on both flanks of a tooth of either member."""

import base64
import math

import numpy as np

from meshwright.flank.mesh import mesh
from meshwright.flank.tooth import drawn_mesh, tooth

#: Cells of a flank go round its axis by this angle, rad; places of a flank at most (``MOST_PLACES`` of ``live.c``);
#: teeth of the wheel on either side of the one in contact, and teeth of the pinion beyond which only as many are drawn.
TURN, MOST_PLACES, NEAR, MOST_COPIES = 0.12, 4096, 3, 24

#: Cells of a mesh that only measures.
COARSE = (4, 4)


def teeth(drive):
    """Plain data of both members, or None if the flanks of one are empty or too fine to draw.

    Of each: ``places`` of the flank in contact and ``far`` ones of the other flank (parameters, or None where a width
    is assumed), ``triangles``, the angle ``across`` from one to the other about the axis, rad, and the turns of
    ``copies``. Right hand.
    """
    bodies = []
    for member in ("pinion", "wheel"):
        count = drive.teeth(member)
        region = drive.region(member)
        if region.empty:
            return None
        radius = np.hypot(*region.flank(mesh(region, COARSE).parameters).points[:, :2].T)
        near = drawn_mesh(region, TURN * float(np.median(radius)))
        if not 0 < len(near.points) <= MOST_PLACES:
            return None
        behind = tooth(drive, member, near, count)
        bodies.append({
            "name": member,
            "places": _packed(near.parameters, "<f8"),
            "far": None if behind.parameters is None else _packed(behind.parameters, "<f8"),
            "triangles": _packed(near.triangles, "<u4"),
            "across": _packed(behind.across, "<f8"),
            "copies": _copies(member, int(count)),
        })  # fmt: skip
    return {"bodies": bodies, "side": _side(drive)}


def _side(drive):
    """The parameter that says which flank is meant, by number."""
    return next(k for k, p in enumerate(drive.design.description["parameters"]) if p["table"] == "flank")


def _copies(member, count):
    if member == "pinion" and count <= MOST_COPIES:
        return [2 * math.pi * k / count for k in range(count)]
    near = min(NEAR, (count - 1) // 2)
    return [2 * math.pi * k / count for k in range(-near, near + 1)]


def _packed(values, kind):
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode("ascii")
