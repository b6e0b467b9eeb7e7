"""Samples of a sweep on a GPU: the drive's header and runtime/c/drive/device.h, compiled when they are first asked for.

The rows are those of ``portable`` lanes, bit for bit. What does not go through in one trace is left to the lanes.
"""

# pyright: reportMissingImports=false

from functools import cache
from pathlib import Path
from threading import Lock

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import SHIPPED

#: What ``--device`` knows beside the processor itself.
DEVICES = ("cuda",)

#: Of each operation the rounded result, as on the host.
OPTIONS = ("--fmad=false",)

#: Threads that a multiprocessor is given at once.
BLOCK = 128

_COMPILING = Lock()


def require(device):
    """Raise :class:`~meshwright.base.errors.UsageError` if a device, or what drives it, is not there."""
    if device in DEVICES:
        _cupy()


def source(drive):
    """The program of a drive for a device, and the folders in which its headers are."""
    description = drive.design.description
    folders = (SHIPPED / "source", SHIPPED / "include", Path(description["folder"]) / "include")
    return f'#define MW_DRIVE {description["name"]}\n#include "drive/device.h"\n', folders


def on_cuda(drive, parameters, angles, start):
    """Traces (S, np) of designs at angles (N,), from start values (nx,) at the first, on the current CUDA device.

    Returns arrays: whether each trace went through (S,), status and flags (S, N), errors (S, N) in rad, points
    (S, N, 3) in mm.
    """
    cupy = _cupy()
    text, folders = source(drive)
    with _COMPILING:
        kernel = _compiled(text, tuple(f"-I{folder}" for folder in folders))
    shape = len(parameters), len(angles)
    given = [cupy.asarray(a) for a in (parameters, angles, start)]
    found = [
        cupy.empty(shape[:1], np.int32), cupy.empty(shape, np.int32), cupy.empty(shape, np.uint32),
        cupy.empty(shape), cupy.empty((*shape, 3)),
    ]  # fmt: skip
    sizes = np.int64(shape[0]), np.int32(shape[1])
    kernel((-(-shape[0] // BLOCK),), (BLOCK,), (given[0], sizes[0], given[1], sizes[1], given[2], *found))
    through, *rest = map(cupy.asnumpy, found)
    return through != 0, *rest


@cache
def _compiled(text, folders):
    module = _cupy().RawModule(code=text, options=(*OPTIONS, *folders))
    return module.get_function("mw_samples")


def _cupy():
    """The library that compiles for CUDA devices and runs there."""
    without = "--portable has the same rows without one"
    try:
        import cupy
    except ImportError as error:
        remedy = "`pip install 'meshwright[cuda]'` brings it"
        raise UsageError(f"--device cuda: CuPy is not installed; {remedy}; {without}") from error
    try:
        count = cupy.cuda.runtime.getDeviceCount()
    except RuntimeError as error:  # of the driver, or where there is none
        reason = str(error).partition(": ")[2] or str(error)
        raise UsageError(f"--device cuda: no GPU ({reason}); install NVIDIA's driver; {without}") from error
    if not count:
        raise UsageError(f"--device cuda: there is no GPU in this machine; {without}")
    return cupy
