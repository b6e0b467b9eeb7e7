"""Tooth contact analysis of one drive: trace in C, contact geometry of every point, results as columns."""

from dataclasses import dataclass
from functools import cache, cached_property
from itertools import count, takewhile

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import ffi, library, pointer, record, text
from meshwright.contact.model import DriveModel
from meshwright.contact.results import OFF_TIP, TCA


def largest_angle():
    """Largest angle to either side, rad, to which one pair of teeth is followed."""
    return float(library().MW_MAX_TURN)


def checked_angles(angles, most=None):
    """Angles (rad) as an array (N,); raises :class:`~meshwright.base.errors.UsageError` for what cannot be traced, or
    lies beyond ``most`` where that is given.
    """
    most = largest_angle() if most is None else most
    return _numbers("angles: must be a one-dimensional array of finite numbers", angles, most, " rad")


def checked_angle(angle):
    """One angle (rad), checked likewise."""
    return float(_numbers("angle: must be a finite number", [angle], largest_angle(), " rad")[0])


def checked_pitches(pitches, pitch):
    """Multiples of a pitch (rad) as an array (N,), checked likewise."""
    most = largest_angle() / pitch
    return _numbers("pitches: must be a one-dimensional array of finite numbers", pitches, most)


def _numbers(must_be, values, most, unit=""):
    try:
        values = np.atleast_1d(np.ascontiguousarray(values, dtype=float))
    except (TypeError, ValueError, OverflowError):
        values = np.array([np.nan])
    if values.ndim != 1 or not np.all(np.abs(values) <= most):
        raise UsageError(f"{must_be}; give none beyond {most:g}{unit}")
    return values


def checked_result(drive, result, angles=None):
    """A TCA of the drive, of as many points as ``angles`` if these are given; raises UsageError for anything else."""
    if not isinstance(result, TCA) or result.solutions.shape != (
        len(result.angles if angles is None else angles), drive.model.nx
    ):  # fmt: skip
        raise UsageError("result: no contact analysis of this drive at these angles; give what tca(angles) returns")
    return result


def trace(drive, angles):
    """Unknowns (N, nx) and ``mw_info`` records (N,) at ascending angles of the right-hand drive, rad."""
    m, n = drive.model, len(angles)
    x, records = np.full((n, m.nx), np.nan), np.zeros(n, record("mw_info"))
    s, work = np.empty(m.ns), np.empty(m.np)
    library().mw_trace(
        m, pointer(drive.design.parameters), pointer(angles), n, pointer(s), pointer(work), pointer(x),
        pointer(records, "mw_info[]"),
    )  # fmt: skip
    return x, records


def analyse(drive, angles):
    """:class:`~meshwright.contact.results.TCA` at pinion angles (rad), in any order.

    The points are traced in ascending order; relative errors refer to the design's reference angle.
    """
    mirror = drive.design.mirror
    grid, rows = mirror.sign * angles, slice(None)
    if not np.all(np.diff(grid) > 0.0):
        grid, rows = np.unique(grid, return_inverse=True)
    points = _Points.of(drive, grid)
    return points.result(angles, rows, mirror, _reference(drive, points))


def _reference(drive, points):
    """Transmission error to which those of the points are relative: that at the reference angle, of one of the points
    where it is among them, so that its own is zero to the last bit; else that at the solved angle nearest to it.
    Without any contact it is not looked for: that is the longest search there is.
    """
    angle = drive.design.reference_angle
    if not points.touching.any() or np.any(points.touching & (points.grid == angle)):
        return points.reference()
    x, found = trace(drive, np.array([angle], dtype=float))
    return float(x[0, points.description["error"]]) if found["status"][0] >= 0 else points.reference()


def at_solutions(drive, angles, unknowns):
    """:class:`~meshwright.contact.results.TCA` of contacts solved already, one row each: angles (N,), unknowns (N, nx).

    Angles and unknowns are those of the right-hand drive, whatever the design's hand.
    """
    mirror = drive.design.mirror
    points = _Points.solved(drive, angles, unknowns)
    return points.result(mirror.sign * angles, slice(None), mirror, points.reference())


