"""The life of a resharpened tool: what its wheels do in contact, grind by grind, and which new tool meets given bounds.

Resharpening moves the tool's profile towards its axis and leaves its lead; what of a design that changes is declared by
the family (``regrind`` of its description). Every state is a design of its own, solved like any other.
"""

import itertools
import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from meshwright.base.errors import DesignError, UsageError
from meshwright.cycle.backlash import backlash
from meshwright.cycle.first_contact import first_contacts
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.transmission import peak_to_peak, rides_on_edge
from meshwright.design import design as designs
from meshwright.design.description import families, table_and_key
from meshwright.drive import Drive
from meshwright.flank.mesh import mesh as triangulated
from meshwright.pattern.pattern import contours

#: Cells of the wheel's flank on which a pattern is counted, contact patches over a pair's window, directions of each.
CELLS, PATCHES, DIRECTIONS = (16, 32), 17, 32

#: Angles of one pitch at which the pair that leads is asked where it touches.
SAMPLES = 12

#: A radius of the new tool is found to this, mm, and sought up to this share above the least one.
RESOLVED, FARTHEST = 1e-4, 0.5


@dataclass(frozen=True)
class Pattern:
    """What the contact patches at the design's separation cover of the wheel's flank over a pair's window.

    ``share`` of the flank's area; ``centre`` (2,), mm, axial position and radius of the middle of what is covered.
    """

    share: float
    centre: np.ndarray


@dataclass(frozen=True)
class Edge:
    """Errors of assembly (key → size) at which an edge leads: of which ``member``, its ``limits``."""

    errors: dict[str, float]
    member: str
    limits: tuple[str, ...]


@dataclass(frozen=True)
class State:
    """The drive with a tool of which ``ground_off`` is gone and whose ``working`` radius is left, mm.

    ``assembly`` are errors of assembly (key → size), judged with either sign. What is asked of it is computed then.
    """

    ground_off: float
    working: float
    drive: Drive
    assembly: dict[str, float]

    @cached_property
    def mesh(self):
        """Its tooth pairs."""
        return Mesh.of(self.drive)

    @property
    def status(self):
        """Status word of its contact."""
        return self.mesh.window.status

    @cached_property
    def error(self):
        """Peak to peak of the transmission error, rad; NaN without contact."""
        if self.mesh.window.path is None:
            return 0.0 if self.status == "line_contact" else math.nan
        return peak_to_peak(self.mesh)

    @cached_property
    def backlash(self):
        """Of the wheel, rad."""
        return backlash(self.drive)

    @cached_property
    def pattern(self):
        """Its :class:`Pattern`, None without contact points."""
        return None if self.mesh.window.path is None else pattern(self.mesh)

    @cached_property
    def edges(self):
        """Every :class:`Edge` that leads, nominally and with errors of assembly."""
        return tuple(self._edges())

    def _edges(self):
        rows = itertools.product((-1.0, 1.0), repeat=len(self.assembly)) if self.assembly else ()
        corners = [{p: s * size for (p, size), s in zip(self.assembly.items(), row, strict=True)} for row in rows]
        for errors in ({}, *corners):
            mesh = self.mesh
            if errors:
                places = {place: _shown(self.drive, place) + size for place, size in errors.items()}
                tables = designs.changed(self.drive.design.given(), places)
                mesh = Mesh.of(type(self.drive).from_tables(tables, self.drive.backend))
            if mesh.window.path is not None and (edge := leading_edge(mesh)) is not None:
                yield Edge(errors, *edge)


@dataclass(frozen=True)
class Bounds:
    """What a tool must meet: the transmission error (rad) at most at every grind, the least share of the wheel's flank
    that the new tool's pattern covers, the least oversize of the working radius at the last grind (share of the
    mate's radius), and whether no edge may lead. None, 0 and False set no bound.
    """

    error: float | None = None
    pattern: float | None = None
    oversize: float = 0.0
    no_edge: bool = False

    def broken(self, state, new):
        """The bounds that a state breaks, in words."""
        found = []
        if self.error is not None and not state.error <= self.error:
            found.append("transmission error")
        if new and self.pattern is not None and not (state.pattern and state.pattern.share >= self.pattern):
            found.append("contact pattern")
        if self.no_edge and state.edges:
            found.append("edge contact")
        return found


@dataclass(frozen=True)
class Limit:
    """A radius of the new tool, and the bound that ends the range there with the grind at which it does."""

    radius: float
    bound: str
    ground_off: float


@dataclass(frozen=True)
class Range:
    """Radii of the new tool between which all bounds are met; ``life`` (mm) is what the larger one can lose until its
    working radius is the least that the bounds allow.
    """

    smallest: Limit
    largest: Limit
    life: float


