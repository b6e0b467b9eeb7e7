"""Slices of a sweep as files of columns: Parquet or CSV."""

import csv

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.files import replaced


def require(form):
    """Raise :class:`~meshwright.base.errors.UsageError` if what reads and writes a form is not installed."""
    if form == "parquet":
        _parquet()


def write(columns, path, form):
    """Write columns by name, (N,) each, in place of what is there; an interrupted write leaves nothing."""
    with replaced(path) as temporary:
        _WRITERS[form](columns, temporary)


def read(path, names):
    """Columns of a written slice."""
    return _READERS[path.suffix.removeprefix(".")](path, names)


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
