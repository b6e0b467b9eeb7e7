"""Write a design as a REXS 2 file, with a report of what was mapped, what was not, and what was assumed.

A design that came from a REXS file is put back into it: what the design does not hold stays there as it was. --new
writes a file of its own instead.
"""

import sys

from meshwright.base.files import write_bytes, write_json
from meshwright.commands import options as common
from meshwright.design import design as designs
from meshwright.rexs.origin import origin_of
from meshwright.rexs.report import lines
from meshwright.rexs.writing import file_of

NAME = "export"


def add_arguments(parser):
    parser.add_argument("design", metavar="DESIGN", help="packaged design or TOML file")
    parser.add_argument("--rexs", metavar="OUT|-", required=True, help="where to write the file")
    parser.add_argument("--json", metavar="REPORT|-", help="write the report (schema meshwright.rexs/1)")
    parser.add_argument("--new", action="store_true", help="a new file, not that from which the design came")
    parser.add_argument(
        "--set", action="append", default=[], metavar="TABLE.KEY=VALUE", help="change a key of the design; repeatable"
    )


def run(options):
    from importlib.metadata import version

    text = designs.text_of(options.design)
    tables = designs.changed(designs.parsed(text, options.design), dict(common.setting(t) for t in options.set))
    into, stage = (None, None) if options.new else origin_of(text, options.design)
    written = file_of(tables, version("meshwright"), into, stage)
    write_bytes(options.rexs, written.content)
    if options.json:
        write_json(options.json, written.report)
    else:
        print(*lines(written.report), sep="\n", file=sys.stderr)
    return 0
