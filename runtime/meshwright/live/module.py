"""The generated C of a drive and what calls it, compiled to a WebAssembly module that imports nothing."""

import importlib.util
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

from meshwright.base.drives import SHIPPED
from meshwright.base.errors import LibraryError, UsageError

SOURCE = Path(__file__).parent / "page" / "live.c"

#: Functions that the page calls; ``live.c`` says what each does.
EXPORTS = (
    "parameters", "sizes", "angles", "rows", "row_length", "most_angles", "complete", "cycle",
    "places", "shape", "flank",
)  # fmt: skip

#: No product is contracted into a sum, so that every number has the bits of the native objects.
FLAGS = (
    "-target", "wasm32-freestanding", "-mbulk-memory", "-std=c99", "-O3", "-ffp-contract=off", "-nostdlib",
    "-Wl,--no-entry",
)  # fmt: skip


def compiled(name, folder):
    """The page's WebAssembly module (bytes) of the drive ``name``, whose headers the folder of drives has."""
    defines = (f"-DLIVE_DRIVE={name}", f'-DLIVE_HEADER="{name}.h"')
    exports = (f"live_{export}" for export in EXPORTS)
    return to_wasm(SOURCE.read_text(encoding="utf-8"), exports, folder, defines)


def to_wasm(source, exports, folder, defines=()):
    """A WebAssembly module (bytes) of a C text that includes a drive's header, which the folder of drives has.

    Raises :class:`UsageError` without the compiler (clang of the package ``ziglang``), :class:`LibraryError` if it
    refuses the source.
    """
    if importlib.util.find_spec("ziglang") is None:
        raise UsageError(
            "ziglang, the compiler for WebAssembly, is not installed; `pip install 'meshwright[live]'` brings it"
        )
    headers = (SOURCE.parent / "include", Path(folder) / "include", SHIPPED / "include", SHIPPED / "source")
    with tempfile.TemporaryDirectory() as work:
        path, target = Path(work) / "module.c", Path(work) / "module.wasm"
        path.write_text(source, encoding="utf-8")
        command = [
            sys.executable, "-m", "ziglang", "cc", *FLAGS, *(f"-Wl,--export={export}" for export in exports),
            *(f"-I{place}" for place in headers), *defines, str(path), "-o", str(target),
        ]  # fmt: skip
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            raise LibraryError(f"not compiled to WebAssembly: {shlex.join(command)}\n{done.stderr.strip()}")
        return target.read_bytes()
