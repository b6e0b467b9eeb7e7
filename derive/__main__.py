"""``python -m derive``: see :mod:`derive.command`."""

import gc
import os
import signal
import sys

#: Exit status of a command that was interrupted, as shells have it.
INTERRUPTED = 130


def main():
    """Run the command with Python's own integers, whatever else SymPy would find, and without looking for garbage.

    Modules and expressions live as long as the process: the search would take a fifth of the time of one drive. What
    is frozen is not searched at the end either. Interrupted, it says so, and its workers nothing.
    """
    os.register_at_fork(after_in_child=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    os.environ.setdefault("SYMPY_GROUND_TYPES", "python")
    gc.disable()
    try:
        from derive import command

        status = command.main()
    except KeyboardInterrupt:
        print("interrupted; every file is whole, as it was or new", file=sys.stderr)
        return INTERRUPTED
    gc.freeze()
    return status


if __name__ == "__main__":
    sys.exit(main())
