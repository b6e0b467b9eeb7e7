"""A side of a tooth in any of its sections, from those in which it is known: fast where sections are few or many.

Between two known sections whose lines end for the same reasons, a limit, a crossing of flank and fillet or the end of
the fillet on the flank, the ends are found by Newton's method from those beside them; elsewhere the side itself finds
them. Where the reasons change, sections are known closer and closer to the change. The profile's parameter at the ends
is analytic in between: Chebyshev polynomials tell it, on pieces as short as they need to be: L. N. Trefethen,
Approximation Theory and Approximation Practice (2013).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from meshwright.flank.lines import ROUNDING, Lines, ended_by
from meshwright.flank.region import Region
from meshwright.flank.sections import lengthwise, lengthwise_slopes, solved
from meshwright.flank.sides import Bools, Floats, Ints, RegionSide

#: Sections in which a side is known, equally far apart.
KNOWN = 65
#: A distance between two of them that end for other reasons is divided into so many parts, and so often; not where
#: there are more of them: such reasons are hard to tell apart, and change at no place.
PARTS, TIMES, MOST = 16, 2, 12
NEWTON_STEPS = 12
#: A step of this, in sizes of the parameters, is none.
STILL = 1e-14
#: Why a line ends: the number of a limit, or one of these.
JOINED, CROSSED, ELSEWHERE = -3, -2, -1
#: Terms of the polynomials; their last ones are no more than this part of the parameter's size; so often pieces are
#: halved until that is so. They are made when so many sections are asked for at once.
TERMS, TAIL, TOLD, HALVINGS, MANY = 16, 3, 1e-11, 8, 128


@dataclass(frozen=True)
class KnownSide:
    """A side and, at ascending ``values`` (V,), its ``flank`` and ``fillet``, up to where they meet.

    ``ends``: by region and end, (V,) why lines end there.
    """

    side: RegionSide
    values: Floats
    flank: Lines
    fillet: Lines | None
    ends: dict[tuple[str, bool], Ints]
    found: dict[bytes, tuple[Lines, Lines | None]] = field(default_factory=dict, repr=False)
    pieces: list[_Pieces] = field(default_factory=list, repr=False)

    @classmethod
    def of(cls, side: RegionSide, faces: tuple[float, float]) -> KnownSide:
        """Raises UsageError where a section holds no flank or fillet."""
        known = cls._of(side, np.linspace(*faces, KNOWN))
        for _ in range(TIMES):
            changed = np.flatnonzero(np.any([why[:-1] != why[1:] for why in known.ends.values()], axis=0))
            if not 0 < len(changed) <= MOST:
                break
            first, last = known.values[changed], known.values[changed + 1]
            known = known._with(cls._of(side, np.linspace(first, last, PARTS + 1)[1:-1].T.ravel()))
        return known

    def _with(self, more: KnownSide) -> KnownSide:
        """Both as one."""
        order = np.argsort(np.concatenate([self.values, more.values]))
        ends = {key: np.concatenate([why, more.ends[key]])[order] for key, why in self.ends.items()}
        fillet = self.fillet and more.fillet and _together(self.fillet, more.fillet, order)
        flank = _together(self.flank, more.flank, order)
        return KnownSide(self.side, flank.along, flank, fillet, ends)

    @classmethod
    def _of(cls, side: RegionSide, values: Floats) -> KnownSide:
        """In the sections (V,) alone."""
        flank, fillet = side.at(values)
        ends = {}
        for name, own, whole in (("flank", side.flank, flank), ("fillet", side.fillet, fillet)):
            if own is None or whole is None:
                continue
            before = own.at(values)
            for upper in (False, True):
                moved = _end(before, upper) != _end(whole, upper)
                ends[name, upper] = np.where(moved.any(axis=1), CROSSED, ended_by(whole, upper))
        joints = ("flank", not side.tip), ("fillet", not side.land)
        if fillet is not None:
            both = np.array([ends[joint] == CROSSED for joint in joints])
            ends[joints[0]][both[0] & ~both[1]] = JOINED  # the flank goes on beyond the end of the fillet on it
            ends[joints[1]][both[1] & ~both[0]] = ELSEWHERE
        return cls(side, values, flank, fillet, ends)

    def lines(self, name: str, values: Floats | None = None) -> Lines:
        """Those of flank or fillet in sections (K,), None for the known ones."""
        flank, fillet = (self.flank, self.fillet) if values is None else self.at(values)
        found = flank if name == "flank" else fillet
        if found is None:
            raise ValueError(f"this side has no {name}")
        return found

    def at(self, values: Floats) -> tuple[Lines, Lines | None]:
        """Flank and fillet in sections (K,), kept."""
        key = values.tobytes()
        if key not in self.found:
            self.found[key] = self._at(values)
        return self.found[key]

    def profiles(self, name: str, values: Floats) -> tuple[Floats, Floats]:
        """The profile's parameter (K,) at the lower and at the upper ends of flank or fillet in sections (K,)."""
        if not self.pieces and len(values) >= MANY:
            self.pieces.append(_Pieces.of(self))
        if self.pieces:
            found, told = self.pieces[0].at(values)
            if not told.all():
                found[~told] = self.exact_profiles(values[~told])
        else:
            found = self.exact_profiles(values)
        first = 0 if name == "flank" else 2
        return found[:, first], found[:, first + 1]

    def exact_profiles(self, values: Floats) -> Floats:
        """The profile's parameter (K, E) at both ends of the flank, and of the fillet if there is one."""
        whole = [lines for lines in self.at(values) if lines]
        return np.column_stack([end[:, lines.region.profile] for lines in whole for end in (lines.lower, lines.upper)])

    def _at(self, values: Floats) -> tuple[Lines, Lines | None]:
        sure = self._between_alike(values)
        flank = self._near(self.flank, "flank", values, sure)
        fillet = self.fillet and self._near(self.fillet, "fillet", values, sure)
        if fillet is not None:
            flank, fillet = self._crossing(self._joined(flank, fillet, sure), fillet, sure)
        if sure.all():
            return flank, fillet
        exact, beside = self.side.at(values[~sure])
        return _put(flank, ~sure, exact), fillet and beside and _put(fillet, ~sure, beside)

    def _between_alike(self, values: Floats) -> Bools:
        """Whether (K,) lines end for the same reasons, known ones, in the known sections on either side."""
        before, _ = self.beside(values)
        return (values >= self.values[0]) & (values <= self.values[-1]) & self.alike[before]

    @property
    def alike(self) -> Bools:
        """Whether (V - 1,) lines end for the same reasons, known ones, in a known section and the next."""
        same = [(why[:-1] == why[1:]) & (why[:-1] != ELSEWHERE) for why in self.ends.values()]
        return np.all(same, axis=0)

    def beside(self, values: Floats) -> tuple[Ints, Floats]:
        """Number (K,) of the known section before each, and the share (K, 1) of the way to the next."""
        before = np.clip(np.searchsorted(self.values, values, side="right") - 1, 0, len(self.values) - 2)
        first, last = self.values[before], self.values[before + 1]
        return before, np.clip((values - first) / (last - first), 0.0, 1.0)[:, None]

    def _near(self, known: Lines, name: str, values: Floats, sure: Bools) -> Lines:
        """Lines in sections (K,) from the known ones; ``sure`` (K,) is false from then on where one is not found."""
        before, rest = self.beside(values)
        ends = []
        for upper in (False, True):
            end, why = _end(known, upper), self.ends[name, upper][before]
            places = (1.0 - rest) * end[before] + rest * end[before + 1]
            limited = sure & (why >= 0)
            places[limited], held = _onto(known.region, why[limited], values[limited], places[limited])
            sure[limited] &= held
            ends.append(places)
        return Lines(known.region, values, *ends)

    def _joined(self, flank: Lines, fillet: Lines, sure: Bools) -> Lines:
        """The lines of the flank up to the ends of the fillet's, where those beside them end there."""
        upper = not self.side.tip
        before, _ = self.beside(flank.along)
        joined = sure & (self.ends["flank", upper][before] == JOINED)
        if not joined.any():
            return flank
        some, end = _some(flank, joined), _end(fillet, not self.side.land)[joined]
        joint = fillet.region.flank(end).points
        q, of, size = _end(some, upper).copy(), some.region.profile, some.region.chart.sizes[some.region.profile]
        for _ in range(NEWTON_STEPS):
            q = some.onto(q)
            points, way = some.slopes(q)
            step = np.sum((points - joint) * way, axis=1) / np.sum(way * way, axis=1)
            q[:, of] -= step
            if not (np.abs(step) > STILL * size).any():
                break
        q = some.onto(q)
        sure[joined] &= np.linalg.norm(some.region.flank(q).points - joint, axis=1) < ROUNDING
        return _moved(flank, upper, joined, q)

    def _crossing(self, flank: Lines, fillet: Lines, sure: Bools) -> tuple[Lines, Lines]:
        """The lines up to where they cross, where those beside them do."""
        joints = not self.side.tip, not self.side.land
        before, _ = self.beside(flank.along)
        crossed = sure & (self.ends["flank", joints[0]][before] == CROSSED)
        if not crossed.any():
            return flank, fillet
        both = [_some(lines, crossed) for lines in (flank, fillet)]
        places = [_end(lines, upper) for lines, upper in zip(both, joints, strict=True)]
        found = self.side.crossing_near(both[0], both[1], [q.copy() for q in places])
        points = [lines.region.flank(q).points for lines, q in zip(both, found, strict=True)]
        sure[crossed] &= np.linalg.norm(points[0] - points[1], axis=1) < ROUNDING
        return _moved(flank, joints[0], crossed, found[0]), _moved(fillet, joints[1], crossed, found[1])


