"""Files of bounded size are read; results go to files, replaced atomically, to devices, pipes or standard output."""

import csv
import errno
import io
import json
import os
import re
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

from meshwright.base.errors import UsageError

#: Name of a file on its way to another's place.
_PART = re.compile(r"\..+\.[0-9a-f]{16}")


def read_bytes(path, largest, refused, smaller):
    """The content of a file of ``largest`` bytes at the most; of what cannot be read or is longer, with the remedy
    ``smaller``, the exception ``refused(reason, remedy)`` is raised.
    """
    try:
        with open(path, "rb") as stream:
            content = stream.read(largest + 1)
    except OSError as error:
        raise refused(f"cannot be read ({error.strerror})", "name a readable file") from error
    if len(content) > largest:
        raise refused(f"longer than {largest} bytes", smaller)
    return content


def read_table(path, largest, what):
    """The lines of a CSV file in UTF-8, with or without a byte order mark; ``what``: which file is asked for."""

    def refused(reason, remedy):
        return UsageError(f"{path}: {reason}; {remedy}")

    try:
        return read_bytes(path, largest, refused, f"name {what}").decode("utf-8-sig").splitlines()
    except UnicodeDecodeError as error:
        raise refused("not a text file", "save it as CSV in UTF-8") from error


def write_text(place, content):
    """Write to standard output ("-") or replace a file; an interrupted write leaves the old file."""
    with written(place) as write:
        write(content)


def write_bytes(place, content):
    """Write to standard output ("-") or replace a file, keeping its mode, or the file that a link names.

    An interrupted write leaves the old file. What is not a regular file (a device, a pipe) is written to.
    """
    if place == "-":
        sys.stdout.flush()
        sys.stdout.buffer.write(content)
        return
    with _opened(place) as stream:
        stream.write(content)


@contextmanager
def written(place):
    """Function of a text that writes it to standard output ("-") or to what replaces a file at the end; after an error
    the old file is left.
    """
    if place == "-":
        yield sys.stdout.write
        return
    with _opened(place) as stream:
        yield lambda text: stream.write(text.encode("utf-8"))


@contextmanager
def _opened(place):
    """A stream of bytes into a device or pipe, or into what replaces a file at the end."""
    path = Path(place)
    if path.is_dir():
        raise UsageError(f"{place}: a folder; name a file in it")
    try:
        if path.exists() and (not path.is_file() or path.is_relative_to("/dev")):
            with open(path, "wb") as stream:
                yield stream
        else:
            with replaced(path.resolve()) as temporary, open(temporary, "wb") as stream:
                yield stream
    except OSError as error:
        raise UsageError(f"{place}: cannot be written ({error.strerror}); {remedy(error)}") from error


def remedy(error):
    """What helps against an :class:`OSError` in writing."""
    if error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
        return "make room, or name a file elsewhere"
    return "name a file in an existing folder"


@contextmanager
def replaced(path):
    """An empty file beside ``path`` that takes its place and mode at the end; after an error it is removed.

    Its content is on the disk before it takes the place, so that a power cut leaves the old file or the new one.
    """
    temporary = path.with_name(f".{path.name}.{os.urandom(8).hex()}")
    mode = path.stat().st_mode & 0o7777 if path.exists() else None
    os.close(os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666 if mode is None else 0o600))
    try:
        yield temporary
        if mode is not None:
            os.chmod(temporary, mode)
        _to_disk(temporary)
        os.replace(temporary, path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def remove_parts(folder):
    """Remove what killed processes left of :func:`replaced` in ``folder``; for whoever holds the folder's lock."""
    for part in folder.glob(".*"):
        if _PART.fullmatch(part.name):
            part.unlink(missing_ok=True)


def _to_disk(path):
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


@contextmanager
def locked(folder, what):
    """Keep other processes from working in ``folder`` meanwhile; raises :class:`UsageError` if one does already.

    The lock is the operating system's and ends with the process, however that ends.
    """
    with open(folder / ".lock", "ab") as stream:
        try:
            lock(stream)
        except OSError as error:
            remedy = "wait for it to end, or name another folder"
            raise UsageError(f"{folder}: another {what} is at work here; {remedy}") from error
        yield


def lock(stream, wait=False):
    """Lock an open file until it is closed; raises :class:`OSError` if it is locked elsewhere, unless told to wait."""
    if os.name == "nt":
        import msvcrt

        stream.seek(0)
        while True:
            try:
                msvcrt.locking(stream.fileno(), msvcrt.LK_NBLCK, 1)
                break
            except OSError:
                if not wait:
                    raise
                time.sleep(0.1)
    else:
        import fcntl

        fcntl.flock(stream, fcntl.LOCK_EX if wait else fcntl.LOCK_EX | fcntl.LOCK_NB)


def write_json(place, data):
    """Plain data as JSON; numbers round-trip. Letters beyond ASCII are escaped where standard output has none."""
    write_text(place, json.dumps(data, indent=1, ensure_ascii=_is_plain(place), allow_nan=False) + "\n")


def _is_plain(place):
    return place == "-" and "utf" not in (sys.stdout.encoding or "").lower()


@contextmanager
def json_list(place, data, name):
    """Function of a list that adds its entries, a line each, to the list ``name`` behind the plain ``data`` as JSON."""
    plain = _is_plain(place)
    encoded = json.JSONEncoder(ensure_ascii=plain, allow_nan=False).encode
    with written(place) as write:
        write(json.dumps(data, indent=1, ensure_ascii=plain, allow_nan=False)[:-2] + f',\n "{name}": [')
        begun = False

        def add(entries):
            nonlocal begun
            if entries:
                write((",\n  " if begun else "\n  ") + ",\n  ".join(map(encoded, entries)))
            begun |= bool(entries)

        yield add
        write("\n ]\n}\n" if begun else "]\n}\n")


def write_csv(place, header, rows):
    """A table as CSV."""
    write_text(place, _lines([header, *rows]))


def _lines(rows):
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows(rows)
    return stream.getvalue()


@contextmanager
def csv_table(place):
    """Function of a list of dictionaries that adds them as rows of a CSV table, whose columns are all names that occur,
    in the order in which they do; its lines wait in a temporary file for the last.
    """
    header, parts = {}, []
    with tempfile.TemporaryFile("w+", encoding="utf-8", newline="") as kept:

        def add(rows):
            header.update(dict.fromkeys(key for row in rows for key in row))
            parts.append((len(rows), len(header)))
            kept.write(_lines([[row.get(key, "") for key in header] for row in rows]))

        yield add
        kept.seek(0)
        with written(place) as write:
            write(_lines([header]))
            for count, columns in parts:
                missing = "," * (len(header) - columns) + "\n"
                for _ in range(count):
                    write(kept.readline().rstrip("\n") + missing)
