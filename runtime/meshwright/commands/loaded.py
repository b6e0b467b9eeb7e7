"""Loaded contact without a solver: transmission error under load, load share, contact pressure, mesh stiffness.

Elastic teeth are factorised once, which takes a second for gears and a few for threads, then every angle takes a part
of a second; a terminal shows how far it is. Teeth are linear elastic and turn by small angles: where the loaded member
turns by more than 0.01 rad there are no figures. Points, lines, edges and corners are one method: pressure cells along
the curve of smallest gap, as far as the flanks go, laid out wider until no pressure is left at a free border of theirs,
and finer until rotation, forces and peaks change by less than 1 %. Each result is checked: its moment is the torque,
and its peak is no lower than the least with which lines can carry the force (Johnson, Contact Mechanics). What fails is
not_resolved and has no figures. Where an edge of a flank cuts a contact off and the mate goes on, pressure grows there
without bound as cells get finer: the peak of pressure is that of the free contact, a quarter of its length and width
away from such edges, and what presses beside them is told apart, by force, length of the edge and mean pressure, to
about 5 %. With --measured a flank has the measured deviations, every tooth those of the one measured; nothing beyond
the measured grid touches. Where the bounded flanks of a pair touch first on an edge or at a corner, as those of gears
out of line do, the pair carries from there on: on half-spaces with the free edges of a quarter-space, and the tooth
behind; force and share hold. Where an edge carries half of a pair's force or more, its peak is that of the half further
away. Exit status 1 without figures: if no tooth pair touches at one of the angles, its contact under load is not found
or not resolved, or the torque is too large for the method.
"""

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.files import write_json, write_text
from meshwright.base.plain import finite_or_none
from meshwright.commands import loading
from meshwright.commands import options as common
from meshwright.commands.progress import progress
from meshwright.commands.shown import blank_note
from meshwright.contact.results import ARCSEC
from meshwright.shop.tables import read_csv

SCHEMA = "meshwright.loaded/1"

#: Transmission errors of a point, under load and of rigid teeth.
ERRORS = "loaded_transmission_error_arcsec", "unloaded_transmission_error_arcsec"

#: Steps of the work besides one an angle.
STEPS = 4


def add_arguments(parser):
    loading.add_arguments(parser)
    common.add_angles(parser)
    parser.add_argument("--measured", metavar="FILE.csv", help="deviations of a flank: its as-measured contact")
    parser.add_argument("--member", choices=("pinion", "wheel"), help="whose flank is measured")
    parser.add_argument("--tooth", type=common.count, metavar="K", help="which tooth; default: the first measured")
    parser.add_argument("--json", metavar="FILE|-", help=f"write as JSON (schema {SCHEMA})")


def run(options):
    fe = loading.finite_elements()
    drive = loading.checked_drive(options)
    angles = common.angles_of(options, drive)
    points = _measured(options)
    if points is not None:
        common.say_other_design(drive, points)
    with progress(len(angles) + STEPS) as step:
        gear, document = solved(fe, options, drive, angles, step, points)
    if options.json:
        write_json(options.json, document)
    else:
        write_text("-", blank_note(gear.assumed) + _table(document) + _gaps(document))
    return 0 if all(point["pairs"] for point in document["points"]) else 1


def solved(fe, options, drive, angles, step, points=None):
    """The gear pair and the document ``meshwright.loaded/1`` at pinion angles, rad; ``step(text)`` is called
    :data:`STEPS` times and once an angle. ``points`` are measured ones. A mirrored drive is solved as it is described,
    and its mirror image written.
    """
    mirror, described = drive.design.mirror, drive.as_described
    gear, load, pairs = loading.loaded_gears(fe, options, described, step)
    if points is not None:
        from meshwright.fe.as_measured import as_measured

        gear = as_measured(gear, drive, options.member, points, options.tooth)
    compliance = loading.compliances(fe, gear, pairs, step)
    found = []
    for angle in angles:
        step(f"pinion at {np.degrees(angle):.4g} deg")
        solution = _point(fe, gear, mirror, mirror.sign * angle, pairs, load, compliance)
        found.append(_nothing(angle) | _mirrored(solution, mirror))
    return gear, {
        "schema": SCHEMA,
        "torque_nm": options.torque_nm,
        "torque_on": load.member,
        "assumed_blank": gear.assumed,
        "gaps": loading.gap_note(gear),
        "contact_ratio": gear.contact_ratio if np.isfinite(gear.contact_ratio) else None,
        "points": found,
    }


