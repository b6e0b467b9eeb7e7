"""Results to files or to standard output; files are replaced atomically, devices and pipes are written to."""

import csv
import io
import json
import os
import sys
from contextlib import contextmanager
from pathlib import Path

from meshwright.base.errors import UsageError


def write_text(place, content):
    """Write to standard output ("-") or replace a file; an interrupted write leaves the old file."""
    if place == "-":
        sys.stdout.write(content)
    else:
        write_bytes(place, content.encode("utf-8"))


def write_bytes(place, content):
    """Write to standard output ("-") or replace a file, keeping its mode, or the file that a link names.

    An interrupted write leaves the old file. What is not a regular file (a device, a pipe) is written to.
    """
    if place == "-":
        sys.stdout.flush()
        sys.stdout.buffer.write(content)
        return
    path = Path(place)
    if path.is_dir():
        raise UsageError(f"{place}: a folder; name a file in it")
    try:
        if path.exists() and (not path.is_file() or path.is_relative_to("/dev")):
            path.write_bytes(content)
        else:
            with replaced(path.resolve()) as temporary:
                temporary.write_bytes(content)
    except OSError as error:
        raise UsageError(f"{place}: cannot be written ({error.strerror}); name a file in an existing folder") from error


@contextmanager
def replaced(path):
    """An empty file beside ``path`` that takes its place and mode at the end; after an error it is removed."""
    temporary = path.with_name(f".{path.name}.{os.urandom(8).hex()}")
    mode = path.stat().st_mode & 0o7777 if path.exists() else None
    os.close(os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666 if mode is None else 0o600))
    try:
        yield temporary
        if mode is not None:
            os.chmod(temporary, mode)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def write_json(place, data):
    """Plain data as JSON; numbers round-trip. Letters beyond ASCII are escaped where standard output has none."""
    plain = place == "-" and "utf" not in (sys.stdout.encoding or "").lower()
    write_text(place, json.dumps(data, indent=1, ensure_ascii=plain, allow_nan=False) + "\n")


def write_csv(place, header, rows):
    """A table as CSV."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    write_text(place, stream.getvalue())
