"""Tooth contact analysis of one drive: trace in C, contact geometry of every point, results as columns."""

from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import ffi, library, pointer, text
from meshwright.contact.results import TCA

#: Largest input angle to either side, rad: MW_MAX_ANGLE of meshwright.h.
LARGEST_ANGLE = 10_000.0

#: ``mw_info`` and ``mw_contact`` of meshwright.h as NumPy records.
_INFO = np.dtype(
    [("status", "i4"), ("iterations", "i4"), ("guard", "i4"), ("step", "f8"), ("residual", "f8"), ("rank_gap", "f8")],
    align=True,
)
_CONTACT = np.dtype(
    [
        ("point", "f8", 3), ("normal", "f8", 3), ("curvature_min", "f8"), ("curvature_max", "f8"), ("major", "f8", 3),
        ("distance", "f8"), ("misfit", "f8"), ("line", "i4"), ("flags", "u4"),
        ("lever_pinion", "f8"), ("lever_wheel", "f8"), ("ratio", "f8"),
    ],
    align=True,
)  # fmt: skip


def checked_angles(angles):
    """Angles (rad) as an array (N,); raises :class:`~meshwright.base.errors.UsageError` for what cannot be traced."""
    angles = np.atleast_1d(np.ascontiguousarray(angles, dtype=float))
    if angles.ndim != 1 or not np.all(np.abs(angles) <= LARGEST_ANGLE):
        raise UsageError(
            f"angles: must be a one-dimensional array of finite numbers; give none beyond {LARGEST_ANGLE:g} rad"
        )
    return angles


def trace(drive, angles):
    """Unknowns (N, nx) and ``mw_info`` records (N,) at ascending angles of the right-hand drive, rad."""
    m, n = drive.model, len(angles)
    x, records = np.full((n, m.nx), np.nan), np.zeros(n, _INFO)
    s, work = np.empty(m.ns), np.empty(m.np)
    library().mw_trace(
        m, pointer(drive.design.parameters), pointer(angles), n, pointer(s), pointer(work), pointer(x),
        ffi.from_buffer("mw_info[]", records),
    )  # fmt: skip
    return x, records


def analyse(drive, angles):
    """:class:`~meshwright.contact.results.TCA` at pinion angles (rad), in any order.

    The points are traced in ascending order together with the design's reference angle, to which relative errors
    refer.
    """
    mirror = drive.design.mirror
    grid, inverse = np.unique(np.append(mirror.sign * angles, drive.design.reference_angle), return_inverse=True)
    points = _Points.of(drive, grid)
    return points.result(angles, inverse[:-1], mirror)


def without_contact(drive, angles):
    """:class:`~meshwright.contact.results.TCA` of teeth that do not reach each other, at pinion angles (rad)."""
    mirror = drive.design.mirror
    records = np.zeros(len(angles), _INFO)
    records["status"] = status_codes("no_contact")[0]
    points = _Points.solved(drive, mirror.sign * angles, np.full((len(angles), drive.model.nx), np.nan), records)
    return points.result(angles, np.arange(len(angles)), mirror)


def at_solutions(drive, angles, unknowns):
    """:class:`~meshwright.contact.results.TCA` of contacts solved already, one row each: angles (N,), unknowns (N, nx).

    Angles and unknowns are those of the right-hand drive, whatever the design's hand.
    """
    mirror = drive.design.mirror
    points = _Points.solved(drive, angles, unknowns, np.zeros(len(angles), _INFO))
    return points.result(mirror.sign * angles, np.arange(len(angles)), mirror)


