"""Backlash between the two flanks of a tooth: how far the wheel can turn while the pinion stands."""

import math

import numpy as np

from meshwright.contact.placement import placed
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.transmission import ROUND_OFF, envelopes

#: Samples of one pitch.
SAMPLES = 64

#: The same where each takes a search for first contact of several pairs.
SEARCHED = 8


def backlash(drive):
    """Smallest wheel angle from contact on one flank to contact on the other over one pitch, rad.

    Negative: the teeth are thicker than the spaces, the drive jams. NaN where each flank is a design of its own or one
    of them has no contact. Without limits of contact it is that of the pair that touches at angle 0.
    """
    if drive.design.description["flanks_apart"]:
        return math.nan
    one, other = _both_flanks(drive)
    here = Mesh.of(one)
    if here.contact is None:
        return math.nan
    there = Mesh.of(other)
    if there.contact is None:
        return math.nan
    complete = here.window.complete and there.window.complete
    angles = np.arange(_samples(here, there)) / _samples(here, there) * drive.pitch() if complete else np.zeros(1)
    pinion, wheel = offsets(here, there)
    play = here.sense * (_stops(there, angles + pinion) + wheel - _stops(here, angles))
    tooth = drive.pitch() * drive.ratio
    least = float(np.min(play)) if np.isfinite(play).all() else math.nan
    return least - tooth * round(least / tooth) if math.isfinite(least) else least


def meaning(backlash):
    """What a backlash (rad) says of the drive, in words."""
    if abs(backlash) < ROUND_OFF:
        return "the teeth just fill the spaces"
    return "wheel angle between the flanks" if backlash > 0.0 else "negative: the drive jams"


def _both_flanks(drive):
    """The right-hand drive (a mirror image has the same backlash) with either flank."""
    description = drive.design.description
    right = drive.with_(design={"hand": description["handed"]}) if description["handed"] else drive
    words = next(p["choices"] for p in description["parameters"] if p["table"] == "flank")
    return right, right.with_(flank=next(w for w in words if w != drive.design.tables["flank"]))


def _samples(*meshes):
    """Samples of one pitch: fewer where each takes searches, one where all are alike."""
    if all(mesh.path is not None for mesh in meshes):
        return SAMPLES
    return 1 if all(mesh.constant for mesh in meshes) else SEARCHED


def _stops(mesh, angles):
    """Wheel angles at which the flanks touch, of the pair that stops the wheel: (N,)."""
    if mesh.path is None and mesh.rigid is not None:
        return mesh.drive.ratio * angles + mesh.rigid.transmitted(angles)
    found = envelopes(mesh, angles)
    return mesh.drive.ratio * angles + (found.upper if mesh.sense > 0 else found.lower)


def offsets(here, there):
    """What to add to pinion angles of one flank to get the other's for the same stand of the body, and to the other's
    wheel angles to get the first one's.
    """
    first, second = (placed(mesh.drive, [0.0], [0.0]) for mesh in (here, there))
    pinion, wheel = (_turn(first, second, name) for name in ("pinion", "wheel"))
    return -pinion, wheel


def _turn(first, second, member):
    """Angle about a member's axis, in the sense in which its angle grows, from one flank's zero to the other's."""
    turned = first.matrices[member][0, :3, :3].T @ second.matrices[member][0, :3, :3]
    direction, _ = first.axes[member]
    return math.atan2(turned[1, 0], turned[0, 0]) * math.copysign(1.0, direction[0] @ first.matrices[member][0, :3, 2])
