"""Lines across a region at given coordinates along the tooth, each from border to border.

They are found from the region's triangles, and carried on from line to line where the region narrows to a strip that
triangles miss. A line is a piece of a section of the tooth where the drive says that sections run across it.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.roots import narrowed
from meshwright.flank.sections import lengthwise, lengthwise_slopes, solved

#: Triangles of the mesh that shows where a region is, at least.
FEWEST = 24 * 24

#: Samples of a line across the tooth on which its ends are looked for; halvings of the step that holds an end.
SAMPLES, BISECTIONS = 65, 56

#: A step of this many towards an end is a bisection.
HALVED = 4

#: Places on a line are located to so many units in the last place.
LAST_PLACES = 4.0

#: Lines along the border count as inside: the limits there are zero to rounding, mm; and how much it varies along one.
ROUNDING, NOISE = 1e-9, 1e-13

#: Lines from which others are found; how far a line's ends are sought beyond its neighbours', in parts of its width,
#: and how often that is doubled.
GUIDES, BEYOND, WIDER = 25, 0.25, 5

#: A region is followed beyond its triangles in steps of its length over this, halved at most to the second number,
#: and only where it goes on by the third one, all in parts of a step.
STEPS, CLOSEST, FURTHER = 64, 2.0**-30, 2.0**-20

#: So many steps of one length are followed by one twice as long; more lines than this are not followed.
REGAINED, FARTHEST = 3, 256

#: Steps in which a line is followed from end to end; places between them are found from these.
STEPS_ACROSS = 8

#: A line is no narrower than this part of the one before it, and than this one of the first of those that follow it.
NARROWEST, CUSP = 1e-6, 1e-8

#: Distances between places that are held at once.
DISTANCES_AT_ONCE = 2_000_000

#: Limits that come from the surface itself, not from a size of blank or tool.
SINGULAR = ("undercut", "regression", "spurious_sheet")

#: Corners of the border are looked for between so many lines for each that is known; what holds one is divided into so
#: many parts at once, so often.
PER_GUIDE, PARTS, ROUNDS_OF_PARTS = 4, 16, 8

#: Places on a line from which its arc length is known, and rounds of setting them evenly.
PLACES, ROUNDS = 129, 3


@dataclass(frozen=True)
class Lines:
    """Lines across a region at lengthwise coordinates ``along`` (M,): ``lower`` and ``upper`` (M, k), the ends of the
    profile's parameter; NaN where a line misses the region.
    """

    region: Any  # a meshwright.flank.region.Region, which finds its lines here
    along: np.ndarray
    lower: np.ndarray
    upper: np.ndarray

    def at(self, along):
        """Lines at other coordinates (M,), found from these ones."""
        known = np.isfinite(self.lower[:, 0])
        order = np.flatnonzero(known)[np.argsort(self.along[known])]
        ends = [_between(self.along[order], end[order], along) for end in (self.lower, self.upper)]
        of = self.region.profile
        low = np.minimum(*(_extreme(self.along[order], end[order, of], along, np.minimum) for end in self._both))
        high = np.maximum(*(_extreme(self.along[order], end[order, of], along, np.maximum) for end in self._both))
        return _within(self.region, along, ends, low, high)

    @property
    def _both(self):
        return self.lower, self.upper

    def moved(self, lower=None, upper=None):
        """The lines with other ends (M, k)."""
        return Lines(
            self.region, self.along, self.lower if lower is None else lower, self.upper if upper is None else upper
        )

    def places(self, shares):
        """Parameters (J, M, k) at shares (J,) of the way from lower to upper end, in steps of the profile's parameter;
        ends included where the shares are 0 and 1.
        """
        return self._solved(np.broadcast_to(np.asarray(shares)[:, None], (len(shares), len(self.along))))

    def _solved(self, shares):
        """Parameters (J, M, k) at ascending shares (J, M) of the profile's parameter between the ends."""
        steps = np.linspace(0.0, 1.0, STEPS_ACROSS + 1)
        guide = np.stack([np.broadcast_to(share, len(self.along)) for share in steps])
        guide = self._followed(guide)
        at = np.clip(shares * STEPS_ACROSS, 0.0, STEPS_ACROSS)
        before = np.minimum(at.astype(int), STEPS_ACROSS - 1)
        column = np.arange(len(self.along))
        rest = (at - before)[:, :, None]
        start = (1.0 - rest) * guide[before, column] + rest * guide[before + 1, column]
        profile = self._profile(shares)
        along = np.broadcast_to(self.along, shares.shape)
        found = solve(self.region, profile.ravel(), along.ravel(), start.reshape(-1, start.shape[2]))
        found = found.reshape(*shares.shape, -1)
        found[shares == 0.0] = np.broadcast_to(self.lower, found.shape)[shares == 0.0]
        found[shares == 1.0] = np.broadcast_to(self.upper, found.shape)[shares == 1.0]
        return found

    def _profile(self, share):
        """The profile's parameter at shares (M,) or (J, M) of the way from the lower to the upper ends."""
        lower, upper = (end[:, self.region.profile] for end in self._both)
        return lower + share * (upper - lower)

    def _followed(self, shares):
        """The same, each from the one before it."""
        rows, start = [self.lower], self.lower
        for share in shares[1:-1]:
            found = solve(self.region, self._profile(share), self.along, start)
            rows.append(found)
            start = np.where(np.isfinite(found), found, start)
        return np.stack([*rows, self.upper])

    def even(self, shares):
        """Parameters (J, M, k) at shares (J,) of the arc length of each line; ends included."""
        from scipy.interpolate import CubicSpline, PchipInterpolator

        count = len(self.along)
        share = np.broadcast_to(np.linspace(0.0, 1.0, PLACES)[:, None], (PLACES, count)).copy()
        wanted = np.broadcast_to(np.asarray(shares, dtype=float)[:, None], (len(shares), count)).copy()
        for turn in range(ROUNDS):
            arc = self._arc(share)
            last = turn == ROUNDS - 1
            even = wanted if last else np.broadcast_to(np.linspace(0.0, 1.0, PLACES)[:, None], share.shape)
            kind = CubicSpline if last else PchipInterpolator
            share = np.stack([kind(arc[:, k], share[:, k])(even[:, k]) for k in range(count)], axis=1)
            share[even == 0.0], share[even == 1.0] = 0.0, 1.0
        return self._solved(share)

    def spaced(self, shares):
        """Parameters (J, M, k) at about the shares (J,) of the arc length of each line; ends included."""
        share = np.broadcast_to(np.linspace(0.0, 1.0, PLACES)[:, None], (PLACES, len(self.along)))
        arc = self._arc(share)
        wanted = np.asarray(shares, dtype=float)
        return self._solved(np.stack([np.interp(wanted, a, share[:, 0]) for a in arc.T], axis=1))

    def _arc(self, share):
        """Shares (J, M) of the arc length at shares (J, M) of the profile's parameter."""
        q = self._solved(share)
        points = self.region.flank(q.reshape(-1, q.shape[2])).points.reshape(*q.shape[:2], 3)
        steps = np.linalg.norm(np.diff(points, axis=0), axis=2)
        arc = np.concatenate([np.zeros((1, steps.shape[1])), np.cumsum(steps, axis=0)])
        return np.where(arc[-1] > 0.0, arc / np.where(arc[-1] > 0.0, arc[-1], 1.0), share)

    def onto(self, q):
        """Places (M, k) on the lines with the profile's parameters that nearby ones have."""
        return solve(self.region, q[:, self.region.profile].copy(), self.along, q)

    def nearest(self, points, way, before, after):
        """Places (M, k) on the lines, between ones ``before`` and ``after`` (M, k), that are as far along ``way``
        (M, 3) as ``points`` (M, 3).
        """
        of, q = self.region.profile, before.copy()

        def short(places, which):
            return np.sum((points[which] - self.region.flank(places).points) * way[which], axis=1)

        def at(profile, which):
            trial = solve(self.region, profile, self.along[which], q[which])
            q[which] = np.where(np.isfinite(trial), trial, q[which])
            return short(trial, which)

        every = np.arange(len(q))
        ends = short(before, every), short(after, every)
        there = np.where(ends[0] < 0.0, before[:, of], after[:, of])  # they lie before what should hold them
        exact = LAST_PLACES * np.spacing(np.maximum(np.abs(before[:, of]), np.abs(after[:, of])))
        q[:, of], _ = narrowed(at, before[:, of], there, ends, exact)
        return self.onto(q)

    def slopes(self, q):
        """Points (N, 3) at parameters (N, k) and their change (N, 3) along the line by the profile's parameter."""
        found = self.region.flank(q)
        return found.points, tangents(self.region, found)[:, 0]


