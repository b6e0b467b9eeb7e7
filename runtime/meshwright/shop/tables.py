"""Points of a measuring machine as files: CSV of our own, and DMIS.

CSV: comment lines ``# key = value`` with the unit in each key, then a header and one line a point. Coordinates are of
the body frame: z along the axis of rotation, teeth numbered from 1 in the sense of +z. ``deviation_um`` is the excess
of metal along the outward normal, empty where nothing is measured.
"""

import csv
import io
import math
from dataclasses import dataclass, field

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.files import read_table

#: Columns of every file; more may follow.
COLUMNS = ("tooth", "flank", "i", "j", "x_mm", "y_mm", "z_mm", "nx", "ny", "nz", "deviation_um")
CENTRES = ("cx_mm", "cy_mm", "cz_mm")

#: Larger files are taken for a mistake, bytes.
LARGEST_FILE = 2**28


#: Largest number of a tooth or of a line of points, and most places of the grid that such numbers span.
LARGEST_NUMBER = 999_999
MOST_PLACES = 4_000_000


@dataclass(frozen=True)
class Points:
    """M points: ``tooth``, ``i`` (across), ``j`` (along) (M,) of int, ``flank`` (M,) of words, ``points`` and outward
    ``normals`` (M, 3), ``deviations`` (M,) in mm, NaN where nothing is measured. ``remarks`` are what their file
    says of itself, by key.
    """

    tooth: np.ndarray
    flank: tuple[str, ...]
    i: np.ndarray
    j: np.ndarray
    points: np.ndarray
    normals: np.ndarray
    deviations: np.ndarray
    remarks: dict[str, str] = field(default_factory=dict)

    def of(self, rows):
        """Those of these rows."""
        return Points(
            self.tooth[rows], tuple(self.flank[k] for k in rows), self.i[rows], self.j[rows], self.points[rows],
            self.normals[rows], self.deviations[rows], self.remarks,
        )  # fmt: skip


def csv_text(points, remarks, ball_radius=None):
    """The CSV file of :class:`Points`; with ``ball_radius`` (mm) the ball's centres too, P + radius · n."""
    stream = io.StringIO()
    for key, value in remarks.items():
        stream.write(f"# {key} = {value}\n")
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(COLUMNS + (CENTRES if ball_radius else ()))
    for k in range(len(points.tooth)):
        measured = points.deviations[k]
        row = [int(points.tooth[k]), points.flank[k], int(points.i[k]), int(points.j[k])]
        row += [repr(float(v)) for v in (*points.points[k], *points.normals[k])]
        row.append(repr(float(measured * 1e3)) if np.isfinite(measured) else "")
        if ball_radius:
            row += [repr(float(v)) for v in points.points[k] + ball_radius * points.normals[k]]
        writer.writerow(row)
    return stream.getvalue()


def read_csv(path):
    """:class:`Points` and remarks of a CSV file; :class:`~meshwright.base.errors.UsageError` names line and column."""
    remarks, lines = {}, []
    for number, line in enumerate(read_table(path, LARGEST_FILE, "a file of measured points"), 1):
        if line.startswith("#"):
            key, equals, value = line[1:].partition("=")
            if equals:
                remarks[key.strip()] = value.strip()
        elif line.strip():
            lines.append((number, line))
    if not lines:
        raise UsageError(f"{path}: holds no table; its header is {','.join(COLUMNS)}")
    header = next(csv.reader([lines[0][1]]))
    missing = [name for name in COLUMNS if name not in header]
    if missing:
        raise UsageError(f"{path}: column {missing[0]} is missing; the header is {','.join(COLUMNS)}")
    rows = [_row(path, number, header, line) for number, line in lines[1:]]
    if not rows:
        raise UsageError(f"{path}: holds no points; write one a line below the header")
    columns = dict(zip(COLUMNS, zip(*rows, strict=True), strict=True))
    shape = max(columns["i"]) + 1, max(columns["j"]) + 1
    if shape[0] * shape[1] > MOST_PLACES:
        size = f"{shape[0]} x {shape[1]}"
        raise UsageError(f"{path}: i and j span {size} places, more than a grid has; number them from 0")
    return _points(columns, remarks), remarks


def read_measured(path):
    """:class:`Points` of a CSV file, some of which are measured."""
    points, _ = read_csv(path)
    if not np.isfinite(points.deviations).any():
        raise UsageError(f"{path}: deviation_um is empty in every line; fill in what was measured")
    return points


def _row(path, number, header, line):
    cells = next(csv.reader([line]))
    if len(cells) != len(header):
        raise UsageError(f"{path}, line {number}: {len(cells)} cells below {len(header)} columns; complete the line")
    by_name = dict(zip(header, cells, strict=True))
    return [_cell(path, number, name, by_name[name].strip()) for name in COLUMNS]


def _cell(path, number, name, text):
    if name == "flank":
        if not text:
            raise UsageError(f"{path}, line {number}: flank is empty; write the flank's word")
        return text
    whole = name in ("tooth", "i", "j")
    if name == "deviation_um" and text == "":
        return math.nan
    try:
        value = int(text) if whole else float(text)
    except ValueError:
        value = math.nan
    if whole and not (name == "tooth") <= value <= LARGEST_NUMBER:
        least = 1 if name == "tooth" else 0
        reason = f"is not a whole number from {least} to {LARGEST_NUMBER}"
        raise UsageError(f"{path}, line {number}: {name} = {text[:40]!r} {reason}; correct it")
    if not math.isfinite(value):
        kind = "a whole number" if whole else "a finite number"
        raise UsageError(f"{path}, line {number}: {name} = {text[:40]!r} is not {kind}; correct it")
    return value


def _points(columns, remarks):
    def vectors(*names):
        return np.stack([np.array(columns[name]) for name in names], axis=1)

    return Points(
        np.array(columns["tooth"]), columns["flank"], np.array(columns["i"]), np.array(columns["j"]),
        vectors("x_mm", "y_mm", "z_mm"), vectors("nx", "ny", "nz"), np.array(columns["deviation_um"]) * 1e-3,
        remarks,
    )  # fmt: skip


def dmis_text(points, name):
    """The points as DMIS features and measuring commands (ISO 22093), mm, outward normals."""
    title = "".join(c if c.isascii() and c.isprintable() and c not in "'$" else "_" for c in name)
    lines = [f"DMISMN/'{title}',05.2", "UNITS/MM,ANGDEC", "D(BODY)=DATSET/MCS"]
    for k, (point, normal) in enumerate(zip(points.points, points.normals, strict=True), 1):
        place = ",".join(f"{v:.9f}" for v in (*point, *normal))
        lines += [f"F(P{k})=FEAT/POINT,CART,{place}", f"MEAS/POINT,F(P{k}),1", f"PTMEAS/CART,{place}", "ENDMES"]
    return "\n".join([*lines, "ENDFIL"]) + "\n"
