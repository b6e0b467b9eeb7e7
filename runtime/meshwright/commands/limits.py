"""Undercut lines, edges of regression, limit points of contact, meshing axes and branch points."""

from meshwright.base.errors import UsageError
from meshwright.base.files import write_json, write_text
from meshwright.commands import options as common
from meshwright.commands.progress import progress
from meshwright.commands.shown import blank_note, shown
from meshwright.limits import STEPS, Request, limits_of

#: More lines than this are taken for a mistake.
MOST_LINES = 10_000


def add_arguments(parser):
    common.add_design(parser)
    parser.add_argument("--section-y-mm", type=common.number, metavar="C", help="section y = C of the rack and pinion")
    parser.add_argument("--radius-mm", type=common.radii, default=(), metavar="R1,R2,…", help="radii on pinion or tool")
    parser.add_argument("--axial-mm", type=common.numbers, default=(), metavar="Z1,Z2,…", help="axial positions")
    parser.add_argument("--grid", type=common.count, default=15, metavar="N", help="lines of a searched flank")
    parser.add_argument("--json", metavar="FILE|-", help="write as JSON (schema meshwright.limits/1)")


def run(options):
    if options.grid > MOST_LINES:
        raise UsageError(f"--grid {options.grid}: {MOST_LINES} lines at most; choose fewer")
    drive = common.drive_of(options)
    request = Request(options.section_y_mm, options.radius_mm, options.axial_mm, options.grid)
    with progress(STEPS) as step:
        found = limits_of(drive, request, step)
    if options.json:
        document = {"schema": "meshwright.limits/1", "drive": drive.design.family, "design": drive.design.as_solved()}
        write_json(options.json, document | found.plain())
    else:
        write_text("-", _page(drive, found.plain(), options.axial_mm))
    return 0


def _page(drive, found, axial):
    lines = [f"{drive.design.description['title']}, {drive.design.tables['name'] or 'design'}"]
    omitted = found["not_computed"]
    for name, entries in found.items():
        if name == "not_computed" or name.removesuffix("_exist") in omitted:
            continue
        if name == "assumed_blank":
            lines += blank_note(entries).splitlines()
        elif name == "blank_left_open":
            if entries:
                lines.append(f"what [blank] leaves open bounds nothing, a standard blank does not fit: {entries}")
        elif isinstance(entries, list):
            where = " at the axial positions given" if axial and name == "undercut" else ""
            lines.append(f"{name.replace('_', ' ')}{where}: {len(entries) or 'none'}{_on_flanks(entries)}")
            lines += [f"  {_line(entry)}" for entry in entries]
        elif entries is not None:
            lines.append(f"{name.replace('_', ' ')}: {_cell(entries)}")
    return "\n".join([*lines, *_omitted(omitted)]) + "\n"


def _omitted(omitted):
    """What was not computed, a line for each reason."""
    for why in dict.fromkeys(omitted.values()):
        names = (name.replace("_", " ") for name, reason in omitted.items() if reason == why)
        yield f"not computed: {', '.join(names)} ({why})"


def _on_flanks(entries):
    """How many of the places lie on a flank, where that is known of them."""
    known = [entry["on_flank"] for entry in entries if "on_flank" in entry]
    return f", {sum(known) or 'none'} of them on a flank" if known else ""


def _line(entry):
    said = (_proved(value) if key == "certificate" else f"{key} {_cell(value)}" for key, value in _filled(entry))
    return "  ".join(said)


def _filled(entry):
    return ((key, value) for key, value in entry.items() if value not in ([], {}, None))


def _proved(certificate):
    """What is proved of a branch point."""
    if certificate["outcome"] != "unique":
        return f"(not certified: {certificate['reason']})"
    low, high = certificate["pinion_angle_deg"]
    return f"(certified to {high - low:.0e} deg)"


def _cell(value):
    if isinstance(value, dict):
        return " ".join(f"{key} {_cell(inner)}" for key, inner in value.items())
    if isinstance(value, list):
        return "(" + ", ".join(map(_cell, value)) + ")"
    return shown(value) if isinstance(value, float) else str(value)
