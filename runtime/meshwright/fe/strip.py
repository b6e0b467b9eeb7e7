"""The strip of the contact plane that pressure cells divide: along the curve of smallest gap, as far as flanks go.

In each place along the strip the gap has its least across it: there touch the flanks of a line contact, and about there
those of any other contact whose ellipse is slender. Rows of cells lie straight across that curve, each between the
edges of the flanks or half a width away from its own least gap, and the strip ends where an edge cuts it off, or where
the gap is larger than what the load closes. There is one strip for tangencies, lines, edges and corners.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.spatial import KDTree

from meshwright.fe.gap import Bools, ContactGrid, ContactPlane
from meshwright.fe.hexahedra import Floats

# Stations along the strip at which its curve is sought.
_STATIONS = 41
# Places on both flanks that make a curve.
_FEWEST = 3
# Places across the flanks among which the start of that search is chosen.
_STARTS = 17
# Newton steps of that search.
_STEPS = 8
# Stations of a profile come as close to the contact as so many halvings of the strip.
_HALVINGS = 24.0
# Differences across the strip are taken over this part of the extent of the flanks across.
_DIFFERENCE = 0.01
# A border is looked for across the strip at distances that double so often.
_DOUBLINGS = 10
# Evaluations with which a border across the strip is closed in on.
_CLOSING_IN = 40
# A border across the strip is known to this part of the distance in which it is sought.
_KNOWN = 1e-10
# Stations and rounds with which the ends of a strip are closed in on.
_END_STATIONS, _END_ROUNDS = 16, 5
# What bounds a cell is told so far beyond its border, in parts of the width of the strip.
_BEYOND = 1e-4
# Edges are sharp where the mate goes on so far beyond them, in parts of its flank.
_SHARP = 0.01
# Places in each interval of its stations at which the length and the way of a strip's curve are known.
_FINER = 10
# Rows turn by no more than this over a length of the curve as long as their own half width, rad.
_TURN = 0.5
# Cells on the inside of a bend are at least so long, in parts of their row: beyond a row's own half width.
_LEAST_LENGTH = 0.1
# Cells at an edge are so much shorter than the mean.
_SHORTER = 0.6


@dataclass(frozen=True)
class Window:
    """The part of a strip that is divided: where the gap is less than ``closing``, and not further than ``width`` from
    the place of the least gap across, both in mm; ``whole``: pressure has reached its end, it stays as long as that.
    """

    closing: float
    width: float
    whole: bool = False


@dataclass(frozen=True)
class Profile:
    """Stations ``along`` (K,) a strip: ``offset`` in mm to the left of its curve of the least ``gap`` in mm on both
    flanks, not a number where these are not; ``curvature`` of the gap across, 1/mm; ``length`` of each in mm.
    """

    along: Floats
    offset: Floats
    gap: Floats
    curvature: Floats
    length: Floats

    def opened(self, closing: float) -> Floats:
        """Closing (K,) in mm that is left for the flanks at each station where the load closes so much."""
        return np.nan_to_num(np.maximum(closing - self.gap, 0.0))


@dataclass(frozen=True)
class Strip:
    """A curve in the contact plane, given across its first axis.

    ends: where both flanks may lie along that axis, mm; reach: extent across, mm.  along: stations (K,) of the first
    axis; curve: coordinate along the second one at the first.  turned: angle in rad from the first axis to the way that
    rows lie straight across, None for that of the curve.
    """

    plane: ContactPlane
    ends: tuple[float, float]
    reach: float
    along: Floats
    curve: Callable[..., Floats]
    turned: Callable[[Floats], Floats] | None = None

    @classmethod
    def of(cls, plane: ContactPlane) -> Strip:
        """Raises ArithmeticError where the flanks do not lie over one another about the contact."""
        (first, low), (last, high) = plane.extents()
        if not plane.shared:
            raise ArithmeticError(
                f"the flanks of the pair {plane.contact.pairs_later:+d} do not lie over one another about their first "
                f"contact ({plane.contact.touch.edge or 'tangency'}): turn to another angle or lessen the misalignment"
            )
        along = np.linspace(first, last, _STATIONS)
        across = _least_gap(plane, along, low, high)
        ends, reach = (float(first), float(last)), float(high - low)
        strip = cls(plane, ends, reach, along, PchipInterpolator(along, across))
        return strip._along_edges() if plane.contact.touch.edge else strip

    def _along_edges(self) -> Strip:
        """The strip whose curve, where that of the surfaces leaves the flanks, goes along their edges."""
        offset = self.nearest(self.along)
        known = np.isfinite(offset)
        if not np.any(offset[known]):
            return self
        along, across = self.at(self.along[known], offset[known]).T
        onward = along > np.maximum.accumulate(np.insert(along, 0, self.ends[0]))[:-1]
        along, across = along[onward], across[onward]
        if len(along) < _FEWEST:
            return self
        slopes = np.diff(across)[[0, -1]] / np.diff(along)[[0, -1]]
        before, after = (np.array([at]) if side * (at - along[k]) > 0.0 else np.empty(0)
                         for at, k, side in zip(self.ends, (0, -1), (-1.0, 1.0), strict=True))  # fmt: skip
        across = np.concatenate([
            across[0] + slopes[0] * (before - along[0]), across, across[-1] + slopes[1] * (after - along[-1])
        ])  # fmt: skip
        along = np.concatenate([before, along, after])
        return replace(self, along=along, curve=PchipInterpolator(along, across))

    def at(self, along: Floats, offset: Floats) -> Floats:
        """Coordinates (..., 2) in the contact plane at stations and mm to the left of the curve there, of one shape."""
        way = self.directions(along)
        return np.stack([along, self.curve(along)], axis=-1) + offset[..., None] * way[..., 1, :]

    def directions(self, along: Floats) -> Floats:
        """Unit directions (..., 2, 2) straight across rows and along them, to the left, in the contact plane."""
        angle = self.way(along)
        way = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        return np.stack([way, np.stack([-way[..., 1], way[..., 0]], axis=-1)], axis=-2)

    def way(self, along: Floats) -> Floats:
        """Angle (...,) in rad from the first axis to the way that rows lie straight across."""
        return np.arctan(self.curve(along, 1)) if self.turned is None else self.turned(along)

    @cached_property
    def _measured(self) -> tuple[Floats, Floats]:
        """Stations (F,) from end to end, and the length (F,) of the curve up to them, mm."""
        along = np.linspace(*self.ends, _FINER * _STATIONS)
        middles = 0.5 * (along[1:] + along[:-1])
        return along, np.insert(np.cumsum(np.diff(along) * np.hypot(1.0, self.curve(middles, 1))), 0, 0.0)

    def _without_crossing(self, width: float) -> Strip:
        """The strip with rows so wide, to either side, that do not cross where its curve bends, as at a corner: their
        ways turn with it as fast as they may, before it bends and after.
        """
        along, length = self._measured
        way = self.way(along)
        most = _TURN / width * np.abs(length[:, None] - length)
        turned = 0.5 * ((way + most).min(axis=1) + (way - most).max(axis=1))
        return replace(self, turned=lambda at: np.interp(at, along, turned))

    def margin(self, along: Floats, offset: Floats) -> Floats:
        """How far (...,) places of the strip are within both flanks, in parts of the flanks."""
        of = self.plane.footprints(self.plane.feet(self.at(along, offset).reshape(-1, 2)))
        return np.minimum(*(one.margin for one in of.values())).reshape(along.shape)

    def gap(self, along: Floats, offset: Floats) -> Floats:
        """Gap (...,) of the flanks, as far as their surfaces go, along the normal of the pinion's, mm."""
        of = self.plane.footprints(self.plane.feet(self.at(along, offset).reshape(-1, 2)))
        gap, _ = self.plane.gap(of)
        return (gap * (of["pinion"].normals @ self.plane.axes[2])).reshape(along.shape)

    def nearest(self, along: Floats) -> Floats:
        """Where (R,), in mm to the left, both flanks come nearest to the curve; not a number where they do not."""
        found = np.where(self.margin(along, np.zeros_like(along)) >= 0.0, 0.0, np.nan)
        (away,) = np.nonzero(np.isnan(found))
        if not len(away):
            return found
        distance = self.reach * 0.5 ** np.arange(_DOUBLINGS)[::-1]
        offsets = np.stack([distance, -distance], axis=1).ravel()
        inside = self.margin(*np.broadcast_arrays(along[away, None], offsets)) >= 0.0
        met = inside.any(axis=1)
        away, first = away[met], inside[met].argmax(axis=1)
        if len(away):
            nearer = np.where(first > 1, offsets[first - 2], 0.0)
            found[away] = self._border(along[away], offsets[first], nearer)
        return found

    def _border(self, along: Floats, inside: Floats, outside: Floats) -> Floats:
        """Offsets (R,) of the edges of the flanks between places on them and beyond them: the last on them.

        By false position that halves what stays (the Illinois method), since margins are smooth up to a corner.
        """
        inside, outside = inside.copy(), outside.copy()
        ends = [self.margin(along, inside), np.maximum(self.margin(along, outside), -1.0)]
        for _ in range(_CLOSING_IN):
            middle = inside + (outside - inside) * np.clip(ends[0] / (ends[0] - ends[1]), 0.01, 0.99)
            value = np.maximum(self.margin(along, middle), -1.0)
            on = value >= 0.0
            ends = [np.where(on, value, 0.5 * ends[0]), np.where(on, 0.5 * ends[1], value)]
            inside, outside = np.where(on, middle, inside), np.where(on, outside, middle)
            if np.abs(outside - inside).max() < _KNOWN * self.reach:
                break
        return inside

    @cached_property
    def profile(self) -> Profile:
        """Stations from end to end, closer and closer to the contact."""
        near = (self.ends[1] - self.ends[0]) * 0.5 ** np.arange(2.0, _HALVINGS)
        near = np.concatenate([-near, [0.0], near])
        along = np.union1d(self.along, near[(near > self.ends[0]) & (near < self.ends[1])])
        on_flanks = self._on_flanks(along)
        (last,) = np.nonzero(on_flanks[1:] != on_flanks[:-1])
        inner, outer = (np.where(on_flanks[last] == side, along[last], along[last + 1]) for side in (True, False))
        along = np.union1d(along, _last(self._on_flanks, inner, outer))
        offset = self.nearest(along)
        gap = self.least(along, offset)
        steps = np.diff(along) * np.isfinite(gap[1:] + gap[:-1])
        lengths = 0.5 * (np.append(steps, 0.0) + np.insert(steps, 0, 0.0))
        lengths[lengths > 0.0] *= np.nan_to_num(self.lengths(along[lengths > 0.0]), nan=1.0)
        curvature = _between(along, self.curvature(along, _DIFFERENCE * self.reach))
        return Profile(along, offset, gap, curvature, lengths)

    def half_width(self, closing: float) -> float:
        """How far flanks would lie in one another across, to one side, at most, mm, where the load closes so much."""
        profile = self.profile
        used = profile.opened(closing) > 0.0
        along, middle, least = profile.along[used], profile.offset[used], profile.gap[used]
        distance = np.concatenate([[0.0], self.reach * 0.5 ** np.arange(_DOUBLINGS)[::-1]])
        widest = 0.0
        for side in (-1.0, 1.0):
            stations, offsets = np.broadcast_arrays(along[:, None], middle[:, None] + side * distance)
            gaps = np.where(self.margin(stations, offsets) >= 0.0, self.gap(stations, offsets), np.inf)
            gaps[:, 0] = least
            last = np.argmax(np.column_stack([gaps[:, 1:] >= closing, np.ones(len(along), dtype=bool)]), axis=1)
            rows, after = np.arange(len(along)), np.minimum(last + 1, len(distance) - 1)
            rise = gaps[rows, after] - gaps[rows, last]
            share = np.divide(closing - gaps[rows, last], rise, out=np.zeros_like(rise), where=rise > 0.0)
            between = distance[last] ** 2 + np.clip(share, 0.0, 1.0) * (distance[after] ** 2 - distance[last] ** 2)
            widest = max(widest, math.sqrt(np.max(between, initial=0.0)))
        return widest

    def _on_flanks(self, along: Floats) -> Bools:
        """Whether the curve is on both flanks at stations (...,)."""
        return self.margin(along, np.zeros_like(along)) >= 0.0

    def least(self, along: Floats, offset: Floats) -> Floats:
        """The gaps (R,) at offsets, not a number where these are not."""
        return np.where(np.isfinite(offset), self.gap(along, np.nan_to_num(offset)), np.nan)

    def curvature(self, along: Floats, step: float) -> Floats:
        """Curvature (R,) of the gap across the curve, 1/mm, over a step in mm to either side."""
        stations, offsets = np.broadcast_arrays(along[:, None], step * np.array([-1.0, 0.0, 1.0]))
        bend = self.gap(stations, offsets) @ np.array([1.0, -2.0, 1.0]) / step**2
        return bend / self._on_flank(along, self._normals(along))[1][:, 1] ** 2

    def lengths(self, along: Floats) -> Floats:
        """Length (R,) of the curve on the flank per mm of the first axis."""
        return np.hypot(1.0, self.curve(along, 1)) * self._on_flank(along, self._normals(along))[1][:, 0]

    def _normals(self, along: Floats) -> Floats:
        """Normals (R, 3) of the pinion's flank on the curve."""
        feet = self.plane.feet(self.at(along, np.zeros_like(along)))
        return self.plane.footprints(feet)["pinion"].normals

    def _on_flank(self, along: Floats, normals: Floats) -> tuple[Floats, Floats]:
        """Of flanks with normals (R, 3) at stations: unit directions (R, 3, 3) along, across and normal, and how far
        (R, 2) along, and straight across that, a mm along and one across in the contact plane below leads there.
        """
        ways = self.directions(along) @ self.plane.axes[:2]
        steep = np.einsum("kij,kj->ki", ways, normals) / (normals @ self.plane.axes[2])[:, None]
        above = ways - steep[..., None] * self.plane.axes[2]
        length = np.linalg.norm(above[:, 0], axis=1)
        first = above[:, 0] / length[:, None]
        second = np.cross(normals, first)
        across = np.einsum("ki,ki->k", above[:, 1], second)
        return np.stack([first, second, normals], axis=1), np.stack([length, across], axis=1)

    def grid(self, window: Window, rows: int, columns: int) -> ContactGrid | None:
        """The cells of a part of the strip; None where no gap is so small."""
        ends = self._closed(window.closing)
        if ends is None:
            return None
        beyond = ends + _BEYOND * self.reach * np.array([-1.0, 1.0])
        stations, lengths = self._measured
        first, last = np.interp(ends, stations, lengths)
        bounds = first + (last - first) * _shares(rows, *(self.margin(beyond, np.zeros(2)) < 0.0))
        along, bounds = (np.interp(at, lengths, stations) for at in (0.5 * (bounds[1:] + bounds[:-1]), bounds))
        return self._without_crossing(window.width)._divided(along, bounds, window.width, columns)

    def _divided(self, along: Floats, bounds: Floats, width: float, columns: int) -> ContactGrid:
        """The cells of rows at stations (R,) between others (R + 1,)."""
        middle = self.nearest(along)
        known = np.isfinite(middle)
        along, middle, borders = along[known], middle[known], np.stack([bounds[:-1], bounds[1:]])[:, known]
        sides, cut = zip(*(self._side(along, middle, sign * width) for sign in (-1.0, 1.0)), strict=True)
        return self._cells(along, borders, middle, np.stack(sides), np.stack(cut), columns)

    def _closed(self, closing: float) -> Floats | None:
        """The first and the last station (2,) at which the gap is less than ``closing``; None where it is nowhere."""
        along, gaps = self.profile.along, self.profile.gap
        for _ in range(_END_ROUNDS):
            (used,) = np.nonzero(gaps < closing)
            if len(used):
                break
            if not np.isfinite(gaps).any():
                return None
            at = int(np.nanargmin(gaps))
            along = np.linspace(along[max(at - 1, 0)], along[min(at + 1, len(along) - 1)], _END_STATIONS)
            gaps = self.least(along, self.nearest(along))
        else:
            return None
        inner = np.array([along[used[0]], along[used[-1]]])
        outer = np.array([along[max(used[0] - 1, 0)], along[min(used[-1] + 1, len(along) - 1)]])

        def touching(stations: Floats) -> Bools:
            flat = stations.ravel()
            return (self.least(flat, self.nearest(flat)) < closing).reshape(stations.shape)

        return _last(touching, inner, outer)

    def _side(self, along: Floats, middle: Floats, width: float) -> tuple[Floats, Bools]:
        """Offsets (R,) at which rows end to one side, and whether an edge of a flank ends them there."""
        end = middle + width
        cut = ~(self.margin(along, end) >= 0.0)
        if cut.any():
            end[cut] = self._border(along[cut], middle[cut], end[cut])
        return end, cut

    def _cells(
        self, along: Floats, bounds: Floats, middle: Floats, sides: Floats, cut: Bools, columns: int
    ) -> ContactGrid:
        rows = len(along)
        share = _shares(columns, bool(cut[0].any()), bool(cut[1].any()))
        borders = sides[0][:, None] + (sides[1] - sides[0])[:, None] * share
        size, offsets = np.diff(borders, axis=1), 0.5 * (borders[:, 1:] + borders[:, :-1])
        stations = np.broadcast_to(along[:, None], offsets.shape)
        centres = self.at(stations, offsets).reshape(-1, 2)
        feet = self.plane.feet(centres)
        of = self.plane.footprints(feet)
        known = np.all([one.inside for one in of.values()], axis=0)
        nearest = np.arange(len(feet))
        if not known.all() and known.any():
            # Beside an undercut a normal may meet another sheet of the surface: there the gap is that of the next cell.
            nearest = np.flatnonzero(known)[KDTree(centres[known]).query(centres)[1]]
            of = {name: one.at(nearest) for name, one in of.items()}
        gap, _ = self.plane.gap(of)
        # Straight above their feet, which are known better than where normals are met.
        up, met = self.plane.axes[2], of["pinion"].points
        points = feet + ((met - feet[nearest]) @ up)[:, None] * up
        normals, upright = of["pinion"].normals, of["pinion"].normals @ up
        frame, longer = self._on_flank(np.repeat(along, columns), normals)
        # Rows across a bent curve are longer on its outside, as their centres are further apart there.
        begin, end = self.at(bounds, np.zeros_like(bounds))
        straight = np.einsum("ri,ri->r", end - begin, self.directions(along)[:, 0])[:, None]
        turn = np.diff(self.way(bounds), axis=0).T
        length = np.maximum(straight - offsets * turn, _LEAST_LENGTH * straight)
        half = 0.5 * longer * np.stack([length.ravel(), size.ravel()], axis=1)
        ways = np.repeat(self.directions(along), columns, axis=0)
        next_row = np.asarray(np.gradient(centres.reshape(rows, columns, 2), axis=0)) if rows > 1 else ways[:, 0]
        onward = np.einsum("ni,nji->nj", next_row.reshape(-1, 2), ways)
        shear = np.where(onward[:, 0] > 0.0, onward[:, 1] / onward[:, 0], 0.0) * longer[:, 1] / longer[:, 0]
        turned, rectangle = _rectangles(half, shear)
        frame[:, :2], ways = turned @ frame[:, :2], turned @ ways
        free, beyond, sharp = self._bounds(along, bounds, offsets, sides, cut)
        middle_foot = feet.mean(axis=0)
        place = {name: flank.place(of[name], middle_foot) for name, flank in self.plane.flanks.items()}
        return ContactGrid(
            rows, columns, centres, half, rectangle, ways, frame, points, gap * upright, self.least(along, middle),
            (offsets - middle[:, None]).ravel(), free.reshape(2, -1), beyond, sharp, place,
            {name: flank.free_edges for name, flank in self.plane.flanks.items()},
        )  # fmt: skip

    def _bounds(
        self, along: Floats, bounds: Floats, offsets: Floats, sides: Floats, cut: Bools
    ) -> tuple[Bools, dict[str, Bools], Floats]:
        """The cells (2, R, C) at free borders of the grid along and across, by the name of an edge those (4, R C) that
        it bounds at either end and on either side, and how sharp edges are there.
        """
        rows, columns = offsets.shape
        number = np.arange(rows * columns).reshape(rows, columns)
        free = np.zeros((2, rows, columns), dtype=bool)
        away = _BEYOND * self.reach
        sides_of, cells, stations, beyond = [], [], [], []
        for side, column in ((0, 0), (1, -1)):
            free[1, ~cut[side], column] = True
            cells.append(number[cut[side], column])
            sides_of.append(np.full(len(cells[-1]), 2 + side))
            stations.append(along[cut[side]])
            beyond.append(sides[side][cut[side]] + (away if side else -away))
        for end, row in ((0, 0), (1, -1)):
            station = bounds[end, row] + away * (1.0 if end else -1.0)
            free[0, row] = self.margin(np.full(columns, station), offsets[row]) >= 0.0
            ended = ~free[0, row]
            cells.append(number[row, ended])
            sides_of.append(np.full(len(cells[-1]), end))
            stations.append(np.full(len(cells[-1]), station))
            beyond.append(offsets[row, ended])
        at = np.concatenate(sides_of), np.concatenate(cells)
        names: dict[str, Bools] = {}
        sharp = np.zeros((4, rows * columns))
        place = self.at(np.concatenate(stations), np.concatenate(beyond))
        footprints = self.plane.footprints(self.plane.feet(place))
        goes_on = np.max([of.margin for of in footprints.values()], axis=0)
        sharp[at] = np.clip(goes_on / _SHARP, 0.0, 1.0)
        for name, of in footprints.items():
            for edge, margin in of.margins.items():
                beside = of.pierced & (margin < 0.0)
                bounded = np.zeros(sharp.shape, dtype=np.bool_)
                bounded[at[0][beside], at[1][beside]] = True
                if bounded.any():
                    names[f"{edge} of the {name}"] = bounded
        return free, names, sharp


