"""``python -m derive [DRIVE…|FILE.py…] [--output FOLDER | --into FOLDER] [--strict]``: run the six stages, write their
files.

``python -m derive show DRIVE|FILE.py [--after PASS]`` prints the description, or the program after a pass.

Without drives, the whole record is proved and the files of every packaged drive are replaced, which are those that a
packaged design uses; with ``all`` the files of all drives. With names, the files of those drives alone are replaced,
and the statements that they rest on are decided anew. ``--into`` writes a folder of drives instead, with shared objects
and an audit entry each, for ``meshwright --drives FOLDER``: of the drives named, or of those that a file outside the
tree defines.

A statement that is false or not decided of today's pages is open: it is said here, in the header, in the drive's JSON
and on its page, and nothing is cited from it. The C is written all the same, unless ``--strict`` makes it an error.
"""

import argparse
import json
import multiprocessing
import sys
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from derive import compiler, drive_folder, generated, products
from derive.audit.standing import Standings, of_ledger, standings
from derive.compiler import Compiled
from derive.emit import families
from derive.language.validate_outlines import validate_outlines
from derive.packaged import packaged
from derive.pages import EVERY, Page, of_tree, pages
from derive.refusals import Refused, told
from meshwright.base.worker import submit

#: What is known of every drive before it is derived.
FAMILIES = "families.json"
#: Exit status of what is open where ``--strict`` is given.
OPEN = 1
#: Exit status of what is refused.
REFUSED = 2


@contextmanager
def log(stage: str, name: str) -> Iterator[None]:
    """One line a stage: its name, the drive, its time."""
    begin = time.perf_counter()
    yield
    sys.stderr.write(f"{stage:<9} {name:<28} {time.perf_counter() - begin:7.3f} s\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Exit status 0; 1 with ``--strict`` where a statement is open; 2 for an unknown drive, a page that is refused, a
    damaged folder or one that cannot be written.
    """
    arguments = sys.argv[1:] if arguments is None else list(arguments)
    try:
        if arguments[:1] == ["show"]:
            return _show(arguments[1:])
        return _derive(arguments)
    except Refused as error:
        print(error, file=sys.stderr)
        return REFUSED


def _derive(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m derive", description=__doc__)
    parser.add_argument("drive", nargs="*", help="drives to compile, or all; default: those of packaged designs")
    parser.add_argument("--output", type=_folder, default=compiler.ROOT / "generated", help="folder to write")
    parser.add_argument("--into", type=_folder, metavar="FOLDER", help="write a folder of drives, compiled and audited")
    parser.add_argument("--strict", action="store_true", help="exit status 1 where a statement is open")
    options = parser.parse_args(arguments)
    try:
        if options.into:
            made = _into(options.into, options.drive)
        elif not options.drive or EVERY in options.drive:
            made = _everything(options.output, every=EVERY in options.drive)
        else:
            made = _some(options.output, options.drive)
    except OSError as error:
        raise Refused(_refused(error, options)) from error
    for compiled in made:
        for statement, reason in compiled.open.items():
            sys.stderr.write(f"open      {compiled.name:<28} {statement}: {reason}\n")
    return OPEN if options.strict and any(compiled.open for compiled in made) else 0


def _folder(word: str) -> Path:
    """A folder that is named; an empty word, as of a variable that is not set, would be the one where one is."""
    if not word:
        raise argparse.ArgumentTypeError("'' is no folder; name one, or . for this one")
    return Path(word)


def _refused(error: OSError, options: argparse.Namespace) -> str:
    """What the system refused, in words: a folder that was named, or a file of the installation."""
    folder, option = (options.into, "--into") if options.into else (options.output, "--output")
    place = Path(error.filename or folder)
    if place.resolve().is_relative_to(folder.resolve()):
        return f"{place}: cannot be written ({error.strerror}); name another folder with {option}"
    return f"{place}: cannot be read ({error.strerror}); install meshwright again, whole"


def _into(folder: Path, words: Sequence[str]) -> list[Compiled]:
    """Write the drives of names, or of files, into a folder of drives."""
    if not words:
        raise Refused("--into: no drive is named; name drives, a file that defines some, or all")
    return [drive_folder.write(page, standings, folder, log) for page in pages(words)]


def _some(folder: Path, words: Sequence[str]) -> list[Compiled]:
    """Replace the files of the drives named."""
    for word in words:
        if word.endswith(".py"):
            raise Refused(f"{word}: what a file defines is written to a folder of its own: add --into FOLDER")
    made = [compiler.compile_drive(page, standings, log, submit=submit) for page in pages(words)]
    files = {path: text for compiled in made for path, text in compiled.files.items()}
    table = folder / FAMILIES
    if table.is_file() and not all(_is_in(table, compiled) for compiled in made):
        files[FAMILIES] = families.text(_families()[0])
    generated.add(folder, files)
    return made


def _is_in(table: Path, compiled: Compiled) -> bool:
    """Whether the table of families says of a drive what was just derived; one that is damaged does not."""
    described = json.loads(compiled.files[f"c/{compiled.name}.json"])
    try:
        return families.agrees(json.loads(table.read_text(encoding="utf-8")), described, compiled.shared)
    except (ValueError, LookupError, TypeError, AttributeError):
        return False


def _everything(folder: Path, every: bool) -> list[Compiled]:
    """Replace every generated file, all of it proved anew; of the drives the packaged ones, or every one."""
    from derive.audit import record

    defined = submit(_families)
    with log("prove", "audit record"):
        ledger = record.ledger()
    table, names = defined()
    made = _compiled(of_tree(names if every else packaged(table)), of_ledger(ledger))
    files = {path: text for compiled in made for path, text in compiled.files.items()}
    files |= {FAMILIES: families.text(table), "README.md": products.readme()}
    with log("emit", "audit record"), told("emit", "the audit record"):
        files |= record.files(ledger, files)
    generated.replace(folder, files)
    return made


def _families() -> tuple[dict, list[str]]:
    """The table of families, and the names of all drives."""
    with log("define", "families"), told("define", "the families"):
        listed = [page.build() for page in pages([EVERY])]
        validate_outlines(listed)
        return families.table(listed), [drive.name for drive in listed]


def _compiled(listed: Sequence[Page], known: Standings) -> list[Compiled]:
    """Many pages, each compiled by whichever process is free; those that take longest come last."""
    with ProcessPoolExecutor(mp_context=multiprocessing.get_context("fork")) as processes:
        made = processes.map(partial(_compile, known), [page.name for page in reversed(listed)])
        return [*made][::-1]


def _compile(known: Standings, name: str) -> Compiled:
    (page,) = of_tree([name])
    return compiler.compile_drive(page, lambda names: known, log)


def _show(arguments: Sequence[str]) -> int:
    """Print the description of a drive, or its program after a pass; exit status 0, or 2 for an unknown drive."""
    from derive.emit import text
    from derive.passes.after import PASSES, routines
    from derive.passes.schedule import schedule

    parser = argparse.ArgumentParser(prog="python -m derive show", description=_show.__doc__)
    parser.add_argument("drive", help="name of a drive, or a file that defines one")
    parser.add_argument("--after", choices=[*PASSES], help="the program after this pass; default: the description")
    options = parser.parse_args(arguments)
    try:
        for page in pages([options.drive]):
            with told("define", page.name):
                drive = page.build()
            if options.after:
                with told("schedule", page.name):
                    plan = schedule(drive)
                    shown = text.program(plan, routines(plan, options.after), options.after)
            else:
                shown = text.description(drive)
            print(shown)
    except BrokenPipeError:  # who reads has seen enough
        sys.stdout = None
    return 0