def lines(region, triangles=None, count=GUIDES):
    """:class:`Lines` over a whole region, ``count`` or more of them, ascending, the first and last at its very ends.

    ``triangles`` is the region's mesh, if there is one; coarse ones are refined.
    """
    if triangles is None or len(triangles.triangles) < FEWEST:
        triangles = region.triangles
    known = triangles.parameters
    reached = lengthwise(region.flank, region.flank(known))
    along = np.linspace(reached.min(), reached.max(), count)
    found = _sampled(region, known, reached, along)
    inside = np.isfinite(found.lower[:, 0])
    if not inside.any():
        return found
    size = (along[-1] - along[0]) / STEPS
    first, last = np.flatnonzero(inside)[[0, -1]]
    before, after = (_followed(found, k, way * size) for k, way in ((first, -1.0), (last, 1.0)))
    parts = [before[::-1], [(found.along[k], found.lower[k], found.upper[k]) for k in range(first, last + 1)], after]
    joined = [line for part in parts for line in part]
    return Lines(region, *(np.array(column) for column in zip(*joined, strict=True)))


def ended_by(found, upper):
    """Numbers (M,) of the limits at an end of lines, that of the face apart; -1 where it is a singular line."""
    limits = found.region.limits
    values = np.abs(limits.values(found.region.flank(found.upper if upper else found.lower)))
    values[:, [k for k, name in enumerate(limits.names) if name == "face"]] = np.inf
    number = np.argmin(values, axis=1)
    number[np.isin(number, [k for k, name in enumerate(limits.names) if name in SINGULAR])] = -1
    return number


