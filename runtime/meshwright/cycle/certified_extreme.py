"""The error of flanks that touch along a line, on an edge or at a corner, enclosed; and the line.

No tangency holds the wheel there. But with the wheel turned back by a little the two bounded flanks have no place in
common, and turned on by a little they have one, surely: between both lies the angle at which they touch first. The
search that proves first contacts shows the first, and the second or, along a line, how near the flanks are there does.
"""

from dataclasses import dataclass

import numpy as np

from meshwright.contact.results import ARCSEC
from meshwright.cycle.certified_first import EFFORT, REACH, ranges
from meshwright.cycle.certified_line import CertifiedLine, Posed, certified_line
from meshwright.cycle.search import Search
from meshwright.cycle.searched_flank import start_values

#: Turned back by more than this, mm of arc at the place of contact, the flanks have no place in common; turned on by so
#: much they have one: the first for which it is shown. The least is tried where so many parts may be looked at.
TURNED_BACK = (1e-9, 1e-8, 1e-7, 1e-6)
TURNED_ON = (3e-9, 3e-8, 3e-7, 3e-6, 3e-5)
LEAST_EFFORT = 6_000

#: The place from which the flanks are looked at lies this share of the way from that of contact to their middle.
INWARDS = 0.02

#: Operations with doubles that an angle of the wheel has come through, in units of the last place.
ROUNDED = 8.0

#: Parts of flanks that are looked at, most, at all angles together; what is left then is not shown.
BUDGET = 60_000

#: Status words of what is enclosed.
HELD = ("line_contact", "edge_contact", "corner_contact")


@dataclass(frozen=True)
class Extremes:
    """What is proved of a TCA at N angles where no tangency holds the wheel.

    ``bounds`` (N, 2) of the transmission error, rad; NaN elsewhere, and where nothing is shown. ``slacks`` (N,): with
    the wheel turned back by more than this, mm of arc at the place of contact, and up to ``reach``, rad, the bounded
    flanks have no place in common; ``parts`` (N,) of the flanks that were looked at; ``lines``: a
    :class:`~meshwright.cycle.certified_line.CertifiedLine` where they touch along one, else None. ``asked`` (N,) of
    bool: where something was to be shown.
    """

    bounds: np.ndarray
    slacks: np.ndarray
    lines: tuple[CertifiedLine | None, ...]
    asked: np.ndarray
    parts: np.ndarray
    reach: float

    def plain(self, k):
        """What the certificate of point k of the ``meshwright.tca/1`` schema says of it; {} where nothing was asked."""
        if not self.asked[k]:
            return {}
        line = {} if self.lines[k] is None else {"contact_line": self.lines[k].plain()}
        low, high = self.bounds[k].tolist()
        if not np.isfinite((low, high)).all():
            return line
        away = ROUNDED * np.finfo(float).eps * max(abs(low), abs(high)) / ARCSEC
        low, high = low / ARCSEC - away, high / ARCSEC + away
        return line | {
            "outcome": "enclosed",
            "reason": None,
            "message": "the flanks surely touch first between these errors",
            "transmission_error_arcsec": [float(low), float(high)],
            "radius": float(np.nextafter(0.5 * (high - low), np.inf)),
            "first_contact": {
                "outcome": "first", "reason": None, "message": "it is shown",
                "overlap_below_mm": float(self.slacks[k]), "turned_back_arcsec": self.reach / ARCSEC,
                "overlap_arcsec": None, "point_mm": None, "flanks": {}, "parts": int(self.parts[k]), "neighbours": [],
            },
        }  # fmt: skip


