"""Undercut teeth: flank and fillet end where they cross, a limit of both regions like those of blank and tool.

The limit is the height of the crossing in each section of the tooth, an interpolant between sections in which it is
found by Newton's method. What lies below it on the flank, or above it on the fillet, the tool has cut away.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev

from meshwright.base.errors import UsageError
from meshwright.flank.bounds import Limit
from meshwright.flank.lines import SINGULAR, changes
from meshwright.flank.region import Region, region
from meshwright.flank.sections import Sections, lengthwise, lengthwise_slopes
from meshwright.flank.sides import PLACES_ALONG, Bools, Floats, RegionSide

#: Name of the limit.
JUNCTION = "junction"

#: An interpolant is refined until it is within so many mm midway between its sections, of which it has at most so many.
EXACT, FEWEST, MOST = 1e-7, 16, 256

#: Where undercut begins within the face the first section with a crossing is so far on, in parts of their distance.
BEFORE_END = 1e-8

#: It goes on beyond the faces of the tooth by this part of their distance.
ROOM = 1e-6


@dataclass(frozen=True)
class Piece:
    """Height of the crossing between the sections ``first`` and ``last``: coefficients of a Chebyshev series."""

    first: float
    last: float
    series: Floats

    @classmethod
    def of(cls, side: RegionSide, first: float, last: float) -> Piece:
        """The piece refined until it is exact midway between its nodes as well."""
        count = FEWEST
        heights = _heights(side, _nodes(first, last, count))
        while True:
            found = cls(first, last, np.asarray(chebyshev.chebfit(_cosines(count), heights, count), dtype=float))
            between = _nodes(first, last, 2 * count)[1::2]
            exact = _heights(side, between)
            if np.abs(found(between) - exact).max() <= EXACT or 2 * count > MOST:
                return found
            heights = np.insert(heights, np.arange(1, count + 1), exact)
            count *= 2

    def __call__(self, along: Floats) -> Floats:
        """Heights (N,) in mm in sections (N,)."""
        return np.asarray(chebyshev.chebval(self._place(along), self.series), dtype=float)

    def slopes(self, along: Floats) -> Floats:
        """Their slopes (N,)."""
        slopes = chebyshev.chebval(self._place(along), chebyshev.chebder(self.series)) / self._half
        return np.asarray(slopes, dtype=float)

    def _place(self, along: Floats) -> Floats:
        return (along - 0.5 * (self.first + self.last)) / self._half

    @property
    def _half(self) -> float:
        return 0.5 * (self.last - self.first)


@dataclass(frozen=True)
class Crossing:
    """Where flank and fillet of a side of a tooth cross; ``outward``: 1 or -1 as the height grows towards the tip.
    ``reach``: first and last section of the flank.
    """

    sections: Sections
    reach: tuple[float, float]
    pieces: tuple[Piece, ...]
    outward: float

    @classmethod
    def of(cls, side: RegionSide) -> Crossing | None:
        """None where they nowhere cross."""
        reach = side.reach
        at = np.linspace(*reach, PLACES_ALONG + 2)[1:-1]
        crossed = side.crossed(at)
        ends = [reach[0], *changes(at, side.crossed, crossed), reach[1]]
        first = np.concatenate([[crossed[0]], crossed[1:][crossed[1:] != crossed[:-1]]])
        inside = BEFORE_END * (reach[1] - reach[0])
        starts = [low if low == reach[0] else low + inside for low in ends[:-1]]
        stops = [high if high == reach[1] else high - inside for high in ends[1:]]
        spans = zip(starts, stops, first, strict=True)
        pieces = [Piece.of(side, low, high) for low, high, cut in spans if cut]
        if not pieces:
            return None
        line = side.at(np.array([0.5 * (pieces[0].first + pieces[0].last)]))[0]
        low, high = (side.sections.height(line.region.flank(end).points)[0] for end in (line.lower, line.upper))
        return cls(side.sections, reach, tuple(pieces), float(np.sign(high - low) * (1.0 if side.tip else -1.0)))

    def bounds(self, found: Region) -> Region:
        """The region of the flank or of the fillet with this limit."""
        sign = self.outward if found.flank.region == "flank" else -self.outward
        limit = Limit(
            JUNCTION,
            lambda at: self._within(found.flank, at, sign),
            lambda at: self._within_slopes(found.flank, at, sign),
        )
        return found.within(limit)

    def _within(self, flank: Any, found: Any, sign: float) -> Floats:
        """How far (N,) points lie within the limit, mm, not a number in sections without one."""
        along, values = lengthwise(flank, found), np.full(len(found.points), np.nan)
        height = self.sections.height(found.points)
        for piece, here in self._shares(along):
            values[here] = sign * (height[here] - piece(along[here]))
        return values

    def _within_slopes(self, flank: Any, found: Any, sign: float) -> Floats:
        """The slopes (N, k) of that by the parameters."""
        along, slopes = lengthwise(flank, found), np.full(found.parameters.shape, np.nan)
        height_slopes, along_slopes = self._height_slopes(found), lengthwise_slopes(flank, found)
        for piece, here in self._shares(along):
            slopes[here] = sign * (height_slopes[here] - piece.slopes(along[here])[:, None] * along_slopes[here])
        return slopes

    def _shares(self, along: Floats) -> Iterator[tuple[Piece, Bools]]:
        """Each piece, and which of the sections (N,) are its own."""
        room = ROOM * (self.reach[1] - self.reach[0])
        for piece in self.pieces:
            # lines at the very faces lie beyond them by rounding
            low = piece.first - (room if piece.first == self.reach[0] else 0.0)
            high = piece.last + (room if piece.last == self.reach[1] else 0.0)
            yield piece, (along >= low) & (along <= high)

    def _height_slopes(self, found: Any) -> Floats:
        """Slopes (N, k) of the height by the parameters."""
        sine, cosine = self.sections.sides
        radius = np.hypot(found.points[:, 0], found.points[:, 1])[:, None]
        radial = np.einsum("nkj,nj->nk", found.tangents[:, :, :2], found.points[:, :2]) / radius
        return cosine * radial - sine * found.tangents[:, :, 2]


def crossing(drive: Any, member: str) -> Crossing | None:
    """Where the fillet of a member cuts its flank off; None where it does not, or the design leaves it open."""
    side = undercut_side(drive, member)
    return None if side is None else Crossing.of(side)


def undercut_side(drive: Any, member: str) -> RegionSide | None:
    """The side of a tooth whose flank ends at its singular line and may be cut off by its fillet; None as above."""
    regions = {(r["name"], r["region"]) for r in drive.design.description["regions"]}
    if drive.flank(member).sections is None or (member, "fillet") not in regions:
        return None
    flank = region(drive, member, "flank", drive.uses)
    if flank.empty or not _ends_at_singular_line(flank):
        return None
    try:
        fillet = region(drive, member, "fillet", drive.uses)
        return None if fillet.empty else RegionSide.of(flank, fillet)
    except UsageError:
        return None  # the design does not say how the tool is rounded, or where the tooth ends


def _ends_at_singular_line(flank: Region) -> bool:
    """Whether the surface's own singular line is part of its border."""
    return any(flank.limits.names[k] in SINGULAR for k in np.unique(flank.triangles.limit))


def _cosines(count: int) -> Floats:
    return -np.cos(np.pi * np.arange(count + 1) / count)


def _nodes(first: float, last: float, count: int) -> Floats:
    """Chebyshev's points of the second kind (count + 1,), ascending."""
    found = 0.5 * (first + last) + 0.5 * (last - first) * _cosines(count)
    found[[0, -1]] = first, last
    return found


def _heights(side: RegionSide, values: Floats) -> Floats:
    """Heights (K,) in sections (K,) at which the flank ends on the fillet."""
    return side.sections.height(side.flank.region.flank(side.joint(values)[0]).points)
