"""The REXS file that a design came from, named in the design's first line."""

import json
import re
from pathlib import Path

from meshwright.base.errors import UsageError
from meshwright.rexs.document import read

_LINE = re.compile(r'# REXS: (?P<file>"(?:[^"\\]|\\.)*")(?:, stage (?P<stage>"(?:[^"\\]|\\.)*"))?$')


def line_of(path, stage):
    """The first line of a design that came from the file at ``path`` (from the design's folder)."""
    named = f", stage {json.dumps(stage)}" if stage is not None else ""
    return f"# REXS: {json.dumps(str(path), ensure_ascii=False)}{named}\n"


def origin_of(text, place):
    """(document, id of its stage or None) that a design's text, found at ``place``, names; (None, None) if none."""
    match = _LINE.fullmatch(text.partition("\n")[0].rstrip("\r"))
    if match is None:
        return None, None
    path = Path(place).parent / json.loads(match["file"])
    if not path.is_file():
        raise UsageError(f"{path}: the REXS file that {place} came from is not there; put it there, or add --new")
    return read(path), match["stage"] and json.loads(match["stage"])
