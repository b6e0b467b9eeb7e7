"""Contact of an edge: where a flank ends at its tip or its face, its edge touches the mating flank.

The edge is where a limit function of its member is zero. It touches the mating flank where its tangent is normal to
that flank's normal: five conditions (common point, on the edge, tangency) for two parameters on either flank and the
wheel angle, besides the conditions that either flank keeps. Right-hand drive, like the path of contact.
"""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.base.library import ffi, pointer
from meshwright.cycle.path import NODES_PER_PITCH, Path
from meshwright.cycle.windows import Limit, limits_of

#: Events at which the flank ends in a convex edge. At its root it runs on into a fillet, which no mating tip reaches in
#: a drive that works; at an undercut or a fold it ends otherwise.
EDGES = frozenset({"tip", "throat", "face"})

#: Differences of the limit function and of the equations, in natural sizes of the unknowns.
STEP = 1e-5
MAX_STEPS = 30

#: Edge contact is followed no further than this.
MAX_PITCHES = 8
STEP_DONE = 1e-10

#: The slopes are kept while steps shrink at least so fast.
SLOW = 0.1


@dataclass(frozen=True)
class EdgePath:
    """Edge contact beyond one end of a window: solutions at ``angles`` (N,), away from the window, right hand.

    ``limit`` is the edge. ``ended``: why it goes no further: the ``reason`` word of the next limit, or "".
    """

    limit: Limit
    angles: np.ndarray
    unknowns: np.ndarray
    ended: str
    path: Path

    @property
    def bounds(self):
        """Smallest and largest angle."""
        return float(self.angles.min()), float(self.angles.max())

    def solve(self, angles):
        """Unknowns (M, nx) at input angles; NaN beyond the ends."""
        angles = np.atleast_1d(np.asarray(angles, dtype=float))
        solved = np.full((len(angles), self.unknowns.shape[1]), np.nan)
        equations = _Equations.of(self.path, self.limit)
        low, high = self.bounds
        for k, angle in enumerate(angles):
            if low <= angle <= high:
                found = equations.solve(angle, self._between(angle))
                solved[k] = np.nan if found is None else found
        return solved

    def _between(self, angle):
        order = np.argsort(self.angles)
        columns = self.unknowns[order].T
        return np.array([np.interp(angle, self.angles[order], column) for column in columns])

    def errors(self, angles):
        """Transmission error, rad, at input angles (M,)."""
        return self.solve(angles)[:, self.path.error_index]


def edge_paths(mesh):
    """Edge contact beyond the lower and the upper end of the window, right hand: a pair of :class:`EdgePath`, None
    where no material edge ends the window. It is followed for a pitch, and on until the pair can no longer lead or a
    limit ends it.
    """
    window = mesh.window
    if window.path is None:
        return None, None
    events = sorted((e for e in (window.begin, window.end) if e.exists), key=lambda e: mesh.mirror * e.angle)
    low, high = window.bounds
    lower = _followed(mesh, events[0], -1.0) if math.isfinite(low) else None
    upper = _followed(mesh, events[-1], 1.0) if math.isfinite(high) else None
    return lower, upper


def _followed(mesh, event, sign):
    if event.reason not in EDGES:
        return None
    path, start = mesh.window.path, mesh.mirror * event.angle
    limits = limits_of(mesh.drive)
    unknowns = path.solve([start])[0]
    limit = _active(path, limits, event, start)
    others = [m for m in limits if m.index != limit.index]
    equations = _Equations.of(path, limit)
    step = sign * mesh.drive.pitch() / NODES_PER_PITCH
    least = _least_leading(mesh)
    angles, solutions, ended = [start], [unknowns], ""
    for k in range(1, MAX_PITCHES * NODES_PER_PITCH + 1):
        found = equations.solve(start + k * step, _predicted(solutions))
        if found is None:
            break
        worst = _violated(path, others, start + k * step, found)
        if worst:
            ended = worst
            break
        angles.append(start + k * step)
        solutions.append(found)
        if k >= NODES_PER_PITCH and mesh.mirror * mesh.sense * found[path.error_index] < least:
            break
    return EdgePath(limit, np.array(angles), np.array(solutions), ended, path)


def _least_leading(mesh):
    """Smallest sense · error of a pair inside its window: below it a pair does not lead; without a window, always."""
    path, (low, high) = mesh.window.path, mesh.window.bounds
    inside = path.unknowns[(path.angles >= low) & (path.angles <= high), path.error_index]
    return float(np.min(mesh.mirror * mesh.sense * inside)) if mesh.window.complete else -math.inf


