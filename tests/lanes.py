"""Traces in lanes, called as the library offers them."""

import numpy as np

from meshwright.base.library import ffi, library, pointer

WIDTHS = (2, 4, 8)


def available():
    """The sets of lanes that this processor runs, by width."""
    sets = {width: library().mw_lanes(width) for width in WIDTHS}
    return {width: lanes for width, lanes in sets.items() if lanes != ffi.NULL}


def trace(lanes, drive, angles):
    """Unknowns, statuses and number of successes of one design along ``angles``, each lane a part of them."""
    m, n = drive.design.model_in_lanes, len(angles)
    width = library().mw_lanes_width(lanes)
    work = np.empty(library().mw_lanes_work(lanes, m, -(-n // width)))
    x, status = np.empty((n, m.nx)), np.empty(n, dtype=np.int32)
    succeeded = library().mw_trace_angles(
        lanes, m, pointer(drive.design.parameters), pointer(angles), n, pointer(work), pointer(x),
        pointer(status, "int[]"),
    )  # fmt: skip
    return x, status, succeeded


def trace_designs(lanes, drive, designs, angles, start=None):
    """The same of many parameter vectors, every lane one of them, all along ``angles``.

    ``start`` is near the solutions at the first angle; that of the drive itself if it is not given.
    """
    m, count, n = drive.design.model_in_lanes, len(designs), len(angles)
    start = drive.trace(angles[:1])[0][0] if start is None else start
    x, status = np.empty((count, n, m.nx)), np.empty((count, n), dtype=np.int32)
    work = np.empty(library().mw_lanes_work(lanes, m, n))
    succeeded = library().mw_trace_designs(
        lanes, m, pointer(designs), count, pointer(angles), n, pointer(start), pointer(work), pointer(x),
        pointer(status, "int[]"),
    )  # fmt: skip
    return x, status, succeeded
