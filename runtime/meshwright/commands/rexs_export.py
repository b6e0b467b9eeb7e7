"""Write a design as a REXS 2 file, with a report of what was mapped, what was not, and what was assumed.

A design that came from a REXS file is put back into it: what the design does not hold stays there as it was. --new
writes a file of its own instead. --measured adds measured deviations of a member (a file as of `grid`, filled in) as
lists of points.
"""

import sys

from meshwright.base.errors import UsageError
from meshwright.base.files import write_bytes, write_json
from meshwright.commands import options as common
from meshwright.design import design as designs
from meshwright.rexs.measurements import with_points
from meshwright.rexs.origin import origin_of
from meshwright.rexs.report import lines
from meshwright.rexs.writing import file_of
from meshwright.shop.tables import read_measured

NAME = "export"


def add_arguments(parser):
    parser.add_argument("design", metavar="DESIGN", help="packaged design or TOML file")
    parser.add_argument("--rexs", metavar="OUT|-", required=True, help="where to write the file")
    parser.add_argument("--json", metavar="REPORT|-", help="write the report (schema meshwright.rexs/1)")
    parser.add_argument("--new", action="store_true", help="a new file, not that from which the design came")
    parser.add_argument("--measured", metavar="FILE.csv", help="measured deviations to add as lists of points")
    parser.add_argument("--member", choices=("pinion", "wheel"), help="whose they are")
    parser.add_argument(
        "--set", action="append", default=[], metavar="TABLE.KEY=VALUE", help="change a key of the design; repeatable"
    )


def run(options):
    from importlib.metadata import version

    text = designs.text_of(options.design)
    tables = designs.changed(designs.parsed(text, options.design), dict(common.setting(t) for t in options.set))
    into, stage = (None, None) if options.new else origin_of(text, options.design)
    written = file_of(tables, version("meshwright"), into, stage)
    content, report = written.content, written.report
    if (points := _measured(options)) is not None:
        added = with_points(content, options.member, points, options.rexs, stage)
        content = added.content
        report |= {kind: report[kind] + getattr(added, kind) for kind in ("assumed", "unmapped")}
    write_bytes(options.rexs, content)
    if options.json:
        write_json(options.json, report)
    else:
        print(*lines(report), sep="\n", file=sys.stderr)
    return 0


def _measured(options):
    """The measured points that are to be added, None if none are."""
    if (options.measured is None) != (options.member is None):
        raise UsageError("--measured and --member belong together: whose deviations are they? give both or neither")
    return None if options.measured is None else read_measured(options.measured)
