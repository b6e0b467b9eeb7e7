"""Where drives are: folders of drives (:mod:`meshwright.base.compile` has their form).

Folders are searched in this order: those of ``--drives`` and of the environment variable ``MESHWRIGHT_DRIVES``; those
that installed packages name by entry points of the group ``meshwright.drives``, each a package whose folder holds
drives or an attribute that is a path; the package's own. A drive that its family has, but no folder, is made when it
is first asked for (:mod:`meshwright.base.first_use`).
"""

import os
import sys
from contextlib import contextmanager
from functools import cache
from pathlib import Path

from meshwright.base.errors import UsageError

SHIPPED = Path(__file__).parent.parent / "_generated"

#: Variable of the environment and entry points of packages that name folders of drives.
ENVIRONMENT = "MESHWRIGHT_DRIVES"
GROUP = "meshwright.drives"


def get_include():
    """The folder of C headers: ``<drive>.h`` needs nothing else, ``meshwright.h`` the library."""
    return str(SHIPPED / "include")


def folders(*first):
    """The folders of drives, in the order in which they are searched: the ``first`` before all others."""
    for folder in first:
        if not isinstance(folder, str | os.PathLike):
            raise UsageError(f"drives = {folder!r}: no path; name a folder of drives")
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
    from meshwright.base.first_use import derived

    return derived(name)


def object_of(name, places=None, kind=""):
    """Path of a drive's shared object; one that is missing, damaged or of other sources is compiled into the cache.

    ``places`` as in :func:`folder_of`; ``kind``: "" the drive itself or, as file names end, "_in_lanes", "_proofs".
    """
    folder = folder_of(name, places)
    path = folder / f"{name}{kind}.so"
    if folder == SHIPPED and path.exists():
        return path
    from meshwright.base.first_use import compiled

    return compiled(name, folder, kind)
