"""What a design has and REXS does not: a remark in the file, and from it words of the report when the file is read."""

import json
import math
import re

from meshwright.design import description as metadata
from meshwright.rexs.document import MARK, RexsError

_KEY = re.compile(r"[A-Za-z0-9_.]{1,120}")
_WORD = re.compile(r"[A-Za-z0-9_ .+-]{0,60}")


def remark(values):
    """The XML remark of values by key ("table.key")."""
    listed = json.dumps(dict(sorted(values.items()))).replace("--", r"-\u002d")
    return f"<!--{MARK}{listed} -->"


def left_out(document):
    """Values by key that the remark of a document names; none without one. Raises for one that is damaged."""
    if document.remark is None:
        return {}
    start, end = document.remark
    text = document.source[start:end].decode().removeprefix(f"<!--{MARK}").removesuffix("-->")
    try:
        values = json.loads(text)
        whole = isinstance(values, dict) and all(_KEY.fullmatch(k) and _plain(v) for k, v in values.items())
    except (ValueError, RecursionError):
        whole = False
    if not whole:
        line = document.source[:start].count(b"\n") + 1
        raise RexsError(f"{document.place}, line {line}, remark on what was left out", "damaged", "remove it")
    return values


def _plain(value):
    """Whether a value is such as a design has: a word or a finite number."""
    if isinstance(value, str):
        return _WORD.fullmatch(value) is not None
    return not isinstance(value, bool) and isinstance(value, int | float) and -1e300 < value < 1e300


def named_in(tables, keys):
    """Values by key of those ``keys`` that tables give; the flank apart, which a reader of any file is told of."""
    found = {}
    for key in keys:
        table, name = metadata.table_and_key(key)
        value = tables.get(table, {}).get(name) if table != "flank" and key != "flank" else None
        if isinstance(value, str) or (value is not None and math.isfinite(value)):
            found[key] = value
    return found


def reported(family, values, tables):
    """Entries of the report on what a file's remark names and the design read from it does not have."""
    absent = family.exchange["absent"]
    for key, value in values.items():
        table, name = metadata.table_and_key(key)
        if tables.get(table, {}).get(name) is None:
            why = absent.get(key, "REXS has no attribute for it")
            reason = f"the design from which the file was written has {value!r}: {why}"
            yield {"key": key, "attribute": None, "reason": reason}