def _measured(options):
    """The measured points, None if none are given."""
    if (options.measured is None) != (options.member is None):
        raise UsageError("--measured and --member belong together: whose flank is it? give both or neither")
    if options.measured is None:
        if options.tooth is not None:
            raise UsageError(f"--tooth {options.tooth}: of a measured member: give --measured and --member")
        return None
    return read_csv(options.measured)[0]


def _mirrored(point, mirror):
    """A point of the drive as described as one of its mirror image, in which a later pair is an earlier one."""
    if mirror.sign > 0.0 or not point.get("pairs"):
        return point
    pairs = [
        pair | {
            "pairs_later": -pair["pairs_later"],
            "line_mm": {name: (np.array(line) * mirror.flip).tolist() for name, line in pair["line_mm"].items()},
        }
        for pair in point["pairs"]
    ]  # fmt: skip
    errors = {key: mirror.sign * point[key] for key in ERRORS}
    return point | {"pairs": pairs} | errors


def _nothing(angle):
    return {
        "pinion_angle_deg": float(np.degrees(angle)),
        "status": "no_contact",
        "message": "no tooth pair touches at this angle",
        **dict.fromkeys(ERRORS),
        "mesh_stiffness_n_per_um": None,
        "rotation_rad": None,
        "pairs": [],
    }


def _point(fe, gear, mirror, angle, pairs, load, compliance):
    """What is known of an angle but the angle; {} where nothing touches."""
    point = {}
    if not fe.pair.first_touches(gear, angle, pairs):
        return point
    try:
        found = fe.loaded.loaded_contact(gear, angle, pairs, load, compliance)
    except (ArithmeticError, ValueError) as error:  # a section of a tooth that is not whole, too
        return point | {"status": "diverged", "message": str(error)}
    if not abs(found.rotation) <= fe.gate.LARGEST_ROTATION:
        return point | {"status": "rotation_not_small", "message": _too_far(found, fe.gate.LARGEST_ROTATION)}
    if found.unresolved:
        return point | {"status": "not_resolved", "message": found.unresolved}
    total = sum(pair.force for pair in found.pairs)
    lines = _lines(gear, angle, found.unloaded_error, found.pairs)
    errors = found.transmission_error, found.unloaded_error
    return point | {
        "status": "converged",
        "message": "; ".join(_edge_note(pair, mirror) for pair in found.pairs if _cut_short(pair)),
        **{key: error / ARCSEC for key, error in zip(ERRORS, errors, strict=True)},
        "mesh_stiffness_n_per_um": found.mesh_stiffness / 1000.0,
        "rotation_rad": found.rotation,
        "pairs": [_pair(pair, total) | {"line_mm": line} for pair, line in zip(found.pairs, lines, strict=True)],
    }


def _too_far(found, limit):
    return (
        f"under this torque the {found.load.member} would turn by {abs(found.rotation):.3g} rad, beyond {limit:g}: "
        "elasticity and rotations are no longer linear and small; choose a smaller torque"
    )


def _number(pairs_later, mirror):
    """The number of a pair of the drive as described, as it is of the design's hand."""
    return f"{int(mirror.sign) * pairs_later:+d}"


def _cut_short(pair):
    """Whether an edge bounds a contact area that it need not bound: lines end at edges, where pressure may not peak."""
    return pair.peaks_at_edge or (pair.cut_off and _kind(pair.contact.touch) != "line")


