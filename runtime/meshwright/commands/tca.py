"""Tooth contact analysis: contact point, transmission error and ellipse over the pinion angle.

Where the blank bounds the flanks, also where the two flanks touch first: at that point, along a line, on an edge or at
a corner, each of which is a result. Exit status 1 if the flanks do not touch at an angle, or as bodies cannot.
"""

import math
import sys
from pathlib import Path

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.files import write_csv, write_json, write_text
from meshwright.commands import options as common
from meshwright.commands.progress import progress
from meshwright.contact.flags import not_first
from meshwright.contact.friction import efficiency
from meshwright.contact.velocities import velocities
from meshwright.cycle.first_contact import Search

#: More directions than this are taken for a mistake.
MOST_DIRECTIONS = 36_000

#: A search for first contact that could have missed an overlap above this, mm, says so.
RESOLVED = 1e-4

#: A bound on that overlap above this, mm, says nothing: tooth depths are of its order.
MEANINGFUL = 1.0

#: Status words of contacts that no tangency is.
ON_EDGES = ("edge_contact", "corner_contact")

#: Contact points nearer than this are one, mm.
SAME_POINT = 1e-5


def add_arguments(parser):
    common.add_design(parser)
    common.add_angles(parser)
    common.add_friction(parser)
    parser.add_argument(
        "--contour", type=int, metavar="N", help="add the contact patch by separation in N directions, 3 or more (JSON)"
    )
    parser.add_argument(
        "--all-contacts", action="store_true",
        help="search for further contacts of the same tooth pair at each angle (CSV gives their number)",
    )  # fmt: skip
    parser.add_argument(
        "--certify", action="store_true",
        help="prove each contact: that it exists, is the only one nearby, how far its numbers can be off, and that "
        "nothing else touches first",
    )  # fmt: skip
    parser.add_argument(
        "--proof", metavar="FILE",
        help="with --certify and --phi-deg: write what generated/audit/check_contact.py verifies from the description "
        "alone; of several angles, files numbered from FILE's name",
    )  # fmt: skip
    parser.add_argument("--json", metavar="FILE|-", help="write as JSON (schema meshwright.tca/1)")
    parser.add_argument("--csv", metavar="FILE|-", help="write as CSV")


def run(options):
    drive = common.drive_of(options)
    if options.contour is not None and (options.contour < 3 or not options.json):
        raise UsageError(
            f"--contour {options.contour}: needs 3 or more directions and --json; for example --contour 72 --json -"
        )
    if options.contour is not None and options.contour > MOST_DIRECTIONS:
        raise UsageError(f"--contour {options.contour}: {MOST_DIRECTIONS} directions at most; choose fewer")
    if options.proof is not None and not (options.certify and options.phi_deg):
        raise UsageError(f"--proof {options.proof}: needs --certify and --phi-deg; for example --phi-deg 0 --certify")
    result = drive.tca(common.angles_of(options, drive))
    certificates = _certificates(options, drive, result)
    if drive.backend == "c":
        result = drive.refined(result, certificates)
    first = drive.first_contact(result.angles, result)
    result = not_first(result, first)
    points = result.to_points()
    for k, point in enumerate(points):
        point["first_contact"] = first.point(k, result.error)
    moving = velocities(drive, result)
    rubbing = efficiency(drive, result, common.friction_of(options), moving)
    for point, *found in zip(points, moving.plain(), rubbing.plain(), strict=True):
        for part in found:
            point |= part
    _say_unresolved(first)
    if set(result.status) == {"no_contact"}:
        common.say_proportions(drive)
    if options.contour is not None:
        _add_contours(points, drive, result, options.contour)
    if options.all_contacts:
        _add_other_contacts(points, drive, result)
    if options.certify:
        firsts = drive.certify_first(result.angles, result, certificates).to_plain(result)
        held = drive.certify_extremes(result.angles, result)
        for k, (point, certificate, found) in enumerate(zip(points, certificates.to_plain(), firsts, strict=True)):
            point["certificate"] = certificate | {"first_contact": found, "contact_line": None} | held.plain(k)
    proved = options.proof is None or _write_proofs(options, drive, result)
    if options.json:
        document = {"schema": "meshwright.tca/1", "drive": drive.design.family, "design": drive.design.as_solved()}
        write_json(options.json, document | {"points": points})
    if options.csv:
        write_csv(options.csv, *_columns(points))
    if not options.json and not options.csv:
        held = [k for k, p in enumerate(points) if p.get("certificate", {}).get("outcome") == "enclosed"]
        said = f"{_not_aligned(drive, points)}{_enclosed(points)}{certificates.said(held)}"
        write_text("-", f"{_table(drive, points)}{said.rstrip()}\n")
    return 0 if result.complete and proved else 1


