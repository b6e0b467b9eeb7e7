"""The compiled library, its interface read from its own headers."""

import re
from functools import cache
from pathlib import Path

import cffi

SHIPPED = Path(__file__).parent / "_generated"
ABI = 1

ffi = cffi.FFI()


class LibraryError(RuntimeError):
    """The compiled library is missing or does not fit this package."""


def _interface():
    """C declarations of the model table and of the runtime, as cffi wants them."""
    model = (SHIPPED / "include" / "mw_model.h").read_text(encoding="utf-8")
    runtime = (SHIPPED / "include" / "meshwright.h").read_text(encoding="utf-8")
    functions = re.search(r"/\* BEGIN INTERFACE.*?\*/(.*)/\* END INTERFACE", runtime, re.DOTALL).group(1)
    return re.sub(r"^#.*$", "", model, flags=re.MULTILINE) + functions


@cache
def library():
    """The loaded library; raises :class:`LibraryError` with the remedy if it cannot be used."""
    path = SHIPPED / "libmeshwright.so"
    if not path.exists():
        raise LibraryError(f"{path} does not exist: run `make build` in the checkout, or install the wheel")
    ffi.cdef(_interface())
    loaded = ffi.dlopen(str(path))
    if loaded.mw_abi() != ABI:
        raise LibraryError(
            f"{path} has ABI {loaded.mw_abi()}, this package needs ABI {ABI}: run `make build` again"
        )
    return loaded


def text(pointer):
    """A C string as a Python string."""
    return ffi.string(pointer).decode()


def model(name):
    """The model table of a drive."""
    found = library().mw_find(name.encode())
    if found == ffi.NULL:
        raise LibraryError(f"the compiled library has no drive {name!r}: run `make generate build`")
    return found
