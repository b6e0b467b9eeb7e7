"""Semi-analytic loaded contact: exact gaps, half-space cells, tooth compliance, one rigid rotation.

Unknowns are the pressures of all cells of all pairs and the rotation of the loaded member; an active set finds the
cells that touch. The cells divide a strip along the curve of smallest gap (``strip``). They are laid out first where a
bed of springs under each strip closes the gap, then where there was pressure, wider where that reached a free border of
the grid, and finer until rotation, forces and peaks stay as they are. What is not settled then, or carries its load
with less pressure than a line can, is told as not resolved.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.optimize import brentq
from scipy.spatial import KDTree

from meshwright.fe.cells import Cells
from meshwright.fe.compliance import ToothCompliance
from meshwright.fe.edge_zone import EdgeZone
from meshwright.fe.gap import Bools, ContactGrid, ContactPlane
from meshwright.fe.gate import LARGEST_ROTATION
from meshwright.fe.hertz import HertzContact, line_contact
from meshwright.fe.hexahedra import Floats
from meshwright.fe.material import contact_modulus
from meshwright.fe.model import Load, hertz_of, loaded_side
from meshwright.fe.pair import GearPair, Member, PairTouch, first_touches, lever_arm, unloaded_wheel_angle
from meshwright.fe.strip import Strip, Window
from meshwright.fe.touching import active_set

# Rows and columns of cells: where the load is found first, and finer and finer ones, most of all along: there peaks are
# narrow, as where a relief begins.
_FIRST_CELLS = 15, 11
_CELLS = (21, 15), (31, 21), (47, 25), (71, 29)
# The first of these that may be the last.
_ENOUGH = 1
# What may change with finer cells: rotation, forces, and peaks of pressure, of pairs that carry much.
_SETTLED = 0.01
# The same of peaks of pairs that a sharp edge presses, which the cells beside it still change.
_BESIDE_EDGES = 0.05
# How often the cells are laid out wider where pressure reaches a free border of theirs.
_WIDENINGS = 5
# How much wider.
_WIDER = 1.5
# Room beyond what is pressed, in parts of that across and of the gap that is closed.
_ROOM = 0.3
# A line of a half-space gives way under its load per length like springs of so many contact moduli.
_SPRINGS = 0.45
# Strips end no sooner than where gaps are so large, in parts of what the load closes: along lines they are all alike.
_LEAST_CLOSED = 0.4
# Those that pressure has reached the end of end beyond all that is closed.
_ALL_CLOSED = 1.1
# Cells that springs close reach further than pressure does.
_REACH = 0.8
_LEAST_SHARE = 0.05
#: Beyond so many times the rotation up to which there are figures, more cells are not worth their while.
FAR_TOO_FAR = 2.0
# Flanks touch where they would overlap by so much of what is closed there, about: by half of it under Hertz's ellipse.
_TOUCHING = 0.5
# Teeth give way about so many times as far as the half-spaces of their contact.
_TEETH_SOFTER = 2.0
# Peaks below this part of the least that lines can carry the load with are false.
_POSSIBLE = 0.98
# Flanks that touch first overlap by less than this, mm.
_NO_OVERLAP = 0.01
# Moments of pressures and the torque differ by less than this part.
_EQUILIBRIUM = 1e-3


@dataclass(frozen=True)
class LoadedPair:
    """One pair under load: normal force in N, peak pressure in MPa, Hertz contact under the same force, None without
    force and where an edge touches; ``apart``: gap at its first contact, mm, when the first pair touches unloaded.
    """

    contact: PairTouch
    grid: ContactGrid
    pressures: Floats
    force: float
    apart: float
    hertz: HertzContact | None

    @cached_property
    def edge_zone(self) -> EdgeZone:
        """What presses beside sharp edges of the flanks, and the peak of the free contact."""
        return EdgeZone.of(self.grid, self.pressures)

    @property
    def peak_pressure(self) -> float:
        """Largest pressure in MPa of the free contact, away from sharp edges of the flanks."""
        return self.edge_zone.peak

    @property
    def peaks_at_edge(self) -> bool:
        """Whether pressure is higher than that beside a sharp edge of a flank."""
        return bool(self.pressures.max() > self.peak_pressure)

    @property
    def cut_off(self) -> bool:
        """Whether an edge of a flank bounds the contact area somewhere."""
        return bool(self.edges)

    @property
    def edges(self) -> tuple[str, ...]:
        """The edges that do, such as "tip of the wheel"."""
        return tuple(name for name, cells in self.grid.beyond.items() if np.any(cells & (self.pressures > 0.0)))

    @property
    def line(self) -> Floats:
        """Where the pressure is highest across the contact area, (M, 3) from end to end of it on the pinion's flank:
        the line of contact under load, fixed frame.
        """
        rows = self.pressures.reshape(self.grid.rows, self.grid.columns)
        highest = self.grid.columns * np.arange(self.grid.rows) + rows.argmax(axis=1)
        return self.grid.points[highest[rows.max(axis=1) > 0.0]]


@dataclass(frozen=True)
class LoadedContact:
    """Equilibrium at one pinion angle.

    rotation: rotation in rad of the loaded member in the sense of its torque, from the first unloaded touch.
    transmission_error: loaded wheel angle less ratio times pinion angle, rad; unloaded_error: that of rigid teeth.
    unresolved: why these are no figures to go by, empty where they are.
    """

    pinion_angle: float
    load: Load
    pairs: tuple[LoadedPair, ...]
    rotation: float
    transmission_error: float
    unloaded_error: float
    unresolved: str

    @property
    def mesh_stiffness(self) -> float:
        """Normal force over the deflection along the contact normal, N/mm: torque / (arm^2 rotation)."""
        arm = self.load.torque / sum(pair.force for pair in self.pairs)
        return self.load.torque / (arm**2 * self.rotation)


def loaded_contact(
    gear: GearPair,
    pinion_angle: float,
    pairs: int,
    load: Load,
    compliance: dict[str, ToothCompliance] | None,
) -> LoadedContact:
    """Solve the contact of ``pairs`` tooth pairs around a pinion angle.

    compliance: smooth tooth compliance of both members (see :func:`~meshwright.fe.compliance.tooth_compliance`), or
    None for half-spaces on rigid teeth.  Raises ValueError if no pair touches at this angle.
    """
    contacts = first_touches(gear, pinion_angle, pairs)
    if not contacts:
        raise ValueError(f"no tooth pair touches at a pinion angle of {np.degrees(pinion_angle):g} deg")
    member, direction = loaded_side(gear, load)
    wheel_angle = unloaded_wheel_angle(gear, contacts)
    places = tuple(_Place.of(gear, member, contact, (pinion_angle, wheel_angle)) for contact in contacts)
    # An edge that meets a fillet carries nothing; where it is first of all, that is told.
    places = tuple(place for place in places if place.apart == 0.0 or place.plane.shared)
    found = _resolved(gear, places, load, compliance)
    solved = tuple(
        LoadedPair(place.contact, grid, p, float(f), place.apart, place.hertz(float(f)))
        for place, grid, p, f in zip(found.places, found.grids, found.pressures, found.forces, strict=True)
    )
    rotation = found.rotation
    unloaded = wheel_angle - gear.ratio * pinion_angle
    # The driven side lags: the pinion winds up ahead of the wheel by the rotation.
    wound = direction * rotation * member.turning
    lag = -gear.ratio * wound if load.member == "pinion" else wound
    return LoadedContact(pinion_angle, load, solved, rotation, unloaded + lag, unloaded, found.unresolved)


@dataclass(frozen=True, eq=False)
class _Place:
    """First contact of a pair with the members at ``angles`` in rad: lever ``arm`` of the loaded member there, and how
    far the flanks are ``apart`` there along the normal when the first of all pairs touches, mm.
    """

    gear: GearPair
    contact: PairTouch
    angles: tuple[float, float]
    arm: float
    apart: float

    @classmethod
    def of(cls, gear: GearPair, member: Member, contact: PairTouch, angles: tuple[float, float]) -> _Place:
        point, normal = contact.touch.point, contact.touch.normal
        lever = abs(lever_arm(gear.wheel, point, normal))
        apart = lever * abs(angles[1] - contact.wheel_angle)
        return cls(gear, contact, angles, abs(lever_arm(member, point, normal)), apart)

    @cached_property
    def plane(self) -> ContactPlane:
        """Its tangent plane with the flanks over it."""
        return ContactPlane.of(self.gear, self.contact, self.angles)

    @cached_property
    def strip(self) -> Strip:
        """The strip of the tangent plane there with the flanks over it."""
        return Strip.of(self.plane)

    @property
    def modulus(self) -> float:
        """Contact modulus in MPa."""
        return contact_modulus(self.gear.pinion.material, self.gear.wheel.material)

    def spring_force(self, closing: float) -> float:
        """Force in N of springs under the strip where the load closes so much, mm."""
        profile = self.strip.profile
        return _SPRINGS * self.modulus * float(profile.opened(closing) @ profile.length)

    def hertz(self, force: float) -> HertzContact | None:
        """Hertz contact under a force in N; None without one, and where an edge touches."""
        touch = self.contact.touch
        if force <= 0.0 or touch.edge:
            return None
        if touch.curvature_min > 0.0:
            return hertz_of(self.gear, self.contact, force)
        profile = self.strip.profile
        on_both = np.isfinite(profile.gap)
        across = float(profile.curvature[np.flatnonzero(profile.along == 0.0)[0]])
        poisson_ratio = self.gear.pinion.material.poisson_ratio
        return line_contact(force / float(profile.length[on_both].sum()), across, self.modulus, poisson_ratio)

    def least_peak(self, force: float, closing: float, width: float) -> float:
        """The peak in MPa below which nothing carries a force in N where the load closes so much and touches so wide:
        that of a line under one pressure all along. Source: K. L. Johnson, Contact Mechanics (1985), section 4.2(c).
        """
        profile = self.strip.profile
        across = np.fmin(self.strip.curvature(profile.along, 0.5 * width), profile.curvature)
        (used,) = np.nonzero(profile.opened(closing))
        if not (np.all(across[used] > 0.0) and profile.length[used].any()):
            return 0.0
        return math.sqrt(force * self.modulus / (math.pi * float(np.sum(profile.length[used] / across[used]))))


@dataclass(frozen=True, eq=False)
class _Solution:
    """Pressures (N,) of the cells of each of the pairs at ``places`` that the load may bring together, and rotation."""

    places: tuple[_Place, ...]
    windows: tuple[Window, ...]
    grids: tuple[ContactGrid, ...]
    pressures: tuple[Floats, ...]
    rotation: float
    unresolved: str = ""

    @property
    def forces(self) -> Floats:
        """Normal force in N of each."""
        return np.array([grid.area @ p for grid, p in zip(self.grids, self.pressures, strict=True)])

    def idle(self, place: _Place) -> bool:
        """Whether a pair has no pressure."""
        return place not in self.places or not self.pressures[self.places.index(place)].any()

    def closing(self, place: _Place) -> float:
        """What the load closes at most of the gap of a pair, mm."""
        return abs(self.rotation) * place.arm

    @property
    def leaking(self) -> tuple[Bools, ...]:
        """Whether (2,) pressure reaches a free border of the cells of each pair, along and across.

        Nothing touches along a strip where the gap is larger than what the load closes.
        """
        return tuple(
            np.any(grid.free & (p > 0.0), axis=1) & [window.closing < self.closing(place), True]
            for place, window, grid, p in zip(self.places, self.windows, self.grids, self.pressures, strict=True)
        )

    def windows_after(self) -> dict[int, Window]:
        """By pair what to divide next: where there was pressure, more where it reached a free border."""
        return {
            place.contact.pairs_later: _next_window(self.closing(place), window, grid, p, leaking)
            for place, window, grid, p, leaking in zip(
                self.places, self.windows, self.grids, self.pressures, self.leaking, strict=True
            )
        }

    def settled(self, before: _Solution) -> bool:
        """Whether nothing is left that finer cells than ``before`` change by much.

        Forces hold everywhere; peaks do of pairs that carry much, less well where a sharp edge presses, and not where
        that carries most.
        """
        if any(before.idle(place) != self.idle(place) for place in {*before.places, *self.places}):
            return False
        if before.places != self.places or abs(self.rotation - before.rotation) > _SETTLED * abs(self.rotation):
            return False
        least = _LEAST_SHARE * self.forces.sum()
        if np.any(np.abs(self.forces - before.forces) > _SETTLED * np.maximum(self.forces, least)):
            return False
        told = [
            (new.peak, abs(new.peak - old.peak), _SETTLED if new.depth is None else _BESIDE_EDGES)
            for force, new, old in zip(self.forces, self.edge_zones, before.edge_zones, strict=True)
            if force > least and not (new.holds and old.holds)
        ]
        return all(change < part * max(told)[0] for _, change, part in told)

    @cached_property
    def edge_zones(self) -> tuple[EdgeZone, ...]:
        """What presses beside sharp edges of each pair, and the peak away from them."""
        return tuple(EdgeZone.of(grid, p) for grid, p in zip(self.grids, self.pressures, strict=True))

    def impossible(self, member: Member, load: Load) -> str:
        """What no load on these flanks could give, empty where there is nothing of the kind."""
        moment = sum(
            float((grid.area * p) @ _arms(member, grid)) for grid, p in zip(self.grids, self.pressures, strict=True)
        )
        if not abs(moment / load.torque - 1.0) < _EQUILIBRIUM:
            return f"pressures have a moment of {moment / 1000.0:.5g} N m, not {load.torque / 1000.0:.5g} N m"
        for place, grid in zip(self.places, self.grids, strict=True):
            if grid.gap.min() < -max(self.closing(place), _NO_OVERLAP):
                return (
                    f"surfaces of a pair overlap by {-grid.gap.min():.3g} mm where its "
                    "flanks touch first: beside an undercut normals meet another sheet than the flank"
                )
        for place, window, p, force in zip(self.places, self.windows, self.pressures, self.forces, strict=True):
            least = place.least_peak(force, self.closing(place), window.width) if force > 0.0 else 0.0
            if not p.max() >= _POSSIBLE * least:
                return f"a peak of {p.max():.5g} MPa under a force that no line carries with less than {least:.5g} MPa"
        return ""


def _next_window(closing: float, window: Window, grid: ContactGrid, pressures: Floats, leaking: Bools) -> Window:
    """The part of a strip to divide next, of a pair of which the load closes ``closing`` mm at most."""
    pressed = pressures > 0.0
    if not pressed.any():
        return window
    rows = np.flatnonzero(pressed.reshape(grid.rows, grid.columns).any(axis=1))
    about = grid.row_gap[max(rows[0] - 1, 0) : rows[-1] + 2]
    low, high = grid.row_gap.min(), about.max()
    reach = float(low + (1.0 + _ROOM) * (high - low))
    whole = window.whole or bool(leaking[0])
    least = float(low + (_ALL_CLOSED if whole else _LEAST_CLOSED) * max(closing - low, 0.0))
    across = grid.half[pressed, 1]
    touching, cell = float(np.max(np.abs(grid.offset[pressed]) + across)), 2.0 * float(across.max())
    width = min(touching + max(_ROOM * touching, cell), window.width)
    if leaking[1]:
        width = _WIDER * window.width
    return Window(max(reach, least), width, whole)


def _resolved(
    gear: GearPair, places: tuple[_Place, ...], load: Load, compliance: dict[str, ToothCompliance] | None
) -> _Solution:
    """The solution with cells so wide and fine that it is settled, or the last one with the reason why it is not."""
    member, _ = loaded_side(gear, load)
    windows = _first_windows(places, load)
    cells, level, widened = _FIRST_CELLS, -1, 0
    settled: _Solution | None = None
    before: _Solution | None = None
    while True:
        found = _solved(gear, places, windows, load, compliance, cells, before)
        if abs(found.rotation) > FAR_TOO_FAR * LARGEST_ROTATION:
            return found
        windows = windows | found.windows_after()
        missed = _missed(places, found, windows)
        before = found
        if missed or any(of.any() for of in found.leaking):
            widened += 1
            if widened > _WIDENINGS:
                return replace(found, unresolved="pressure is left at a free border of the cells")
            continue
        if level >= _ENOUGH and settled is not None and found.settled(settled):
            return replace(found, unresolved=found.impossible(member, load))
        level, settled = level + 1, found
        if level == len(_CELLS):
            reason = found.impossible(member, load) or "finer cells go on changing force, rotation or the peak"
            return replace(found, unresolved=reason)
        cells = _CELLS[level]


def _missed(places: tuple[_Place, ...], found: _Solution, windows: dict[int, Window]) -> bool:
    """Whether the load may bring a pair together that has no cells; gives it a window."""
    missed = False
    for place in places:
        closing = found.closing(place)
        if place not in found.places and closing > place.apart:
            windows[place.contact.pairs_later] = _window(place, closing)
            missed = True
    return missed


def _first_windows(places: tuple[_Place, ...], load: Load) -> dict[int, Window]:
    """By pair what to divide first: what springs under all strips close, twice that for teeth.

    An edge that the load does not bring to its mate has none.
    """

    def missing(rotation: float) -> float:
        return sum(p.arm * p.spring_force(rotation * p.arm) for p in places) - load.torque

    rotation = _TEETH_SOFTER * _root(missing)
    found: dict[int, Window] = {}
    for place in places:
        closing = rotation * place.arm
        if not place.contact.touch.edge:
            least = _LEAST_SHARE * load.torque / place.arm
            closing = max(closing, _root(lambda depth, p=place, f=least: p.spring_force(depth) - f))
        elif closing <= place.apart:
            continue
        found[place.contact.pairs_later] = _window(place, closing)
    return found


def _window(place: _Place, closing: float) -> Window:
    return Window(closing, _REACH * place.strip.half_width(closing))


def _root(rising) -> float:
    """Where a function of a positive number that rises from below zero vanishes."""
    high = 1e-12
    while rising(high) < 0.0:
        if high > 1e12:
            raise ArithmeticError("no part of the flanks comes into contact: choose a larger torque")
        high *= 4.0
    return float(brentq(rising, 0.0, high, rtol=1e-3))


def _likely(place: _Place, window: Window, grid: ContactGrid, before: _Solution | None) -> Bools:
    """The cells (N,) of a pair thought to touch, from other cells ``before`` and their pressures."""
    if before is None or place not in before.places:
        return grid.gap < _TOUCHING * window.closing
    at = before.places.index(place)
    _, nearest = KDTree(before.grids[at].points).query(grid.points)
    return before.pressures[at][nearest] > 0.0


def _arms(member: Member, grid: ContactGrid) -> Floats:
    """Levers (N,) in mm of forces on cells about the axis of a member."""
    origin, axis = member.axis
    return np.abs(np.cross(grid.points - origin, grid.frame[:, 2]) @ axis)


def _solved(
    gear: GearPair, places: tuple[_Place, ...], windows: dict[int, Window], load: Load,
    compliance: dict[str, ToothCompliance] | None, cells: tuple[int, int], before: _Solution | None,
) -> _Solution:
    """Pressures of so many rows and columns of cells over the windows of all pairs, and the rotation."""
    laid = [
        (place, window, place.strip.grid(window, *(_FIRST_CELLS if before and before.idle(place) else cells)))
        for place in places
        if (window := windows.get(place.contact.pairs_later)) is not None
    ]
    used = [(place, window, grid) for place, window, grid in laid if grid is not None]
    if not used:
        raise ArithmeticError("no cell of the flanks comes into contact: choose a larger torque")
    member, _ = loaded_side(gear, load)
    grids = [grid for _, _, grid in used]
    every = Cells.of(gear, tuple(place.contact for place, _, _ in used), grids, compliance or {})
    areas, gap = (np.concatenate(of) for of in zip(*((g.area, g.gap) for g in grids), strict=True))
    arms = np.concatenate([_arms(member, grid) for grid in grids])
    start = np.concatenate([_likely(*of, before) for of in used])
    pressure, rotation = active_set(every, gap, arms, areas, start, load.torque)
    return _Solution(
        tuple(place for place, _, _ in used), tuple(window for _, window, _ in used), tuple(grids),
        tuple(every.of_pairs(pressure)), rotation,
    )  # fmt: skip
