"""Fault injection: a process that ends, or a disk that fills, at a given write.

What a function does to the files of a folder is counted by the interpreter's audit events: each opening for writing,
lock, new folder, renaming and removal. ``os.fork`` gives each attempt a process of its own in milliseconds.
"""

import errno
import os
import signal
import sys
from contextlib import contextmanager

_WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC
_CHANGES = {"os.rename", "os.remove", "os.mkdir", "os.rmdir", "os.truncate", "os.link", "os.symlink"}


def _writes(event, arguments, folder):
    if event == "fcntl.flock":
        return True
    if event == "open":
        path, _, flags = arguments
        return flags & _WRITING and isinstance(path, str | bytes) and os.fsdecode(path).startswith(folder)
    return event in _CHANGES and any(os.fsdecode(a).startswith(folder) for a in arguments if isinstance(a, str | bytes))


def _forked(function, folder, before):
    """Exit status of a process that calls ``function``; ``before(k)`` is called before its k-th write, from 1."""
    child = os.fork()
    if child:
        return os.waitpid(child, 0)[1]
    count, own = 0, os.getpid()

    def heard(event, arguments):
        nonlocal count
        if os.getpid() == own and _writes(event, arguments, str(folder)):
            count += 1
            before(count)

    status = 70
    try:
        sys.addaudithook(heard)
        function()
        status = 0
    finally:
        os._exit(status)


def killed(function, folder, at):
    """Call ``function`` in a process that is killed before its write number ``at``; whether it came so far."""

    def end(count):
        if count == at:
            os.kill(os.getpid(), signal.SIGKILL)

    status = _forked(function, folder, end)
    assert status in (0, signal.SIGKILL), f"ended with status {status}"
    return status != 0


def ended(function, folder):
    """Call ``function`` in a process of its own, to its end."""
    assert not killed(function, folder, 0)


def writes(function, folder):
    """How many writes ``function`` makes, in a process of its own that is killed at none."""
    reader, writer = os.pipe()
    status = _forked(function, folder, lambda count: os.write(writer, b"."))
    os.close(writer)
    with os.fdopen(reader, "rb") as stream:
        count = len(stream.read())
    assert status == 0
    return count


def contents(folder, but=()):
    """Path → bytes of every file below a folder."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.name not in but
    }


@contextmanager
def full_disk(monkeypatch, at):
    """From call number ``at`` on no file can be synchronised or take the place of another."""
    count = 0

    def failing(real):
        def call(*arguments, **named):
            nonlocal count
            count += 1
            if count >= at:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            return real(*arguments, **named)

        return call

    with monkeypatch.context() as patched:
        for name in ("fsync", "replace"):
            patched.setattr(os, name, failing(getattr(os, name)))
        yield
