"""Samples of a sweep: a drive under many values of its keys, solved in lanes, judged as each is by itself.

What :meth:`~meshwright.drive.Drive.tca` says of a whole tooth pair – its teeth do not reach each other, it runs on an
edge – is asked of the drive of a sample, but only where lanes over the whole batch leave it open.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from meshwright.base.errors import DesignError
from meshwright.base.library import library, pointer
from meshwright.contact import analysis, flags
from meshwright.contact.results import OFF_TIP, SOLVED, impossible
from meshwright.cycle import windows
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.path import NODES_PER_PITCH
from meshwright.cycle.transmission import ROUND_OFF
from meshwright.design import description as metadata
from meshwright.design import design as designs
from meshwright.drive import Drive

#: Width of the lanes that give the same bits on every machine.
PORTABLE_WIDTH = 2

#: Beyond the ends of the nominal window samples are followed by this share of a pitch, to find their own ends.
MARGIN = 0.5


@dataclass(frozen=True)
class Batch:
    """S samples of a drive: complete parameter vectors (S, np), and what traces them: a set of lanes, and a device
    before it, a function such as :func:`meshwright.sweep.device.on_cuda`, or None.

    A row of NaN is no design; its points are bad input.
    """

    drive: Drive
    parameters: np.ndarray
    lanes: object
    device: Callable | None = None

    @classmethod
    def of(cls, drive, keys, values, portable=False, device=None):
        """The samples of ``values`` (S, K) of ``keys`` ("table.key"), in the units of the keys."""
        lanes = library().mw_lanes(PORTABLE_WIDTH if portable or device else 0)
        return cls(drive, _parameters(drive, keys, values), lanes, device)

    def only(self, rows):
        return replace(self, parameters=np.ascontiguousarray(self.parameters[rows]))

    def points(self, angles):
        """:class:`Points` at pinion angles (N,) of the right-hand drive, rad."""
        angles = np.ascontiguousarray(angles, dtype=float)
        start = np.ascontiguousarray(self.drive.trace(angles[:1])[0])
        if self.device is None or np.abs(angles).max(initial=0.0) > library().MW_MAX_TURN:
            return self._in_lanes(angles, start)
        through, status, flags, error, points = self.device(self.drive, self.parameters, angles, start[0])
        rest = self.only(~through)._in_lanes(angles, start)
        for found, of_lanes in ((status, rest.status), (flags, rest.flags), (error, rest.error), (points, rest.points)):
            found[~through] = of_lanes
        return Points(status, error, points, flags)

    def _in_lanes(self, angles, start):
        m, count, n = _in_lanes(self.drive), len(self.parameters), len(angles)
        x, work = np.empty((count, n, m.nx)), np.empty(library().mw_lanes_work(self.lanes, m, n))
        status, flags = np.empty((count, n), dtype=np.int32), np.empty((count, n), dtype=np.uint32)
        library().mw_trace_designs(
            self.lanes, m, pointer(self.parameters), count, pointer(angles), n, pointer(start), pointer(work),
            pointer(x), pointer(status, "int[]"),
        )  # fmt: skip
        points, s, o = np.empty((count, n, 3)), np.empty(m.ns), np.empty(m.no)
        library().mw_contact_points(
            m, pointer(self.parameters), count, pointer(angles), n, pointer(x), pointer(status, "int[]"), pointer(s),
            pointer(o), pointer(points), pointer(flags, "unsigned int[]"),
        )  # fmt: skip
        error = np.where(status >= 0, x[..., self.drive.design.description["error"]], np.nan)
        return Points(status, error, points, flags)


@dataclass(frozen=True)
class Points:
    """``status``, ``error`` (rad), ``flags`` (S, N) and contact ``points`` (S, N, 3), fixed frame, mm."""

    status: np.ndarray
    error: np.ndarray
    points: np.ndarray
    flags: np.ndarray

    @property
    def solved(self):
        """Which points have a contact point: (S, N) of bool."""
        return np.isin(self.status, analysis.status_codes(*SOLVED))

    def mirrored(self, mirror):
        """The same by a :class:`~meshwright.design.mirror.Mirror`."""
        return Points(self.status, mirror.sign * self.error, self.points * mirror.flip, self.flags)


def solve(drive, keys, values, angles, portable=False, device=None):
    """:class:`Points` of the samples ``values`` (S, K) of ``keys`` at pinion angles (N,), rad: as of ``Drive.tca``."""
    mirror = drive.design.mirror
    angles = np.asarray(angles, dtype=float)
    batch = Batch.of(drive, keys, values, portable, device)
    found = batch.points(mirror.sign * angles).mirrored(mirror)

    def drive_of(k):
        return with_keys(drive, keys, values[k])

    for k in np.flatnonzero(_perhaps_past_the_tips(batch, found)):
        if drive_of(k).past_the_tips:
            found.status[k], found.flags[k] = analysis.status_codes("no_contact")[0], 0
            found.error[k], found.points[k] = np.nan, np.nan
    found.flags[:] |= _bits(drive, flags.ON_EDGE) * _on_an_edge(batch, found, angles, drive_of)
    _without_tangency(drive, found, angles, drive_of)
    return found


def _without_tangency(drive, found, angles, drive_of):
    """Fill in where and how the bounded flanks touch at points at which lanes found no tangency, or nearly a line; and
    at all of a sample of which some points are none that bodies can make: how a trace goes on past these depends on
    its steps.
    """
    open_ = ~found.solved | (found.status == library().MW_CONVERGED_NOISE)
    open_ |= (found.solved & (found.flags & impossible_bits(drive) != 0)).any(axis=1)[:, None]
    open_ &= found.status != library().MW_BAD_INPUT
    for k in np.flatnonzero(open_.any(axis=1)):
        result, rows = drive_of(k).tca(angles), open_[k]
        found.status[k, rows] = [analysis.status_codes(word)[0] for word in result.only(rows).status]
        found.error[k, rows], found.points[k, rows] = result.error[rows], result.points[rows]
        found.flags[k, rows] = [_bits(drive, *words) for words in result.only(rows).flags]


def _in_lanes(drive):
    """The model table, with its lane kernels where compiled arithmetic solves the drive."""
    return drive.design.model_in_lanes if drive.backend == "c" else drive.model


def with_keys(drive, keys, values):
    """The drive with other values of keys ("table.key"), in the units of the keys."""
    changes = {}
    for key, value in zip(keys, values.tolist(), strict=True):
        table, _, name = key.partition(".")
        changes.setdefault(table, {})[name] = value
    return drive.with_(**changes)


def flag_names(drive):
    """The flags of a drive's points, from the lowest bit."""
    return [*analysis.flag_names(drive.model), flags.ON_EDGE]


