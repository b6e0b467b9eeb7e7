"""Certified paths: one branch of contact over a range of angles without a gap, as polynomials with an error bound, and
what follows from them: bounds of the transmission error, of its peak-to-peak value and of the ends of contact.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import ffi, library, pointer, text
from meshwright.contact.analysis import largest_angle, trace
from meshwright.contact.certificate import OUTCOMES, ProvedModel
from meshwright.contact.results import ARCSEC

#: Pieces shorter than this share of the range are not tried: there the branch is singular or ends.
SHORTEST = 2.0**-14

#: The same of pieces in which the formula of a flank changes, or that follow such a one: about a kink of the path no
#: polynomial is nearer than what the contact moves there.
SHORTEST_AT_KINKS = 2.0**-32

#: Widest half-width of the tube of transmission error about its polynomial, rad: 5e-8 arcseconds.
TUBE = 5e-8 * ARCSEC

#: Halvings of a path for bounds of its error, of a piece at least, and of an angle's bracket.
DEPTH, LEAST_DEPTH, BRACKET = 10, 3, 40


@dataclass(frozen=True)
class Gap:
    """Angles (rad) over which no branch is shown, and why."""

    begin: float
    end: float
    reason: str


@dataclass(frozen=True)
class CertifiedPath:
    """A branch of contact from ``begin`` to ``end``, rad, of the right-hand drive.

    At every angle that no gap holds, the equations have a solution within the radius of a piece's polynomials and no
    other within its box; at each joint both pieces hold the same one. So where there is no gap it is one branch,
    without turning point or crossing, smooth but where the formula of a flank changes.
    """

    drive: ProvedModel
    begin: float
    end: float
    pieces: tuple
    ends: tuple[tuple[float, float], ...]
    gaps: tuple[Gap, ...]

    @property
    def complete(self):
        """Whether there is no gap."""
        return not self.gaps

    @property
    def tube(self):
        """Largest half-width of the transmission error about its polynomial, rad."""
        index = self.drive.design.description["error"]
        return max((piece.x[index].radius for piece in self.pieces), default=math.nan)

    def within(self, begin, end):
        """The part of the path between two of its angles."""
        kept = [
            (piece, (max(low, begin), min(high, end)))
            for piece, (low, high) in zip(self.pieces, self.ends, strict=True)
            if max(low, begin) < min(high, end)
        ]
        return replace(self, begin=begin, end=end, pieces=tuple(k[0] for k in kept), ends=tuple(k[1] for k in kept))

    def _piece(self, angle):
        for piece, (low, high) in zip(self.pieces, self.ends, strict=True):
            if low <= angle <= high:
                return piece
        raise ValueError(f"no piece of the path holds {angle} rad")

    def error(self, angle):
        """Bounds of the transmission error at an angle of the path, rad."""
        return self._error(self._piece(angle), angle)

    def error_between(self, begin, end):
        """Bounds of the transmission error at every angle from one to another of the path, rad."""
        return self.within(begin, end).error_range

    def _error(self, piece, angle):
        ball = library().mw_piece_at(piece, ffi.addressof(piece.x[self.drive.design.description["error"]]), angle)
        return math.nextafter(ball.mid - ball.radius, -math.inf), math.nextafter(ball.mid + ball.radius, math.inf)

    def _depth(self, low, high):
        """Halvings of a piece between two angles, by which the whole path is halved DEPTH times."""
        return max(LEAST_DEPTH, DEPTH - int(math.log2((self.end - self.begin) / (high - low))))

    def _range(self, piece, polynomial, low, high, depth):
        bounds = np.empty(2)
        library().mw_piece_range(piece, ffi.addressof(polynomial), low, high, depth, pointer(bounds))
        return tuple(bounds.tolist())

    @cached_property
    def error_range(self):
        """Bounds between which the transmission error stays along the whole path, rad."""
        index = self.drive.design.description["error"]
        ranges = [
            self._range(piece, piece.x[index], *ends, self._depth(*ends))
            for piece, ends in zip(self.pieces, self.ends, strict=True)
        ]
        return min(r[0] for r in ranges), max(r[1] for r in ranges)

    @cached_property
    def peak_to_peak(self):
        """Bounds of the peak-to-peak transmission error over the path, rad."""
        low, high = self.error_range
        found = [
            self._error(piece, angle)
            for piece, ends in zip(self.pieces, self.ends, strict=True)
            for angle in np.linspace(*ends, 2 ** self._depth(*ends) + 1).tolist()
        ]
        least = max(f[0] for f in found) - min(f[1] for f in found)
        return max(0.0, math.nextafter(least, -math.inf)), math.nextafter(high - low, math.inf)

    def first_exit(self, start, direction):
        """Where the first margin is lost from ``start`` on: (event, low, high), angles in rad; None within the path.

        Between ``start`` and the nearer of both angles every margin is shown to be positive, and that of the event is
        shown to be negative at the other. Where no margin is shown to be either, the two are as far apart as that goes.
        """
        order = range(len(self.pieces)) if direction > 0 else range(len(self.pieces) - 1, -1, -1)
        held = None
        for k in order:
            low, high = self.ends[k]
            near, far = (max(low, start), high) if direction > 0 else (min(high, start), low)
            if (far - near) * direction <= 0.0:
                continue
            piece = self.pieces[k]
            # the design sets no limit where a margin is infinite
            margins = [i for i in range(piece.margins) if math.isfinite(piece.margin[i].c[0])]
            if held is None:
                angles = [self._until(piece, piece.margin[i], near, far) for i in margins]
                held = near = min((a for a in angles if a is not None), key=lambda a: direction * a, default=None)
                if held is None:
                    continue
            lost = [(self.event(i), self._lost(piece, piece.margin[i], near, far)) for i in margins]
            lost = [(event, angle) for event, angle in lost if angle is not None]
            if lost:
                event, angle = min(lost, key=lambda found: direction * found[1])
                return event, held, angle
        return None

    def _lost(self, piece, polynomial, near, far):
        """An angle from ``near`` to ``far`` where a margin is surely negative, close to the first; None if none is."""
        for halvings in range(BRACKET, -1, -1):
            angle = near + (far - near) * 0.5**halvings if halvings else far
            ball = library().mw_piece_at(piece, ffi.addressof(polynomial), angle)
            if ball.mid + ball.radius < 0.0:
                return angle
        return None

    def _until(self, piece, polynomial, near, far):
        """The angle up to which a margin is surely positive, None if it is as far as ``far``."""
        if self._range(piece, polynomial, min(near, far), max(near, far), 6)[0] > 0.0:
            return None
        for _ in range(BRACKET):
            middle = near + 0.5 * (far - near)
            if self._range(piece, polynomial, min(near, middle), max(near, middle), 6)[0] > 0.0:
                near = middle
            else:
                far = middle
        return near

    def event(self, i):
        """(member, event) of a margin of the pieces by its number."""
        for body in self.drive.design.description["bodies"]:
            events = ["undercut", *(margin["event"] for margin in body["margins"])]
            if i < len(events):
                return body["name"], events[i]
            i -= len(events)
        raise IndexError(i)


def certified_path(drive, begin, end, tube=TUBE, longest=math.inf):
    """The :class:`CertifiedPath` of the drive from one angle to another, rad, of the right-hand drive.

    Its pieces are at most ``longest``, rad, and such that the transmission error stays within ``tube`` of them, rad.
    """
    refuse_empty(begin, end)
    nodes = np.empty(9)
    library().mw_piece_nodes(pointer(nodes))
    pieces, ends, gaps = [], [], []
    angle, step, least = begin, min(longest, end - begin), 0.0
    while angle < end:
        to = min(end, angle + step)
        piece, reason = _piece(drive, nodes, angle, to, tube)
        if not reason and pieces and ends[-1][1] == angle:
            joined = library().mw_pieces_join(drive.enclosed.model, pieces[-1], piece, angle)
            reason = "" if joined else "joint"
        if not reason:
            pieces.append(piece)
            ends.append((angle, to))
            angle, step, least = to, min(longest, 2.0 * (to - angle)), 0.0
        elif to - angle > max(least, (end - begin) * _shortest(piece, pieces)):
            step = 0.5 * (to - angle)
        else:
            _extend(gaps, angle, to, reason)
            least = 2.0 * (to - angle)  # a long gap is not searched through in short steps
            angle, step = to, min(longest, least)
    return CertifiedPath(drive, begin, end, tuple(pieces), tuple(ends), tuple(gaps))


def _shortest(piece, before):
    """Below which share of the range a piece after those ``before`` is not halved."""
    return SHORTEST_AT_KINKS if piece.kinks or (before and before[-1].kinks) else SHORTEST


def refuse_empty(begin, end):
    """Raise :class:`~meshwright.base.errors.UsageError` unless two angles, rad, are the ends of a path."""
    most = largest_angle()
    if not (all(isinstance(angle, int | float | np.number) for angle in (begin, end)) and -most <= begin < end <= most):
        raise UsageError(f"begin = {begin}, end = {end}: give the smaller angle first, none beyond {most:g} rad")


def _extend(gaps, begin, end, reason):
    if gaps and gaps[-1].end == begin and gaps[-1].reason == reason:
        begin = gaps.pop().begin
    gaps.append(Gap(begin, end, reason))


def _piece(drive, nodes, begin, end, tube):
    """A piece and why it does not hold, "" if it does."""
    angles = 0.5 * (begin + end) + 0.5 * (end - begin) * nodes
    x, found = trace(drive, angles)
    piece = ffi.new("mw_piece *")
    if np.any(found["status"] < 0):
        return piece, "no_contact"
    state = drive.enclosed.state
    library().mw_certify_piece(drive.enclosed.model, pointer(state, "mw_wide[]"), begin, end, pointer(x), piece)
    if OUTCOMES[piece.outcome] != "unique":
        return piece, text(library().mw_reason_word(piece.reason))
    return piece, "" if piece.x[drive.design.description["error"]].radius <= tube else "tube"


