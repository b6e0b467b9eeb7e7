"""The whole C interface gives the same bits from every compiler, at every level of optimisation, with this machine's
own instructions or without, on ARM64 and as WebAssembly: results of random calls of all its functions, by one digest.

Headers alone, fused too, and on Cortex-M7: ``tests/embedding/test_headers.py``. Where the promise ends is written in
``runtime/c/exact.h``.
"""

import re
import shutil
from pathlib import Path

import pytest

from tests.embedding import compile as c
from tests.embedding.machines import wasi
from tests.fuzz import interface
from tests.quick import full

ZIG = " ".join((*c.CLANG, "cc"))
DESIGNS, INPUTS = ("spherical-table-2-3",), 60

#: Compilers by name: commands, the first of which that there is.
COMPILERS = {"gcc": ("gcc",), "clang": ("clang", *(f"clang-{k}" for k in range(21, 12, -1))), "zig": (ZIG,)}
OPTIONS = [(level, *native) for level in ("-O0", "-O1", "-O2", "-O3") for native in ((), ("-march=native",))]
QUICK_OPTIONS = [("-O0",), ("-O3", "-march=native")]

#: Other machines: target of zig's compiler, and what runs the program.
MACHINES = {"ARM64": "aarch64-linux-musl", "WebAssembly": "wasm32-wasi"}
LEVELS = ("-O0", "-O1", "-O2", "-O3") if full() else ("-O2",)


#: What the core library needs of a C library: of numbers no function but these, whose results IEEE arithmetic fixes.
NEEDED = {"sqrt", "fmax", "fmin", "memcpy", "memmove", "memset", "memcmp", "strcmp"}


def built(folder, command, options, link=()):
    return interface.build(folder, command, options, ("-DMW_FUZZ_ALONE", "-DMW_FUZZ_EXACT"), DESIGNS, link)


def digest(ended, said):
    """What the results of random calls add up to."""
    assert ended == 0, said
    assert interface.counted(said)["successes"] > 5 * INPUTS
    return re.search(r"digest (\w+)", said).group(1)


@pytest.fixture(scope="module")
def wanted(tmp_path_factory):
    """Of the compiler that is always there."""
    program = built(tmp_path_factory.mktemp("wanted"), ZIG, ("-O1",))
    return digest(*interface.run(program, (3, INPUTS), 600))


def test_the_core_library_asks_the_c_library_for_no_function_whose_bits_may_differ():
    objects = sorted((c.ROOT / ".venv" / "objects").glob("*.o"))
    if not objects:
        pytest.skip("the library was not built in this checkout")
    asked = set().union(*map(c.undefined, objects))
    assert {name for name in asked if not name.startswith(("mw_", "_"))} <= NEEDED


@pytest.mark.validate
@pytest.mark.parametrize("options", OPTIONS if full() else QUICK_OPTIONS, ids=" ".join)
@pytest.mark.parametrize("name", COMPILERS)
def test_every_compiler_level_and_instruction_set_gives_the_same_bits(tmp_path, wanted, name, options):
    commands = [command for command in COMPILERS[name] if shutil.which(command.split()[0])]
    if not commands:
        pytest.skip(f"no {name} here: nothing is said of it")
    assert digest(*interface.run(built(tmp_path, commands[0], options), (3, INPUTS), 600)) == wanted


@pytest.mark.validate
@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("name", MACHINES)
def test_other_machines_give_the_same_bits(tmp_path, wanted, name, level):
    emulator = next(filter(None, map(shutil.which, ("qemu-aarch64-static", "qemu-aarch64"))), None)
    if name == "ARM64" and not emulator:
        pytest.skip("no qemu-aarch64 here (Debian: qemu-user-static): nothing is said of ARM64")
    stack = ("-Wl,-z,stack-size=4194304",) if name == "WebAssembly" else ()
    program = built(tmp_path, ZIG, (level, "-target", MACHINES[name]), ("-static", *stack))
    if name == "ARM64":
        assert digest(*interface.run(Path(emulator), (program, 3, INPUTS), 1800)) == wanted
    else:
        assert digest(*wasi(program, (3, INPUTS))) == wanted
