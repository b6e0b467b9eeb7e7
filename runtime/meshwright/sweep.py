"""Sweeps: one design under many misalignments and parameter values, traced in lanes.

A sweep is cut into slices that depend on nothing but the plan: the same plan gives the same rows however many threads
or machines work on it and however often it is interrupted. Each slice is one file, replaced atomically; a slice whose
file exists is done.
"""

import hashlib
import json
import os
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshwright import design as designs
from meshwright._library import ffi, library
from meshwright.drive import Drive
from meshwright.errors import DesignError, UsageError
from meshwright.files import write_bytes
from meshwright.results import ARCSEC

#: Points of a slice: enough to keep a core busy, few enough that memory stays small.
SLICE_POINTS = 200_000

#: Width of the lanes that give the same bits on every machine.
PORTABLE_WIDTH = 2

QUANTILES = (0.0, 0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99, 1.0)


@dataclass(frozen=True)
class Variation:
    """What happens to one key ("table.key"), in its unit: ``uniform`` low, high or ``normal`` mean, deviation."""

    key: str
    kind: str
    first: float
    second: float

    def draw(self, generator, count):
        if self.kind == "uniform":
            return generator.uniform(self.first, self.second, count)
        return generator.normal(self.first, self.second, count)

    def levels(self, count):
        """Equally spaced values: the whole range, or three deviations to either side."""
        if self.kind == "uniform":
            return np.linspace(self.first, self.second, count)
        return self.first + np.linspace(-3.0, 3.0, count) * self.second


