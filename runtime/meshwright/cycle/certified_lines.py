"""The error of a pair that touches along lines, enclosed at every angle of a range at once.

A place of the line that moves with the pinion's angle stays inside both flanks, which stand apart there by next to
nothing; and with the wheel turned back by little from there the flanks have no place in common. Both are shown of
polynomials of the angle, as of a certified path, though no equation holds along them to the last digit.
"""

import heapq
import math
from dataclasses import dataclass

import numpy as np

from meshwright.base.library import ffi, library, pointer, record, text
from meshwright.contact.results import ARCSEC
from meshwright.cycle.certified_extreme import Extremes, enclosed_extremes
from meshwright.cycle.certified_first import REACH, SLACK, ranges
from meshwright.cycle.certified_line import TERMS
from meshwright.cycle.search import Search

#: Longest range that is tried, and shortest, in pitches; what is kept from the ends of the window.
LONGEST = 1 / 8
SHORTEST = 1 / 256
INSIDE = 1e-4

#: Angles of the window at each of which line and error are enclosed by themselves, more narrowly.
SAMPLES = 9

#: Parts of the flanks that are looked at over one range, and in all.
EFFORT = 3_000
BUDGET = 25_000

#: Widest error, mm of arc, of the place at which flanks are shown to be near: polynomials of less are no better.
NEAR = 0.5 * SLACK

#: Operations with doubles that a bound has come through, as a share of its size.
ROUNDED = 16.0 * np.finfo(float).eps


@dataclass(frozen=True)
class Span:
    """From one pinion angle to another, rad, of the right-hand drive: bounds of the error of the pair, rad, at every
    angle of it, or NaN and the ``reason``.
    """

    begin: float
    end: float
    low: float
    high: float
    reason: str


@dataclass(frozen=True)
class CertifiedLines:
    """What is shown over the window of a pair: ``spans`` without a gap, and ``extremes``
    (:class:`~meshwright.cycle.certified_extreme.Extremes`) at ``angles`` (N,), rad, as the user counts them.
    """

    spans: tuple[Span, ...]
    angles: np.ndarray
    extremes: Extremes

    @property
    def held(self):
        """The spans in which bounds are shown."""
        return [span for span in self.spans if not span.reason]

    @property
    def bounds(self):
        """Bounds of the error over all of those, rad, right-hand drive; None without any."""
        if not self.held:
            return None
        return min(span.low for span in self.held), max(span.high for span in self.held)

    def plain(self, sign):
        """The ``certificate`` of ``meshwright.ratio/1``; ``sign``: that of the design's hand."""
        bounds = _outwards(self.bounds and (sign * end for end in self.bounds))
        swing = bounds and math.nextafter(bounds[1] - bounds[0], math.inf)
        return {
            "outcome": "enclosed" if self.held or self._shown.any() else "unknown",
            "gaps": [{"pinion_angle_deg": ends, "reason": reason} for reason, ends in self._gaps(sign)],
            "pieces": len(self.held),
            "transmission_error_radius_arcsec": swing and 0.5 * swing,
            "transmission_error_arcsec": bounds,
            "held_deg": _joined(_degrees(sign, span.begin, span.end) for span in self.held),
            "at_angles": [self._at(k) for k in range(len(self.angles))],
            "smaller_angle": None,
            "larger_angle": None,
            "contact_ratio": None,
            "transfer_angles_deg": None,
            "pair_peak_to_peak_arcsec": swing and [0.0, swing],
            "first_contact": None,
        }

    @property
    def _shown(self):
        return np.isfinite(self.extremes.bounds).all(axis=1)

    def _at(self, k):
        found = self.extremes.plain(k)
        return {
            "pinion_angle_deg": math.degrees(self.angles[k]),
            "transmission_error_arcsec": found.get("transmission_error_arcsec"),
            "contact_line": found.get("contact_line"),
        }

    def _gaps(self, sign):
        """Ranges in which nothing is shown, those of one reason that meet as one."""
        open_ = [span for span in self.spans if span.reason]
        for reason in dict.fromkeys(span.reason for span in open_):
            own = (_degrees(sign, span.begin, span.end) for span in open_ if span.reason == reason)
            yield from ((reason, ends) for ends in _joined(own))


def _outwards(bounds):
    """Bounds in rad as arcsec, rounded outwards; None of none."""
    if bounds is None:
        return None
    low, high = sorted(end / ARCSEC for end in bounds)
    return [math.nextafter(low, -math.inf), math.nextafter(high, math.inf)]


def _degrees(sign, begin, end):
    return sorted((sign * math.degrees(begin), sign * math.degrees(end)))


def _joined(spans):
    """Ranges, ascending, those that meet as one."""
    joined = []
    for low, high in sorted(spans):
        if joined and low <= joined[-1][1]:
            joined[-1][1] = max(joined[-1][1], high)
        else:
            joined.append([low, high])
    return joined


