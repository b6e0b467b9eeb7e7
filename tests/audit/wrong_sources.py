"""Wrong physics in the sources: one edit of a drive, tool, rule, pass or printer at a time, in a copy of the tree.

Each edit is generated anew, of one drive that uses the file, and put before the checkers alone. What the derivation
itself refuses (it does not run, or one of its own checks fails) is counted apart, and so is what changes no byte.
"""

import ast
import json
import os
import random
import shutil
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SEED = 7
SPUR, CONCAVE, ZN = "spherical_convex_spur", "spherical_concave_convex", "cylindrical_worm_zn_zn"
#: File -> a drive that it takes part in; of a folder the drive that is quickest.
DRIVES = {
    "drives/spherical.py": CONCAVE, "drives/spherical_keys.py": CONCAVE, "drives/cylindrical_worm.py": ZN,
    "drives/cylindrical_worm_functions.py": ZN, "drives/face_worm.py": "face_worm",
    "drives/cylindrical_gears.py": "cylindrical_gears", "drives/bevel.py": "bevel_formate",
    "tools/straight_blade.py": ZN, "tools/worm_body.py": ZN, "tools/tip_rounding.py": ZN,
    "tools/axial_blade.py": "cylindrical_worm_za_za", "tools/involute.py": "cylindrical_worm_zi_zi",
    "tools/grinding.py": "cylindrical_worm_zk_zk", "tools/grinding_disc.py": "cylindrical_worm_zk_zk",
    "tools/grinding_arc.py": "cylindrical_worm_zc_zc", "tools/basic_rack.py": "cylindrical_gears",
    "tools/rack_section.py": CONCAVE, "tools/cutter_blade.py": "bevel_formate", "tools/head_cutter.py": "bevel_formate",
    "language/chain.py": SPUR, "language/contact.py": SPUR, "language/differentiate.py": SPUR,
    "language/envelope.py": SPUR, "language/surface.py": SPUR, "language/vectors.py": SPUR,
    "language/rack_and_pinion.py": ZN, "passes/singular.py": ZN, "language/functions.py": SPUR,
    "passes/completion.py": SPUR, "passes/directional.py": SPUR, "passes/edges.py": SPUR, "passes/fuse.py": SPUR,
    "passes/geometry.py": SPUR, "passes/linearise.py": SPUR, "passes/quotients.py": SPUR,
    "program/tape.py": SPUR, "emit/c99.py": SPUR, "emit/lanes.py": SPUR, "emit/sensitivity.py": SPUR,
    "emit/bounded.py": SPUR,
}  # fmt: skip
OTHER = {"sin": "cos", "cos": "sin", "Rx": "Ry", "Ry": "Rz", "Rz": "Rx", "add": "sub", "sub": "add", "mul": "add"}
SWAPPED = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Add, ast.Div: ast.Mult}


@dataclass(frozen=True)
class Edit:
    """A changed source: file below derive/, the line, what was changed, and the whole text."""

    file: str
    line: int
    words: str
    text: str


@dataclass(frozen=True)
class Outcome:
    """By whom an edit is refused: a checker (print, code, description, bounded), derivation; or "same", "survivor"."""

    edit: Edit
    by: str
    reason: str


def edits(count: int, seed: int = SEED) -> Iterator[Edit]:
    """File by file in turn, seeded."""
    rng = random.Random(seed)
    queues = {file: _edits_of(file, rng) for file in DRIVES if (ROOT / "derive" / file).is_file()}
    made = 0
    while made < count and any(queues.values()):
        for queue in queues.values():
            if queue and made < count:
                made += 1
                yield queue.pop()


def _edits_of(file: str, rng: random.Random) -> list[Edit]:
    text = (ROOT / "derive" / file).read_text(encoding="utf-8")
    lines = text.splitlines(keepends=True)
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line.encode()))
    raw, found = text.encode(), []

    def place(line: int, column: int) -> int:
        return starts[line - 1] + column

    for node in ast.walk(ast.parse(text)):
        for span, other in _changes(node, place, raw):
            changed = (raw[: span[0]] + other + raw[span[1] :]).decode()
            words = f"{raw[span[0] : span[1]].decode()!r} -> {other.decode()!r}"
            found.append(Edit(file, node.lineno, words, changed))
    rng.shuffle(found)
    return found


def _changes(node, place, raw):
    """Spans of bytes and what to put there."""
    match node:
        case ast.BinOp(left, operator, right) if type(operator) in SWAPPED and not _is_text(node):
            a, b = place(left.end_lineno, left.end_col_offset), place(right.lineno, right.col_offset)
            old = raw[a:b]
            signs = {ast.Add: b"+", ast.Sub: b"-", ast.Mult: b"*", ast.Div: b"/"}
            new = signs[SWAPPED[type(operator)]]
            if old.count(signs[type(operator)]) == 1:
                yield (a, b), old.replace(signs[type(operator)], new)
        case ast.UnaryOp(ast.USub(), operand) if not isinstance(operand, ast.Constant):
            a = place(node.lineno, node.col_offset)
            yield (a, a + 1), b"+"
        case ast.Call(ast.Attribute(attr=name) as f) if name in OTHER:
            b = place(f.end_lineno, f.end_col_offset)
            yield (b - len(name), b), OTHER[name].encode()
        case ast.Call(ast.Name(name) as f) if name in OTHER:
            b = place(f.end_lineno, f.end_col_offset)
            yield (b - len(name), b), OTHER[name].encode()
        case ast.Call(ast.Attribute(attr="cross" | "sub" | "div"), [first, second]):
            a, b = (place(p.lineno, p.col_offset) for p in (first, second))
            c, d = (place(p.end_lineno, p.end_col_offset) for p in (first, second))
            yield (a, d), raw[b:d] + raw[c:b] + raw[a:c]