@dataclass(frozen=True)
class _Pieces:
    """Polynomials on P pieces, ascending, from ``low`` to ``high`` (P,): coefficients ``terms`` (P, TERMS, E)."""

    low: Floats
    high: Floats
    terms: Floats

    @classmethod
    def of(cls, known: KnownSide) -> _Pieces:
        """Those of the exact profiles of a side; none where they are no such polynomials."""
        turns = np.pi * (np.arange(TERMS) + 0.5) / TERMS
        fit = np.cos(np.arange(TERMS)[:, None] * turns) * (2.0 / TERMS)
        fit[0] *= 0.5
        regions = [lines.region for lines in (known.flank, known.fillet) if lines]
        sizes = np.repeat([region.chart.sizes[region.profile] for region in regions], 2)
        edges = np.flatnonzero(np.diff(np.concatenate([[0], known.alike.astype(int), [0]])))
        low, high = known.values[edges[::2]], known.values[edges[1::2]]
        done: list[tuple[Floats, Floats, Floats]] = [(np.empty(0), np.empty(0), np.empty((0, TERMS, len(sizes))))]
        for _ in range(HALVINGS + 1):
            if not len(low):
                break
            places = 0.5 * (low + high)[:, None] + 0.5 * (high - low)[:, None] * np.cos(turns)
            terms = fit @ known.exact_profiles(places.ravel()).reshape(*places.shape, -1)
            told = np.all(np.abs(terms[:, -TAIL:]) <= TOLD * sizes, axis=(1, 2))
            done.append((low[told], high[told], terms[told]))
            middle = 0.5 * (low + high)[~told]
            low, high = np.concatenate([low[~told], middle]), np.concatenate([middle, high[~told]])
        joined = [np.concatenate(column) for column in zip(*done, strict=True)]
        order = np.argsort(joined[0])
        return cls(*(column[order] for column in joined))

    def at(self, values: Floats) -> tuple[Floats, Bools]:
        """Profiles (K, E) in sections (K,), and whether (K,) they are told."""
        found = np.empty((len(values), self.terms.shape[2]))
        piece = np.searchsorted(self.low, values, side="right") - 1
        told = piece >= 0
        told[told] = values[told] <= self.high[piece[told]]
        piece, terms = piece[told], self.terms[piece[told]]
        share = (2.0 * values[told] - self.low[piece] - self.high[piece]) / (self.high[piece] - self.low[piece])
        later, last = np.zeros_like(terms[:, 0]), terms[:, -1]
        for k in range(TERMS - 2, 0, -1):
            later, last = last, terms[:, k] + 2.0 * share[:, None] * last - later
        found[told] = terms[:, 0] + share[:, None] * last - later
        return found, told


