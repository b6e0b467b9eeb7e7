"""First contact with a proof at every angle of a range: as the wheel comes up to the contact of a certified path, no
place of the one bounded flank meets one of the other's, nor do those of neighbouring pairs; or the angle and place
where one does.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from meshwright.base.library import ffi, library, pointer, record, text
from meshwright.contact import exact
from meshwright.contact.certified_path import CertifiedPath, certified_path
from meshwright.contact.model import DriveModel
from meshwright.cycle import certified_first as single

#: First and shortest range of angles looked at at once, in pinion pitches, and the longest of which an overlap at one
#: angle is said; the path is certified beyond both ends by ``BESIDE``, its transmission error to the share ``TUBE`` of
#: the slack.
FIRST, SHORTEST, NAMED, BESIDE, TUBE = 1.0, 2.0**-8, 2.0**-4, 1e-6, 0.02

#: Parts of the wheel's flank that a first range takes at most; those of a longer one as a multiple of the last one's.
MOST, FEWER = 4000, 3


@dataclass(frozen=True)
class Span:
    """What is shown from one angle to another, rad, of a pair so many ``later``: outcome and reason as of
    :class:`~meshwright.cycle.certified_first.FirstCertificates`. ``angle`` and ``wheel`` (2,), parameters of its flank:
    where it fails, NaN where it does not; ``overlap``: by how much the flanks surely overlap there, rad.
    """

    later: int
    begin: float
    end: float
    outcome: str
    reason: str
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
    pitch = drive.pitch()
    contacts = drive.tca(drive.design.mirror.sign * np.linspace(begin, end, single.ANGLES))
    boxes = single.ranges(drive, contacts.solutions, neighbours)
    slack = single.SLACK / float(np.nanmax(single.distances(drive, contacts))) * (1.0 - 1e-3)
    path = certified_path(drive, begin - BESIDE * pitch, end + BESIDE * pitch, tube=TUBE * slack)
    search = _Search(drive, boxes, slack, single.REACH * abs(drive.ratio) * pitch)
    pairs = sorted(range(-neighbours, neighbours + 1), key=abs)
    spans = []
    for later in pairs:
        for piece, (low, high) in zip(path.pieces, path.ends, strict=True):
            low, high = max(low, begin), min(high, end)
            spans += search.spans(piece, low, high, later) if low < high else []
    return FirstAlongPath(drive, begin, end, path, boxes, tuple(pairs), tuple(spans), slack, search.reach)


class _Search:
    """What calls of the library share."""

    def __init__(self, drive, boxes, slack, reach):
        self.drive, self.slack, self.reach = drive, slack, reach
        self.flat = np.array([end for box in boxes.values() for ends in box.values() for end in ends] or [0.0] * 8)
        self.work, self.state = np.empty(library().mw_certify_first_work()), drive.enclosed.state.copy()
        self.parts = None

    def spans(self, piece, begin, end, later):
        """Spans of a pair without a gap over a part of a piece."""
        pitch, found, angle = self.drive.pitch(), [], begin
        longest = {"first": math.inf, "not_first": NAMED, "unknown": SHORTEST}
        step, self.parts = FIRST * pitch, None
        while angle < end:
            to = end if end - angle < 1.5 * step else angle + step
            span = self._span(piece, angle, to, later)
            if to - angle > pitch * longest[span.outcome] and not span.throughout:
                step = 0.5 * (to - angle)
                continue
            found.append(span)
            self.parts = max(span.parts, 16) if span.outcome == "first" else None
            angle, step = to, 2.0 * (to - angle)
        return _joined(found)

    def _span(self, piece, begin, end, later):
        entry, angle = np.zeros(1, record("mw_first_certificate")), np.empty(1)
        effort = MOST if self.parts is None else FEWER * self.parts
        library().mw_certify_first_along(
            self.drive.enclosed.model, pointer(self.state, "mw_wide[]"), piece, begin, end, self._turn("pinion", later),
            self._turn("wheel", later), pointer(self.flat), self.slack, self.reach, effort, pointer(self.work),
            pointer(entry, "mw_first_certificate[]"), pointer(angle),
        )  # fmt: skip
        (entry,) = entry
        overlap = -float(entry["apart"]["mid"] + entry["apart"]["radius"])
        return Span(
            later, begin, end, single.OUTCOMES[entry["outcome"]], text(library().mw_reason_word(int(entry["reason"]))),
            bool(entry["throughout"]), int(entry["parts"]), float(angle[0]), tuple(entry["wheel"].tolist()), overlap,
        )  # fmt: skip

    def _turn(self, member, later):
        """How far a member is turned on where a pair so many later is asked for, ``mw_wide``."""
        back = 1 if member == "pinion" or self.drive.ratio > 0.0 else -1
        count = -int(self.drive.design.mirror.sign) * back * later
        high, low, radius = exact.wide(*single.turned((0, 0), count, self.drive.teeth(member)))
        return ffi.new("mw_wide *", {"hi": high, "lo": low, "radius": radius})[0]


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
