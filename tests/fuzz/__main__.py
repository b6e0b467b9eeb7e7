"""Everything that is fuzzed, bounded and seeded, in one table: ``python -m tests.fuzz`` (``make fuzz``).

Designs, ``surface`` and ``report`` of them, the C interface under each sanitizer and in threads, and records. A
part that fails makes the exit status 1; a tool that is missing is named in the table, and what it would have checked
was then not checked.
"""

import argparse
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path

from meshwright.base.library import library
from tests.fuzz import designs, interface, pages, records


@dataclass(frozen=True)
class Size:
    """Mutated designs, of these analysed; through ``surface`` and ``report``; calls of the C interface, inputs of
    threads, mutated records.
    """

    designs: int
    analyse: int
    pages: int
    calls: int
    threads: int
    records: int


SIZES = {"short": Size(1500, 100, 6, 80_000, 40, 15), "full": Size(200_000, 10_000, 300, 10_000_000, 2_000, 500)}

#: Packaged designs whose drives the short run compiles.
FEW = ("spherical-table-2-3",)

#: Inputs of a process, of random bytes and of bytes led by coverage, in turn; seconds an input may take.
PIECE, LED, LIMIT = 200, 400, 60


#: What is drawn by seeds, each of which can be shown again.
SHOWN = {"designs": designs, "surface and report": pages}
AGAIN = "; show one again with python -m tests.fuzz --only PART --show SEED"


def _show(drawn, seed):
    """Print the mutated design of a seed and what becomes of it."""
    name, content = drawn.mutation(seed)
    print(f"# from {name}\n{content.decode('utf-8', 'backslashreplace')}", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        print(dict(drawn.one(seed, folder)) or "refused")


def _designs(size, seed):
    total, failures, slowest = designs.run(size.designs, size.analyse, seed, designs.DEEP)
    wrong = [f"seed {f['seed']}: {f['error']}" for f in failures]
    words = f"{total['analysed']} analysed, {total['refused']} refused, slowest {slowest[0]:.2f} s, seed {slowest[1]}"
    return f"{sum(total.values())} loaded, {words}{AGAIN if wrong else ''}", wrong


def _pages(size, seed):
    total, failures = pages.run(size.pages, seed)
    wrong = [f"seed {f['seed']}: {f['error']}" for f in failures]
    reports = ", ".join(f"{total[f'report {k}']} reports with exit status {k}" for k in pages.STATUSES)
    return f"{total['analysed']} designs, {reports}, {total['refused']} refused{AGAIN if wrong else ''}", wrong


def _pieces(led, random, size, seed):
    """Program and arguments of one process after another."""
    if led is None and size.threads:
        yield random, [seed, size.threads], size.threads
    for k in range(size.calls):
        yield random, [seed, PIECE, k * PIECE], PIECE
        if led:
            arguments = [f"-runs={LED}", f"-seed={seed + k + 1}", f"-timeout={LIMIT}", "-max_len=384", "-len_control=0"]
            yield led, [*arguments, "-verbosity=0"], LED


def _interface(kind, size, seed, which):
    """Words and failures of one sanitizer; None where no compiler has it."""
    flags, by_gcc = interface.SANITIZERS[kind]
    led_by = interface.clang()
    compiler = led_by or (interface.gcc() if by_gcc else None)
    if compiler is None:
        return None
    threaded = kind == "thread"
    size = replace(size, calls=1) if threaded else replace(size, threads=0)
    total, kinds = Counter(calls=0), Counter()
    with tempfile.TemporaryDirectory(prefix="meshwright-fuzz-") as folder:
        threads = ("-DMW_FUZZ_THREADS=4",) if threaded else ()
        random, led = interface.build_both(Path(folder), compiler, flags, threads, which, led_by and not threaded)
        for program, arguments, count in _pieces(led, random, size, seed):
            ended, said = interface.run(program, arguments, LIMIT + count * 5)
            found = interface.counted(said)
            total.update(found)
            kinds.update(interface.counted_by_kind(said))
            if ended or not found["calls"]:
                return "", [said[-6000:]]
            if total["calls"] >= size.calls:
                break
    words = f"{total['inputs']} inputs, {total['calls']} calls, {total['successes']} successes looked at, "
    words += Path(compiler).name + (", random bytes and led by coverage" if led else ", random bytes")
    return words + "".join(f"\n{count:>48} {kind}" for kind, count in kinds.items()), []


PARTS = ("designs", "surface and report", "record", *(f"C interface, {kind}" for kind in interface.SANITIZERS))

BUDGETS = {
    "designs": "mutated designs loaded", "analyse": "of these analysed",
    "pages": "designs through surface and report", "calls": "calls of the C interface",
    "threads": "inputs that four threads share", "records": "changed records",
}  # fmt: skip


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__.split("\n")[0])
    parser.add_argument("--size", choices=SIZES, default="short")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", choices=PARTS, help="one part alone")
    parser.add_argument("--show", type=int, metavar="SEED", help=f"of {' or '.join(SHOWN)}: this alone")
    for name, what in BUDGETS.items():
        parser.add_argument(f"--{name}", type=int, help=f"{what}, instead of those of the size")
    given = parser.parse_args(arguments)
    library()
    if given.show is not None:
        if given.only not in SHOWN:
            parser.error(f"--show {given.show}: goes with --only {' or '.join(map(repr, SHOWN))}")
        return _show(SHOWN[given.only], given.show)
    asked = {name: value for name in BUDGETS if (value := getattr(given, name)) is not None}
    size, few = replace(SIZES[given.size], **asked), FEW if given.size == "short" else interface.DESIGNS
    parts = {
        "designs": lambda: _designs(size, given.seed), "surface and report": lambda: _pages(size, given.seed),
        "record": lambda: records.run(size.records, given.seed),
    }  # fmt: skip
    for kind in interface.SANITIZERS:
        parts[f"C interface, {kind}"] = lambda kind=kind: _interface(kind, size, given.seed, few)
    if given.only:
        parts = {given.only: parts[given.only]}
    failed = missing = 0
    for name, part in parts.items():
        begin = time.monotonic()
        done = part()
        if done is None:
            missing += 1
            print(f"{name:32} NOT RUN: needs clang with its runtime (Debian: clang, libclang-rt-dev)", flush=True)
            continue
        (words, *more), wrong = done[0].split("\n"), done[1]
        failed += bool(wrong)
        print(f"{name:32} {'FAILED' if wrong else 'ok':6} {words} ({time.monotonic() - begin:.0f} s)", *more, sep="\n")
        sys.stdout.flush()
        for text in wrong:
            print(text, file=sys.stderr)
    if missing:
        print(f"{missing} of {len(parts)} parts were not run: nothing is said of what they check")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
