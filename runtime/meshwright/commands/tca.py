"""Tooth contact analysis: contact point, transmission error and ellipse over the pinion angle.

Where the blank bounds the flanks, also where the two flanks touch first: at that point, along a line, on an edge or at
a corner, each of which is a result. Exit status 1 if the flanks do not touch at an angle, or as bodies cannot.
"""

import math
import sys
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.files import csv_table, json_list, write_json, write_text
from meshwright.commands import options as common
from meshwright.commands.progress import progress
from meshwright.contact.certificate import Shown, degrees_of
from meshwright.contact.flags import not_first
from meshwright.contact.friction import efficiency
from meshwright.contact.results import ON_EDGES
from meshwright.contact.velocities import velocities
from meshwright.cycle.search import Search

#: Angles that are analysed, and written, at once.
AT_ONCE = 4096

#: More directions than this are taken for a mistake.
MOST_DIRECTIONS = 36_000

#: A search for first contact that could have missed an overlap above this, mm, says so.
RESOLVED = 1e-4

#: A bound on that overlap above this, mm, says nothing: tooth depths are of its order.
MEANINGFUL = 1.0

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
    angles = common.angles_of(options, drive)
    degrees = degrees_of(options.phi_deg) if options.phi_deg else None
    parts = [slice(k, k + AT_ONCE) for k in range(0, len(angles), AT_ONCE)]
    reference = _reference(drive, [angles[part] for part in parts]) if len(parts) > 1 else None
    told = _Told(drive)
    with ExitStack() as until_the_end:
        writers = _writers(options, drive, until_the_end)
        for part in parts:
            asked = _Asked(angles[part], degrees and degrees[part], reference)
            result, first, certificates = _contacts(drive, asked)
            points = _points(options, drive, result, first, certificates)
            told.add(result, first, options.proof is None or _write_proofs(options, drive, result, degrees, part.start))
            if not writers:
                told.add_in_words(points, certificates)
                write_text("-", (_heading(drive) if part.start == 0 else "") + "".join(map(_line, points)))
            for write in writers:
                write(points)
    told.say(in_words=not writers)
    return 0 if told.complete else 1


@dataclass(frozen=True)
class _Asked:
    """Some of the angles, rad; as written, in degrees, or None; the error to which theirs are relative, or None."""

    angles: np.ndarray
    degrees: list | None
    reference: float | None


def _contacts(drive, asked):
    """A TCA, refined, with what precedes its contacts, and their proofs."""
    result = drive.tca(asked.angles)
    certificates = drive.certify(result.angles, result, asked.degrees)
    if drive.backend == "c":
        result = drive.refined(result, certificates)
    if asked.reference is not None:
        result = result.relative_to(asked.reference)
    first = drive.first_contact(result.angles, result)
    return not_first(result, first), first, certificates


def _reference(drive, parts):
    """The error to which those of all parts are relative: at the reference angle or, where there is no contact, the
    nearest angle that has one.
    """
    at = drive.design.mirror.sign * drive.design.reference_angle
    least, known = math.inf, math.nan
    there = [] if any(np.any(part == at) for part in parts) else [np.array([at])]
    for part in there + sorted(parts, key=lambda part: np.min(np.abs(part - at))):
        if np.min(np.abs(part - at)) > least or least == 0.0:
            break
        result = drive.tca(part)
        if drive.backend == "c":
            result = drive.refined(result)
        away = np.where(np.isfinite(result.error), np.abs(part - at), math.inf)
        if np.min(away) < least:
            least, known = np.min(away), float(result.error[np.argmin(away)])
    return known


def _points(options, drive, result, first, certificates):
    """What is written of each point, as plain data."""
    points = result.to_points()
    moving = velocities(drive, result)
    rubbing = efficiency(drive, result, common.friction_of(options), moving)
    columns = first.plain(result.error), moving.plain(), rubbing.plain()
    for point, found, *others in zip(points, *columns, strict=True):
        point["first_contact"] = found
        for part in others:
            point |= part
    if options.contour is not None:
        _add_contours(points, drive, result, options.contour)
    if options.all_contacts:
        _add_other_contacts(points, drive, result)
    if options.certify:
        firsts = drive.certify_first(result.angles, result, certificates).to_plain(result)
        held = drive.certify_extremes(result.angles, result)
        for k, (point, certificate, found) in enumerate(zip(points, certificates.to_plain(), firsts, strict=True)):
            point["certificate"] = certificate | {"first_contact": found, "contact_line": None} | held.plain(k)
    return points


def _writers(options, drive, until_the_end):
    """Functions that write some points to each file that is asked for."""
    writers = []
    if options.json:
        document = {"schema": "meshwright.tca/1", "drive": drive.design.family, "design": drive.design.as_solved()}
        writers.append(until_the_end.enter_context(json_list(options.json, document, "points")))
    if options.csv:
        add_rows = until_the_end.enter_context(csv_table(options.csv))
        writers.append(lambda points: add_rows([_flat(point) for point in points]))
    return writers


def _write_proofs(options, drive, result, degrees, begin):
    """A file of each angle from number ``begin`` on; whether every contact has one. One without a proof is said on
    standard error.
    """
    from meshwright.contact.proof import proof

    place, written = Path(options.proof), 0
    for k, x in enumerate(result.solutions, begin):
        numbered = place.with_stem(f"{place.stem}-{k + 1}") if len(degrees) > 1 else place
        try:
            write_json(str(numbered), proof(drive, degrees[k], x))
            written += 1
        except UsageError as error:
            print(error, file=sys.stderr)
    return written == len(result.solutions)


