"""The parts of the C runtime that each generated header repeats, so that a copy of it is enough.

They are the same text under the same guards in every header, and the text from which the library is built.
"""

import re
from functools import cache

_INCLUDE = re.compile(r'^#include "(.+)"\n', re.MULTILINE)
_COMMENT = re.compile(r"[ \t]*/\*.*?\*/", re.DOTALL)
#: Headers of the solver that need all others.
ROOTS = ("complete.h", "cycle.h", "self_test.h")
#: Headers that each generated one repeats before its own text.
TABLES = ("mw_device.h", "mw_arithmetic.h", "mw_model.h", "mw_status.h")
_EMPTY = re.compile(r"\n(?:[ \t]*\n)+")


@cache
def tables(runtime):
    """What the arithmetic must be, model table and statuses, as their headers in the folder ``runtime`` have them."""
    return "".join((runtime / name).read_text(encoding="utf-8") + "\n" for name in TABLES)


@cache
def solver(runtime):
    """The solver behind ``X_complete`` and ``X_solve``, in order, without its comments."""
    seen = set()
    texts = (text for name in ROOTS for text in _needed((runtime / "solver" / name).resolve(), seen))
    return "".join(map(_bare, texts))


@cache
def arithmetic(runtime):
    """Numbers with error bounds, in order, without the comments."""
    texts = [(runtime / name).read_text(encoding="utf-8") for name in ("circular.h", "mw_enclosures.h")]
    texts += [_INCLUDE.sub("", _certify(runtime, name)) for name in ("ball.h", "wide.h", "units.h", "lane.h")]
    return "".join(map(_bare, texts))


@cache
def test(runtime):
    """The test of existence and uniqueness at MW_LANES points, without its comments."""
    return _bare(_INCLUDE.sub("", _certify(runtime, "point.h")))


def _certify(runtime, name):
    return (runtime / "certify" / name).read_text(encoding="utf-8")


def _bare(text):
    """A header's text without comments and empty lines."""
    return _EMPTY.sub("\n", _COMMENT.sub("", text))


def _needed(path, seen):
    """Texts of the solver's headers, each after those that it includes."""
    if path in seen or path.parent.name != "solver":
        return
    seen.add(path)
    text = path.read_text(encoding="utf-8")
    for name in _INCLUDE.findall(text):
        yield from _needed((path.parent / name).resolve(), seen)
    yield _INCLUDE.sub("", text)
