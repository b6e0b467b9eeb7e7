"""Contact of an edge: where a flank ends at its tip or its face, its edge touches the mating flank.

The equations are the drive's own (:mod:`derive.passes.edges`), solved by the core library. Where the edge runs off the
mating flank over an edge of that, both edges touch: the path goes on with their common point. Right-hand drive, like
the path of contact.
"""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.base.library import ffi, library, pointer
from meshwright.base.roots import bracketed
from meshwright.cycle.path import NODES_PER_PITCH, Path
from meshwright.cycle.windows import ANGLE_TOLERANCE, Limit, limits_of

#: Edge contact is followed no further than this.
MAX_PITCHES = 8


@dataclass(frozen=True)
class EdgePath:
    """Edge contact beyond one end of a window: solutions at ``angles`` (N,), away from the window, right hand.

    ``limit`` is the edge. ``systems`` (N,): the system of equations between a node and the one before it; where it
    changes, ``corner`` is the limit of the mating flank whose edge touches from there on, else None. ``ended``: why it
    goes no further: the ``reason`` word of the next limit, or "".
    """

    limit: Limit
    angles: np.ndarray
    unknowns: np.ndarray
    systems: np.ndarray
    corner: Limit | None
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
        away = np.abs(self.angles - self.angles[0])
        low, high = self.bounds
        for k, angle in enumerate(angles):
            if low <= angle <= high:
                behind = max(int(np.searchsorted(away, abs(angle - self.angles[0]))), 1)
                nodes = self.angles[behind - 1], self.unknowns[behind - 1]
                found = _followed(self.path, int(self.systems[min(behind, len(away) - 1)]), *nodes, np.array([angle]))
                if len(found):
                    solved[k] = found[0]
        return solved

    def errors(self, angles):
        """Transmission error, rad, at input angles (M,)."""
        return self.solve(angles)[:, self.path.error_index]


def edge_paths(mesh):
    """Edge contact beyond the lower and the upper end of the window, right hand: a pair of :class:`EdgePath`, None
    where no edge ends the window. It is followed for a pitch, and on until the pair can no longer lead or a limit ends
    it.
    """
    window = mesh.window
    if window.path is None:
        return None, None
    events = sorted((e for e in (window.begin, window.end) if e.exists), key=lambda e: mesh.mirror * e.angle)
    low, high = window.bounds
    lower = _edge_path(mesh, events[0], -1.0) if math.isfinite(low) else None
    upper = _edge_path(mesh, events[-1], 1.0) if math.isfinite(high) else None
    return lower, upper


def _edge_path(mesh, event, sign):
    path, start = mesh.window.path, mesh.mirror * event.angle
    limits = limits_of(mesh.drive)
    limit = _active(path, limits, event, start)
    if limit is None or (system := _system(path, (limit,))) < 0:
        return None
    others = [m for m in limits if m.index != limit.index]
    walk = _Walk(mesh, np.array([start]), path.solve([start]), np.array([system]))
    walk, crossed = walk.along(system, others, sign)
    corner = None
    if crossed is not None and (system := _system(path, (limit, crossed))) >= 0:
        others = [m for m in others if m.index != crossed.index]
        further, next_crossed = walk.along(system, others, sign)
        if len(further.angles) > len(walk.angles):
            walk, corner, crossed = further, crossed, next_crossed
    return EdgePath(limit, walk.angles, walk.unknowns, walk.systems, corner, crossed.reason if crossed else "", path)


