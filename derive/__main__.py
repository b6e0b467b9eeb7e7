"""``python -m derive [DRIVE…] [--output FOLDER]``: run the six stages and replace the generated files."""

import argparse
import json
import sys
import time
from contextlib import contextmanager
from pathlib import Path

from derive import compiler, drives
from derive.audit import record
from derive.emit import external, lanes, sensitivity
from derive.files import replace_text


@contextmanager
def log(stage, name):
    """One line a stage: its name, the drive, its time."""
    begin = time.perf_counter()
    yield
    print(f"{stage:<9} {name:<28} {time.perf_counter() - begin:7.3f} s", file=sys.stderr)


def main(arguments=None):
    """Exit status 0, or 2 for an unknown drive."""
    parser = argparse.ArgumentParser(prog="python -m derive", description=__doc__)
    parser.add_argument("drive", nargs="*", help="drives to compile; default: all")
    parser.add_argument("--output", type=Path, default=compiler.ROOT / "generated", help="folder to write")
    options = parser.parse_args(arguments)
    known = drives.catalogue()
    unknown = [name for name in options.drive if name not in known]
    if unknown:
        print(f"no drive {unknown[0]!r}; known: {', '.join(known)}", file=sys.stderr)
        return 2
    with log("prove", "audit record"):
        ledger = record.ledger()
    files = {}
    for name in options.drive or known:
        with log("define", name):
            drive = known[name]()
        files |= compiler.compile_drive(drive, ledger, log)
    if not options.drive:
        files["c/models.h"] = compiler.table_of_models(known)
        files["c/lane_models.h"] = lanes.table_of_models(known)
        files["c/sensitivity_models.h"] = sensitivity.table_of_models(known)
        shapes = {name: json.loads(files[f"c/{name}.json"])["shapes"] for name in known}
        files["c/casadi_models.h"] = external.table(shapes.items())
        with log("emit", "audit record"):
            files |= record.files(ledger, files)
        files["manifest.json"] = compiler.manifest(files)
        _remove_superseded(options.output, files)
    for path, text in files.items():
        replace_text(options.output / path, text)
    return 0


def _remove_superseded(folder, files):
    for path in folder.glob("*/*"):
        if path.is_file() and path.relative_to(folder).as_posix() not in files:
            path.unlink()


if __name__ == "__main__":
    sys.exit(main())
