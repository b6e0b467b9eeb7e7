"""The contact window of a pair with a proof: its branch without a gap; its ends, contact ratio and peak-to-peak error
between bounds.
"""

import math
from dataclasses import dataclass

from meshwright.contact.certified_path import CertifiedPath, certified_path
from meshwright.contact.results import ARCSEC

#: Margins are enclosed in pieces no longer than this, rad; the path goes on beyond the window by this share of a pitch.
LONGEST, BEYOND = 0.25, 1e-3


@dataclass(frozen=True)
class CertifiedWindow:
    """``path``: the branch from before the one end to beyond the other. ``ends`` (lower, upper): each ((member, event),
    low, high), rad, of the right-hand drive, None where it cannot be shown: every margin is positive from the one
    ``high`` to the other ``low``, and that of the event negative at the outer bound. ``contact_ratio``: bounds, None
    without ends. ``peak_to_peak``: bounds of the transmission error's over the window, rad.
    """

    path: CertifiedPath
    ends: tuple
    contact_ratio: tuple[float, float] | None
    peak_to_peak: tuple[float, float] | None

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
            "pair_peak_to_peak_arcsec": arcsec and [_outwards(arcsec[0], -1), _outwards(arcsec[1], 1)],
        }

    def _end(self, end, sign):
        if end is None:
            return None
        (member, event), low, high = end
        angles = sorted((sign * math.degrees(low), sign * math.degrees(high)))
        return {
            "member": member, "event": event,
            "pinion_angle_deg": [_outwards(angles[0], -1), _outwards(angles[1], 1)],
        }  # fmt: skip


def _angles(pair):
    return {"pinion_angle_deg": pair}


def _outwards(value, direction):
    """A number beyond what a change of unit rounded; zero it leaves alone."""
    if value == 0.0:
        return 0.0
    for _ in range(4):
        value = math.nextafter(value, direction * math.inf)
    return value


def certified_window(drive, window):
    """The :class:`CertifiedWindow` of a :class:`~meshwright.cycle.windows.Window` with both ends and a path; None
    without: a line of contact has no path.
    """
    if window.path is None or not window.complete:
        return None
    lower, upper = window.bounds
    beyond = BEYOND * drive.pitch()
    path = certified_path(drive, lower - beyond, upper + beyond, longest=LONGEST)
    if not path.complete:
        return CertifiedWindow(path, (None, None), None, None)
    middle = 0.5 * (lower + upper)
    found = [path.first_exit(middle, direction) for direction in (-1, 1)]
    ends = tuple(None if f is None else (f[0], *sorted(f[1:])) for f in found)
    if None in ends:
        return CertifiedWindow(path, ends, None, None)
    least, most = ends[1][1] - ends[0][2], ends[1][2] - ends[0][1]
    pitch = drive.pitch()
    ratio = tuple(_outwards(span / pitch, direction) for span, direction in ((least, -1), (most, 1)))
    # at least that of the window surely held, at most that of the one that may be
    least, most = (path.within(*bounds).peak_to_peak for bounds in ((ends[0][2], ends[1][1]), (ends[0][1], ends[1][2])))
    return CertifiedWindow(path, ends, ratio, (least[0], most[1]))