@dataclass(frozen=True)
class _Walk:
    """Nodes of edge contact, away from the window."""

    mesh: object
    angles: np.ndarray
    unknowns: np.ndarray
    systems: np.ndarray

    def along(self, system, limits, sign):
        """The walk continued by one system of equations, and the first limit that ends it, None where none does."""
        path, pitch = self.mesh.window.path, self.mesh.drive.pitch()
        step, walk = sign * pitch / NODES_PER_PITCH, self
        farthest = self.angles[0] + sign * MAX_PITCHES * pitch
        while sign * (farthest - walk.angles[-1]) > 0.5 * abs(step):
            wanted = walk.angles[-1] + step * np.arange(1, NODES_PER_PITCH + 1)
            found = _followed(path, system, walk.angles[-1], walk.unknowns[-1], wanted)
            values = path.observe(wanted[: len(found)], found)[:, [m.index for m in limits]]
            inside = ~(values < 0.0).any(axis=1)
            count = len(found) if inside.all() else int(np.argmin(inside))
            lost = walk._lost(wanted[:count], found[:count])
            if lost is not None:
                return walk._with(system, wanted[:lost], found[:lost]), None
            walk = walk._with(system, wanted[:count], found[:count])
            if count < len(found):
                exceeded = [m for m, v in zip(limits, values[count], strict=True) if v < 0.0]
                return walk._to_limit(system, exceeded, wanted[count])
            if count < NODES_PER_PITCH:
                return walk, None
        return walk, None

    def _with(self, system, angles, unknowns):
        return _Walk(
            self.mesh,
            np.concatenate([self.angles, angles]),
            np.concatenate([self.unknowns, unknowns]),
            np.concatenate([self.systems, np.full(len(angles), system)]),
        )

    def _lost(self, angles, unknowns):
        """How many of the next nodes it takes until the pair can no longer lead; None if it always can."""
        mesh = self.mesh
        ahead = mesh.mirror * mesh.sense * unknowns[:, mesh.window.path.error_index]
        whole = np.abs(angles - self.angles[0]) >= (1.0 - 1e-9) * mesh.drive.pitch()
        behind = whole & (ahead < _least_leading(mesh))
        return int(np.argmax(behind)) + 1 if behind.any() else None

    def _to_limit(self, system, limits, beyond):
        """The walk up to the first of the limits that it exceeds at the angle ``beyond``, and that limit."""
        path, begin = self.mesh.window.path, (self.angles[-1], self.unknowns[-1])

        def value(limit, angle):
            return path.observe([angle], _followed(path, system, *begin, np.array([angle])))[0, limit.index]

        crossed = []
        for limit in limits:
            ends = value(limit, begin[0]), value(limit, beyond)
            at = begin[0] if ends[0] < 0.0 else beyond  # where it is zero but for rounding
            if ends[1] < 0.0 <= ends[0]:
                at = bracketed(lambda angle, m=limit: value(m, angle), begin[0], beyond, ANGLE_TOLERANCE, ends)
            crossed.append((abs(at - begin[0]), at, limit))
        away, at, limit = min(crossed, key=lambda c: c[0])
        if away == 0.0:
            return self, limit
        return self._with(system, np.array([at]), _followed(path, system, *begin, np.array([at]))), limit


def _system(path, limits):
    """Number of the equations in which these limits, of a member each, are edges that touch; -1 if there are none."""
    bodies, margins = path.drive.design.description["bodies"], {0: -1, 1: -1}
    for limit in limits:
        number = next(k for k, b in enumerate(bodies) if b["name"] == limit.member)
        if margins[number] >= 0 or limit.index < bodies[number]["margin"]:
            return -1
        margins[number] = limit.index - bodies[number]["margin"]
    return library().mw_edge(_model(path), margins[0], margins[1])


def _model(path):
    """The compiled model, whatever backend solves the contact."""
    return path.drive.design.model


def _followed(path, system, angle, unknowns, wanted):
    """Solutions along the angles ``wanted`` (N,), as far as the edge can be followed."""
    compiled = _model(path)
    state = path.drive.design.state.copy()
    x, records = np.empty((len(wanted), compiled.nx)), ffi.new("mw_info[]", max(len(wanted), 1))
    start, wanted = np.ascontiguousarray(unknowns), np.ascontiguousarray(wanted)
    solved = library().mw_edge_follow(
        compiled, system, pointer(state), angle, pointer(start), pointer(wanted), len(wanted), pointer(x), records
    )
    return x[:solved]


def _least_leading(mesh):
    """Smallest sense · error of a pair inside its window: below it a pair does not lead; without a window, always."""
    path, (low, high) = mesh.window.path, mesh.window.bounds
    inside = path.unknowns[(path.angles >= low) & (path.angles <= high), path.error_index]
    return float(np.min(mesh.mirror * mesh.sense * inside)) if mesh.window.complete else -math.inf


def _active(path, limits, event, angle):
    """The limit that the event names: of several with its name the one that is zero there."""
    named = [m for m in limits if (m.member, m.reason) == (event.member, event.reason)]
    values = path.observe([angle])[0]
    return min(named, key=lambda m: abs(values[m.index]), default=None)
