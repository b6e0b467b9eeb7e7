"""Read a design from a REXS 2 file, with a report of what was mapped, what was not, and what was assumed.

The design's first line names the file it came from: ``meshwright export`` puts the design back into that file and
keeps there what the design does not hold. --measured takes out lists of points with measured deviations of a member.
"""

import os
import sys
from pathlib import Path

from meshwright.base.errors import UsageError, plain
from meshwright.base.files import write_json, write_text
from meshwright.design import design as designs
from meshwright.rexs.document import read
from meshwright.rexs.left_out import left_out
from meshwright.rexs.measurements import points_of
from meshwright.rexs.origin import line_of
from meshwright.rexs.reading import design_of
from meshwright.rexs.report import lines
from meshwright.shop.tables import csv_text

NAME = "import"


def add_arguments(parser):
    parser.add_argument("file", metavar="FILE.rexs", help="REXS file")
    parser.add_argument("--toml", metavar="OUT|-", required=True, help="where to write the design")
    parser.add_argument("--json", metavar="REPORT|-", help="write the report (schema meshwright.rexs/1)")
    parser.add_argument("--measured", metavar="OUT.csv|-", help="write the measured deviations of --member")
    parser.add_argument("--member", choices=("pinion", "wheel"), help="whose they are")
    parser.add_argument("--stage", metavar="ID", help="the stage to read, if the file has several")


def run(options):
    if (options.measured is None) != (options.member is None):
        raise UsageError("--measured and --member belong together: whose deviations are they? give both or neither")
    document = read(options.file)
    found = design_of(document, options.stage)
    if options.measured:
        points = points_of(document, options.member, options.stage)
        write_text(options.measured, csv_text(points, {"source": options.file, "member": options.member}))
    folder = Path.cwd() if options.toml == "-" else Path(options.toml).resolve().parent
    origin = line_of(os.path.relpath(Path(options.file).resolve(), folder), options.stage)
    unheld = "".join(f"# not in the file: {plain(key)} = {value!r}\n" for key, value in left_out(document).items())
    write_text(options.toml, origin + unheld + designs.toml_text(found.tables))
    if options.json:
        write_json(options.json, found.report)
    else:
        print(*lines(found.report), sep="\n", file=sys.stderr)
    return 0
