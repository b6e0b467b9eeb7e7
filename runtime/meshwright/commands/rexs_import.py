"""Read a design from a REXS 2 file, with a report of what was mapped, what was not, and what was assumed.

The design's first line names the file it came from: ``meshwright export`` puts the design back into that file and
keeps there what the design does not hold.
"""

import os
import sys
from pathlib import Path

from meshwright.base.files import write_json, write_text
from meshwright.design import design as designs
from meshwright.rexs.document import read
from meshwright.rexs.origin import line_of
from meshwright.rexs.reading import design_of
from meshwright.rexs.report import lines

NAME = "import"


def add_arguments(parser):
    parser.add_argument("file", metavar="FILE.rexs", help="REXS file")
    parser.add_argument("--toml", metavar="OUT|-", required=True, help="where to write the design")
    parser.add_argument("--json", metavar="REPORT|-", help="write the report (schema meshwright.rexs/1)")
    parser.add_argument("--stage", metavar="ID", help="the stage to read, if the file has several")


def run(options):
    found = design_of(read(options.file), options.stage)
    folder = Path.cwd() if options.toml == "-" else Path(options.toml).resolve().parent
    origin = line_of(os.path.relpath(Path(options.file).resolve(), folder), options.stage)
    write_text(options.toml, origin + designs.toml_text(found.tables))
    if options.json:
        write_json(options.json, found.report)
    else:
        print(*lines(found.report), sep="\n", file=sys.stderr)
    return 0
