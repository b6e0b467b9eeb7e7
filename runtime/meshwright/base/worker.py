"""Work in a forked process while this one goes on."""

import multiprocessing
import os
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from multiprocessing.connection import Connection
from typing import TypeVar

T = TypeVar("T")


def submit(work: Callable[[], T]) -> Callable[[], T]:
    """Start ``work`` in a forked worker; returns a memoised ``result()``, which waits for what ``work`` returns or
    raises. Either must be picklable; what ``work`` changes stays in the worker.

    With one processor, beside a thread, in a worker, or on a system without fork, ``work`` is done when its result is
    asked for; it is done again there if its worker was killed. A worker that exits by itself is a ChildProcessError.
    """
    return cache(_started(work)[0])


def at_once(work: Callable[[], T]) -> Callable[[], T]:
    """Start nothing: what :func:`submit` gives where ``work`` is done when its result is asked for."""
    return cache(work)


@contextmanager
def in_worker(work: Callable[[], T]) -> Iterator[Callable[[], T]]:
    """:func:`submit` for ``with``, at whose end no worker is left."""
    result, ended = _started(work)
    try:
        yield cache(result)
    finally:
        ended()


def _can_fork() -> bool:
    several = hasattr(os, "sched_getaffinity") and len(os.sched_getaffinity(0)) > 1
    alone = threading.active_count() == 1 and not multiprocessing.current_process().daemon
    return several and alone and "fork" in multiprocessing.get_all_start_methods()


def _started(work: Callable[[], T]) -> tuple[Callable[[], T], Callable[[], None]]:
    """The function that gives the result, and one that returns when the worker has ended."""
    if not _can_fork():
        return work, lambda: None
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    # as a daemon it ends with this process, asked for or not
    process = context.Process(target=_send, args=(receiver, sender, work), daemon=True)
    process.start()
    sender.close()

    def result() -> T:
        try:
            value, error = receiver.recv()
        except EOFError:
            process.join()
            if (process.exitcode or 0) < 0:
                return work()
            raise ChildProcessError(f"a worker exited with {process.exitcode}, without a result") from None
        process.join()
        if error is not None:
            raise error
        return value

    def ended() -> None:
        receiver.close()  # it ends at the latest when it writes
        process.join()

    return result, ended


def _send(receiver: Connection, sender: Connection, work: Callable[[], object]) -> None:
    receiver.close()  # as long as anybody could read, nothing would tell that the process that began this is gone
    try:
        sender.send((work(), None))
    except BrokenPipeError:
        pass
    except Exception as error:  # noqa: BLE001  raised where the result is asked for
        sender.send((None, error))
