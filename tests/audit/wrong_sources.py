"""Wrong physics in the sources: one edit of a drive, tool, rule, pass or printer at a time, in a copy of the tree.

Each edit is generated anew, of the drives that use the file one after the other, and put before the checkers alone, as
``make audit`` does with all drives. What the derivation itself refuses (it does not run, or one of its own checks
fails) is counted apart, and so is what changes no byte of any of these drives and what changes no value: the program is
another one, and each of its functions returns what it returned.

``python -m tests.audit.wrong_sources [--count N] [--each M] [--seed S] [--jobs J] [--log FILE] [--write]`` prints a
line an edit; with a log, what stands in it is not run again; ``--write`` keeps the sums for the page of validation.
``M`` more edits each of passes, of program and of printers change numbers and the code in strings and templates.
"""

import argparse
import ast
import json
import os
import random
import re
import resource
import shutil
import sys
import tempfile
import time
import tokenize
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

from derive.audit.mutations.table import keep

ROOT = Path(__file__).resolve().parents[2]
SEED = 7
#: A derivation that takes longer does not end.
SECONDS = 150
ZN, ZA, ZI, ZK, ZC = (f"cylindrical_worm_{form}_{form}" for form in ("zn", "za", "zi", "zk", "zc"))
SPUR, CONCAVE = "spherical_convex_spur", "spherical_concave_convex"
WORMS, EVERY = (ZN, ZA, ZI, ZK, ZC), (SPUR, ZN, "bevel_formate")
BEVELS = ("bevel_formate", "bevel_generated", "bevel_face_hobbed")
FACE, CYLINDRICAL = ("face_worm",), ("cylindrical_gears",)
#: File -> drives that it takes part in; of what all use, one of each kind, the quickest first.
DRIVES = {
    "drives/spherical.py": (CONCAVE, SPUR), "drives/spherical_keys.py": (CONCAVE,),
    "drives/rack_generated.py": (CONCAVE, *CYLINDRICAL),
    "drives/cylindrical_worm.py": WORMS, "drives/cylindrical_worm_functions.py": WORMS,
    "drives/cylindrical_worm_keys.py": WORMS,
    "drives/face_worm.py": FACE, "drives/face_worm_keys.py": FACE, "drives/cylindrical_gears.py": CYLINDRICAL,
    "drives/cylindrical_gears_keys.py": CYLINDRICAL, "drives/bevel.py": BEVELS, "drives/bevel_keys.py": BEVELS,
    "tools/straight_blade.py": (ZN,), "tools/worm_body.py": WORMS, "tools/tip_rounding.py": WORMS,
    "tools/axial_blade.py": (ZA,), "tools/involute.py": (ZI,), "tools/grinding.py": (ZK, ZC),
    "tools/grinding_disc.py": (ZK,), "tools/grinding_arc.py": (ZC,), "tools/basic_rack.py": CYLINDRICAL,
    "tools/rack_section.py": (CONCAVE, *CYLINDRICAL), "tools/cutter_blade.py": BEVELS, "tools/head_cutter.py": BEVELS,
    "language/chain.py": EVERY, "language/contact.py": EVERY, "language/differentiate.py": EVERY,
    "language/envelope.py": EVERY, "language/surface.py": EVERY, "language/vectors.py": EVERY,
    "drives/rack_and_pinion.py": (ZN,), "passes/singular.py": EVERY, "language/functions.py": EVERY,
    "passes/completion.py": EVERY, "passes/directional.py": EVERY, "passes/edges.py": EVERY, "passes/fuse.py": EVERY,
    "passes/geometry.py": EVERY, "passes/linearise.py": EVERY, "passes/quotients.py": EVERY,
    "program/tape.py": EVERY, "program/lowering.py": EVERY, "program/formula.py": EVERY,
    "emit/c99.py": EVERY, "emit/lanes.py": EVERY, "emit/sensitivity.py": EVERY, "emit/bounded.py": EVERY,
    "emit/casadi.py": EVERY, "emit/certified.py": EVERY, "emit/approximation.py": EVERY,
    "passes/schedule.py": EVERY, "passes/equations.py": EVERY, "passes/flanks.py": EVERY, "passes/binding.py": EVERY,
    "passes/observation.py": EVERY, "passes/plan.py": EVERY, "passes/pivot_order.py": EVERY,
    "passes/tangents.py": EVERY, "passes/arrange.py": EVERY, "passes/enclosed.py": EVERY,
    "program/enclosure.py": EVERY, "program/routine.py": EVERY,
    "emit/templates/drive.h.jinja": EVERY, "emit/templates/functions.jinja": EVERY,
    "emit/templates/lanes.h.jinja": EVERY, "emit/templates/sensitivity.h.jinja": EVERY,
    "emit/templates/bounded.h.jinja": EVERY, "emit/templates/certified.h.jinja": EVERY,
}  # fmt: skip
#: What makes programs of descriptions, and C of programs: of each, more edits than signs and operations.
COMPILER = ("passes/", "program/", "emit/")
#: Of what it makes nothing but words: formulas in comments and on pages.
WORDS = ("program/formula.py",)
#: By whom an edit is judged that no checker refuses.
UNREFUSED = ("survivor", "derivation", "same", "equal")
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
    """By whom an edit is refused: a checker (print, code, description, bounded, tables), derivation; or "same" (no byte
    changes), "equal" (no value changes), "survivor".
    """

    edit: Edit
    by: str
    reason: str