@dataclass(frozen=True)
class ToolLife:
    """A design and the sizes of assembly errors (key → size) that its states are judged with, each with either sign."""

    drive: Drive
    errors: dict[str, float]

    @classmethod
    def of(cls, drive, errors=None):
        """Raises :class:`~meshwright.base.errors.UsageError` for a family without such a tool, or a wrong error."""
        known = families()
        if known[drive.design.family].regrind is None:
            have = ", ".join(name for name, family in known.items() if family.regrind)
            raise UsageError(
                f"drive = {drive.design.family!r}: no tool of this family is resharpened; use a design of {have}"
            )
        for place, size in (errors or {}).items():
            table, key = table_and_key(place)
            if not any((p["table"], p["key"]) == (table, key) and table == "misalignment"
                       for p in drive.design.description["parameters"]):
                raise UsageError(f"--error {place}={size:g}: no error of assembly; use a key of [misalignment]")
        return cls(drive, errors or {})

    @cached_property
    def regrind(self):
        """What the family declares."""
        return families()[self.drive.design.family].regrind

    @property
    def radius(self):
        """Radius of the new tool, mm."""
        return self._value(self.drive, "radius")

    @property
    def mate(self):
        """Radius of the member for which the tool stands, mm."""
        return self._value(self.drive, "mate")

    def at(self, ground_off, radius=None):
        """The drive when ``ground_off`` (mm) is gone of a new tool of ``radius`` (mm), by default the design's.

        Raises :class:`~meshwright.base.errors.UsageError` where that leaves no tool.
        """
        given = self.drive.design.given()
        changes = dict(self.regrind["words"]) | {self.regrind["amount"]: float(ground_off)}
        if radius is not None:
            changes[self.regrind["radius"]] = float(radius)
        if not ground_off > 0.0:
            return self._drive(given, changes | self._settings(given, changes))
        try:
            return self._drive(given, changes | self._settings(given, changes))
        except DesignError as error:
            raise UsageError(
                f"{self.regrind['amount']} = {ground_off:g}: with so much ground off there is no design ({error}); "
                "grind off less: --life-mm"
            ) from error

    def state(self, ground_off, radius=None):
        """The :class:`State` there."""
        drive = self.at(ground_off, radius)
        return State(float(ground_off), self._value(drive, "working"), drive, self.errors)

    def life(self, radius=None, oversize=0.0):
        """What may be ground off (mm) until the working radius exceeds the mate's by the share ``oversize`` alone."""
        least = self.mate * (1.0 + oversize)
        whole = (self.radius if radius is None else radius) - least
        if not whole > 0.0:
            return 0.0
        return _root(lambda amount: self._value(self.at(amount, radius), "working") - least, 0.5 * whole, whole)

    def range(self, amounts, bounds, step=lambda text: None):
        """The :class:`Range` of new tools that meet ``bounds`` at every amount ground off (mm), ascending from 0.

        The smallest just keeps the least oversize at the last grind, the largest is the first above it that breaks a
        bound. Raises :class:`~meshwright.base.errors.UsageError` if none meets them, or none is too large.
        """
        last = max(amounts)
        least = self.mate * (1.0 + bounds.oversize)
        start = _root(lambda r: self._value(self.at(last, r), "working") - least, least + last, least + 1.1 * last)

        def broken(radius):
            step(f"radius {radius:.4f} mm")
            for amount in amounts:
                if words := bounds.broken(self.state(amount, radius), amount == min(amounts)):
                    return words[0], amount
            return None

        inside = start + RESOLVED
        if found := broken(inside):
            raise UsageError(
                f"no oversize meets the bounds: at {100.0 * (inside / self.mate - 1.0):.3g} %, the least that is left "
                f"with the least oversize after {last:g} mm, {found[0]} is beyond its bound at {found[1]:g} mm ground "
                "off; grind off less or allow more"
            )
        width, outside, why = 0.01 * self.mate, None, None
        while outside is None:
            trial = inside + width
            if trial - start > FARTHEST * self.mate:
                raise UsageError(
                    f"no bound limits the oversize up to {100.0 * FARTHEST:g} %: bound the transmission error, the "
                    "contact pattern or edge contact"
                )
            if found := broken(trial):
                outside, why = trial, found
            else:
                inside, width = trial, 2.0 * width
        while outside - inside > RESOLVED:
            middle = 0.5 * (inside + outside)
            if found := broken(middle):
                outside, why = middle, found
            else:
                inside = middle
        return Range(
            Limit(start, "least oversize", last), Limit(inside, *why), self.life(inside, bounds.oversize)
        )

    def _drive(self, given, changes):
        return type(self.drive).from_tables(designs.changed(given, _full(changes)), self.drive.backend)

    def _settings(self, given, changes):
        """Settings that the design gives, moved as far as their rules move."""
        held = [place for place in self.regrind["settings"] if _of(given, place) is not None]
        if not held:
            return {}
        freed = _without(given, held)
        before = self._drive(freed, dict(self.regrind["words"]) | {self.regrind["amount"]: 0.0})
        after = self._drive(freed, changes)
        return {place: _of(given, place) + _shown(after, place) - _shown(before, place) for place in held}

    def _value(self, drive, role):
        """A size of the tool by what the family declares; of a design whose tool is new also its working radius."""
        place = self.regrind[role]
        value = drive.design.value(*reversed(table_and_key(place)))
        return self._value(drive, "radius") if math.isnan(value) and role == "working" else value


def leading_edge(mesh):
    """(member, limits) of an edge that touches before all flanks somewhere in one pitch, None if there is none.

    Where the blank does not bound the flanks: whether the pair that leads stands at an end of its window.
    """
    drive, pitch, window = mesh.drive, mesh.drive.pitch(), mesh.window
    low, high = sorted((window.begin.angle, window.end.angle)) if window.complete else (-0.5 * pitch, 0.5 * pitch)
    numbers = np.arange(-1, math.ceil((high - low) / pitch) + 1)
    angles = low + (np.arange(SAMPLES) + 0.5) / SAMPLES * pitch
    own = (angles[None, :] + pitch * numbers[:, None]).ravel()
    found = first_contacts(drive, own)
    if found.reason or not np.isfinite(found.errors).any():
        if not rides_on_edge(mesh):
            return None
        return ("both", ("end of the window",))
    lead = np.where(np.isfinite(found.errors), mesh.sense * found.errors, -np.inf).reshape(len(numbers), -1)
    for k in np.argmax(lead, axis=0) * len(angles) + np.arange(len(angles)):
        if found.kinds[k] in ("edge", "corner"):
            return found.members[k], found.limits[k]
    return None


def pattern(mesh):
    """The :class:`Pattern` of a drive on its wheel; None where no patch is found."""
    drive, window = mesh.drive, mesh.window
    ends = (window.begin.angle, window.end.angle) if window.complete else drive.about_the_middle([-0.5, 0.5])
    low, high = sorted(ends)
    tca = drive.tca(np.linspace(low, high, PATCHES))
    outlines = [_plane(patch.body_points["wheel"]) for patch in contours(drive, tca, DIRECTIONS) if patch is not None]
    flank = triangulated(drive.region("wheel"), CELLS)
    if not outlines or not len(flank.triangles):
        return None
    corners = flank.points[flank.triangles]
    areas = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    places = _plane(corners.mean(axis=1))
    covered = np.zeros(len(areas), dtype=bool)
    for outline in outlines:
        covered |= _inside(places, outline)
    if not covered.any():
        return Pattern(0.0, np.full(2, math.nan))
    weights = areas * covered
    return Pattern(float(weights.sum() / areas.sum()), weights @ places / weights.sum())


def _plane(points):
    """Axial position and radius (N, 2) of points (N, 3) of a body."""
    return np.stack([points[:, 2], np.hypot(points[:, 0], points[:, 1])], axis=1)


def _inside(places, outline):
    """Which places (N, 2) a closed outline (M, 2) goes around."""
    ends = np.roll(outline, -1, axis=0)
    rising = (outline[None, :, 1] > places[:, None, 1]) != (ends[None, :, 1] > places[:, None, 1])
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = (ends - outline)[:, 0] / (ends - outline)[:, 1]
        crossing = outline[None, :, 0] + (places[:, None, 1] - outline[None, :, 1]) * slope
    return (rising & (places[:, None, 0] < crossing)).sum(axis=1) % 2 == 1


def _root(function, first, second):
    """Zero of a nearly straight function, by secants."""
    a, b = first, second
    at_a, at_b = function(a), function(b)
    for _ in range(40):
        if abs(b - a) < 1e-12 * max(1.0, abs(b)) or at_b == at_a:
            break
        a, at_a, b = b, at_b, b - at_b * (b - a) / (at_b - at_a)
        at_b = function(b)
    return b


def _full(changes):
    return {".".join(table_and_key(place)): value for place, value in changes.items()}


def _of(tables, place):
    table, key = table_and_key(place)
    return tables.get(table, {}).get(key)


def _without(tables, places):
    names = {table_and_key(place) for place in places}
    return {
        table: {k: v for k, v in entries.items() if (table, k) not in names} if isinstance(entries, dict) else entries
        for table, entries in tables.items()
    }


def _shown(drive, place):
    """A key of a complete design in its own unit."""
    table, key = table_and_key(place)
    return drive.design.as_solved()[table][key]

