"""Measured flanks in the terms of ISO 1328-1: profile and lead deviations of every trace, pitch, and the map.

Total deviation F, slope deviation f_H and form deviation f_f along the normal, over the length of each trace; pitch
where every tooth is measured, along the circle through the middle of the grid. Reads the points that `grid` writes,
with deviation_um filled in: positive for excess material. With --contact also what the as-measured flank of one tooth
does with the nominal mate: tangency and first contact, contact pattern and ease-off; what lies beyond the measured grid
has no numbers. Exit status 1 if the flanks touch there nowhere on the grid.
"""

import math

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.files import write_json, write_text
from meshwright.base.plain import finite_or_none
from meshwright.commands import options as common
from meshwright.commands.progress import progress
from meshwright.contact.results import ARCSEC
from meshwright.cycle.pairs import Mesh
from meshwright.shop.as_measured import AsMeasured
from meshwright.shop.measured import measured
from meshwright.shop.tables import read_measured


def add_arguments(parser):
    common.add_design(parser)
    parser.add_argument("--member", choices=("pinion", "wheel"), required=True)
    parser.add_argument("--measured", required=True, metavar="FILE.csv", help="points with deviation_um, as of `grid`")
    parser.add_argument("--contact", action="store_true", help="the contact of the as-measured flank as well")
    common.add_angles(parser)
    parser.add_argument("--tooth", type=common.count, metavar="K", help="whose contact; default: the first measured")
    parser.add_argument("--json", metavar="FILE|-", help="write as JSON (schema meshwright.measured/1)")


def run(options):
    drive = common.drive_of(options)
    points = read_measured(options.measured)
    if not options.contact and (options.tooth or options.phi_deg):
        raise UsageError("--phi-deg and --tooth are of the contact: add --contact")
    with progress(4 if options.contact else 1) as step:
        step("measured flanks")
        found = measured(drive, options.member, points)
        contact = _contact(drive, options, points, step) if options.contact else None
    common.say_other_design(drive, points)
    if options.json:
        write_json(options.json, document(found) | {"contact": contact and _plain(*contact)})
    else:
        write_text("-", _table(found) + (_contact_table(*contact) if contact else ""))
    return 0 if contact is None or all(kind is not None for kind in contact[0].kinds) else 1


def _contact(drive, options, points, step):
    """Contact and ease-off of the as-measured flank; ``step(text)`` is called three times."""
    step("window of contact")
    flank = AsMeasured.of(drive, options.member, points, options.tooth)
    window = Mesh.of(drive).window
    ends = (window.begin.angle, window.end.angle) if window.complete else drive.about_the_middle([-0.5, 0.5])
    separation = drive.design.value("separation_mm", "contact")
    step("contact of the measured flank")
    contact = flank.tca(common.angles_of(options, drive))
    step("ease-off")
    return contact, flank.ease_off(*sorted(ends), separation)


def _plain(tca, ease_off):
    return {
        "points": [
            {
                "pinion_angle_deg": float(np.degrees(tca.angles[k])), "status": tca.status[k],
                "transmission_error_arcsec": finite_or_none(tca.errors[k] / ARCSEC),
                "nominal_transmission_error_arcsec": finite_or_none(tca.nominal[k] / ARCSEC),
                "contact_point_mm": _row(tca.points[k]), "contact_normal": _row(tca.normals[k]),
                "first_contact": tca.kinds[k] and {
                    "kind": tca.kinds[k], "transmission_error_arcsec": finite_or_none(tca.first[k] / ARCSEC),
                },
            }
            for k in range(len(tca.angles))
        ],
        "ease_off_um": [[_um(value) for value in row] for row in ease_off.ease_off],
        "pattern_share": ease_off.pattern,
        "separation_mm": ease_off.separation,
    }  # fmt: skip


def _row(values):
    return values.tolist() if np.isfinite(values).all() else None


def _contact_table(tca, ease_off):
    lines = [f"{'pinion':>10}{'measured':>14}{'nominal':>14}{'first contact':>16}   transmission error, arcsec"]
    for k, angle in enumerate(np.degrees(tca.angles)):
        values = (tca.errors[k], tca.nominal[k], tca.first[k])
        cells = (f"{v / ARCSEC:.5f}" if math.isfinite(v) else "–" for v in values)
        row = "".join(f"{cell:>{width}}" for cell, width in zip(cells, (14, 14, 16), strict=True))
        lines.append(f"{angle:>10.3f}{row}   {tca.status[k]}, {tca.kinds[k] or 'no contact'}")
    lines.append(
        f"pattern at {1e3 * ease_off.separation:g} µm: {100.0 * ease_off.pattern:.1f} % of the measured grid; ease-off "
        f"up to {1e3 * np.nanmax(ease_off.ease_off):.1f} µm"
    )
    return "\n".join(lines) + "\n"


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
