"""First contact with a proof at every angle of a range: as the wheel comes up to the contact of a certified path, no
place of the one bounded flank meets one of the other's, nor do those of neighbouring pairs; or the angle and place
where one does.
"""

import heapq
import math
from dataclasses import dataclass, replace

import numpy as np

from meshwright.base.library import ffi, library, pointer, record, text
from meshwright.contact import exact
from meshwright.contact.certified_path import CertifiedPath, certified_path, refuse_empty
from meshwright.cycle import certified_first as single
from meshwright.cycle.model import DriveModel

#: Longest range of angles in pinion pitches of which each outcome is said: an overlap at one of its angles, or that
#: nothing is shown. Where the contact leaves the flanks is told to ``LEAVING`` pitches. The path is certified beyond
#: both ends by ``BESIDE``, its transmission error to the share ``TUBE`` of the slack.
LONGEST = {"first": math.inf, "not_first": 2.0**-4, "unknown": 2.0**-8}
LEAVING, BESIDE, TUBE = 2.0**-14, 1e-6, 0.02

#: Parts of the wheel's flank that a pitch of angles takes at most, half a pitch twice as many …; a pair in all, and one
#: of which nothing has been shown.
LEAST, BUDGET, FRUITLESS = 600, 12_000, 5_000


@dataclass(frozen=True)
class Span:
    """What is shown from one angle to another, rad, of a pair so many ``later``: outcome and reason as of
    :class:`~meshwright.cycle.certified_first.FirstCertificates`. ``angle`` and ``wheel`` (2,), parameters of its flank:
    where it fails, NaN where it does not; ``overlap``: by how much the flanks surely overlap there, rad, and with
    ``throughout`` at every angle of the span.
    """

    later: int
    begin: float
    end: float
    outcome: str
    reason: str
    message: str
    throughout: bool
    parts: int
    angle: float
    wheel: tuple[float, float]
    overlap: float


@dataclass(frozen=True)
class FirstAlongPath:
    """First contact from ``begin`` to ``end``, rad, of the right-hand drive: of each of ``pairs`` spans without a gap.

    ``slack``, rad of the wheel, is the overlap below which nothing is said; by ``reach`` the wheel is turned back.
    """

    drive: DriveModel
    begin: float
    end: float
    path: CertifiedPath
    boxes: dict[str, dict[str, tuple[float, float]]]
    pairs: tuple[int, ...]
    spans: tuple[Span, ...]
    slack: float
    reach: float

    def of(self, later):
        """The spans of a pair, ascending."""
        return [span for span in self.spans if span.later == later]

    @property
    def outcome(self):
        """``first`` at every angle against all pairs, ``not_first`` at one surely, or ``unknown``."""
        words = {span.outcome for span in self.spans}
        if "not_first" in words:
            return "not_first"
        return "first" if self.path.complete and words == {"first"} else "unknown"

    @property
    def failures(self):
        """The spans in which it is not shown."""
        return [span for span in self.spans if span.outcome != "first"]


def certify_first_path(drive, begin, end, neighbours=1):
    """:class:`FirstAlongPath` from one pinion angle to another, rad, of the right-hand drive, and of so many
    ``neighbours`` on either side, all with both members where this pair's contact holds them.
    """
    refuse_empty(begin, end)
    pitch = drive.pitch()
    contacts = drive.tca(drive.design.mirror.sign * np.linspace(begin, end, single.ANGLES))
    boxes = single.ranges(drive, contacts.solutions, neighbours)
    slack = single.SLACK / float(np.nanmax(single.distances(drive, contacts))) * (1.0 - 1e-3)
    path = certified_path(drive, begin - BESIDE * pitch, end + BESIDE * pitch, tube=TUBE * slack)
    search = _Search(drive, boxes, slack, single.REACH * abs(drive.ratio) * pitch)
    pairs = sorted(range(-neighbours, neighbours + 1), key=abs)
    spans = []
    whole = path.within(begin, end)
    ranges = [(piece, *ends) for piece, ends in zip(whole.pieces, whole.ends, strict=True)]
    for later in pairs:
        spans += search.spans(ranges, later)
    return FirstAlongPath(drive, begin, end, path, boxes, tuple(pairs), tuple(spans), slack, search.reach)


