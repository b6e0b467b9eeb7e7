"""Semi-analytic loaded contact: exact gaps, half-space cells, tooth compliance, one rigid rotation.

Unknowns are the pressures of all cells of all pairs and the rotation of the loaded member; an active set finds the
cells that touch.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.ndimage import binary_dilation

from meshwright.fe.cells import Cells
from meshwright.fe.compliance import ToothCompliance
from meshwright.fe.gap import Bools, ContactGrid, ContactPlane, contact_grid
from meshwright.fe.gate import LARGEST_ROTATION
from meshwright.fe.hertz import HertzContact
from meshwright.fe.hexahedra import Floats
from meshwright.fe.model import Load, hertz_of, loaded_side
from meshwright.fe.overlap import fitted_grid, overlap_grid
from meshwright.fe.pair import GearPair, Member, PairTouch, first_touches, lever_arm, unloaded_wheel_angle
from meshwright.fe.touching import active_set

_CELLS = 31
_FIRST_CELLS = 15
_REACH = 1.35
_LEAST_SHARE = 0.05
# An ellipse of which no more than this lies on both flanks is no guide to where they touch.
_LEAST_USED = 0.15
#: Beyond so many times the rotation up to which there are figures, more cells are not worth their while.
FAR_TOO_FAR = 2.0
# Flanks touch where they would overlap by so much of what is closed there, about: by half of it under Hertz's ellipse.
_TOUCHING = 0.5
# Teeth give way about so many times as far as the half-spaces of their contact.
_TEETH_SOFTER = 2.0


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

    @property
    def peak_pressure(self) -> float:
        """Largest cell pressure in MPa."""
        return float(self.pressures.max())

    @property
    def peaks_at_edge(self) -> bool:
        """Whether an edge of a flank bounds the cell of the largest pressure."""
        peak = self.pressures == self.pressures.max()
        return self.force > 0.0 and bool(np.any(_and_around(peak) & ~self.grid.inside))

    @property
    def cut_off(self) -> bool:
        """Whether an edge of a flank bounds the contact area somewhere."""
        return bool(np.any(self._area_and_around & ~self.grid.inside))

    @property
    def edges(self) -> tuple[str, ...]:
        """The edges that do, such as "tip of the wheel", as far as the normals of the contact plane meet the flank."""
        return tuple(name for name, cells in self.grid.beyond.items() if np.any(cells & self._area_and_around))

    @property
    def line(self) -> Floats:
        """Where the pressure is highest across the contact area, (M, 3) from end to end of it on the pinion's flank:
        the line of contact under load, fixed frame.
        """
        side = math.isqrt(len(self.pressures))
        rows = self.pressures.reshape(side, side)
        highest = side * np.arange(side) + rows.argmax(axis=1)
        return self.grid.points[highest[rows.max(axis=1) > 0.0]]

    @property
    def _area_and_around(self) -> Bools:
        return _and_around(self.pressures > 0.0)


@dataclass(frozen=True)
class LoadedContact:
    """Equilibrium at one pinion angle.

    rotation: rotation in rad of the loaded member in the sense of its torque, from the first unloaded touch.
    transmission_error: loaded wheel angle less ratio times pinion angle, rad; unloaded_error: that of rigid teeth.
    """

    pinion_angle: float
    load: Load
    pairs: tuple[LoadedPair, ...]
    rotation: float
    transmission_error: float
    unloaded_error: float

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
    used, forces, rotation = places, np.array([load.torque / place.arm for place in places]), math.nan
    passes = [_FIRST_CELLS, _CELLS]
    before: _Before = {}
    if any(place.contact.touch.edge for place in places):
        passes, rotation = [_FIRST_CELLS, *passes], _first_rotation(gear, places, load)
    for cells in passes:
        # The first pass finds the forces, the last fits each grid to its own ellipse, or to what the load closes.
        least = _LEAST_SHARE * load.torque
        known = {place.contact.pairs_later: force for place, force in zip(used, forces, strict=True)}
        laid = [
            (place, _grid(place, max(known.get(place.contact.pairs_later, 0.0), least / place.arm), rotation, cells))
            for place in places
        ]
        used, grids = tuple(place for place, grid in laid if grid), [grid for _, grid in laid if grid]
        start = [
            _likely(place, grid, before.get(place.contact.pairs_later), rotation)
            for place, grid in zip(used, grids, strict=True)
        ]
        pressures, rotation = _equilibrium(gear, used, grids, load, compliance, start)
        before = {of.contact.pairs_later: (g, p) for of, g, p in zip(used, grids, pressures, strict=True)}
        forces = np.array([grid.area * p.sum() for grid, p in zip(grids, pressures, strict=True)])
        if abs(rotation) > FAR_TOO_FAR * LARGEST_ROTATION:
            break
    solved = tuple(
        LoadedPair(
            place.contact, g, p, float(f), place.apart,
            hertz_of(gear, place.contact, float(f)) if f > 0.0 and not place.contact.touch.edge else None,
        )
        for place, g, p, f in zip(used, grids, pressures, forces, strict=True)
    )  # fmt: skip
    unloaded = wheel_angle - gear.ratio * pinion_angle
    # The driven side lags: the pinion winds up ahead of the wheel by the rotation.
    wound = direction * rotation * member.turning
    lag = -gear.ratio * wound if load.member == "pinion" else wound
    return LoadedContact(pinion_angle, load, solved, rotation, unloaded + lag, unloaded)


# By pair (``pairs_later``) the cells of the pass before and their pressures.
_Before = dict[int, tuple[ContactGrid, Floats]]


@dataclass(frozen=True)
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
        """The tangent plane there with the flanks over it."""
        return ContactPlane.of(self.gear, self.contact, self.angles)


def _first_rotation(gear: GearPair, places: tuple[_Place, ...], load: Load) -> float:
    """About how far the loaded member turns, rad: under the whole torque on the pair that touches first."""
    first = min(places, key=lambda place: place.apart)
    return _TEETH_SOFTER * hertz_of(gear, first.contact, load.torque / first.arm).approach / first.arm


def _and_around(cells: Bools) -> Bools:
    """The cells (N,) of a square grid and their neighbours."""
    side = math.isqrt(len(cells))
    return binary_dilation(cells.reshape(side, side), np.ones((3, 3))).ravel()


def _grid(place: _Place, force: float, rotation: float, cells: int) -> ContactGrid | None:
    """The cells of a pair; None of an edge that the load does not bring to the mate."""
    if place.contact.touch.edge:
        closing = rotation * place.arm
        return overlap_grid(place.plane, place.apart, closing, cells) if closing > place.apart else None
    ellipse = hertz_of(place.gear, place.contact, force)
    reach = _REACH * np.array([ellipse.semi_major, ellipse.semi_minor])
    grid = contact_grid(place.plane, reach, cells)
    if grid.inside.mean() > _LEAST_USED:
        return grid
    return fitted_grid(place.plane, reach, math.inf, cells) or grid


def _likely(place: _Place, grid: ContactGrid, before: tuple[ContactGrid, Floats] | None, rotation: float) -> Bools:
    """The cells (N,) of a pair thought to touch, from those of other cells ``before`` and their pressures."""
    if before is not None and not np.any(before[1] > 0.0):
        return np.zeros(len(grid.gap), dtype=bool)
    if not place.contact.touch.edge:
        return _in_ellipse(grid)
    if before is None:
        return grid.gap < _TOUCHING * rotation * place.arm
    old, pressures = before
    side, half = math.isqrt(len(pressures)), np.array([old.half_major, old.half_minor])
    cell = np.floor((grid.centres - old.centres[0] + half) / (2.0 * half)).astype(int)
    held = np.all((cell >= 0) & (cell < side), axis=1)
    return held & (pressures[side * np.clip(cell[:, 0], 0, side - 1) + np.clip(cell[:, 1], 0, side - 1)] > 0.0)


def _in_ellipse(grid: ContactGrid) -> Bools:
    """Cells inside the Hertz ellipse that the grid was made for."""
    extent = np.abs(grid.centres).max(axis=0) + np.array([grid.half_major, grid.half_minor])
    return np.hypot(*(_REACH * grid.centres / extent).T) < 1.0


def _equilibrium(
    gear: GearPair,
    places: tuple[_Place, ...],
    grids: list[ContactGrid],
    load: Load,
    compliance: dict[str, ToothCompliance] | None,
    start: list[Bools],
) -> tuple[list[Floats], float]:
    """Pressures (N,) of the cells of each pair and the rotation; ``start`` (N,): the cells of each thought to touch."""
    if not grids:
        raise ArithmeticError("no cell of the flanks comes into contact: choose a larger torque")
    member, _ = loaded_side(gear, load)
    origin, axis = member.axis
    contacts = tuple(place.contact for place in places)
    areas = np.concatenate([np.full(len(g.gap), g.area) for g in grids])
    cells = Cells.of(gear, contacts, grids, compliance or {})
    arms = np.concatenate(
        [np.abs(np.cross(g.points - origin, c.touch.normal) @ axis) for c, g in zip(contacts, grids, strict=True)]
    )
    gap = np.concatenate([g.gap for g in grids])
    inside = np.concatenate([g.inside for g in grids])
    pressure, rotation = active_set(cells, gap, arms, areas, inside, np.concatenate(start), load.torque)
    return cells.of_pairs(pressure), rotation
