"""The command line: ``meshwright COMMAND …``; every command is a module of :mod:`meshwright.commands`.

Exit status: 0 done, 1 a result is missing or did not converge (the rest is written), 2 bad input.
"""

import argparse
import atexit
import gc
import os
import re
import sys
from pathlib import Path

from meshwright import commands
from meshwright.base import drives
from meshwright.base.errors import DesignError, LibraryError, UsageError, plain

#: Objects made before cycles among them are looked for. What a command makes it mostly keeps to its end: to look as
#: often as Python does by itself, and once more at the end, takes a tenth of a report's time.
OBJECTS = 500_000


#: How a message begins that no input should lead to.
FAULT = "a fault of the program"


def _told(error):
    """What ended a command that should have said so in words: the error and the line, for who mends it."""
    import traceback  # not loaded where all is well

    *_, frame = traceback.extract_tb(error.__traceback__)
    return (
        f"{type(error).__name__}: {error} ({Path(frame.filename).name}, line {frame.lineno}). If the drive is one of "
        "your own, compare its page with that of a family; else please report this with the command and the design"
    )


class _Parser(argparse.ArgumentParser):
    """Repeats no control characters of the command line to the terminal."""

    def error(self, message):
        super().error(_shown(message))


def _shown(message):
    return "\n".join(map(plain, str(message).splitlines()))


def parser(names=None):
    """The argument parser of these commands, by default of all."""
    top = _Parser(prog="meshwright", description="Tooth contact analysis of gear drives.")
    top.add_argument("--version", action=_Version, help="show the version and exit")
    top.add_argument("--drives", action="append", default=[], metavar="DIR", help="folder of drives to search first")
    subparsers = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name in commands.every() if names is None else names:
        module, summary = commands.module(name), commands.summary(name)
        text = (summary + module.__doc__.strip().partition("\n")[2]).replace("``", "`")
        sub = subparsers.add_parser(name, help=summary, description=text)
        module.add_arguments(sub)
        files = [a.dest for a in sub._actions if re.search("DESIGN|FILE", a.metavar or "")]
        sub.set_defaults(run=module.run, files=files)
    return top


def _named(words):
    """The command that is named, as a list: it waits for no other's imports. None where all are to answer."""
    word = _first(words)
    known = word in commands.MODULES or word in commands.every()
    return [word] if known else None


def _first(words):
    """The first word that is neither a global option nor the value of one; None where help is asked for before it."""
    rest = iter(words)
    for word in rest:
        if word == "--drives":
            next(rest, None)
        elif word in ("-h", "--help"):
            return None
        elif not word.startswith("-"):
            return word
    return None


class _Version(argparse.Action):
    """Prints the installed version; it is looked up only when it is asked for."""

    def __init__(self, **options):
        super().__init__(nargs=0, **options)

    def __call__(self, parser, namespace, values, option_string=None):
        from importlib.metadata import version

        parser.exit(message=f"meshwright {version('meshwright')}\n")


def joined(arguments):
    """``--phi-deg -3,0,3`` as ``--phi-deg=-3,0,3``: argparse takes a list that begins with a minus for an option."""
    result = []
    for argument in arguments:
        if result and re.match(r"--[a-z-]+$", result[-1]) and re.match(r"-[\d.]", argument):
            result[-1] += f"={argument}"
        else:
            result.append(argument)
    return result


def _refuse_overwriting(options):
    """A file is read or written once: a slip of the keyboard costs no design, no measurement and no result."""
    given = {name: getattr(options, name) for name in options.files}
    design = given.pop("design", None)
    seen = {"design": design} if design and Path(design).is_file() else {}
    for name, value in given.items():
        for other, place in seen.items():
            if _one_file(Path(value or "-"), Path(place)):
                whose = "the design itself" if other == "design" else f"the file of {_as_typed(other)} too"
                raise UsageError(f"{_as_typed(name)} {value}: is {whose}; name another file")
        if value not in (None, "-"):
            seen[name] = value


def _one_file(a, b):
    """Whether two paths lead to one file; a device or a pipe is none."""
    if a.exists() and b.exists():
        return a.is_file() and a.samefile(b)
    return a.resolve() == b.resolve()


def main(arguments=None):
    """Run one command; returns the exit status."""
    # Matrices here are small: a second thread of the linear algebra mostly waits for the first, at full load.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    if arguments is None:
        gc.set_threshold(OBJECTS)
        atexit.register(gc.freeze)
    words = joined(sys.argv[1:] if arguments is None else arguments)
    if hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(errors="replace")  # a terminal without a letter of ours shows "?"
    try:
        options = parser(_named(words)).parse_args(words)
        _refuse_empty(options)
        _refuse_mixed(options)
        _refuse_overwriting(options)
        with drives.searched_first(options.drives):
            status = options.run(options)
        sys.stdout.flush()
        return status
    except (DesignError, UsageError, LibraryError) as error:
        print(f"meshwright: {_shown(error)}", file=sys.stderr)
        return 2
    except Exception as error:
        if arguments is not None:  # who calls from Python sees it as it is
            raise
        print(f"meshwright: {FAULT} in {_first(words)}: {_told(error)}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("meshwright: interrupted", file=sys.stderr)
        return 130
    except BrokenPipeError:
        sys.stderr.close()
        return 1
    except OSError as error:
        place = error.filename or "standard output"
        print(_shown(f"meshwright: {place}: {error.strerror}; name a place that can be written"), file=sys.stderr)
        if not error.filename:
            _forget(sys.stdout)
        return 2


def _refuse_empty(options):
    for name, value in vars(options).items():
        if value == "":
            raise UsageError(f"{_as_typed(name)}: an empty word; give it a value or leave it out")


def _as_typed(name):
    """The name of an argument as the command line has it."""
    return "DESIGN" if name == "design" else f"--{name.replace('_', '-')}"


def _refuse_mixed(options):
    """Two results on one standard output could not be told apart."""
    outputs = [f"{_as_typed(name)} -" for name, value in vars(options).items() if value == "-"]
    if len(outputs) > 1:
        raise UsageError(f"{' '.join(outputs)}: two results on standard output; name a file for one of them")


def _forget(stream):
    """Send what a stream still holds nowhere, so that closing it does not fail again."""
    with open(os.devnull, "w") as nowhere:
        os.dup2(nowhere.fileno(), stream.fileno())


if __name__ == "__main__":
    sys.exit(main())
