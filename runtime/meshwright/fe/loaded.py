"""Semi-analytic loaded contact: exact gaps, half-space cells, tooth compliance, one rigid rotation.

Unknowns are the pressures of all cells of all pairs and the rotation of the loaded member; an active set finds the
cells that touch.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import LinAlgError, block_diag, cho_factor, cho_solve
from scipy.ndimage import binary_dilation

from meshwright.fe.compliance import ToothCompliance, without_negative
from meshwright.fe.free_edges import free_edge_displacements
from meshwright.fe.gap import Bools, ContactGrid, contact_grid
from meshwright.fe.gate import LARGEST_ROTATION
from meshwright.fe.halfspace import equal_cells
from meshwright.fe.hertz import HertzContact
from meshwright.fe.hexahedra import Floats, Ints
from meshwright.fe.material import contact_modulus
from meshwright.fe.model import Load, hertz_of, loaded_side
from meshwright.fe.overlap import fitted_grid, overlap_grid
from meshwright.fe.pair import GearPair, Member, PairTouch, first_touches, lever_arm, unloaded_wheel_angle

_CELLS = 31
_FIRST_CELLS = 15
_REACH = 1.35
_LEAST_SHARE = 0.05
_ACTIVE_SET_STEPS = 200
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
    places = tuple(_Place.of(gear, member, contact, wheel_angle) for contact in contacts)
    used, forces, rotation = places, np.array([load.torque / place.arm for place in places]), math.nan
    passes = [_FIRST_CELLS, _CELLS]
    before: _Before = {}
    if any(place.contact.touch.edge for place in places):
        passes, rotation = [_FIRST_CELLS, *passes], _first_rotation(gear, places, load)
    for cells in passes:
        # The first pass finds the forces, the last fits each grid to its own ellipse, or to what the load closes.
        angles, least = (pinion_angle, wheel_angle), _LEAST_SHARE * load.torque
        known = {place.contact.pairs_later: force for place, force in zip(used, forces, strict=True)}
        laid = [
            (place, _grid(gear, place, angles, max(known.get(place.contact.pairs_later, 0.0), least / place.arm),
                          rotation, cells))
            for place in places
        ]  # fmt: skip
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
    """First contact of a pair: lever ``arm`` of the loaded member there, and how far the flanks are ``apart`` there
    along the normal when the first of all pairs touches, mm.
    """

    contact: PairTouch
    arm: float
    apart: float

    @classmethod
    def of(cls, gear: GearPair, member: Member, contact: PairTouch, wheel_angle: float) -> _Place:
        point, normal = contact.touch.point, contact.touch.normal
        lever = abs(lever_arm(gear.wheel, point, normal))
        return cls(contact, abs(lever_arm(member, point, normal)), lever * abs(wheel_angle - contact.wheel_angle))


def _first_rotation(gear: GearPair, places: tuple[_Place, ...], load: Load) -> float:
    """About how far the loaded member turns, rad: under the whole torque on the pair that touches first."""
    first = min(places, key=lambda place: place.apart)
    return _TEETH_SOFTER * hertz_of(gear, first.contact, load.torque / first.arm).approach / first.arm


def _and_around(cells: Bools) -> Bools:
    """The cells (N,) of a square grid and their neighbours."""
    side = math.isqrt(len(cells))
    return binary_dilation(cells.reshape(side, side), np.ones((3, 3))).ravel()


def _grid(
    gear: GearPair, place: _Place, angles: tuple[float, float], force: float, rotation: float, cells: int
) -> ContactGrid | None:
    """The cells of a pair; None of an edge that the load does not bring to the mate."""
    if place.contact.touch.edge:
        return overlap_grid(gear, place.contact, angles, place.apart, rotation * place.arm, cells)
    ellipse = hertz_of(gear, place.contact, force)
    reach = (_REACH * ellipse.semi_major, _REACH * ellipse.semi_minor)
    grid = contact_grid(gear, place.contact, angles, reach, cells)
    if grid.inside.mean() > _LEAST_USED:
        return grid
    return fitted_grid(gear, place.contact, angles, np.array(reach), math.inf, cells) or grid


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
    cells = _Cells.of(gear, contacts, grids, compliance or {})
    arms = np.concatenate(
        [np.abs(np.cross(g.points - origin, c.touch.normal) @ axis) for c, g in zip(contacts, grids, strict=True)]
    )
    gap = np.concatenate([g.gap for g in grids])
    inside = np.concatenate([g.inside for g in grids])
    pressure, rotation = active_set(cells, gap, arms, areas, inside, np.concatenate(start), load.torque)
    return np.split(pressure, np.cumsum([len(g.gap) for g in grids])[:-1]), rotation


@dataclass(frozen=True)
class _Cells:
    """How cells of all pairs, N together, move one another: displacements in mm by unit pressures.

    Of each pair: the displacements ``half_space`` (n, n) at so many cells' distances along and across; ``free`` (N, N),
    what free edges of the teeth near the cells add to them, None where there is none; ``smooth``, of a
    member, what its teeth add: weights (N, T P Q) of the patches of all pairs, and the displacement (T P Q, T P Q)
    between these by unit forces. ``areas`` (N,), ``pair`` and ``place`` (N,), (N, 2): of which pair, and where in it.
    """

    half_space: tuple[Floats, ...]
    free: tuple[Floats | None, ...]
    smooth: tuple[tuple[Floats, Floats], ...]
    areas: Floats
    pair: Ints
    place: Ints

    @classmethod
    def of(
        cls, gear: GearPair, contacts: tuple[PairTouch, ...], grids: list[ContactGrid],
        compliance: dict[str, ToothCompliance],
    ) -> _Cells:
        sides = [math.isqrt(len(grid.gap)) for grid in grids]
        modulus = contact_modulus(gear.pinion.material, gear.wheel.material)
        members = (("pinion", gear.pinion), ("wheel", gear.wheel))
        edges = {
            name: [free_edge_displacements(grid, name, of.material, compliance.get(name)) for grid in grids]
            for name, of in members
        }
        return cls(
            tuple(equal_cells(n, g.half_major, g.half_minor, modulus) for n, g in zip(sides, grids, strict=True)),
            tuple(_summed([of[0] for of in both if of]) for both in zip(*edges.values(), strict=True)),
            tuple(
                _smooth(name, tooth, contacts, grids, [of[1] if of else None for of in edges[name]])
                for name, tooth in compliance.items()
            ),
            np.concatenate([np.full(len(g.gap), g.area) for g in grids]),
            np.repeat(np.arange(len(grids)), [len(g.gap) for g in grids]),
            np.concatenate([np.stack(np.divmod(np.arange(n * n, dtype=np.int32), n), axis=1) for n in sides]),
        )

    def between(self, seen: Ints, pressed: Ints) -> Floats:
        """Displacements (S, P) of cells (S,) by unit pressures on others (P,)."""
        found = np.zeros((len(seen), len(pressed)))
        count = len(self.half_space)
        rows, columns = ([np.flatnonzero(self.pair[cells] == k) for k in range(count)] for cells in (seen, pressed))
        for k, (table, free) in enumerate(zip(self.half_space, self.free, strict=True)):
            of_pair = np.ix_(rows[k], columns[k])
            found[of_pair] = self._of_table(table, seen[rows[k]], pressed[columns[k]])
            if free is not None:
                begin = np.searchsorted(self.pair, k)
                found[of_pair] += free[np.ix_(seen[rows[k]] - begin, pressed[columns[k]] - begin)]
        for weights, block in self.smooth:
            # the cells of a pair are on the patches of its own tooth alone
            own = [slice(k * weights.shape[1] // count, (k + 1) * weights.shape[1] // count) for k in range(count)]
            moved = np.empty((weights.shape[1], len(pressed)))
            for patches, some in zip(own, columns, strict=True):
                forces = weights[pressed[some], patches].T * self.areas[pressed[some]]
                moved[:, some] = block[:, patches] @ forces
            for patches, some in zip(own, rows, strict=True):
                found[some] += weights[seen[some], patches] @ moved[patches]
        return found

    def _of_table(self, table: Floats, seen: Ints, pressed: Ints) -> Floats:
        """Entries (S, P) of a table (n, n) at the distances of cells of one pair along and across."""
        along, across = (np.abs(self.place[seen, None, k] - self.place[None, pressed, k]) for k in (0, 1))
        return table.ravel().take(along * len(table) + across)

    def under(self, pressure: Floats) -> Floats:
        """Displacements (N,) of all cells under pressures (N,)."""
        used = np.flatnonzero(pressure)
        found = np.zeros(len(pressure))
        for k, table in enumerate(self.half_space):
            rows, columns = np.flatnonzero(self.pair == k), used[self.pair[used] == k]
            found[rows] = self._of_table(table, rows, columns) @ pressure[columns]
            if (free := self.free[k]) is not None:
                found[rows] += free[:, columns - rows[0]] @ pressure[columns]
        for weights, block in self.smooth:
            found += weights @ (block @ (weights[used].T @ (self.areas * pressure)[used]))
        return found

    @property
    def largest(self) -> float:
        """The largest displacement (mm) of a cell by a unit pressure on itself."""
        own = np.array([table[0, 0] for table in self.half_space])[self.pair]
        for weights, block in self.smooth:
            patches = len(block) // len(self.half_space)
            for k in range(len(self.half_space)):
                rows, mine = self.pair == k, slice(k * patches, (k + 1) * patches)
                part = weights[rows, mine]
                own[rows] += np.sum((part @ block[mine, mine]) * part, axis=1) * self.areas[rows]
        return float(np.abs(own).max())


#: Share of the cells above which those that are let go are taken out of a factorisation.
_KEPT = 0.75


def _summed(parts: list[Floats]) -> Floats | None:
    return np.sum(parts, axis=0) if parts else None


def _smooth(
    name: str, tooth: ToothCompliance, contacts: tuple[PairTouch, ...], grids: list[ContactGrid],
    known: list[Floats | None],
) -> tuple[Floats, Floats]:
    """Weights (N, T P Q) of the patches of a member's T teeth, and what these move one another by unit forces.

    known: of each tooth, (P Q, P Q) of that which free edges add to the cells already, None for nothing. What is left
    stores no negative energy: teeth are cut out of the half-space, and stiffer by the coarseness of their mesh alone.
    """
    weights = block_diag(*(tooth.weights(g.place[name][:, 0], g.place[name][:, 1]) for g in grids))
    later = [contact.pairs_later for contact in contacts]
    nothing = np.zeros_like(tooth.own)
    blocks = [[tooth.between(seen, pressed) for pressed in later] for seen in later]
    whole = np.block([[nothing if block is None else block for block in row] for row in blocks])
    return weights, without_negative(whole - block_diag(*(nothing if k is None else k for k in known)))


@dataclass(frozen=True)
class _Touching:
    """Equilibrium of the cells ``used`` (U,), factorised, and of all of them but the rows ``dropped`` (R,).

    factor: Cholesky's, of what forces on the cells move one another by, times both areas: two loads do the same work
    on one another's displacements (E. Betti, 1872). turned (U,): pressures by which the cells follow a unit rotation;
    levers (U,): moment of a unit pressure. whole (U + 1,): pressures of all and the rotation. inverse (U + 1, R): the
    columns of the inverse for what is dropped: W. W. Hager, Updating the inverse of a matrix (1989).
    """

    used: Ints
    factor: tuple[Floats, bool]
    areas: Floats
    levers: Floats
    turned: Floats
    whole: Floats
    dropped: Ints
    inverse: Floats

    @classmethod
    def of(
        cls, cells: _Cells, used: Ints, gap: Floats, arms: Floats, areas: Floats, torque: float
    ) -> _Touching:
        levers = areas[used] * arms[used]
        system = cells.between(used, used)
        system *= areas[used, None]
        try:
            # of a symmetric matrix; the transposed one is laid out as LAPACK overwrites it
            factor = cho_factor(system.T, lower=True, overwrite_a=True, check_finite=False)
        except LinAlgError as error:
            raise ArithmeticError("the pressures of the cells in contact are not determined") from error
        turned = cho_solve(factor, levers, check_finite=False)
        none = np.empty(0, dtype=np.int64), np.empty((len(used) + 1, 0))
        open_ = cls(used, factor, areas[used], levers, turned, np.empty(0), *none)
        return replace(open_, whole=open_._solved(-gap[used, None], torque)[:, 0])

    def _solved(self, displacements: Floats, torque: float) -> Floats:
        """Pressures and rotation (U + 1, K) where cells move by (U, K) less what the rotation gives way to."""
        pressures = cho_solve(self.factor, self.areas[:, None] * displacements, overwrite_b=True, check_finite=False)
        rotation = (torque - self.levers @ pressures) / (self.levers @ self.turned)
        return np.vstack([pressures + self.turned[:, None] * rotation, rotation])

    def most(self, active: Bools) -> bool:
        """Whether so many of the cells are still ``active`` (N,) that it is less work not to factorise them anew."""
        return bool(active[self.used].mean() > _KEPT)

    def without(self, pulled: Bools) -> _Touching:
        """The same without further cells, given among all (N,)."""
        rows = np.setdiff1d(np.flatnonzero(pulled[self.used]), self.dropped)
        units = np.zeros((len(self.used), len(rows)))
        units[rows, np.arange(len(rows))] = 1.0
        inverse = np.hstack([self.inverse, self._solved(units, 0.0)])
        return replace(self, dropped=np.concatenate([self.dropped, rows]), inverse=inverse)

    def pressure(self, count: int) -> tuple[Floats, float]:
        """Pressures (count,) of all cells, and the rotation. Raises ArithmeticError where they are not determined."""
        solution = self.whole
        if len(self.dropped):
            open_again = np.linalg.solve(self.inverse[self.dropped], solution[self.dropped])
            solution = solution - self.inverse @ open_again
            solution[self.dropped] = 0.0
        if not np.isfinite(solution).all():
            raise ArithmeticError("the pressures of the cells in contact are not determined")
        found = np.zeros(count)
        found[self.used] = solution[:-1]
        return found, float(solution[-1])


def active_set(
    cells: _Cells, gap: Floats, arms: Floats, areas: Floats, inside: Bools, start: Bools, torque: float
) -> tuple[Floats, float]:
    """Pressures (N,) >= 0 and rotation with gap + displacement - rotation arms >= 0, zero where p > 0, moment = torque.

    start (N,): cells thought to touch.  Raises ArithmeticError if no cell is on both flanks, or the set of touching
    cells does not settle.
    """
    if not inside.any():
        raise ArithmeticError("no cell of the contact grid lies on both flanks: the load is too large for these teeth")
    active = inside & start
    if not active.any():
        active = inside & (gap <= gap[inside].min())
    scale = cells.largest
    touching: _Touching | None = None
    for _ in range(_ACTIVE_SET_STEPS):
        touching = touching or _Touching.of(cells, np.flatnonzero(active), gap, arms, areas, torque)
        pressure, rotation = touching.pressure(len(gap))
        pulled = pressure < 0.0
        if pulled.any():
            active &= ~pulled
            touching = touching.without(pulled) if touching.most(active) else None
            continue
        opening = gap + cells.under(pressure) - rotation * arms
        overlapping = inside & ~active & (opening < -1e-9 * scale * max(1.0, float(pressure.max())))
        if not overlapping.any():
            return pressure, float(rotation)
        active |= overlapping
        touching = None
    raise ArithmeticError(f"the loaded contact did not settle in {_ACTIVE_SET_STEPS} steps")