def edits(count: int, seed: int = SEED) -> Iterator[Edit]:
    """File by file in turn, seeded."""
    rng = random.Random(seed)
    python = [file for file in DRIVES if file.endswith(".py")]
    return _in_turn({file: _edits_of(file, rng) for file in python}, count)


def further(each: int, seed: int = SEED) -> Iterator[Edit]:
    """Of passes, of program and of printers so many each, part by part and file by file in turn, seeded."""
    parts = []
    for part in COMPILER:
        files = [file for file in DRIVES if file.startswith(part) and file not in WORDS]
        queues = {file: _text_edits_of(file, random.Random(f"{seed} {file}")) for file in files}
        parts.append(list(_in_turn(queues, each)))
    for row in zip_longest(*parts):
        yield from filter(None, row)


def _in_turn(queues: dict[str, list[Edit]], count: int) -> Iterator[Edit]:
    made = 0
    while made < count and any(queues.values()):
        for queue in queues.values():
            if queue and made < count:
                made += 1
                yield queue.pop()


#: In code that is printed: what stands there, and what is put there.
PRINTED = (
    (r" \+ ", " - "), (r" - ", " + "), (r" \* ", " + "), (r"MW_FMA\(", "MW_FMS("), (r"MW_FNMA\(", "MW_FMA("),
    (r"MW_FMS\(", "MW_FMA("), (r"(?<=[\w)\]]) < (?=[\w(])", " > "), (r" != ", " == "), (r"\bsin\b", "cos"),
    (r"\bcos\b", "sin"), (r"(?<![\w.\[])0\.5(?!\w)", "0.75"), (r"(?<![\w.\[])1\.0(?!\w)", "1.5"), (r"\[k\]", "[0]"),
    (r"\[loop\.index0( \+ (?=offset))?", "[1 + loop.index0"),
)  # fmt: skip
#: A string that is one operator.
OPERATORS = {'"+"': '"-"', '"-"': '"+"', '"*"': '"+"', '"/"': '"*"', '"sin"': '"cos"', '"cos"': '"sin"'}


def _text_edits_of(file: str, rng: random.Random) -> list[Edit]:
    text = (ROOT / "derive" / file).read_text(encoding="utf-8")
    found = list(_template_changes(text) if file.endswith(".jinja") else _token_changes(text))
    lines = text.splitlines(keepends=True)
    made = {}
    for number, column, old, new in found:
        line = lines[number - 1]
        changed = line[:column] + new + line[column + len(old) :]
        if old == new:
            continue
        words = f"{line.strip()[:60]!r} @{column}: {old!r} -> {new!r}"
        made[words] = Edit(file, number, words, "".join([*lines[: number - 1], changed, *lines[number:]]))
    edits_ = list(made.values())
    rng.shuffle(edits_)
    return edits_


