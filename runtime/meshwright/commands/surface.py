"""Grids of a tooth flank with normals: JSON, VTU (ParaView), STL, STEP.

Body frame, normals out of the material. The region goes as far as blank, tool and singular lines let the surface
exist, and where they set no limit, what contact uses; an undercut flank ends where its fillet cuts it. JSON holds a
grid, with null off the region, and triangles with the border resolved; VTU and STL hold the triangles, STEP trimmed
B-spline surfaces. Exit status 1 if the STEP file departs from the exact surface by more than 1 µm. With --solid: the
closed body of the member, all its teeth or some, as STL (triangles) or STEP (B-spline faces); volume and departure from
the flanks are printed, above 1 µm with exit status 1.
"""

import re
import sys

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.files import write_bytes, write_json, write_text
from meshwright.commands import options as common
from meshwright.commands.progress import progress
from meshwright.drive import Drive
from meshwright.flank import exports
from meshwright.flank.grids import checked_size
from meshwright.flank.step import step
from meshwright.limits.sections import section

#: A STEP file that departs further from the exact surface, mm, is not what was asked for.
MOST_DEVIATION = 1e-3


def add_arguments(parser):
    common.add_design(parser)
    parser.add_argument("--member", choices=("pinion", "wheel"), required=True)
    parser.add_argument("--region", choices=("flank", "fillet"), default="flank", help="default: flank")
    parser.add_argument("--grid", default="21x41", metavar="NxM", help="points across and along; default 21x41")
    parser.add_argument(
        "--section",
        type=common.number,
        metavar="C",
        help="profile in the plane y = C, mm, where tool and wheel are a rack and a pinion at right angles",
    )
    parser.add_argument("--json", metavar="FILE|-", help="write as JSON (schema meshwright.surface/1)")
    parser.add_argument("--vtu", metavar="FILE|-", help="write for ParaView")
    parser.add_argument("--stl", metavar="FILE|-", help="write triangles")
    parser.add_argument(
        "--step", metavar="FILE|-", help="write a B-spline surface and print its deviation; needs the extra cad"
    )
    parser.add_argument("--solid", action="store_true", help="the closed body of the member; needs --stl or --step")
    parser.add_argument("--teeth", type=common.count, metavar="N", help="with --solid: so many teeth; default: all")
    parser.add_argument(
        "--other-flank", metavar="DESIGN", help="with --solid: the design of the other flank, if flanks have their own"
    )


def run(options):
    shape = _shape(options.grid)
    drive = common.drive_of(options)
    if options.solid and options.region != "flank":
        raise UsageError(f"--region {options.region}: a body has all its regions; leave --region or --solid out")
    if options.solid:
        return _write_solid(options, drive)
    if options.teeth is not None:
        raise UsageError(f"--teeth {options.teeth}: goes with --solid; add it, or leave --teeth out")
    if options.other_flank is not None:
        raise UsageError(f"--other-flank {options.other_flank}: goes with --solid; add it, or leave --other-flank out")
    if options.section is not None:
        _refuse_with_section(options)
        found = section(drive, options.member, options.section, shape[0])
        write_json(options.json or "-", document(found) | {"section_y_mm": options.section})
        return 0
    with progress(2) as step:
        step("where contact uses the flanks")
        drive.uses  # noqa: B018 (the drive keeps it)
        step(f"{options.region} of the {options.member}")
        found = drive.surface(options.member, shape, options.region)
    if drive.crossing(options.member) is not None:
        other = "fillet" if options.region == "flank" else "flank"
        print(
            f"the flank of the {options.member} is undercut: its {options.region} is written up to its {other}",
            file=sys.stderr,
        )
    if options.vtu:
        write_text(options.vtu, exports.vtu(found))
    if options.stl:
        triangles = found.mesh.points, found.mesh.triangles
        write_bytes(options.stl, exports.stl(*triangles, f"{found.member} {found.region}"))
    good = _write_step(options, drive, shape) if options.step else True
    if options.json or not (options.vtu or options.stl or options.step):
        write_json(options.json or "-", document(found))
    return 0 if good else 1


def _write_solid(options, drive):
    """Write the closed body, print volume and departure; exit status."""
    if not (options.stl or options.step) or options.json or options.vtu or options.section is not None:
        raise UsageError("--solid: a body is written with --stl FILE or --step FILE, and with nothing else")
    try:
        from meshwright.fe.closed_body import solid_body
        from meshwright.flank.solid_step import solid_step
    except ModuleNotFoundError as error:
        raise UsageError(f"--solid: {error.name} is not installed; `pip install 'meshwright[fe]'` brings it") from error
    other = options.other_flank and Drive.load(options.other_flank, drive.backend)
    body = solid_body(drive, options.member, options.teeth, other=other)
    name = f"{drive.design.tables['name'] or drive.design.family} {options.member}, {body.teeth} teeth"
    departures = []
    if options.stl:
        faceted = body.faceted(MOST_DEVIATION)
        write_bytes(options.stl, exports.stl(faceted.points, faceted.triangles, name))
        _say(name, faceted.volume, f"{len(faceted.triangles)} facets", faceted.departure)
        departures.append(faceted.departure)
    if options.step:
        patches, departure = body.splined(MOST_DEVIATION)
        content, volume = solid_step(patches, name)
        write_bytes(options.step, content)
        _say(name, volume, f"{len(patches)} faces", departure)
        departures.append(departure)
    return 0 if max(departures) <= MOST_DEVIATION else 1


def _say(name, volume, count, departure):
    print(
        f"{name}: volume {volume:.6g} mm³, {count}, those of the flanks within {1000.0 * departure:.3g} µm of them",
        file=sys.stderr,
    )


def _refuse_with_section(options):
    """A section is a line, not a surface: it is written as JSON only, and only of flanks."""
    for name in ("vtu", "stl", "step"):
        if getattr(options, name):
            raise UsageError(f"--{name}: a section is a line; write it with --json, or leave --section out")
    if options.region != "flank":
        raise UsageError(f"--region {options.region}: sections are of the flank; leave --region or --section out")


def document(found):
    """The ``meshwright.surface/1`` document of a grid: null off the region, and the mesh where there is one."""
    mesh = {} if found.mesh is None else {
        "mesh": {
            "vertices_mm": found.mesh.points.tolist(),
            "normals": found.mesh.normals.tolist(),
            "triangles": found.mesh.triangles.tolist(),
        }
    }
    return {
        "schema": "meshwright.surface/1",
        "member": found.member,
        "region": found.region,
        "parameters": list(found.parameters),
        "shape": list(found.shape),
        "parameter_values": _rows(found.values),
        "points_mm": _rows(found.points),
        "normals": _rows(found.normals),
        **mesh,
    }


def _rows(values):
    return [row if known else None for row, known in zip(values.tolist(), np.isfinite(values).all(axis=1), strict=True)]


def _shape(text):
    match = re.fullmatch(r"(\d+)x(\d+)", text)
    if not match:
        raise UsageError(f"--grid {text}: not NxM; for example --grid 21x41")
    return checked_size((int(match[1]), int(match[2])))


def _write_step(options, drive, shape):
    """Write the file, say how far it departs, and return whether that is little enough."""
    place, region = options.step, options.region
    made = step(drive, drive.region(options.member, region), shape)
    write_bytes(place, made.content)
    print(f"{place}: B-spline surface within {1000.0 * made.deviation:.3g} µm of the {region}", file=sys.stderr)
    return made.deviation <= MOST_DEVIATION
