"""The search for first contacts of a drive, angle by angle, and for lines along which its flanks touch."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from meshwright.base.library import ffi, library, pointer, record
from meshwright.contact.placement import placed, placements_at
from meshwright.cycle.first_results import OPEN_ENDED, UNKNOWN, event_of, gathered
from meshwright.cycle.searched_flank import SearchedFlank, start_values
from meshwright.cycle.touching_line import TouchingLine, unknowns_at
from meshwright.flank.model import DriveModel

#: Turn of the wheel by which its sense of rotation is read off, rad.
TURN = 0.01

#: Which of the known contacts, by distance in angle, the search starts from until one leads to the angle asked for.
STARTS = (0, 1, 2, 4, 8, 16, 32)

#: Between two angles what leads at them and at one between is followed, not searched for, where that is shown to lead:
#: over this share of a pitch at most.
STRETCH = 0.125

#: And where there are more than so many angles between.
FEWEST_BETWEEN = 6

#: First contacts that are kept of a drive: more are those of long ranges, which nobody asks for twice.
KEPT = 20_000

#: What the search of one angle resolves, mm along the normal: RESOLUTION of runtime/c/first/cover.h.
RESOLUTION = 1e-4

#: Flanks that stand apart by more beside a place of first contact, mm, are level along no curve through it.
CLEARLY_APART = 1e-6

#: Of more known contacts, one for each step of the pinion is enough to choose from.
MANY = 512

#: Searches that come to the angle and find places, but no extreme of them, or no place, before it is given up.
SEARCHES = 2

#: What stands for the ridge of the wheel's turn as a start.
RIDGE = object()

#: Over how many pitches it is followed from where it is known.
RIDGE_REACH = 4.0

#: Into how many parts a step is divided in which it is lost.
RIDGE_PARTS = (1, 4)

#: In which steps it is sought, in pitches.
RIDGE_SOUGHT = 0.25

#: And in how many to either side of the reference angle.
RIDGE_LOOKS = 8

#: A place further inside the other flank than this, mm, where flanks touch along a line, is before it.
OVERLAP = 1e-9

#: Flanks that stand apart by no more than this all along a curve, mm along the normal, touch along it; the last places
#: of a position, which rounding takes, included.
FLAT = 1.001e-9

#: The share of that which is left on the level part of a curve that falls off at its ends.
LEVEL = 0.01

#: A step to either side along a curve to see whether it is level at all, in natural sizes.
NEAR = 0.05

#: Steps along a curve, in natural sizes.
STEP = 0.125

#: By what share of these steps a line is followed more closely, where a proof needs it.
CLOSER = 0.25

#: Most steps to either side.
POINTS = 240

#: The fewest points that show where a curve is level.
LEAST_LEVEL = 5

#: Where the geometry in an observation has the larger principal curvature of the gap.
LARGER_CURVATURE = 16

#: Steps of the pinion from an angle at which a contact is known, per pitch.
STEPS_PER_PITCH = 24


@dataclass(frozen=True)
class Searched:
    """The search at an ``angle``: what it ``found``, as :meth:`Search.at` gives it, the ``last`` ``mw_first`` that C
    gave, and what that has looked at.
    """

    angle: float
    found: object
    last: object
    met: object

    @property
    def held(self):
        """Status, limits, their members, whether flanks are open; None where C has not looked at all of the flank."""
        last, lib = self.last, library()
        if last is None or self.met is None or (last.status < 0 and last.status != lib.MW_NO_CONTACT):
            return None
        if self.found is UNKNOWN or (last.status < 0) != (self.found in (None, OPEN_ENDED)):
            return None
        return last.status, tuple(last.limit), tuple(last.member), self.found is OPEN_ENDED


@dataclass(frozen=True)
class Search:
    """First contacts of a drive: the wheel's ``flank`` and what the search starts from: ``solutions`` (N, nx) at
    angles ``solved_at``.
    """

    drive: DriveModel
    flank: SearchedFlank
    work: np.ndarray
    solutions: np.ndarray
    solved_at: np.ndarray
    turn: float
    sense: float

    @classmethod
    def of(cls, drive, angles=(), solutions=()):
        """The search, or None and why there is none; solutions (N, nx) of contacts at angles (N,), right hand."""
        flank = drive.searched_flank
        if flank is None:
            return None, "no part of the wheel's flank lies within its limits"
        solutions = np.concatenate([flank.solutions, np.reshape(solutions, (len(angles), drive.model.nx))])
        angles = np.concatenate([flank.angles, angles])
        known = np.isfinite(solutions).all(axis=1)
        solutions, angles = solutions[known], angles[known]
        regular = _on_regular_flanks(drive, solutions)
        if regular.any():
            solutions, angles = solutions[regular], angles[regular]
        at, here = (solutions, angles) if len(angles) else (start_values(drive, np.zeros(1)), np.zeros(1))
        middle = int(np.argmin(np.abs(here)))
        turn, sense = _senses(drive, here[middle], at[middle])
        sizes = library().mw_first_contact_work(flank.table.vertices), library().mw_first_curve_work(POINTS)
        work = np.empty(max(sizes))
        return cls(drive, flank, work, solutions, angles, turn, sense), ""

    @cached_property
    def lasting_work(self):
        """What ``mw_first_lasts`` works in."""
        return np.empty(library().mw_first_lasts_work())

    def at(self, angles, until=None):
        """``mw_first``, None, UNKNOWN or OPEN_ENDED at angles (N,) of the right-hand drive; beyond the turn of the
        wheel ``until``, perhaps of a later contact.
        """
        if until is not None:
            return [self._one(angle, until)[0] for angle in angles]
        known, angles = self.flank.found, np.asarray(angles, dtype=float).tolist()
        if len(known) > KEPT:
            known.clear()
        new = np.array(sorted(set(angles).difference(known)))
        known |= zip(new.tolist(), self._all(new), strict=True)
        return [known[angle] for angle in angles]

    def _all(self, angles):
        """The same at ascending angles: searched for at some, followed from these where what they have surely leads."""
        found: list = [None] * len(angles)

        def between(low, high, begin, end):
            if high - low < 2:
                return
            middle = (low + high) // 2
            here = self._node(angles[middle], high - low > FEWEST_BETWEEN)
            followed = None
            if high - low > FEWEST_BETWEEN and self._lasts(begin, here, end):
                followed = self._along((begin, here, end), angles[low + 1 : high])
            if followed is None:
                between(low, middle, begin, here)
                between(middle, high, here, end)
            else:
                found[low + 1 : high] = followed
            found[middle] = here.found

        ends = [self._node(angles[k], len(angles) > FEWEST_BETWEEN) for k in ((0, -1) if len(angles) else ())]
        if ends:
            found[0], found[-1] = (node.found for node in ends)
            between(0, len(angles) - 1, *ends)
        return found

    def _node(self, angle, kept):
        """The search at an angle; ``kept``: with what it has looked at."""
        found, last = self._one(angle, -self.sense * math.inf)
        met = self.work[: library().mw_first_met_size(self.flank.table.vertices)].copy() if kept else None
        return Searched(angle, found, last, met)

    def _lasts(self, *nodes):
        """Whether what three searches found leads at every angle between them."""
        begin, middle, end = (node.angle for node in nodes)
        if end - begin > STRETCH * self.drive.pitch() or len({node.held for node in nodes}) != 1:
            return False
        if nodes[0].held is None:
            return False
        stand = _matrices(self.drive, np.array([begin, middle, end]))
        three, met = ffi.new("mw_first[3]"), ffi.new("double *[3]", [pointer(node.met) for node in nodes])
        for k, node in enumerate(nodes):
            three[k] = node.last[0]
        return bool(
            library().mw_first_lasts(
                *self._model, *map(pointer, stand), (middle - begin) / (end - begin), self.turn, self.sense, met, three,
                pointer(self.lasting_work),
            )  # fmt: skip
        )

    def _along(self, nodes, angles):
        """What :meth:`at` gives at ascending angles between three searches that have what leads there; None where it
        is not where they say it is.
        """
        if nodes[0].found in (None, OPEN_ENDED):
            return [nodes[0].found] * len(angles)
        stand = _matrices(self.drive, angles)
        records, n = np.zeros(len(angles), record("mw_first")), len(angles)
        library().mw_first_along(
            *self._model, *map(pointer, stand), n, self.turn, self.sense, nodes[0].last, pointer(records, "mw_first[]"),
        )  # fmt: skip
        at, turns = np.array([node.angle for node in nodes]), [node.last.wheel_turn for node in nodes]
        parabola = sum(
            turn * np.prod([(angles - other) / (own - other) for other in at if other != own], axis=0)
            for own, turn in zip(at, turns, strict=True)
        )
        good = (records["status"] >= 0) & (
            np.abs((records["wheel_turn"] - parabola) * records["lever"]) <= 0.5 * RESOLUTION
        )
        for name in ("limit", "member"):
            good &= (records[name] == list(getattr(nodes[0].last, name))).all(axis=1)
        records["unresolved"] = max(node.last.unresolved for node in nodes)
        many = ffi.from_buffer("mw_first[]", records)
        return [ffi.new("mw_first *", many[k]) for k in range(len(angles))] if good.all() else None

    def _one(self, angle, until):
        """As :meth:`at` at one angle, and the last ``mw_first`` that C gave: from a contact known there, the start
        values, other contacts and, where no contact is one in a point of both flanks, the ridge.
        """
        away = np.abs(self.solved_at - angle)
        order = np.argsort(away, kind="stable")
        steps = np.floor(away[order] / self.drive.pitch() * STEPS_PER_PITCH)  # of those that are close together, one
        order = order[np.unique(steps, return_index=True)[1]] if len(order) > MANY else order
        starts = [(self.solved_at[k], self.solutions[k]) for k in order[[i for i in STARTS if i < len(order)]]]
        starts.insert(int(bool(starts) and starts[0][0] == angle), (angle, None))
        ended, empty, found = 0, 0, None
        for known_at, x in (*starts, *([(angle, RIDGE)] if self.flank.pointless else [])):
            if x is RIDGE:
                depth, place = self._ridge(float(angle))
                if math.isnan(depth):
                    break
                x = unknowns_at(self.drive, place)
            elif SEARCHES in (ended, empty):
                continue
            found = self._from(known_at, start_values(self.drive, [angle])[0] if x is None else x, angle, until)
            if found.status >= 0:
                return found, found
            if found.open:
                return OPEN_ENDED, found
            nowhere = found.status == library().MW_NO_CONTACT
            if nowhere and found.met:
                return None, found
            ended, empty = ended + (found.met > 0), empty + nowhere
        return UNKNOWN if ended else None, found

    def _from(self, known_at, x, angle, until):
        pinion, wheel = self._way(known_at, angle - known_at)
        start = np.concatenate([x[b["unknowns"]] for b in self.drive.design.description["bodies"][::-1]])
        start = np.append(start, x[self.drive.design.description["error"]])
        found = ffi.new("mw_first *")
        library().mw_first_contact(
            *self._model, pointer(pinion), pointer(wheel), len(pinion), self.turn,
            self.sense, pointer(start), until, pointer(self.work), found,
        )  # fmt: skip
        return found

    @property
    def _model(self):
        """The compiled model, the design's state and the wheel's flank, for C."""
        return self.drive.design.model, pointer(self.drive.design.state), self.flank.table

    def _way(self, known_at, away):
        """Placements (M, 12) of both members from an angle to another one, ``away`` from it."""
        steps = 1 + math.ceil(abs(away) / self.drive.pitch() * STEPS_PER_PITCH - 1e-9)
        return _matrices(self.drive, known_at + away * (np.linspace(0.0, 1.0, steps) if steps > 1 else np.ones(1)))

    def first(self, angles):
        """:class:`~meshwright.cycle.first_results.FirstContacts` at pinion angles (N,), with the design's hand."""
        own = self.drive.design.mirror.sign * angles
        found = self.at(own)
        return gathered(self.drive, angles, found, self.lines(own, found))

    def lines(self, angles, found):
        """The :class:`TouchingLine` through each of ``found`` at angles (N,), None where there is none."""
        without = (None, UNKNOWN, OPEN_ENDED)
        return [
            None if f in without or f.apart > CLEARLY_APART else self.line(angle, f)
            for angle, f in zip(angles, found, strict=True)
        ]

    def line(self, angle, found, flat=False):
        """The :class:`TouchingLine` through a place, along which the wheel angle is one but for 1e-9 mm: of both
        flanks, or of one of the edges that hold it; None if there is none. ``flat``: the equations of contact are
        singular there, so that also a part of the curve can be one, where the flanks fall back from one another at its
        ends.
        """
        borders = [(found.member[k], found.limit[k]) for k in (0, 1) if found.limit[k] >= 0]
        for member, limit in ((0, -1), *borders):
            closely = self._curve(angle, found, member, limit, NEAR, math.inf, 1)
            if not len(closely) or _spread(closely) > FLAT:
                continue
            whole = self._curve(angle, found, member, limit, STEP, math.inf, POINTS)
            whole_way = len(whole) > 1 and not _spread(whole) > FLAT
            if flat and limit < 0 and not whole_way:
                whole = self._curve(angle, found, member, limit, STEP, FLAT, POINTS)
                whole_way = _level_inside(whole)
            if whole_way:
                return self._of_places(angle, whole, limit < 0)
        return None

    def ever_closer(self, line, shares=(CLOSER,)):
        """A :class:`TouchingLine` of both flanks, right hand, then the same by points at these shares of its steps."""
        yield line
        for share in shares:
            at = line.middle
            yield self._of_places(line.angle, self._curve(line.angle, at, 0, -1, share * STEP, math.inf, POINTS), True)

    def rise(self, angle, found):
        """How far the flanks stand apart at one end of the ridge of the wheel's turn while they touch at the other, mm;
        NaN where no part of it lies on both.
        """
        ridge = self._curve(angle, found, 0, -1, STEP, math.inf, POINTS)
        return _spread(ridge) if len(ridge) > 1 else math.nan

    def of_solution(self, angle, x):
        """The line of both flanks through a solution (nx,) at an angle, which may lie beyond them; None if there is
        none.
        """
        return self.line(angle, self._place(x), flat=True)

    def depth(self, angle):
        """How deep inside the limits the ridge of the wheel's turn comes at an angle, in the unit of the limit that it
        is nearest to, and (member, event) of that one and of another as near; NaN where no ridge is found.
        """
        depth, found = self._ridge(float(angle))
        bodies = self.drive.design.description["bodies"]
        held = [(found.member[k], found.limit[k]) for k in (0, 1) if found.limit[k] >= 0]
        return depth, tuple((bodies[m]["name"], event_of(bodies, m, limit)) for m, limit in held)

    def _ridge(self, angle):
        """Depth and place of the ridge at an angle: from the start values there or, where they do not lead to it, from
        the nearest of some fixed angles at which they do, step by step; what was asked before changes nothing.
        """
        step, reference = RIDGE_SOUGHT * self.drive.pitch(), self.drive.design.reference_angle
        around = (reference + k * step for k in range(-RIDGE_LOOKS, RIDGE_LOOKS + 1))
        found = self._sought(angle)
        for at in sorted(around, key=lambda at: abs(at - angle)):
            if found is None and self._sought(at) is not None:
                found = self._followed(at, angle)
                break
        return found or (math.nan, ffi.new("mw_first *", {"limit": (-1, -1)}))

    def _sought(self, angle):
        """Depth and place of the ridge to which the start values at an angle lead; None if to none."""
        known = self.flank.ridges
        if angle not in known:
            if len(known) > KEPT:
                known.clear()
            depth, found = self._deepest(angle, self._place(start_values(self.drive, [angle])[0]))
            known[angle] = None if math.isnan(depth) else (depth, found)
        return known[angle]

    def _followed(self, begin, angle):
        """The same at an angle, followed from one at which start values lead to it; places on the way are kept."""
        pitch, side = self.drive.pitch(), math.copysign(1.0, angle - begin)
        if abs(angle - begin) > RIDGE_REACH * pitch:
            return None
        steps = int(abs(angle - begin) / pitch * STEPS_PER_PITCH)
        passed = self.flank.passed.setdefault((begin, side), [self._sought(begin)])
        places = [begin + side * k * pitch / STEPS_PER_PITCH for k in range(steps + 1)]
        while len(passed) <= steps and passed[-1] is not None:
            passed.append(self._stepped(passed[-1], *places[len(passed) - 1 : len(passed) + 1]))
        last = passed[min(steps, len(passed) - 1)]
        return last and self._stepped(last, places[steps], angle)

    def _stepped(self, last, begin, end):
        """The same a step further, in one or, where it is lost on the way, in shorter ones."""
        for parts in RIDGE_PARTS:
            depth, found = last
            for at in np.linspace(begin, end, 1 + parts)[1:]:
                depth, found = self._deepest(at, found)
                if math.isnan(depth):
                    break
            else:
                return depth, found
        return None

    def _deepest(self, angle, start):
        """Depth and place of ``mw_first_deepest`` from another place at an angle."""
        depth, found = ffi.new("double *", math.nan), ffi.new("mw_first *")
        pinion, wheel = self._way(angle, 0.0)
        library().mw_first_deepest(
            *self._model, pointer(pinion), pointer(wheel), self.turn, self.sense, start, STEP, depth, found
        )
        return float(depth[0]), found

    def _place(self, x):
        """Unknowns (nx,) as a place for C."""
        at = ffi.new("mw_first *")
        pinion, wheel = self.drive.design.description["bodies"]
        at.q_pinion[0 : len(pinion["unknowns"])] = x[pinion["unknowns"]].tolist()
        at.q_wheel[0 : len(wheel["unknowns"])] = x[wheel["unknowns"]].tolist()
        at.wheel_turn, at.limit = x[self.drive.design.description["error"]], (-1, -1)
        return at

    def _curve(self, angle, at, member, limit, step, fall, count):
        """Places of the curve through one of them: see ``mw_first_curve``."""
        pinion, wheel = self._way(angle, 0.0)
        found = ffi.new("mw_first[]", 2 * count + 1)
        known = library().mw_first_curve(
            *self._model, pointer(pinion), pointer(wheel), self.turn,
            self.sense, at, member, limit, step, fall, count, pointer(self.work), found,
        )  # fmt: skip
        kept = ffi.new("mw_first[]", known)
        ffi.memmove(kept, found, ffi.sizeof(kept))
        return kept

    def _of_places(self, angle, places, across):
        bodies = self.drive.design.description["bodies"]
        ends = []
        for place in (places[0], places[len(places) - 1]):
            limited = place.limit[1] >= 0
            member = place.member[1]
            ends.append((bodies[member]["name"], event_of(bodies, member, place.limit[1])) if limited else (None, ""))
        points = np.array([list(place.point) for place in places])
        curvatures = self._curvatures(angle, places) if across else np.full(len(points), np.nan)
        return TouchingLine(float(angle), places, points, tuple(ends), curvatures)

    def _curvatures(self, angle, places):
        """Relative curvature of the flanks across the line at its places: (M,)."""
        model = self.drive.design.model
        x = np.array([unknowns_at(self.drive, place) for place in places])
        observed, angles = np.empty((len(x), model.no)), np.full(len(x), float(angle))
        library().mw_observe(
            model, pointer(self.drive.design.state.copy()), pointer(angles), pointer(x), len(x), pointer(observed)
        )
        return observed[:, model.geometry + LARGER_CURVATURE]


