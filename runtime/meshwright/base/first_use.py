"""What is made on first use: a drive that no folder holds is derived, one without its shared object is compiled.

Both are kept in the cache (``MESHWRIGHT_CACHE``, else ``$XDG_CACHE_HOME/meshwright`` or ``~/.cache/meshwright``), which
must be the user's own (:mod:`meshwright.base.cache`).
"""

import importlib.util
import json
import os
import shutil
import stat
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from pathlib import Path

from meshwright.base import compile as build
from meshwright.base import files
from meshwright.base.cache import CACHE, PRIVATE, cache_folder, not_own, say
from meshwright.base.drives import SHIPPED
from meshwright.base.errors import LibraryError

#: File of a folder of the cache that lists what is in it.
SEAL = "sealed.json"


def compiled(name, folder, kind=""):
    """Path of a shared object of a drive in ``folder``, or of the one that is made of its sources into the cache.

    ``kind``: the ending of the name of a :class:`~meshwright.base.compile.Part`.
    """
    (part,) = (part for part in build.PARTS if part.ending == kind)
    object_ = f"{name}{kind}"
    path = folder / f"{object_}.so"
    _check_headers(name, folder)
    inputs = build.inputs(name, folder, SHIPPED)
    if build.sealed(path).get("inputs") == inputs:
        return path
    _check_layout(name, folder)

    def made(place):
        (place / "include").mkdir()
        for header in build.headers(name, folder):
            shutil.copy(header, place / "include")
        with tempfile.TemporaryDirectory() as objects:
            build.drives([name], place, SHIPPED, Path(objects), parts=(part,))

    return _kept(f"{object_}-{inputs[:16]}", f"compiling {object_}", made) / f"{object_}.so"


def _check_headers(name, folder):
    """A folder of drives has every generated header of a drive that this package compiles."""
    if not all(header.exists() for header in build.headers(name, folder)):
        raise _OtherVersion(name, folder)


def _check_layout(name, folder):
    """A header repeats the model table's declaration: it must be that of this package."""
    declared = (SHIPPED / "include" / "mw_model.h").read_text(encoding="utf-8")
    if declared not in (folder / "include" / f"{name}.h").read_text(encoding="utf-8"):
        raise _OtherVersion(name, folder)


class _OtherVersion(LibraryError):
    """A drive was derived for a package that expects other files of it."""

    def __init__(self, name, folder):
        super().__init__(
            f"{folder}: {name} was derived for another version of meshwright; `python -m derive` it again into that "
            "folder"
        )


def derived(name):
    """The folder of the cache that holds a drive, derived and compiled into it where it is not there yet."""
    found = importlib.util.find_spec("derive")
    if found is None or importlib.util.find_spec("sympy") is None:
        raise LibraryError(
            f"the drive {name} is not built and must be derived first: `pip install 'meshwright[derive]'`, "
            f"or `make build DRIVES={name}` in a checkout"
        )
    root = Path(found.origin).parent
    sources = sorted(path for pattern in ("*.py", "*.jinja") for path in root.rglob(pattern))
    key = build.digest(name, str(SHIPPED), *sources, *build.shared(SHIPPED))

    def made(place):
        command = [sys.executable, "-m", "derive", name, "--into", str(place)]
        environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(root.parent), *filter(None, sys.path)])}
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        if done.returncode:
            raise LibraryError(f"{name} could not be derived: {done.stderr.strip()}")

    return _kept(f"{name}-{key[:16]}", f"deriving and compiling {name}", made)


def _kept(entry, what, make):
    """A folder of the cache, filled by ``make(folder)`` once among all processes, and anew where it is not whole."""
    place = _cache() / entry
    if _whole(place):
        return place
    with _locked(place.with_name(f"{entry}.lock")):
        if _whole(place):
            return place
        say(f"{what} ({'damaged or not yours alone: made anew' if place.exists() else 'first use'}; kept in {place})")
        with tempfile.TemporaryDirectory(dir=place.parent, prefix=f".{entry}.") as beside:
            fresh = Path(beside) / "fresh"
            fresh.mkdir(PRIVATE)
            try:
                make(fresh)
            except build.CompileError as error:
                raise LibraryError(str(error)) from None
            (fresh / SEAL).write_text(json.dumps(_sums(fresh), indent=1), encoding="utf-8")
            for path in fresh.rglob("*"):
                path.chmod(stat.S_IMODE(path.stat().st_mode) & ~(stat.S_IWGRP | stat.S_IWOTH))
            if os.path.lexists(place):
                place.rename(Path(beside) / "damaged")
            fresh.rename(place)
    return place


def _sums(folder):
    """Relative path → digest of every file of a folder but its seal."""
    files = sorted(path for path in folder.rglob("*") if path.is_file() and path.name != SEAL)
    return {str(path.relative_to(folder)): build.digest(path) for path in files}


def _whole(folder):
    """Whether a folder of the cache is as it was written, and the user's own with all that is in it."""
    try:
        if not_own(folder) or any(map(not_own, folder.rglob("*"))):
            return False
        return json.loads((folder / SEAL).read_text(encoding="utf-8")) == _sums(folder)
    except (OSError, ValueError):
        return False


def _cache():
    place = cache_folder()
    try:
        place.mkdir(PRIVATE, parents=True, exist_ok=True)
    except OSError as error:
        remedy = f"name a folder for built drives in {CACHE}"
        raise LibraryError(f"{place}: cannot be made ({error.strerror}); {remedy}") from error
    return place


@contextmanager
def _locked(path):
    """Hold a lock among all processes; the one that dies lets go of it."""
    with open(path, "ab") as lock:
        files.lock(lock, wait=True)
        yield
