"""Nominal points of flanks for a measuring machine, and sizes over balls or wires.

Body frame: z along the axis of rotation; tooth k is the drawn one turned by (k − 1)/T of a turn about +z. Points stay
off the ends of the flank by a margin, with unit normals out of the material and, for a ball, its centres. Exit status 1
if a ball does not rest between the flanks.
"""

import math
import re

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.files import write_json, write_text
from meshwright.base.plain import finite_or_none
from meshwright.commands import options as common
from meshwright.commands.progress import progress
from meshwright.shop.balls import sizes
from meshwright.shop.nominal import flank_words, nominal
from meshwright.shop.tables import csv_text, dmis_text

#: More points than this are taken for a mistake.
MOST_POINTS = 1_000_000

#: Margins from this on leave nothing of a flank, percent.
MOST_MARGIN = 50.0


def add_arguments(parser):
    common.add_design(parser)
    parser.add_argument("--member", choices=("pinion", "wheel"), required=True)
    parser.add_argument("--lines", metavar="NxM", help="points across the tooth, along the profile, and along it")
    parser.add_argument(
        "--margin-percent", type=common.number, default=5.0, metavar="P", help="left out at each end; default 5"
    )
    parser.add_argument("--teeth", metavar="K,K,…", default="1", help="numbers of the teeth; default 1")
    parser.add_argument("--both-flanks", action="store_true", help="the other flank too; default: the design's")
    parser.add_argument("--ball-mm", type=common.positive, metavar="D", help="diameter of the ball: adds its centres")
    parser.add_argument("--csv", metavar="FILE|-", help="write as CSV")
    parser.add_argument("--dmis", metavar="FILE|-", help="write as a DMIS program")
    parser.add_argument("--over-balls", type=common.radii, metavar="D,D,…", help="sizes over balls of these diameters")
    parser.add_argument("--json", metavar="FILE|-", help="write the sizes as JSON (schema meshwright.size/1)")


def run(options):
    drive = common.drive_of(options)
    if options.over_balls is None and options.lines is None:
        raise UsageError("grid: neither --lines nor --over-balls is given; for example --lines 5x9 --csv points.csv")
    if options.lines is None and (options.csv or options.dmis):
        raise UsageError("--csv and --dmis hold points: give --lines NxM, for example --lines 5x9")
    if options.over_balls is None and options.json:
        raise UsageError("--json holds sizes over balls: give --over-balls D,D,…, or write points with --csv")
    if options.lines is not None:
        _write_points(options, drive)
    if options.over_balls is None:
        return 0
    with progress(1 + len(options.over_balls)) as step:
        found = sizes(drive, options.member, options.over_balls, step)
    if options.json:
        write_json(options.json, {"schema": "meshwright.size/1", "sizes": [plain(size) for size in found]})
    else:
        write_text("-", _table(found))
    return 0 if all(math.isfinite(size.size) for size in found) else 1


def _write_points(options, drive):
    lines, margin = _lines(options.lines), options.margin_percent
    if not 0.0 <= margin < MOST_MARGIN:
        raise UsageError(f"--margin-percent {margin:g}: must be from 0 to below {MOST_MARGIN:g}; 5 is usual")
    flanks = flank_words(drive) if options.both_flanks else (drive.design.tables["flank"],)
    with progress(2) as step:
        step("where contact uses the flanks")
        drive.uses  # noqa: B018 (the drive keeps it)
        step(f"points of the {options.member}")
        points = nominal(drive, options.member, lines, margin / 100.0, _teeth(options.teeth), flanks)
    if not len(points.tooth):
        raise UsageError(f"--lines {options.lines}: no point is on the flank; take more lines or a smaller margin")
    if options.dmis:
        write_text(options.dmis, dmis_text(points, f"{options.member} of {drive.design.label}"))
    if options.csv or not options.dmis:
        radius = options.ball_mm and 0.5 * options.ball_mm
        write_text(options.csv or "-", csv_text(points, _remarks(options, drive, lines), radius))


def _remarks(options, drive, lines):
    """What a file of points says of itself."""
    teeth = drive.teeth(options.member)
    remarks = {
        "design": drive.design.label,
        "member": options.member,
        "lines_across": lines[0],
        "lines_along": lines[1],
        "margin_percent": options.margin_percent,
        "teeth": teeth,
        "datum": "z along the axis of rotation, z = 0 and the zero of the angle as in the design's body frame",
        "tooth_k_turned_deg": f"(k - 1) * 360 / {teeth} about +z",
        "deviation": "along the normal, positive for excess material",
    }
    return remarks | ({"ball_diameter_mm": options.ball_mm} if options.ball_mm else {})


def plain(size):
    """A size as plain data; None for what does not exist."""
    fits = math.isfinite(size.centre_radius)
    return {
        "ball_mm": size.ball,
        "centre_radius_mm": finite_or_none(size.centre_radius),
        "size_over_balls_mm": finite_or_none(size.size),
        "arrangement": size.arrangement or None,
        "size_over_three_wires_mm": finite_or_none(size.wires),
        "lowest_radius_mm": finite_or_none(size.lowest),
        "contact_points_mm": size.contacts.tolist() if fits and np.isfinite(size.contacts).all() else None,
        "reason": size.reason or None,
    }


def _table(found):
    lines = [f"{'ball':>9} {'centre radius':>15} {'over two balls':>15} {'over three wires':>17}   mm"]
    for size in found:
        row = "".join(
            f" {value:>{width}.6f}" if math.isfinite(value) else " " + "–".rjust(width)
            for value, width in ((size.centre_radius, 15), (size.size, 15), (size.wires, 17))
        )
        lines.append(f"{size.ball:>9.4f}{row}   {size.reason or size.arrangement}")
    return "\n".join(lines) + "\n"


def _lines(text):
    match = re.fullmatch(r"(\d+)x(\d+)", text)
    shape = (int(match[1]), int(match[2])) if match else (0, 0)
    if min(shape) < 2 or shape[0] * shape[1] > MOST_POINTS:
        raise UsageError(f"--lines {text}: not NxM with 2 or more each way and {MOST_POINTS} points at most; e.g. 5x9")
    return shape


def _teeth(text):
    if not re.fullmatch(r"\d{1,6}(,\d{1,6})*", text):
        raise UsageError(f"--teeth {text}: not numbers of teeth; for example --teeth 1,14,27")
    return tuple(dict.fromkeys(int(word) for word in text.split(",")))
