"""A drive ready to be analysed: a design, the compiled model that solves it, and its results."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from meshwright import design as designs
from meshwright._library import ffi, library, model, text
from meshwright.design import Design
from meshwright.errors import UsageError
from meshwright.results import TCA
from meshwright.surface import Flank


def _pointer(array, kind="double[]"):
    return ffi.from_buffer(kind, array)


def _compiled(design):
    return model(design.description["name"])


def _casadi(design):
    from meshwright.casadi_backend import model_of

    return model_of(design.description)


BACKENDS = {"c": _compiled, "casadi": _casadi}


@dataclass(frozen=True)
class Drive:
    """A checked design and the backend that solves it. Angles in rad, lengths in mm."""

    design: Design
    backend: str = "c"

    @classmethod
    def load(cls, name_or_path, backend="c"):
        """The drive of a packaged design or a TOML file; raises :class:`~meshwright.errors.DesignError`."""
        return cls.from_tables(designs.read(name_or_path), backend)

    @classmethod
    def from_tables(cls, tables, backend="c"):
        """The drive of a design given as nested dictionaries, as in a TOML file."""
        if backend not in BACKENDS:
            raise UsageError(f"backend = {backend!r}: no such backend; use one of {', '.join(BACKENDS)}")
        return cls(designs.check(tables), backend)

    def with_(self, **tables):
        """A new drive with keys changed: ``drive.with_(misalignment={"center_distance_mm": -0.1})``."""
        changes = {}
        for table, entries in tables.items():
            if isinstance(entries, dict):
                changes |= {f"{table}.{key}": value for key, value in entries.items()}
            else:
                changes[table] = entries
        given = _without_gaps(self.design.tables)
        return Drive.from_tables(designs.changed(given, changes), self.backend)

    @cached_property
    def model(self):
        """The model table, as a cffi pointer."""
        return BACKENDS[self.backend](self.design)

    @property
    def ratio(self):
        """Transmission ratio, pinion teeth over wheel teeth."""
        return self.design.sizes["ratio"]

    def pitch(self):
        """Pinion angle from one tooth pair to the next, rad."""
        return 2 * math.pi / self.design.value(self.design.description["pinion_teeth"])

    def flank(self, member, region="flank"):
        """The generated flank of ``"pinion"`` or ``"wheel"``, or another region that the drive has of a member."""
        return Flank.of(self, member, region)

    def state(self, angle=0.0):
        """The model's state for this design at an input angle: what generated functions read."""
        s = np.empty(self.model.ns)
        self.model.setup(_pointer(self.design.parameters), _pointer(s))
        self.model.set_phi(_pointer(s), angle)
        return s

    def tca(self, angles):
        """Tooth contact analysis at pinion angles (rad), in any order; see :class:`~meshwright.results.TCA`.

        The points are traced in ascending order, from a solution at angle 0 where there is one.
        """
        angles = np.atleast_1d(np.asarray(angles, dtype=float))
        if angles.ndim != 1 or not np.all(np.isfinite(angles)):
            raise UsageError("angles must be a one-dimensional array of finite numbers")
        mirror = -1.0 if self.design.mirrored else 1.0
        grid, inverse = np.unique(np.append(mirror * angles, 0.0), return_inverse=True)
        x, records = self._trace(grid)
        rows = [self._observe(phi, x[k], records[k]) for k, phi in enumerate(grid)]
        reference = _reference(grid, rows, self.design.description["error"])
        return self._collect(angles, [rows[k] for k in inverse[:-1]], reference, mirror)

    def trace(self, angles):
        """Unknowns (N, nx) and status words of a bare trace, without contact geometry: the fast way."""
        x, records = self._trace(np.ascontiguousarray(angles, dtype=float))
        return x, [text(library().mw_status_word(r.status)) for r in records]

    def _trace(self, grid):
        m, n = self.model, len(grid)
        x = np.full((n, m.nx), np.nan)
        records = ffi.new("mw_info[]", n)
        s, work = np.empty(m.ns), np.empty(m.np)
        library().mw_trace(
            m, _pointer(self.design.parameters), _pointer(grid), n, _pointer(s), _pointer(work), _pointer(x), records
        )
        return x, records

    def _observe(self, phi, x, record):
        """One point: record, observation and contact geometry; None for the latter two if there is no contact."""
        lib = library()
        if record.status < 0:
            return _Row(record.status, record, x, None, None)
        s, o = self.state(phi), np.empty(self.model.no)
        contact = ffi.new("mw_contact *")
        ended = lib.mw_contact_at(self.model, _pointer(s), _pointer(np.ascontiguousarray(x)), _pointer(o), contact)
        return _Row(ended if contact.line else record.status, record, x, o, contact)

    def _collect(self, angles, rows, reference, mirror):
        description, m = self.design.description, self.model
        n = len(rows)
        flip = np.array([1.0, mirror, 1.0])
        points, normals, major = (np.full((n, 3), np.nan) for _ in range(3))
        curvatures, semi_axes = np.full((n, 2), np.nan), np.full((n, 2), np.nan)
        bodies = {b["name"]: np.full((n, 3), np.nan) for b in description["bodies"]}
        names = [u["name"] for k, u in enumerate(description["unknowns"]) if k != description["error"]]
        recovered = [o for o in description["outputs"] if o["name"] in _recovered(description)]
        unknowns = {name: np.full(n, np.nan) for name in [*names, *(o["name"] for o in recovered)]}
        signs = {u["name"]: mirror if _turns(u) else 1.0 for u in [*description["unknowns"], *recovered]}
        units = {u["name"]: u["unit"] for u in [*description["unknowns"], *recovered]}
        margins = {}
        wheel, error = np.full(n, np.nan), np.full(n, np.nan)
        separation = self.design.value("separation_mm", "contact")
        flags = []
        for k, row in enumerate(rows):
            flags.append(())
            if row.contact is None:
                continue
            error[k] = mirror * row.x[description["error"]]
            wheel[k] = mirror * row.o[description["wheel_angle"]]
            if row.contact.line:
                continue
            c = row.contact
            points[k], normals[k], major[k] = flip * list(c.point), flip * list(c.normal), flip * list(c.major)
            curvatures[k] = c.curvature_min, c.curvature_max
            with np.errstate(invalid="ignore"):
                semi_axes[k] = np.sqrt(2 * separation / curvatures[k])
            for body in description["bodies"]:
                bodies[body["name"]][k] = flip * row.o[body["point"] : body["point"] + 3]
            for i, u in enumerate(description["unknowns"]):
                if u["name"] in unknowns:
                    unknowns[u["name"]][k] = signs[u["name"]] * row.x[i]
            for o in recovered:
                unknowns[o["name"]][k] = signs[o["name"]] * row.o[o["offset"]]
            flags[k] = _flag_words(m, c.flags)
        for body in description["bodies"]:
            for i, margin in enumerate(body["margins"]):
                values = [np.nan if r.o is None else r.o[body["margin"] + i] for r in rows]
                margins[f"{body['name']}.{margin['event']}"] = np.array(values)
        return TCA(
            angles=angles,
            status=tuple(text(library().mw_status_word(r.status)) for r in rows),
            messages=tuple(text(library().mw_status_text(r.status)) for r in rows),
            iterations=np.array([r.record.iterations for r in rows]),
            residual=np.array([max(r.contact.distance, r.contact.misfit) if r.contact else np.nan for r in rows]),
            wheel_angles=wheel,
            error=error,
            reference_error=mirror * reference,
            unknowns=unknowns,
            units=units,
            points=points,
            normals=normals,
            body_points=bodies,
            curvatures=curvatures,
            major=major,
            semi_axes=semi_axes,
            flags=tuple(flags),
            margins=margins,
            solutions=np.array([row.x for row in rows]).reshape(n, m.nx),
        )


@dataclass(frozen=True)
class _Row:
    status: int
    record: object
    x: np.ndarray
    o: np.ndarray | None
    contact: object | None


def _recovered(description):
    return {name for body in description["bodies"] for name in body["recovered"]}


def _turns(entry):
    """Whether a number is an angle of rotation about a z-type axis, which a mirror image negates."""
    return entry["name"].startswith(("psi_", "phi_", "transmission_error"))


def _flag_words(m, bits):
    lib, words, bit = library(), [], 0
    while (name := lib.mw_flag(m, bit)) != ffi.NULL:
        if bits >> bit & 1:
            words.append(text(name))
        bit += 1
    return tuple(dict.fromkeys(words))


def _reference(grid, rows, error):
    """Transmission error (unknown number ``error``) at the solved angle nearest to 0; NaN if nothing is solved."""
    solved = [(abs(phi), row.x[error]) for phi, row in zip(grid, rows, strict=True) if row.contact is not None]
    return float(min(solved)[1]) if solved else math.nan


def _without_gaps(tables):
    """Checked tables without the keys that were left open."""
    return {
        name: {k: v for k, v in entry.items() if v is not None} if isinstance(entry, dict) else entry
        for name, entry in tables.items()
    }
