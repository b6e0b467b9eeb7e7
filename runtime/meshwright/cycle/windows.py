"""The window of contact of one tooth pair: where it begins, where it ends, and what limits it there."""

import math
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from meshwright.base.roots import bracketed
from meshwright.contact.branch import fold_angle
from meshwright.contact.results import TOUCHING
from meshwright.cycle.bounded import rigid_contact
from meshwright.cycle.first_results import STATUSES
from meshwright.cycle.line_windows import line_ends
from meshwright.cycle.path import SHORT_OF_FOLD, Path
from meshwright.cycle.search import Search

#: Events are located to this angle, rad.
ANGLE_TOLERANCE = 1e-10

#: The search goes on this many pitches at a time.
CHUNK = 2

#: Nodes about the place that comes nearest to the flanks, where none lies on them: a window shorter than a share of
#: 1/256 of the pitch is none.
FINER = 33

#: Events beyond which a member has no more tooth.
TIPS = ("tip", "throat")


@dataclass(frozen=True)
class Event:
    """What limits contact at one end: the pinion ``angle`` (rad, NaN if nothing does), the reason and the member.

    ``reason`` is one of tip, throat, face, root, tool_end, undercut, regression, fold, none.
    """

    angle: float
    reason: str
    member: str | None

    @property
    def exists(self):
        return math.isfinite(self.angle)


NO_EVENT = Event(math.nan, "none", None)


@dataclass(frozen=True)
class Limit:
    """A function along the path that is negative outside the flanks: where it stands in the observation."""

    member: str
    reason: str
    index: int


@dataclass(frozen=True)
class Window:
    """Contact of one pair from ``begin`` to ``end``, in the order in which the driving pinion turns.

    ``path`` is the branch of contact, right-hand drive, continued beyond the window; it is None where there is none
    that comes onto both flanks, and ``status`` is the status word in its middle. Contact along lines, and at an end of
    one, has no path but may begin and end.
    """

    begin: Event
    end: Event
    path: Path | None
    status: str = "converged"

    @property
    def complete(self):
        """Whether both ends exist."""
        return self.begin.exists and self.end.exists

    @property
    def span(self):
        """Pinion angle from begin to end, rad; NaN if an end does not exist."""
        return abs(self.end.angle - self.begin.angle)

    @property
    def bounds(self):
        """Smaller and larger angle of the window, rad, right-hand drive like ``path``; infinite where no event is."""
        sign = _mirror(self.path.drive)
        angles = [sign * e.angle for e in (self.begin, self.end)]
        if _descending(self.path.drive):
            angles.reverse()
        return tuple(a if math.isfinite(a) else end for a, end in zip(angles, (-math.inf, math.inf), strict=True))


def contact_window(drive):
    """The :class:`Window` of a drive's tooth pair: the stretch of its path inside every limit, nearest to angle 0."""
    path, status = drive.path_start
    limits = limits_of(drive)
    if path is None:
        return _of_lines(drive, limits) or Window(NO_EVENT, NO_EVENT, None, status_at(drive, 0.0, status))
    path = _searched(path, limits)
    if not (_worst(path, limits) >= 0.0).any():
        path = _closer(path, limits)
    ends = _ends(path, limits)
    if ends is None:
        if (found := _of_lines(drive, limits)) is not None:
            return found
        if _past_the_tips(path, limits):
            return Window(NO_EVENT, NO_EVENT, None, status_at(drive, drive.design.reference_angle, "no_contact"))
        return Window(NO_EVENT, NO_EVENT, path)
    return Window(*_in_order(drive, ends), _with_margin(path, ends))


def _of_lines(drive, limits):
    """The window of contact along lines or at an end of them; None if no line comes onto both flanks."""
    ends = tuple(NO_EVENT if e is None else Event(e[0], e[1].reason, e[1].member) for e in line_ends(drive, limits))
    middle = 0.5 * (ends[0].angle + ends[1].angle)
    if not math.isfinite(middle):
        return None
    (status,) = rigid_contact(drive, np.array([_mirror(drive) * middle])).status
    return Window(*_in_order(drive, ends), None, status) if status in TOUCHING else None


def status_at(drive, angle, otherwise):
    """Status word of the bounded flanks at an angle of the right-hand drive; ``otherwise`` where that is not known."""
    search, _ = Search.of(drive)
    (kind,) = (None,) if search is None else search.first(np.array([_mirror(drive) * angle])).kinds
    return STATUSES.get(kind, otherwise)


def past_the_tips(drive):
    """Whether the pair's path of contact lies past a tip everywhere: the teeth do not reach each other.

    Where the path has a stretch between both tips, a point beyond it is a contact off the tip.
    """
    path, _ = drive.path_start
    return path is not None and _past_the_tips(path, limits_of(drive))


def inside_the_tips(drive):
    """Pinion angle of the right-hand drive, rad, where the pair's contact is farthest inside the tips.

    None if its path of contact is past them everywhere, or there is none.
    """
    path, _ = drive.path_start
    tips = _tips(limits_of(drive))
    if path is None or not tips:
        return None
    path = _searched(path, tips)
    worst = _worst(path, tips)
    return float(path.angles[np.argmax(worst)]) if worst.max() >= 0.0 else None


def _tips(limits):
    return [limit for limit in limits if limit.reason in TIPS]


def _past_the_tips(path, limits):
    tips = _tips(limits)
    if not tips:
        return False
    path = _searched(path, tips)
    return not (_worst(path, tips) >= 0.0).any() and not (_worst(_closer(path, tips), tips) >= 0.0).any()