def certified_lines(drive, window):
    """The :class:`CertifiedLines` of a :class:`~meshwright.cycle.windows.Window` of contact along lines; None where it
    is none, or has no ends.
    """
    if window.path is not None or not window.complete or window.status != "line_contact":
        return None
    sign, pitch = drive.design.mirror.sign, drive.pitch()
    low, high = sorted((sign * window.begin.angle, sign * window.end.angle))
    low, high = low + INSIDE * pitch, high - INSIDE * pitch
    asked = _Asked.of(drive, low, high)
    count = max(1, math.ceil((high - low) / (LONGEST * pitch)))
    cuts, middle_of_all = np.linspace(low, high, count + 1).tolist(), 0.5 * (low + high)

    def first_asked(begin, end):
        """The longest first, of equal ones that nearest the middle."""
        return round((begin - end) / pitch, 9), abs(0.5 * (begin + end) - middle_of_all), begin, end

    waiting = [first_asked(*ends) for ends in zip(cuts, cuts[1:], strict=False)]
    heapq.heapify(waiting)
    found = []
    while waiting:
        *_, begin, end = heapq.heappop(waiting)
        span = asked.span(begin, end)
        if not span.reason or end - begin <= SHORTEST * pitch or asked.left <= 0:
            found.append(span)
            continue
        middle = 0.5 * (begin + end)
        for half in ((begin, middle), (middle, end)):
            heapq.heappush(waiting, first_asked(*half))
    angles = sign * np.linspace(low, high, SAMPLES)
    spans = tuple(sorted(found, key=lambda span: span.begin))
    return CertifiedLines(spans, angles, enclosed_extremes(drive, drive.tca(angles)))


class _Asked:
    """What calls of the library share."""

    def __init__(self, drive, boxes, radius, sense):
        self.drive, self.left, self.radius, self.sense = drive, BUDGET, radius, sense
        self.flat = np.array([end for box in boxes.values() for ends in box.values() for end in ends])
        self.work, self.state = np.empty(library().mw_certify_first_work()), drive.enclosed.state.copy()
        self.nodes = np.empty(library().MW_ORDER + 1)
        library().mw_piece_nodes(pointer(self.nodes))
        self.powers = np.linalg.inv(np.vander(self.nodes, increasing=True))

    @classmethod
    def of(cls, drive, low, high):
        sign = drive.design.mirror.sign
        contacts = drive.tca(sign * np.linspace(low, high, 5))
        places = np.array([_halfway(drive, line) for line in contacts.lines if line is not None])
        wheel = drive.design.description["bodies"][1]
        points = drive.flank(wheel["name"])(places[:, wheel["unknowns"]]).points
        radius = float(np.hypot(points[:, 0], points[:, 1]).max()) * (1.0 + 1e-2)
        return cls(drive, ranges(drive, places, 0), radius, Search.of(drive)[0].sense)

    def span(self, begin, end):
        """What is shown from one angle to another."""
        if self.left <= 0:
            return _open(begin, end, "effort")
        piece = self._piece(begin, end)
        if piece is None:
            return _open(begin, end, "no_line")
        near = np.zeros(1, record("mw_line_certificate"))
        shared = self.drive.enclosed.model, pointer(self.state, "mw_wide[]"), piece
        library().mw_certify_line_along(
            *shared, pointer(self.flat), NEAR / self.radius, pointer(self.work), pointer(near, "mw_line_certificate[]")
        )
        (near,), slack = near, SLACK / self.radius
        self.left -= 1
        if not near["outcome"] or not near["limit"][0] > 0.0:
            return _open(begin, end, _reason(near) or "off_flank")
        first, reach = np.zeros(1, record("mw_first_certificate")), REACH * abs(self.drive.ratio) * self.drive.pitch()
        library().mw_certify_first_followed(
            *shared, pointer(self.flat), slack, reach, int(min(EFFORT, self.left)), pointer(self.work),
            pointer(first, "mw_first_certificate[]"),
        )  # fmt: skip
        (first,) = first
        self.left -= int(first["parts"])
        if first["outcome"] != 1:
            return _open(begin, end, _reason(first) or "elsewhere_first")
        error = piece.x[self.drive.design.description["error"]]
        swing = sum(abs(c) for c in list(error.c)[1:]) + ROUNDED * (slack + abs(error.c[0]))
        latest, earliest = max(float(near["nearest"]), 0.0), slack
        before, after = (latest, earliest) if self.sense > 0.0 else (earliest, latest)
        return Span(begin, end, error.c[0] - before - swing, error.c[0] + after + swing, "")

    def _piece(self, begin, end):
        """A piece of path that follows the middle of the line; None where there is none at some angle."""
        centre, half = 0.5 * (begin + end), 0.5 * (end - begin) * (1.0 + 1e-9)
        sign = self.drive.design.mirror.sign
        contacts = self.drive.tca(sign * (centre + half * self.nodes))
        if any(line is None for line in contacts.lines) or set(contacts.status) != {"line_contact"}:
            return None
        found = self.powers @ np.array([_halfway(self.drive, line) for line in contacts.lines])
        piece = ffi.new("mw_piece *", {"outcome": 1, "centre": centre, "half": half})
        for k, coefficients in enumerate(found.T.tolist()):
            piece.x[k].c = coefficients
        return piece


def _open(begin, end, reason):
    return Span(begin, end, math.nan, math.nan, reason)


def _reason(entry):
    return text(library().mw_reason_word(int(entry["reason"])))


def _halfway(drive, line):
    """Unknowns (nx,) halfway along a line, which change smoothly from angle to angle."""
    values = line.unknowns(drive)
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line.points, axis=0), axis=1))])
    at, far = 0.5 * along[-1], along[-1]
    begin = max(min(int(np.searchsorted(along, at)) - TERMS // 2, len(along) - TERMS), 0)
    chosen = slice(begin, begin + TERMS)
    matrix = np.vander((along[chosen] - at) / far, increasing=True)
    return np.linalg.lstsq(matrix, values[chosen], rcond=None)[0][0]
