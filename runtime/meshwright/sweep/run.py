"""Sweeps: one design under many misalignments and parameter values, traced in lanes.

A sweep is cut into slices that depend on nothing but the plan: the same plan gives the same rows however many threads
or machines work on it and however often it is interrupted. Each slice is one file, replaced atomically and sealed
(:mod:`meshwright.sweep.slices`); a slice that is sealed is done. One process at a time works in a folder.
"""

import hashlib
import json
import os
from collections import Counter
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import numpy as np

from meshwright.base.errors import DesignError, UsageError
from meshwright.base.files import locked, remove_parts, write_bytes
from meshwright.contact import analysis
from meshwright.contact.results import ARCSEC, SOLVED, TOUCHING
from meshwright.design import design as designs
from meshwright.drive import Drive
from meshwright.sweep import device as devices
from meshwright.sweep import samples, slices

#: Points of a slice: enough to keep a core busy, few enough that memory stays small.
SLICE_POINTS = 200_000

#: Larger sweeps are taken for a mistake.
MOST_POINTS = 10_000_000_000

#: Slices handed to a cluster beforehand.
AHEAD = 1000

#: So many samples that are not complete are listed.
FIRST = 20

#: The file that says which sweep a folder holds.
MARK = "sweep.json"

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

    def levels(self, places, count):
        """Values at ``places`` of so many, equally spaced: over the whole range, or three deviations to either side."""
        share = places / max(count - 1, 1)
        if self.kind == "uniform":
            return np.where(share == 1.0, self.second, self.first + share * (self.second - self.first))
        return self.first + (6.0 * share - 3.0) * self.second


@dataclass(frozen=True)
class Plan:
    """A sweep: raw design tables, variations, pinion angles (rad), number of samples or grid levels, seed.

    ``portable`` rows have the same bits on every machine; otherwise they differ by round-off between those whose
    processor fuses products into sums and those whose does not. ``places`` are the folders in which the drive is
    searched, by default :func:`meshwright.base.drives.folders`.
    """

    tables: dict
    variations: tuple[Variation, ...]
    angles: tuple[float, ...]
    samples: int
    levels: int = 0
    seed: int = 0
    portable: bool = False
    places: tuple[Path, ...] | None = None

    @property
    def drive(self):
        """The nominal drive."""
        return Drive(designs.check(self.tables, self.places))

    @property
    def identity(self):
        """Hash of everything that decides a row: what is asked, and the compiled drive that answers."""
        description = self.drive.design.description
        how = [self.angles, self.samples, self.levels, self.seed, self.portable]
        who = [description["name"], description["specification_hash"], description["generator"]]
        data = [self.tables, [vars(v) for v in self.variations], *how, *who]
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

    def _samples_of(self, number):
        return min(self.slice_samples, self.count - number * self.slice_samples)

    def slice_rows(self, number):
        """Number of rows of a slice: its samples at every angle."""
        return self._samples_of(number) * len(self.angles)

    def values(self, number):
        """Values of the varied keys in a slice, (samples, keys), in the keys' units."""
        first, count = number * self.slice_samples, self._samples_of(number)
        if self.levels:
            places = np.unravel_index(np.arange(first, first + count), [self.levels] * len(self.variations))
            columns = [v.levels(place, self.levels) for v, place in zip(self.variations, places, strict=True)]
            return np.stack(columns, axis=1)
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
    if plan.seed < 0:
        raise UsageError(f"seed = {plan.seed}: must not be negative; give a whole number from 0 on")
    if plan.count * len(plan.angles) > MOST_POINTS:
        points = plan.count * len(plan.angles)
        raise UsageError(f"{points} points: {MOST_POINTS} at most; sweep fewer samples or levels")
    drive = plan.drive
    for k, v in enumerate(plan.variations):
        samples.column(drive, v.key)
        if v.key in {other.key for other in plan.variations[:k]}:
            raise DesignError(v.key, None, "varied twice", "give one range for each key")
        if v.kind == "normal" and v.second < 0:
            raise DesignError(v.key, v.second, "the deviation is negative", "give normal:mean:deviation")
        if v.kind == "uniform" and v.second < v.first:
            raise DesignError(v.key, f"{v.first:g}:{v.second:g}", "the larger end stands first", "give low:high")
        if not np.isfinite(v.second - v.first):
            raise DesignError(v.key, v.second, "the range is too wide for the machine", "narrow the range")
    return drive


def solve(plan, number, device=None):
    """:class:`Rows` of one slice; ``device`` as of :func:`run`."""
    drive, values = check(plan), plan.values(number)
    traced = devices.on_cuda if device == "cuda" else None
    found = samples.solve(drive, [v.key for v in plan.variations], values, plan.angles, plan.portable, traced)
    sample = number * plan.slice_samples + np.arange(len(values))
    return Rows(sample, values, found.status, found.error, found.points, found.flags)


def write_slice(plan, identity, folder, number, form, device=None):
    """Solve a slice and write it, unless it is done."""
    path = _slice(folder, number, form)
    if not slices.done(path, identity, number):
        slices.write(_columns(plan, solve(plan, number, device)), path, form, identity, number)


def _slice(folder, number, form):
    return Path(folder) / f"slice-{number:06d}.{form}"


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


