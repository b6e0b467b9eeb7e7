"""What a drawing of a design states: every size with its symbol, value, and where it is from.

Given sizes, those that relations derive from them, and what is assumed of the rest; checks with their margins.
"""

from meshwright.base.files import write_json, write_text
from meshwright.commands import options as common
from meshwright.design.design import toml_text
from meshwright.design.drawing import shortened


def add_arguments(parser):
    common.add_design(parser)
    parser.add_argument("--json", metavar="FILE|-", help="write as JSON")
    parser.add_argument("--toml", metavar="FILE|-", help="write a design of the keys that follow, without the drawing")


def run(options):
    drive = common.drive_of(options)
    stated = drive.drawing()
    if options.toml:
        write_text(options.toml, toml_text(drive.design.given()))
    if options.json:
        write_json(options.json, stated.as_json())
    elif not options.toml:
        write_text("-", _page(stated))
    return 0


def _page(stated):
    lines = [f"{stated.drive}, {stated.design['name'] or 'design'}"]
    for key, size in stated.sizes.items():
        value = size.value if isinstance(size.value, str | int) else f"{size.value:.9g}"
        lines.append(f"{key:<44} {value:<14} {size.provenance:<8} {shortened(size.relation)}".rstrip())
    for name, check in stated.checks.items():
        lines.append(f"{name:<44} {check.said}, margin {check.margin:.6g}")
    return "\n".join(lines) + "\n"
