"""A folder of drives, ready for ``meshwright --drives FOLDER``: compiled as they are printed, with an audit entry each.

It has the form of :mod:`meshwright.base.compile`, with the entry in ``audit/<drive>.json``.
"""

import json
import re
import sys
import tempfile
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

from derive import compiler, products
from derive.audit.checker.refusal import UNREADABLE, Rejected, Undecided
from derive.audit.provenance import Decide
from derive.files import replace_text
from derive.pages import Page
from derive.refusals import Refused
from meshwright.base.worker import submit

#: What the checker may find: it computed both sides and they agree, or they do not, or it could not compute them.
HOLDS, FAILS, OPEN = "holds", "does not hold", "not decided"


def write(page: Page, decide: Decide, folder: Path, log: compiler.Log) -> compiler.Compiled:
    """Derive the drive of a page into a folder and compile it."""
    from meshwright.base import compile as build

    name = page.name
    found: list[Callable[[], dict[str, str]]] = []
    with tempfile.TemporaryDirectory() as temporary:
        fresh, objects = Path(temporary, "drives"), Path(temporary, "objects")
        with build.Begun(name, fresh, compiler.package(), objects) as begun:

            def emitted(path: str, text: str) -> None:
                if path == f"c/{name}.h":  # before anything is compiled: no thread is there yet to be copied
                    found.append(submit(partial(checked, text)))
                if path.endswith(".h"):
                    replace_text(fresh / _place(path), text)
                    begun.written(Path(path).name)

            made = compiler.compile_drive(page, decide, log, emitted, submit)
            described = json.loads(made.files[f"c/{name}.json"])
            with log("audit", name):
                entry = audit_entry(described, found[0](), page.file)
            if left := undecided_or_wrong(entry):
                sys.stderr.write(f"{left}; see {folder / 'audit' / f'{name}.json'}\n")
            with log("compile", name):
                begun.wait()
                try:
                    build.drives([name], fresh, compiler.package(), objects, parts=(build.DRIVE,))
                except build.CompileError as error:
                    raise _not_compiled(name, fresh / "include", str(error)) from error
        # what the table of families says of those of the tree
        described |= made.shared
        files = {**made.files, f"c/{name}.json": json.dumps(described, indent=1, ensure_ascii=False) + "\n"}
        for path, text in files.items():
            replace_text(folder / _place(path), text)
        replace_text(folder / "audit" / f"{name}.json", json.dumps(entry, indent=1, ensure_ascii=False) + "\n")
        build.moved(name, fresh, folder)
        # what is beside it was compiled from what was there before
        build.drop_superseded([name], folder, compiler.package())
    return made


#: The first line in which a C compiler says what is wrong.
WRONG = re.compile(r"^\S*?(\w+\.[ch]):(\d+):(?:\d+:)? error: (.*)$", re.MULTILINE)


def _not_compiled(name, headers, said):
    """What a C compiler says first of a drive, by the function of the description in which it stands."""
    found = WRONG.search(said)
    if found is None:
        return Refused(f"{name}: {said}")
    file, line, what = found.groups()
    where = f"{file}, line {line}"
    if (headers / file).is_file():
        lines = (headers / file).read_text("utf-8").splitlines()[: int(line)]
        begun = re.findall(rf"^(?:MW_\w+ )?static [^;=]*\b{name}_(\w+)\(", "\n".join(lines), re.MULTILINE)
        where = f"the function {begun[-1]}, {where}" if begun else where
    return Refused(
        f"{name}: the C that is made of the description does not compile: {where}: {what}; give what is named there "
        "another name in the description, or what it lacks"
    )


def _place(path):
    """Where a folder of drives has a generated file."""
    kind, name = path.split("/", 1)
    if kind == "descriptions":
        return path
    return f"include/{name}" if kind == "c" and name.endswith(".h") else name


def audit_entry(description: Mapping, found: Mapping[str, str], source: Path | None) -> dict:
    """What is proved for a drive and what is not, as plain data.

    ``proved``: the statements behind it, by the functions that rest on them, and their ``keys``. ``not_proved``:
    statements that it names and that are open, with the reason. ``checked``: see :func:`checked`; ``counts`` how many
    of these checks found what. ``not_checked``: what nothing here decides.
    """
    origin = None if source is None else {"file": source.name, "sha256": products.sha256(source.read_text("utf-8"))}
    return {
        "schema": "meshwright.drive-audit/1",
        "drive": description["name"],
        "specification_hash": description["specification_hash"],
        "source": origin,
        "proved": {
            key: sorted(name for name, keys in description["equations_of"].items() if key in keys)
            for key in description["equations"]
        },
        "keys": description["keys"],
        "not_proved": description["open"],
        "checked": found,
        "counts": {word: sum(verdict.startswith(word) for verdict in found.values()) for word in (HOLDS, FAILS, OPEN)},
        "not_checked": [
            "that the description is the drive that is meant: compare it with a source, or with measured parts",
            "conversions of keys, rules and derived sizes: their formulas are taken from the description as they are",
            "start values and limits of the flanks",
            "curvatures of a flank that keeps an equation of meshing beside it",
            "generated files beside the header: lanes, changes of parameters, bounded and certified flanks, CasADi",
        ],
    }


def undecided_or_wrong(entry):
    """What the checks of an audit entry found, counted, in words; "" where all holds."""
    counts = entry["counts"]
    if counts[HOLDS] == len(entry["checked"]) > 0:
        return ""
    found = ", ".join(f"{count} {word}" for word, count in counts.items() if count)
    return f"{entry['drive']}: checks of the generated C: {found}"


def checked(header):
    """What a drive's generated C was found to be by running it modulo a prime (:mod:`derive.audit.checker.check_code`):
    words → "holds", "does not hold" or, of what the checker does not foresee, "not decided", with the reason.
    """
    from derive.audit.checker import check_code, straight_line  # not loaded where no drive is checked

    try:
        checks = [*check_code.checks_of(straight_line.read_header(header))]
    except (Rejected, *UNREADABLE) as reason:
        return {"generated C as it is read": f"{OPEN}: {_said(reason)}"}
    return {words: _verdict(check) for words, check in checks}


def _verdict(check):
    from derive.audit.checker import attempts

    try:
        attempts.attempt(*check)
    except Undecided as reason:
        return f"{OPEN}: {reason}"
    except Rejected as reason:
        return f"{FAILS}: {reason}"
    except UNREADABLE as reason:
        return f"{OPEN}: {_said(reason)}"
    return HOLDS


def _said(reason):
    """What ended a checker, where that may be an error of Python's with nothing but a key."""
    return str(reason) if isinstance(reason, Rejected) else f"{type(reason).__name__}: {reason}"
