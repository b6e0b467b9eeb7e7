"""First contact with a proof: as the wheel comes up to a certified contact from the side on which the gap is open, no
place of the one bounded flank meets one of the other's; or the place where one does.
"""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import library, pointer, record
from meshwright.contact import exact
from meshwright.contact.certificate import InWords
from meshwright.contact.placement import placed
from meshwright.contact.results import ARCSEC
from meshwright.cycle.model import DriveModel
from meshwright.flank.region import region
from meshwright.flank.uses import Uses

#: An overlap below this is not told from a contact, mm of arc at the contact.
SLACK = 1e-6

#: Neighbouring pairs on either side that are looked at, where the pair itself could be told.
NEIGHBOURS = 1

#: How far back the wheel is turned, in wheel pitches; parts of the wheel's flank that are looked at, most.
REACH, EFFORT = 0.5, 15_000

#: Contacts at so many angles over so many pitches to either side of the middle show where the flanks are. Parameters go
#: on beyond the flanks by this share, and where nothing ends a flank, beyond its contacts by so many natural sizes.
ANGLES, PITCHES, BESIDE, BEYOND = 9, 0.5, 0.05, 4.0


@dataclass(frozen=True)
class FirstCertificates(InWords):
    """What is shown of first contact at N pinion angles.

    ``outcomes``: ``first``: with the wheel turned back from the contact by any angle above ``slacks`` and up to
    ``reach``, rad, the two flanks have no place in common; ``not_first``: they have one, near the :meth:`points`;
    ``unknown``: neither is shown, for the reason in ``reasons``. A flank is what of its ``boxes`` ({member: {parameter:
    (lowest, highest)}}) lies inside all its limits, of the wheel's the piece that holds the contact. ``records`` (N,)
    are the library's own; ``radii`` (N,) the distances of the contacts from the wheel's axis, mm. Right-hand drive.
    ``neighbours``: the same of pairs so many later, with both members where this pair's contact holds them.
    """

    WORDS: ClassVar = ("unknown", "first", "not_first")
    drive: DriveModel
    records: np.ndarray
    boxes: dict[str, dict[str, tuple[float, float]]]
    slacks: np.ndarray
    reach: float
    radii: np.ndarray
    neighbours: dict[int, "FirstCertificates"]

    def points(self, contacts):
        """The places (N, 3) that are named, of the wheel's flank at its transmission errors of the ``contacts`` (N,),
        fixed frame, mm; NaN where none is.
        """
        named, points = np.isfinite(self.records["wheel"]).all(axis=1), np.full((len(self.records), 3), np.nan)
        if not named.any():
            return points
        wheel, mirror = self.drive.design.description["bodies"][1]["name"], self.drive.design.mirror
        angles = mirror.sign * contacts.angles[named], mirror.sign * contacts.wheel_angles[named]
        matrix = placed(self.drive, *angles).matrices[wheel]
        local = self.drive.flank(wheel)(self.records["wheel"][named]).points
        points[named] = (np.einsum("nij,nj->ni", matrix[:, :3, :3], local) + matrix[:, :3, 3]) * mirror.flip
        return points

    def to_plain(self, contacts):
        """A certificate each, as plain data of the ``meshwright.tca/1`` schema; ``contacts``: their TCA."""
        points = self.points(contacts)
        return [self._plain(k, points[k]) for k in range(len(self.records))]

    def _plain(self, k, point):
        outcome, entry = self.outcomes[k], self.records[k]
        named = np.isfinite(entry["wheel"]).all()
        middle, radius = (float(entry["apart"][part]) for part in ("mid", "radius"))
        overlap = [-(middle + radius) / ARCSEC, (radius - middle) / ARCSEC]
        return {
            "outcome": outcome,
            "reason": self.reasons[k] or None,
            "message": self.messages[k],
            "overlap_below_mm": SLACK if outcome == "first" else None,
            "turned_back_arcsec": self.reach / ARCSEC if outcome == "first" else None,
            "overlap_arcsec": overlap if outcome == "not_first" else None,
            "point_mm": point.tolist() if named else None,
            "flanks": self._flanks(entry),
            "parts": int(entry["parts"]),
            "neighbours": [
                {"pairs_later": later, "outcome": of.outcomes[k], "reason": of.reasons[k] or None}
                for later, of in self.neighbours.items()
                if entry["outcome"]
            ],
        }

    def _flanks(self, entry):
        """Of each member the ranges of its parameters, and whether limits surely end it within them."""
        return {
            name: {"parameters": {p: list(ends) for p, ends in box.items()}, "ended_by_limits": bool(ended)}
            for (name, box), ended in zip(self.boxes.items(), entry["ends"], strict=False)
        }


