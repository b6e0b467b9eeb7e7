"""Where drives are: folders of drives (:mod:`meshwright.base.compile` has their form), and what is made on first use.

Folders are searched in this order: those of ``--drives`` and of the environment variable ``MESHWRIGHT_DRIVES``; those
that installed packages name by entry points of the group ``meshwright.drives``, each a package whose folder holds
drives or an attribute that is a path; the package's own. A drive that its family has, but no folder, is derived into
the cache (``MESHWRIGHT_CACHE``, else ``$XDG_CACHE_HOME/meshwright`` or ``~/.cache/meshwright``) when first asked for.
"""

import importlib.util
import json
import os
import shutil
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from functools import cache
from pathlib import Path

from meshwright.base import compile as build
from meshwright.base import files
from meshwright.base.errors import LibraryError, UsageError

SHIPPED = Path(__file__).parent.parent / "_generated"
ENVIRONMENT, CACHE, GROUP = "MESHWRIGHT_DRIVES", "MESHWRIGHT_CACHE", "meshwright.drives"

#: File of a folder of the cache that lists what is in it.
SEAL = "sealed.json"


def folders(*first):
    """The folders of drives, in the order in which they are searched: the ``first`` before all others."""
    places = tuple(Path(folder).absolute() for folder in first)
    for folder, place in zip(first, places, strict=True):
        if not place.is_dir():
            raise UsageError(f"drives = {folder}: no such folder; `python -m derive FILE.py --into {folder}` makes one")
    return tuple(dict.fromkeys((*places, *_folders(os.environ.get(ENVIRONMENT, "")))))


@contextmanager
def searched_first(named):
    """For the time of a command, the folders ``named`` are searched first, also by the processes that it starts."""
    before = os.environ.get(ENVIRONMENT)
    if named:
        os.environ[ENVIRONMENT] = os.pathsep.join(map(str, folders(*named)[:-1]))
    try:
        yield
    finally:
        if before is None:
            os.environ.pop(ENVIRONMENT, None)
        else:
            os.environ[ENVIRONMENT] = before


@cache
def _folders(named):
    given = [Path(path) for path in named.split(os.pathsep) if path]
    for folder in given:
        if not folder.is_dir():
            raise UsageError(f"{ENVIRONMENT} = {folder}: no such folder; take it out or make it")
    return (*given, *_installed(), SHIPPED)


def _installed():
    """Folders of installed packages that offer drives."""
    if not _any_entry_point():
        return []
    from importlib.metadata import entry_points

    return [_folder_of(point.load()) for point in entry_points(group=GROUP)]


def _any_entry_point():
    """Whether an installed package has an entry point of the group; importlib.metadata takes ten times as long."""
    section = f"[{GROUP}]".encode()
    listed = (path for place in sys.path for path in Path(place or ".").glob("*-info/entry_points.txt"))
    return any(section in path.read_bytes() for path in listed)


def _folder_of(offered):
    return Path(offered.__path__[0]) if hasattr(offered, "__path__") else Path(offered)


def folder_of(name, places=None):
    """The folder that holds a drive; one that no folder holds is derived, compiled and kept in the cache.

    ``places`` are the folders to search, by default :func:`folders`.
    """
    for folder in places or folders():
        if (folder / f"{name}.json").exists():
            return folder
    return _derived(name)


def object_of(name, places=None):
    """Path of a drive's shared object; one that is missing, damaged or of other sources is compiled into the cache.

    ``places`` as in :func:`folder_of`.
    """
    folder = folder_of(name, places)
    path = folder / f"{name}.so"
    if folder == SHIPPED and path.exists():
        return path
    _check_headers(name, folder)
    inputs = build.inputs(name, folder, SHIPPED)
    if build.sealed(path).get("inputs") == inputs:
        return path
    _check_layout(name, folder)

    def compiled(place):
        shutil.copytree(folder / "include", place / "include")
        with tempfile.TemporaryDirectory() as objects:
            build.drives([name], place, SHIPPED, Path(objects))

    return _kept(f"{name}-{inputs[:16]}", f"compiling {name}", compiled) / f"{name}.so"


def _check_headers(name, folder):
    """A folder of drives has every generated header of a drive that this package compiles."""
    if not all((folder / "include" / pattern.format(name)).exists() for pattern in build.GENERATED):
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


def _derived(name):
    found = importlib.util.find_spec("derive")
    if found is None or importlib.util.find_spec("sympy") is None:
        raise LibraryError(
            f"the drive {name} is not built and must be derived first: `pip install 'meshwright[derive]'`, "
            f"or `make build DRIVES={name}` in a checkout"
        )
    root = Path(found.origin).parent
    sources = sorted(path for pattern in ("*.py", "*.jinja") for path in root.rglob(pattern))
    key = build.digest(name, str(SHIPPED), *sources, *build.shared(SHIPPED))

    def derived(place):
        command = [sys.executable, "-m", "derive", name, "--into", str(place)]
        environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(root.parent), *filter(None, sys.path)])}
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        if done.returncode:
            raise LibraryError(f"{name} could not be derived: {done.stderr.strip()}")

    return _kept(f"{name}-{key[:16]}", f"deriving and compiling {name}", derived)


def _kept(entry, what, make):
    """A folder of the cache, filled by ``make(folder)`` once among all processes, and anew where it is not whole."""
    place = _cache() / entry
    if _whole(place):
        return place
    with _locked(place.with_name(f"{entry}.lock")):
        if _whole(place):
            return place
        print(f"meshwright: {what} (first use; kept in {place})", file=sys.stderr, flush=True)
        with tempfile.TemporaryDirectory(dir=place.parent, prefix=f".{entry}.") as beside:
            fresh = Path(beside) / "fresh"
            fresh.mkdir()
            try:
                make(fresh)
            except build.CompileError as error:
                raise LibraryError(str(error)) from None
            (fresh / SEAL).write_text(json.dumps(_sums(fresh), indent=1), encoding="utf-8")
            if place.exists():
                place.rename(Path(beside) / "damaged")
            fresh.rename(place)
    return place


def _sums(folder):
    """Relative path → digest of every file of a folder but its seal."""
    files = sorted(path for path in folder.rglob("*") if path.is_file() and path.name != SEAL)
    return {str(path.relative_to(folder)): build.digest(path) for path in files}


def _whole(folder):
    """Whether a folder of the cache is as it was written."""
    try:
        return json.loads((folder / SEAL).read_text(encoding="utf-8")) == _sums(folder)
    except (OSError, ValueError):
        return False


def cache_folder():
    """The folder of what is made on first use; it need not exist."""
    home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(os.environ.get(CACHE) or Path(home) / "meshwright")


def _cache():
    place = cache_folder()
    try:
        place.mkdir(parents=True, exist_ok=True)
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
