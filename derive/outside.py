"""Drives in a folder of their own: derived, compiled and audited, ready for ``meshwright --drives FOLDER``.

A file outside the tree offers, as the families of :mod:`derive.drives` do, ``catalogue()``: name → function that builds
the drive. What comes out has the form of :mod:`meshwright.base.compile`, with an audit entry beside each description.
"""

import importlib.util
import json
import re
import sys
import tempfile
from functools import partial
from pathlib import Path

from derive import beside, compiler, drives, products
from derive.audit.checker.refusal import UNREADABLE, Rejected, Undecided
from derive.emit import families
from derive.files import replace_text
from derive.language.drive import Drive
from derive.language.refusal import DescriptionError

#: What the checker may find: it computed both sides and they agree, or they do not, or it could not compute them.
HOLDS, FAILS, OPEN = "holds", "does not hold", "not decided"


class FileError(ValueError):
    """A file that does not define drives; says why."""


def catalogue_of(path):
    """The drives that a file defines: name → function that builds one."""
    if not path.is_file():
        raise FileError(f"{path}: no such file; name a Python file that offers catalogue()")
    spec = importlib.util.spec_from_file_location(f"drives_of_{path.stem}", path)
    if spec is None or spec.loader is None:
        raise FileError(f"{path}: no Python file; name one that ends in .py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    sys.path.insert(0, str(path.resolve().parent))
    try:
        spec.loader.exec_module(module)
    except SyntaxError as error:
        raise FileError(f"{path}, line {error.lineno}: {error.msg}; correct the line") from error
    except OSError as error:
        raise FileError(f"{path}: {error.filename}: {error.strerror}; give what the file reads") from error
    finally:
        sys.path.remove(str(path.resolve().parent))
    if not callable(getattr(module, "catalogue", None)):
        raise FileError(f"{path}: offers no catalogue(); define one that returns name → function that builds the drive")
    offered = module.catalogue()
    if not isinstance(offered, dict) or not offered or not all(map(callable, offered.values())):
        raise FileError(f"{path}: catalogue() returns {offered!r}; return a dict, name → function that builds it")
    return offered


def built(path, name, build):
    """The drive of a name, which must be the drive's own and fit for C."""
    try:
        drive = build()
    except DescriptionError:
        raise
    except ValueError as error:  # what the language refuses
        raise FileError(f"{path}: catalogue()[{name!r}]: {error}") from error
    if not isinstance(drive, Drive):
        raise FileError(f"{path}: catalogue()[{name!r}] builds a {type(drive).__name__}; build a Drive")
    if drive.name != name:
        raise FileError(f"{path}: catalogue()[{name!r}] builds a drive named {drive.name!r}; give both the same name")
    if not re.fullmatch(r"[a-z][a-z0-9_]*", name):
        raise FileError(f"{path}: the drive's name {name!r} must be small letters, digits and _; rename it")
    of_tree = drives.catalogue([name]).get(name)
    if of_tree and drive.family != of_tree().family:
        raise FileError(f"{path}: the name {name!r} is that of a drive of another family; rename the drive")
    return drive


def write(page, name, proved, folder, log, source=None):
    """Derive the drive ``name`` that ``page`` builds into a folder and compile it; ``proved`` is as in
    :func:`derive.compiler.compile_drive`, ``source`` the file that defines the drive, if it is not of the tree.
    """
    from meshwright.base import compile as build

    open_, made, found = {}, [], []

    def kept():
        made.append(page())
        return made[0]

    with tempfile.TemporaryDirectory() as temporary:
        fresh, objects = Path(temporary, "drives"), Path(temporary, "objects")
        with build.Begun(name, fresh, compiler.package(), objects) as begun:

            def emitted(path, text):
                if path == f"c/{name}.h":  # the first of all: no thread is there yet to be copied
                    found.append(beside.begun(partial(checked, text)))
                if path.endswith(".h"):
                    replace_text(fresh / _place(path), text)
                    begun.written(Path(path).name)

            files = compiler.compile_drive(kept, name, proved, log, open_, emitted, beside.begun)
            described = json.loads(files[f"c/{name}.json"])
            with log("audit", name):
                entry = audit_entry(described, open_, found[0](), source)
            if left := undecided_or_wrong(entry):
                sys.stderr.write(f"{left}; see {folder / 'audit' / f'{name}.json'}\n")
            with log("compile", name):
                begun.wait()
                try:
                    build.drives([name], fresh, compiler.package(), objects, parts=(build.DRIVE,))
                except build.CompileError as error:
                    raise _not_compiled(name, fresh / "include", str(error)) from error
        # what the table of families says of those of the tree
        described |= families.shared(made)
        files[f"c/{name}.json"] = json.dumps(described, indent=1, ensure_ascii=False) + "\n"
        for path, text in files.items():
            replace_text(folder / _place(path), text)
        replace_text(folder / "audit" / f"{name}.json", json.dumps(entry, indent=1, ensure_ascii=False) + "\n")
        build.moved(name, fresh, folder)
        # what is beside it was compiled from what was there before
        build.drop_superseded([name], folder, compiler.package())


#: The first line in which a C compiler says what is wrong.
WRONG = re.compile(r"^\S*?(\w+\.[ch]):(\d+):(?:\d+:)? error: (.*)$", re.MULTILINE)


def _not_compiled(name, headers, said):
    """What a C compiler says first of a drive, by the function of the description in which it stands."""
    found = WRONG.search(said)
    if found is None:
        return FileError(f"{name}: {said}")
    file, line, what = found.groups()
    where = f"{file}, line {line}"
    if (headers / file).is_file():
        lines = (headers / file).read_text("utf-8").splitlines()[: int(line)]
        begun = re.findall(rf"^static [^;=]*\b{name}_(\w+)\(", "\n".join(lines), re.MULTILINE)
        where = f"the function {begun[-1]}, {where}" if begun else where
    return FileError(
        f"{name}: the C that is made of the description does not compile: {where}: {what}; give what is named there "
        "another name in the description, or what it lacks"
    )


def _place(path):
    """Where a folder of drives has a generated file."""
    kind, name = path.split("/", 1)
    if kind == "descriptions":
        return path
    return f"include/{name}" if kind == "c" and name.endswith(".h") else name


def audit_entry(description, open_, found, source):
    """What is proved for a drive and what is not, as plain data.

    ``proved``: the statements of the audit record behind it, by the functions that rest on them. ``not_proved``:
    statements that it names and the record does not prove, with the reason. ``checked``: see :func:`checked`;
    ``counts`` how many of these checks found what. ``not_checked``: what nothing here decides.
    """
    origin = None if source is None else {"file": source.name, "sha256": products.sha256(source.read_text("utf-8"))}
    return {
        "schema": "meshwright.drive-audit/1",
        "drive": description["name"],
        "specification_hash": description["specification_hash"],
        "source": origin,
        "record": description["root_hash"],
        "proved": {
            key: sorted(name for name, keys in description["equations_of"].items() if key in keys)
            for key in description["equations"]
        },
        "not_proved": open_,
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
