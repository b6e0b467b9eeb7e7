"""The compiled core library, its interface read from its own headers, and the drives' objects, loaded on first use."""

import contextlib
import ctypes
import hashlib
import re
import threading
from functools import cache
from pathlib import Path

import numpy as np

from meshwright.base.cache import cache_folder, read_sealed, say, write_sealed
from meshwright.base.drives import SHIPPED, folders, object_of
from meshwright.base.errors import LibraryError

#: Version of the model table (mw_model.h) that this package reads.
ABI = 7

_loading, _thread = threading.Lock(), threading.local()


def _interface():
    """C declarations of the model table and of the runtime, as cffi wants them."""
    names = ("mw_model.h", "mw_status.h", "mw_enclosures.h", "mw_certify.h", "meshwright.h")
    model, status, *parts = ((SHIPPED / "include" / name).read_text(encoding="utf-8") for name in names)
    codes = ", ".join(f"{code} = {value}" for code, value in re.findall(r"X\((MW_\w+), (-?\d+),", status))
    end = re.search(r"MW_STATUS_END = \d+", status).group()
    declared = re.sub(r"^#.*$", "", model, flags=re.MULTILINE)
    declared += f"typedef enum mw_status {{ {codes}, {end} }} mw_status;"
    for text in (status, *parts):
        declared += re.search(r"/\* BEGIN INTERFACE.*?\*/(.*)/\* END INTERFACE", text, re.DOTALL).group(1)
    return declared


def record(name):
    """NumPy's view of a plain structure of the interface, field by field as C lays it out."""
    library()
    fields = dict(ffi.typeof(name).fields)
    return np.dtype(
        {
            "names": list(fields),
            "formats": [_format(field.type) for field in fields.values()],
            "offsets": [field.offset for field in fields.values()],
            "itemsize": ffi.sizeof(name),
        }
    )


def _format(kind):
    if kind.kind == "array":
        return (_format(kind.item), kind.length)
    if kind.kind == "struct":
        return record(kind.cname)
    return {"double": "f8", "int": "i4", "unsigned int": "u4", "size_t": "u8"}[kind.cname]


def _parsed():
    """cffi's view of the interface; parsing takes a third of a short command's time, so the result is kept."""
    try:
        declarations = _interface()
    except OSError:  # nothing is built yet; whoever loads the library is told so
        declarations = ""
    kept = cache_folder() / f"interface-{hashlib.sha256(declarations.encode()).hexdigest()[:32]}.sealed"
    try:
        return _executed(read_sealed(kept, declarations))
    except OSError:
        pass
    except ValueError as error:
        say(f"{kept}: {error}; made anew")
    return _written(declarations, kept)


def _executed(source):
    """The interface that Python's ``source`` (bytes), written by cffi, makes."""
    names = {}
    exec(compile(source, "interface", "exec"), names)
    return names["ffi"]


def _written(declarations, place):
    """The interface, parsed and, if it can be, kept at ``place``."""
    import tempfile

    import cffi
    from cffi.recompiler import make_py_source

    made = cffi.FFI()
    made.cdef(declarations)
    made.set_source("interface", None)
    with tempfile.TemporaryDirectory() as folder:
        written = Path(folder) / "interface.py"
        make_py_source(made, "interface", str(written))
        source = written.read_bytes()
    with contextlib.suppress(OSError):  # a cache that cannot be written costs time, nothing else
        write_sealed(place, declarations, source)
    return _executed(source)


ffi = _parsed()


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
        if isinstance(function, int):  # a constant
            return function

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


def model(name, places=None):
    """The model table of a drive, from its own shared object in the first of the folders ``places`` that has it."""
    library()
    with _loading:
        return _model(name, places or folders())


@cache
def _model(name, places):
    path = object_of(name, places)
    found = ffi.cast("const mw_model *", _table(path, "mw_drive", name))
    if found.abi != ABI:
        raise LibraryError(f"{path} has ABI {found.abi}, this package needs ABI {ABI}: build it again")
    return found


def proofs(name, places=None):
    """What of a drive proves many contacts at once, from an object of its own; ``places`` as of :func:`model`."""
    library()
    with _loading:
        return _beside("proofs", name, places or folders())


def model_in_lanes(name, places=None):
    """The model table of a drive with its lane kernels, from an object of their own; ``places`` as of :func:`model`."""
    library()
    with _loading:
        return _joined(name, places or folders())[0]


@cache
def _joined(name, places):
    """The table, and the room that it is in."""
    room = ffi.new("double[]", -(-_loaded().mw_joined_size() // ffi.sizeof("double")))
    lanes = _beside("in_lanes", name, places)
    return _loaded().mw_joined(_model(name, places), lanes, ffi.NULL, room), room


@cache
def _beside(kind, name, places):
    """What an object beside a drive's own holds."""
    table = _table(object_of(name, places, f"_{kind}"), f"mw_{kind}", name)
    return ffi.cast(f"const struct mw_{kind} *", table)


def _table(path, kind, name):
    """The address that the one function of a drive's shared object returns."""
    try:
        table = getattr(ctypes.CDLL(str(path)), f"{kind}_{name}")
    except (OSError, AttributeError) as error:
        raise LibraryError(f"{path} is not the object of the drive {name} ({error}): build it again") from error
    table.restype = ctypes.c_void_p
    return table()
