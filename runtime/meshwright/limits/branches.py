"""Branches of contact: followed in arclength through folds, their turning points and crossings located."""

from dataclasses import dataclass

import numpy as np

from meshwright._library import ffi, library
from meshwright.analysis import pointer
from meshwright.limits.results import BranchPoint
from meshwright.limits.zeros import zeros

#: Steps along a branch, in natural sizes of the unknowns and radians of the input angle, and how many each way.
STEP, STEPS = 0.1, 150

#: A branch is followed this many pitches from where it starts.
PITCHES = 2.5

#: Fine steps into which a step is divided to locate a branch point on it.
FINENESS = 8


@dataclass(frozen=True)
class Branch:
    """Consecutive points of a branch: ``angles`` (N,), ``unknowns`` (N, nx), ``slopes`` dφ/darclength, bordered
    ``determinants``."""

    angles: np.ndarray
    unknowns: np.ndarray
    slopes: np.ndarray
    determinants: np.ndarray


def follow(drive, angle, unknowns, step=STEP, count=STEPS):
    """The :class:`Branch` through a solved contact; towards larger angles first if ``step`` > 0."""
    m, s = drive.model, drive.state(angle)
    angles, slopes, determinants = (np.empty(count + 1) for _ in range(3))
    x = np.empty((count + 1, m.nx))
    start = np.ascontiguousarray(unknowns, dtype=float)
    arrays = (pointer(a) for a in (angles, x, slopes, determinants))
    n = library().mw_arclength(m, pointer(s), angle, pointer(start), step, count, *arrays)
    return Branch(angles[:n], x[:n], slopes[:n], determinants[:n])


def branch_points(drive):
    """Folds and crossings of the branch through the contact nearest to angle 0, within its regular sheet."""
    start = _start(drive)
    if start is None:
        return ()
    angle, unknowns = start
    found = []
    for step in (STEP, -STEP):
        branch = _regular_part(drive, follow(drive, angle, unknowns, step), angle)
        found += [_located(drive, branch, k, step) for k in _turns(branch)]
    return tuple(sorted((point for point in found if point), key=lambda point: point.angle))


def _start(drive):
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
    """The branch up to where it leaves the wheel's or the worm's regular sheet or the angles of interest."""
    bodies = drive.design.description["bodies"]
    sheets = [b["regular"] for b in bodies]
    sheets += [b["margin"] + i for b in bodies for i, m in enumerate(b["margins"]) if m["flag"] == "spurious_sheet"]
    for k, (phi, x) in enumerate(zip(branch.angles, branch.unknowns, strict=True)):
        o, _ = _observed(drive, phi, x)
        if abs(phi - angle) > PITCHES * drive.pitch() or not all(o[i] > 0.0 for i in sheets):
            return Branch(*(a[:k] for a in (branch.angles, branch.unknowns, branch.slopes, branch.determinants)))
    return branch


def _turns(branch):
    """Steps on which the branch turns back or another crosses it."""
    turned = branch.slopes[:-1] * branch.slopes[1:] < 0.0
    crossed = branch.determinants[:-1] * branch.determinants[1:] < 0.0
    return np.flatnonzero(turned | crossed)


def _located(drive, branch, k, step):
    """The branch point on step k, by interpolation of fine steps on both sides of it.

    At a crossing the equations for a point are singular, beside it they are not: so no point is solved there.
    """
    crossed = branch.determinants[k] * branch.determinants[k + 1] < 0.0
    turned = branch.slopes[k] * branch.slopes[k + 1] < 0.0
    sense = np.sign(branch.slopes[k])
    fine = follow(drive, branch.angles[k], branch.unknowns[k], sense * abs(step) / FINENESS, 2 * FINENESS)
    values = fine.determinants if crossed else fine.slopes
    change = np.flatnonzero(values[:-1] * values[1:] < 0.0)
    if not len(change):
        return None
    near = slice(max(change[0] - 2, 0), change[0] + 4)
    curve = np.column_stack([fine.unknowns, fine.angles])[near]
    along = (curve - curve[0]) @ _direction(curve, drive)
    place = _interpolated_zero(along, values[near])
    angle, x = _interpolated(along, curve, place)[-1], _interpolated(along, curve, place)[:-1]
    kind = "fold" if not crossed else "pitchfork" if turned else "crossing"
    o, _ = _observed(drive, float(angle), x)
    return BranchPoint(float(angle), kind, o[0:3].copy())


def _direction(curve, drive):
    """Unit chord of a stretch of branch, in natural sizes; distance along it is the parameter of interpolation."""
    scale = np.ones(curve.shape[1])
    drive.model.scale(pointer(drive.state()), pointer(scale))
    chord = (curve[-1] - curve[0]) / scale
    return chord / np.linalg.norm(chord) / scale


def _interpolated(places, values, at):
    """Values of the polynomials through ``values`` (N, …) at ``places`` (N,), at one place."""
    weights = [np.prod([(at - q) / (p - q) for q in places if q != p]) for p in places]
    return np.tensordot(weights, values, axes=1)


def _interpolated_zero(places, values):
    """Place where the polynomial through values of changing sign is zero."""
    return zeros(lambda at: np.array([_interpolated(places, values, p) for p in at]), places)[0]
