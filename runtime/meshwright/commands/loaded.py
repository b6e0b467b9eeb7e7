"""Loaded contact in seconds: transmission error under load, load share, contact pressure, mesh stiffness.

Exit status 1 if no tooth pair touches at one of the angles, or its contact under load is not found.
"""

import numpy as np

from meshwright.commands import loading
from meshwright.commands import options as common
from meshwright.commands.progress import progress
from meshwright.files import write_json, write_text
from meshwright.results import ARCSEC

SCHEMA = "meshwright.loaded/1"


def add_arguments(parser):
    loading.add_arguments(parser)
    common.add_angles(parser)
    parser.add_argument("--json", metavar="FILE|-", help=f"write as JSON (schema {SCHEMA})")


def run(options):
    fe = loading.finite_elements()
    drive, gear, load, pairs = loading.loaded_gears(fe, options)
    angles = common.angles_of(options, drive)
    with progress(len(angles) + 3) as step:
        compliance = loading.compliances(fe, gear, pairs, step)
        points = []
        for angle in angles:
            step(f"pinion at {np.degrees(angle):.4g} deg")
            points.append(_point(fe, gear, angle, pairs, load, compliance))
    document = {
        "schema": SCHEMA,
        "torque_nm": options.torque_nm,
        "torque_on": load.member,
        "assumed_blank": gear.assumed,
        "points": points,
    }
    if options.json:
        write_json(options.json, document)
    else:
        write_text("-", loading.blank_note(gear) + _table(document))
    return 0 if all(point["pairs"] for point in points) else 1


def _point(fe, gear, angle, pairs, load, compliance):
    point = {
        "pinion_angle_deg": float(np.degrees(angle)),
        "status": "no_contact",
        "message": "no tooth pair touches at this angle",
        "loaded_transmission_error_arcsec": None,
        "mesh_stiffness_n_per_um": None,
        "rotation_rad": None,
        "pairs": [],
    }
    if not fe.pair.touches(gear, angle, pairs):
        return point
    try:
        found = fe.loaded.loaded_contact(gear, angle, pairs, load, compliance)
    except ArithmeticError as error:
        return point | {"status": "diverged", "message": str(error)}
    total = sum(pair.force for pair in found.pairs)
    return point | {
        "status": "converged",
        "message": "",
        "loaded_transmission_error_arcsec": found.transmission_error / ARCSEC,
        "mesh_stiffness_n_per_um": found.mesh_stiffness / 1000.0,
        "rotation_rad": found.rotation,
        "pairs": [_pair(pair, total) for pair in found.pairs],
    }


def _pair(pair, total):
    hertz = pair.hertz
    return {
        "pairs_later": pair.contact.pairs_later,
        "force_n": pair.force,
        "share": pair.force / total,
        "peak_pressure_mpa": pair.peak_pressure,
        "hertz_pressure_mpa": float(hertz.peak_pressure) if hertz else None,
        "hertz_semi_major_mm": hertz.semi_major if hertz else None,
        "hertz_semi_minor_mm": hertz.semi_minor if hertz else None,
    }


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
    return "\n".join(lines) + "\n"