class _Told:
    """What is said of all points together."""

    def __init__(self, drive):
        self.drive = drive
        self.complete, self.statuses, self.unresolved = True, set(), []
        self.shown, self.radii, self.lines = Shown(), [], []
        self.on_edges, self.rise, self.beyond_a_pitch = 0, -math.inf, False

    def add(self, result, first, proved):
        self.complete &= result.complete and proved
        self.statuses |= set(result.status)
        self.unresolved.append(first.unresolved)

    def add_in_words(self, points, certificates):
        """What the text alone says."""
        proofs = [point.get("certificate", {}) for point in points]
        held = [k for k, proof in enumerate(proofs) if proof.get("outcome") == "enclosed"]
        self.shown += certificates.shown(held)
        self.radii += [proofs[k]["radius"] for k in held]
        self.lines += [proofs[k]["contact_line"] for k in held if proofs[k]["contact_line"] is not None]
        on_edges = [point for point in points if point["status"] in ON_EDGES]
        self.on_edges += len(on_edges)
        if on_edges:
            self.rise = max(self.rise, _out_of_line(self.drive, on_edges))
            wheel_pitch = math.degrees(abs(self.drive.ratio) * self.drive.pitch()) * 3600.0
            self.beyond_a_pitch |= any(abs(p["transmission_error_arcsec"]) > wheel_pitch for p in on_edges)

    def say(self, in_words):
        unresolved = np.concatenate(self.unresolved)
        _say_unresolved(unresolved)
        if self.statuses == {"no_contact"}:
            common.say_proportions(self.drive)
        if in_words:
            said = f"{self._not_aligned(len(unresolved))}{self._enclosed()}{self.shown.said()}"
            write_text("-", f"{said.rstrip()}\n")

    def _not_aligned(self, count):
        """Which errors of the assembly are given where flanks touch on edges or at corners; nothing elsewhere."""
        if not self.on_edges:
            return ""
        errors = {key: value for key, value in self.drive.design.given().get("misalignment", {}).items() if value}
        given = ", ".join(f"{key} = {value:g}" for key, value in errors.items())
        said = [f"on an edge or at a corner at {self.on_edges} of {count} angles"]
        if self.rise > -math.inf:
            rise = f"{1000 * self.rise:.3g} µm"
            said.append(f"from one end of the contact line to the other the flanks are out of line by {rise}")
        if self.beyond_a_pitch:
            until = "until this pair touches: other pairs do before"
            said.append(f"somewhere the wheel turns by more than its pitch {until}")
        said.append(f"errors of the assembly: {given}" if given else "the assembly has no errors")
        return "; ".join(said) + "\n"

    def _enclosed(self):
        """How many errors of contacts that are no tangencies are proved to lie between two numbers; nothing if none."""
        if not self.radii:
            return ""
        within = f"within {max(self.radii):.0e} arcsec"
        said = f"enclosed: the error of {len(self.radii)} contacts on lines, edges or corners, {within}\n"
        if shown := [max(map(abs, line["apart_mm"])) for line in self.lines if line["outcome"] == "enclosed"]:
            of = f"{len(shown)} of {len(self.lines)} lines"
            said += f"enclosed: {of}, both flanks within {max(shown):.0e} mm all along\n"
        return said


def _say_unresolved(unresolved):
    """On standard error, what the search for first contact could not exclude."""
    doubtful = unresolved > RESOLVED
    if doubtful.any():
        most = unresolved[doubtful].max()
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


def _flat(point):
    """A row: nested entries become ``name_x`` or ``group.name``."""
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


def _heading(drive):
    return (
        f"{drive.design.description['title']}, {drive.design.tables['name'] or 'design'}\n"
        f"{'pinion':>10} {'wheel':>12} {'transmission':>13} {'relative':>11} {'ellipse semi-axes':>19}  status, flags\n"
        f"{'deg':>10} {'deg':>12} {'error, arcsec':>13} {'arcsec':>11} {'mm':>19}\n"
    )


def _line(point):
    axes = point["ellipse"]
    return (
        f"{point['pinion_angle_deg']:>10.3f} {_cell(point['wheel_angle_deg'], '12.6f')} "
        f"{_cell(point['transmission_error_arcsec'], '13.5f')} "
        f"{_cell(point['transmission_error_relative_arcsec'], '11.5f')} "
        f"{_cell(axes['semi_major_mm'], '9.3f')} {_cell(axes['semi_minor_mm'], '9.4f')}  "
        f"{' '.join([point['status'], *point['flags'], *_remarks(point)])}\n"
    )


def _out_of_line(drive, points):
    """The most by which flanks that touch on edges stand apart along what would be their line of contact, mm; -infinity
    where they have none, or touch in points.
    """
    search, _ = Search.of(drive)
    own = drive.design.mirror.sign * np.radians([point["pinion_angle_deg"] for point in points])
    if search is None or not search.flank.pointless:
        return -math.inf
    rises = [search.rise(*at) for at in zip(own, search.at(own), strict=True)]
    return max((rise for rise in rises if math.isfinite(rise)), default=-math.inf)


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
