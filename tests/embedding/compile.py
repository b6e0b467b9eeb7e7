"""The one helper that compiles generated C: strict flags, several compilers, targets without a C library."""

import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
GENERATED, RUNTIME = ROOT / "generated" / "c", ROOT / "runtime" / "c"
FREESTANDING = ROOT / "runtime" / "examples" / "freestanding"

STRICT = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror")
EXACT = ("-ffp-contract=off", "-fno-math-errno")
CLANG = (sys.executable, "-m", "ziglang")

#: Targets without an operating system and the options that select them.
TARGETS = {
    "wasm": ("-target", "wasm32-freestanding", "-Wl,--no-entry", "-Wl,--export=solve"),
    "cortex-m7": ("-target", "thumb-freestanding-eabihf", "-mcpu=cortex_m7+fp_armv8d16", "-Wl,--entry,solve"),
    "arm64": ("-target", "aarch64-freestanding", "-Wl,--entry,solve"),
}


def compilers():
    """C and C++ commands by name: clang from its Python package, and gcc and clang of the system that has them."""
    found = {"clang": ((*CLANG, "cc"), (*CLANG, "c++"))}
    for name in ("clang", "clang-14"):
        if shutil.which(name) and shutil.which(name.replace("clang", "clang++")):
            found["a clang of the system"] = ((name,), (name.replace("clang", "clang++"),))
    if shutil.which("gcc") and shutil.which("g++"):
        found["gcc"] = (("gcc",), ("g++",))
    return found


def tool(name):
    """A program of the system or of this Python's environment; None if there is none."""
    return shutil.which(name) or shutil.which(name, path=str(Path(sys.executable).parent))


def run(*command, **options):
    """Run a command; its output is the error's text if it fails."""
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, **options)
    assert done.returncode == 0, f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}"
    return done.stdout


def strict_object(command, header, folder, standard):
    """Object file of a translation unit that holds one header and refers to its model."""
    unit = folder / ("unit.c" if standard.startswith("c9") else "unit.cpp")
    prefix = Path(header).stem
    before = ('extern "C" ' if standard.startswith("c++") else "") + "const mw_model *model(void);\n"
    unit.write_text(f'#include "{header}"\n{before}const mw_model *model(void) {{ return &{prefix}_model; }}\n')
    output = folder / "unit.o"
    run(*command, f"-std={standard}", "-O1", *STRICT, *EXACT, f"-I{GENERATED}", "-c", unit, "-o", output)
    return output


def undefined(output):
    """Undefined symbols of an object file."""
    return {line.split()[-1] for line in run("nm", "-u", output).splitlines() if line.strip()}


def writable(output):
    """Symbols in writable sections of an object file, constants that need relocation not counted."""
    kinds = [line.split()[-2:] for line in run("nm", output).splitlines()]
    return {name for kind, name in kinds if kind in "bBdDgGsSC"} - _relocated(output)


def _relocated(output):
    """Constant tables of addresses: .data.rel.ro, which the loader makes read-only."""
    lines = run("objdump", "-t", output).splitlines()
    return {line.split()[-1] for line in lines if ".data.rel.ro" in line}


def freestanding(target, drive, output, source=FREESTANDING / "solve.c", *options):
    """The example solver, or another source of ``solve``, for a target without a C library."""
    defines = (f"-DDRIVE={drive}", f'-DHEADER="{drive}.h"')
    includes = (f"-I{GENERATED}", f"-I{FREESTANDING}")
    run(*CLANG, "cc", *TARGETS[target], "-nostdlib", "-O2", *EXACT, *defines, *includes, *options, source, "-o", output)
    return output