def _certificates(options, drive, result):
    """Proofs of the contacts, at the decimals of the angles where they were given."""
    from meshwright.contact.certificate import degrees_of

    return drive.certify(result.angles, result, options.phi_deg and degrees_of(options.phi_deg))


def _write_proofs(options, drive, result):
    """A file of each angle; whether every contact has one. One that has no proof is said on standard error."""
    from meshwright.contact.certificate import degrees_of
    from meshwright.contact.proof import proof

    place = Path(options.proof)
    exact = degrees_of(options.phi_deg)
    written = 0
    for k, degrees in enumerate(exact):
        numbered = place.with_stem(f"{place.stem}-{k + 1}") if len(exact) > 1 else place
        try:
            write_json(str(numbered), proof(drive, degrees, result.solutions[k]))
            written += 1
        except UsageError as error:
            print(error, file=sys.stderr)
    return written == len(exact)


def _say_unresolved(first):
    """On standard error, what the search for first contact could not exclude."""
    doubtful = first.unresolved > RESOLVED
    if doubtful.any():
        most = first.unresolved[doubtful].max()
        bound = f"by up to {1000.0 * most:.3g} µm" if most < MEANINGFUL else "by an amount that is not bounded"
        print(
            f"first contact: at {doubtful.sum()} of {len(doubtful)} angles a place that the search missed could "
            f"overlap {bound}",
            file=sys.stderr,
        )


def _add_contours(points, drive, result, count):
    """One-sided radii at the design's separation; ``radius_on_flank_mm`` stops at the edges of the flanks.

    Where the flanks touch along a line: the line, from edge to edge.
    """
    from meshwright.pattern.pattern import contour

    with progress(len(points)) as step:
        for point, angle in zip(points, result.angles, strict=True):
            step(f"contact patch at {np.degrees(angle):.1f}°")
            patch = contour(drive, angle, count, result=result)
            point["contour"] = [] if patch is None else _radii(patch)
            if point["status"] == "line_contact":
                point["contact_line_mm"] = point["contact_line"]["points_mm"] if point["contact_line"] else []


def _add_other_contacts(points, drive, result):
    """The other contacts of the tooth pair at each angle; relative errors refer to the same contact as the points."""
    with progress(len(points)) as step:
        for k, (point, angle) in enumerate(zip(points, result.angles, strict=True)):
            step(f"contacts at {np.degrees(angle):.1f}°")
            found = drive.contacts(angle).relative_to(result.reference_error)
            same = np.linalg.norm(found.points - result.points[k], axis=1) < SAME_POINT
            point["other_contacts"] = [c for c, known in zip(found.to_points(), same, strict=True) if not known]


def _radii(patch):
    return [
        {"direction_deg": float(d), "radius_mm": float(r) if np.isfinite(r) else None, "radius_on_flank_mm": float(e)}
        for d, r, e in zip(np.degrees(patch.directions), patch.radii, patch.radii_on_flank, strict=True)
    ]


def _columns(points):
    """Header and rows: nested entries become ``name_x`` or ``group.name``."""
    rows = [_flat(point) for point in points]
    header = list(dict.fromkeys(key for row in rows for key in row))
    return header, [[row.get(key, "") for key in header] for row in rows]


def _flat(point):
    flat = {}
    for key, value in point.items():
        if isinstance(value, dict):
            flat |= {f"{key}.{inner}": v for inner, v in _flat(value).items()}
        elif key in ("contour", "contact_line", "contact_line_mm"):
            continue
        elif key == "other_contacts":
            flat[key] = len(value)
        elif key == "edges":
            flat[key] = ", ".join(value)
        elif key in ("flags", "limits", "impossible") and isinstance(value, list):
            flat[key] = " ".join(value)
        elif isinstance(value, list):
            axes = "xyz" if len(value) == 3 else ("low", "high")
            flat |= {f"{key}_{axis}": v for axis, v in zip(axes, value, strict=True)}
        else:
            flat[key] = value
    return flat


def _table(drive, points):
    lines = [f"{drive.design.description['title']}, {drive.design.tables['name'] or 'design'}"]
    lines.append(
        f"{'pinion':>10} {'wheel':>12} {'transmission':>13} {'relative':>11} {'ellipse semi-axes':>19}  status, flags"
    )
    lines.append(f"{'deg':>10} {'deg':>12} {'error, arcsec':>13} {'arcsec':>11} {'mm':>19}")
    for point in points:
        axes = point["ellipse"]
        lines.append(
            f"{point['pinion_angle_deg']:>10.3f} {_cell(point['wheel_angle_deg'], '12.6f')} "
            f"{_cell(point['transmission_error_arcsec'], '13.5f')} "
            f"{_cell(point['transmission_error_relative_arcsec'], '11.5f')} "
            f"{_cell(axes['semi_major_mm'], '9.3f')} {_cell(axes['semi_minor_mm'], '9.4f')}  "
            f"{' '.join([point['status'], *point['flags'], *_remarks(point)])}"
        )
    return "\n".join(lines) + "\n"


