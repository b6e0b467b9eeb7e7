"""A table of a drive's error as a file: C, JSON, CSV, NumPy or Modelica text."""

import io
import json
import re
from pathlib import Path

import numpy as np

from meshwright.base.drives import SHIPPED
from meshwright.base.errors import UsageError
from meshwright.base.plain import finite_or_none, finite_or_nones
from meshwright.export.table import SHORTEST

#: Rows of sampled files, both ends of the pitch included.
SAMPLES = 257

_COMMENT = re.compile(r"[ \t]*/\*.*?\*/", re.DOTALL)
_IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*")


def writer(place, stiff=False):
    """What writes a file of this ending; raises :class:`~meshwright.base.errors.UsageError` where nothing does, or it
    has no place for stiffness.
    """
    found = WRITERS.get(Path(place).suffix.lower())
    if found is None:
        raise UsageError(f"--table {place}: no table ends like this; name a file that ends in {', '.join(WRITERS)}")
    if found is _c and not _IDENTIFIER.fullmatch(Path(place).stem):
        raise UsageError(f"--table {place}: its functions are named after the file; use letters, digits and _ alone")
    if stiff and found not in WITH_STIFFNESS:
        raise UsageError(f"--torque-nm: {place} has no place for stiffness; name a file in .json, .npz or .txt")
    return found


def content(table, place, heading, stiffness=()):
    """The bytes of the file of a :class:`~meshwright.export.table.Table`; ``heading``: of which drive it is,
    ``stiffness``: :class:`~meshwright.export.stiffness.Stiffness` under each torque.
    """
    more = (stiffness,) if stiffness else ()
    return writer(place, bool(stiffness))(table, Path(place).stem, heading, *more)


def _json(table, _, heading, stiffness=()):
    def plain(pieces):
        return [
            {"begin_rad": p.begin, "end_rad": p.end, "pair": p.pair, "chebyshev": p.chebyshev.tolist()} for p in pieces
        ]

    document: dict = {
        "schema": "meshwright.table/1",
        "of": heading,
        "pitch_rad": table.pitch,
        "ratio": table.ratio,
        "sense": table.sense,
        "error_bound_rad": table.bound,
        "backlash_rad": finite_or_none(table.backlash),
        "edge_may_touch_first": list(table.edges),
        "drive": plain(table.drive),
        "coast": plain(table.coast),
    }
    if stiffness:
        document["stiffness"] = [
            {
                "torque_nm": under.torque,
                "torque_on": under.torque_on,
                "pinion_angle_rad": under.angles.tolist(),
                "mesh_at_wheel_nm_per_rad": finite_or_nones(under.mesh),
                "pair_at_wheel_nm_per_rad": under.pair,
            }
            for under in stiffness
        ]
    return (json.dumps(document, indent=1) + "\n").encode()


def _samples(table):
    angles = np.linspace(0.0, table.pitch, SAMPLES)
    return np.column_stack([angles, table.errors(angles), table.ratios(angles), table.errors(angles, "coast")])


def _csv(table, _, heading):
    rows = "".join(",".join(map(repr, map(float, row))) + "\n" for row in _samples(table))
    return f"pinion_angle_rad,drive_error_rad,drive_ratio,coast_error_rad\n{rows}".encode()


def _modelica(table, _, heading, stiffness=()):
    """For ``CombiTable1Ds``, repeated from pitch to pitch: the last value is the first."""
    rows = _samples(table)[:, :2]
    rows[-1, 1] = rows[0, 1]
    if not np.isfinite(rows).all():
        raise UsageError("--table: no pair touches at some angles, which this format cannot say; use .json or .c")
    lines = "".join(f"{float(angle)!r} {float(error)!r}\n" for angle, error in rows)
    words = f"# {heading}: pinion angle rad, error rad; extrapolate periodically\n"
    return f"#1\n{words}double te({len(rows)},2)\n{lines}{_modelica_stiffness(stiffness)}".encode()


def _modelica_stiffness(stiffness):
    """A second table: the mesh's stiffness under each torque over the pinion angle."""
    if not stiffness:
        return ""
    rows = np.column_stack([stiffness[0].angles, *(under.mesh for under in stiffness)])
    if not np.isfinite(rows).all():
        raise UsageError("--torque-nm: at some angles no stiffness is known, which this format cannot say; use .json")
    lines = "".join(" ".join(map(repr, map(float, row))) + "\n" for row in rows)
    torques = ", ".join(f"{under.torque:g}" for under in stiffness)
    words = f"# pinion angle rad, N m/rad at the wheel under {torques} N m on the {stiffness[0].torque_on}\n"
    return f"{words}double stiffness({len(rows)},{1 + len(stiffness)})\n{lines}"


