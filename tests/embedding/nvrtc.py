"""NVIDIA's compiler at run time, which makes PTX of CUDA C++ without a processor that runs it."""

import ctypes
import ctypes.util
from functools import cache
from importlib.util import find_spec
from pathlib import Path

#: Options under which a device gives the host's bits, for the oldest processor with all that is asked for here.
OPTIONS = ("--fmad=false", "--gpu-architecture=compute_80")


@cache
def library():
    """NVRTC of its Python package or of the system; None if there is none."""
    spec = find_spec("nvidia") and (find_spec("nvidia.cuda_nvrtc") or find_spec("nvidia.cu13"))
    places = spec.submodule_search_locations if spec else ()
    found = [path for place in places for path in Path(place).glob("lib/libnvrtc.so.*")]
    name = next(iter(sorted(found)), None) or ctypes.util.find_library("nvrtc")
    return ctypes.CDLL(str(name)) if name else None


def ptx(text, *options):
    """What NVRTC makes of a source text; raises AssertionError with its words where it refuses it."""
    lib, program, size = library(), ctypes.c_void_p(), ctypes.c_size_t()
    lib.nvrtcCreateProgram(ctypes.byref(program), text.encode(), b"kernel.cu", 0, None, None)
    words = [option.encode() for option in (*OPTIONS, *options)]
    ended = lib.nvrtcCompileProgram(program, len(words), (ctypes.c_char_p * len(words))(*words))

    def said(what):
        getattr(lib, f"nvrtcGet{what}Size")(program, ctypes.byref(size))
        buffer = ctypes.create_string_buffer(size.value)
        getattr(lib, f"nvrtcGet{what}")(program, buffer)
        return buffer.value.decode()

    assert ended == 0, said("ProgramLog")
    made = said("PTX")
    lib.nvrtcDestroyProgram(ctypes.byref(program))
    return made