def corners(found):
    """Coordinates along the tooth, ascending, at which other limits begin to end the lines of a whole region."""
    known = found.along[np.isfinite(found.lower[:, 0])]
    at = np.linspace(known[0], known[-1], PER_GUIDE * len(known))[1:-1]
    parts = [changes(at, lambda along, upper=upper: ended_by(found.at(along), upper)) for upper in (False, True)]
    return np.unique(np.concatenate(parts))


def changes(values, what, seen=None):
    """Places between ascending values (K,) at which ``what``, a function of places, has another value from there on;
    ``seen`` (K,): what it is at them, if that is known.
    """
    seen = what(values) if seen is None else seen
    at = np.flatnonzero(seen[1:] != seen[:-1])
    low, high, first = values[at], values[at + 1], seen[at, None]
    shares, rows = np.arange(1, PARTS) / PARTS, np.arange(len(at))
    for _ in range(ROUNDS_OF_PARTS if len(at) else 0):
        places = low[:, None] + shares * (high - low)[:, None]
        other = what(places.ravel()).reshape(places.shape) != first
        ends = np.column_stack([low, places, high])
        number = np.argmax(np.column_stack([other, np.ones(len(at), dtype=bool)]), axis=1)
        low, high = ends[rows, number], ends[rows, number + 1]
    return 0.5 * (low + high)


def _followed(found, number, step):
    """Lines beyond one, as far as the region goes: lists of (along, lower, upper)."""
    at, ends, result = found.along[number], np.stack([found.lower[number], found.upper[number]]), []
    slopes = np.zeros_like(ends)
    if _next(found.region, at + FURTHER * step, ends, slopes) is None:
        return result
    of = found.region.profile
    size, alike, narrowest = step, 0, CUSP * (ends[1, of] - ends[0, of])
    while abs(size) > CLOSEST * abs(step) and ends[1, of] - ends[0, of] > narrowest:
        further = _next(found.region, at + size, ends, size * slopes)
        if further is None:
            size, alike = 0.5 * size, 0
            continue
        slopes = (further - ends) / size
        at, ends = at + size, further
        result.append((at, *ends))
        alike += 1
        if alike == REGAINED and abs(size) < abs(step):
            size, alike = 2.0 * size, 0
        if len(result) > FARTHEST:
            flank = found.region.flank
            raise UsageError(
                f"the {flank.region} of the {flank.body['name']} is too narrow at {at:.6g} mm along its teeth to be "
                "followed to its end: change [blank] or [design]"
            )
    return result


