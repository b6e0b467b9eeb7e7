"""Where the pages of drives come from: the families of the tree, or a file of one's own.

Both offer ``catalogue()``: name → function that builds the drive; what follows makes no difference between them.
"""

import importlib.util
import re
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from functools import partial
from pathlib import Path
from typing import cast

from derive import drives
from derive.language.drive import Drive
from derive.language.validate_outlines import validate_outlines
from derive.refusals import Refused, told

EVERY = "all"


@dataclass(frozen=True)
class Page:
    """What builds the drive ``name``, and the file that it stands in where that is not of the tree."""

    name: str
    build: Callable[[], Drive]
    file: Path | None = None


def pages(words: Iterable[str]) -> list[Page]:
    """The pages of drives by name, of all of them, or of the drives that files define; ``Refused`` for any other."""
    return [page for word in words for page in (of_file(Path(word)) if word.endswith(".py") else _of_tree(word))]


def of_tree(names: Iterable[str]) -> list[Page]:
    """The pages of drives of the tree."""
    with told("define", "the families"):
        known = drives.catalogue(names)
    return [Page(name, known[name]) for name in names]


def _of_tree(word: str) -> list[Page]:
    with told("define", "the families"):
        every = [*drives.catalogue()] if word == EVERY else [*drives.catalogue([word])]
    if word == EVERY:
        return of_tree(every)
    if word not in every:
        every = [*drives.catalogue()]
        near = get_close_matches(word, every)
        remedy = f"did you mean {' or '.join(near)}?" if near else f"known: {', '.join(every)}"
        raise Refused(f"no drive {word!r}; {remedy}")
    return of_tree([word])


def of_file(path: Path) -> list[Page]:
    """The pages of the drives that a file defines, each built, with the outlines of families that are its own."""
    found = {name: _built(path, name, build) for name, build in catalogue_of(path).items()}
    # a family of the tree has drives beside these, and its outline is checked there
    with told("define", str(path)):
        validate_outlines(d for d in found.values() if d.family.replace("-", "_") not in drives.FAMILIES)
    return [Page(name, partial(_the, drive), path) for name, drive in found.items()]


def _the(drive: Drive) -> Drive:
    return drive


def catalogue_of(path: Path) -> dict[str, Callable[[], Drive]]:
    """The drives that a file defines: name → function that builds one."""
    if not path.is_file():
        raise Refused(f"{path}: no such file; name a Python file that offers catalogue()")
    spec = importlib.util.spec_from_file_location(f"drives_of_{path.stem}", path)
    if spec is None or spec.loader is None:
        raise Refused(f"{path}: no Python file; name one that ends in .py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    sys.path.insert(0, str(path.resolve().parent))
    try:
        with told("define", str(path)):
            spec.loader.exec_module(module)
            if not callable(getattr(module, "catalogue", None)):
                remedy = "define one that returns name → function that builds the drive"
                raise Refused(f"{path}: offers no catalogue(); {remedy}")
            offered = module.catalogue()
    finally:
        sys.path.remove(str(path.resolve().parent))
    if not isinstance(offered, dict) or not offered or not all(map(callable, offered.values())):
        raise Refused(f"{path}: catalogue() returns {offered!r}; return a dict, name → function that builds it")
    return cast("dict[str, Callable[[], Drive]]", offered)


def _built(path: Path, name: str, build: Callable[[], object]) -> Drive:
    """The drive of a name, which must be the drive's own and fit for C."""
    with told("define", f"{path}: catalogue()[{name!r}]"):
        drive = build()
    if not isinstance(drive, Drive):
        raise Refused(f"{path}: catalogue()[{name!r}] builds a {type(drive).__name__}; build a Drive")
    if drive.name != name:
        raise Refused(f"{path}: catalogue()[{name!r}] builds a drive named {drive.name!r}; give both the same name")
    if not re.fullmatch(r"[a-z][a-z0-9_]*", name):
        raise Refused(f"{path}: the drive's name {name!r} must be small letters, digits and _; rename it")
    of_tree = drives.catalogue([name]).get(name)
    if of_tree and drive.family != of_tree().family:
        raise Refused(f"{path}: the name {name!r} is that of a drive of another family; rename the drive")
    return drive