def _rectangles(half: Floats, shear: Floats) -> tuple[Floats, Floats]:
    """Rectangles as large as cells of half sides (N, 2), with the same second moments, where rows lie off the next
    ones by so much of their length, ``shear`` (N,): their directions (N, 2, 2) and half sides (N, 2).
    """
    (along, across), off = (half**2).T, shear
    angle = 0.5 * np.arctan2(2.0 * along * off, along * (1.0 - off**2) - across)
    longer = 0.5 * (along * (1.0 + off**2) + across + np.hypot(along * (1.0 - off**2) - across, 2.0 * along * off))
    directions = np.stack([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]).transpose(2, 0, 1)
    return directions, np.sqrt(np.stack([longer, along * across / longer], axis=1))


def _shares(count: int, first: bool, last: bool) -> Floats:
    """Shares (count + 1,) of a length at the borders of its parts, the shorter the nearer to an edge, where there is
    one at the first and the last.
    """
    share = np.linspace(0.0, 1.0, count + 1)
    one = _SHORTER * np.sin(np.pi * share) / np.pi
    both = 0.5 * _SHORTER * np.sin(2.0 * np.pi * share) / np.pi
    return share - (both if first and last else (float(first) - float(last)) * one)


def _last(holds: Callable[[Floats], Bools], inner: Floats, outer: Floats) -> Floats:
    """The last (R,) of the numbers from inner to outer ones at which something holds, as it does at the inner ones."""
    share, rows = np.linspace(0.0, 1.0, _END_STATIONS + 1), np.arange(len(inner))
    for _ in range(_END_ROUNDS if len(inner) else 0):
        places = inner[:, None] + (outer - inner)[:, None] * share
        held = holds(places)
        held[:, 0] = True
        last = np.where(held.all(axis=1), _END_STATIONS, np.argmin(held, axis=1) - 1)
        inner, outer = places[rows, last], places[rows, np.minimum(last + 1, _END_STATIONS)]
    return inner