def impossible_bits(drive):
    """The bits of flags that mark points which bodies cannot make."""
    return _bits(drive, *filter(impossible, flag_names(drive)))


def _bits(drive, *flags):
    return np.uint32(sum(1 << k for k, name in enumerate(flag_names(drive)) if name in flags))


def _perhaps_past_the_tips(batch, found):
    """Samples whose every contact is off a tip, also where the nominal teeth reach each other: (S,) of bool."""
    off_tip, solved = _bits(batch.drive, OFF_TIP), found.solved
    perhaps = solved.any(axis=1) & ((found.flags & off_tip != 0) | ~solved).all(axis=1)
    angle = windows.inside_the_tips(batch.drive) if perhaps.any() else None
    if angle is not None:
        there = batch.only(perhaps).points(np.array([angle]))
        perhaps[perhaps] = ((there.flags & off_tip != 0) | ~there.solved)[:, 0]
    return perhaps


def _on_an_edge(batch, found, angles, drive_of):
    """Which points belong to a pair that runs on an edge, where the drive's error is designed to avoid that: (S, N).

    ``drive_of(k)`` is the drive of sample k, asked where the nodes over its window do not say.
    """
    drive, solved = batch.drive, found.solved
    on_edge, rows = np.zeros_like(solved), np.flatnonzero(solved.any(axis=1))
    if not drive.design.description["absorbs_errors"] or not rows.size:
        return on_edge
    within = solved & ((found.flags & ~impossible_bits(drive)) == 0)
    for k, stretch in zip(rows, _edge_stretches(batch.only(rows)), strict=True):
        if stretch is None:
            on_edge[k] = solved[k] & flags.inside(drive_of(k).edge_window, angles)
        else:
            on_edge[k] = within[k] & flags.inside(stretch, angles)
    return on_edge


