"""Grids of a tooth flank with normals: JSON, VTU (ParaView), STL, STEP.

Body frame, normals out of the material. The grid covers the flank as far as the blank and the tool let it exist, and
where they set no limit, what contact uses.
"""

import re
import sys

from meshwright.base.errors import UsageError
from meshwright.base.files import write_bytes, write_json, write_text
from meshwright.commands import options as common
from meshwright.flank import exports
from meshwright.flank.grids import grid
from meshwright.flank.step import step
from meshwright.limits.sections import section

#: Larger grids are taken for a mistake.
MOST_POINTS = 4_000_000


def add_arguments(parser):
    common.add_design(parser)
    parser.add_argument("--member", choices=("pinion", "wheel"), required=True)
    parser.add_argument("--region", choices=("flank", "fillet"), default="flank", help="default: flank")
    parser.add_argument("--grid", default="21x41", metavar="NxM", help="points across and along; default 21x41")
    parser.add_argument(
        "--section", type=common.number, metavar="C", help="profile in the plane y = C of a right-angle worm drive, mm"
    )
    parser.add_argument("--json", metavar="FILE|-", help="write as JSON (schema meshwright.surface/1)")
    parser.add_argument("--vtu", metavar="FILE|-", help="write for ParaView")
    parser.add_argument("--stl", metavar="FILE|-", help="write triangles")
    parser.add_argument(
        "--step", metavar="FILE|-", help="write a B-spline surface and print its deviation; needs the extra cad"
    )


def run(options):
    shape = _shape(options.grid)
    drive = common.drive_of(options)
    if options.section is not None:
        _refuse_with_section(options)
        found = section(drive, options.member, options.section, shape[0])
        write_json(options.json or "-", document(found) | {"section_y_mm": options.section})
        return 0
    found = grid(drive, options.member, shape, options.region)
    if options.vtu:
        write_text(options.vtu, exports.vtu(found))
    if options.stl:
        write_bytes(options.stl, exports.stl(found))
    if options.step:
        _write_step(options.step, drive, options.member, shape, options.region)
    if options.json or not (options.vtu or options.stl or options.step):
        write_json(options.json or "-", document(found))
    return 0


def _refuse_with_section(options):
    """A section is a line, not a surface: it is written as JSON only, and only of flanks."""
    for name in ("vtu", "stl", "step"):
        if getattr(options, name):
            raise UsageError(f"--{name}: a section is a line; write it with --json, or leave --section out")
    if options.region != "flank":
        raise UsageError(f"--region {options.region}: sections are of the flank; leave --region or --section out")


def document(found):
    """The ``meshwright.surface/1`` document of a grid."""
    return {
        "schema": "meshwright.surface/1",
        "member": found.member,
        "region": found.region,
        "parameters": list(found.parameters),
        "shape": list(found.shape),
        "parameter_values": found.values.tolist(),
        "points_mm": found.points.tolist(),
        "normals": found.normals.tolist(),
    }


def _shape(text):
    match = re.fullmatch(r"(\d+)x(\d+)", text)
    if not match:
        raise UsageError(f"--grid {text}: not NxM; for example --grid 21x41")
    across, along = int(match[1]), int(match[2])
    if across * along > MOST_POINTS:
        raise UsageError(f"--grid {text}: {across * along} points; {MOST_POINTS} at most")
    return across, along


def _write_step(place, drive, member, shape, region):
    made = step(drive, member, shape, region)
    write_bytes(place, made.content)
    print(f"{place}: B-spline surface within {1000.0 * made.deviation:.3g} µm of the flank", file=sys.stderr)