def _spread(places):
    """How far the flanks stand apart somewhere on a curve while they touch elsewhere on it, mm along the normal."""
    turns = [place.wheel_turn for place in places]
    return (max(turns) - min(turns)) * abs(places[0].lever)


def _level_inside(places):
    """Whether a curve that falls off at its ends is level halfway to each of them."""
    if len(places) < LEAST_LEVEL:
        return False
    quarter = len(places) // 4
    return not _spread(places[quarter : len(places) - quarter]) > LEVEL * FLAT


def _on_regular_flanks(drive, solutions):
    """Whether solutions (N, nx) lie before the singular lines of both flanks: beyond them is another sheet."""
    bodies = drive.design.description["bodies"]
    return np.all([~(drive.flank(b["name"])(solutions[:, b["unknowns"]]).regular < 0.0) for b in bodies], axis=0)


def _matrices(drive, angles):
    """Placements (N, 12) of pinion and wheel, rows of four, at angles (N,), the wheel without transmission error."""
    matrices = placed(drive, angles, drive.ratio * angles).matrices
    bodies = drive.design.description["bodies"]
    return [np.ascontiguousarray(matrices[body["name"]][:, :3].reshape(-1, 12)) for body in bodies]


def _senses(drive, angle, x):
    """Sense of the wheel's rotation about its own z with the transmission error; the side on which the gap opens."""
    turned = np.stack([x, x])
    turned[1, drive.design.description["error"]] += TURN
    pinion, wheel = (b["name"] for b in drive.design.description["bodies"])
    stand = placements_at(drive, np.array([angle, angle]), turned).matrices
    rotation = stand[wheel][0, :3, :3].T @ stand[wheel][1, :3, :3]
    turn = math.copysign(1.0, math.atan2(rotation[1, 0], rotation[0, 0]))
    flank = drive.flank(wheel)
    at = flank(x[drive.design.description["bodies"][1]["unknowns"]][None])
    outward = -at.normals[0]
    moved = turn * np.array([-at.points[0, 1], at.points[0, 0], 0.0])
    return turn, math.copysign(1.0, float(outward @ moved))
