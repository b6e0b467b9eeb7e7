"""Print the JSON Schema of design files."""

from meshwright.base.files import write_json
from meshwright.design import schema


def add_arguments(parser):
    parser.add_argument("--json", metavar="FILE|-", default="-", help="where to write; default: standard output")


def run(options):
    write_json(options.json, schema.json_schema())
    return 0
