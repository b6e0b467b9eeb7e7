"""Clock and compiler for the benchmarks."""

import shutil
import subprocess
import sys
import time

FLAGS = ["-std=gnu99", "-O3", "-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math", "-fopenmp-simd", "-w"]


def best(run, repeats=15, least=0.02):
    """Shortest of several processor times of ``run()``, each long enough to be measured, seconds a call."""
    begin = time.process_time()
    run()
    once = max(time.process_time() - begin, 1e-9)
    count = max(1, int(least / once))
    shortest = once
    for _ in range(repeats):
        begin = time.process_time()
        for _ in range(count):
            run()
        shortest = min(shortest, (time.process_time() - begin) / count)
    return shortest


def compiler():
    """The system's C compiler, else the one that comes as a Python package."""
    for name in ("cc", "gcc", "clang"):
        if shutil.which(name):
            return [name]
    return [sys.executable, "-m", "ziglang", "cc"]


def compile_c(sources, target, *options):
    """Compile to an executable, or a shared library if the options say so."""
    subprocess.run([*compiler(), *FLAGS, *options, *map(str, sources), "-o", str(target), "-lm"], check=True)
    return target


def instructions(stdin, program, *arguments):
    """Instructions that a program executes, counted by callgrind; None where there is no valgrind."""
    if not shutil.which("valgrind"):
        return None
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", str(program), *map(str, arguments)]
    with open(stdin, encoding="ascii") as numbers:
        run = subprocess.run(command, stdin=numbers, capture_output=True, text=True, check=True)
    return int(run.stderr.rsplit("Collected :", 1)[1].split()[0])