def _closer(path, limits):
    """The path with more nodes about that where its limits are least exceeded."""
    best = int(np.argmax(_worst(path, limits)))
    low, high = path.angles[[max(best - 1, 0), min(best + 1, len(path.angles) - 1)]]
    angles = np.setdiff1d(np.linspace(low, high, FINER), path.angles)
    order = np.argsort(np.concatenate([path.angles, angles]))
    return replace(
        path,
        angles=np.concatenate([path.angles, angles])[order],
        unknowns=np.concatenate([path.unknowns, path.solve(angles)])[order],
    )


def _in_order(drive, ends):
    """Begin and end, as the user counts angles, of the lower and upper event of the right-hand drive."""
    sign = _mirror(drive)
    lower, upper = (Event(sign * e.angle, e.reason, e.member) for e in ends)
    return (upper, lower) if _descending(drive) else (lower, upper)


def limits_of(drive):
    """Every limit of both members: the margins of the design and the singular lines of the flanks."""
    limits = []
    for body in drive.design.description["bodies"]:
        limits.append(Limit(body["name"], "undercut", body["regular"]))
        for i, margin in enumerate(body["margins"]):
            limits.append(Limit(body["name"], _reason(margin["event"]), body["margin"] + i))
    return limits


def _reason(event):
    """The sheet of an envelope turns over into a spurious one: a fold."""
    return "fold" if event == "spurious_sheet" else event


def _mirror(drive):
    return drive.design.mirror.sign


def _descending(drive):
    """Whether, in the right-hand drive, begin is the larger angle: the flank that drives for negative angles."""
    return drive.design.flank < 0 and not drive.design.description["ascending_path"]


def _worst(path, limits, nodes=slice(None)):
    """The smallest limit function at every node, or at some; limits that the design leaves open do not count.

    Where the flanks have no point, none of their limits holds.
    """
    observed = path.observe(path.angles[nodes], path.unknowns[nodes])
    values = observed[:, [limit.index for limit in limits]]
    return np.where(np.isnan(observed[:, 0]), -np.inf, np.where(np.isnan(values), np.inf, values).min(axis=1))


def _searched(path, limits):
    """The path followed both ways until contact has left the flanks again, but no further than half a wheel turn."""
    farthest, worst = math.pi / path.drive.ratio, _worst(path, limits)
    for sign in (1.0, -1.0):
        while _goes_on(path, worst, sign, farthest):
            here, known = path.angles[-1 if sign > 0 else 0], len(path.angles)
            path = path.extended(here + sign * min(CHUNK * path.drive.pitch(), farthest - sign * here))
            new = slice(known, None) if sign > 0 else slice(0, len(path.angles) - known)
            worst = np.concatenate([worst, _worst(path, limits, new)][:: int(sign)])
    return path


def _with_margin(path, ends):
    """The path continued a pitch beyond either end, where neighbours are compared, or up to the fold that ends it."""
    pitch = path.drive.pitch()
    for event, sign in zip(ends, (-1.0, 1.0), strict=True):
        side = -1 if sign > 0 else 0
        to = event.angle + sign * pitch * (-SHORT_OF_FOLD if path.ended[side] else 1.0)
        if event.exists and sign * path.angles[side] < sign * to:
            path = path.extended(to)
    return path


def _goes_on(path, worst, sign, farthest):
    side = -1 if sign > 0 else 0
    if path.ended[side] or sign * path.angles[side] >= farthest * (1.0 - 1e-12):
        return False
    return worst[side] >= 0.0 or not (worst >= 0.0).any()


def _ends(path, limits):
    """Lower and upper event of the stretch of valid nodes nearest to the reference angle; None if there is none."""
    stretch = _nearest_stretch(path.angles, _worst(path, limits) >= 0.0, path.drive.design.reference_angle)
    if stretch is None:
        return None
    first, last = stretch
    lower = _locate(path, limits, first, first - 1) if first > 0 else _branch_end(path, 0)
    upper = _locate(path, limits, last, last + 1) if last + 1 < len(path.angles) else _branch_end(path, -1)
    return lower, upper


def _nearest_stretch(angles, valid, about):
    edges = np.flatnonzero(np.diff(np.concatenate(([False], valid, [False])).astype(int)))
    stretches = [(int(a), int(b) - 1) for a, b in zip(edges[::2], edges[1::2], strict=True)]
    if not stretches:
        return None
    return min(stretches, key=lambda s: max(angles[s[0]] - about, about - angles[s[1]], 0.0))


def _locate(path, limits, inside, outside):
    """The first limit on the way from a valid node to an invalid neighbour; none where that is no point of the flanks.

    Where contact is along a line but for errors near round-off, its place on it differs from one solution to the next:
    a limit may then be passed at the valid node already.
    """
    angles = path.angles[[inside, outside]]
    values = path.observe(angles, path.unknowns[[inside, outside]])
    crossed = []
    for limit in limits:
        at_ends = values[:, limit.index]
        if at_ends[1] < 0.0:
            function, passed = partial(_value, path, limit), not at_ends[0] > 0.0
            at = angles[0] if passed else bracketed(function, *angles, ANGLE_TOLERANCE, tuple(at_ends))
            crossed.append((at, limit))
    if not crossed:
        return NO_EVENT
    angle, limit = min(crossed, key=lambda c: abs(c[0] - angles[0]))
    return Event(float(angle), limit.reason, limit.member)


def _value(path, limit, angle):
    return path.observe([angle])[0, limit.index]


def _branch_end(path, side):
    """What ended the branch itself: a fold, where it turns back, or nothing that can be named."""
    if not path.ended[side]:
        return NO_EVENT
    angle = fold_angle(path, side)
    return NO_EVENT if angle is None else Event(angle, "fold", None)