@dataclass(frozen=True)
class _Points:
    """Solved points of the right-hand drive in ascending order; rows without contact are NaN."""

    drive: object
    grid: np.ndarray
    x: np.ndarray
    records: np.ndarray
    status: np.ndarray
    observed: np.ndarray
    contacts: np.ndarray

    @classmethod
    def of(cls, drive, grid):
        return cls.solved(drive, grid, *trace(drive, grid))

    @classmethod
    def solved(cls, drive, grid, x, records):
        """The points of unknowns x (N, nx) and records (N,) at the angles ``grid`` (N,)."""
        m = drive.model
        status = records["status"].copy()
        observed = np.full((len(grid), m.no), np.nan)
        contacts = np.zeros(len(grid), _CONTACT)
        points = cls(drive, grid, x, records, status, observed, contacts)
        s = drive.state()
        for k in np.flatnonzero(status >= 0):
            m.set_phi(pointer(s), grid[k])
            points._look(k, s)
        return points

    def _look(self, k, s):
        """Contact geometry of row k; s is set up for its angle."""
        place = ffi.from_buffer("mw_contact[]", self.contacts[k : k + 1])
        solution, observed = pointer(self.x[k]), pointer(self.observed[k])
        ended = library().mw_contact_at(self.drive.model, pointer(s), solution, observed, place)
        self.status[k] = ended if self.contacts["line"][k] else self.records["status"][k]

    @property
    def description(self):
        return self.drive.design.description

    @property
    def touching(self):
        """Rows with a transmission error: a contact point or a contact line."""
        return self.status >= 0

    @property
    def pointlike(self):
        """Rows with a contact point."""
        return self.touching & (self.contacts["line"] == 0)

    @cached_property
    def error(self):
        return np.where(self.touching, self.x[:, self.description["error"]], np.nan)

    def reference(self):
        """Transmission error at the solved angle nearest to the reference angle; NaN if nothing is solved."""
        rows = np.flatnonzero(self.touching)
        distance = np.abs(self.grid[rows] - self.drive.design.reference_angle)
        return float(self.error[rows[np.argmin(distance)]]) if rows.size else np.nan

    def _only(self, values):
        """Columns with NaN where there is no contact point."""
        keep = self.pointlike if values.ndim == 1 else self.pointlike[:, None]
        return np.where(keep, values, np.nan)

    def unknowns(self, mirror):
        """Values and units of the unknowns and of what the reduce stage removed."""
        recovered = {name for body in self.description["bodies"] for name in body["recovered"]}
        columns = {u["name"]: (u, self.x[:, k]) for k, u in enumerate(self.description["unknowns"])}
        del columns[self.description["unknowns"][self.description["error"]]["name"]]
        for output in self.description["outputs"]:
            if output["name"] in recovered:
                columns[output["name"]] = output, self.observed[:, output["offset"]]
        values = mirror.numbers({name: self._only(column) for name, (_, column) in columns.items()})
        return values, {name: u["unit"] for name, (u, _) in columns.items()}

    def flags(self):
        names = flag_names(self.drive.model)
        bits = np.where(self.pointlike, self.contacts["flags"], 0)
        return [tuple(dict.fromkeys(n for k, n in enumerate(names) if b >> k & 1)) for b in bits.tolist()]

    def result(self, angles, rows, mirror):
        """The rows asked for, as the drive of the design's hand has them."""
        flip = mirror.flip
        unknowns, units = self.unknowns(mirror)
        curvatures = self._only(np.stack([self.contacts["curvature_min"], self.contacts["curvature_max"]], axis=1))
        with np.errstate(invalid="ignore", divide="ignore"):
            semi_axes = np.sqrt(2 * self.drive.design.value("separation_mm", "contact") / curvatures)
        gap = np.maximum(self.contacts["distance"], self.contacts["misfit"])
        words, flags = [text(library().mw_status_word(c)) for c in self.status], self.flags()
        bodies = self.description["bodies"]
        return TCA(
            angles=angles,
            status=tuple(words[k] for k in rows),
            messages=tuple(text(library().mw_status_text(self.status[k])) for k in rows),
            iterations=self.records["iterations"][rows],
            residual=np.where(self.touching, gap, np.nan)[rows],
            wheel_angles=mirror.sign
            * np.where(self.touching, self.observed[:, self.description["wheel_angle"]], np.nan)[rows],
            error=mirror.sign * self.error[rows],
            reference_error=mirror.sign * self.reference(),
            unknowns={name: values[rows] for name, values in unknowns.items()},
            units=units,
            points=flip * self._only(self.contacts["point"])[rows],
            normals=flip * self._only(self.contacts["normal"])[rows],
            body_points={
                b["name"]: flip * self._only(self.observed[:, b["point"] : b["point"] + 3])[rows] for b in bodies
            },
            curvatures=curvatures[rows],
            major=flip * self._only(self.contacts["major"])[rows],
            lever_arms={b["name"]: self._only(self.contacts[f"lever_{b['name']}"])[rows] for b in bodies},
            instantaneous_ratio=self._only(self.contacts["ratio"])[rows],
            semi_axes=semi_axes[rows],
            flags=tuple(flags[k] for k in rows),
            margins={
                f"{b['name']}.{margin['event']}": self.observed[rows, b["margin"] + i]
                for b in bodies
                for i, margin in enumerate(b["margins"])
            },
            solutions=self.x[rows],
        )


@cache
def statuses():
    """The word of each status by its number in meshwright.h."""
    words = {code: text(library().mw_status_word(code)) for code in range(-99, 100)}
    return {code: word for code, word in words.items() if word != "unknown"}


def status_codes(*words):
    """Numbers of the statuses that results call by these words."""
    return [code for code, word in statuses().items() if word in words]


def status_text(word):
    """What a status word means, in a sentence."""
    return text(library().mw_status_text(status_codes(word)[0]))


def flag_names(m):
    """Names of a model's flags, from the lowest bit."""
    names = []
    while (name := library().mw_flag(m, len(names))) != ffi.NULL:
        names.append(text(name))
    return names
