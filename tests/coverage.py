"""What the tests reach: lines and branches of runtime/c, lines of the Python runtime; ``make coverage``.

The C interface is compiled with counters and called by the fuzzer's random but seeded bytes (:mod:`tests.fuzz`), whose
checks every call passes; the Python runtime runs under coverage.py in ``make test``'s tests. The exit status is 1 where
a share is below what is required, where a line of C is not reached that ``tests/uncovered.txt`` does not name with a
reason, and where that list names a line that is reached or is no more.
"""

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

from tests.fuzz import interface

ROOT = Path(__file__).resolve().parent.parent
LISTED = Path(__file__).with_name("uncovered.txt")

#: Shares of lines and branches of runtime/c and of lines of the Python runtime that must be reached.
LINES, BRANCHES, PYTHON = 0.95, 0.85, 0.92

SEED, INPUTS = 0, 3200

#: What runs under coverage.py: of the default tests those that use the runtime and neither derive nor compile.
TESTS = (
    "-m", "not slow and not validate", "--numprocesses", "auto", "--ignore=tests/prove",
    "--ignore=tests/derive", "--ignore=tests/audit", "--ignore=tests/benchmarks", "--ignore=tests/embedding",
    "--ignore=tests/outside",
)  # fmt: skip
DESIGNS = (
    "zk-zn-45", "zk-zn-90", "spherical-table-2-3", "helical-crowned", "crossed-helical-17-23",
    "face-worm-conical-concave", "bevel-face-hobbed",
)  # fmt: skip

#: Lane sets that this processor may not have: the calls do not go there.
ELSEWHERE = ("lanes_avx2.c", "lanes_avx512.c")


def reached(folder):
    """Hits of each line and of each branch, by file and number, of hand-written C, from the counters in a folder."""
    lines, branches = Counter(), Counter()
    for counters in sorted(folder.glob("*.gcda")):
        command = ("gcov", "--json-format", "--stdout", "--branch-probabilities", counters)
        done = subprocess.run(command, capture_output=True, text=True, cwd=folder, check=True)
        for report in map(json.loads, done.stdout.splitlines()):
            for source in report["files"]:
                path = (folder / source["file"]).resolve()
                if interface.SOURCE not in path.parents:
                    continue
                name = path.relative_to(interface.SOURCE).as_posix()
                if any(word in name for word in ELSEWHERE):
                    continue
                for line in source["lines"]:
                    lines[name, line["line_number"]] += line["count"]
                    for k, branch in enumerate(line["branches"]):
                        branches[name, line["line_number"], k] += branch["count"]
    return lines, branches


def not_reached(lines):
    """"file: text" of every line that was never run."""
    text = {name: (interface.SOURCE / name).read_text(encoding="utf-8").splitlines() for name, _ in lines}
    return {f"{name}: {text[name][number - 1].strip()}" for (name, number), hits in lines.items() if not hits}


def excused():
    """Lines that are known not to be reached, each with its reason: "file: text  # reason"."""
    found = {}
    for line in LISTED.read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            place, _, reason = line.partition("  # ")
            found[place] = reason
    return found


def of_c():
    """Words and what is wrong with the coverage of runtime/c."""
    if not (shutil.which("gcov") and interface.gcc()):
        return "runtime/c: NOT MEASURED: needs gcc with gcov", []
    with tempfile.TemporaryDirectory(prefix="meshwright-coverage-") as place:
        folder = Path(place)
        program = interface.build(folder, "gcc", ("--coverage",), ("-DMW_FUZZ_ALONE",), DESIGNS)
        ended, said = interface.run(program, (SEED, INPUTS), 3600)
        if ended:
            return "runtime/c: the calls failed", [said]
        lines, branches = reached(folder)
    shares = [sum(hits > 0 for hits in found.values()) / len(found) for found in (lines, branches)]
    missing, known, wrong = not_reached(lines), excused(), []
    for share, least, what in zip(shares, (LINES, BRANCHES), ("lines", "branches"), strict=True):
        if share < least:
            wrong.append(f"{what} of runtime/c: {share:.1%}, required {least:.0%}")
    wrong += [f"not reached, and not named in {LISTED.name}: {place}" for place in sorted(missing - set(known))]
    wrong += [f"named in {LISTED.name}, but reached or gone: {place}" for place in sorted(set(known) - missing)]
    wrong += [f"named in {LISTED.name} without a reason: {place}" for place, reason in known.items() if not reason]
    per_file = Counter(name for name, _ in lines), Counter(name for (name, _), hits in lines.items() if hits)
    words = [f"  {name:24} {per_file[1][name]:4} of {count:4} lines" for name, count in sorted(per_file[0].items())]
    words.append(f"runtime/c: lines {shares[0]:.1%} of {len(lines)}, branches {shares[1]:.1%} of {len(branches)}")
    return "\n".join(words), wrong


def of_python(tests):
    """Words and what is wrong with the coverage of the Python runtime by these arguments of pytest."""
    with tempfile.TemporaryDirectory(prefix="meshwright-coverage-") as place:
        settings, data = Path(place) / "settings", Path(place) / "data"
        settings.write_text(
            f"[run]\nsource = meshwright\nparallel = true\nsigterm = true\ndata_file = {data}\n"
            "concurrency = thread,multiprocessing\npatch = subprocess,_exit\n", encoding="utf-8",
        )  # fmt: skip
        run = (sys.executable, "-m", "coverage")
        ended = subprocess.run((*run, "run", f"--rcfile={settings}", "-m", "pytest", *tests), cwd=ROOT).returncode
        subprocess.run((*run, "combine", f"--rcfile={settings}", "--quiet"), cwd=place, check=True)
        out = Path(place) / "report.json"
        subprocess.run((*run, "json", f"--rcfile={settings}", "-o", out, "--quiet"), cwd=place, check=True)
        found = json.loads(out.read_text(encoding="utf-8"))
    share = found["totals"]["percent_covered"] / 100.0
    words = [f"  {_module(name):40} {_ranges(entry['missing_lines'])}" for name, entry in sorted(found["files"].items())
             if entry["missing_lines"]]  # fmt: skip
    words.append(f"Python runtime: lines {share:.1%} of {found['totals']['num_statements']}")
    wrong = [f"lines of the Python runtime: {share:.1%}, required {PYTHON:.0%}"] if share < PYTHON else []
    return "\n".join(words), wrong + ([f"pytest ended with status {ended}"] if ended else [])


def _module(name):
    return Path(name).as_posix().rpartition("meshwright/")[2]


def _ranges(numbers):
    """Numbers in words: 3, 7-9."""
    found = []
    for k in numbers:
        if found and k == found[-1][1] + 1:
            found[-1][1] = k
        else:
            found.append([k, k])
    return ", ".join(f"{a}-{b}" if b > a else str(a) for a, b in found)


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="python -m tests.coverage", description=__doc__.split("\n")[0])
    parser.add_argument("--only", choices=("c", "python"))
    parser.add_argument("tests", nargs="*", default=TESTS, help="arguments of pytest, after --")
    given = parser.parse_args(arguments)
    wrong = []
    for name, part in (("c", of_c), ("python", lambda: of_python(given.tests))):
        if given.only in (None, name):
            words, own = part()
            wrong += own
            print(words, flush=True)
    for text in wrong:
        print(text, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
