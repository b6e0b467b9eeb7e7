"""Which cells touch: an active set over the cells of all pairs with one rigid rotation."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from meshwright.fe.cells import Bearing, Cells
from meshwright.fe.gap import Bools
from meshwright.fe.hexahedra import Floats, Ints

_ACTIVE_SET_STEPS = 200
# After fewer cells have lowered the energy, more are added: half of so many times as many.
_MORE = 4
#: Share of the cells above which those that are let go are taken out of a factorisation.
_KEPT = 0.75


@dataclass(frozen=True)
class _Touching:
    """Equilibrium of the cells ``used`` (U,), factorised, and of all of them but the rows ``dropped`` (R,).

    turned (U,): pressures by which the cells follow a unit rotation; levers (U,): moment of a unit pressure. whole
    (U + 1,): pressures of all and the rotation. inverse (U + 1, R): the columns of the inverse for what is dropped:
    W. W. Hager, Updating the inverse of a matrix (1989).
    """

    used: Ints
    bearing: Bearing
    areas: Floats
    levers: Floats
    turned: Floats
    whole: Floats
    dropped: Ints
    inverse: Floats

    @classmethod
    def of(cls, cells: Cells, used: Ints, gap: Floats, arms: Floats, areas: Floats, torque: float) -> _Touching:
        levers, bearing = areas[used] * arms[used], cells.bearing(used)
        turned = bearing.pressures(levers[:, None])[:, 0]
        none = np.empty(0, dtype=np.int64), np.empty((len(used) + 1, 0))
        open_ = cls(used, bearing, areas[used], levers, turned, np.empty(0), *none)
        return replace(open_, whole=open_._solved(-gap[used, None], torque)[:, 0])

    def _solved(self, displacements: Floats, torque: float) -> Floats:
        """Pressures and rotation (U + 1, K) where cells move by (U, K) less what the rotation gives way to."""
        pressures = self.bearing.pressures(self.areas[:, None] * displacements)
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


@dataclass(frozen=True)
class _Problem:
    """Least energy of pressures >= 0 on the cells, the moment of which is the torque."""

    cells: Cells
    gap: Floats
    arms: Floats
    areas: Floats
    torque: float

    def equilibrium(self, active: Bools) -> _Touching:
        """That of the active cells (N,), with pulls where there would be such."""
        return _Touching.of(self.cells, np.flatnonzero(active), self.gap, self.arms, self.areas, self.torque)

    def energy(self, pressure: Floats) -> float:
        """Energy in N mm of pressures (N,), less the work of the torque."""
        return float((self.areas * pressure) @ (0.5 * self.cells.under(pressure) + self.gap))

    def pressed(self, active: Bools) -> tuple[Floats, float]:
        """Pressures (N,) and rotation of those of the active cells that are left when all that pull are let go."""
        touching, active = self.equilibrium(active), active.copy()
        for _ in range(_ACTIVE_SET_STEPS):
            pressure, rotation = touching.pressure(len(active))
            pulled = pressure < 0.0
            if not pulled.any():
                return pressure, rotation
            active &= ~pulled
            touching = touching.without(pulled) if touching.most(active) else self.equilibrium(active)
        raise ArithmeticError(f"the loaded contact did not settle in {_ACTIVE_SET_STEPS} steps")

    def lower(self, before: Floats, active: Bools) -> tuple[Floats, float]:
        """As ``pressed``, from pressures (N,) on part of the active cells on: each is let go when it is about to pull,
        so that the energy falls all the way.
        """
        touching, active = self.equilibrium(active), active.copy()
        for _ in range(len(active)):
            pressure, rotation = touching.pressure(len(active))
            pulled = pressure < 0.0
            if not pulled.any():
                return pressure, rotation
            way = np.full(len(active), np.inf)
            way[pulled] = before[pulled] / (before - pressure)[pulled]
            before = before + way.min() * (pressure - before)
            let_go = way <= way.min()
            before[let_go] = 0.0
            active &= ~let_go
            touching = touching.without(let_go) if touching.most(active) else self.equilibrium(active)
        raise ArithmeticError("the loaded contact did not settle")


def active_set(
    cells: Cells, gap: Floats, arms: Floats, areas: Floats, start: Bools, torque: float
) -> tuple[Floats, float]:
    """Pressures (N,) >= 0 and rotation with gap + displacement - rotation arms >= 0, zero where p > 0, moment = torque.

    start (N,): cells thought to touch. All that overlap are added at once, and all that pull let go at once, as
    long as that lowers the energy; else fewer are, the worst first, and let go one by one: so no set of cells comes
    twice. Source: C. L. Lawson, R. J. Hanson, Solving least squares problems (1974), chapter 23. Raises
    ArithmeticError if the set of touching cells does not settle.
    """
    of = _Problem(cells, gap, arms, areas, torque)
    scale, added = cells.largest, len(gap)
    pressure, rotation = of.pressed(start if start.any() else gap <= gap.min())
    for _ in range(_ACTIVE_SET_STEPS):
        opening = gap + cells.under(pressure) - rotation * arms
        overlapping = (pressure <= 0.0) & (opening < -1e-9 * scale * max(1.0, float(pressure.max())))
        if not overlapping.any():
            return pressure, rotation
        energy = of.energy(pressure)
        found = of.pressed((pressure > 0.0) | overlapping) if added == len(gap) else (pressure, rotation)
        while not of.energy(found[0]) < energy:
            added = max(min(added, int(overlapping.sum())) // 2, 1)
            worst = np.zeros(len(gap), dtype=bool)
            worst[np.argsort(np.where(overlapping, opening, np.inf))[:added]] = True
            found = of.lower(pressure, (pressure > 0.0) | worst)
            if added == 1:
                break
        else:
            added = min(_MORE * added, len(gap))
        pressure, rotation = found
    raise ArithmeticError(f"the loaded contact did not settle in {_ACTIVE_SET_STEPS} steps")
