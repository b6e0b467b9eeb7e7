"""The whole C interface gives the same bits from every compiler, at every level of optimisation, with this machine's
own instructions or without: results of random calls of all its functions, by one digest.

Headers alone, fused too, and on WebAssembly, ARM64 and Cortex-M7: ``tests/embedding/test_headers.py``. Where the
promise ends is written in ``runtime/c/exact.h``.
"""

import re
import shutil

import pytest

from tests.embedding import compile as c
from tests.fuzz import interface

INPUTS = 12
DESIGNS = ("spherical-table-2-3",)


def commands():
    """C compilers by name: gcc, clang of the system and clang from its Python package, those that there are."""
    found = {"zig": f"{c.CLANG[0]} {c.CLANG[1]} {c.CLANG[2]} cc"}
    for name in ("gcc", "clang", "clang-14"):
        if shutil.which(name):
            found[name.partition("-")[0]] = name
    return found


def digest(folder, command, options):
    """What the results of random calls add up to."""
    program = interface.build(folder, command, options, ("-DMW_FUZZ_ALONE", "-DMW_FUZZ_EXACT"), DESIGNS)
    ended, said = interface.run(program, (3, INPUTS), 600)
    assert ended == 0, said
    return re.search(r"digest (\w+)", said).group(1), interface.counted(said)


@pytest.mark.validate
def test_the_interface_gives_the_same_bits_from_every_compiler_level_and_instruction_set(tmp_path):
    found = {}
    for name, command in commands().items():
        for level in ("-O0", "-O1", "-O2", "-O3"):
            for native in ((), ("-march=native",)):
                options = (level, *native)
                found[name, *options], counted = digest(tmp_path / "-".join((name, *options)), command, options)
                assert counted["successes"] > 10
    assert len(set(found.values())) == 1, found
    assert "gcc" in commands() or not shutil.which("gcc")
