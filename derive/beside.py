"""Work in a process of its own while this one goes on: what it returns comes back by way of a pipe."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable
from functools import cache
from multiprocessing.connection import Connection
from typing import TypeVar

T = TypeVar("T")


def begun(work: Callable[[], T]) -> Callable[[], T]:
    """Begin ``work`` in a copy of this process; the function returned waits for what it returns, once however often it
    is called, or raises its error.

    What ``work`` changes stays in the copy. With one processor, or where processes cannot be copied, ``work`` is done
    when it is asked for.
    """
    if not hasattr(os, "sched_getaffinity") or len(os.sched_getaffinity(0)) < 2:
        return cache(work)
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    # as a daemon it ends with this process, asked for or not
    process = context.Process(target=_send, args=(receiver, sender, work), daemon=True)
    process.start()
    sender.close()

    def result() -> T:
        try:
            made, error = receiver.recv()
        except EOFError:
            process.join()
            raise ChildProcessError(f"a process ended with exit code {process.exitcode}, without a result") from None
        process.join()
        if error is not None:
            raise error
        return made

    return cache(result)


def _send(receiver: Connection, sender: Connection, work: Callable[[], object]) -> None:
    receiver.close()  # as long as anybody could read, nothing would tell that the process that began this is gone
    try:
        sender.send((work(), None))
    except BrokenPipeError:
        pass
    except Exception as error:  # noqa: BLE001  raised where the result is asked for
        sender.send((None, error))