class _Search:
    """What calls of the library share."""

    def __init__(self, drive, boxes, slack, reach):
        self.drive, self.slack, self.reach = drive, slack, reach
        self.flat = np.array([end for box in boxes.values() for ends in box.values() for end in ends] or [0.0] * 8)
        self.work, self.state = np.empty(library().mw_certify_first_work()), drive.enclosed.state.copy()

    def spans(self, ranges, later):
        """Spans of a pair without a gap over parts (piece, begin, end) of a path, until the budget is spent: the
        longest first, halved where nothing is shown.
        """
        pitch, left, found = self.drive.pitch(), BUDGET, []
        waiting = [(begin - end, begin, end, k) for k, (_, begin, end) in enumerate(ranges)]
        heapq.heapify(waiting)
        while waiting:
            _, begin, end, k = heapq.heappop(waiting)
            if left <= 0 or (left <= BUDGET - FRUITLESS and all(span.outcome == "unknown" for span, _ in found)):
                found.append((_spent(later, begin, end), k))
                continue
            effort = min(LEAST * max(1.0, pitch / (end - begin)), left, single.EFFORT)
            span = self._span(ranges[k][0], begin, end, later, int(effort))
            left -= span.parts
            if span.throughout or end - begin <= LONGEST[span.outcome] * pitch:
                found.append((span, k))
                continue
            middle = 0.5 * (begin + end)
            for half in ((begin, middle), (middle, end)):
                heapq.heappush(waiting, (half[0] - half[1], *half, k))
        found.sort(key=lambda entry: entry[0].begin)
        return _joined(self._sharpened(found, ranges, later))

    def _sharpened(self, found, ranges, later):
        """The spans, with those at which the contact leaves the flanks divided where it does."""
        sharp = []
        for n, (span, k) in enumerate(found):
            before, after = (found[m][0] if 0 <= m < len(found) else span for m in (n - 1, n + 1))
            if span.reason != "off_flank" or before.reason == after.reason:
                sharp.append(span)
            elif before.reason != span.reason:
                sharp += self._divided(ranges[k][0], span, span.begin, later)
            else:
                sharp += reversed(self._divided(ranges[k][0], span, span.end, later))
        return sharp

    def _divided(self, piece, span, end, later):
        """What is shown from an end of a span on, and the rest of it."""
        held, lost, shown = end, span.begin + span.end - end, []
        while abs(lost - held) > LEAVING * self.drive.pitch():
            middle = 0.5 * (held + lost)
            half = self._span(piece, *sorted((held, middle)), later, single.EFFORT)
            if half.outcome == "unknown":
                lost = middle
            else:
                shown.append(half)
                held = middle
        low, high = sorted((held, span.begin + span.end - end))
        return [*shown, replace(span, begin=low, end=high)]

    def _span(self, piece, begin, end, later, effort):
        entry, angle = np.zeros(1, record("mw_first_certificate")), np.empty(1)
        library().mw_certify_first_along(
            self.drive.enclosed.model, pointer(self.state, "mw_wide[]"), piece, begin, end, self._turn("pinion", later),
            self._turn("wheel", later), pointer(self.flat), self.slack, self.reach, effort, pointer(self.work),
            pointer(entry, "mw_first_certificate[]"), pointer(angle),
        )  # fmt: skip
        (entry,) = entry
        overlap = -float(entry["apart"]["mid"] + entry["apart"]["radius"])
        return Span(
            later, begin, end, single.FirstCertificates.WORDS[entry["outcome"]], *_said(int(entry["reason"])),
            bool(entry["throughout"]), int(entry["parts"]), float(angle[0]), tuple(entry["wheel"].tolist()), overlap,
        )  # fmt: skip

    def _turn(self, member, later):
        """How far a member is turned on where a pair so many later is asked for, ``mw_wide``."""
        back = 1 if member == "pinion" or self.drive.ratio > 0.0 else -1
        count = -int(self.drive.design.mirror.sign) * back * later
        high, low, radius = exact.wide(*single.turned((0, 0), count, self.drive.teeth(member)))
        return ffi.new("mw_wide *", {"hi": high, "lo": low, "radius": radius})[0]


def _said(reason):
    """Word and sentence of a reason."""
    return text(library().mw_reason_word(reason)), text(library().mw_reason_text(reason))


def _spent(later, begin, end):
    """What is left when the budget of a pair is spent."""
    said = next(said for said in map(_said, range(256)) if said[0] == "effort")
    return Span(later, begin, end, "unknown", *said, False, 0, math.nan, (math.nan, math.nan), math.nan)


def _joined(spans):
    """Neighbours of which the same is shown as one; of failures what the first names."""
    joined = spans[:1]
    for span in spans[1:]:
        last = joined[-1]
        if (span.outcome, span.reason, span.throughout) == (last.outcome, last.reason, last.throughout):
            joined[-1] = replace(last, end=span.end, parts=last.parts + span.parts)
        else:
            joined.append(span)
    return joined
