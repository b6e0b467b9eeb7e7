"""A page that solves the drive in the browser while its keys are dragged: one self-contained HTML file.

The drive's own generated C, compiled to WebAssembly, is in the page: it needs no network and no server. Exit status 2
if there is no compiler for it (``pip install 'meshwright[live]'``).
"""

from meshwright.base.files import write_text
from meshwright.commands import options as common
from meshwright.commands.progress import progress


def add_arguments(parser):
    common.add_design(parser)
    parser.add_argument("--html", metavar="FILE", required=True, help="write the page")


def run(options):
    from meshwright import live

    drive = common.drive_of(options)
    with progress(1) as step:
        step("compiling to WebAssembly")
        write_text(options.html, live.page(drive))
    return 0