def run(plan, folder, form="parquet", threads=None, scheduler=None, advance=lambda: None, device=None):
    """Write every slice that is not yet there; ``advance`` is called after each. Returns :func:`summary`.

    ``scheduler`` is None for threads of this process, "local" for an embedded Dask cluster, or the address of one.
    ``device`` is "cuda" for a GPU of each process that works on slices, of a plan that is ``portable``.
    Raises :class:`~meshwright.base.errors.UsageError` if the folder holds another sweep.
    """
    drive = check(plan)
    slices.require(form)
    devices.require(device)
    folder = Path(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"{folder}: cannot be made ({error.strerror}); name another folder") from error
    identity = plan.identity
    with locked(folder, "sweep"):
        _claim(plan, identity, drive, folder, form)
        remove_parts(folder)
        try:
            if scheduler is None:
                _on_threads(plan, identity, folder, form, threads or os.cpu_count(), advance, device)
            else:
                _on_dask(plan, identity, folder.resolve(), form, threads, scheduler, advance, device)
        except OSError as error:
            done = "what is written stays, and the same command goes on from there"
            raise UsageError(f"{folder}: cannot be written ({error.strerror or error}); make room: {done}") from error
        return summary(plan, folder, form)


def _on_threads(plan, identity, folder, form, threads, advance, device):
    numbers = iter(range(plan.slices))
    with ThreadPoolExecutor(threads) as pool:
        running, free = set(), 2 * threads
        while True:
            more = islice(numbers, free)
            running |= {pool.submit(write_slice, plan, identity, folder, k, form, device) for k in more}
            if not running:
                return
            done, running = wait(running, return_when=FIRST_COMPLETED)
            free = len(done)
            for finished in done:
                finished.result()
                advance()


def _on_dask(plan, identity, folder, form, threads, scheduler, advance, device):
    try:
        from distributed import Client, as_completed
    except ImportError as error:
        raise UsageError("--scheduler needs Dask: pip install 'meshwright[sweep]'") from error
    local = {"n_workers": threads or os.cpu_count(), "threads_per_worker": 1, "dashboard_address": None}
    with Client(**local) if scheduler == "local" else Client(scheduler) as client:
        task = (plan, identity, folder)
        work = (client.submit(write_slice, *task, k, form, device, pure=False) for k in range(plan.slices))
        running = as_completed(islice(work, AHEAD))
        for finished in running:
            finished.result()
            advance()
            running.update(islice(work, 1))


def _claim(plan, identity, drive, folder, form):
    """Mark the folder as this sweep's, with the meaning of the numbers in its columns: flags from the lowest bit."""
    mark = folder / MARK
    claim = {
        "schema": "meshwright.sweep/1",
        "identity": identity,
        "format": form,
        "slices": plan.slices,
        "statuses": {str(code): word for code, word in analysis.statuses().items()},
        "flags": samples.flag_names(drive),
    }
    if mark.exists():
        if _read_claim(mark) != claim:
            raise UsageError(f"{folder}: holds another sweep, or of another version; name another folder, or remove it")
        return
    if any(not path.name.startswith(".") for path in folder.iterdir()):
        raise UsageError(f"{folder}: is not empty and holds no sweep; name another folder")
    write_bytes(mark, json.dumps(claim).encode())


def _read_claim(mark):
    try:
        return json.loads(mark.read_text(encoding="utf-8"))
    except ValueError as error:
        raise UsageError(f"{mark}: is damaged; remove its folder, or name another") from error


def summary(plan, folder, form="parquet"):
    """Quantiles over the samples: peak-to-peak transmission error and, of those without a line of contact, mean contact
    position; counts of points.

    Points that bodies cannot make are counted apart; a sample with one of them, or without a contact, is not complete.
    Of those that are not, the first are listed by number.
    """
    names = ["status", "flags", "transmission_error_arcsec", *(f"contact_{axis}_mm" for axis in "xyz")]
    identity = plan.identity
    n, bad = len(plan.angles), samples.impossible_bits(check(plan))
    peaks, places, wholes, words, impossible = [], [], [], Counter(), 0
    for number in range(plan.slices):
        path, rows = _slice(folder, number, form), plan.slice_rows(number)
        status, flags, error, *xyz = slices.read(path, names, identity, number, rows)
        solved = np.isin(status, analysis.status_codes(*TOUCHING))
        good = solved & ((flags.astype(np.uint32) & bad) == 0)
        words.update(dict(zip(*(a.tolist() for a in np.unique(status, return_counts=True)), strict=True)))
        impossible += int((solved & ~good).sum())
        whole = good.reshape(-1, n).all(axis=1)
        peaks.append(np.ptp(error.reshape(-1, n)[whole], axis=1))
        wholes.append(whole)
        means = np.stack([c.reshape(-1, n)[whole].mean(axis=1) for c in xyz], axis=1)
        places.append(means[np.isfinite(means).all(axis=1)])
    peaks, places, whole = np.concatenate(peaks), np.concatenate(places), np.concatenate(wholes)
    statuses, by_word = analysis.statuses(), Counter()
    for code, count in words.items():
        by_word[statuses[code]] += count
    return {
        "samples": plan.count,
        "samples_complete": len(peaks),
        "first_incomplete_samples": np.flatnonzero(~whole)[:FIRST].tolist(),
        "points": words.total(),
        "points_converged": sum(by_word[word] for word in SOLVED) - impossible,
        "points_touching": sum(by_word[word] for word in TOUCHING) - impossible,
        "points_impossible": impossible,
        "points_by_status": dict(by_word),
        "quantiles": list(QUANTILES),
        "peak_to_peak_arcsec": _quantiles(peaks),
        "contact_position_mm": {axis: _quantiles(places[:, k]) for k, axis in enumerate("xyz")},
    }


def _quantiles(values):
    return [float(q) for q in np.quantile(values, QUANTILES)] if len(values) else None
