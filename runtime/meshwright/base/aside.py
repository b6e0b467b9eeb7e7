"""Work that a copy of this process does while the process itself goes on, on systems that can copy a process."""

import os
import pickle
import threading
from contextlib import contextmanager


@contextmanager
def aside(work):
    """A function for ``with`` that returns what ``work()`` returns, or raises what it raises; both can be pickled.

    The work is begun at once where a process can be copied and there is a second processor; else, and if the copy has
    been ended from outside, it is done when it is asked for.
    """
    if not _can_be_copied():
        yield work
        return
    reading, writing = os.pipe()
    copy = os.fork()
    if copy == 0:
        _done(work, reading, writing)
    os.close(writing)
    try:
        with os.fdopen(reading, "rb") as stream:
            yield lambda: _result(stream.read(), work)
    finally:
        os.waitpid(copy, 0)  # with its pipe closed it ends at the latest when it writes


def _can_be_copied():
    several = hasattr(os, "sched_getaffinity") and len(os.sched_getaffinity(0)) > 1
    return several and hasattr(os, "fork") and threading.active_count() == 1


def _done(work, reading, writing):
    """In the copy: the work, written to the pipe; it never returns."""
    try:
        os.close(reading)
        try:
            found = pickle.dumps((work(), None))
        except Exception as error:
            found = pickle.dumps((None, error))
        with os.fdopen(writing, "wb") as stream:
            stream.write(found)
    finally:
        os._exit(0)


def _result(found, work):
    if not found:
        return work()
    value, error = pickle.loads(found)
    if error is not None:
        raise error
    return value