def _template_changes(text: str) -> Iterator[tuple[int, int, str, str]]:
    """Line, column, what stands there, and what is put there: lines of code alone."""
    for number, line in enumerate(text.splitlines(), 1):
        if not re.match(r"\s*(/?\*|{#|#|//|{%-? (from|macro|end))", line):
            code = line.partition("/*")[0]
            for pattern, other in PRINTED:
                yield from ((number, m.start(), m[0], other) for m in re.finditer(pattern, code))


def _token_changes(text: str) -> Iterator[tuple[int, int, str, str]]:
    """The same of Python: numbers, names of operations and code in strings, docstrings left out."""
    before = ""
    for token in tokenize.generate_tokens(iter(text.splitlines(keepends=True)).__next__):
        (row, column), old = token.start, token.string
        if token.type == tokenize.NUMBER:
            yield row, column, old, str(int(old) + 1) if old.isdigit() else repr(float(old) * 1.5)
        elif token.type == tokenize.NAME and old in ("min", "max", "reversed"):
            yield row, column, old, {"min": "max", "max": "min", "reversed": "list"}[old]
        elif token.type == tokenize.STRING and "\n" not in old and before.strip():
            if old in OPERATORS:
                yield row, column, old, OPERATORS[old]
            for pattern, other in PRINTED if len(old) > 5 else ():
                yield from ((row, column + m.start(), m[0], other) for m in re.finditer(pattern, old))
        before = old


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
            found.append(Edit(file, getattr(node, "lineno", 0), words, changed))
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


def judged(edits_: list[Edit], folder: Path, jobs: int = 1) -> Iterator[Outcome]:
    """Each edit in a copy of derive/ and a process of its own; the parent has what every one of them imports first."""
    import casadi  # noqa: F401
    import sympy  # noqa: F401

    for k in range(jobs):
        shutil.copytree(ROOT / "derive", folder / f"{k}" / "derive", ignore=shutil.ignore_patterns("__pycache__"))
        (folder / f"{k}" / "runtime").symlink_to(ROOT / "runtime")
    shutil.copytree(ROOT / "generated", folder / "kept", ignore=shutil.ignore_patterns("site", "benchmark"))
    waiting, free, running = list(edits_)[::-1], list(range(jobs)), {}
    while waiting or running:
        while waiting and free:
            edit, slot = waiting.pop(), free.pop()
            path = folder / f"{slot}" / "derive" / edit.file
            kept = path.read_text(encoding="utf-8")
            path.write_text(edit.text, encoding="utf-8")
            (folder / f"{slot}.json").unlink(missing_ok=True)
            child = os.fork()
            if not child:
                _judge(edit, folder, slot)
            running[child] = edit, slot, path, kept
        child, _ = os.wait()
        edit, slot, path, kept = running.pop(child)
        path.write_text(kept, encoding="utf-8")
        free.append(slot)
        result = folder / f"{slot}.json"
        yield Outcome(edit, *(json.loads(result.read_text("utf-8")) if result.is_file() else ("derivation", "ended")))


def _judge(edit: Edit, folder: Path, slot: int) -> None:
    """In a process of its own: never returns."""
    own = folder / f"{slot}"
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    sys.dont_write_bytecode = True
    sys.path.insert(0, str(own))
    os.chdir(own)
    for name in [n for n in sys.modules if n.partition(".")[0] == "derive"]:
        del sys.modules[name]
    sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115
    try:
        by, reason = _of_all(DRIVES[edit.file], own, folder / "kept")
    except BaseException as error:  # whatever the derivation ends in
        by, reason = "derivation", repr(error)[:200]
    (folder / f"{slot}.json").write_text(json.dumps([by, reason]), encoding="utf-8")
    os._exit(0)


def _of_all(drives: tuple[str, ...], folder: Path, kept: Path) -> tuple[str, str]:
    """Refused if it is refused of one drive; what is the same or equal in all is no wrong physics."""
    found: dict[str, str] = {}
    for drive in drives:
        by, reason = _verdict(drive, folder, kept)
        if by not in ("same", "equal", "survivor"):
            return by, f"{drive}: {reason}"
        found.setdefault(by, f"{drive} {reason}")
    by = next(by for by in ("survivor", "equal", "same") if by in found)
    return by, found[by]


