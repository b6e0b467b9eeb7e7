"""The folder of what is made on first use: only what is the user's own is executed or loaded from it.

A file or folder of the cache counts if the user owns it and nobody else may write to it; what is in a file, if it has
the digest with which it was written. All else is made anew, and said: a file in its place, a whole cache elsewhere.
"""

import atexit
import hashlib
import os
import shutil
import stat
import sys
import tempfile
from pathlib import Path

CACHE = "MESHWRIGHT_CACHE"

#: Mode of the folder: no other user reads or writes it.
PRIVATE = 0o700

_OTHERS = stat.S_IWGRP | stat.S_IWOTH


def cache_folder():
    """The folder; it need not exist. A private one of this process where another user may write to the cache."""
    home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    place = Path(os.environ.get(CACHE) or Path(home) / "meshwright")
    if not os.path.lexists(place) or not (reason := not_own(place.resolve())):
        return place
    fresh = Path(tempfile.mkdtemp(prefix="meshwright-"))
    os.environ[CACHE] = str(fresh)  # of the processes that this one starts, too
    atexit.register(_removed, fresh, os.getpid())
    remedy = "what is needed is made anew for this time; make the folder yours alone, or name another one in"
    say(f"{place}: {reason}, and nothing in it is used: {remedy} {CACHE}")
    return fresh


def _removed(folder, process):
    if os.getpid() == process:
        shutil.rmtree(folder, ignore_errors=True)


def say(text):
    """A line on standard error."""
    print(f"meshwright: {text}", file=sys.stderr, flush=True)


def not_own(path):
    """Why a file or folder of the cache is not the user's own, empty if it is; links are nobody's."""
    if os.name == "nt":  # a profile's folders are
        return ""
    found = os.lstat(path)
    if not (stat.S_ISREG(found.st_mode) or stat.S_ISDIR(found.st_mode)):
        return "no file and no folder"
    if found.st_uid != os.geteuid():
        return "of another user"
    return "writable by other users" if found.st_mode & _OTHERS else ""


def read_sealed(path, key):
    """The content (bytes) of a file as :func:`write_sealed` left it under this ``key``; else ValueError says why not.

    Raises FileNotFoundError where there is none.
    """
    if reason := not_own(path):
        raise ValueError(reason)
    seal, _, content = path.read_bytes().partition(b"\n")
    if seal != _seal(key, content):
        raise ValueError("damaged")
    return content


def write_sealed(path, key, content):
    """Keep a content (bytes) with its digest, atomically; others may not write to it."""
    path.parent.mkdir(parents=True, exist_ok=True, mode=PRIVATE)
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")  # of mode 600
    with os.fdopen(handle, "wb") as stream:
        stream.write(_seal(key, content) + b"\n" + content)
    os.replace(temporary, path)


def _seal(key, content):
    return hashlib.sha256(b"%d:%s:%s" % (len(key), key.encode(), content)).hexdigest().encode()
