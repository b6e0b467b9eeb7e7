"""Backlash between the two flanks of a tooth: how far the wheel can turn while the pinion stands."""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.contact.placement import placements
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.transmission import ROUND_OFF, envelopes

#: Samples of one pitch.
SAMPLES = 64

#: Turn of the pinion by which the sense of the members' rotation is read off, rad.
TURN = 0.01


def backlash(drive):
    """Smallest wheel angle from contact on one flank to contact on the other over one pitch, rad.

    Negative: the teeth are thicker than the spaces, the drive jams. NaN where each flank is a design of its own or one
    of them has no contact. Without limits of contact it is that of the pair that touches at angle 0.
    """
    if drive.design.description["flanks_apart"]:
        return math.nan
    one, other = _both_flanks(drive)
    here = Mesh.of(one)
    if here.window.path is None:
        return math.nan
    there = Mesh.of(other)
    if there.window.path is None:
        return math.nan
    complete = here.window.complete and there.window.complete
    angles = np.arange(SAMPLES) / SAMPLES * drive.pitch() if complete else np.zeros(1)
    pinion, wheel = _offsets(here, there)
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


def _stops(mesh, angles):
    """Wheel angles at which the flanks touch, of the pair that stops the wheel: (N,)."""
    found = envelopes(mesh, angles)
    return mesh.drive.ratio * angles + (found.upper if mesh.sense > 0 else found.lower)


def _offsets(here, there):
    """What to add to pinion angles of one flank to get the other's for the same stand of the body, and to the other's
    wheel angles to get the first one's.
    """
    first, second = _stand(here), _stand(there)
    pinion = -_between(first, second, "pinion") / first.senses["pinion"]
    return pinion, _between(first, second, "wheel") / first.senses["wheel"]


@dataclass(frozen=True)
class _Stand:
    """Placements, input angles and senses of rotation about their z axes of the bodies by member, at one solution."""

    matrices: dict
    angles: dict
    senses: dict


def _stand(mesh):
    """The bodies at the stored solution nearest to angle 0; a second one nearby tells the senses."""
    path = mesh.window.path
    start = path.angles[np.argmin(np.abs(path.angles))]
    at = np.array([start, start + TURN])
    placed = placements(mesh.drive, at).matrices
    angles = {"pinion": at, "wheel": mesh.drive.ratio * at + path.errors(at)}
    senses = {k: math.copysign(1.0, _turn(*m) * (angles[k][1] - angles[k][0])) for k, m in placed.items()}
    return _Stand({k: m[0] for k, m in placed.items()}, {k: a[0] for k, a in angles.items()}, senses)


def _between(first, second, member):
    """Angle about the body's axis from one flank's zero to the other's, in the sense of its frame."""
    turned = _turn(first.matrices[member], second.matrices[member])
    return turned - first.senses[member] * (second.angles[member] - first.angles[member])


def _turn(first, second):
    """Angle about z that takes one placement of a body into another."""
    turned = first[:3, :3].T @ second[:3, :3]
    return math.atan2(turned[1, 0], turned[0, 0])