def _edge_stretches(batch):
    """For each sample the pinion angles, rad, between which a pair that runs on an edge is within its limits.

    An empty pair if it does not run on an edge, None where nodes over the window and beyond leave that open.
    """
    mesh = Mesh.of(batch.drive)
    if mesh.window.path is None or not mesh.window.complete:
        return [None] * len(batch.parameters)
    angles = _nodes(mesh)
    nodes = batch.points(angles)
    possible = nodes.solved & ((nodes.flags & impossible_bits(batch.drive)) == 0)
    ahead = mesh.sense * mesh.mirror * nodes.error
    found = [_ends(*row) for row in zip(ahead, possible, possible & (nodes.flags == 0), strict=True)]
    return [ends and tuple(sorted(mesh.mirror * angles[list(ends)])) for ends in found]


def _nodes(mesh):
    """Angles over the window and beyond, right-hand drive."""
    pitch, (low, high) = mesh.drive.pitch(), mesh.window.bounds
    low, high = low - MARGIN * pitch, high + MARGIN * pitch
    return np.linspace(low, high, int(np.ceil((high - low) / pitch * NODES_PER_PITCH)) + 1)


def _ends(ahead, possible, within):
    """The nodes just outside a window whose error is extreme at an end of it; () if it is inside, None if unclear.

    ``ahead`` (N,) is the error the way the wheel is pushed, ``within`` says which nodes lie within all limits. The ends
    of the window lie between the outermost nodes within and the next ones: the error there is between theirs.
    """
    (inside,) = np.nonzero(within)
    if not inside.size or inside[0] == 0 or inside[-1] == len(within) - 1:
        return None
    ends = inside[0] - 1, inside[-1] + 1
    around = slice(ends[0], ends[1] + 1)
    if np.ptp(inside) + 1 != inside.size or not possible[around].all() or np.ptp(ahead[around]) <= ROUND_OFF:
        return None
    largest, last = np.argmax(ahead[around]), inside.size + 1
    if largest in (0, last):
        best = np.argmax(ahead[inside]) + 1
        near = ahead[around][:3] if largest == 0 else ahead[around][:-4:-1]
        falls = 4.0 * near[1] - 3.0 * near[0] - near[2] < 0.0  # a parabola through them, from outside the window on
        return ends if falls and abs(best - largest) == 1 else None
    return () if 1 < largest < last - 1 else None


def _parameters(drive, keys, values):
    """Complete parameter vectors (S, np) of the samples; NaN where there is no such design.

    Rules and design systems are applied anew where more than misalignments vary: nothing follows from those.
    """
    columns = [column(drive, key) for key in keys]
    follows = any(p["table"] != "misalignment" for _, p in columns)
    rows = np.tile(designs.given_vector(drive.design) if follows else drive.design.parameters, (len(values), 1))
    for (k, p), numbers in zip(columns, values.T, strict=True):
        rows[:, k] = numbers * p["factor"]
    possible = designs.allowed(drive.design, dict(zip(keys, values.T, strict=True)))
    if follows:
        for k in np.flatnonzero(possible):
            possible[k] = designs.complete(drive.design.model, drive.design.description, rows[k]) == 0
    rows[~possible] = np.nan
    return rows


def column(drive, key):
    """Index and entry of the parameter that a key ("table.key") of the design file sets; it must be free to vary."""
    table, _, name = key.partition(".")
    description = drive.design.description
    known = metadata.parameters(description["family"], drive.design.places)
    if table == "design" and designs.has_rival(drive.design, name):
        raise DesignError(key, None, "another key of the design determines it", "vary that key instead")
    if any(key in group for group in description["together"]) and not _is_given(drive.design, table, name):
        raise DesignError(key, None, "it makes sense only together with others", "give all of them in the design")
    for k, p in enumerate(description["parameters"]):
        if (p["table"], p["key"]) == (table, name):
            if not designs.is_real(p):
                raise DesignError(key, None, "a whole number or a word does not vary", "vary another key")
            return k, p
    if any((p["table"], p["key"]) == (table, name) for p in known):
        raise DesignError(key, None, f"no key of a {description['title']!r}", "vary another key")
    raise DesignError(key, None, "no real parameter of this drive", "`meshwright drives` lists the keys as table.key")


def _is_given(design, table, key):
    return design.tables[table].get(key) is not None
