"""Work aside: a function in a process of its own while this one goes on."""

import os
import pickle
import sys
import traceback
from functools import partial


def processors():
    """How many processes can work at once: one where the system cannot fork a process that has loaded libraries."""
    return len(os.sched_getaffinity(0)) if sys.platform == "linux" else 1


def aside(function, *arguments):
    """Begin ``function(*arguments)`` in a process of its own; returns a function that waits for its value.

    With one processor the work is done when its value is asked for. Raises ``ChildProcessError`` there if the work
    failed; why is written to stderr.
    """
    if processors() == 1:
        return partial(function, *arguments)
    reader, writer = os.pipe()
    process = os.fork()
    if process == 0:
        os.close(reader)
        _work(writer, function, arguments)
    os.close(writer)
    return partial(_value, process, reader)


def shared(items):
    """The items (at most 256), each for whichever process asks first: this one or one begun later."""
    reader, writer = os.pipe()
    os.write(writer, bytes(range(len(items))))
    os.close(writer)
    return (items[position[0]] for position in iter(partial(os.read, reader, 1), b""))


def _work(writer, function, arguments):
    status = 1
    try:
        with os.fdopen(writer, "wb") as stream:
            pickle.dump(function(*arguments), stream)
        status = 0
    except Exception:
        traceback.print_exc()
    finally:
        os._exit(status)


def _value(process, reader):
    with os.fdopen(reader, "rb") as stream:
        answer = stream.read()
    _, status = os.waitpid(process, 0)
    if status:
        raise ChildProcessError("work aside has failed")
    return pickle.loads(answer)
