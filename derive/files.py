"""Replace files atomically: a reader sees the old text or the new, never a part."""

import os
import tempfile
from pathlib import Path

#: Ending of the temporary files, whose names begin with a dot.
PART = ".part"


def remove_parts(folder: Path):
    """Remove what killed processes left of :func:`replace_text` below a folder."""
    for part in folder.rglob(f".*{PART}"):
        part.unlink(missing_ok=True)


def replace_text(path: Path, text: str):
    """Write ``text`` to ``path`` by way of a temporary file in the same folder; equal text is left alone."""
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=PART)
    try:
        with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as stream:
            stream.write(text)
            stream.flush()
            os.fsync(stream.fileno())
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise
