"""The compiled core library, its interface read from its own headers, and the drives' objects, loaded on first use."""

import ctypes
import re
import threading
from functools import cache

import cffi

from meshwright.base.drives import SHIPPED, folders, object_of
from meshwright.base.errors import LibraryError

ABI = 1

ffi = cffi.FFI()
_loading, _thread = threading.Lock(), threading.local()


def _interface():
    """C declarations of the model table and of the runtime, as cffi wants them."""
    model = (SHIPPED / "include" / "mw_model.h").read_text(encoding="utf-8")
    runtime = (SHIPPED / "include" / "meshwright.h").read_text(encoding="utf-8")
    functions = re.search(r"/\* BEGIN INTERFACE.*?\*/(.*)/\* END INTERFACE", runtime, re.DOTALL).group(1)
    return re.sub(r"^#.*$", "", model, flags=re.MULTILINE) + functions


def library():
    """The loaded library; raises :class:`LibraryError` with the remedy if it cannot be used. Safe in any thread."""
    with _loading:
        return _loaded()


class _Calls:
    """The functions of a library. An exception in a Python function that one of them calls is raised on its return."""

    def __init__(self, functions):
        self._functions = functions

    def __getattr__(self, name):
        function = getattr(self._functions, name)

        def call(*arguments):
            result = function(*arguments)
            if error := vars(_thread).pop("error", None):
                raise error
            return result

        setattr(self, name, call)
        return call


def callback(signature, function):
    """C's view of a Python function; where it raises, C gets not-a-number or 1, and the exception is raised later."""
    failed = {"double": float("nan"), "int": 1}.get(signature.result.cname)
    return ffi.callback(signature, function, error=failed, onerror=_keep)


def _keep(kind, error, traceback):
    vars(_thread).setdefault("error", error)


@cache
def _loaded():
    path = SHIPPED / "libmeshwright.so"
    if not path.exists():
        raise LibraryError(f"{path} does not exist: run `make build` in the checkout, or install the wheel")
    ffi.cdef(_interface())
    loaded = _Calls(ffi.dlopen(str(path)))
    if loaded.mw_abi() != ABI:
        raise LibraryError(
            f"{path} has ABI {loaded.mw_abi()}, this package needs ABI {ABI}: run `make build` again"
        )
    return loaded


def text(string):
    """A C string as a Python string."""
    return ffi.string(string).decode()


def pointer(array, kind="double[]"):
    """A contiguous array, of floats unless another kind is named, as C sees it."""
    return ffi.from_buffer(kind, array)


def model(name):
    """The model table of a drive, from its own shared object."""
    library()
    with _loading:
        return _model(name, folders())


@cache
def _model(name, places):
    path = object_of(name)
    try:
        table = getattr(ctypes.CDLL(str(path)), f"mw_drive_{name}")
    except (OSError, AttributeError) as error:
        raise LibraryError(f"{path} is not the object of the drive {name} ({error}): build it again") from error
    table.restype = ctypes.c_void_p
    found = ffi.cast("const mw_model *", table())
    if found.abi != ABI:
        raise LibraryError(f"{path} has ABI {found.abi}, this package needs ABI {ABI}: build it again")
    return found
