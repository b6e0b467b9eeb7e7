"""How long it takes from a drive's definition to compiled C, and to prove and re-check the audit record."""

import json
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from derive.packaged import packaged
from tests.benchmarks.timing import FLAGS, compiler

ROOT = Path(__file__).resolve().parents[2]

#: Packaged designs of every family, whose drives are tried as if a line of a tool had been changed.
DESIGNS = (
    "recess-action-full", "plain-zc", "spherical-table-2-1", "face-worm-cylindrical-convex", "helical-crowned",
    "bevel-formate", "bevel-hypoid", "bevel-face-hobbed",
)  # fmt: skip

#: How often one drive is derived and compiled; the quickest counts, as other work slows a process down.
TURNS = 7


def report(drive):
    """Print seconds a stage for all drives and for ``drive``, then whole processes."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        log, every = _timed(sys.executable, "-m", "derive", "--output", folder / "all")
        turns = [_derived_and_compiled(drive, folder / "one") for _ in range(TURNS)]
        one, compiled, own = min(turns, key=lambda turn: turn[0] + turn[1])
        _, checked = _timed(sys.executable, "-I", "-S", folder / "all" / "audit" / "check.py")
    total, single = _seconds(log), _seconds(own)
    print(f"\nregeneration, seconds a stage on every processor: all drives, {drive} alone")
    for stage in total:
        print(f"  {stage:<9} {total[stage]:7.2f} {single[stage]:7.2f}")
    print("whole processes, seconds")
    print(f"  {every:7.2f} python -m derive")
    print(f"  {one + compiled:7.2f} python -m derive {drive} ({one:.2f}), its C compiled ({compiled:.2f}); quickest of")
    print(f"          {' '.join(f'{a + b:.2f}' for a, b, _ in turns)}")
    print(f"  {checked:7.2f} generated/audit/check.py")
    print("from a changed line of a tool to what it changes: the drive derived and compiled, meshwright tca; seconds")
    for design in DESIGNS:
        print(f"  {_tried(design):7.2f} {design}")


def _tried(design):
    """Seconds from a changed line until ``meshwright tca`` has printed its table."""
    families = json.loads((ROOT / "generated" / "families.json").read_text(encoding="utf-8"))
    (drive,) = packaged(families, [design])
    with tempfile.TemporaryDirectory() as folder:
        _, made = _timed(sys.executable, "-m", "derive", drive, "--into", folder)
        _, solved = _timed(sys.executable, "-m", "meshwright", "--drives", folder, "tca", design)
    return made + solved


def _derived_and_compiled(drive, folder):
    """Seconds of ``python -m derive`` and of the C compiler, and the log of the former."""
    log, derived = _timed(sys.executable, "-m", "derive", drive, "--output", folder)
    _, compiled = _compile(folder / "c", drive)
    return derived, compiled, log


def _timed(*command):
    begin = time.perf_counter()
    done = subprocess.run([str(part) for part in command], cwd=ROOT, capture_output=True, text=True, check=True)
    return done.stderr, time.perf_counter() - begin


def _compile(folder, drive):
    source = folder / "model.c"
    source.write_text(f'#include "{drive}.h"\nextern const mw_model *model;\nconst mw_model *model = &{drive}_model;\n')
    return _timed(*compiler(), *FLAGS, "-c", source, "-o", folder / "model.o")


def _seconds(log):
    """Stage -> seconds, from the log of ``python -m derive``."""
    seconds = {}
    for stage, time_spent in re.findall(r"^(\S+) .*? ([\d.]+) s$", log, re.MULTILINE):
        seconds[stage] = seconds.get(stage, 0.0) + float(time_spent)
    return seconds