def _next(region, at, ends, moved):
    """Ends (2, k) of the line at a coordinate, from other ones and about where they have ``moved``; None for none."""
    of = region.profile
    near = np.concatenate([ends[:, of], (ends + moved)[:, of]])
    places = [end[None] for end in ends + moved]
    line = _within(region, np.array([at]), places, near.min(keepdims=True), near.max(keepdims=True))
    width = abs(ends[1, of] - ends[0, of])
    if not line.upper[0, of] - line.lower[0, of] > NARROWEST * width:
        return None
    return np.stack([line.lower[0], line.upper[0]])


def _sampled(region, known, reached, along):
    """Lines found on even samples of the whole profile, from the nearest of known parameters (V, k)."""
    across = known[:, region.profile]
    room = np.ptp(across) / SAMPLES
    profile = np.linspace(across.min() - room, across.max() + room, SAMPLES)
    places = np.stack(np.meshgrid(profile, along, indexing="ij"), axis=-1).reshape(-1, 2)
    near = known[_nearest(np.stack([across, reached], axis=1), places)]
    profile = np.broadcast_to(profile[:, None], (SAMPLES, len(along)))
    return _ended(region, along, profile, near.reshape(SAMPLES, len(along), -1))[0]


def _within(region, along, ends, low, high):
    """Lines whose ends lie near ``low`` and ``high`` (M,) of the profile's parameter and near ``ends`` (2, M, k)."""
    width, room = high - low, BEYOND
    shares = np.linspace(0.0, 1.0, SAMPLES)[:, None]
    for _ in range(WIDER):
        first, last = low - room * width, high + room * width
        profile = first + shares * (last - first)
        first_end, last_end = (end[:, region.profile] for end in ends)
        span = last_end - first_end
        share = np.clip((profile - first_end) / np.where(span == 0.0, 1.0, span), 0.0, 1.0)[:, :, None]
        start = ends[0][None] + share * (ends[1] - ends[0])[None]
        found, whole = _ended(region, along, profile, start)
        if whole.all():
            break
        room *= 2.0
    return found


def _ended(region, along, profile, near):
    """Lines through samples (S, M) of the profile, from nearby parameters (S, M, k), and whether (M,) they end before
    the samples do.
    """
    samples, count = profile.shape
    q = solve(region, profile.ravel(), np.tile(along, samples), near.reshape(samples * count, -1))
    values = region.limits.values(region.flank(q)).reshape(samples, count, -1)
    inside = values.min(axis=2) >= -ROUNDING
    q = q.reshape(samples, count, -1)
    first, last = _longest_runs(inside)
    # what has one value on a line does not end it
    with np.errstate(invalid="ignore"):
        off = np.where(inside[:, :, None], np.abs(values - values[first, np.arange(count)]), 0.0)
        spread = np.fmax.reduce(off, axis=(0, 1))
    across = ~(spread < ROUNDING)
    missed = ~inside.any(axis=0)
    lower, upper = np.full((2, count, q.shape[2]), np.nan)
    if not missed.all():
        there = ~missed
        ends = first[there], last[there]
        lower[there], upper[there] = _both_ends(region, across, q[:, there], profile[:, there], along[there], ends)
    return Lines(region, along, lower, upper), missed | ((first > 0) & (last < samples - 1))


def _between(known, values, wanted):
    return np.stack([np.interp(wanted, known, column) for column in values.T], axis=1)


def _extreme(known, values, wanted, least):
    """The smaller or larger value of the two known ones about each wanted place."""
    after = np.clip(np.searchsorted(known, wanted), 0, len(known) - 1)
    return least(values[np.maximum(after - 1, 0)], values[after])