def _end(lines: Lines, upper: bool) -> Floats:
    return lines.upper if upper else lines.lower


def _moved(lines: Lines, upper: bool, chosen: Bools, q: Floats) -> Lines:
    end = _end(lines, upper).copy()
    end[chosen] = q
    return lines.moved(upper=end) if upper else lines.moved(lower=end)


def _together(lines: Lines, others: Lines, order: Ints) -> Lines:
    ends = ("along", "lower", "upper")
    both = (np.concatenate([getattr(lines, name), getattr(others, name)])[order] for name in ends)
    return Lines(lines.region, *both)


def _some(lines: Lines, chosen: Bools) -> Lines:
    return replace(lines, along=lines.along[chosen], lower=lines.lower[chosen], upper=lines.upper[chosen])


def _put(lines: Lines, chosen: Bools, others: Lines) -> Lines:
    return _moved(_moved(lines, False, chosen, others.lower), True, chosen, others.upper)


def _onto(region: Region, limits: Ints, values: Floats, start: Floats) -> tuple[Floats, Bools]:
    """Parameters (K, k) where limits (K,) are zero in sections (K,), from places near that; and whether they are within
    all limits.
    """
    q, rows = start.copy(), np.arange(len(start))
    if not len(q):
        return q, np.ones(0, dtype=bool)
    for _ in range(NEWTON_STEPS):
        found = region.flank(q)
        reached, along = lengthwise(region.flank, found), lengthwise_slopes(region.flank, found)
        off = region.limits.values(found)[rows, limits]
        residual = np.concatenate([np.stack([off, reached - values], axis=1), found.conditions[:, :, 0]], axis=1)
        slopes = np.stack([region.limits.slopes(found)[rows, limits], along], axis=1)
        step = solved(np.concatenate([slopes, found.conditions[:, :, 1:]], axis=1), residual)
        q = q - step
        if not (np.abs(step / region.chart.sizes) > STILL).any():
            break
    found = region.flank(q)
    reached = lengthwise(region.flank, found)
    held = (region.limits.values(found).min(axis=1) >= -ROUNDING) & (np.abs(reached - values) < ROUNDING)
    return q, held & np.isfinite(q).all(axis=1)
