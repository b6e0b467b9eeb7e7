"""Sides of a tooth in its sections: fillet and flank between root and tip, as generated, within the member's limits.

Where the tool undercuts the tooth, its flank ends on the fillet: both are then followed up to where they cross. A flank
without a fillet of its own ends at its root.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from meshwright.base.errors import UsageError
from meshwright.flank.lines import Lines, changes, ended_by
from meshwright.flank.region import Region
from meshwright.flank.sections import Sections

Floats = NDArray[np.floating[Any]]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

#: Roles of the limits that end a flank at its tip, and a fillet at the root land.
TIPS, BOTTOMS = ("tip", "throat"), ("bottom",)

#: Flank and fillet meet where their ends are no further apart, mm; else they are cut where they cross, found between so
#: many places on each and then by Newton's method.
TOGETHER, PLACES, NEWTON_STEPS, STILL = 1e-6, 129, 30, 1e-13

#: Sections in which a side is looked at; what a modification of a flank is at most, mm.
PLACES_ALONG, MODIFIED = 17, 0.1


class Side(Protocol):
    """A side of a tooth: its fillet, if there is one, and its flank, between which there may be a step."""

    @property
    def sections(self) -> Sections: ...

    @property
    def has_fillet(self) -> bool: ...

    @property
    def has_step(self) -> bool: ...

    def grids(self, values: Floats, fillet: Floats, flank: Floats) -> tuple[Floats, Floats, Floats]:
        """Points of fillet (K, F, 3) and flank (K, J, 3) and the flank's normals, at section values (K,), ascending,
        and at shares (F,), (J,) of the ways from root land to joint and from joint to tip. Without a fillet the first
        is the joint alone, (K, 1, 3).
        """
        ...

    def breaks(self) -> Floats:
        """Section values at which an end of the side has a corner, ascending."""
        ...


@dataclass(frozen=True)
class RegionSide:
    """The side that a flank and a fillet make whose regions have lines in all sections of the tooth.

    ``tip`` says whether the tip is at the flank lines' upper end, ``land`` whether the root land is at the fillet's. A
    modified flank may lie deeper than the end of its fillet everywhere: then the side ``has_step``.
    """

    sections: Sections
    flank: Lines
    fillet: Lines | None
    tip: bool
    land: bool
    has_step: bool = False

    @classmethod
    def of(cls, flank: Region, fillet: Region | None = None) -> RegionSide:
        """Raises UsageError where a region is empty, or no limit of the flank is a tip."""
        for one in (flank, fillet):
            if one is not None and one.empty:
                raise UsageError(f"{one.why_empty}; change [blank] or [design]")
        sections = flank.flank.sections
        found = flank.lines
        tip = _tip_is_upper(found)
        if fillet is None:
            return cls(sections, found, None, tip, False)
        beside, middle = fillet.lines, 0.5 * (found.along[0] + found.along[-1])
        ends = _ends(beside)
        if not np.linalg.norm(ends[1] - ends[0], axis=1).max() > TOGETHER:  # a sharp tool cuts none
            return cls(sections, found, None, tip, False)
        root = _ends(found.at(np.array([middle])))[0 if tip else 1]
        away = [np.linalg.norm(end - root) for end in _ends(beside.at(np.array([middle])))]
        # a fillet that crosses an undercut flank may go on far beyond it
        lower, upper = (_ended(beside, end, BOTTOMS) for end in (False, True))
        side = cls(sections, found, beside, tip, bool(upper > lower if upper != lower else away[1] > away[0]))
        return replace(side, has_step=side._stepped())

    @property
    def has_fillet(self) -> bool:
        return self.fillet is not None

    @property
    def reach(self) -> tuple[float, float]:
        """First and last section that the flank reaches."""
        return float(self.flank.along[0]), float(self.flank.along[-1])

    def grids(self, values: Floats, fillet: Floats, flank: Floats) -> tuple[Floats, Floats, Floats]:
        """As :class:`Side` says. Raises UsageError where a section holds no flank."""
        above, below = self.at(values)
        points, normals = _grid(above, flank, self.tip)
        if below is None:
            return points[:, :1], points, normals
        rounded, _ = _grid(below, fillet, not self.land)
        if not self.has_step:
            rounded[:, -1] = points[:, 0]
        return rounded, points, normals

    def joint(self, values: Floats) -> tuple[Floats, Floats]:
        """Parameters (K, k), (K, l) of flank and fillet where they meet in sections (K,); without a fillet both are the
        flank's.
        """
        flank, fillet = self.at(values)
        root = flank.lower if self.tip else flank.upper
        if fillet is None:
            return root, root
        return root, (fillet.lower if self.land else fillet.upper)

    def breaks(self) -> Floats:
        """As :class:`Side` says."""
        at = np.linspace(*self.reach, 4 * len(self.flank.along))[1:-1]
        return np.unique(np.concatenate([changes(at, self._tips), changes(at, self.crossed)]))

    def _tips(self, values: Floats) -> Floats:
        """Numbers (K,) of the limits that end the flank at its tip."""
        found = self.flank.at(values)
        return ended_by(found, self.tip)

    def _stepped(self) -> bool:
        """Whether flank and fillet end beside each other in all sections, not further apart than a modification."""
        if self.fillet is None:
            return False
        values = np.linspace(*self.reach, PLACES_ALONG)
        flank, fillet = self.flank.at(values), self.fillet.at(values)
        flank = self._up_to(flank, fillet)
        away = self._away(flank, fillet)
        if not ((away > TOGETHER) & (away < MODIFIED)).all():
            return False
        return all(hit is None for hit in self._hits(flank, fillet)[1])

    def crossed(self, values: Floats) -> Bools:
        """Whether (K,) flank and fillet cross."""
        if self.fillet is None or self.has_step:
            return np.zeros(len(values), dtype=bool)
        fillet = self.fillet.at(values)
        return self._apart(self._up_to(self.flank.at(values), fillet), fillet)

    def _away(self, flank: Lines, fillet: Lines) -> Floats:
        root, joint = _ends(flank)[0 if self.tip else 1], _ends(fillet)[0 if self.land else 1]
        return np.linalg.norm(root - joint, axis=1)

    def _apart(self, flank: Lines, fillet: Lines) -> Bools:
        return self._away(flank, fillet) > TOGETHER

    def at(self, values: Floats) -> tuple[Lines, Lines | None]:
        """Flank and fillet in sections, up to where they meet. Raises UsageError where one of them is missing."""
        flank = self.flank.at(values)
        _check(flank, values)
        if self.fillet is None:
            return flank, None
        fillet = self.fillet.at(values)
        _check(fillet, values)
        if self.has_step:
            return flank, fillet
        flank = self._up_to(flank, fillet)
        apart = self._apart(flank, fillet)
        if not apart.any():
            return flank, fillet
        crossing = self._crossing(_some(flank, apart), _some(fillet, apart))
        return _ending(flank, not self.tip, apart, crossing[0]), _ending(fillet, not self.land, apart, crossing[1])

    def _up_to(self, flank: Lines, fillet: Lines) -> Lines:
        """The flank up to the fillet's joint where that lies on it: a tool's profile may go on beyond its rounding."""
        apart = self._apart(flank, fillet)
        if not apart.any():
            return flank
        some = _some(flank, apart)
        joint = _ends(fillet)[0 if self.land else 1][apart]
        q = some.spaced(np.linspace(0.0, 1.0, PLACES))
        near = np.argmin(np.linalg.norm(_points(some, q) - joint, axis=2), axis=0)
        column, points = np.arange(q.shape[1]), _points(some, q)
        ends = np.clip(near - 1, 0, PLACES - 1), np.clip(near + 1, 0, PLACES - 1)
        chord = points[ends[1], column] - points[ends[0], column]
        q = some.nearest(joint, chord, q[ends[0], column], q[ends[1], column])
        on = np.linalg.norm(some.region.flank(q).points - joint, axis=1) <= TOGETHER
        chosen = np.flatnonzero(apart)[on]
        return _ending(flank, not self.tip, chosen, q[on])

    def _crossing(self, flank: Lines, fillet: Lines) -> tuple[Floats, Floats]:
        """Parameters (K, k) of flank and fillet where they cross in each section, nearest to the tip."""
        q, hits = self._hits(flank, fillet)
        start = []
        for k, hit in enumerate(hits):
            if hit is None:
                body = flank.region.flank.body["name"]
                raise UsageError(
                    f"the {body} is undercut and its fillet does not reach its flank in the section at "
                    f"{flank.along[k]:.6g} mm along its teeth: change [blank], or the tool's tip in [design]"
                )
            start.append([_mixed(places[:, k], at) for places, at in zip(q, hit, strict=True)])
        places = [np.array(column) for column in zip(*start, strict=True)]
        return self.crossing_near(flank, fillet, places)

    def _hits(self, flank: Lines, fillet: Lines) -> tuple[list[Floats], list[tuple[float, float] | None]]:
        """Places (P, K, k) on both from afar to where they meet, closer and closer since where little is cut away they
        cross near their ends; and the crossing in each section in numbers of places.
        """
        shares = 1.0 - np.linspace(1.0, 0.0, PLACES) ** 3
        q = [
            one.spaced(shares) if upper else one.spaced(1.0 - shares[::-1])[::-1]
            for one, upper in ((flank, not self.tip), (fillet, not self.land))
        ]
        points = [_points(one, places) for one, places in zip((flank, fillet), q, strict=True)]
        flat = [self._flat(of, points[0][0]) for of in points]
        return q, [_first_hit(flat[0][:, k], flat[1][:, k]) for k in range(flat[0].shape[1])]

    def crossing_near(self, flank: Lines, fillet: Lines, places: list[Floats]) -> tuple[Floats, Floats]:
        """Parameters (K, k), (K, l) where flank and fillet cross in each section, from places near that on both."""
        both = (flank, fillet)
        for _ in range(NEWTON_STEPS):
            places = [one.onto(q) for one, q in zip(both, places, strict=True)]
            (x, dx), (y, dy) = (one.slopes(q) for one, q in zip(both, places, strict=True))
            off, matrix = self._flat_change(x, y - x), np.stack(
                [self._flat_change(x, dx), -self._flat_change(y, dy)], axis=2
            )
            step = (np.linalg.pinv(matrix) @ off[:, :, None])[:, :, 0]
            for q, change, one in zip(places, step.T, both, strict=True):
                of = one.region.profile
                width = np.abs(one.upper[:, of] - one.lower[:, of])
                q[:, of] += np.clip(change, -0.05 * width, 0.05 * width)
            if np.abs(off).max() < STILL:
                break
        return tuple(one.onto(q) for one, q in zip(both, places, strict=True))

    def _flat(self, points: Floats, beside: Floats) -> Floats:
        """Height in mm and azimuth in rad (P, K, 2) of points (P, K, 3), the latter from that of others (K, 3)."""
        along = np.einsum("pki,ki->pk", points[..., :2], beside[:, :2])
        across = beside[:, 0] * points[..., 1] - beside[:, 1] * points[..., 0]
        return np.stack([self.sections.height(points), np.arctan2(across, along)], axis=-1)

    def _flat_change(self, points: Floats, change: Floats) -> Floats:
        """Change of height and length around the axis (K, 2) at points (K, 3) that move by ``change`` (K, 3)."""
        radius = np.hypot(points[:, 0], points[:, 1])
        outward = np.sum(points[:, :2] * change[:, :2], axis=1) / radius
        around = (points[:, 0] * change[:, 1] - points[:, 1] * change[:, 0]) / radius
        sine, cosine = self.sections.sides
        return np.stack([cosine * outward - sine * change[:, 2], around], axis=1)


def _points(found: Lines, q: Floats) -> Floats:
    return found.region.flank(q.reshape(-1, q.shape[2])).points.reshape(*q.shape[:2], 3)


def _grid(found: Lines, shares: Floats, forward: bool) -> tuple[Floats, Floats]:
    """Points and normals (K, J, 3) at shares (J,) of the lines, from the lower to the upper end or back."""
    q = found.even(shares if forward else 1.0 - shares[::-1])
    at = found.region.flank((q if forward else q[::-1]).reshape(-1, q.shape[2]))
    return tuple(np.swapaxes(a.reshape(*q.shape[:2], 3), 0, 1) for a in (at.points, at.normals))


def _ends(found: Lines) -> tuple[Floats, Floats]:
    """Points (M, 3) of the lower and the upper ends."""
    return found.region.flank(found.lower).points, found.region.flank(found.upper).points


def _ending(found: Lines, upper: bool, chosen: Bools | Ints, q: Floats) -> Lines:
    """The lines with another end (C, k) of some."""
    end = (found.upper if upper else found.lower).copy()
    end[chosen] = q
    return found.moved(upper=end) if upper else found.moved(lower=end)


def _some(found: Lines, chosen: Bools) -> Lines:
    return Lines(found.region, found.along[chosen], found.lower[chosen], found.upper[chosen])


def _check(found: Lines, values: Floats) -> None:
    missed = ~np.isfinite(found.lower[:, 0])
    if missed.any():
        flank = found.region.flank
        raise UsageError(
            f"the {flank.region} of the {flank.body['name']} does not go from face to face: it is missing in the "
            f"section at {values[missed][0]:.6g} mm along its teeth; change the face width or the tip in [blank]"
        )


def _ended(found: Lines, upper: bool, roles: tuple[str, ...]) -> int:
    """How many lines have a limit of some roles at an end."""
    limits = [k for k, name in enumerate(found.region.limits.names) if name in roles]
    return int(np.isin(ended_by(found, upper), limits).sum())


def _tip_is_upper(found: Lines) -> bool:
    """Which end of a flank's lines most of them have at a tip."""
    lower, upper = (_ended(found, end, TIPS) for end in (False, True))
    if lower == upper:
        name = found.region.flank.body["name"]
        if set(TIPS) & set(found.region.limits.names):
            raise UsageError(f"the flank of the {name} does not reach its tip: change [blank]")
        raise UsageError(
            f"--solid: no limit ends the flank of the {name} at its tip, which a closed body needs: the drive's "
            f'description has to give its body "{name}" a margin with the event "tip"'
        )
    return bool(upper > lower)


def _first_hit(one: Floats, other: Floats) -> tuple[float, float] | None:
    """Where two polylines (P, 2), (Q, 2) cross, as numbers of places with fractions; the first one along ``one``."""
    a, b = one[:-1, None], other[None, :-1]
    u, v = np.diff(one, axis=0)[:, None], np.diff(other, axis=0)[None]
    cross = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
    away = b - a
    with np.errstate(divide="ignore", invalid="ignore"):
        s = (away[..., 0] * v[..., 1] - away[..., 1] * v[..., 0]) / cross
        t = (away[..., 0] * u[..., 1] - away[..., 1] * u[..., 0]) / cross
    hits = np.argwhere((s >= 0.0) & (s <= 1.0) & (t >= 0.0) & (t <= 1.0))
    if not len(hits):
        return None
    i, j = hits[0]
    return float(i + s[i, j]), float(j + t[i, j])


def _mixed(places: Floats, at: float) -> Floats:
    """Parameters (k,) at a number of a place with its fraction, of places (P, k)."""
    k = min(int(at), len(places) - 2)
    return places[k] + (at - k) * (places[k + 1] - places[k])