def _nearest(known, places):
    """For each place (P, 2) the number of the nearest of known ones (V, 2), in shares of their spread."""
    spread = np.maximum(np.ptp(known, axis=0), 1e-300)
    known, places = known / spread, places / spread
    # of squared distances what differs from one known place to another, of so many places that a block stays small
    squares, rows = np.sum(known**2, axis=1), max(1, DISTANCES_AT_ONCE // len(known))
    blocks = [places[k : k + rows] for k in range(0, max(1, len(places)), rows)]
    return np.concatenate([np.argmin(squares - 2.0 * block @ known.T, axis=1) for block in blocks])


def _longest_runs(inside):
    """First and last index (M,) of the longest run of true in each column."""
    first, last, best = (np.zeros(inside.shape[1], dtype=int) for _ in range(3))
    length = np.zeros(inside.shape[1], dtype=int)
    for k, row in enumerate(inside):
        length = np.where(row, length + 1, 0)
        longer = length > best
        best, last = np.where(longer, length, best), np.where(longer, k, last)
        first = np.where(longer, k - length + 1, first)
    return first, last


def _both_ends(region, across, q, profile, along, within):
    """Parameters (2, M, k) where each line leaves the region beyond its first and its last sample ``within`` (2, M) of
    the profile (S, M), by the Illinois variant of regula falsi (M. Dowell, P. Jarratt, BIT 11, 1971), by bisection
    where there is no surface; steps of inverse quadratic interpolation have left the surface's sheet at its cusps.
    ``across`` are the limits that can end a line.
    """

    def least(places):
        return region.limits.values(region.flank(places))[:, across].min(axis=1, initial=np.inf)

    columns, index, along = np.tile(np.arange(len(along)), 2), np.concatenate(within), np.tile(along, 2)
    sign = np.repeat([-1, 1], len(columns) // 2)
    inner, beyond = profile[index, columns].copy(), np.clip(index + sign, 0, len(profile) - 1)
    outer, best = profile[beyond, columns].copy(), q[index, columns].copy()
    inside = least(best)
    floor = np.minimum(inside, 0.0) - NOISE
    outside = least(q[beyond, columns]) - floor
    inside = inside - floor
    left, moved = np.flatnonzero(inner != outer), np.zeros(len(inner))  # which end the last step moved: 1 the inner one
    for step in range(BISECTIONS):
        if not len(left):
            break
        a, b, fa, fb = inner[left], outer[left], inside[left], outside[left]
        with np.errstate(invalid="ignore", divide="ignore"):
            share = fa / (fa - fb)
        # now and then the middle: a limit function may be far from a straight line
        share = np.where(np.isfinite(fb) & (share > 0.0) & (share < 1.0) & (step % HALVED > 0), share, 0.5)
        trial = solve(region, a + share * (b - a), along[left], best[left])
        value = least(trial) - floor[left]
        good = value >= 0.0
        inner[left] = np.where(good, a + share * (b - a), a)
        outer[left] = np.where(good, b, a + share * (b - a))
        # an end that stays where it is a second time counts half
        inside[left] = np.where(good, value, np.where(moved[left] < 0.0, 0.5 * fa, fa))
        outside[left] = np.where(good, np.where(moved[left] > 0.0, 0.5 * fb, fb), value)
        moved[left] = np.where(good, 1.0, -1.0)
        best[left] = np.where(good[:, None], trial, best[left])
        near = (good & (value < 2.0 * NOISE)) | (np.abs(outer[left] - inner[left]) <= 1e-15 * np.abs(outer[left]))
        left = left[~near]
    return best.reshape(2, -1, best.shape[1])


def tangents(region, found):
    """Change (N, 2, 3) of flank points by the profile's parameter and by the coordinate along the tooth."""
    slopes = lengthwise_slopes(region.flank, found)
    size, k = slopes.shape
    matrix = np.zeros((size, k, k))
    matrix[:, 0, region.profile], matrix[:, 1], matrix[:, 2:] = 1.0, slopes, found.conditions[:, :, 1:]
    ways = solved(matrix, np.broadcast_to(np.eye(k)[:, :2], (size, k, 2)))
    return np.swapaxes(ways, 1, 2) @ found.tangents


def solve(region, profile, along, start):
    """Parameters (N, k) at profile parameters and lengthwise coordinates (N,), from nearby ones; NaN for none."""
    k, sections = start.shape[1], region.flank.sections
    factors = np.zeros((2, k + 4))
    factors[0, region.profile] = 1.0
    if sections:
        factors[1, -1], factors[1, -2] = sections.sides
    else:
        factors[1, k - 1] = 1.0
    return region.flank.places(factors, region.chart.sizes, np.stack([profile, along], axis=1), start)