def _numpy(table, _, heading, stiffness=()):
    arrays = {"pitch_rad": table.pitch, "ratio": table.ratio, "sense": table.sense, "error_bound_rad": table.bound}
    arrays |= {"backlash_rad": table.backlash, "of": heading}
    for name in ("drive", "coast"):
        pieces = getattr(table, name)
        series = np.zeros((len(pieces), max((len(p.chebyshev) for p in pieces), default=0)))
        for row, piece in zip(series, pieces, strict=True):
            row[: len(piece.chebyshev)] = piece.chebyshev
        arrays |= {f"{name}_begin_rad": np.array([p.begin for p in pieces]), f"{name}_chebyshev": series}
        arrays |= {f"{name}_end_rad": np.array([p.end for p in pieces])}
        arrays |= {f"{name}_pair": np.array([p.pair for p in pieces], dtype=np.int64)}
    if stiffness:
        arrays |= {"torque_nm": np.array([under.torque for under in stiffness]), "torque_on": stiffness[0].torque_on}
        arrays |= {"stiffness_angle_rad": stiffness[0].angles}
        arrays |= {"mesh_at_wheel_nm_per_rad": np.stack([under.mesh for under in stiffness])}
        arrays |= {"pair_at_wheel_nm_per_rad": np.array([under.pair for under in stiffness])}
    stream = io.BytesIO()
    np.savez(stream, **arrays)
    return stream.getvalue()


def _c(table, name, heading):
    """C99 and C++ that needs nothing from a library: the drive's own reduction of angles, then the series."""
    pieces, values, slopes = [], [], []
    for p in (*table.drive, *table.coast):
        pieces.append(f"{{ {p.begin!r}, {p.end!r}, {len(values)}, {len(p.chebyshev)} }}")
        values += p.chebyshev.tolist()
        slopes += [*p.derivative.tolist(), 0.0][: len(p.chebyshev)]
    reduction = (SHIPPED / "include" / "solver" / "reduce.h").read_text(encoding="utf-8")
    reduction = _COMMENT.sub("", reduction).replace('#include "basics.h"\n', _BASICS)
    return _TEMPLATE.format(
        name=name, heading=heading.replace("*/", ""), reduction=re.sub(r"\n\s*\n+", "\n", reduction).strip(),
        pieces=",\n    ".join(pieces), of_drive=len(table.drive), of_coast=len(table.coast),
        values=_wrapped(values), slopes=_wrapped(slopes), teeth=float(table.teeth), ratio=table.ratio,
        bound=table.bound, middle=0.5 * table.pitch, slack=SHORTEST * table.pitch,
    ).encode()  # fmt: skip


def _wrapped(numbers):
    rows = [numbers[k : k + 5] for k in range(0, len(numbers), 5)]
    return ",\n    ".join(", ".join(repr(float(number)) for number in row) for row in rows)


WITH_STIFFNESS = (_json, _numpy, _modelica)
WRITERS = {".c": _c, ".json": _json, ".csv": _csv, ".npz": _numpy, ".txt": _modelica}

_BASICS = """#include <math.h>
#ifndef MW_DEVICE
#define MW_DEVICE
#endif
#ifndef MW_MAX_ANGLE
#define MW_MAX_ANGLE 1e12
#endif
#ifndef MWI_BASICS_H
#define MWI_BASICS_H
static const double MWI_TO_INTEGER = 6755399441055744.0;
static inline double mwi_abs(double a)
{
    return a < 0.0 ? -a : a;
}
#endif
"""

_TEMPLATE = """\
/* {heading}.
 * Made by meshwright.  SPDX-License-Identifier: MIT-0
 *
 * Pinion angle phi, rad, to 1e12 to either side; side 0: the flank that drives, 1: the other one, in the same angles.
 * {name}_error: the wheel stands at {ratio!r} phi plus this, rad; {name}_ratio: d(wheel angle)/d(pinion angle); not
 * numbers where no pair touches. {name}_bound: what the error lacks at most of that of the pair that leads, rad. */
{reduction}
extern const double {name}_bound;
double {name}_error(double phi, int side);
double {name}_ratio(double phi, int side);

typedef struct {name}_piece {{
    double begin, end;
    int first, terms;
}} {name}_piece;

static const {name}_piece {name}_pieces[] = {{
    {pieces}
}};
static const double {name}_values[] = {{
    {values}
}};
static const double {name}_slopes[] = {{
    {slopes}
}};
const double {name}_bound = {bound!r};

/* C. W. Clenshaw, "A note on the summation of Chebyshev series", Mathematics of Computation 9 (1955). */
static double {name}_at(const double *c, double phi, int side)
{{
    double pair, later = 0.0, latest = 0.0, t;
    const double angle = mwi_reduce({teeth!r}, {middle!r}, phi, &pair);
    int low = side ? {of_drive} : 0, high = low + (side ? {of_coast} : {of_drive});
    if (angle != angle || low == high) return NAN;
    while (high - low > 1) {{
        const int middle = (low + high) / 2;
        if ({name}_pieces[middle].begin <= angle) low = middle;
        else high = middle;
    }}
    const {name}_piece *const p = {name}_pieces + low;
    if (angle < p->begin - {slack!r} || angle > p->end + {slack!r}) return NAN;
    t = (2.0 * angle - (p->begin + p->end)) / (p->end - p->begin);
    for (int k = p->terms - 1; k > 0; k--) {{
        const double next = 2.0 * t * later - latest + c[p->first + k];
        latest = later;
        later = next;
    }}
    return t * later - latest + c[p->first];
}}

double {name}_error(double phi, int side)
{{
    return {name}_at({name}_values, phi, side);
}}

double {name}_ratio(double phi, int side)
{{
    return {ratio!r} + {name}_at({name}_slopes, phi, side);
}}
"""
