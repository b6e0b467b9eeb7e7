"""The arithmetics of certified contact, compiled as they are and with changed error terms, for the tests.

Every variant is a copy of the same header under other names, so that one compilation serves all.
"""

import ctypes
import re
import subprocess
from pathlib import Path

import numpy as np

from meshwright.base.compile import FLAGS, compiler

C = Path(__file__).resolve().parent.parent.parent / "runtime" / "c"
BINARY = ("add", "sub", "mul", "div", "atan2")
UNARY = ("sqr", "neg", "sqrt", "magnitude", "sign")
NUMBER = {"ball": ("mw_ball", "mwc_", 2), "wide": ("mw_wide", "mwc_wide_", 3)}

_LOOPS = """
void run_{v}_{kind}_{op}(int n, const {type} *a, const {type} *b, {type} *r, {type} *s)
{{
    (void)b, (void)s;
    for (int k = 0; k < n; k++) {call};
}}
"""

_ANGLES = """
void run_angles(int n, const double *y, const double *x, double *r)
{
    for (int k = 0; k < n; k++) r[k] = mwi_angle(y[k], x[k]);
}
"""


def _calls(kind, prefix):
    type_, name, _ = NUMBER[kind]
    name = prefix + name.removeprefix("mwc_")
    for op in BINARY:
        yield op, type_, f"r[k] = {name}{op}(a[k], b[k])"
    for op in UNARY:
        yield op, type_, f"r[k] = {name}{op}(a[k])"
    yield "sincos", type_, f"{name}sincos(a[k], &r[k], &s[k])"


def _text(name):
    """A header without its guard and what it includes."""
    text = (C / "certify" / name).read_text(encoding="utf-8")
    guard = re.search(r"^#ifndef (\w+)\n", text, flags=re.MULTILINE).group(1)
    text = re.sub(rf"^#(include .*|(ifndef|define) {guard})\n", "", text, flags=re.MULTILINE)
    return text[: text.rindex("#endif")]


def library_of(folder, source, *headers):
    """The library of a text of C that includes headers of these folders, by default of the runtime."""
    path, library = folder / "tested.c", folder / "tested.so"
    path.write_text(source, encoding="utf-8")
    flags = [f for f in FLAGS if not f.startswith(("-W", "-O"))]
    command = (*compiler(), *flags, "-O1", *(f"-I{f}" for f in headers or (C,)), "-shared", path, "-o", library, "-lm")
    subprocess.run([*map(str, command)], check=True)
    return ctypes.CDLL(str(library))


def halved(text):
    r"""Name → (what a header holds, the same with one error term halved), from lines ``name: … ⟦term⟧ …``.

    ``⟦term → other⟧`` says what stands in its place; ``\n`` is the end of a line.
    """
    lines = (line.replace("\\n", "\n").partition(": ") for line in text.strip().splitlines())
    term = re.compile(r"⟦(.*?)(?: → (.*?))?⟧")
    return {name: (term.sub(r"\1", held), term.sub(lambda m: m[2] or f"0.5 * {m[1]}", held)) for name, _, held in lines}


def header(name, replaced=None):
    """A header of certify/ for a file of another folder, as it is or with one text replaced."""
    text = (C / "certify" / name).read_text(encoding="utf-8")
    if replaced:
        assert text.count(replaced[0]) == 1, (replaced[0], text.count(replaced[0]))
        text = text.replace(*replaced)
    return text.replace('#include "../mw_certify.h"', '#include "mw_certify.h"').replace('"ball.h"', '"certify/ball.h"')


def operations(folder, source, type_, calls):
    """The library of a text of C, with a function for each of ``calls`` (name → what is done with ``a[k]`` …)."""
    loops = (_LOOPS.format(v="each", kind="row", op=op, type=type_, call=call) for op, call in calls)
    return library_of(folder, f"#include <stddef.h>\n{source}{''.join(loops)}")


def run(loaded, op, a, b):
    """Rows of results of one of :func:`operations`; of ``sincos`` both."""
    arrays = [np.ascontiguousarray(x, dtype=float) for x in (a, b)] + [np.empty_like(a) for _ in range(2)]
    getattr(loaded, f"run_each_row_{op}")(len(a), *(x.ctypes.data_as(ctypes.c_void_p) for x in arrays))
    return arrays[2:] if op == "sincos" else arrays[2:3]


def compiled(folder, changes=None):
    """Variant → :class:`Arithmetic`: ``exact`` as it is and, for each name in ``changes`` (name → [(text, instead)]),
    the same with these texts of the headers replaced. A text that is not there once is an error.
    """
    sources = ['#include <math.h>\n#include "circular.h"\n#include "mw_enclosures.h"\n', _ANGLES]
    variants = {"exact": [], **(changes or {})}
    for number, (variant, replaced) in enumerate(variants.items()):
        text, prefix = _text("ball.h") + _text("wide.h"), f"v{number}_"
        for old, new in replaced:
            assert text.count(old) == 1, (variant, old, text.count(old))
            text = text.replace(old, new)
        sources.append(text.replace("mwc_", prefix).replace("MWC_", prefix.upper()))
        for kind in NUMBER:
            for op, type_, call in _calls(kind, prefix):
                sources.append(_LOOPS.format(v=f"v{number}", kind=kind, op=op, type=type_, call=call))
    library = library_of(folder, "".join(sources))
    return {variant: Arithmetic(library, f"v{number}") for number, variant in enumerate(variants)}


class Arithmetic:
    """One variant. Numbers are arrays (N, 2): mid, radius, or (N, 3): hi, lo, radius."""

    def __init__(self, loaded, name):
        self._loaded, self._name = loaded, name

    def __call__(self, kind, op, a, b=None):
        """Results (N, 2 or 3) of one operation; of ``sincos`` both."""
        width = NUMBER[kind][2]
        a = np.ascontiguousarray(a, dtype=float).reshape(-1, width)
        b = a if b is None else np.ascontiguousarray(b, dtype=float).reshape(-1, width)
        r, s = np.empty_like(a), np.empty_like(a)
        run = getattr(self._loaded, f"run_{self._name}_{kind}_{op}")
        run(len(a), *(x.ctypes.data_as(ctypes.c_void_p) for x in (a, b, r, s)))
        return (r, s) if op == "sincos" else r

    def angles(self, y, x):
        """Angles of the points (x, y), each as near as is said, not enclosed."""
        y, x, r = np.ascontiguousarray(y), np.ascontiguousarray(x), np.empty_like(y)
        self._loaded.run_angles(len(y), *(a.ctypes.data_as(ctypes.c_void_p) for a in (y, x, r)))
        return r