def _least_gap(plane: ContactPlane, along: Floats, low: float, high: float) -> Floats:
    """Second coordinates (K,) at which the surfaces of both flanks, limits apart, come nearest to one another.

    From the best of some places on both flanks on by Newton's method with central differences; beyond the flanks, where
    surfaces may cut one another, from what is next to that.
    """
    step = _DIFFERENCE * (high - low)
    lattice = np.linspace(low, high, _STARTS)
    gaps = _gaps(plane, along, np.tile(lattice, (len(along), 1)), limits=True)
    best = np.nan_to_num(gaps, nan=np.inf)
    across = _between(along, np.where(np.isfinite(gaps).any(axis=1), lattice[np.argmin(best, axis=1)], np.nan))
    for _ in range(_STEPS):
        before, here, after = _gaps(plane, along, across[:, None] + step * np.array([-1.0, 0.0, 1.0])).T
        bend = (after - 2.0 * here + before) / step**2
        move = -0.5 * (after - before) / (step * np.where(bend > 0.0, bend, np.nan))
        across = across + np.clip(move, -0.25 * (high - low), 0.25 * (high - low))
    beyond = high - low
    return _between(along, np.where((across > low - beyond) & (across < high + beyond), across, np.nan))


def _between(along: Floats, values: Floats) -> Floats:
    """Values (K,) at stations, where they are not numbers between those of the next ones that are; else 0."""
    known = np.isfinite(values)
    return np.interp(along, along[known], values[known]) if known.any() else np.zeros_like(along)


def _gaps(plane: ContactPlane, along: Floats, across: Floats, limits: bool = False) -> Floats:
    """Gaps (K, M) along the plane's normal at the first coordinates (K,) and the second ones (K, M), of the surfaces,
    or of the flanks within their limits.
    """
    places = np.stack(np.broadcast_arrays(along[:, None], across), axis=-1).reshape(-1, 2)
    of = plane.footprints(plane.feet(places))
    gap, inside = plane.gap(of)
    there = inside if limits else of["pinion"].pierced & of["wheel"].pierced
    return np.where(there, gap, np.nan).reshape(across.shape)