def _is_text(node) -> bool:
    return any(isinstance(n, ast.JoinedStr | ast.List | ast.Tuple) or (isinstance(n, ast.Constant)
               and isinstance(n.value, str)) for n in ast.walk(node))  # fmt: skip


def judged(edits_: list[Edit], folder: Path, report=None) -> Iterator[Outcome]:
    """Each edit in a copy of derive/ and a process of its own; the parent has what every one of them imports first."""
    import casadi  # noqa: F401
    import sympy  # noqa: F401

    shutil.copytree(ROOT / "derive", folder / "derive", ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "runtime").symlink_to(ROOT / "runtime")
    for k, edit in enumerate(edits_):
        path = folder / "derive" / edit.file
        kept = path.read_text(encoding="utf-8")
        path.write_text(edit.text, encoding="utf-8")
        result = folder / f"outcome_{k}.json"
        child = os.fork()
        if not child:
            _judge(edit, folder, result)
        os.waitpid(child, 0)
        path.write_text(kept, encoding="utf-8")
        by, reason = json.loads(result.read_text(encoding="utf-8")) if result.is_file() else ("derivation", "ended")
        outcome = Outcome(edit, by, reason)
        if report:
            report(outcome)
        yield outcome


def _judge(edit: Edit, folder: Path, result: Path) -> None:
    """In a process of its own: never returns."""
    sys.dont_write_bytecode = True
    sys.path.insert(0, str(folder))
    os.chdir(folder)
    for name in [n for n in sys.modules if n.partition(".")[0] == "derive"]:
        del sys.modules[name]
    try:
        by, reason = _verdict(DRIVES[edit.file], folder)
    except BaseException as error:  # whatever the derivation ends in
        by, reason = "derivation", repr(error)[:200]
    result.write_text(json.dumps([by, reason]), encoding="utf-8")
    os._exit(0)


def _verdict(drive: str, folder: Path) -> tuple[str, str]:
    from derive.audit import check_bounded, check_code, check_description, check_print

    assert Path(check_print.__file__).is_relative_to(folder)
    made, kept = folder / "generated", ROOT / "generated"
    shutil.rmtree(made, ignore_errors=True)
    shutil.copytree(kept / "audit", made / "audit")
    printed = check_print.read_printed(Path(check_print.__file__).with_name("printed.txt").read_text(encoding="utf-8"))
    description, header = made / "descriptions" / f"{drive}.json", made / "c" / f"{drive}.h"
    write_description(drive, description)
    changed = description.read_text(encoding="utf-8") != (kept / "descriptions" / f"{drive}.json").read_text("utf-8")
    try:
        if changed:
            check_print.check_drive(description, printed)
    except check_print.Rejected as reason:
        return "print", str(reason)[:200]
    write_all(drive, made)
    if not changed and not any(_differs(path, kept / "c" / path.name) for path in (made / "c").glob(f"{drive}*.h")):
        return "same", ""
    checks = (
        (check_code, lambda: check_code.check_header(header)),
        (check_description, lambda: check_description.check_drive(description, header)),
        (check_bounded, lambda: check_bounded.check_drive(description, header, made / "casadi")),
    )
    for checker, check in checks:
        checker.__dict__.get("CODE", checker).ATTEMPTS = 3000
        try:
            check()
        except checker.Rejected as reason:
            return checker.__name__.rpartition("_")[2], str(reason)[:200]
    return "survivor", ""


def _differs(path: Path, other: Path) -> bool:
    """Apart from the lines that name hashes."""
    a, b = (
        [line for line in p.read_text(encoding="utf-8").splitlines() if "HASH" not in line and "hash" not in line]
        for p in (path, other)
    )
    return a != b


def write_description(drive: str, path: Path) -> None:
    from derive import drives
    from derive.language import description

    path.parent.mkdir(parents=True, exist_ok=True)
    built = drives.catalogue([drive])[drive]()
    path.write_text(description.text(built), encoding="utf-8")


def write_all(drive: str, folder: Path) -> None:
    from derive import command

    if command.main([drive, "--output", str(folder)]):
        raise RuntimeError("not generated")


def main() -> int:
    import tempfile

    count = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        for outcome in judged(list(edits(count)), Path(folder)):
            edit = outcome.edit
            print(f"{outcome.by:12} {edit.file}:{edit.line} {edit.words[:60]} | {outcome.reason[:110]}", flush=True)
        print(f"{time.perf_counter() - begin:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
