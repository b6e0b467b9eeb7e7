"""Print a design file: a packaged design, to copy and change, or any other; with --solved, every derived size too."""

from meshwright.base.files import write_json, write_text
from meshwright.commands import options as common
from meshwright.design import design as designs


def add_arguments(parser):
    common.add_design(parser)
    parser.add_argument("--solved", action="store_true", help="with defaults and derived sizes, as JSON")
    parser.add_argument("--out", metavar="FILE|-", default="-", help="where to write; default: standard output")


def run(options):
    if options.solved:
        write_json(options.out, common.drive_of(options).design.as_solved())
    elif options.set:
        write_text(options.out, designs.toml_text(common.drive_of(options).design.given()))
    else:
        text = designs.text_of(options.design)
        designs.check(designs.parsed(text, options.design))
        write_text(options.out, text)
    return 0