@dataclass(frozen=True)
class _Points:
    """Analysed points of the right-hand drive; rows without contact are NaN."""

    drive: DriveModel
    grid: np.ndarray
    x: np.ndarray
    records: np.ndarray
    observed: np.ndarray
    contacts: np.ndarray

    @classmethod
    def _room(cls, drive, grid, x):
        n = len(grid)
        records, contacts = np.zeros(n, record("mw_info")), np.empty(n, record("mw_contact"))
        return cls(drive, grid, x, records, np.empty((n, drive.model.no)), contacts)

    def _out(self):
        """The arrays that C fills in, as it takes them."""
        records, contacts = pointer(self.records, "mw_info[]"), pointer(self.contacts, "mw_contact[]")
        return pointer(self.x), records, pointer(self.observed), contacts

    @classmethod
    def of(cls, drive, grid):
        """The points of the drive at ascending angles ``grid`` (N,)."""
        m, n = drive.model, len(grid)
        points = cls._room(drive, grid, np.full((n, m.nx), np.nan))
        parameters, s, work = drive.design.parameters, np.empty(m.ns), np.empty(m.np)
        library().mw_analyse(m, pointer(parameters), pointer(grid), n, pointer(s), pointer(work), *points._out())
        return points

    @classmethod
    def solved(cls, drive, grid, x):
        """The points of unknowns x (N, nx) at the angles ``grid`` (N,)."""
        grid, x = np.ascontiguousarray(grid, dtype=float), np.array(x, dtype=float, order="C")
        points = cls._room(drive, grid, x)
        library().mw_contacts(drive.model, pointer(drive.state()), pointer(grid), len(grid), *points._out())
        x[~points.touching] = np.nan
        return points

    @property
    def description(self):
        return self.drive.design.description

    @property
    def status(self):
        return self.records["status"]

    @cached_property
    def touching(self):
        """Rows with a transmission error: a contact point or a contact line."""
        return self.status >= 0

    @cached_property
    def pointlike(self):
        """Rows with a contact point."""
        return self.touching & (self.contacts["line"] == 0)

    @cached_property
    def error(self):
        return self.x[:, self.description["error"]]

    def reference(self):
        """Transmission error at the solved angle nearest to the reference angle; NaN if nothing is solved."""
        rows = np.flatnonzero(self.touching)
        distance = np.abs(self.grid[rows] - self.drive.design.reference_angle)
        return float(self.error[rows[np.argmin(distance)]]) if rows.size else np.nan

    def _only(self, values):
        """Columns with NaN where there is no contact point."""
        line = self.contacts["line"] != 0
        if not line.any():  # where there is no contact either, nothing is a number
            return values
        return np.where(line if values.ndim == 1 else line[:, None], np.nan, values)

    def unknowns(self, mirror):
        """Values and units of the unknowns and of what the reduce stage removed."""
        recovered = {name for body in self.description["bodies"] for name in body["recovered"]}
        columns = {u["name"]: (u, self.x[:, k]) for k, u in enumerate(self.description["unknowns"])}
        del columns[self.description["unknowns"][self.description["error"]]["name"]]
        for output in self.description["outputs"]:
            if output["name"] in recovered:
                columns[output["name"]] = output, self.observed[:, output["offset"]]
        values = {name: self._only(_times(mirror.factor(name), column)) for name, (_, column) in columns.items()}
        return values, {name: u["unit"] for name, (u, _) in columns.items()}

    @cached_property
    def bits(self):
        """The flags of each row, as numbers."""
        return np.where(self.pointlike, self.contacts["flags"], 0)

    def result(self, angles, rows, mirror, reference):
        """The rows asked for, as the drive of the design's hand has them; ``reference`` is the error they refer to."""

        def column(values, sign=1.0):
            return _times(sign, self._only(values)[rows])

        def vectors(values):
            return column(values, 1.0 if mirror.sign > 0.0 else mirror.flip)

        names, status, bits = flag_names(self.drive.model), self.status[rows], self.bits[rows]
        off_tip = sum(1 << k for k, name in enumerate(names) if name == OFF_TIP)
        unknowns, units = self.unknowns(mirror)
        curvatures = column(np.stack([self.contacts["curvature_min"], self.contacts["curvature_max"]], axis=1))
        with np.errstate(invalid="ignore", divide="ignore"):
            semi_axes = np.sqrt(2 * self.drive.design.value("separation_mm", "contact") / curvatures)
        bodies = self.description["bodies"]
        return TCA(
            angles=angles,
            status=_looked_up(status, lambda code: text(library().mw_status_word(code))),
            messages=_looked_up(status, lambda code: text(library().mw_status_text(code))),
            iterations=self.records["iterations"][rows],
            residual=np.maximum(self.contacts["distance"], self.contacts["misfit"])[rows],
            wheel_angles=_times(mirror.sign, self.observed[:, self.description["wheel_angle"]][rows]),
            error=_times(mirror.sign, self.error[rows]),
            reference_error=mirror.sign * reference,
            unknowns={name: values[rows] for name, values in unknowns.items()},
            units=units,
            points=vectors(self.contacts["point"]),
            normals=vectors(self.contacts["normal"]),
            body_points={b["name"]: vectors(self.observed[:, b["point"] : b["point"] + 3]) for b in bodies},
            curvatures=curvatures,
            major=vectors(self.contacts["major"]),
            lever_arms={b["name"]: column(self.contacts[f"lever_{b['name']}"]) for b in bodies},
            instantaneous_ratio=column(self.contacts["ratio"]),
            semi_axes=semi_axes,
            flags=_looked_up(bits, lambda b: tuple(dict.fromkeys(n for k, n in enumerate(names) if b >> k & 1))),
            margins={
                f"{b['name']}.{margin['event']}": self.observed[:, b["margin"] + i][rows]
                for b in bodies
                for i, margin in enumerate(b["margins"])
            },
            solutions=self.x[rows],
            outside_the_tips=~self.pointlike[rows] | ((bits & off_tip) != 0),
            lines=(None,) * len(angles),
        )


