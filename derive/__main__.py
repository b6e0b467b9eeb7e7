"""``python -m derive``: see :mod:`derive.command`."""

import gc
import os
import sys


def main():
    """Run the command with Python's own integers, whatever else SymPy would find, and without looking for garbage.

    Modules and expressions live as long as the process: the search would take a fifth of the time of one drive. What
    is frozen is not searched at the end either.
    """
    os.environ.setdefault("SYMPY_GROUND_TYPES", "python")
    gc.disable()
    from derive import command

    status = command.main()
    gc.freeze()
    return status


if __name__ == "__main__":
    sys.exit(main())
