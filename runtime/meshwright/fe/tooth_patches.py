"""Patches of a body with teeth: two sides of each tooth, its tip, the root lands, the ends of the face and the rim.

Coordinates are those of the sections of the teeth: section, height and azimuth.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from meshwright.base.errors import DesignError
from meshwright.contact.placement import about_z
from meshwright.fe.hexahedra import Floats
from meshwright.flank.patches import Patch
from meshwright.flank.sections import Sections
from meshwright.flank.sides import Side

_TURN = 2.0 * np.pi
# Places on half a flank at which azimuths are compared, and the number of its middle among those from root to tip.
_HALF, _MIDDLE = 8, 16


class NoLand(DesignError):
    """A tooth that is pointed, or that meets the next one at its root: ``where`` says which, "tip" or "root land"."""

    def __init__(self, where: str, reason: str, remedy: str) -> None:
        super().__init__("blank", None, reason, remedy)
        self.where = where



@dataclass(frozen=True)
class Rows:
    """Steps of the patches: between sections, over fillet and flank, around the axis over tip, root land and bore."""

    along: int
    fillet: int
    flank: int
    tip: int
    land: int

    def times(self, **growth: float) -> Rows:
        """More steps, by name."""
        return replace(self, **{name: int(np.ceil(getattr(self, name) * factor)) for name, factor in growth.items()})


@dataclass(frozen=True)
class Tooth:
    """A tooth between two sides, turned by ``turns`` rad about the axis so that it lies between them.

    ``sides``: at the smaller and the larger azimuth. ``pitch``: angle from tooth to tooth. ``faces``: its first and
    last section; ``parted``: those between them where it is divided, None where it has corners. ``bore``: height (K,)
    of the bore in sections (K,); ``outward``: 1 or -1 as the height grows out of the material at the tip or into it.
    """

    name: str
    sides: tuple[Side, Side]
    turns: tuple[float, float]
    pitch: float
    faces: tuple[float, float]
    bore: Callable[[Floats], Floats]
    outward: float
    parted: Floats | None = None

    @property
    def sections(self) -> Sections:
        return self.sides[0].sections

    @cached_property
    def breaks(self) -> Floats:
        """Sections between the faces at which the tooth is divided, ascending."""
        if self.parted is not None:
            return self.parted
        breaks = np.concatenate([side.breaks() for side in self.sides])
        return np.unique(np.round(breaks[(breaks > self.faces[0]) & (breaks < self.faces[1])], 6))

    def stations(self, rows: int) -> Floats:
        """Section values (K,): faces and breaks, with ``rows`` steps between any two."""
        ends = self.ends
        parts = [np.linspace(a, b, rows + 1) for a, b in zip(ends[:-1], ends[1:], strict=True)]
        return np.concatenate([parts[0], *(part[1:] for part in parts[1:])])

    @property
    def ends(self) -> Floats:
        """Faces and breaks, ascending."""
        return np.array([self.faces[0], *self.breaks, self.faces[1]])

    def grid(self, rows: Rows) -> Grid:
        """The tooth at so many steps."""
        values = self.stations(rows.along)
        fillet, flank = (np.linspace(0.0, 1.0, n + 1) for n in (rows.fillet, rows.flank))
        parts = []
        for side, turn in zip(self.sides, self.turns, strict=True):
            below, above, normals = side.grids(values, fillet, flank)
            motion = about_z(turn)[:3, :3].T
            parts.append((below @ motion, above @ motion, normals @ motion))
        return Grid(self, rows, values, *parts)


@dataclass(frozen=True)
class Grid:
    """Points (K, F, 3) of fillet and (K, J, 3) of flank with its normals, of the side at the smaller and at the larger
    azimuth, in K sections.
    """

    tooth: Tooth
    rows: Rows
    values: Floats
    low: tuple[Floats, Floats, Floats]
    high: tuple[Floats, Floats, Floats]

    def patches(self, teeth: int, whole: int) -> list[Patch]:
        """The patches of so many teeth of a ``whole``."""
        tooth, pieces = self.tooth, []
        closed = teeth == whole
        own = self._tooth()
        land = self._land(0.0, 1.0)
        for k in range(teeth):
            motion = about_z(k * tooth.pitch)
            pieces += [patch.moved(motion) for patch in own]
            if closed or k < teeth - 1:
                pieces += [patch.moved(motion) for patch in land]
        if not closed:
            back, on = about_z(-tooth.pitch), about_z((teeth - 1) * tooth.pitch)
            pieces += [p.moved(back) for p in [*self._land(0.5, 1.0), *self._cut(False)]]
            pieces += [p.moved(on) for p in [*self._land(0.0, 0.5), *self._cut(True)]]
        return [p.turned_over() for p in pieces] if tooth.outward < 0.0 else pieces

    # -- the pieces, as if height grew outwards ---------------------------------------------------------------------

    @property
    def _levels(self) -> list[tuple[str, Floats, Floats]]:
        """What lies between root land and tip on both sides, from the land upwards: kind and points (K, J, 3)."""
        found = [("flank", self.low[1], self.high[1])]
        if any(side.has_step for side in self.tooth.sides):
            low, high = (np.stack([side[0][:, -1], side[1][:, 0]], axis=1) for side in (self.low, self.high))
            found.insert(0, ("step", low, high))
        if self.tooth.sides[0].has_fillet:
            found.insert(0, ("fillet", self.low[0], self.high[0]))
        return found

    def _tooth(self) -> list[Patch]:
        bottom = self._across(self.low[0][:, 0], self.high[0][:, 0], self.rows.tip)
        pieces = self._rim(bottom)
        for kind, low, high in self._levels:
            top = self._across(low[:, -1], high[:, -1], self.rows.tip)
            pieces += [*self._lengthwise(kind, low), *self._lengthwise(kind, high[:, ::-1])]
            pieces += self._ends(low, high, bottom, top)
            bottom = top
        return [*pieces, *self._lengthwise("tip", bottom)]

    def _land(self, first: float, last: float) -> list[Patch]:
        """The land from one share to another of the way to the next tooth, and the rim below it."""
        start, end = self.high[0][:, 0], self.low[0][:, 0] @ about_z(self.tooth.pitch)[:3, :3].T
        land = self._across(start, end, self.rows.land, first, last)
        return [*self._lengthwise("land", land), *self._rim(land)]

    def _cut(self, after: bool) -> list[Patch]:
        """The cut through the rim in the middle of a land, after the tooth or before its next one."""
        start, end = self.high[0][:, 0], self.low[0][:, 0] @ about_z(self.tooth.pitch)[:3, :3].T
        middle = self._across(start, end, 1, 0.5, 0.5)[:, 0]
        cut = np.stack([self._below(middle), middle], axis=1)
        pieces = [Patch("cut", cut[part]) for part in self._parts()]
        return [p if after else p.turned_over() for p in pieces]

    def _rim(self, top: Floats) -> list[Patch]:
        """Bore and ends of the rim below a line (K, J, 3) of each section."""
        bore = self._below(top)
        ends = [np.stack([bore[k], top[k]]) for k in (0, -1)]
        return [*(Patch("bore", bore[part]) for part in self._parts()), *self._caps(*ends)]

    def _ends(self, low: Floats, high: Floats, bottom: Floats, top: Floats) -> list[Patch]:
        """The ends of the face between two sides and two lines that join them (K, J, 3)."""
        return self._caps(*(self._filled(low[k], high[k], bottom[k], top[k], self.values[k]) for k in (0, -1)))

    def _caps(self, first: Floats, last: Floats) -> list[Patch]:
        return [Patch("end", np.swapaxes(first, 0, 1)), Patch("end", last)]

    def _lengthwise(self, kind: str, points: Floats) -> list[Patch]:
        """Patches over points (K, J, 3), between breaks."""
        return [Patch(kind, np.swapaxes(points[part], 0, 1)) for part in self._parts()]

    def _parts(self) -> list[slice]:
        step = self.rows.along
        return [slice(k, k + step + 1) for k in range(0, len(self.values) - 1, step)]

    # -- points in the sections ---------------------------------------------------------------------------------------

    def _across(self, start: Floats, end: Floats, steps: int, first: float = 0.0, last: float = 1.0) -> Floats:
        """Points (K, steps + 1, 3) from one to another (K, 3) in the sense of the azimuth, in shares of the way."""
        share = np.linspace(first, last, steps + 1)
        angle = self._angle(start, end)
        sections, azimuth = self.tooth.sections, np.arctan2(start[:, 1], start[:, 0])
        heights = [sections.height(p)[:, None] for p in (start, end)]
        points = sections.points(
            self.values[:, None], heights[0] + share * (heights[1] - heights[0]),
            azimuth[:, None] + angle[:, None] * share,
        )  # fmt: skip
        points[:, share == 0.0], points[:, share == 1.0] = start[:, None], end[:, None]
        return points

    def _angle(self, start: Floats, end: Floats) -> Floats:
        turn = np.arctan2(end[:, 1], end[:, 0]) - np.arctan2(start[:, 1], start[:, 0])
        return turn % _TURN

    def _below(self, points: Floats) -> Floats:
        """Points of the bore (K, ..., 3) below points in the sections."""
        values = self.values.reshape(-1, *np.ones(points.ndim - 2, dtype=int))
        azimuth = np.arctan2(points[..., 1], points[..., 0])
        return self.tooth.sections.points(values, self.tooth.bore(values), azimuth)

    def _filled(self, low: Floats, high: Floats, bottom: Floats, top: Floats, value: float) -> Floats:
        """Points (I, J, 3) of a section within its edges, low, high (I, 3), bottom and top (J, 3) (Coons)."""
        sections = self.tooth.sections
        reference = bottom[0]

        def flat(points: Floats) -> Floats:
            along = points[..., :2] @ reference[:2]
            across = reference[0] * points[..., 1] - reference[1] * points[..., 0]
            return np.stack([sections.height(points), np.unwrap(np.arctan2(across, along), axis=0)], axis=-1)

        edges = low, high, bottom, top
        a, b, c, d = (flat(edge) for edge in edges)
        b, d = b + [0.0, c[-1, 1] - b[0, 1]], d + [0.0, a[-1, 1] - d[0, 1]]
        u, v = (np.linspace(0.0, 1.0, len(edge)) for edge in (low, bottom))
        u, v = u[:, None, None], v[None, :, None]
        inner = (1 - v) * a[:, None] + v * b[:, None] + (1 - u) * c[None] + u * d[None]
        inner -= (1 - u) * (1 - v) * c[0] + (1 - u) * v * c[-1] + u * (1 - v) * d[0] + u * v * d[-1]
        azimuth = np.arctan2(reference[1], reference[0])
        points = sections.points(value, inner[..., 0], azimuth + inner[..., 1])
        points[:, 0], points[:, -1], points[0], points[-1] = edges
        return points


def between(
    name: str, low: Side, high: Side, turn: float, pitch: float, faces: tuple[float, float], outward: float,
    bore: Callable[[Floats], Floats],
) -> Tooth:
    """The tooth from one side to the other, which is turned by ``turn`` and as many pitches as put it after the first.

    Raises NoLand where tip or root land have no width.
    """
    tooth = Tooth(name, (low, high), (0.0, turn), pitch, faces, bore, outward)
    values = np.linspace(*faces, 9)
    width = _azimuths(high, values) - _azimuths(low, values) + turn
    middle, mid = width[len(values) // 2, _MIDDLE], width[:, _MIDDLE]
    width -= _TURN * np.round((mid - middle) / _TURN)[:, None] + pitch * np.floor(middle / pitch)
    remedies = {"tip": "choose a smaller tip radius", "root land": "choose a tool with a narrower tip"}
    for what, left in (("tip", width[:, -1]), ("root land", pitch - width[:, 0])):
        if not (left > 0.0).all():
            value = values[int(np.argmin(left))]
            reason = f"the teeth of the {name} have no {what} in the section at {value:.6g} mm along them"
            raise NoLand(what, reason, remedies[what])
    return replace(tooth, turns=(0.0, turn - pitch * np.floor(middle / pitch)))


def _azimuths(side: Side, values: Floats) -> Floats:
    """Azimuths (K, P) from the root land to the tip of a side, without jumps in a section, in sections (K,)."""
    rows = _MIDDLE + 1 - _HALF, 2 * _HALF + 1
    below, above, _ = side.grids(values, *(np.linspace(0.0, 1.0, n) for n in rows))
    if below.shape[1] == 1:
        below = np.repeat(below, rows[0], axis=1)
    points = np.concatenate([below[:, :-1], above], axis=1)
    return np.unwrap(np.arctan2(points[..., 1], points[..., 0]), axis=1)
