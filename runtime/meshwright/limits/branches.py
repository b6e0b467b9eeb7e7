"""Where the branch of contact turns back or another crosses it."""

import numpy as np

from meshwright.base.library import ffi, library, pointer
from meshwright.contact.branch import STEP, crossing_point, follow, turning_point
from meshwright.contact.certificate import certify_branch
from meshwright.limits.results import BranchPoint

#: A branch is followed this many pitches from where it starts.
PITCHES = 2.5


def branch_points(drive):
    """Folds and crossings of the branch through the contact nearest to angle 0, within its regular sheet."""
    if (found := start(drive)) is None:
        return ()
    angle, unknowns = found
    found = []
    for step in (STEP, -STEP):
        branch = _regular_part(drive, follow(drive, angle, unknowns, step), angle)
        found += [_located(drive, branch, k) for k in np.union1d(branch.turns, branch.crossings)]
    return tuple(sorted((point for point in found if point), key=lambda point: point.angle))


def start(drive):
    """Angle and unknowns of a contact near angle 0; None if there is none, or the contact is a line."""
    pitch = drive.pitch()
    for angle in np.array([0.0, 0.25, -0.25, 0.5, -0.5]) * pitch:
        x, status = drive.trace([angle])
        if status[0] == "converged" and not _observed(drive, angle, x[0])[1].line:
            return float(angle), x[0]
    return None


def _observed(drive, angle, x):
    s, o = drive.state(angle), np.empty(drive.model.no)
    contact = ffi.new("mw_contact *")
    library().mw_contact_at(drive.model, pointer(s), pointer(np.ascontiguousarray(x)), pointer(o), contact)
    return o, contact


def _regular_part(drive, branch, angle):
    """The branch up to where it leaves the regular sheet of either member or the angles of interest."""
    bodies = drive.design.description["bodies"]
    sheets = [b["regular"] for b in bodies]
    sheets += [b["margin"] + i for b in bodies for i, m in enumerate(b["margins"]) if m["flag"] == "spurious_sheet"]
    for k, (phi, x) in enumerate(zip(branch.angles, branch.unknowns, strict=True)):
        o, _ = _observed(drive, phi, x)
        if abs(phi - angle) > PITCHES * drive.pitch() or not all(o[i] > 0.0 for i in sheets):
            return branch.up_to(k)
    return branch


def _located(drive, branch, k):
    """The branch point on step k; None if it cannot be located."""
    if k not in branch.crossings:
        kind, place = "fold", turning_point(drive, branch, k)
    else:
        kind, place = "pitchfork" if k in branch.turns else "crossing", crossing_point(drive, branch, k)
    if place is None:
        return None
    angle, x = place
    o, _ = _observed(drive, float(angle), x)
    return BranchPoint(float(angle), kind, o[0:3].copy(), certify_branch(drive, angle, x, kind != "fold"))
