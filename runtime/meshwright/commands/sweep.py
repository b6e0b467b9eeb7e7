"""Trace one design under many misalignments and parameter values.

Rows go to slices in a folder, whose sweep.json names statuses and flags; an interrupted sweep goes on where it stopped.
Exit status 1 if a point has no contact, or one that bodies cannot make; contact along a line is a result.
"""

import math
import re
import sys

from meshwright.base.errors import UsageError
from meshwright.base.files import write_json, write_text
from meshwright.commands import options as common
from meshwright.design import design as designs
from meshwright.sweep import run as sweep
from meshwright.sweep.device import DEVICES

_FORMS = "low:high or normal:mean:deviation"


def add_arguments(parser):
    parser.add_argument("design", metavar="DESIGN", help="packaged design or TOML file")
    parser.add_argument("--set", action="append", default=[], metavar="TABLE.KEY=VALUE", help="change a key")
    parser.add_argument("--vary", action="append", required=True, metavar="TABLE.KEY=RANGE", help=_FORMS)
    how = parser.add_mutually_exclusive_group(required=True)
    how.add_argument("--samples", type=int, metavar="N", help="random samples")
    how.add_argument("--grid", type=int, metavar="N", help="levels of every varied key, all combined")
    parser.add_argument("--seed", type=int, default=0, help="of the random samples; default 0")
    common.add_angles(parser)
    parser.add_argument("--out", required=True, metavar="FOLDER", help="where the slices are written")
    parser.add_argument("--format", choices=("parquet", "csv"), default="parquet")
    parser.add_argument(
        "--portable", action="store_true", help="rows with the same bits on every machine, at a third of the speed"
    )
    parser.add_argument(
        "--device", choices=("cpu", *DEVICES), default="cpu",
        help="cuda: trace on a GPU; the rows are those of --portable, which it implies",
    )  # fmt: skip
    parser.add_argument("--threads", type=int, metavar="N", help="default: one a processor")
    parser.add_argument(
        "--scheduler", nargs="?", const="local", metavar="ADDRESS",
        help="hand slices to a Dask cluster at this address; without an address, to an embedded local one",
    )  # fmt: skip
    parser.add_argument(
        "--json", metavar="FILE|-", help="write the summary as JSON; without it: a table on a terminal, JSON in a pipe"
    )


def run(options):
    plan = _plan(options)
    with _Progress(plan.slices) as advance:
        device = options.device if options.device in DEVICES else None
        summary = sweep.run(plan, options.out, options.format, options.threads, options.scheduler, advance, device)
    if options.json is None and sys.stdout.isatty():
        write_text("-", _table(summary, options.out))
    else:
        write_json(options.json or "-", {"schema": "meshwright.sweep/1", **summary})
    return 0 if summary["points_touching"] == summary["points"] else 1


def _table(summary, folder):
    """The summary for a reader: counts, then quantiles over the complete samples."""
    lines = [f"{summary['samples']} samples, {summary['samples_complete']} complete; rows are in {folder}"]
    lines += [f"  {count} points {word}" for word, count in summary["points_by_status"].items()]
    if summary["points_impossible"]:
        lines.append(f"  {summary['points_impossible']} of them are points that bodies cannot make")
    if summary["peak_to_peak_arcsec"] is not None:
        lines.append("quantile".rjust(10) + "peak to peak, arcsec".rjust(24))
        rows = zip(summary["quantiles"], summary["peak_to_peak_arcsec"], strict=True)
        lines += [f"{quantile:>10.2f}{value:>24.5f}" for quantile, value in rows]
    return "\n".join(lines) + "\n"


def _plan(options):
    changes = dict(common.setting(text) for text in options.set)
    tables = designs.changed(designs.read(options.design), changes)
    for name in ("samples", "grid", "threads"):
        value = getattr(options, name)
        if value is not None and value < 1:
            raise UsageError(f"--{name} {value}: must be at least 1")
    angles = common.angles_of(options, common.Drive.from_tables(tables))
    variations = tuple(_variation(text) for text in options.vary)
    portable = options.portable or options.device in DEVICES
    how = (options.samples or 0, options.grid or 0, options.seed, portable)
    return sweep.Plan(tables, variations, tuple(map(float, angles)), *how)


def _variation(text):
    key, _, words = text.partition("=")
    kind, values = ("normal", words.removeprefix("normal:")) if words.startswith("normal:") else ("uniform", words)
    match = re.fullmatch(r"([^:]+):([^:]+)", values)
    try:
        numbers = tuple(map(float, match.groups()))
    except (AttributeError, ValueError):
        raise UsageError(f"--vary {text}: not TABLE.KEY={_FORMS}") from None
    if not all(map(math.isfinite, numbers)):
        raise UsageError(f"--vary {text}: a bound is not finite; give finite numbers")
    return sweep.Variation(key.strip(), kind, *numbers)


class _Progress:
    """A bar on a terminal, nothing in a pipe."""

    def __init__(self, total):
        self.total = total

    def __enter__(self):
        from rich.console import Console
        from rich.progress import Progress

        self.bar = Progress(console=Console(stderr=True), disable=not sys.stderr.isatty())
        self.bar.start()
        task = self.bar.add_task("sweep", total=self.total)
        return lambda: self.bar.advance(task)

    def __exit__(self, *_):
        self.bar.stop()
