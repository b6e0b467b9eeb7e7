"""``python -m derive [DRIVE…] [--output FOLDER]``: run the six stages and replace the generated files.

Without drives, everything is proved anew and every file replaced. With drives, their files alone are replaced; what
they rest on is looked up in the record that was written when everything was last proved.
"""

import argparse
import json
import sys
import time
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from derive import compiler, drives
from derive.audit import check
from derive.emit import tables
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
    known = drives.catalogue(options.drive or drives.FAMILIES)
    unknown = [name for name in options.drive if name not in known]
    if unknown:
        print(f"no drive {unknown[0]!r}; known: {', '.join(drives.catalogue())}", file=sys.stderr)
        return 2
    if options.drive:
        try:
            files = _some(options.drive)
        except check.Rejected as error:
            print(f"the audit record is damaged: {error}; python -m derive proves it anew", file=sys.stderr)
            return 2
    else:
        files = _everything(known)
        _remove_superseded(options.output, files)
    for path, text in files.items():
        replace_text(options.output / path, text)
    return 0


def _some(names):
    """The files of the drives named."""
    with log("prove", "audit record, as written"):
        record = check.read_record(compiler.ROOT / "generated" / "audit")
    return {path: text for name in names for path, text in _of_drive(record, name).items()}


def _everything(known):
    """Every generated file, all of it proved anew."""
    from derive.audit import record

    with log("prove", "audit record"):
        ledger = record.ledger()
    files = _of_drives([*known], ledger.objects)
    files |= tables.tables({name: json.loads(files[f"c/{name}.json"]) for name in known})
    with log("emit", "audit record"):
        files |= record.files(ledger, files)
    files["manifest.json"] = compiler.manifest(files)
    return files


def _of_drives(names, record):
    """The files of these drives, each made by whichever process is free; those that take longest come last."""
    from concurrent.futures import ProcessPoolExecutor

    with ProcessPoolExecutor() as processes:
        made = list(processes.map(partial(_of_drive, record), reversed(names)))
    return {path: text for files in reversed(made) for path, text in files.items()}


def _of_drive(record, name):
    with log("define", name):
        drive = drives.catalogue([name])[name]()
    return compiler.compile_drive(drive, record, log)


def _remove_superseded(folder, files):
    """Remove what an earlier run wrote there, by its manifest, and this one does not."""
    manifest = folder / "manifest.json"
    written = json.loads(manifest.read_text(encoding="utf-8"))["files"] if manifest.exists() else {}
    for path in written.keys() - files.keys():
        (folder / path).unlink(missing_ok=True)
