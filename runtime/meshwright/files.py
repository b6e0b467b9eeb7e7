"""Results to files or to standard output; files are replaced atomically."""

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
    """Replace a file; an interrupted write leaves the old one."""
    path = Path(place)
    try:
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    except OSError as error:
        raise UsageError(f"{place}: cannot be written ({error.strerror}); name a file in an existing folder") from error
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def write_json(place, data):
    """Plain data as JSON; numbers round-trip."""
    write_text(place, json.dumps(data, indent=1, ensure_ascii=False, allow_nan=False) + "\n")


def write_csv(place, header, rows):
    """A table as CSV."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    write_text(place, stream.getvalue())
