"""Slices of a sweep as files of columns, Parquet or CSV, each beside its seal.

The seal, ``<slice>.seal``, is written after the slice and says whose rows it holds, how many, and the digest of its
bytes. A slice without a seal is not done; one that does not agree with its seal is refused.
"""

import csv
import hashlib
import json
from dataclasses import asdict, dataclass

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.files import replaced, write_bytes


@dataclass(frozen=True)
class Seal:
    """Slice ``number`` of the sweep ``identity``: its rows, and the size and SHA-256 of its file."""

    identity: str
    number: int
    rows: int
    bytes: int
    sha256: str


def require(form):
    """Raise :class:`~meshwright.base.errors.UsageError` if what reads and writes a form is not installed."""
    if form == "parquet":
        _parquet()


def write(columns, path, form, identity, number):
    """Write columns by name, (N,) each, in place of what is there, then the seal, which an interrupted write lacks."""
    seal = _seal_path(path)
    seal.unlink(missing_ok=True)
    with replaced(path) as temporary:
        _WRITERS[form](columns, temporary)
        digest, size = _digest(temporary)
    rows = len(next(iter(columns.values())))
    write_bytes(seal, json.dumps(asdict(Seal(identity, number, rows, size, digest))).encode())


def done(path, identity, number):
    """Whether a slice is written and sealed as this one; its bytes are compared when it is read."""
    seal = _read_seal(path)
    return seal is not None and path.exists() and (seal.identity, seal.number) == (identity, number)


def read(path, names, identity, number, rows):
    """Columns of a written slice; raises :class:`~meshwright.base.errors.UsageError` for one that is not as sealed."""
    seal = _read_seal(path)
    try:
        intact = seal is not None and seal == Seal(identity, number, rows, *_digest(path)[::-1])
    except OSError as error:
        raise _damaged(path, f"cannot be read ({error.strerror})") from error
    if not intact:
        raise _damaged(path, "is not what the sweep wrote there")
    return columns(path, names)


def columns(path, names):
    """Columns (N,) of a slice file, whoever wrote it."""
    try:
        return _READERS[path.suffix.removeprefix(".")](path, names)
    except (OSError, ValueError, KeyError) as error:  # pyarrow's errors are of these kinds
        raise _damaged(path, f"cannot be read ({error})") from error


def _damaged(path, what):
    return UsageError(f"{path}: {what}; remove it and run the sweep again: it is computed anew")


def _seal_path(path):
    return path.with_name(f"{path.name}.seal")


def _read_seal(path):
    """The seal of a slice; None if there is none, or none that can be read."""
    try:
        return Seal(**json.loads(_seal_path(path).read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):
        return None


def _digest(path):
    """SHA-256 and size of a file."""
    with open(path, "rb") as stream:
        digest = hashlib.file_digest(stream, "sha256").hexdigest()
        return digest, stream.tell()


def _parquet():
    """The Parquet library, which is an extra."""
    try:
        import pyarrow.parquet
    except ModuleNotFoundError as error:
        remedy = "`pip install 'meshwright[sweep]'` brings it; --format csv does without"
        raise UsageError(f"--format parquet: pyarrow is not installed; {remedy}") from error
    return pyarrow


def _write_parquet(columns, path):
    pyarrow = _parquet()
    table = pyarrow.table(columns)
    pyarrow.parquet.write_table(table, path, compression="zstd", compression_level=1, use_dictionary=False)


def _read_parquet(path, names):
    table = _parquet().parquet.read_table(path, columns=names)
    return [table.column(name).to_numpy() for name in names]


def _write_csv(columns, path):
    with open(path, "w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*(column.tolist() for column in columns.values()), strict=True))


def _read_csv(path, names):
    with open(path, encoding="utf-8") as stream:
        places = {name: k for k, name in enumerate(stream.readline().rstrip("\n").split(","))}
        table = np.loadtxt(stream, delimiter=",", usecols=[places[name] for name in names], ndmin=2)
    return list(table.T)


_WRITERS = {"parquet": _write_parquet, "csv": _write_csv}
_READERS = {"parquet": _read_parquet, "csv": _read_csv}
