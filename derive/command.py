"""``python -m derive [DRIVE…|FILE.py] [--output FOLDER | --into FOLDER]``: run the six stages, write their files.

``python -m derive show DRIVE|FILE.py [--after PASS]`` prints the description, or the program after a pass.

Without drives, everything is proved anew and the files of every packaged drive are replaced, which are those that a
packaged design uses; with ``all`` the files of all drives. With names, the files of those drives alone are replaced;
what they rest on is looked up in the record that was written when everything was last proved. ``--into`` writes a
folder of drives instead, with shared objects and an audit entry each, for ``meshwright --drives FOLDER``: of the drives
named, or of those that a file outside the tree defines.
"""

import argparse
import json
import sys
import time
from contextlib import contextmanager
from difflib import get_close_matches
from functools import partial
from pathlib import Path

from derive import beside, compiler, drives, outside, products
from derive.audit.checker.record import read_record
from derive.audit.checker.refusal import Rejected
from derive.audit.provenance import Proved
from derive.emit import families
from derive.files import remove_parts, replace_text
from derive.language.refusal import DescriptionError
from derive.language.validate_outlines import validate_outlines
from derive.packaged import packaged
from derive.passes.guards import Unguarded
from meshwright.base.compile import CompileError

EVERY = "all"


@contextmanager
def log(stage, name):
    """One line a stage: its name, the drive, its time."""
    begin = time.perf_counter()
    yield
    sys.stderr.write(f"{stage:<9} {name:<28} {time.perf_counter() - begin:7.3f} s\n")


def show(arguments):
    """Print the description of a drive, or its program after a pass; exit status 0, or 2 for an unknown drive."""
    from derive.emit import text
    from derive.passes.after import PASSES, routines
    from derive.passes.schedule import schedule

    parser = argparse.ArgumentParser(prog="python -m derive show", description=show.__doc__)
    parser.add_argument("drive", help="name of a drive, or a file that defines one")
    parser.add_argument("--after", choices=[*PASSES], help="the program after this pass; default: the description")
    options = parser.parse_args(arguments)
    try:
        for drive in _built(options.drive):
            if options.after:
                plan = schedule(drive)
                print(text.program(plan, routines(plan, options.after), options.after))
            else:
                print(text.description(drive))
    except BrokenPipeError:  # who reads has seen enough
        sys.stdout = None
    except (outside.FileError, DescriptionError) as error:
        print(error, file=sys.stderr)
        return 2
    return 0


def _built(word):
    """The drives of a name or of a file outside the tree."""
    if word.endswith(".py"):
        path = Path(word)
        return (outside.built(path, name, build) for name, build in outside.catalogue_of(path).items())
    (name,) = _known([word])
    return (drives.catalogue([name])[name](),)


def main(arguments=None):
    """Exit status 0, or 2 for an unknown drive, a description that contradicts itself, a damaged folder or one that
    cannot be written.
    """
    arguments = sys.argv[1:] if arguments is None else list(arguments)
    if arguments[:1] == ["show"]:
        return show(arguments[1:])
    parser = argparse.ArgumentParser(prog="python -m derive", description=__doc__)
    parser.add_argument("drive", nargs="*", help="drives to compile, or all; default: those of packaged designs")
    parser.add_argument("--output", type=Path, default=compiler.ROOT / "generated", help="folder to write")
    parser.add_argument("--into", type=Path, metavar="FOLDER", help="write a folder of drives, compiled and audited")
    options = parser.parse_args(arguments)
    try:
        if options.into:
            _into(options.into, options.drive)
        elif not options.drive or EVERY in options.drive:
            files = _everything(every=EVERY in options.drive)
            _remove_superseded(options.output, files)
            _replace(options.output, files)
        else:
            files = _some(_known(options.drive))
            remove_parts(options.output)
            _replace(options.output, files)
            _list_in_manifest(options.output, files)
    except Rejected as error:
        print(f"the audit record is damaged: {error}; python -m derive proves it anew", file=sys.stderr)
        return 2
    except OSError as error:
        print(_refused(error, options), file=sys.stderr)
        return 2
    except (outside.FileError, DescriptionError, Unguarded, CompileError, DamagedManifest) as error:
        print(error, file=sys.stderr)
        return 2
    return 0


def _refused(error, options):
    """What the system refused, in words: a folder that was named, or a file of the installation."""
    folder, option = (options.into, "--into") if options.into else (options.output, "--output")
    place = Path(error.filename or folder)
    if place.resolve().is_relative_to(folder.resolve()):
        return f"{place}: cannot be written ({error.strerror}); name another folder with {option}"
    return f"{place}: cannot be read ({error.strerror}); install meshwright again, whole"