def _not_aligned(drive, points):
    """Which errors of the assembly are given where flanks touch on edges or at corners; nothing elsewhere."""
    count = sum(point["status"] in ON_EDGES for point in points)
    if not count:
        return ""
    errors = {key: value for key, value in drive.design.given().get("misalignment", {}).items() if value}
    given = ", ".join(f"{key} = {value:g}" for key, value in errors.items())
    said = [f"on an edge or at a corner at {count} of {len(points)} angles"]
    if math.isfinite(rise := _out_of_line(drive, points)):
        said.append(f"from one end of the contact line to the other the flanks are out of line by {1000 * rise:.3g} µm")
    wheel_pitch = math.degrees(abs(drive.ratio) * drive.pitch()) * 3600.0
    if any(abs(p["transmission_error_arcsec"]) > wheel_pitch for p in points if p["status"] in ON_EDGES):
        said.append("somewhere the wheel turns by more than its pitch until this pair touches: other pairs do before")
    said.append(f"errors of the assembly: {given}" if given else "the assembly has no errors")
    return "; ".join(said) + "\n"


def _enclosed(points):
    """How many errors of contacts that are no tangencies are proved to lie between two numbers; nothing if none."""
    radii = [p["certificate"]["radius"] for p in points if p.get("certificate", {}).get("outcome") == "enclosed"]
    if not radii:
        return ""
    lines = [p["certificate"]["contact_line"] for p in points if p["certificate"]["contact_line"] is not None]
    shown = [max(map(abs, line["apart_mm"])) for line in lines if line["outcome"] == "enclosed"]
    said = f"enclosed: the error of {len(radii)} contacts on lines, edges or corners, within {max(radii):.0e} arcsec\n"
    if shown:
        said += f"enclosed: {len(shown)} of {len(lines)} lines, both flanks within {max(shown):.0e} mm all along\n"
    return said


def _out_of_line(drive, points):
    """The most by which flanks that touch on edges stand apart along what would be their line of contact, mm; NaN where
    they have none, or touch in points.
    """
    search, _ = Search.of(drive)
    angles = np.radians([point["pinion_angle_deg"] for point in points if point["status"] in ON_EDGES])
    own = drive.design.mirror.sign * angles
    if search is None or not search.flank.pointless:
        return math.nan
    rises = [search.rise(*at) for at in zip(own, search.at(own), strict=True)]
    return max((rise for rise in rises if math.isfinite(rise)), default=math.nan)


def _remarks(point):
    return *_touching(point), *_others(point), *_efficiency(point), *_shown(point)


def _touching(point):
    """A remark on the limits at which flanks touch on an edge or at a corner."""
    found = point["first_contact"]
    if point["status"] not in ON_EDGES or found is None:
        return ()
    return (f"({' on '.join(found['edges']) if found['kind'] == 'edge' else ' and '.join(found['edges'])})",)


def _efficiency(point):
    """A remark on the efficiency, where friction is given."""
    found = point["efficiency"]
    if found["pinion_drives"] is None:
        return ()
    return (f"(efficiency {found['pinion_drives']:.4f}, wheel drives {found['wheel_drives']:.4f})",)


def _others(point):
    """A remark on further contacts of the tooth pair, if any were sought and found."""
    others = point.get("other_contacts")
    return (f"(+{len(others)} contact{'s' * (len(others) > 1)})",) if others else ()


def _shown(point):
    """What is proved of a point, if that was asked for."""
    if (certificate := point.get("certificate")) is None:
        return ()
    if certificate["outcome"] == "enclosed":
        return (f"(touches first, surely, within {certificate['radius']:.0e} arcsec of this error)",)
    if certificate["outcome"] != "unique":
        return (f"({certificate['outcome']}: {certificate['reason']})",)
    first = certificate["first_contact"]
    word = f"unknown whether first: {first['reason']}" if first["reason"] else first["outcome"].replace("_", " ")
    return (f"(certified to {certificate['radius']:.0e} arcsec, {word})",)


def _cell(value, form):
    """A number in a column; no minus sign on what rounds to zero."""
    if value is None:
        return "–".rjust(int(form.split(".")[0]))
    digits = int(form.split(".")[1].rstrip("f"))
    return f"{round(value, digits) + 0.0:>{form}}"