def _active(path, limits, event, angle):
    """The limit that the event names: of several with its name the one that is zero there."""
    named = [m for m in limits if (m.member, m.reason) == (event.member, event.reason)]
    values = path.observe([angle])[0]
    return min(named, key=lambda m: abs(values[m.index]))


def _predicted(solutions):
    return solutions[-1] if len(solutions) < 2 else 2.0 * solutions[-1] - solutions[-2]


def _violated(path, limits, angle, unknowns):
    """Reason word of a limit that a solution violates, or ""."""
    values = path.observe([angle], unknowns[None, :])[0]
    return next((m.reason for m in limits if values[m.index] < 0.0), "")


@dataclass(frozen=True)
class _Equations:
    """The conditions of edge contact on the unknowns of the drive. ``edge`` and ``mate`` are the members' numbers."""

    path: Path
    limit: Limit
    bodies: tuple
    edge: int
    scale: np.ndarray

    @classmethod
    def of(cls, path, limit):
        bodies = path.drive.design.description["bodies"]
        model, scale = path.drive.model, np.empty(path.drive.model.nx)
        model.scale(pointer(path.state), pointer(scale))
        return cls(path, limit, tuple(bodies), [b["name"] for b in bodies].index(limit.member), scale)

    def solve(self, angle, unknowns):
        """The solution near given unknowns; None if Newton's method does not find it."""
        x, slopes, before = unknowns.copy(), None, math.inf
        for _ in range(MAX_STEPS):
            slopes = self._slopes(angle, x) if slopes is None else slopes
            try:
                step = np.linalg.solve(slopes, self(angle, x))
            except np.linalg.LinAlgError:
                return None
            largest = np.abs(step).max()
            if not math.isfinite(largest):
                return None
            x -= step * self.scale * min(1.0, 0.5 / max(largest, 1e-300))
            if largest < STEP_DONE:
                return x
            if largest > SLOW * before:
                slopes = None
            before = largest
        return None

    def __call__(self, angle, x):
        """Residual: distance (3), limit, tangency, conditions of the flanks."""
        o = self.path.observe([angle], x[None, :])[0]
        mate = 1 - self.edge
        tangent, normal = self._edge_tangent(angle, x, o), o[6 * mate + 3 : 6 * mate + 6]
        tangency = tangent @ normal / np.linalg.norm(tangent)
        return np.array([*(o[0:3] - o[6:9]), o[self.limit.index], tangency, *self._conditions(x)])

    def _edge_tangent(self, angle, x, o):
        """Direction in space along which neither the limit nor the flank's own condition changes."""
        body = self.bodies[self.edge]
        k, at = body["parameters"], body["at"]
        slopes = [self._limit_slopes(angle, x)]
        tangents = o[at : at + 3 * len(k)].reshape(len(k), 3)
        if body["conditions"]:
            slopes.append(o[at + 3 * len(k) : at + 4 * len(k)])
        first = slopes[0]
        free = np.array([-first[1], first[0]]) if len(slopes) == 1 else np.cross(*slopes)
        return free @ tangents

    def _limit_slopes(self, angle, x):
        slopes = []
        for index in self.bodies[self.edge]["unknowns"]:
            around = []
            for h in (STEP, -STEP):
                moved = x.copy()
                moved[index] += h * self.scale[index]
                around.append(self.path.observe([angle], moved[None, :])[0, self.limit.index])
            slopes.append((around[0] - around[1]) / (2.0 * STEP * self.scale[index]))
        return np.array(slopes)

    def _conditions(self, x):
        """What the drive's own equations keep beyond common point and common tangent plane."""
        if len(x) == 5:
            return ()
        model, residual = self.path.drive.model, np.empty(len(x))
        model.eval(pointer(self.path.state), pointer(np.ascontiguousarray(x)), pointer(residual), ffi.NULL)
        return residual[5:]

    def _slopes(self, angle, x):
        """Jacobian by unknowns in natural sizes, by central differences."""
        columns = []
        for index in range(len(x)):
            around = []
            for h in (STEP, -STEP):
                moved = x.copy()
                moved[index] += h * self.scale[index]
                around.append(self(angle, moved))
            columns.append((around[0] - around[1]) / (2.0 * STEP))
        return np.stack(columns, axis=1)