@dataclass(frozen=True)
class Plan:
    """A sweep: raw design tables, variations, pinion angles (rad), number of samples or grid levels, seed.

    ``portable`` rows have the same bits on every machine; otherwise they differ by round-off between those whose
    processor fuses products into sums and those whose does not.
    """

    tables: dict
    variations: tuple[Variation, ...]
    angles: tuple[float, ...]
    samples: int
    levels: int = 0
    seed: int = 0
    portable: bool = False

    @property
    def identity(self):
        """Hash of everything that decides a row."""
        how = [self.angles, self.samples, self.levels, self.seed, self.portable]
        data = [self.tables, [vars(v) for v in self.variations], *how]
        return hashlib.sha256(json.dumps(data, sort_keys=True, default=str).encode()).hexdigest()

    @property
    def count(self):
        """Number of samples: of the grid if there is one."""
        return self.levels ** len(self.variations) if self.levels else self.samples

    @property
    def slice_samples(self):
        return max(1, SLICE_POINTS // len(self.angles))

    @property
    def slices(self):
        return -(-self.count // self.slice_samples)

    def values(self, number):
        """Values of the varied keys in a slice, (samples, keys), in the keys' units."""
        first = number * self.slice_samples
        count = min(self.slice_samples, self.count - first)
        if self.levels:
            axes = [v.levels(self.levels) for v in self.variations]
            places = np.unravel_index(np.arange(first, first + count), [self.levels] * len(axes))
            return np.stack([axis[place] for axis, place in zip(axes, places, strict=True)], axis=1)
        generator = np.random.default_rng([self.seed, number])
        return np.stack([v.draw(generator, count) for v in self.variations], axis=1)


@dataclass(frozen=True)
class Rows:
    """A solved slice: ``sample`` (S,), ``values`` (S, K), ``status``, ``error``, ``flags`` (S, N), ``points``."""

    sample: np.ndarray
    values: np.ndarray
    status: np.ndarray
    error: np.ndarray
    points: np.ndarray
    flags: np.ndarray


def check(plan):
    """The nominal drive of a plan; raises an error that names the key if the plan cannot be swept."""
    drive = Drive.from_tables(plan.tables)
    for k, v in enumerate(plan.variations):
        _column(drive, v.key)
        if v.key in {other.key for other in plan.variations[:k]}:
            raise DesignError(v.key, None, "varied twice", "give one range for each key")
        if v.kind == "normal" and v.second < 0 or v.kind == "uniform" and v.second < v.first:
            raise DesignError(v.key, v.second, "the spread is negative", "give low:high or normal:mean:deviation")
    keys = [v.key for v in plan.variations]
    if twice := [key for key in keys if keys.count(key) > 1]:
        raise DesignError(twice[0], None, "varied twice", "vary each key once")
    return drive


def _column(drive, key):
    """Index and entry of the parameter that a key ("table.key") of the design file sets."""
    table, _, name = key.partition(".")
    description = drive.design.description
    if table == "design" and name in description["excluded"]:
        raise DesignError(key, None, f"a {description['title']} has no such size", "vary another key")
    if table == "design" and designs.has_rival(drive.design, name):
        raise DesignError(key, None, "another key of the design determines it", "vary that key instead")
    for k, p in enumerate(description["parameters"]):
        if (p["table"], p["key"]) == (table, name) and designs.is_real(p):
            return k, p
    raise DesignError(key, None, "no real parameter of this drive", "`meshwright drives` lists the keys as table.key")


def solve(plan, number):
    """:class:`Rows` of one slice."""
    drive, values = check(plan), plan.values(number)
    m, count, n = drive.model, len(values), len(plan.angles)
    parameters = _parameters(plan, drive, values)
    mirror = -1.0 if drive.design.mirrored else 1.0
    angles = mirror * np.array(plan.angles)
    start = np.ascontiguousarray(drive.trace(angles[:1])[0])
    lib = library()
    lanes = lib.mw_lanes(PORTABLE_WIDTH if plan.portable else 0)
    x, work = np.empty((count, n, m.nx)), np.empty(lib.mw_lanes_work(lanes, m, n))
    status, flags = np.empty((count, n), dtype=np.int32), np.empty((count, n), dtype=np.uint32)
    lib.mw_trace_designs(
        lanes, m, _p(parameters), count, _p(angles), n, _p(start), _p(work), _p(x), _p(status, "int[]")
    )
    points, s, o = np.empty((count, n, 3)), np.empty(m.ns), np.empty(m.no)
    lib.mw_contact_points(
        m, _p(parameters), count, _p(angles), n, _p(x), _p(status, "int[]"), _p(s), _p(o), _p(points),
        _p(flags, "unsigned int[]"),
    )  # fmt: skip
    error = np.where(status >= 0, mirror * x[..., drive.design.description["error"]], np.nan)
    sample = number * plan.slice_samples + np.arange(count)
    return Rows(sample, values, status, error, points * [1.0, mirror, 1.0], flags)


def _p(array, kind="double[]"):
    return ffi.from_buffer(kind, array)


def _parameters(plan, drive, values):
    """Complete parameter vectors, NaN where there is no such design; its points are then bad input.

    Rules and design systems are applied anew where more than misalignments vary: nothing follows from those.
    """
    columns = [_column(drive, v.key) for v in plan.variations]
    follows = any(p["table"] != "misalignment" for _, p in columns)
    rows = np.tile(designs.given_vector(drive.design) if follows else drive.design.parameters, (len(values), 1))
    possible = np.ones(len(rows), dtype=bool)
    for (k, p), column in zip(columns, values.T, strict=True):
        rows[:, k] = column * p["factor"]
        possible &= (rows[:, k] > _end(p["lower"], -np.inf)) & (rows[:, k] < _end(p["upper"], np.inf))
    if follows:
        work, info = np.empty(drive.model.np + 1), ffi.new("mw_info *")
        for k in np.flatnonzero(possible):
            possible[k] = library().mw_complete(drive.model, _p(rows[k]), _p(work), info) == 0
    rows[~possible] = np.nan
    return rows


def _end(bound, without):
    return without if bound is None else bound


def write_slice(plan, folder, number, form):
    """Solve a slice and write it, unless its file exists."""
    path = Path(folder) / f"slice-{number:06d}.{form}"
    if path.exists():
        return
    rows = solve(plan, number)
    columns = _columns(plan, rows)
    handle, temporary = tempfile.mkstemp(dir=folder, prefix=f".{path.name}.")
    os.close(handle)
    try:
        _WRITERS[form](columns, temporary)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def _columns(plan, rows):
    count, n = rows.error.shape
    columns = {"sample": np.repeat(rows.sample, n)}
    columns |= {v.key: np.repeat(rows.values[:, k], n) for k, v in enumerate(plan.variations)}
    columns["pinion_angle_deg"] = np.tile(np.degrees(plan.angles), count)
    columns["status"] = rows.status.ravel().astype(np.int16)
    columns["flags"] = rows.flags.ravel()
    columns["transmission_error_arcsec"] = rows.error.ravel() / ARCSEC
    columns |= {f"contact_{axis}_mm": rows.points[..., k].ravel() for k, axis in enumerate("xyz")}
    return columns


def _write_parquet(columns, path):
    import pyarrow
    from pyarrow import parquet

    parquet.write_table(pyarrow.table(columns), path, compression="zstd", compression_level=1, use_dictionary=False)


def _write_csv(columns, path):
    import pyarrow
    from pyarrow import csv

    csv.write_csv(pyarrow.table(columns), path)


_WRITERS = {"parquet": _write_parquet, "csv": _write_csv}


def read_slice(path, names):
    """Columns of a written slice."""
    if path.suffix == ".parquet":
        from pyarrow import parquet

        table = parquet.read_table(path, columns=names)
    else:
        from pyarrow import csv

        table = csv.read_csv(path, convert_options=csv.ConvertOptions(include_columns=names))
    return [table.column(name).to_numpy() for name in names]


def run(plan, folder, form="parquet", threads=None, scheduler=None, advance=lambda: None):
    """Write every slice that is not yet there; ``advance`` is called after each. Returns :func:`summary`.

    ``scheduler`` is None for threads of this process, "local" for an embedded Dask cluster, or the address of one.
    Raises :class:`~meshwright.errors.UsageError` if the folder holds another sweep.
    """
    check(plan)
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    _claim(plan, folder, form)
    if scheduler is None:
        with ThreadPoolExecutor(threads or os.cpu_count()) as pool:
            for _ in pool.map(lambda k: write_slice(plan, folder, k, form), range(plan.slices)):
                advance()
    else:
        _on_dask(plan, folder.resolve(), form, threads, scheduler, advance)
    for part in folder.glob(".slice-*"):
        part.unlink(missing_ok=True)  # what a killed process left; every slice is there
    return summary(plan, folder, form)


def _on_dask(plan, folder, form, threads, scheduler, advance):
    try:
        from distributed import Client, as_completed
    except ImportError as error:
        raise UsageError("--scheduler needs Dask: pip install 'meshwright[sweep]'") from error
    local = {"n_workers": threads or os.cpu_count(), "threads_per_worker": 1, "dashboard_address": None}
    with Client(**local) if scheduler == "local" else Client(scheduler) as client:
        work = [client.submit(write_slice, plan, folder, k, form, pure=False) for k in range(plan.slices)]
        for finished in as_completed(work):
            finished.result()
            advance()


def _claim(plan, folder, form):
    """Mark the folder as this sweep's."""
    mark = folder / "sweep.json"
    claim = {"schema": "meshwright.sweep/1", "identity": plan.identity, "format": form, "slices": plan.slices}
    if mark.exists():
        if json.loads(mark.read_text(encoding="utf-8")) != claim:
            raise UsageError(f"{folder}: holds another sweep; name another folder, or remove it")
        return
    if any(not path.name.startswith(".") for path in folder.iterdir()):
        raise UsageError(f"{folder}: is not empty and holds no sweep; name another folder")
    write_bytes(mark, json.dumps(claim).encode())


def summary(plan, folder, form="parquet"):
    """Quantiles over the samples: peak-to-peak transmission error and mean contact position; counts of points."""
    names = ["status", "transmission_error_arcsec", *(f"contact_{axis}_mm" for axis in "xyz")]
    n = len(plan.angles)
    peaks, places, solved, points = [], [], 0, 0
    for number in range(plan.slices):
        status, error, *xyz = read_slice(Path(folder) / f"slice-{number:06d}.{form}", names)
        good = (status == 0) | (status == 1)
        solved, points = solved + int(good.sum()), points + len(good)
        whole = good.reshape(-1, n).all(axis=1)
        peaks.append(np.ptp(error.reshape(-1, n)[whole], axis=1))
        places.append(np.stack([c.reshape(-1, n)[whole].mean(axis=1) for c in xyz], axis=1))
    peaks, places = np.concatenate(peaks), np.concatenate(places)
    return {
        "samples": plan.count,
        "samples_complete": len(peaks),
        "points": points,
        "points_converged": solved,
        "quantiles": list(QUANTILES),
        "peak_to_peak_arcsec": _quantiles(peaks),
        "contact_position_mm": {axis: _quantiles(places[:, k]) for k, axis in enumerate("xyz")},
    }


def _quantiles(values):
    return [float(q) for q in np.quantile(values, QUANTILES)] if len(values) else None