def _known(names):
    """The names, if they are of drives of the tree."""
    known = drives.catalogue(names)
    for name in names:
        if name.endswith(".py"):
            raise outside.FileError(f"{name}: what a file defines is written to a folder of its own: add --into FOLDER")
        if name not in known:
            every = [*drives.catalogue()]
            near = get_close_matches(name, every)
            remedy = f"did you mean {' or '.join(near)}?" if near else f"known: {', '.join(every)}"
            raise outside.FileError(f"no drive {name!r}; {remedy}")
    return names


def _into(folder, words):
    """Write the drives of names, or of files, into a folder of drives."""
    if not words:
        raise outside.FileError("--into: no drive is named; name drives, a file that defines some, or all")
    proved = beside.begun(_proved)
    for word in [*drives.catalogue()] if EVERY in words else words:
        if word.endswith(".py"):
            path = Path(word)
            listed = [outside.built(path, name, build) for name, build in outside.catalogue_of(path).items()]
            # a family of the tree has drives beside these, and its outline is checked there
            validate_outlines(d for d in listed if d.family.replace("-", "_") not in drives.FAMILIES)
            for drive in listed:
                outside.write(lambda drive=drive: drive, drive.name, proved, folder, log, path)
        else:
            (name,) = _known([word])
            outside.write(drives.catalogue([name])[name], name, proved, folder, log)


def _replace(folder, files):
    for path, text in files.items():
        replace_text(folder / path, text)


def _some(names):
    """The files of the drives named."""
    proved = beside.begun(_proved)
    return {path: text for name in names for path, text in _compiled(name, proved, beside.begun).items()}


def _proved():
    if not (compiler.RECORD / "certificates.jsonl").exists():  # git does not keep them
        from derive.audit import record

        with log("prove", "audit record"):
            return Proved.by(record.ledger().objects)
    with log("prove", "audit record, as written"):
        return Proved.by(read_record(compiler.RECORD))


def _everything(every):
    """Every generated file, all of it proved anew; of the drives the packaged ones, or every one."""
    from derive.audit import record

    def proved():
        with log("prove", "audit record"):
            return record.ledger()

    proving = beside.begun(proved)
    with log("define", "families"):
        known = drives.catalogue()
        listed = [build() for build in known.values()]
        validate_outlines(listed)
        table = families.table(listed)
    ledger = proving()
    files = _of_drives([*known] if every else packaged(table), Proved.by(ledger.objects))
    files |= {"families.json": families.text(table), "README.md": products.readme()}
    with log("emit", "audit record"):
        files |= record.files(ledger, files)
    files["manifest.json"] = products.manifest(files)
    return files


def _of_drives(names, proved):
    """The files of these drives, each made by whichever process is free; those that take longest come last."""
    from concurrent.futures import ProcessPoolExecutor

    with ProcessPoolExecutor() as processes:
        made = list(processes.map(partial(_of_drive, proved), reversed(names)))
    return {path: text for files in reversed(made) for path, text in files.items()}


def _of_drive(proved, name):
    return _compiled(name, lambda: proved)


def _compiled(name, proved, *begun):
    return compiler.compile_drive(drives.catalogue([name])[name], name, proved, log, None, None, *begun)


def _written(folder):
    """Path → hash of what earlier runs wrote there, by the manifest."""
    manifest = folder / "manifest.json"
    if not manifest.exists():
        return {}
    try:
        files = json.loads(manifest.read_text(encoding="utf-8"))["files"]
        outside = [path for path in files if Path(path).is_absolute() or ".." in Path(path).parts]
    except (ValueError, KeyError, TypeError) as error:
        raise DamagedManifest(f"{manifest} is damaged ({error}): remove it; what it listed stays then") from error
    if outside:
        raise DamagedManifest(f"{manifest} names {outside[0]}, which is outside its folder: remove it")
    return files


class DamagedManifest(ValueError):
    """The list of what an earlier run wrote cannot be believed."""


def _remove_superseded(folder, files):
    """Remove what earlier runs wrote there and this one does not."""
    for path in _written(folder).keys() - files.keys():
        (folder / path).unlink(missing_ok=True)
    remove_parts(folder)


def _list_in_manifest(folder, files):
    """Add the files of some drives to a folder's manifest."""
    written = _written(folder)
    if written and (now := written | products.hashes(files)) != written:
        replace_text(folder / "manifest.json", products.manifest_of(now))