def _verdict(drive: str, folder: Path, kept: Path) -> tuple[str, str]:
    from derive.audit.checker import attempts, check_bounded, check_code, check_description, check_print
    from derive.audit.checker.printed import read_printed
    from derive.audit.checker.refusal import Rejected
    from derive.audit.mutations.equality import different

    assert Path(check_print.__file__).is_relative_to(folder)
    made = folder / "generated"
    shutil.rmtree(made, ignore_errors=True)
    shutil.copytree(kept / "audit", made / "audit")
    printed = read_printed(Path(check_print.__file__).parent.with_name("printed.txt").read_text(encoding="utf-8"))
    description, header = made / "descriptions" / f"{drive}.json", made / "c" / f"{drive}.h"
    write_description(drive, description)
    changed = _differs(description, kept / "descriptions" / f"{drive}.json")
    try:
        if changed:
            check_print.check_drive(description, printed)
    except Rejected as reason:
        return "print", str(reason)[:200]
    write_all(drive, made)
    if not changed and not any(_differs(path, kept / path.relative_to(made)) for path in written(drive, made)):
        return "same", ""
    checks = (
        (check_code, lambda: check_code.check_header(header)),
        (check_description, lambda: check_description.check_drive(description, header)),
        (check_bounded, lambda: check_bounded.check_drive(description, header, made / "casadi")),
    )
    with attempts.limited(3000):
        for checker, check in checks:
            try:
                check()
            except Rejected as reason:
                return checker.__name__.rpartition("_")[2], str(reason)[:200]
    place = different(drive, made, kept)
    return ("survivor", place) if place else ("equal", "")


def written(drive: str, folder: Path) -> list[Path]:
    """The files of a drive that hold its functions."""
    return [*(folder / "c").glob(f"{drive}*.h"), *(folder / "casadi").glob(f"{drive}*.casadi")]


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
    parser = argparse.ArgumentParser(prog="python -m tests.audit.wrong_sources", description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--each", type=int, default=0, help="so many more of passes, of program and of printers")
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--log", type=Path, help="a line of JSON an edit; what stands there is not run again")
    parser.add_argument("--write", action="store_true", help="replace the table of the page of validation")
    options = parser.parse_args()
    chosen = {
        key_of(edit): edit for edit in (*further(options.each, options.seed), *edits(options.count, options.seed))
    }
    known = {}
    if options.log and options.log.is_file():
        lines = map(json.loads, options.log.read_text("utf-8").splitlines())
        known = {tuple(key): (by, reason) for *key, by, reason in lines if tuple(key) in chosen}
    counted = Counter(by for by, _ in known.values())
    begin = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        left = [edit for key, edit in chosen.items() if key not in known]
        left.sort(key=lambda edit: not edit.file.startswith(("drives/", "tools/")))  # what print refuses is quick
        for outcome in judged(left, Path(folder), options.jobs):
            edit = outcome.edit
            counted[outcome.by] += 1
            known[key_of(edit)] = outcome.by, outcome.reason
            print(f"{outcome.by:12} {edit.file}:{edit.line} {edit.words[:60]} | {outcome.reason[:110]}", flush=True)
            if options.log:
                with options.log.open("a", encoding="utf-8") as log:
                    log.write(json.dumps([*key_of(edit), outcome.by, outcome.reason]) + "\n")
    print(dict(counted), f"{time.perf_counter() - begin:.0f} s")
    if options.write:
        keep(edits=table(known))
    return 0


def table(outcomes: dict[tuple[str, int, str], tuple[str, str]]) -> dict:
    """Rows by file, and what survived."""
    rows: dict[str, dict] = {}
    for (file, _, _), (by, _) in outcomes.items():
        row = rows.setdefault(file, {"file": file} | dict.fromkeys(("refused", *UNREFUSED), 0))
        row[by if by in UNREFUSED else "refused"] += 1
    survivors = [[*edit, reason] for edit, (by, reason) in outcomes.items() if by == "survivor"]
    return {"rows": [rows[file] for file in DRIVES if file in rows], "survivors": survivors}


def key_of(edit: Edit) -> tuple[str, int, str]:
    return edit.file, edit.line, edit.words


if __name__ == "__main__":
    sys.exit(main())