def enclosed_extremes(drive, contacts):
    """The :class:`Extremes` of a :class:`~meshwright.contact.results.TCA`."""
    count = len(contacts.angles)
    bounds, slacks = np.full((count, 2), np.nan), np.full(count, np.nan)
    rows = np.flatnonzero([word in HELD for word in contacts.status])
    asked, lines, parts = np.isin(np.arange(count), rows), [None] * count, np.zeros(count, dtype=int)
    mirror = drive.design.mirror
    search, _ = Search.of(drive, mirror.sign * contacts.angles, contacts.solutions)
    if search is not None and rows.size:
        first = search.first(contacts.angles[rows])
        boxes = ranges(drive, np.concatenate([first.solutions, search.solutions]), 0)
        ends = np.array([end for box in boxes.values() for pair in box.values() for end in pair] or [0.0] * 8)
        left = BUDGET
        for k, row in enumerate(rows):
            if not np.isfinite(first.solutions[k]).all():
                continue
            share = left // (len(rows) - k)
            one = _Extreme(drive, search, first, k, ends, share)
            if contacts.status[row] == "line_contact" and contacts.lines[row] is not None:
                lines[row] = one.line(contacts.lines[row].mirrored(mirror))
            found = one.bounds()
            bounds[row] = found if mirror.sign > 0 else (-found[1], -found[0])
            slacks[row], parts[row] = one.slack * one.radius, share - one.left
            left -= share - one.left
    return Extremes(bounds, slacks, tuple(lines), asked, parts, REACH * abs(drive.ratio) * drive.pitch())


class _Extreme:
    """First contact k, right hand, to be enclosed while so many parts of flanks are ``left``."""

    def __init__(self, drive, search, first, k, ends, left):
        mirror = drive.design.mirror
        self.drive, self.search, self.left = drive, search, left
        self.angle, self.error = mirror.sign * first.angles[k], mirror.sign * first.errors[k]
        self.radius, self.slack = abs(first.levers[k]), np.nan
        (middle,) = start_values(drive, np.array([drive.design.reference_angle]))
        self.looked_from = first.solutions[k] + INWARDS * (middle - first.solutions[k])
        self.posed, self.nearest = Posed(drive, self.angle, ends), np.inf

    def line(self, line):
        """What is shown of a :class:`~meshwright.cycle.touching_line.TouchingLine`, right hand."""
        wheel = self.drive.design.description["bodies"][1]
        on_wheel = self.drive.flank(wheel["name"])(line.unknowns(self.drive)[:, wheel["unknowns"]]).points
        radius = float(np.hypot(on_wheel[:, 0], on_wheel[:, 1]).max()) * (1.0 + 1e-9)
        found = certified_line(
            self.posed, self._wheel(self.error), self.looked_from, self.search.ever_closer(line), radius
        )
        self.nearest, self.left = found.nearest, self.left - found.parts
        return found

    def bounds(self):
        """Bounds of the error; NaN where they are not shown."""
        arcs = TURNED_BACK if self.left >= LEAST_EFFORT else TURNED_BACK[1:]
        earliest = next((found for found in map(self._apart_from, arcs) if found is not None), None)
        if earliest is None:
            return np.full(2, np.nan)
        if np.isfinite(self.nearest):
            latest = self.search.sense * self.error - max(self.nearest, 0.0) - self._off(self.error)
        else:
            latest = next((found for found in map(self._overlapping_at, TURNED_ON) if found is not None), None)
        return np.full(2, np.nan) if latest is None else np.sort(self.search.sense * np.array([latest, earliest]))

    def _apart_from(self, arc):
        """Sense times the turn from which on, this much arc back, nothing touches; None where that is not shown."""
        slack = arc / self.radius
        if self._asked(self.error, slack)["outcome"] != 1:
            return None
        self.slack = slack
        return self.search.sense * self.error + slack + self._off(self.error)

    def _overlapping_at(self, arc):
        """Sense times the turn at which, turned on by this much arc, something touches already; None likewise."""
        sense = self.search.sense
        turned = self.error - sense * arc / self.radius
        shown = self._asked(turned, TURNED_BACK[0] / self.radius)
        if shown["outcome"] != 2:
            return None
        apart = abs(float(shown["apart"]["mid"])) - float(shown["apart"]["radius"])
        return sense * turned + min(max(apart, 0.0), arc / self.radius) - self._off(turned)

    def _asked(self, turn, slack):
        """What is shown with the wheel turned by so much, a ``mw_first_certificate``."""
        reach = REACH * abs(self.drive.ratio) * self.drive.pitch()
        shown = self.posed.first(self._wheel(turn), self.looked_from, slack, reach, min(EFFORT, max(self.left, 1)))
        self.left -= int(shown["parts"])
        return shown

    def _wheel(self, turn):
        return self.drive.ratio * self.angle + turn

    def _off(self, turn):
        """Rounding of a wheel angle."""
        return ROUNDED * np.finfo(float).eps * (abs(self.drive.ratio * self.angle) + abs(turn))
