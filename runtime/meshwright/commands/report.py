"""A page that an engineer reads: figures, tables and the teeth in contact, in one self-contained HTML file.

Exit status 1 if a position has no contact, or one that bodies cannot make; contact along a line is a result.
"""

from dataclasses import replace

import numpy as np

from meshwright.base.aside import aside
from meshwright.base.errors import UsageError
from meshwright.base.files import write_text
from meshwright.commands import loaded, loading
from meshwright.commands import options as common
from meshwright.commands.progress import progress
from meshwright.cycle.pairs import Mesh

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
    parser.add_argument(
        "--torque-nm", type=common.positive, metavar="T",
        help="adds error, load share and pressure under this torque over one pitch, in some seconds",
    )  # fmt: skip
    parser.add_argument("--torque-on", choices=("pinion", "wheel"), help="whose torque it is; default: the usual one")
    parser.set_defaults(pairs=None, rim_mm=None)
    parser.add_argument("--html", metavar="FILE", help="write the page")
    parser.add_argument("--figures", metavar="FOLDER", help="write the figures for print, one file each")
    parser.add_argument("--format", choices=FORMATS, default="pdf", help="of the figures for print")


def run(options):
    if not options.html and not options.figures:
        raise UsageError("report: nothing to write; give --html FILE, --figures FOLDER or both")
    drive, friction = common.drive_of(options), common.friction_of(options)
    marking = None if options.marking_um is None else options.marking_um / 1000.0
    sizes = dict(_misalignment(text) for text in options.misalign)
    angles = _loaded_angles(options, drive)
    Mesh.of(drive)  # the window of contact, which the copy needs as well
    with aside(drive.crossings) as crossings:  # while the drawing libraries are imported
        report = _report()
        with progress(report.steps(drive) + 1 + (loaded.STEPS + len(angles) if len(angles) else 0)) as step:
            analysis = report.analyse(drive, step, friction, marking, sizes, crossings)
            if len(angles):
                _, document = loaded.solved(loading.finite_elements(), options, drive, angles, step)
                analysis = replace(analysis, loaded=document)
            step("figures")
            if options.html:
                write_text(options.html, report.page(analysis))
            if options.figures:
                report.write_figures(analysis, options.figures, options.format)
    return 0 if analysis.tca.complete else 1


def _loaded_angles(options, drive):
    """The pinion angles of the loaded contact, rad; none without a torque."""
    if options.torque_nm is None:
        if options.torque_on is not None:
            raise UsageError(f"--torque-on {options.torque_on}: of which torque? give --torque-nm")
        return ()
    loading.finite_elements()
    return drive.about_the_middle(np.linspace(-0.5, 0.5, 13))


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
        _leave_artists_undescribed()
        from meshwright import report
    except ModuleNotFoundError as error:
        remedy = "`pip install 'meshwright[plot]'` brings it"
        raise UsageError(f"report: {error.name} is not installed; {remedy}") from error
    return report


def _leave_artists_undescribed():
    """Matplotlib writes a docstring for every kind of artist while it is imported, longer than it draws a figure."""
    from matplotlib import artist

    artist.Artist._update_set_signature_and_doc = classmethod(lambda kind: None)
