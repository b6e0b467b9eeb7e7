"""Results to files or to standard output; files are replaced atomically, devices and pipes are written to."""

import csv
import io
import json
import os
import sys
import tempfile
from pathlib import Path

from meshwright.errors import UsageError


def write_text(place, content):
    """Write to standard output ("-") or replace a file; an interrupted write leaves the old file."""
    if place == "-":
        sys.stdout.write(content)
    else:
        write_bytes(place, content.encode("utf-8"))


def write_bytes(place, content):
    """Replace a file, keeping its mode, or the file that a link names; an interrupted write leaves the old one.

    What is not a regular file (a device, a pipe) is written to.
    """
    path = Path(place)
    if path.is_dir():
        raise UsageError(f"{place}: a folder; name a file in it")
    try:
        if path.exists() and (not path.is_file() or path.is_relative_to("/dev")):
            path.write_bytes(content)
        else:
            _replace(path.resolve(), content)
    except OSError as error:
        raise UsageError(f"{place}: cannot be written ({error.strerror}); name a file in an existing folder") from error


def _replace(path, content):
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
        os.chmod(temporary, path.stat().st_mode & 0o7777 if path.exists() else 0o666 & ~_mask())
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def _mask():
    """The mode bits that new files of this process do without."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


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