def certify_first(drive, contacts, certificates, neighbours=NEIGHBOURS):
    """:class:`FirstCertificates` of a TCA and its :class:`~meshwright.contact.certificate.Certificates`, and of so many
    ``neighbours`` on either side.
    """
    boxes, radii = ranges(drive, contacts.solutions, neighbours), distances(drive, contacts)
    own = _pair(drive, certificates.records, certificates.angles, boxes, radii)
    told = own.records["outcome"] > 0
    for later in (*range(-neighbours, 0), *range(1, neighbours + 1)):
        proofs, angles = _of_pair(drive, certificates, later)
        proofs["outcome"][~told] = 0
        own.neighbours[later] = _pair(drive, proofs, angles, boxes, radii)
    return own


def _pair(drive, proofs, angles, boxes, radii):
    """:class:`FirstCertificates` from ``mw_certificate`` and ``mw_wide`` of N contacts and angles."""
    flat = np.array([end for box in boxes.values() for ends in box.values() for end in ends] or [0.0] * 8)
    reach, slacks = REACH * abs(drive.ratio) * drive.pitch(), SLACK / radii * (1.0 - 1e-9)
    records = np.zeros(len(radii), record("mw_first_certificate"))
    work, state = np.empty(library().mw_certify_first_work()), drive.enclosed.state.copy()
    proofs, angles = proofs.copy(), angles.copy()
    for k, slack in enumerate(slacks.tolist()):
        library().mw_certify_first(
            drive.enclosed.model, pointer(state, "mw_wide[]"), pointer(angles[k : k + 1], "mw_wide[]")[0],
            pointer(proofs[k : k + 1], "mw_certificate[]"), pointer(flat), slack, reach, EFFORT, pointer(work),
            pointer(records[k : k + 1], "mw_first_certificate[]"),
        )  # fmt: skip
    return FirstCertificates(drive, records, boxes, slacks, reach, radii, {})


def _of_pair(drive, certificates, later):
    """The certificates and angles with both members turned to where a pair so many later stands as this one does."""
    sign, back = int(drive.design.mirror.sign), 1 if drive.ratio > 0.0 else -1
    proofs, angles = certificates.records.copy(), []
    for entry, angle in zip(proofs, certificates.angles, strict=True):
        angles.append(turned(exact.bounds(angle), -sign * later, drive.teeth("pinion")))
        if np.isfinite(entry["wheel_angle"]["mid"]):
            ends = turned(exact.bounds(entry["wheel_angle"]), -sign * back * later, drive.teeth("wheel"))
            high, low, radius = exact.wide(*ends)
            entry["wheel_angle"]["mid"], entry["wheel_angle"]["radius"] = high, np.nextafter(abs(low) + radius, np.inf)
    return proofs, exact.wides(angles)


def turned(ends, count, teeth):
    """Bounds of an angle turned by so many pitches."""
    turns = sorted(2 * count * pi / teeth for pi in exact.PI)
    return ends[0] + turns[0], ends[1] + turns[1]


def ranges(drive, solutions, neighbours):
    """Ranges of two parameters of each flank by member, a little beyond where the flanks end."""
    if not (isinstance(neighbours, int) and neighbours >= 0):
        raise UsageError(f"neighbours = {neighbours!r}: give a whole number of pairs on either side, 0 or more")
    pitches = PITCHES + neighbours
    here = drive.trace(np.linspace(-pitches, pitches, ANGLES) * drive.pitch())[0]
    known = np.concatenate([here, solutions])
    known = known[np.isfinite(known).all(axis=1)]
    boxes = {}
    for body in drive.design.description["bodies"] if len(known) else ():
        whole = region(drive, body["name"], "flank", Uses.of(drive, known, beyond=BEYOND))
        beside = BESIDE * (whole.box[1] - whole.box[0])
        ends = (whole.box[0] - beside).tolist(), (whole.box[1] + beside).tolist()
        names = [whole.flank.parameters[i] for i in whole.chart.free]
        boxes[body["name"]] = dict(zip(names, zip(*ends, strict=True), strict=True))
    return boxes


def distances(drive, contacts):
    """Distances (N,) of the contacts from the wheel's axis, mm."""
    wheel = drive.design.description["bodies"][1]
    points = drive.flank(wheel["name"])(contacts.solutions[:, wheel["unknowns"]]).points
    return np.hypot(points[:, 0], points[:, 1])
