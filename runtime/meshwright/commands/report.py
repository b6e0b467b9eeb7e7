"""A page that an engineer reads: figures, tables and the teeth in contact, in one self-contained HTML file.

Exit status 1 if a position has no contact, or one that bodies cannot make; contact along a line is a result.
"""

from meshwright.base.errors import UsageError
from meshwright.base.files import write_text
from meshwright.commands import options as common
from meshwright.commands.progress import progress

FORMATS = ("pdf", "svg", "png")


def add_arguments(parser):
    common.add_design(parser)
    common.add_friction(parser)
    parser.add_argument(
        "--marking-um", type=common.positive, metavar="UM",
        help="thickness of the marking compound of the composite pattern; default: the design's separation",
    )  # fmt: skip
    parser.add_argument(
        "--misalign", action="append", default=[], metavar="KEY=SIZE",
        help="size of a misalignment whose effect is shown, in the unit of its key; repeatable",
    )  # fmt: skip
    parser.add_argument("--html", metavar="FILE", help="write the page")
    parser.add_argument("--figures", metavar="FOLDER", help="write the figures for print, one file each")
    parser.add_argument("--format", choices=FORMATS, default="pdf", help="of the figures for print")


def run(options):
    if not options.html and not options.figures:
        raise UsageError("report: nothing to write; give --html FILE, --figures FOLDER or both")
    report = _report()
    drive, friction = common.drive_of(options), common.friction_of(options)
    marking = None if options.marking_um is None else options.marking_um / 1000.0
    sizes = dict(_misalignment(text) for text in options.misalign)
    with progress(report.steps(drive) + 1) as step:
        analysis = report.analyse(drive, step, friction, marking, sizes)
        step("figures")
        if options.html:
            write_text(options.html, report.page(analysis))
        if options.figures:
            report.write_figures(analysis, options.figures, options.format)
    return 0 if analysis.tca.complete else 1


def _misalignment(text):
    """``KEY=SIZE`` as (key, number)."""
    key, _, size = text.partition("=")
    try:
        return key.strip(), float(size)
    except ValueError as error:
        raise UsageError(f"--misalign {text}: not KEY=SIZE with a number; for example vertical_deg=0.05") from error


def _report():
    """The report package, whose drawing libraries are an extra."""
    try:
        from meshwright import report
    except ModuleNotFoundError as error:
        remedy = "`pip install 'meshwright[plot]'` brings it"
        raise UsageError(f"report: {error.name} is not installed; {remedy}") from error
    return report