def _edge_note(pair, mirror):
    """That an edge cuts a contact area off, and what presses beside it where pressure is highest there."""
    number, first = _number(pair.contact.pairs_later, mirror), pair.contact.touch.edge
    by = " and the ".join(pair.edges) or "edge of a flank"
    note = f"pair {number} touches first with the {first}" if first else f"pair {number} is cut off by the {by}"
    if not pair.peaks_at_edge:
        return note
    zone = pair.edge_zone
    along, across = zone.depth
    loads = ", ".join(
        f"{load.force:.5g} N beside {load.length:.3g} mm of {load.edge} (mean {load.pressure:.4g} MPa)"
        for load in zone.loads
    )
    said = (
        f"{note}: pressure at a sharp edge grows without bound, so its peak of {pair.peak_pressure:.5g} MPa is that "
        f"beyond {along:.2g} mm along and {across:.2g} mm across from there, with {loads}"
    )
    return said if pair.hertz is None else f"{said}; without an edge {pair.hertz.peak_pressure:.5g} MPa (Hertz)"


def _lines(gear, angle, unloaded, pairs):
    """The line of contact of each pair in the frames of both bodies, as they stand for the reference tooth, mm."""
    turned = {"pinion": angle, "wheel": gear.ratio * angle + unloaded}
    return [
        {name: _in_body(member.pose(turned[name] - pair.contact.pairs_later * member.pitch), pair.line)
         for name, member in (("pinion", gear.pinion), ("wheel", gear.wheel))}
        for pair in pairs
    ]  # fmt: skip


def _in_body(pose, points):
    """Points (M, 3) of the fixed frame in the frame of a body that stands at ``pose`` (4, 4), to 1e-6 mm."""
    return np.round((points - pose[:3, 3]) @ pose[:3, :3], 6).tolist()


def _kind(touch):
    if touch.edge:
        return "edge"
    return "tangency" if touch.curvature_min > 0.0 else "line"


def _pair(pair, total):
    hertz, kind, zone = pair.hertz, _kind(pair.contact.touch), pair.edge_zone
    return {
        "pairs_later": pair.contact.pairs_later,
        "kind": kind,
        "first_contact": pair.contact.touch.edge or kind,
        "gap_um": 1000.0 * pair.apart,
        "force_n": pair.force,
        "share": pair.force / total,
        "peak_pressure_mpa": pair.peak_pressure,
        "cut_off_by": list(pair.edges) or (["edge"] if pair.cut_off else []),
        "peak_at_edge": pair.peaks_at_edge,
        "carried_by_edge": zone.holds,
        "edge_zone_mm": zone.depth and dict(zip(("along", "across"), zone.depth, strict=True)),
        "edge_loads": [
            {
                "edge": load.edge,
                "force_n": load.force,
                "length_mm": load.length,
                "mean_pressure_mpa": load.pressure,
            }
            for load in zone.loads
        ],
        "hertz_pressure_mpa": float(hertz.peak_pressure) if hertz else None,
        "hertz_semi_major_mm": finite_or_none(hertz.semi_major) if hertz else None,
        "hertz_semi_minor_mm": hertz.semi_minor if hertz else None,
    }


def _gaps(document):
    untouched = any(point["status"] == "no_contact" for point in document["points"])
    return f"{document['gaps']}\n" if untouched and document["gaps"] else ""


def _table(document):
    lines = [f"{document['torque_nm']:g} N m on the {document['torque_on']}"]
    lines.append(f"{'pinion, deg':>12} {'TE, arcsec':>11} {'N/um':>8}  force N (share): pressure MPa of each pair")
    for point in document["points"]:
        if not point["pairs"]:
            lines.append(f"{point['pinion_angle_deg']:12.5g} {point['status']}: {point['message']}")
            continue
        pairs = ", ".join(
            f"{p['force_n']:.5g} ({p['share']:.3f}): {p['peak_pressure_mpa']:.5g}" for p in point["pairs"]
        )
        lines.append(
            f"{point['pinion_angle_deg']:12.5g} {point['loaded_transmission_error_arcsec']:11.5g} "
            f"{point['mesh_stiffness_n_per_um']:8.4g}  {pairs}"
        )
        if point["message"]:
            lines.append(f"{'':12} {point['message']}")
    return "\n".join(lines) + "\n"
