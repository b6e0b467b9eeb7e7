"""The contact window of a pair with a proof: its branch without a gap; its ends, contact ratio, peak-to-peak error and
the angles at which pairs change between bounds.
"""

import math
from dataclasses import dataclass

from meshwright.contact.certified_path import CertifiedPath, certified_path
from meshwright.contact.results import ARCSEC

#: Margins are enclosed in pieces no longer than this, rad; the path goes on beyond the window by this share of a pitch.
LONGEST, BEYOND = 0.25, 1e-3

#: Halvings of a pitch within which a change of pairs is looked for, most.
FINEST = 44


@dataclass(frozen=True)
class CertifiedWindow:
    """``path``: the branch from before the one end to beyond the other. ``ends`` (lower, upper): each ((member, event),
    low, high), rad, of the right-hand drive, None where it cannot be shown: every margin is positive from the one
    ``high`` to the other ``low``, and that of the event negative at the outer bound. ``contact_ratio``: bounds, None
    without ends. ``peak_to_peak``: bounds of the transmission error's over the window, rad. ``transfers``: bounds (low,
    high), rad, right-hand drive, of an angle at which a pair and its neighbour have the same error, and of that a pitch
    later; None where that is not shown or does not happen.
    """

    path: CertifiedPath
    ends: tuple
    contact_ratio: tuple[float, float] | None
    peak_to_peak: tuple[float, float] | None
    transfers: tuple | None

    def plain(self, sign):
        """The ``certificate`` of ``meshwright.ratio/1``; ``sign``: that of the design's hand."""
        begin, end = (self._end(e, sign) for e in (self.ends if sign > 0 else self.ends[::-1]))
        gaps = [sorted((sign * math.degrees(g.begin), sign * math.degrees(g.end))) for g in self.path.gaps]
        arcsec = self.peak_to_peak and [self.peak_to_peak[0] / ARCSEC, self.peak_to_peak[1] / ARCSEC]
        return {
            "outcome": "unique" if self.path.complete else "unknown",
            "gaps": [g | {"reason": gap.reason} for g, gap in zip(map(_angles, gaps), self.path.gaps, strict=True)],
            "pieces": len(self.path.pieces),
            "transmission_error_radius_arcsec": self.path.tube / ARCSEC,
            "smaller_angle": begin,
            "larger_angle": end,
            "contact_ratio": self.contact_ratio and list(self.contact_ratio),
            "transfer_angles_deg": self.transfers and sorted(_degrees(t, sign) for t in self.transfers),
            "pair_peak_to_peak_arcsec": arcsec and [_outwards(arcsec[0], -1), _outwards(arcsec[1], 1)],
        }

    def _end(self, end, sign):
        if end is None:
            return None
        (member, event), *bounds = end
        return {"member": member, "event": event, "pinion_angle_deg": _degrees(bounds, sign)}


def _degrees(bounds, sign):
    low, high = sorted(sign * math.degrees(end) for end in bounds)
    return [_outwards(low, -1), _outwards(high, 1)]


def _angles(pair):
    return {"pinion_angle_deg": pair}


def _outwards(value, direction):
    """A number beyond what a change of unit rounded; zero it leaves alone."""
    if value == 0.0:
        return 0.0
    for _ in range(4):
        value = math.nextafter(value, direction * math.inf)
    return value


def certified_window(drive, window, transfers=()):
    """The :class:`CertifiedWindow` of a :class:`~meshwright.cycle.windows.Window` with both ends and a path; None
    without: a line of contact has no path. ``transfers``: where floating point found pairs to change, rad, of the
    design's hand.
    """
    if window.path is None or not window.complete:
        return None
    lower, upper = window.bounds
    beyond = BEYOND * drive.pitch()
    path = certified_path(drive, lower - beyond, upper + beyond, longest=LONGEST)
    if not path.complete:
        return CertifiedWindow(path, (None, None), None, None, None)
    middle = 0.5 * (lower + upper)
    found = [path.first_exit(middle, direction) for direction in (-1, 1)]
    ends = tuple(None if f is None else (f[0], *sorted(f[1:])) for f in found)
    if None in ends:
        return CertifiedWindow(path, ends, None, None, None)
    least, most = ends[1][1] - ends[0][2], ends[1][2] - ends[0][1]
    pitch = drive.pitch()
    ratio = tuple(_outwards(span / pitch, direction) for span, direction in ((least, -1), (most, 1)))
    # at least that of the window surely held, at most that of the one that may be
    least, most = (path.within(*bounds).peak_to_peak for bounds in ((ends[0][2], ends[1][1]), (ends[0][1], ends[1][2])))
    first = min((drive.design.mirror.sign * angle for angle in transfers), default=None)
    change = None if first is None else _transfers(path, first, pitch)
    return CertifiedWindow(path, ends, ratio, (least[0], most[1]), change)


def _transfers(path, first, pitch):
    """Bounds of an angle near ``first`` and of that a pitch later at which the path has the same transmission error: a
    pair's and, a pitch before, its successor's. None where no change of sign is shown.
    """
    def change(angle):
        """Bounds of the error a pitch later less that at the angle, or None beyond the path."""
        later = _outwards(angle + pitch, -1), _outwards(angle + pitch, 1)
        if not (path.begin <= angle and later[1] <= path.end):
            return None
        (low, high), (least, most) = path.error(angle), path.error_between(*later)
        return math.nextafter(least - high, -math.inf), math.nextafter(most - low, math.inf)

    for halvings in range(FINEST, 0, -1):
        ends = first - pitch * 0.5**halvings, first + pitch * 0.5**halvings
        before, after = map(change, ends)
        if before is None or after is None:
            return None
        if before[1] < 0.0 < after[0] or after[1] < 0.0 < before[0]:
            return ends, (_outwards(ends[0] + pitch, -1), _outwards(ends[1] + pitch, 1))
    return None

