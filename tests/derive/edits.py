"""One-line edits of the tree's pages, drawn at random: a sign, a function, a number, a name, a word that is missing.

An edited page is right or wrong physics, or no Python at all; the compiler must compile it or refuse it in words.
"""

import ast
import os
import random
import shutil
import subprocess
import sys
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
#: Page → a drive that it makes.
PAGES = {
    "tools/straight_blade.py": "cylindrical_worm_zn_zn",
    "tools/axial_blade.py": "cylindrical_worm_za_za",
    "tools/involute.py": "cylindrical_worm_zi_zi",
    "tools/grinding.py": "cylindrical_worm_zk_zk",
    "tools/grinding_disc.py": "cylindrical_worm_zk_zn",
    "tools/grinding_arc.py": "cylindrical_worm_zc_zc",
    "tools/tip_rounding.py": "cylindrical_worm_zn_zn",
    "tools/worm_body.py": "cylindrical_worm_za_za",
    "tools/rack_section.py": "spherical_convex_concave",
    "tools/basic_rack.py": "cylindrical_gears",
    "tools/cutter_blade.py": "bevel_face_hobbed",
    "tools/head_cutter.py": "bevel_generated",
    "drives/cylindrical_worm.py": "cylindrical_worm_zn_zn",
    "drives/cylindrical_worm_functions.py": "cylindrical_worm_zn_zn",
    "drives/cylindrical_worm_keys.py": "cylindrical_worm_za_za",
    "drives/rack_and_pinion.py": "cylindrical_worm_zi_zi",
    "drives/spherical.py": "spherical_convex_spur",
    "drives/spherical_keys.py": "spherical_convex_convex",
    "drives/cylindrical_gears.py": "cylindrical_gears",
    "drives/cylindrical_gears_keys.py": "cylindrical_gears",
    "drives/bevel.py": "bevel_formate",
    "drives/bevel_keys.py": "bevel_generated",
    "drives/face_worm.py": "face_worm",
    "drives/face_worm_keys.py": "face_worm",
}


@dataclass(frozen=True)
class Edit:
    """In a page, what stands in a line between two columns, and what stands there instead."""

    page: str
    line: int
    first: int
    last: int
    new: str

    @property
    def drive(self):
        """A drive that the page makes."""
        return PAGES[self.page]

    def __str__(self):
        lines = (ROOT / "derive" / self.page).read_bytes().splitlines()
        old = lines[self.line - 1][self.first : self.last].decode()
        return f"{self.page}:{self.line}: {old!r} -> {self.new!r}"


def edits(seed):
    """Without end, edits in an order that the seed gives, over all pages in turn."""
    rng = random.Random(seed)
    found = {page: _of(page) for page in PAGES}
    while True:
        for page in rng.sample(sorted(PAGES), len(PAGES)):
            yield rng.choice(rng.choice([*found[page].values()]))


def _of(page):
    """All edits of a page, by what is changed."""
    source = (ROOT / "derive" / page).read_text(encoding="utf-8")
    lines, found = source.splitlines(), {}
    for node in ast.walk(ast.parse(source)):
        if getattr(node, "lineno", 0) != getattr(node, "end_lineno", -1):
            continue
        for first, last, new in changes(node, lines[node.lineno - 1]):
            found.setdefault(type(node).__name__, []).append(Edit(page, node.lineno, first, last, new))
    return found


def changes(node, line):
    begin, end = node.col_offset, node.end_col_offset
    raw = line.encode()
    match node:
        case ast.BinOp(left=left, right=right, op=op) if left.end_lineno == right.lineno == node.lineno:
            between = raw[left.end_col_offset : right.col_offset].decode()
            exchanged = {ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*")}
            if type(op) in exchanged:
                old, new = exchanged[type(op)]
                yield left.end_col_offset, right.col_offset, between.replace(old, new)
                yield end, end, f" {old} {raw[left.col_offset : left.end_col_offset].decode()}"
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            yield begin, operand.col_offset, ""
        case ast.Call(func=ast.Attribute(attr="sin" | "cos" | "tan" as name) as function):
            other = {"sin": "cos", "cos": "sin", "tan": "sin"}[name]
            yield function.end_col_offset - len(name), function.end_col_offset, other
        case ast.Call(args=[first, second, *_]) if first.end_lineno == second.lineno == node.lineno:
            both = [raw[a.col_offset : a.end_col_offset].decode() for a in (first, second)]
            yield first.col_offset, second.end_col_offset, f"{both[1]}, {both[0]}"
            yield first.end_col_offset, second.end_col_offset, ""
        case ast.Constant(value=int() as number) if not isinstance(number, bool):
            yield begin, end, str(number + 1)
        case ast.Constant(value=str() as text) if text and len(text) < 40:
            yield begin, end, repr(text + "x")
        case ast.Name(id=name) if isinstance(node.ctx, ast.Load):
            yield begin, end, f"{name}_"
        case ast.keyword(value=value):
            yield value.col_offset, value.end_col_offset, "None"


@dataclass(frozen=True)
class Outcome:
    """How an edited page was answered: exit status, what was said, the folder that was written."""

    status: int
    said: str
    folder: Path

    @property
    def header(self):
        """The text of the one header without ending, or None."""
        found = [path for path in self.folder.glob("c/*.h") if not path.stem.endswith(_PARTS)]
        return found[0].read_text(encoding="utf-8") if found else None


_PARTS = ("_lanes", "_sensitivity", "_bounded", "_certified", "_certify")


def copy_of_tree(folder):
    """A copy of the compiler that may be edited, beside the runtime as it is."""
    shutil.copytree(ROOT / "derive", folder / "derive", ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("runtime", "generated"):
        (folder / name).symlink_to(ROOT / name)
    return folder


@contextmanager
def changed(tree, page, change):
    """A page of the tree as ``change`` makes it of its text, for the time being."""
    path = tree / "derive" / page
    before = path.read_text(encoding="utf-8")
    path.write_text(change(before), encoding="utf-8")
    try:
        yield
    finally:
        path.write_text(before, encoding="utf-8")


def compiled(tree, edit, output, *options):
    """``python -m derive`` of the edited page's drive in a copy of the tree, which is as it was afterwards."""

    def change(text):
        lines = text.splitlines(keepends=True)
        line = lines[edit.line - 1].encode()
        lines[edit.line - 1] = (line[: edit.first] + edit.new.encode() + line[edit.last :]).decode()
        return "".join(lines)

    with changed(tree, edit.page, change):
        return derived(tree, edit.drive, "--output", output, *options)


def derived(tree, *words):
    """``python -m derive`` in a copy of the tree; the folder is that after ``--output``."""
    paths = os.pathsep.join([str(tree), str(ROOT / "runtime")])
    command = [sys.executable, "-m", "derive", *map(str, words)]
    done = subprocess.run(command, cwd=tree, env=os.environ | {"PYTHONPATH": paths}, capture_output=True, text=True)
    return Outcome(done.returncode, done.stderr, Path(words[words.index("--output") + 1]))
