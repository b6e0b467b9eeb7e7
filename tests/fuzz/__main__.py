"""Everything that is fuzzed, bounded and seeded, in one table: ``python -m tests.fuzz`` (``make fuzz``).

Designs, the C interface under each sanitizer and in threads, and records. A part that fails makes the exit status 1;
a tool that is missing is named in the table, and what it would have checked was then not checked.
"""

import argparse
import sys
import tempfile
import time
from pathlib import Path

from meshwright.base.library import library
from tests.fuzz import designs, interface, records

#: (mutated designs, of these analysed, inputs of the C interface, inputs of threads, mutated records)
SIZES = {"short": (1500, 100, 150, 40, 15), "full": (200_000, 10_000, 100_000, 2_000, 500)}

#: Packaged designs whose drives the short run compiles.
FEW = ("spherical-table-2-3",)

#: Inputs a process handles before the next one begins, seconds it may take for each at most.
PIECE, LIMIT = 50_000, 60


def _designs(size, seed):
    total, failures = designs.run(size[0], size[1], seed)
    wrong = [f"seed {f['seed']}: {f['error']}" for f in failures]
    again = "; show one again with python -m tests.fuzz.designs --show SEED" if wrong else ""
    return f"{sum(total.values())} loaded, {total['analysed']} analysed, {total['refused']} refused{again}", wrong


def _interface(kind, size, seed, which):
    """Words and failures of one sanitizer; None where no compiler has it."""
    flags, by_gcc = interface.SANITIZERS[kind]
    threads, led = kind == "thread", interface.clang()
    compiler = led or (interface.gcc() if by_gcc else None)
    if compiler is None:
        return None
    guided = led and not threads
    defines = () if guided else ("-DMW_FUZZ_ALONE", *(("-DMW_FUZZ_THREADS=4",) if threads else ()))
    count = size[3] if threads else size[2]
    with tempfile.TemporaryDirectory(prefix="meshwright-fuzz-") as folder:
        every = (*flags, *(("-fsanitize=fuzzer",) if guided else ()))
        program = interface.build(Path(folder), compiler, every, defines, which)
        if guided:
            arguments = [f"-runs={count}", f"-seed={seed + 1}", f"-timeout={LIMIT}", "-max_len=384", "-verbosity=0"]
        else:
            arguments = [seed, count]
        ended, said = interface.run(program, arguments, LIMIT + count * 5)
    found = interface.counted(said)
    words = (
        f"{found['inputs']} inputs, {found['calls']} calls, {found['successes']} successes looked at, "
        f"{Path(compiler).name}{', led by coverage' if guided else ', random bytes'}"
    )
    return words, [said[-6000:]] if ended or not found["calls"] else []


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__.split("\n")[0])
    parser.add_argument("--size", choices=SIZES, default="short")
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args(arguments)
    library()
    size, few = SIZES[given.size], FEW if given.size == "short" else interface.DESIGNS
    parts = {"designs": lambda: _designs(size, given.seed), "record": lambda: records.run(size[4], given.seed)}
    for kind in interface.SANITIZERS:
        parts[f"C interface, {kind}"] = lambda kind=kind: _interface(kind, size, given.seed, few)
    failed = missing = 0
    for name, part in parts.items():
        begin = time.monotonic()
        done = part()
        if done is None:
            missing += 1
            print(f"{name:32} NOT RUN: needs clang with its runtime (Debian: clang, libclang-rt-dev)", flush=True)
            continue
        words, wrong = done
        failed += bool(wrong)
        print(f"{name:32} {'FAILED' if wrong else 'ok':6} {words} ({time.monotonic() - begin:.0f} s)", flush=True)
        for text in wrong:
            print(text, file=sys.stderr)
    if missing:
        print(f"{missing} of {len(parts)} parts were not run: nothing is said of what they check")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
