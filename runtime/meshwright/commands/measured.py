"""Measured flanks in the terms of ISO 1328-1: profile and lead deviations of every trace, pitch, and the map.

Total deviation F, slope deviation f_H and form deviation f_f along the normal, over the length of each trace; pitch
where every tooth is measured, along the circle through the middle of the grid. Reads the points that `grid` writes,
with deviation_um filled in: positive for excess material.
"""

import math

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.files import write_json, write_text
from meshwright.commands import options as common
from meshwright.shop.measured import measured
from meshwright.shop.tables import read_csv


def add_arguments(parser):
    common.add_design(parser)
    parser.add_argument("--member", choices=("pinion", "wheel"), required=True)
    parser.add_argument("--measured", required=True, metavar="FILE.csv", help="points with deviation_um, as of `grid`")
    parser.add_argument("--json", metavar="FILE|-", help="write as JSON (schema meshwright.measured/1)")


def run(options):
    drive = common.drive_of(options)
    points, _ = read_csv(options.measured)
    if not np.isfinite(points.deviations).any():
        raise UsageError(f"{options.measured}: deviation_um is empty in every line; fill in what was measured")
    found = measured(drive, options.member, points)
    if options.json:
        write_json(options.json, document(found))
    else:
        write_text("-", _table(found))
    return 0


def document(found):
    """The ``meshwright.measured/1`` document: µm along the normal, None where nothing is measured."""
    return {
        "schema": "meshwright.measured/1",
        "flanks": [
            {
                "tooth": flank.tooth,
                "flank": flank.flank,
                "profile": [{"j": j} | _trace(*trace) for j, trace in enumerate(flank.profile)],
                "lead": [{"i": i} | _trace(*trace) for i, trace in enumerate(flank.lead)],
                "map_um": [[_um(value) for value in row] for row in flank.map],
            }
            for flank in found.flanks
        ],
        "pitch": [
            {
                "flank": word, "radius_mm": radius, "single_um": [_um(v) for v in pitch.single],
                "largest_single_um": _um(pitch.largest), "total_cumulative_um": _um(pitch.total),
            }
            for word, (radius, pitch) in found.pitch.items()
        ],
    }  # fmt: skip


def _trace(length, deviations):
    return {
        "length_mm": length,
        "total_um": _um(deviations.total),
        "slope_um": _um(deviations.slope),
        "form_um": _um(deviations.form),
    }


def _um(value):
    return 1e3 * float(value) if math.isfinite(value) else None


def _table(found):
    lines = [f"{'tooth':>5} {'flank':<8}{'trace':<12}{'length':>9}{'F':>10}{'f_H':>10}{'f_f':>10}   mm, µm"]
    for flank in found.flanks:
        traces = [(f"profile {j}", *t) for j, t in enumerate(flank.profile)]
        for name, length, d in [*traces, *((f"lead {i}", *t) for i, t in enumerate(flank.lead))]:
            if math.isfinite(d.total):
                numbers = "".join(f"{1e3 * v:>10.2f}" for v in (d.total, d.slope, d.form))
                lines.append(f"{flank.tooth:>5} {flank.flank:<8}{name:<12}{length:>9.3f}{numbers}")
    for word, (radius, pitch) in found.pitch.items():
        lines.append(
            f"pitch, {word} flanks, radius {radius:.3f} mm: largest single {1e3 * pitch.largest:.2f} µm, "
            f"total cumulative {1e3 * pitch.total:.2f} µm"
        )
    return "\n".join(lines) + "\n"