def _times(factor, values):
    """The product; the values themselves, not copied, if the factor is 1."""
    return values if isinstance(factor, float) and factor == 1.0 else factor * values


def _looked_up(codes, meaning):
    """``meaning(code)`` of each of N whole numbers, asked once for each that occurs: a tuple of N."""
    if not len(codes):
        return ()
    least, most = int(codes.min()), int(codes.max())
    if least == most:
        return (meaning(least),) * len(codes)
    places = codes.astype(np.intp) - least
    table = np.empty(most - least + 1, dtype=object)
    for place in np.flatnonzero(np.bincount(places)).tolist():
        table[place] = meaning(place + least)
    return tuple(table[places].tolist())


@cache
def statuses():
    """The word of each status by its number in meshwright.h."""
    codes = sorted(code for code in ffi.typeof("mw_status").elements if code != library().MW_STATUS_END)
    return {code: text(library().mw_status_word(code)) for code in codes}


def status_codes(*words):
    """Numbers of the statuses that results call by these words."""
    return [code for code, word in statuses().items() if word in words]


@cache
def status_text(word):
    """What a status word means, in a sentence."""
    return text(library().mw_status_text(status_codes(word)[0]))


def reasons():
    """Why a proof shows nothing, in a sentence, by the word for it."""
    words = takewhile(bool, (text(library().mw_reason_word(code)) for code in count(1)))
    return {word: text(library().mw_reason_text(code)) for code, word in enumerate(words, 1)}


def flag_names(m):
    """Names of a model's flags, from the lowest bit."""
    names = []
    while (name := library().mw_flag(m, len(names))) != ffi.NULL:
        names.append(text(name))
    return names
