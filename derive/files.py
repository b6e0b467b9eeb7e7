"""Replace files atomically: a reader sees the old text or the new, never a part."""

import os
import tempfile
from pathlib import Path


def replace_text(path: Path, text: str):
    """Write ``text`` to ``path`` by way of a temporary file in the same folder; equal text is left alone."""
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=".")
    try:
        with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as stream:
            stream.write(text)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise
