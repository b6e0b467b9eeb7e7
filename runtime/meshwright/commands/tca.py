"""Tooth contact analysis: contact point, transmission error and ellipse over the pinion angle.

Exit status 1 if a point has no contact, touches along a line, or is one that bodies cannot make.
"""

from meshwright.commands import options as common
from meshwright.files import write_csv, write_json, write_text


def add_arguments(parser):
    common.add_design(parser)
    common.add_angles(parser)
    parser.add_argument("--json", metavar="FILE|-", help="write as JSON (schema meshwright.tca/1)")
    parser.add_argument("--csv", metavar="FILE", help="write as CSV")


def run(options):
    drive = common.drive_of(options)
    result = drive.tca(common.angles_of(options, drive))
    points = result.to_points()
    if options.json:
        document = {"schema": "meshwright.tca/1", "drive": drive.design.family, "design": drive.design.as_solved()}
        write_json(options.json, document | {"points": points})
    if options.csv:
        write_csv(options.csv, *_columns(points))
    if not options.json and not options.csv:
        write_text("-", _table(drive, points))
    return 0 if result.complete else 1


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
        elif key == "flags":
            flat[key] = " ".join(value)
        elif isinstance(value, list):
            flat |= {f"{key}_{axis}": v for axis, v in zip("xyz", value, strict=True)}
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
            f"{' '.join([point['status'], *point['flags']])}"
        )
    return "\n".join(lines) + "\n"


def _cell(value, form):
    return f"{value:>{form}}" if value is not None else "–".rjust(int(form.split(".")[0]))
