"""The command line: ``meshwright COMMAND …``; every command is a module of :mod:`meshwright.commands`.

Exit status: 0 done, 1 a result is missing or did not converge (the rest is written), 2 bad input.
"""

import argparse
import re
import sys

from meshwright import commands
from meshwright._library import LibraryError
from meshwright.errors import DesignError, UsageError


def parser():
    """The argument parser of all commands."""
    top = argparse.ArgumentParser(prog="meshwright", description="Tooth contact analysis of gear drives.")
    subparsers = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for module in commands.ALL:
        name = module.__name__.rsplit(".", 1)[-1]
        summary = module.__doc__.strip().splitlines()[0]
        sub = subparsers.add_parser(name, help=summary, description=module.__doc__)
        module.add_arguments(sub)
        sub.set_defaults(run=module.run)
    return top


def joined(arguments):
    """``--phi-deg -3,0,3`` as ``--phi-deg=-3,0,3``: argparse takes a list that begins with a minus for an option."""
    result = []
    for argument in arguments:
        if result and re.match(r"--[a-z-]+$", result[-1]) and re.match(r"-[\d.]", argument):
            result[-1] += f"={argument}"
        else:
            result.append(argument)
    return result


def main(arguments=None):
    """Run one command; returns the exit status."""
    options = parser().parse_args(joined(sys.argv[1:] if arguments is None else arguments))
    try:
        return options.run(options)
    except (DesignError, UsageError, LibraryError) as error:
        print(f"meshwright: {error}", file=sys.stderr)
        return 2
    except BrokenPipeError:
        sys.stderr.close()
        return 1


if __name__ == "__main__":
    sys.exit(main())
